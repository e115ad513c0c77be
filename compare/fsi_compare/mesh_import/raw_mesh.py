"""What a file of a mesh holds, before any of it is called a part."""

from dataclasses import dataclass, field
from typing import Any, Sequence

import numpy as np

# Simplices by meshio's names: dimension, order, gmsh's number, gmsh's order of the nodes.
KINDS: dict[str, tuple[int, int, int, tuple[int, ...]]] = {
    "line": (1, 1, 1, (0, 1)),
    "line3": (1, 2, 8, (0, 1, 2)),
    "triangle": (2, 1, 2, (0, 1, 2)),
    "triangle6": (2, 2, 9, (0, 1, 2, 3, 4, 5)),
    "tetra": (3, 1, 4, (0, 1, 2, 3)),
    "tetra10": (3, 2, 11, (0, 1, 2, 3, 4, 5, 6, 7, 9, 8)),
}
# Vertices of a cell's sides, and the nodes in the middles of their edges behind them, in meshio's (VTK's) numbers.
SIDES: dict[str, tuple[str, tuple[tuple[int, ...], ...]]] = {
    "triangle": ("line", ((0, 1), (1, 2), (2, 0))),
    "triangle6": ("line3", ((0, 1, 3), (1, 2, 4), (2, 0, 5))),
    "tetra": ("triangle", ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))),
    "tetra10": ("triangle6", ((1, 2, 3, 5, 9, 8), (0, 3, 2, 7, 9, 6), (0, 1, 3, 4, 8, 7), (0, 2, 1, 6, 5, 4))),
}
# Nodes of a tetrahedron that goes the other way round.
TURNED = {"tetra": (0, 2, 1, 3), "tetra10": (0, 2, 1, 3, 6, 5, 4, 7, 9, 8)}
CORNERS = {kind: dimension + 1 for kind, (dimension, _, _, _) in KINDS.items()}
# Nodes of elements by meshio's names: what readers know, too, to say that it is no simplex.
NODES = {kind: len(order) for kind, (_, _, _, order) in KINDS.items()}
NODES |= {"vertex": 1, "quad": 4, "quad8": 8, "quad9": 9, "hexahedron": 8, "hexahedron20": 20, "hexahedron27": 27}
NODES |= {"wedge": 6, "wedge15": 15, "pyramid": 5, "pyramid13": 13}
ELEMENTS = {1: "lines", 2: "triangles", 3: "tetrahedra"}  # by dimension, for messages


@dataclass
class Block:
    """Elements of one kind."""

    kind: str
    nodes: np.ndarray  # (elements, nodes of each), from 0

    @property
    def dimension(self) -> int:
        return KINDS[self.kind][0]


Blocks = list[tuple[str, np.ndarray]]  # meshio's name of the kind, any kind; nodes of each element


@dataclass
class RawMesh:
    """Arrays have an entry an element, NaN where an element has none; sets hold places, from 0."""

    points: np.ndarray  # (points, 2 or 3), the file's unit
    blocks: Blocks
    cell_data: dict[str, list[np.ndarray]] = field(default_factory=dict)  # an array a block
    point_data: dict[str, np.ndarray] = field(default_factory=dict)
    cell_sets: dict[str, list[np.ndarray]] = field(default_factory=dict)  # places in each block
    point_sets: dict[str, np.ndarray] = field(default_factory=dict)
    unnamed: set[str] = field(default_factory=set)  # of the sets of cells: those that have a number only
    passed_over: list[str] = field(default_factory=list)  # what the reader left out, for messages


def sides_in_order(order: Sequence[int]) -> dict[str, tuple[str, tuple[tuple[int, ...], ...]]]:
    """SIDES as another format numbers those of tetrahedra, by our numbers; those of triangles are numbered alike."""
    return {
        kind: (facet, tuple(sides[i] for i in order) if kind.startswith("tetra") else sides)
        for kind, (facet, sides) in SIDES.items()
    }


def nothing() -> np.ndarray:
    """No places."""
    return np.zeros(0, dtype=np.int64)


def of_meshio(mesh: Any) -> RawMesh:
    """A mesh as meshio has read it, without the names that some of its formats keep elsewhere."""
    blocks = [(block.type, np.asarray(block.data)) for block in mesh.cells]
    sets = {
        name: [nothing() if entry is None else np.asarray(entry, dtype=np.int64) for entry in entries]
        for name, entries in mesh.cell_sets.items()
        if name != "gmsh:bounding_entities"  # of meshio 5.0.0: tags of gmsh's entities, no places of elements
    }
    cell_data = {name: [np.asarray(values) for values in data] for name, data in mesh.cell_data.items()}
    point_data = {name: np.asarray(values) for name, values in mesh.point_data.items()}
    point_sets = {name: np.asarray(entries, dtype=np.int64) for name, entries in mesh.point_sets.items()}
    found = RawMesh(np.asarray(mesh.points, dtype=float), blocks, cell_data, point_data, sets, point_sets)
    _name_physical_groups(found, getattr(mesh, "field_data", None) or {})
    return found


def _name_physical_groups(mesh: RawMesh, field_data: dict[str, Any]) -> None:
    """$PhysicalNames of a gmsh file: name -> number and dimension. Of format 4 meshio makes sets of cells of them, without the
    entities that a group names by a minus; of format 2.2 the numbers alone stand with the cells."""
    signed = mesh.cell_data.get("gmsh:physical")
    for name, data in field_data.items():
        pair = np.asarray(data).ravel()
        if signed is None or len(pair) != 2 or not np.all(pair == np.round(pair)):
            continue
        number, dimension = int(pair[0]), int(pair[1])
        known = mesh.cell_sets.get(str(name))
        places = []
        for i, (values, (kind, _)) in enumerate(zip(signed, mesh.blocks)):
            fitting = (values == -number) | ((values == number) if known is None else False)
            own = np.flatnonzero(fitting & (kind in KINDS and KINDS[kind][0] == dimension))
            places.append(own if known is None else np.union1d(known[i], own))
        if any(len(p) for p in places):
            mesh.cell_sets[str(name)] = places
    if signed is not None:
        mesh.cell_data["gmsh:physical"] = [np.abs(values) for values in signed]
