"""What of a mesh may bear a name: its parts, made of the sets and of the numbers that a file has.

An array of whole numbers says parts where its values are few, and numbers the elements where they are many:
`ModelRegionID` of SimVascular is one, `GlobalElementID` the other. All steps are linear in elements, but for sorting.
"""

from dataclasses import dataclass, field
from typing import Iterable, Sequence

import numpy as np

from ..base.errors import InputError
from .raw_mesh import ELEMENTS, KINDS, Block, RawMesh, nothing

WHOLE = "all"  # the part that every mesh has
# Arrays that number elements or nodes, in lower case: of SimVascular, VTK and ParaView, Exodus.
IDENTITIES = {"globalelementid", "globalnodeid", "vtkoriginalcellids", "vtkoriginalpointids", "globalids"}
IDENTITIES |= {"globalcellids", "globalpointids", "pedigreeelementid", "pedigreenodeid", "objectid"}
# Arrays that say parts, however many values they have.
REGIONS = frozenset(("modelregionid", "modelfaceid", "gmsh:physical", "gmsh:geometrical", "medit:ref"))
MOST_VALUES = 1000  # of an array that says parts
Places = list[np.ndarray]  # in each block
SHOWN = 12  # names in one line
SOLIDS = ("hexahedron", "wedge", "pyramid", "quad", "polyhedron", "polygon")  # begin names of kinds


@dataclass
class FoundMesh:
    """A mesh and all that names parts of it."""

    points: np.ndarray  # (points, 3), mm
    blocks: list[Block]
    cells: dict[str, list[np.ndarray]] = field(default_factory=dict)  # name -> places in each block
    points_of: dict[str, np.ndarray] = field(default_factory=dict)  # name -> places of points
    numbered: frozenset = frozenset()  # names that are an array's and a number
    passed_over: list[str] = field(default_factory=list)  # arrays that say no parts, and why

    @property
    def dimension(self) -> int:
        return max(block.dimension for block in self.blocks)


def found_mesh(file: str, mesh: RawMesh, scale: float) -> FoundMesh:
    """Elements that are no simplices are refused where they would be cells, else left out. Raises InputError."""
    points = np.asarray(mesh.points, dtype=float) * scale
    points = np.hstack([points, np.zeros((len(points), 3 - points.shape[1]))])
    kept = [i for i, (kind, nodes) in enumerate(mesh.blocks) if kind in KINDS and len(nodes)]
    others = sorted({kind for i, (kind, _) in enumerate(mesh.blocks) if i not in kept and kind != "vertex"})
    blocks = [Block(mesh.blocks[i][0], np.asarray(mesh.blocks[i][1], dtype=np.int64)) for i in kept]
    if not blocks or max(block.dimension for block in blocks) < 2 or any(name.startswith(SOLIDS) for name in others):
        problem = f"holds {', '.join(others) or 'no elements'} in place of tetrahedra or triangles"
        raise InputError(file, "", problem, "mesh it by tetrahedra, or by triangles in two dimensions")
    for block in blocks:
        if np.any((block.nodes < 0) | (block.nodes >= len(points))):
            raise InputError(file, block.kind, "names a point that is not there", "write the mesh anew")
        if not np.isfinite(points[block.nodes.ravel()]).all():
            raise InputError(file, block.kind, "has a point whose coordinates are no numbers", "write the mesh anew")
    for name, at in mesh.point_sets.items():
        if np.any((at < 0) | (at >= len(points))):
            raise InputError(file, name, "names a point that is not there", "write the mesh anew")
    for name, entries in mesh.cell_sets.items():
        if any(np.any((e < 0) | (e >= len(n))) for e, (_, n) in zip(entries, mesh.blocks)):
            raise InputError(file, name, "names a cell that is not there", "write the mesh anew")
    cells = {name: [entries[i] for i in kept] for name, entries in mesh.cell_sets.items()}
    found = FoundMesh(points, blocks, cells, passed_over=list(mesh.passed_over))
    numbered = set(mesh.unnamed)
    for name, data in mesh.cell_data.items():
        values = _saying_parts(found, name, [data[i] for i in kept], "cell")
        for text, places in _by_value(name, values, blocks) if values else ():
            found.cells.setdefault(text, places)
            numbered.add(text)
    if WHOLE not in found.cells:
        found.cells[WHOLE] = whole_of(found)
        numbered.add(WHOLE)
    for name, at in mesh.point_sets.items():
        found.points_of[_of_points(found, name)] = at
    for name, at_points in mesh.point_data.items():
        values = _saying_parts(found, name, [at_points], "point")
        for value, places in _places_of_values(values) if values else ():
            part = _of_points(found, f"{name}:{value}")
            found.points_of[part] = places[0]
            numbered.add(part)
    found.numbered = frozenset(numbered)
    return found


def whole_of(mesh: FoundMesh) -> list[np.ndarray]:
    """Places of all its cells, in each block."""
    return [np.arange(len(b.nodes) if b.dimension == mesh.dimension else 0) for b in mesh.blocks]


def _of_points(found: FoundMesh, name: str) -> str:
    """Name for a set of points whose name cells or sides have, too: decks name both alike."""
    return f"{name}:points" if name in found.cells else name


def _numbers(arrays: Sequence[np.ndarray]) -> list[np.ndarray] | None:
    """One whole number, or NaN, an entry; None where they are anything else."""
    found = []
    for array in arrays:
        values = np.asarray(array)
        if values.ndim == 2 and values.shape[1] == 1:
            values = values[:, 0]
        if values.ndim != 1 or values.dtype.kind not in "iufb":
            return None
        if values.dtype.kind == "f":
            there = values[~np.isnan(values)]
            # Beyond 2^53 not every whole number is one of double precision.
            if not np.all((there == np.round(there)) & (np.abs(there) <= 2.0**53)):
                return None
        found.append(values)
    return found


def _saying_parts(found: FoundMesh, name: str, arrays: Sequence[np.ndarray], what: str) -> list[np.ndarray] | None:
    """Numbers of an array that says parts; of another one None, and `found` gets a word on it."""
    values = _numbers(arrays)
    reason = _no_parts(name, values, what)
    if reason:
        found.passed_over.append(f"{name} ({reason})")
    return None if reason else values


def _no_parts(name: str, values: list[np.ndarray] | None, what: str) -> str:
    """Why an array says no parts; empty where it does."""
    if values is None:
        return "no whole numbers"
    count = sum(len(v) for v in values)
    different = len(np.unique(np.concatenate(values))) if values else 0
    if name.lower() in IDENTITIES:
        return f"numbers of {what}s"
    if name.lower() in REGIONS and what == "cell":
        return ""
    if different > MOST_VALUES or (different > 8 and 2 * different > count):
        return f"{different} values at {count} {what}s"
    return ""


def _places_of_values(values: Sequence[np.ndarray]) -> Iterable[tuple[int, list[np.ndarray]]]:
    """Each value with its places in each of the arrays, in ascending order; NaN is none."""
    every = np.concatenate(values)
    starts = np.cumsum([0] + [len(v) for v in values])
    there = np.flatnonzero(~np.isnan(every)) if every.dtype.kind == "f" else np.arange(len(every))
    order = there[np.argsort(every[there], kind="stable")]
    kinds, first = np.unique(every[order], return_index=True)
    for value, places in zip(kinds, np.split(order, first[1:])):
        bounds = np.searchsorted(places, starts)
        yield int(value), [places[a:b] - start for a, b, start in zip(bounds[:-1], bounds[1:], starts)]


def _by_value(name: str, values: Sequence[np.ndarray], blocks: Sequence[Block]) -> Iterable[tuple[str, Places]]:
    """Parts of an array. A number that elements of several dimensions have is a part for each: gmsh and dolfinx count
    volumes and surfaces apart, so that the same number means nothing."""
    for value, places in _places_of_values(values):
        dimensions = sorted({b.dimension for b, p in zip(blocks, places) if len(p)}, reverse=True)
        for dimension in dimensions:
            text = f"{name}:{value}" + (f":{ELEMENTS[dimension]}" if dimension < dimensions[0] else "")
            yield text, [p if b.dimension == dimension else nothing() for b, p in zip(blocks, places)]


def dimensions_of(mesh: FoundMesh, places: Sequence[np.ndarray]) -> list[int]:
    return sorted({block.dimension for block, p in zip(mesh.blocks, places) if len(p)})


def is_surface(mesh: FoundMesh, part: str) -> bool:
    """Whether it has facets alone."""
    return dimensions_of(mesh, mesh.cells[part]) == [mesh.dimension - 1]


def shown_names(names: Sequence[str]) -> str:
    """The first names, in one line."""
    return ", ".join(names[:SHOWN]) + (f", and {len(names) - SHOWN} more" if len(names) > SHOWN else "")


def known_parts(mesh: FoundMesh) -> str:
    """The mesh's parts, for messages."""
    kinds = {name: " and ".join(ELEMENTS[d] for d in dimensions_of(mesh, of)) for name, of in mesh.cells.items()}
    words = {name: kind or "empty" for name, kind in kinds.items()} | dict.fromkeys(mesh.points_of, "points")
    return f"its parts are {shown_names([f'{name} ({word})' for name, word in words.items()])}"
