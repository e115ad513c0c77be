"""Families on the way to a demanded error. A cross varies meshes by long steps and steps on a coarse mesh, so that all
of it together costs about half of what its centre would, which is not run. What either error changes by from there to
the centre is told by the product of both (verdict.py). Where no mesh is coarser, or each is made from a run on its
predecessor, the centre is run."""

import math
from typing import Callable, Sequence

from .family import STEP_RATIO, Member
from .mesh_family import Recipe

Nodes = Callable[[float], int | None]  # of the mesh of a size


def cross(meshes: Sequence[float], steps: Sequence[float]) -> list[Member]:
    """`meshes` and `steps` from coarse to fine, three or more of each, the last ones those of the centre."""
    column = [Member(mesh, steps[0]) for mesh in meshes]
    row = [Member(meshes[0], step) for step in steps[1:]]
    near = Member(meshes[-2], steps[-2])
    return list(dict.fromkeys([*column, *row, near, Member(near.mesh, near.step, True)]))


def between(coarse: float, fine: float, ratio: float) -> list[float]:
    """Sizes from one to the other, each smaller by the ratio."""
    count = round(math.log(coarse / fine) / math.log(ratio))
    return [fine * ratio ** (count - k) for k in range(count)] + [fine]


def lean(meshes: Sequence[float], static: bool) -> list[Member]:
    """`meshes` relative to the centre, from coarse to fine, with at least one coarser than it."""
    coarser = [mesh for mesh in meshes if mesh > 1]
    near = min(coarser)
    found = [Member(mesh, 1.0) for mesh in meshes]
    if static:
        return [*found, Member(near, 1.0, True)]
    far = sorted(coarser)[1] if len(coarser) > 1 else 1.0
    steps = [Member(near, STEP_RATIO), Member(near, STEP_RATIO**2), Member(far, STEP_RATIO)]
    return [*found, *steps, Member(near, STEP_RATIO, True)]


def starting_member(
    recipe: Recipe, static: bool, ratio: float, levels: int, nodes: Nodes, longest: float | None = None
) -> Member:
    """Coarser than the case by a ratio, so that a demand that it exceeds by far costs little, but by steps no longer
    than `longest`, relative to the case's: longer ones give pressures no bar (doubt.py). Its mesh is the case's own
    where no coarser ones can be made, would have fewer than one cell where the case has some, or stay as they are,
    since walls and curves leave a mesh generator no choice. `nodes`: of the mesh of a size, which is made; None: it
    cannot be."""
    coarsens = recipe.coarsens and all(count >= ratio**levels for count in recipe.counts)
    if coarsens:
        near, far = nodes(ratio), nodes(ratio**levels)
        coarsens = near is not None and far is not None and near >= far * ratio ** (levels - 1)
    step = 1.0 if static else STEP_RATIO
    while longest is not None and step > longest * (1 + 1e-9):
        step /= STEP_RATIO
    return Member(ratio if coarsens else 1.0, step)
