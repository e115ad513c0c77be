"""Meshes and surfaces of VTK's XML formats (.vtu, .vtp). meshio 5.3.5 under Python 3.13 refuses most that have appended
arrays in base64, which is how VTK writes them; meshio 5.0.0 gives Lagrange cells kinds of their own."""

from pathlib import Path

import numpy as np

from ..base.errors import InputError
from .raw_mesh import NODES, Blocks, RawMesh
from .vtk_file import POLYGON, VtkFile, read_vtk

# VTK's numbers of cells: meshio's name.
CELLS = {1: "vertex", 3: "line", 5: "triangle", 9: "quad", 10: "tetra", 12: "hexahedron", 13: "wedge", 14: "pyramid"}
CELLS |= {21: "line3", 22: "triangle6", 23: "quad8", 24: "tetra10", 25: "hexahedron20", 26: "wedge15"}
CELLS |= {27: "pyramid13", 28: "quad9", 29: "hexahedron27"}
# Lagrange cells of VTK by their number and how many nodes, where they are cells of the table above.
LAGRANGE = {(68, 2): 3, (68, 3): 21, (69, 3): 5, (69, 6): 22, (71, 4): 10, (71, 10): 24}


def read_vtu(path: Path) -> RawMesh:
    """The cells of all pieces, those of a kind in one block. Raises InputError."""
    file = read_vtk(path)
    if file.is_surface:
        raise InputError(path, "", "holds no UnstructuredGrid of VTK", "write it as .vtu")
    return mesh_of(file)


def read_faces(path: Path) -> RawMesh:
    """The triangles of a surface. Raises InputError."""
    file = read_vtk(path)
    if not file.is_surface:
        raise InputError(path, "", "holds no PolyData of VTK", "write it as .vtp")
    if file.others:
        raise InputError(path, "", "holds vertices, lines or strips", "write its surface as triangles")
    if not len(file.kinds):
        raise InputError(path, "", "holds no polygons", "write the surface anew as .vtp")
    if np.any(np.diff(file.ends, prepend=0) != 3):
        raise InputError(path, "Polys", "holds polygons that are no triangles", "triangulate the surface")
    mesh = mesh_of(file)
    mesh.point_data = {}
    return mesh


def mesh_of(file: VtkFile) -> RawMesh:
    """Raises InputError for cells of a kind that is unknown, or of another number of nodes than theirs."""
    lengths = np.diff(file.ends, prepend=0)
    kinds = np.where(file.kinds == POLYGON, 5, file.kinds) if file.is_surface else file.kinds.copy()
    for (lagrange, count), kind in LAGRANGE.items():
        kinds[(kinds == lagrange) & (lengths == count)] = kind
    blocks: Blocks = []
    cell_data: dict[str, list[np.ndarray]] = {name: [] for name in file.cell_fields}
    for kind in np.unique(kinds):
        if int(kind) not in CELLS:
            problem = f"has a cell of VTK's kind {kind}"
            raise InputError(file.path, "types", problem, "mesh it by tetrahedra, or by triangles")
        which = np.flatnonzero(kinds == kind)
        count = NODES[CELLS[int(kind)]]
        if np.any(lengths[which] != count):
            problem = f"a cell of VTK's kind {kind} has not {count} nodes"
            raise InputError(file.path, "offsets", problem, "write the mesh anew")
        blocks.append((CELLS[int(kind)], file.corners[(file.ends[which] - count)[:, None] + np.arange(count)]))
        for name, values in file.cell_fields.items():
            cell_data[name].append(values[which])
    return RawMesh(file.points, blocks, cell_data, file.point_fields, passed_over=file.left_out)
