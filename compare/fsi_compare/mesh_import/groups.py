"""Which elements of a mesh bear which name: of cells, and of facets of their boundary, by the parts of a file."""

from dataclasses import dataclass
from typing import Sequence

import numpy as np

from ..base.errors import InputError
from ..base.suggestions import nearest
from .parts import FoundMesh, dimensions_of, known_parts
from .raw_mesh import CORNERS, SIDES, Block


@dataclass
class Group:
    name: str
    dimension: int
    parts: list[Block]


def choose_groups(file: str, mesh: FoundMesh, wanted: Sequence[tuple[str, str]]) -> list[Group]:
    """Groups by the names that are wanted, (name, what the file calls it); all parts with a name of their own when none
    is. Raises InputError."""
    if not wanted:
        wanted = [(name, name) for name in named_parts(mesh)]
        if not wanted:
            problem = "is not given, and the file names no parts"
            raise InputError(file, "--group", problem, f"give NAME=PART; {known_parts(mesh)}")
    groups: list[Group] = []
    taken: dict[str, tuple[str, list[np.ndarray]]] = {}  # group -> its last part, whether it has an element, by block
    for name, part in wanted:
        if part in mesh.cells:
            groups += _of_cells(file, mesh, name, part, taken)
        elif part in mesh.points_of:
            blocks = facets_between(mesh, mesh.points_of[part])
            if not blocks:
                problem = f"no side of the mesh has all its points in {part}"
                raise InputError(file, f"--group {name}", problem, known_parts(mesh))
            groups.append(Group(name, mesh.dimension - 1, blocks))
        else:
            remedy = f"did you mean {nearest(part, [*mesh.cells, *mesh.points_of])}? {known_parts(mesh)}"
            raise InputError(file, f"--group {name}", f"the file has no part {part}", remedy)
    if not any(group.dimension == mesh.dimension for group in groups):
        what = "volume" if mesh.dimension == 3 else "surface"
        raise InputError(file, "--group", f"names no {what}", f"give fluid=PART; {known_parts(mesh)}")
    return groups


def named_parts(mesh: FoundMesh) -> list[str]:
    """Parts of cells or facets with a name of their own."""
    return [name for name in mesh.cells if name not in mesh.numbered and _dimensions(mesh, name)]


def left_out(mesh: FoundMesh) -> list[str]:
    """Named parts that become groups where --group asks for them, or never: for the log."""
    sets = [name for name in mesh.cells if name not in mesh.numbered and not _dimensions(mesh, name)]
    points = [name for name in mesh.points_of if name not in mesh.numbered]
    return [f"{name} (no cells or sides)" for name in sets] + [f"{name} (points)" for name in points]


def _dimensions(mesh: FoundMesh, part: str) -> list[int]:
    """Dimensions of the part's cells and facets."""
    return [d for d in dimensions_of(mesh, mesh.cells[part]) if d >= mesh.dimension - 1]


def _of_cells(
    file: str, mesh: FoundMesh, name: str, part: str, taken: dict[str, tuple[str, list[np.ndarray]]]
) -> list[Group]:
    """Groups of the part's elements that the name does not have yet. A cell is of one medium: sets of a file may
    overlap, groups of volumes may not."""
    places = mesh.cells[part]
    if not _dimensions(mesh, part):
        what = "cells or sides" if any(len(p) for p in places) else "elements"
        raise InputError(file, f"--group {name}", f"the part {part} has no {what}", known_parts(mesh))
    for other, (others_part, has) in taken.items():
        cells = [h[p] for block, p, h in zip(mesh.blocks, places, has) if block.dimension == mesh.dimension]
        shared = sum(int(there.sum()) for there in cells)
        if other != name and shared:
            problem = f"{part} shares {shared} cells with {others_part}, which is {other}"
            remedy = "name parts by --group that have no cell in common, as the command of --list does"
            raise InputError(file, f"--group {name}", problem, remedy)
    has = taken[name][1] if name in taken else [np.zeros(len(block.nodes), dtype=bool) for block in mesh.blocks]
    fresh = [p[~h[p]] for p, h in zip(places, has)]
    for p, h in zip(fresh, has):
        h[p] = True
    taken[name] = (part, has)
    groups = []
    for dimension in _dimensions(mesh, part):
        pairs = [(block, p) for block, p in zip(mesh.blocks, fresh) if block.dimension == dimension and len(p)]
        blocks = [Block(block.kind, block.nodes[p]) for block, p in pairs]
        if blocks:
            groups.append(Group(name, dimension, blocks))
    return groups


def sides_of(blocks: Sequence[Block], dimension: int) -> list[Block]:
    """All sides of the cells of this dimension, one block for each kind of side."""
    found: dict[str, list[np.ndarray]] = {}
    for block in blocks:
        if block.dimension == dimension:
            kind, sides = SIDES[block.kind]
            found.setdefault(kind, []).extend(block.nodes[:, list(side)] for side in sides)
    return [Block(kind, np.concatenate(nodes)) for kind, nodes in found.items()]


def corner_keys(kind: str, nodes: np.ndarray) -> np.ndarray:
    """A number for each element: equal for elements of one call with the same corners, whatever their order."""
    corners = np.sort(nodes[:, : CORNERS[kind]], axis=1).astype(np.int64)
    size = int(corners.max(initial=0)) + 1
    keys = corners[:, 0]
    for column in corners.T[1:]:
        if int(keys.max(initial=0)) >= 2**62 // size:  # the next product would not fit: by their ranks
            keys = np.unique(keys, return_inverse=True)[1].ravel()
        keys = keys * size + column
    return keys


def boundary_of(blocks: Sequence[Block], dimension: int) -> list[Block]:
    """Sides of one cell only."""
    found = []
    for block in sides_of(blocks, dimension):
        _, first, uses = np.unique(corner_keys(block.kind, block.nodes), return_index=True, return_counts=True)
        found.append(Block(block.kind, block.nodes[np.sort(first[uses == 1])]))
    return found


def facets_between(mesh: FoundMesh, points: np.ndarray) -> list[Block]:
    """Sides of cells on the mesh's boundary with all nodes among these points; with all corners where the set holds
    corners only, as sets of quadratic cells in Abaqus decks may."""
    mask = np.zeros(len(mesh.points), dtype=bool)
    mask[points] = True
    blocks = []
    for block in boundary_of(mesh.blocks, mesh.dimension):
        corners = CORNERS[block.kind]
        count = block.nodes.shape[1] if mask[block.nodes[:, corners:]].any() else corners
        inside = block.nodes[mask[block.nodes[:, :count]].all(axis=1)]
        if len(inside):
            blocks.append(Block(block.kind, inside))
    return blocks


def as_sides(mesh: FoundMesh, groups: Sequence[Group]) -> list[tuple[Group, np.ndarray]]:
    """Gives facets the nodes of the cells' sides that have their corners: facets of first order fit cells of second.
    Returns the groups with facets that are sides of no cell of the groups, and the corners of these."""
    cells = [block for group in groups if group.dimension == mesh.dimension for block in group.parts]
    facets = [(group, block) for group in groups if group.dimension < mesh.dimension for block in group.parts]
    found = [np.zeros(len(block.nodes), dtype=bool) for _, block in facets]
    for side in sides_of(cells, mesh.dimension):
        corners = CORNERS[side.kind]
        lists = [side.nodes[:, :corners], *(block.nodes[:, :corners] for _, block in facets)]
        keys = np.split(corner_keys(side.kind, np.concatenate(lists)), np.cumsum([len(rows) for rows in lists])[:-1])
        order = np.argsort(keys[0], kind="stable")
        for (_, block), there, wanted in zip(facets, found, keys[1:]):
            at = order[np.minimum(np.searchsorted(keys[0][order], wanted), len(order) - 1)]
            sides = keys[0][at] == wanted
            there |= sides
            if sides.all():
                block.kind, block.nodes = side.kind, side.nodes[at]
    missing = [(group, block, ~there) for (group, block), there in zip(facets, found) if not there.all()]
    return [(group, block.nodes[loose][:, : CORNERS[block.kind]]) for group, block, loose in missing]
