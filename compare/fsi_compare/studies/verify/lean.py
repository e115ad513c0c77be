"""Families on the way to a demanded error: the member at their centre is the dearest, and all others together cost about half of
it. Steps are varied on the next coarser mesh. What a step's error changes by from there to the centre is told by the product of
both (verdict.py)."""

from typing import Callable, List, Optional, Sequence

from .family import STEP_RATIO, Member
from .mesh_family import Recipe


def lean(meshes: Sequence[float], static: bool) -> List[Member]:
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
    recipe: Recipe, static: bool, ratio: float, levels: int, nodes: Callable[[float], Optional[int]]
) -> Member:
    """Coarser than the case by a ratio, so that a demand that it exceeds by far costs little. Its mesh is the case's own where no
    coarser ones can be made, would have fewer than one cell where the case has some, or stay as they are, since walls and
    curves leave a mesh generator no choice. `nodes`: of the mesh of a size, which is made; None: it cannot be."""
    coarsens = recipe.coarsens and all(count >= ratio**levels for count in recipe.counts)
    if coarsens:
        near, far = nodes(ratio), nodes(ratio**levels)
        coarsens = near is not None and far is not None and near >= far * ratio ** (levels - 1)
    return Member(ratio if coarsens else 1.0, 1.0 if static else STEP_RATIO)
