"""Reads meshes of VTK's XML format (.vtu). meshio 5.3.5 under Python 3.13 refuses most that have
appended arrays in base64, which is how VTK writes them; meshio 5.0.0 gives Lagrange cells kinds of their own."""

from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import InputError
from .raw_mesh import NODES, RawMesh
from .vtk_xml import VtkFile, pieces, read_by, require_points, scalars_of

# VTK's numbers of cells: meshio's name.
CELLS = {1: "vertex", 3: "line", 5: "triangle", 9: "quad", 10: "tetra", 12: "hexahedron", 13: "wedge", 14: "pyramid"}
CELLS |= {21: "line3", 22: "triangle6", 23: "quad8", 24: "tetra10", 25: "hexahedron20", 26: "wedge15"}
CELLS |= {27: "pyramid13", 28: "quad9", 29: "hexahedron27"}
# Lagrange cells of VTK by their number and how many nodes, where they are cells of the table above.
LAGRANGE = {(68, 2): 3, (68, 3): 21, (69, 3): 5, (69, 6): 22, (71, 4): 10, (71, 10): 24}


def read_vtu(path: Path) -> RawMesh:
    """The cells of all pieces, those of a kind in one block, with the fields of cells and points that have one number
    each. Raises InputError."""
    return read_by(_read, path, "UnstructuredGrid", "mesh")


def _read(file: VtkFile) -> RawMesh:
    points: list[np.ndarray] = []
    point_data: dict[str, list[np.ndarray]] = {}
    blocks: dict[int, list[np.ndarray]] = {}  # by kind, of each piece that has such cells
    cell_data: dict[str, dict[int, list[np.ndarray]]] = {}
    passed_over: dict[str, None] = {}
    first = 0
    for piece, there in pieces(file):
        points.append(there)
        for name, values in scalars_of(file, piece, "PointData", len(there), passed_over).items():
            point_data.setdefault(name, []).append(values)
        cells = _cells(file, piece)
        fields = scalars_of(file, piece, "CellData", sum(len(which) for _, which, _ in cells), passed_over)
        for kind, which, nodes in cells:
            require_points(file, nodes, len(there))
            blocks.setdefault(kind, []).append(nodes + first)
            for name, values in fields.items():
                cell_data.setdefault(name, {}).setdefault(kind, []).append(values[which])
        first += len(there)
    # A field that some piece does not have is none of the mesh.
    whole = {
        name: [np.concatenate(of_kinds.get(kind, [])) for kind in blocks]
        for name, of_kinds in cell_data.items()
        if all(len(of_kinds.get(kind, [])) == len(parts) for kind, parts in blocks.items())
    }
    return RawMesh(
        np.concatenate(points) if points else np.zeros((0, 3)),
        [(CELLS[kind], np.concatenate(parts)) for kind, parts in blocks.items()],
        whole,
        {name: np.concatenate(parts) for name, parts in point_data.items() if len(parts) == len(points)},
        passed_over=list(passed_over),
    )


def _cells(file: VtkFile, piece: Any) -> list[tuple[int, np.ndarray, np.ndarray]]:
    """Kind, places in the piece and nodes of its cells, kind by kind."""
    arrays = {element.get("Name"): file.array(element) for element in piece.findall("Cells/DataArray")}
    if not {"connectivity", "offsets", "types"} <= set(arrays):
        raise InputError(file.path, "Cells", "has no connectivity, offsets and types", "write the mesh anew as .vtu")
    corners = arrays["connectivity"].astype(np.int64)
    ends, kinds = arrays["offsets"].astype(np.int64), arrays["types"].astype(np.int64)
    lengths = np.diff(ends, prepend=0)
    if len(ends) != len(kinds) or np.any(lengths < 0) or (len(ends) and ends[-1] > len(corners)):
        raise InputError(file.path, "offsets", "do not fit the cells", "write the mesh anew as .vtu")
    for (lagrange, count), kind in LAGRANGE.items():
        kinds[(kinds == lagrange) & (lengths == count)] = kind
    found = []
    for kind in np.unique(kinds):
        if int(kind) not in CELLS:
            problem = f"has a cell of VTK's kind {kind}"
            raise InputError(file.path, "types", problem, "mesh it by tetrahedra, or by triangles")
        which = np.flatnonzero(kinds == kind)
        count = NODES[CELLS[int(kind)]]
        if np.any(lengths[which] != count):
            problem = f"a cell of VTK's kind {kind} has not {count} nodes"
            raise InputError(file.path, "offsets", problem, "write the mesh anew")
        found.append((int(kind), which, corners[(ends[which] - count)[:, None] + np.arange(count)]))
    return found
