"""Reads meshes of MED (.med), which are HDF5 files.

meshio 5.0.0 demands a group `GRO` of every family; gmsh 4 writes it for physical groups only. It turns no tetrahedra,
which in MED go the other way round than in VTK, and ends at names of groups with letters beyond ASCII."""

from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import InputError
from .raw_mesh import NODES, TURNED, RawMesh, nothing

# Tetrahedra of MED turn the other way round than VTK's; middles of edges are in VTK's order.
KINDS = {"PO1": "vertex", "SE2": "line", "SE3": "line3", "TR3": "triangle", "TR6": "triangle6", "TE4": "tetra"}
KINDS |= {"T10": "tetra10", "QU4": "quad", "QU8": "quad8", "QU9": "quad9", "HE8": "hexahedron", "H20": "hexahedron20"}
KINDS |= {"H27": "hexahedron27", "PE6": "wedge", "P15": "wedge15", "PY5": "pyramid", "P13": "pyramid13"}
SOLID = {"TE4": TURNED["tetra"], "T10": TURNED["tetra10"]}  # to VTK's turn
REMEDY = "write it anew as MED, or as .vtu"


def read_med(path: Path) -> RawMesh:
    """Groups of elements and nodes by name; families of elements without a group as `family:NAME`. Raises
    InputError."""
    import h5py  # takes a while to load

    try:
        with h5py.File(path, "r") as file:
            return _read(path, file)
    except (OSError, ValueError, KeyError, IndexError, TypeError, AttributeError, RuntimeError) as error:
        raise InputError(path, "", f"cannot be read as MED: {error}", REMEDY) from None


def _read(path: Path, file: Any) -> RawMesh:
    meshes = list(file.get("ENS_MAA", ()))
    if len(meshes) != 1:
        problem = f"holds {len(meshes)} meshes{': ' if meshes else ''}{', '.join(meshes)}"
        raise InputError(path, "ENS_MAA", problem, "write one mesh into a file of its own")
    whole = file["ENS_MAA"][meshes[0]]
    steps = [] if "NOE" in whole else list(whole)
    if len(steps) > 1 or ("NOE" not in whole and not steps):
        raise InputError(path, meshes[0], f"has {len(steps)} states of the mesh in time", "write one of them")
    step = whole[steps[0]] if steps else whole
    coordinates = step["NOE"]["COO"]
    count = int(coordinates.attrs["NBR"])
    mesh = RawMesh(np.asarray(coordinates[()], dtype=float).reshape(-1, count).T, [])
    families = file["FAS"][meshes[0]] if meshes[0] in file.get("FAS", ()) else whole.get("FAS")
    numbers: list[np.ndarray | None] = []
    for name, group in step.get("MAI", {}).items():
        if name not in KINDS:
            raise InputError(path, name, "is a kind of element that is not known", "mesh it by tetrahedra or triangles")
        there = np.asarray(group["NOD"][()], dtype=np.int64).reshape(NODES[KINDS[name]], -1).T - 1
        if name in SOLID:
            there = there[:, list(SOLID[name])]
        mesh.blocks.append((KINDS[name], there))
        numbers.append(np.asarray(group["FAM"][()], dtype=np.int64) if "FAM" in group else None)
    for text, unnamed, wanted in _families(families, "ELEME"):
        places = [nothing() if n is None else np.flatnonzero(n == wanted) for n in numbers]
        if not any(len(p) for p in places):
            continue
        known = mesh.cell_sets.get(text)
        mesh.cell_sets[text] = places if known is None else [np.union1d(a, b) for a, b in zip(known, places)]
        if unnamed:
            mesh.unnamed.add(text)
    if "FAM" in step["NOE"]:
        of_points = np.asarray(step["NOE"]["FAM"][()], dtype=np.int64)
        sets: dict[str, np.ndarray] = {}
        for text, unnamed, wanted in _families(families, "NOEUD"):
            if not unnamed:
                sets[text] = np.union1d(sets.get(text, nothing()), np.flatnonzero(of_points == wanted))
        mesh.point_sets = {text: points for text, points in sets.items() if len(points)}
    mesh.passed_over += [f"{name} (a field)" for name in file.get("CHA", ())]
    return mesh


def _families(families: Any, place: str) -> list[tuple[str, bool, int]]:
    """Each group of each family: its name, or the family's where it has no group, which of the two, the family's
    number."""
    found = []
    for family, content in (families[place] if families is not None and place in families else {}).items():
        number = int(content.attrs["NUM"])
        if number == 0:
            continue  # what is in no family
        names = content["GRO"]["NOM"][()] if "GRO" in content else ()
        texts = [bytes(np.asarray(name, dtype=np.int8)).split(b"\0")[0] for name in names]
        named = [(text.decode("utf-8", "replace").strip(), False, number) for text in texts]
        found += named or [(f"family:{family}", True, number)]
    return found
