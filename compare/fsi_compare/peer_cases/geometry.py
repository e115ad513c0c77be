"""The mesh of a case from a file for each medium and each face: what a face is, and the groups that become the mesh."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

import numpy as np

from ..base.errors import InputError
from ..mesh_import.conversion import require_sides, turn, write_gmsh
from ..mesh_import.groups import Group, choose_groups, corner_keys
from ..mesh_import.parts import FoundMesh
from ..mesh_import.raw_mesh import SIDES, Block
from ..mesh_import.sources import Source, join, read_sources

FLAT = np.cos(np.radians(5.0))  # a facet's normal along the face's mean one, of a flat face
IN_PLANE = 1e-6  # of the mesh's size: how far off their plane the drivers let nodes of a plane of symmetry lie


@dataclass
class Face:
    """A surface of a mesh. `name` is that of the mesh file, `given` what the other program calls it."""

    name: str
    given: str
    medium: str  # volume group
    triangles: np.ndarray  # (triangles, 3), points of the joined mesh
    area: float = 0.0  # mm^2
    normal: tuple[float, float, float] = (0.0, 0.0, 0.0)  # mean, out of its medium, of length 1
    flat: bool = False
    on_interface: bool = False
    axis: str = ""  # x, y or z: each facet lies in a plane normal to it


@dataclass
class CaseMesh:
    mesh: FoundMesh
    groups: list[Group]
    said: list[str]
    order: int

    def write(self, path: Path) -> None:
        """Writes gmsh's format 2.2."""
        with open(path, "w", encoding="utf-8") as out:
            write_gmsh(out, self.mesh, self.groups)


def plain_names(given: Sequence[str], taken: Sequence[str]) -> list[str]:
    """Names for groups of the mesh and keys of the case file: letters, digits, _ and -, each once; none that means
    something of itself in a mesh of ours."""
    names: list[str] = []
    for text in given:
        name = re.sub(r"[^A-Za-z0-9_-]", "_", text) or "face"
        if name in ("inner", "wall_ends", "fluid", "all") or name.startswith("symmetry"):
            name = f"face_{name}"
        base, number = name, 1
        while name in names or name in taken:
            number += 1
            name = f"face_{base}" if number == 2 else f"face_{base}_{number - 1}"
        names.append(name)
    return names


def read_case_mesh(
    file: str, media: dict[str, Path], faces: Sequence[tuple[str, str, str, Path]], scale: float, tolerance: float
) -> tuple[CaseMesh, list[Face]]:
    """Reads the mesh from files of volumes (by group) and of faces: name, the other program's name, medium and file.
    Facets of the interface of fluid and wall belong to no group of the mesh. Raises InputError."""
    sources = [Source(name, path) for name, path in media.items()]
    sources += [Source(name, path) for name, _, _, path in faces]
    mesh, ends = read_sources(sources, scale)
    if mesh.dimension != 3:
        raise InputError(sources[0].path, "", "holds no tetrahedra", "give a mesh of volumes")
    said = join(file, mesh, ends, tolerance)
    groups = choose_groups(file, mesh, [(source.name, source.name) for source in sources])
    volumes = {name: [g for g in groups if g.name == name and g.dimension == 3] for name in media}
    for source in sources:
        if [g.dimension for g in groups if g.name == source.name] != [3 if source.name in media else 2]:
            raise InputError(source.path, "", "holds cells and faces at once", "give a file for each")
    require_sides(file, mesh, groups, sources)
    turned = turn(mesh, groups)
    if turned:
        said.append(f"{turned} cells were turned inside out and are turned back")
    made = []
    kept = [group for name in media for group in volumes[name]]
    blocks = {name: [block for group in volumes[name] for block in group.parts] for name in media}
    tetrahedra = {name: np.concatenate([block.nodes[:, :4] for block in parts]) for name, parts in blocks.items()}
    order = 2 if any(block.kind == "tetra10" for parts in blocks.values() for block in parts) else 1
    for name, given, medium, path in faces:
        (group,) = [g for g in groups if g.name == name]
        face, rest = _face(mesh, group, given, medium, tetrahedra, path)
        made.append(face)
        if rest is not None:
            kept.append(rest)
    return CaseMesh(mesh, kept, said, order), made


def _face(
    mesh: FoundMesh, group: Group, given: str, medium: str, tetrahedra: dict[str, np.ndarray], path: Path
) -> tuple[Face, Group | None]:
    """The face without what is on the interface, and its group."""
    triangles = np.concatenate([block.nodes[:, :3] for block in group.parts])
    opposite, uses = _owners(tetrahedra[medium], triangles)
    if np.any(uses == 0):
        problem = f"{int((uses == 0).sum())} of its {len(triangles)} triangles are sides of no cell of {medium}"
        raise InputError(path, given, problem, "give the face of this very mesh")
    across = np.zeros(len(triangles), dtype=bool)
    for name, cells in tetrahedra.items():
        if name != medium and "fluid" in (name, medium):
            across |= _owners(cells, triangles)[1] > 0
    normals = _area_vectors(mesh.points, triangles, opposite)
    face = Face(group.name, given, medium, triangles, on_interface=bool(across.all()))
    counted = normals if across.all() else normals[~across]
    sizes = np.linalg.norm(counted, axis=1)
    face.area = float(sizes.sum())
    mean = counted.sum(axis=0)
    length = float(np.linalg.norm(mean))
    if length > 1e-9 * face.area and face.area > 0:
        unit = mean / length
        face.normal = (float(unit[0]), float(unit[1]), float(unit[2]))
        face.flat = bool(np.all(counted @ unit >= FLAT * sizes))
    if across.all():
        return face, None
    spans = np.ptp(mesh.points[triangles[~across]], axis=1).max(axis=0)
    size = float(np.ptp(mesh.points, axis=0).max())
    face.axis = next((axis for axis, span in zip("xyz", spans) if span <= IN_PLANE * size), "")
    starts = np.cumsum([0] + [len(block.nodes) for block in group.parts])
    parts = [Block(b.kind, b.nodes[~across[i:j]]) for b, i, j in zip(group.parts, starts[:-1], starts[1:])]
    return face, Group(group.name, group.dimension, [block for block in parts if len(block.nodes)])


def _owners(tetrahedra: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The corner of a cell that lies behind each triangle, and of how many cells it is a side. The k-th side of a
    tetrahedron has not its k-th corner."""
    sides = np.concatenate([tetrahedra[:, list(side)] for side in SIDES["tetra"][1]])
    behind = np.concatenate([tetrahedra[:, k] for k in range(4)])
    keys = corner_keys("triangle", np.concatenate([sides, triangles]))
    cells, wanted = keys[: len(sides)], keys[len(sides) :]
    order = np.argsort(cells, kind="stable")
    first = np.searchsorted(cells[order], wanted, side="left")
    last = np.searchsorted(cells[order], wanted, side="right")
    return behind[order[np.minimum(first, len(order) - 1)]], last - first


def _area_vectors(points: np.ndarray, triangles: np.ndarray, opposite: np.ndarray) -> np.ndarray:
    """Away from the corner behind, as long as the triangle is large."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    vectors = 0.5 * np.cross(b - a, c - a)
    inward = np.einsum("ij,ij->i", vectors, points[opposite] - a) > 0
    vectors[inward] *= -1
    return np.asarray(vectors)
