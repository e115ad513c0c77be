"""Reads meshes that old dolfin wrote as XML, with what dolfin-convert of gmsh files writes beside NAME.xml:
NAME_physical_region.xml and NAME_facet_region.xml.

meshio 5.0.0 reads every NAME_*.xml as a function of the cells of another form than dolfin writes, and ends with
'size'."""

import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import InputError
from ..base.files import exists, read_bytes
from .raw_mesh import RawMesh

KINDS = {"tetrahedron": "tetra", "triangle": "triangle"}  # dolfin's name of a cell: meshio's
FACETS = {"tetra": "triangle", "triangle": "line"}
COMPANIONS = ("physical_region", "facet_region")
DAMAGES = (KeyError, ValueError, TypeError, OverflowError)
REMEDY = "write it anew as XML, or as HDF5 by dolfin's HDF5File"


def read_dolfin_xml(path: Path) -> RawMesh:
    """Values of cells and facets as parts FUNCTION:VALUE; those of facets that are 0 say nothing. Raises InputError."""
    root = _root(path)
    mesh = root.find("mesh")
    if mesh is None:
        problem = "is no mesh of dolfin" + (", but a function of one" if _functions(root) else "")
        raise InputError(path, "", problem, f"give the mesh, NAME.xml, with NAME_{COMPANIONS[0]}.xml beside it")
    try:
        points, kind, cells = _points_and_cells(mesh)
        blocks: list[tuple[str, np.ndarray]] = [(kind, cells)]
        found = RawMesh(points, blocks)
        for function in mesh.findall("domains/mesh_value_collection"):
            _add(path, found, f"domains_{function.get('dim')}", function)
    except DAMAGES as error:
        raise _damaged(path, error) from None
    for name in COMPANIONS:
        beside = path.with_name(f"{path.stem}_{name}.xml")
        for function in _functions(_root(beside)) if exists(beside) else ():
            try:
                _add(beside, found, name, function)
            except DAMAGES as error:
                raise _damaged(beside, error) from None
    for name, parts in found.cell_data.items():
        parts += [np.full(len(nodes), np.nan) for _, nodes in found.blocks[len(parts) :]]
    return found


def _damaged(path: Path, error: Exception) -> InputError:
    return InputError(path, "", f"cannot be read as dolfin's XML: {error}", REMEDY)


def _root(path: Path) -> Any:
    try:
        root = ElementTree.fromstring(read_bytes(path, "give a mesh", REMEDY))
    except ElementTree.ParseError as error:
        raise InputError(path, "", f"is no XML: {error}", REMEDY) from None
    if root.tag != "dolfin":
        raise InputError(path, root.tag, "is no mesh of dolfin, and no other mesh in XML is known", "write it as .vtu")
    return root


def _functions(root: Any) -> list[Any]:
    """Collections of values stand within a function, or alone."""
    return root.findall(".//mesh_value_collection") or root.findall("mesh_function")


def _points_and_cells(mesh: Any) -> tuple[np.ndarray, str, np.ndarray]:
    cell = mesh.get("celltype")
    if cell not in KINDS:
        raise ValueError(f"has cells of the type {cell}, no tetrahedra or triangles")
    points = _rows([[float(v.get(axis, 0)) for axis in "xyz"] for v in mesh.iter("vertex")], mesh.iter("vertex"), 3)
    count = 4 if cell == "tetrahedron" else 3
    rows = [[int(c.get(f"v{k}")) for k in range(count)] for c in mesh.iter(cell)]
    return points, KINDS[cell], _rows(rows, mesh.iter(cell), count).astype(np.int64)


def _rows(rows: list[list[Any]], elements: Any, width: int) -> np.ndarray:
    """Rows sorted by the index that each element states."""
    places = np.array([int(element.get("index")) for element in elements], dtype=np.int64)
    if not np.array_equal(np.sort(places), np.arange(len(rows))):
        raise ValueError("the indices of vertices or cells are not 0, 1, 2 and so on")
    ordered = np.zeros((len(rows), width))
    ordered[places] = np.array(rows).reshape(len(rows), width)
    return ordered


def _add(path: Path, mesh: RawMesh, name: str, function: Any) -> None:
    """The values of one function, of cells or of facets."""
    kind, cells = mesh.blocks[0]
    top = cells.shape[1] - 1
    dimension = int(function.get("dim"))
    entries: dict[str, str] = {"mesh_function": "entity", "mesh_value_collection": "value"}
    rows = list(function.iter(entries[function.tag]))
    values = np.array([float(row.get("value")) for row in rows])
    if dimension == top:
        of_cell = "index" if function.tag == "mesh_function" else "cell_index"
        numbers = np.full(len(cells), np.nan)
        numbers[_places(path, name, [row.get(of_cell) for row in rows], len(cells))] = values
        mesh.cell_data[name] = [numbers]
    elif dimension == top - 1 and function.tag == "mesh_value_collection":
        told = values != 0
        rows, values = [row for row, kept in zip(rows, told) if kept], values[told]
        which = _places(path, name, [row.get("cell_index") for row in rows], len(cells))
        opposite = _places(path, name, [row.get("local_entity") for row in rows], top + 1)
        # A facet is numbered by the opposite vertex, among the cell's in ascending order.
        corners = np.sort(cells[which], axis=1)
        kept = np.arange(top + 1)[None, :] != opposite[:, None]
        mesh.cell_data[name] = [np.full(len(nodes), np.nan) for _, nodes in mesh.blocks] + [values]
        mesh.blocks.append((FACETS[kind], corners[kept].reshape(len(rows), top)))
    else:
        what = "facets by dolfin's own numbers, which the file does not tell" if dimension == top - 1 else "no facets"
        mesh.passed_over.append(f"{path.name} (values of {what})")


def _places(path: Path, name: str, texts: list[Any], count: int) -> np.ndarray:
    places = np.array([int(text) for text in texts], dtype=np.int64)
    if np.any((places < 0) | (places >= count)):
        raise InputError(path, name, "names a cell or side that is not there", "give the function of this very mesh")
    return places
