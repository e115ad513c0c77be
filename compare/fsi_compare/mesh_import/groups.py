"""Which elements of a mesh bear which name.

A mesh that meshio has read may say it in several ways: sets of cells (Abaqus), families (MED), numbers of cells or points
(VTU), sets of points (Exodus). All become named groups: of cells, and of facets of their boundary.
"""

from dataclasses import dataclass, field
from typing import Any, Dict, List, Sequence, Tuple

import numpy as np

from ..base.errors import InputError
from ..base.suggestions import nearest

# Simplices by meshio's names: dimension, order, gmsh's number, gmsh's order of the nodes.
KINDS: Dict[str, Tuple[int, int, int, Tuple[int, ...]]] = {
    "line": (1, 1, 1, (0, 1)),
    "line3": (1, 2, 8, (0, 1, 2)),
    "triangle": (2, 1, 2, (0, 1, 2)),
    "triangle6": (2, 2, 9, (0, 1, 2, 3, 4, 5)),
    "tetra": (3, 1, 4, (0, 1, 2, 3)),
    "tetra10": (3, 2, 11, (0, 1, 2, 3, 4, 5, 6, 7, 9, 8)),
}


@dataclass
class Block:
    """Elements of one kind."""

    kind: str
    nodes: np.ndarray  # (elements, nodes of each), from 0

    @property
    def dimension(self) -> int:
        return KINDS[self.kind][0]


@dataclass
class FoundMesh:
    """A mesh and all that names parts of it: each a mask per block, or one of the points."""

    points: np.ndarray  # (points, 3), mm
    blocks: List[Block]
    cells: Dict[str, List[np.ndarray]] = field(default_factory=dict)  # name -> a mask per block
    points_of: Dict[str, np.ndarray] = field(default_factory=dict)  # name -> a mask of the points

    @property
    def dimension(self) -> int:
        return max(block.dimension for block in self.blocks)


def found_mesh(file: str, mesh: Any, scale: float) -> FoundMesh:
    """What meshio has read. Blocks that are no simplices are refused where they would be cells, else left out."""
    points = np.asarray(mesh.points, dtype=float) * scale
    points = np.hstack([points, np.zeros((len(points), 3 - points.shape[1]))])
    kept = [i for i, block in enumerate(mesh.cells) if block.type in KINDS and len(block.data)]
    others = sorted({block.type for i, block in enumerate(mesh.cells) if i not in kept and block.type != "vertex"})
    blocks = [Block(mesh.cells[i].type, np.asarray(mesh.cells[i].data, dtype=np.int64)) for i in kept]
    if not blocks or max(block.dimension for block in blocks) < 2 or any(_is_solid(name) for name in others):
        problem = f"holds {', '.join(others) or 'no elements'} in place of tetrahedra or triangles"
        raise InputError(file, "", problem, "mesh it by tetrahedra, or by triangles in two dimensions")
    found = FoundMesh(points, blocks)
    for name, entries in mesh.cell_sets.items():
        masks = []
        for i in kept:
            mask = np.zeros(len(mesh.cells[i].data), dtype=bool)
            if entries[i] is not None:
                mask[np.asarray(entries[i], dtype=np.int64)] = True
            masks.append(mask)
        found.cells[name] = masks
    families = getattr(mesh, "cell_tags", None) or {}  # of MED: number -> names
    for name, data in mesh.cell_data.items():
        values = [np.asarray(data[i]) for i in kept]
        if any(v.ndim != 1 or not np.all(v == np.round(v)) for v in values):
            continue  # no numbers of parts
        for value in np.unique(np.concatenate(values)):
            masks = [v == value for v in values]
            named = families.get(int(value)) if name == "cell_tags" else None
            for text in named or [f"{name}:{int(value)}"]:
                _join(found, text, masks)
    for text, (number, dimension) in _gmsh_names(mesh).items():
        if "gmsh:physical" in mesh.cell_data:
            numbers = [np.asarray(mesh.cell_data["gmsh:physical"][i]) for i in kept]
            masks = [(v == number) & (b.dimension == dimension) for v, b in zip(numbers, blocks)]
            if any(mask.any() for mask in masks) and text not in found.cells:
                found.cells[text] = masks
    for name, entries in mesh.point_sets.items():
        mask = np.zeros(len(points), dtype=bool)
        mask[np.asarray(entries, dtype=np.int64)] = True
        found.points_of[name] = mask
    for name, values in mesh.point_data.items():
        v = np.asarray(values)
        if v.ndim == 1 and np.all(v == np.round(v)) and len(np.unique(v)) <= 1000:
            for value in np.unique(v):
                found.points_of[f"{name}:{int(value)}"] = v == value
    return found


def _join(found: FoundMesh, name: str, masks: List[np.ndarray]) -> None:
    known = found.cells.get(name)
    found.cells[name] = masks if known is None else [a | b for a, b in zip(known, masks)]


def _gmsh_names(mesh: Any) -> Dict[str, Tuple[int, int]]:
    """$PhysicalNames of a gmsh file: name -> number and dimension. Of format 4 meshio makes sets of cells of them; of
    format 2.2 the numbers alone stand with the cells."""
    names = {}
    for name, data in (getattr(mesh, "field_data", None) or {}).items():
        pair = np.asarray(data).ravel()
        if len(pair) == 2 and np.all(pair == np.round(pair)):
            names[str(name)] = (int(pair[0]), int(pair[1]))
    return names


def _is_solid(name: str) -> bool:
    return name.startswith(("hexahedron", "wedge", "pyramid", "quad", "polyhedron", "polygon"))


def dimensions_of(mesh: FoundMesh, masks: Sequence[np.ndarray]) -> List[int]:
    return sorted({block.dimension for block, mask in zip(mesh.blocks, masks) if mask.any()})


@dataclass
class Group:
    name: str
    dimension: int
    parts: List[Block]


def choose_groups(file: str, mesh: FoundMesh, wanted: Sequence[Tuple[str, str]]) -> List[Group]:
    """Groups by the names that are wanted, (name, what the file calls it); all sets of cells with a name of their own
    when none is. Raises InputError."""
    if not wanted:
        wanted = [(name, name) for name in mesh.cells if ":" not in name]
        if not wanted:
            raise InputError(
                file, "--group", "is not given, and the file names no parts", f"give NAME=PART; {known_parts(mesh)}"
            )
    groups: List[Group] = []
    for name, part in wanted:
        if part in mesh.cells:
            masks = mesh.cells[part]
            for dimension in dimensions_of(mesh, masks):
                if dimension < mesh.dimension - 1:
                    continue
                blocks = [
                    Block(block.kind, block.nodes[mask])
                    for block, mask in zip(mesh.blocks, masks)
                    if block.dimension == dimension and mask.any()
                ]
                groups.append(Group(name, dimension, blocks))
        elif part in mesh.points_of:
            blocks = facets_between(mesh, mesh.points_of[part])
            if not blocks:
                raise InputError(
                    file, f"--group {name}", f"no side of the mesh has all its points in {part}", known_parts(mesh)
                )
            groups.append(Group(name, mesh.dimension - 1, blocks))
        else:
            names = [*mesh.cells, *mesh.points_of]
            problem = f"the file has no part {part}"
            close = f"did you mean {nearest(part, names)}? " if names else ""
            raise InputError(file, f"--group {name}", problem, close + known_parts(mesh))
    if not any(group.dimension == mesh.dimension for group in groups):
        what = "volume" if mesh.dimension == 3 else "surface"
        raise InputError(file, "--group", f"names no {what}", f"give fluid=PART; {known_parts(mesh)}")
    return groups


def known_parts(mesh: FoundMesh) -> str:
    """For messages."""
    parts = [f"{name} ({_what(mesh, dimensions_of(mesh, masks))})" for name, masks in mesh.cells.items()]
    parts += [f"{name} (points)" for name in mesh.points_of]
    shown = ", ".join(parts[:12]) + (", ..." if len(parts) > 12 else "")
    return f"its parts are {shown}" if parts else "it has no named or numbered parts"


def _what(mesh: FoundMesh, dimensions: Sequence[int]) -> str:
    words = {1: "lines", 2: "triangles", 3: "tetrahedra"}
    return " and ".join(words[d] for d in dimensions) or "empty"


# Vertices of a cell's sides, and the nodes in the middles of their edges behind them, in meshio's (VTK's) numbers.
SIDES: Dict[str, Tuple[str, Tuple[Tuple[int, ...], ...]]] = {
    "triangle": ("line", ((0, 1), (1, 2), (2, 0))),
    "triangle6": ("line3", ((0, 1, 3), (1, 2, 4), (2, 0, 5))),
    "tetra": ("triangle", ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))),
    "tetra10": ("triangle6", ((1, 2, 3, 5, 9, 8), (0, 3, 2, 7, 9, 6), (0, 1, 3, 4, 8, 7), (0, 2, 1, 6, 5, 4))),
}


def facets_between(mesh: FoundMesh, mask: np.ndarray) -> List[Block]:
    """Sides of cells on the mesh's boundary with all nodes in the mask."""
    blocks = []
    for block in mesh.blocks:
        if block.dimension != mesh.dimension:
            continue
        kind, sides = SIDES[block.kind]
        corners = mesh.dimension
        every = np.concatenate([block.nodes[:, list(side)] for side in sides])
        _, first, uses = np.unique(np.sort(every[:, :corners], axis=1), axis=0, return_index=True, return_counts=True)
        boundary = every[np.sort(first[uses == 1])]
        inside = boundary[mask[boundary].all(axis=1)]
        if len(inside):
            blocks.append(Block(kind, inside))
    return blocks
