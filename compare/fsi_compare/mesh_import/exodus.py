"""Reads meshes of Exodus II (.e, .exo, .ex2, .g), which are netCDF files.

meshio 5.0.0 leaves out names of blocks and all side sets, does not know `TRISHELL`, and takes `TETRA4` for a kind of
its own, `tetra4`, that nothing else of meshio knows. A block whose type is `TETRA` has cells of ten nodes where its
nodes are ten, as Cubit writes it; meshio goes by the name alone. Numbers of nodes and sides: L. A. Schoof, V. R.
Yarberry, EXODUS II: A Finite Element Data Model, SAND92-2137."""

import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import InputError
from .raw_mesh import RawMesh, nothing, sides_in_order

# By the letters with which a block's type begins, and how many nodes its elements have.
KINDS: dict[str, dict[int, str]] = dict.fromkeys(("TETRA", "TET"), {4: "tetra", 10: "tetra10"})
KINDS |= dict.fromkeys(("TRISHELL", "TRIANGLE", "TRI", "SHELL"), {3: "triangle", 6: "triangle6"})
KINDS |= dict.fromkeys(("TRUSS", "BEAM", "BAR"), {2: "line", 3: "line3"})
OTHERS = {"SHELL": "quad", "QUAD": "quad", "HEX": "hexahedron", "WEDGE": "wedge", "PYRAMID": "pyramid"}
OTHERS |= dict.fromkeys(("SPHERE", "CIRCLE", "NODE"), "vertex")
SHAPES = sorted({*KINDS, *OTHERS}, key=len, reverse=True)
# Nodes of sides 1, 2, ... Shells of triangles, which all triangles in space are to the Exodus library, whatever their
# type says, have two faces before them.
SIDES = sides_in_order((2, 0, 1, 3))
REMEDY = "write it anew as Exodus II"


def read_exodus(path: Path) -> RawMesh:
    """Blocks, side sets and node sets by name, or as `block:ID`, `sideset:ID`, `nodeset:ID`. Raises InputError."""
    try:
        with warnings.catch_warnings():
            # netCDF4 1.6.2 beside numpy 1.24 of Debian 12: "numpy.ndarray size changed", which changes nothing here.
            warnings.simplefilter("ignore")
            import netCDF4  # takes a while to load
    except ImportError:
        raise InputError("netCDF4", "", "is not there", "install the Debian package python3-netcdf4") from None
    try:
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            return _read(path, file)
    except (OSError, ValueError, KeyError, IndexError, TypeError, AttributeError, RuntimeError, OverflowError) as error:
        raise InputError(path, "", f"cannot be read as Exodus: {error}", REMEDY) from None


def _read(path: Path, file: Any) -> RawMesh:
    if "num_nodes" not in file.dimensions:
        raise InputError(path, "", "holds no mesh of Exodus", REMEDY)
    mesh = RawMesh(_points(file), [])
    space = mesh.points.shape[1]
    names = _names(file, "eb", "block", "num_el_blk")
    shells: list[bool] = []  # whether elements have two faces, by block
    starts = [0]  # elements are numbered through all blocks
    for number, name in enumerate(names, 1):
        connectivity = file.variables.get(f"connect{number}")
        if connectivity is None:  # a block without elements
            starts.append(starts[-1])
            mesh.blocks.append(("vertex", nothing().reshape(0, 1)))
            shells.append(False)
            continue
        nodes = np.asarray(connectivity[:], dtype=np.int64) - 1
        mesh.blocks.append((_kind(path, name, str(connectivity.elem_type), nodes.shape[1]), nodes))
        kind = mesh.blocks[-1][0]
        shells.append(kind.startswith("triangle") and (space == 3 or "SHELL" in str(connectivity.elem_type).upper()))
        starts.append(starts[-1] + len(nodes))
    count = len(names)
    for number, name in enumerate(names):
        _join(mesh, name, [np.arange(len(nodes) if i == number else 0) for i, (_, nodes) in enumerate(mesh.blocks)])
    for number, name in enumerate(_names(file, "ss", "sideset", "num_side_sets"), 1):
        if f"elem_ss{number}" not in file.variables:
            continue
        elements = np.asarray(file.variables[f"elem_ss{number}"][:], dtype=np.int64) - 1
        sides = np.asarray(file.variables[f"side_ss{number}"][:], dtype=np.int64)
        _add_sides(path, mesh, name, elements, sides, starts, shells)
    for number, name in enumerate(_names(file, "ns", "nodeset", "num_node_sets"), 1):
        if f"node_ns{number}" in file.variables:
            mesh.point_sets[name] = np.asarray(file.variables[f"node_ns{number}"][:], dtype=np.int64) - 1
    for entries in mesh.cell_sets.values():
        entries += [nothing()] * (len(mesh.blocks) - len(entries))
    mesh.unnamed = {name for name in mesh.cell_sets if name.startswith(("block:", "sideset:"))}
    for number, name in enumerate(_texts(file, "name_elem_var"), 1):
        _add_values(file, mesh, number, name, count)
    return mesh


def _points(file: Any) -> np.ndarray:
    if "coord" in file.variables:
        return np.asarray(file.variables["coord"][:], dtype=float).T
    axes = [file.variables[f"coord{axis}"][:] for axis in "xyz" if f"coord{axis}" in file.variables]
    return np.stack(axes, axis=1).astype(float)


def _texts(file: Any, variable: str) -> list[str]:
    if variable not in file.variables:
        return []
    rows = np.asarray(file.variables[variable][:])
    return [b"".join(row.tolist()).split(b"\0")[0].decode("utf-8", "replace").strip() for row in rows]


def _names(file: Any, short: str, word: str, dimension: str) -> list[str]:
    count = len(file.dimensions[dimension]) if dimension in file.dimensions else 0
    texts = _texts(file, f"{short}_names")
    numbered = f"{short}_prop1"
    numbers = file.variables[numbered][:].tolist() if numbered in file.variables else range(1, count + 1)
    return [(texts[i] if i < len(texts) else "") or f"{word}:{numbers[i]}" for i in range(count)]


def _kind(path: Path, block: str, said: str, count: int) -> str:
    shape = next((s for s in SHAPES if said.upper().startswith(s)), "")
    kind = KINDS.get(shape, {}).get(count) or OTHERS.get(shape)
    if kind is not None:
        return kind
    problem = f"has elements of the type {said} with {count} nodes"
    raise InputError(path, block, problem, "mesh it by tetrahedra of 4 or 10 nodes, or by triangles of 3 or 6")


def _join(mesh: RawMesh, name: str, places: list[np.ndarray]) -> None:
    """Blocks and sets of one name are one part."""
    known = mesh.cell_sets.get(name, [])
    known += [nothing()] * (len(places) - len(known))
    mesh.cell_sets[name] = [np.concatenate(pair) for pair in zip(known, places)]


def _add_sides(
    path: Path, mesh: RawMesh, name: str, elements: np.ndarray, sides: np.ndarray, starts: list[int], shells: list[bool]
) -> None:
    """A block of facets for each kind, and the set that holds them."""
    count = len(shells)
    if len(elements) != len(sides) or np.any((elements < 0) | (elements >= starts[count])):
        raise InputError(path, name, "names an element that is not there", REMEDY)
    for block in range(count):
        kind, nodes = mesh.blocks[block]
        here = (elements >= starts[block]) & (elements < starts[block + 1])
        if not here.any():
            continue
        for facet, rows in _facets(path, name, kind, shells[block], nodes[elements[here] - starts[block]], sides[here]):
            mesh.blocks.append((facet, rows))
            _join(mesh, name, [nothing()] * (len(mesh.blocks) - 1) + [np.arange(len(rows))])


def _facets(
    path: Path, name: str, kind: str, shell: bool, nodes: np.ndarray, sides: np.ndarray
) -> list[tuple[str, np.ndarray]]:
    """Sides of elements of one kind, `nodes` and `sides` one a row; of shells faces and edges apart."""
    if kind not in SIDES:
        raise InputError(path, name, f"holds sides of a {kind}", "mesh it by tetrahedra or triangles")
    facet, corners = SIDES[kind]
    faces = 2 if shell else 0
    if np.any((sides < 1) | (sides > faces + len(corners))):
        problem = f"names side {int(sides.max())} of a {kind}, which has {faces + len(corners)}"
        raise InputError(path, name, problem, REMEDY)
    edges = sides > faces
    found = [] if edges.all() else [(kind, nodes[~edges])]
    if edges.any():
        found.append((facet, np.take_along_axis(nodes[edges], np.array(corners)[sides[edges] - faces - 1], axis=1)))
    return found


def _add_values(file: Any, mesh: RawMesh, number: int, name: str, count: int) -> None:
    """A field of elements at its first time; NaN in blocks that have none."""
    values = [np.full(len(nodes), np.nan) for _, nodes in mesh.blocks]
    for variable in file.variables:
        match = re.fullmatch(rf"vals_elem_var{number}eb(\d+)", variable)
        if match and int(match.group(1)) <= count and len(file.variables[variable]):
            values[int(match.group(1)) - 1] = np.asarray(file.variables[variable][0], dtype=float)
    mesh.cell_data[name] = values
