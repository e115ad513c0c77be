"""Reads meshes that dolfin wrote by its HDF5File, as turtleFSI and VaSP keep them: a group `mesh`, and functions of its
cells and facets beside it (`domains`, `boundaries`), each with points and elements of its own, in any order. meshio
takes .h5 for another format, and does not read these."""

from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ..base.errors import InputError
from .raw_mesh import RawMesh

KINDS = {2: "line", 3: "triangle", 4: "tetra"}  # by corners


def read_dolfin_hdf5(path: Path) -> RawMesh:
    """Values of facets that are 0 say nothing: dolfin writes a facet between any two cells. Raises InputError."""
    try:
        with h5py.File(path, "r") as file:
            return _read(path, file)
    except (OSError, KeyError, ValueError, TypeError, RuntimeError) as error:
        raise InputError(path, "", f"cannot be read: {' '.join(str(error).split())}", "write it anew as .vtu") from None


def _read(path: Path, file: Any) -> RawMesh:
    if not isinstance(file.get("mesh"), h5py.Group) or "topology" not in file["mesh"]:
        raise InputError(path, "mesh", "is no mesh of dolfin", "give a mesh that dolfin's HDF5File wrote, or a .vtu")
    points, cells = _mesh(path, "mesh", file["mesh"])
    blocks: list[tuple[str, np.ndarray]] = [(KINDS[cells.shape[1]], cells)]
    values: dict[str, list[np.ndarray]] = {}
    passed_over = []
    for name, group in file.items():
        if name == "mesh" or not isinstance(group, h5py.Group):
            continue
        if "values" not in group or "topology" not in group:
            passed_over.append(f"{name} (no function of cells or facets)")
            continue
        at, nodes = _mesh(path, name, group)
        if not np.array_equal(at, points):
            raise InputError(path, name, "has other points than the mesh", "write mesh and functions in one file")
        numbers = np.asarray(group["values"])
        if numbers.shape != (len(nodes),):
            raise InputError(path, name, f"has {numbers.shape} values of {len(nodes)} elements", "write the file anew")
        if nodes.shape[1] < cells.shape[1]:
            nodes, numbers = nodes[numbers != 0], numbers[numbers != 0]
        values[name] = [np.full(len(b), np.nan) for _, b in blocks] + [numbers.astype(float)]
        blocks.append((KINDS[nodes.shape[1]], nodes))
    # Functions of cells have cells of their own: the mesh's give way to those of the first such function.
    whole = [i for i, (_, nodes) in enumerate(blocks) if nodes.shape[1] == cells.shape[1]]
    if len(whole) > 2:
        names = [name for name, parts in values.items() if len(parts) - 1 in whole]
        raise InputError(path, ", ".join(names), "are two functions of the cells", "leave one in the file")
    kept = [i for i in range(len(blocks)) if i != 0 or len(whole) == 1]
    for parts in values.values():
        parts += [np.full(len(nodes), np.nan) for _, nodes in blocks[len(parts) :]]
    data = {name: [parts[i] for i in kept] for name, parts in values.items()}
    return RawMesh(points, [blocks[i] for i in kept], data, passed_over=passed_over)


def _mesh(path: Path, name: str, group: Any) -> tuple[np.ndarray, np.ndarray]:
    points, nodes = np.asarray(group["coordinates"], dtype=float), np.asarray(group["topology"])
    if points.ndim != 2 or nodes.ndim != 2 or nodes.shape[1] not in KINDS or nodes.dtype.kind not in "iu":
        raise InputError(path, name, "has no points and simplices", "write the file anew")
    return points, nodes.astype(np.int64)
