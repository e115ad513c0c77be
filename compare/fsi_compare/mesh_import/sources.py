"""The files of one mesh: each on its own, or one for each medium and each face, which become one mesh."""

from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

import numpy as np

from ..base.errors import InputError
from ..base.files import exists
from .joining import TooMany, first_of_cluster, near_pairs
from .parts import WHOLE, FoundMesh, found_mesh, whole_of
from .raw_mesh import Block, nothing
from .readers import read_mesh
from .vtu import read_faces

# Points of two files are one where their places agree in single precision, in which VTK and others write.
SINGLE = 4 * 2.0**-24


@dataclass
class Source:
    """A file, and what it is as a whole: `fluid` of fluid=lumen.vtu; empty where its parts are to be named."""

    name: str
    path: Path

    @property
    def file(self) -> str:
        return str(self.path)


def source_of(text: str) -> Source:
    """Reads FILE or NAME=FILE. Raises InputError."""
    name, equals, rest = text.partition("=")
    if not equals or not name or "/" in name or '"' in name or exists(Path(text)):
        return Source("", Path(text))
    if not rest:
        raise InputError("", name, f"'{text}' names no file", "write, for one, fluid=lumen.vtu")
    return Source(name, Path(rest))


def read_sources(sources: Sequence[Source], scale: float) -> tuple[FoundMesh, list[int]]:
    """The mesh, and how many points the files up to each one have. Points are not joined yet. Raises InputError."""
    names = [source.name for source in sources if source.name]
    for name in names:
        if names.count(name) > 1:
            raise InputError("", name, "is the name of two files", "give each file a name of its own")
    meshes = []
    for source in sources:
        surface = source.path.suffix.lower() == ".vtp" and len(sources) > 1
        meshes.append(found_mesh(source.file, (read_faces if surface else read_mesh)(source.path), scale))
    ends = np.cumsum([len(mesh.points) for mesh in meshes]).tolist()
    if len(meshes) == 1 and not names:
        return meshes[0], ends
    whole = FoundMesh(np.concatenate([mesh.points for mesh in meshes]), [])
    count = sum(len(mesh.blocks) for mesh in meshes)
    numbered = set()
    for source, mesh, end in zip(sources, meshes, ends):
        start, first = len(whole.blocks), end - len(mesh.points)
        whole.blocks += [Block(block.kind, block.nodes + first) for block in mesh.blocks]

        def spread(places: list[np.ndarray]) -> list[np.ndarray]:
            return [places[i - start] if start <= i < start + len(places) else nothing() for i in range(count)]

        def take(known: str) -> str:
            if known in whole.cells or known in whole.points_of or (known in names and known != source.name):
                problem = f"two of the files have the part {known}"
                raise InputError(source.file, known, problem, "give the files names: NAME=FILE for each")
            return known

        if source.name:
            whole.cells[take(source.name)] = spread(mesh.cells[WHOLE])
        stem = source.name or source.path.stem
        for name in [*mesh.cells, *mesh.points_of]:
            if name == WHOLE:
                continue
            others = (other for other in meshes if other is not mesh)
            twice = any(name in other.cells or name in other.points_of for other in others)
            known = take(f"{stem}/{name}" if source.name or twice else name)
            if name in mesh.points_of:
                whole.points_of[known] = mesh.points_of[name] + first
                continue
            whole.cells[known] = spread(mesh.cells[name])
            if name in mesh.numbered or source.name:
                numbered.add(known)
        whole.passed_over += [f"{source.path.name}: {text}" for text in mesh.passed_over]
    if WHOLE not in whole.cells:
        whole.cells[WHOLE] = whole_of(whole)
        numbered.add(WHOLE)
    whole.numbered = frozenset(numbered)
    return whole, ends


def join(file: str, mesh: FoundMesh, ends: Sequence[int], tolerance: float) -> list[str]:
    """Joins points that are at most `tolerance` apart, mm; with 0 those of different files that agree in single
    precision. The first one's place stays. Returns what was done, in sentences. Raises InputError where a cell would
    lose an edge."""
    used = np.zeros(len(mesh.points), dtype=bool)
    for block in mesh.blocks:
        used[block.nodes] = True
    there = np.flatnonzero(used)
    if not len(there) or (tolerance == 0 and len(ends) == 1):
        return []
    reach = tolerance if tolerance > 0 else SINGLE * float(np.abs(mesh.points[there]).max())
    try:
        i, j, distances = near_pairs(mesh.points[there], mesh.points[there], max(reach, 1e-300))
    except TooMany:
        raise _too_long(file, tolerance) from None
    owner = np.searchsorted(np.asarray(ends), there, side="right")
    kept = (i < j) & ((owner[i] != owner[j]) | (tolerance > 0))
    i, j, distances = i[kept], j[kept], distances[kept]
    lowest = there[first_of_cluster(len(there), i, j)]
    new = np.arange(len(mesh.points))
    new[there] = lowest
    for block in mesh.blocks:
        nodes = new[block.nodes]
        rows = np.sort(nodes, axis=1)
        if np.any(rows[:, 1:] == rows[:, :-1]):
            raise _too_long(file, tolerance)
        block.nodes = nodes
    for name, points in mesh.points_of.items():
        mesh.points_of[name] = np.unique(new[points])
    joined = int((lowest != there).sum())
    farthest = f", the farthest {float(distances.max()):.3g} mm apart" if joined else ""
    if tolerance > 0:
        return [f"--join {tolerance:g}: {joined} points are joined to others{farthest}."]
    what = "which single precision does not tell apart"
    return [f"{joined} points of the files are those of a file before, {what} ({reach:.2g} mm){farthest}."]


def _too_long(file: str, tolerance: float) -> InputError:
    if tolerance > 0:
        return InputError(file, "--join", f"{tolerance:g} mm is as long as an edge of a cell", "give a shorter one")
    return InputError(file, "", "has an edge that single precision does not resolve", "move the mesh to the origin")
