"""Meshes of `verify --adapt`: each is made by `fsi-mesh adapt` from the error indicator of the run on its predecessor.

Their sizes are counted by their nodes: a mesh of N ratio^d nodes, d the dimension, is finer by the ratio than one of N,
and as fine as a uniform one of as many. Where the elements of a uniform mesh converge with h^p, those of adapted ones
do with N^(-p/d), also where the solution has kinks that would cost the uniform one its order."""

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, Mapping, Sequence

from ..base.errors import InputError
from ..base.files import read_bytes
from ..study.study_file import StudyMesh
from ..study.study_run import StudyRun
from .family import Member
from .mesh_family import Recipe

RATIO = 1.5  # between meshes
NODES = b"$Nodes"
REMEDY = "give a gmsh mesh of format 4.1 or 2.2"


@dataclass(frozen=True)
class Adapted(Recipe):
    """Recipe for the adapted meshes of a case whose own mesh is made by `base`."""

    base: Recipe = None  # type: ignore[assignment]
    dimension: int = 3
    # Mesh and run by level; the case's own is level 0.
    parents: dict[int, tuple[Path, Path]] = field(default_factory=dict)

    @property
    def coarsens(self) -> bool:
        return False

    @property
    def adapts(self) -> bool:
        return True

    def ratio(self, levels: Sequence[int]) -> float:
        return RATIO

    @property
    def remakes(self) -> bool:
        """Whether the script's shape is meshed anew; else cells are halved. A background field changes no counts of
        cells."""
        return self.base.geo is not None and not self.base.geo.counts

    def level(self, mesh: float) -> int:
        return round(-math.log(mesh) / math.log(RATIO))

    def mesh(self, factor: float, folder: Path, case: str) -> StudyMesh | None:
        """The mesh of a level. Raises InputError where the run that it is made from is missing."""
        level = self.level(1 / factor)
        if level == 0:
            return self.base.mesh(1, folder, case)
        if level - 1 not in self.parents:
            raise InputError(folder, f"mesh {level}", "the run on the mesh before it is missing", "see members.csv")
        mesh, run = self.parents[level - 1]
        nodes = round(nodes_of(self.parents[0][0]) * RATIO ** (self.dimension * level))
        words = [str(mesh), str(run), "--nodes", str(nodes)]
        if self.remakes:
            assert self.base.geo is not None
            words += ["--geo", str(self.base.geo.script)]
            for name, value in self.base.geo.settings(1.0, dict(self.base.given)).items():
                words += ["--set", f"{name}={value:.10g}"]
        return StudyMesh(f"{case[:40]}-a{level}", f"adapted {level} times", tuple(words), "adapt")


def adapted(base: Recipe, dimension: int) -> Adapted:
    return Adapted("adapt", base.words, base.geo, base.given, base.file, base=base, dimension=dimension)


def about_adapted(recipe: Adapted) -> str:
    """How its meshes are made, in words."""
    how = f"{recipe.base.geo.script.name} is meshed anew" if recipe.remakes and recipe.base.geo else "cells are halved"
    return (
        "Meshes: the case's own and what fsi-mesh adapt makes of it, each from the error indicator of the run on the one "
        f"before, with {RATIO**recipe.dimension:.3g} times its nodes; {how}. They are adapted to the sum of the indicators of "
        "velocity, displacement and pressure, each alike, and to no single quantity."
    )


def adapting_member(recipe: Adapted, runs: Mapping[Member, StudyRun], level: int) -> Member:
    """The member whose indicator makes the mesh of the next level."""
    plain = (m for m in runs if m.step == 1 and not (m.looser or m.other) and recipe.level(m.mesh) == level)
    return next(plain, Member(round(RATIO**-level, 9), 1.0))


def nodes_of(mesh: Path) -> int:
    """Number of nodes in a mesh file of gmsh, text or binary. Raises InputError."""
    data = read_bytes(mesh, "make the mesh", REMEDY)
    try:
        version, kind, size = data[data.index(b"$MeshFormat") :].split(b"\n", 2)[1].split()[:3]
        begin = data.index(b"\n", data.index(NODES)) + 1
        if version.startswith(b"2"):
            return int(data[begin:].split(None, 1)[0])
        if kind == b"1":
            number = int(size)
            one = data[data.index(b"\n", data.index(b"$MeshFormat") + 12) + 1 :][:4]
            order: Literal["little", "big"] = "little" if one == b"\1\0\0\0" else "big"
            return int.from_bytes(data[begin + number : begin + 2 * number], order)
        return int(data[begin:].split(None, 2)[1])
    except (ValueError, IndexError):
        raise InputError(mesh, "$Nodes", "cannot be read", REMEDY) from None
