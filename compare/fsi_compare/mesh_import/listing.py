"""What `fsi-mesh import --list` says: the parts of a mesh, its size, what touches, and the command that takes it in."""

import shlex
from pathlib import Path
from typing import Sequence

import numpy as np

from ..base.errors import printable
from .groups import facets_between
from .parts import WHOLE, FoundMesh, dimensions_of, is_surface, shown_names
from .raw_mesh import CORNERS, ELEMENTS, Block
from .sources import Source
from .touching import contacts, doubled_words, gap_words, lonely, touch_words

UNITS = (("mm", 1.0), ("cm", 10.0), ("m", 1000.0))
# The longest extent of vessels, mm: one of 0.7 in the file's unit is hardly 0.7 mm, one of 70 hardly 700 mm.
LONGEST, SHORTEST = 700.0, 0.7
Volumes = dict[str, list[Block]]  # by name
FLAT = 1e-3  # area of a flat part over that of its facets, less than 1 by this
FLUID = ("fluid", "lumen", "blood")
SOLID = ("wall", "solid", "structure", "tissue", "vessel", "artery", "media", "adventitia")
MOST_VOLUMES = 4  # whose distances are looked for, each with each; of more what touches what
MOST_LINES = 200  # of parts


def listing(mesh: FoundMesh, words: Sequence[str], sources: Sequence[Source], scale: float, join: float) -> list[str]:
    """Lines. `words` are the files as the user gave them; the mesh is scaled already."""
    lines = _table(mesh, scale)
    volumes = separate_volumes(mesh)
    lines += _touching(mesh, volumes)
    factor = scale
    if scale == 1:
        factor, said = _unit(float(box_of(mesh, WHOLE).max()))
        lines.append(said)
    return lines + _command(mesh, volumes, words, sources, factor, join)


def _cells(mesh: FoundMesh, name: str) -> list[Block]:
    places = mesh.cells[name]
    top = max(dimensions_of(mesh, places), default=0)
    return [Block(b.kind, b.nodes[p]) for b, p in zip(mesh.blocks, places) if b.dimension == top and len(p)]


def _box(points: np.ndarray, blocks: Sequence[Block]) -> np.ndarray:
    used = np.zeros(len(points), dtype=bool)
    for block in blocks:
        used[block.nodes.ravel()] = True
    there = points[used]
    return there.max(axis=0) - there.min(axis=0) if len(there) else np.zeros(3)


def box_of(mesh: FoundMesh, name: str) -> np.ndarray:
    """Extents of a part along x, y and z."""
    return _box(mesh.points, _cells(mesh, name))


def _measure(points: np.ndarray, blocks: Sequence[Block]) -> tuple[float, bool]:
    """Volume, area or length of a part by its vertices, in the unit of the points, and whether it is flat."""
    measure, areas_of = 0.0, [np.zeros((0, 3))]
    for block in blocks:
        corners = points[block.nodes[:, : CORNERS[block.kind]]]
        edges = corners[:, 1:] - corners[:, :1]
        if block.dimension == 3:
            measure += float(np.abs(np.einsum("ij,ij->i", np.cross(edges[:, 0], edges[:, 1]), edges[:, 2])).sum()) / 6
        elif block.dimension == 2:
            areas = np.cross(edges[:, 0], edges[:, 1]) / 2
            measure += float(np.linalg.norm(areas, axis=1).sum())
            areas_of.append(areas)
        else:
            measure += float(np.linalg.norm(edges[:, 0], axis=1).sum())
    return measure, _are_flat(np.concatenate(areas_of))


def _are_flat(areas: np.ndarray) -> bool:
    """Whether facets with these area vectors, which may point either way, lie in parallel planes."""
    sizes = np.linalg.norm(areas, axis=1)
    if not len(areas) or not sizes.sum() > 0:
        return False
    axis = areas[int(np.argmax(sizes))]
    return bool((np.abs(areas @ axis) / np.linalg.norm(axis)).sum() > (1 - FLAT) * sizes.sum())


def _table(mesh: FoundMesh, scale: float) -> list[str]:
    """One line a part: its elements, its measure, its size under each guess of the unit, or by the given scale."""
    units = UNITS if scale == 1 else (("mm", 1.0),)
    sizes = [f"size, mm, if in {unit}" for unit, _ in units] if scale == 1 else ["size, mm"]
    rows = [["part", "elements", "measure", *sizes]]
    for name, places in mesh.cells.items():
        number = {d: sum(len(p) for b, p in zip(mesh.blocks, places) if b.dimension == d) for d in ELEMENTS}
        counts = ", ".join(f"{number[d]} {ELEMENTS[d]}" for d in dimensions_of(mesh, places))
        top = max(dimensions_of(mesh, places), default=0)
        measure, is_flat = _measure(mesh.points, _cells(mesh, name))
        unit = ("mm" if scale != 1 else "unit") + ("" if top == 1 else f"^{top}")
        words = {3: "volume", 2: "area", 1: "length"}
        said = f"{words[top]} {measure:.4g} {unit}" if top else ""
        said += ", flat" if is_flat and mesh.dimension == 3 else ""
        rows.append([name, counts or "none", said, *_sizes(box_of(mesh, name), units)])
    for name, points in mesh.points_of.items():
        box = np.ptp(mesh.points[points], axis=0) if len(points) else np.zeros(3)
        rows.append([name, f"{len(points)} points", "", *_sizes(box, units)])
    left = len(rows) - 1 - MOST_LINES
    rows = rows[: MOST_LINES + 1]
    widths = [max(len(printable(row[k])) for row in rows) for k in range(len(rows[0]))]
    lines = ["  ".join(f"{printable(cell):<{width}}" for cell, width in zip(row, widths)).rstrip() for row in rows]
    return lines + ([f"... and {left} parts more"] if left > 0 else [])


def _sizes(box: np.ndarray, units: Sequence[tuple[str, float]]) -> list[str]:
    return [" x ".join(f"{x * factor:.3g}" for x in box) for _, factor in units]


def separate_volumes(mesh: FoundMesh) -> Volumes:
    """Parts of cells, none of which shares a cell with another: named ones first."""
    found: Volumes = {}
    taken = [np.zeros(len(block.nodes), dtype=bool) for block in mesh.blocks]
    for name in sorted(mesh.cells, key=lambda name: (name == WHOLE, *_rank(mesh, name))):
        places = mesh.cells[name]
        here = [(t, p) for t, p, b in zip(taken, places, mesh.blocks) if b.dimension == mesh.dimension and len(p)]
        if here and not any(t[p].any() for t, p in here):
            found[name] = _cells(mesh, name)
            for t, p in here:
                t[p] = True
    return found


def _rank(mesh: FoundMesh, name: str) -> tuple[bool, bool, bool]:
    """Sort key of names for the same elements. The least tells most: gmsh, for one, writes "Volume1" beside "fluid"."""
    known = any(word in name.lower() for word in (*FLUID, *SOLID))
    return name in mesh.numbered, not known, name[-1:].isdigit()


def _touching(mesh: FoundMesh, volumes: Volumes) -> list[str]:
    few = len(volumes) <= MOST_VOLUMES
    found = contacts(mesh.points, volumes, mesh.dimension, distances=few)
    lines = [f"{(touch_words if contact.sides else gap_words)(contact)}." for contact in found if contact.sides or few]
    alone = lonely(volumes, found)
    if not few and alone:
        lines.append(f"No side in common with another one has: {shown_names(alone)}.")
    doubled = doubled_words(mesh.points, [block for blocks in volumes.values() for block in blocks])
    lines = lines[:MOST_LINES] + ([f"... and {len(lines) - MOST_LINES} more"] if len(lines) > MOST_LINES else [])
    return [printable(line) for line in lines + ([f"{doubled}."] if doubled else [])]


def unit_words(longest: float) -> str:
    """A warning for a mesh that is taken in mm but is no vessel's in that unit; empty where it may be."""
    if SHORTEST <= longest <= LONGEST:
        return ""
    fits = [f"--scale {factor:g} if it is in {unit}" for unit, factor in _fitting(longest)]
    return f"the mesh is {longest:.3g} mm long: {' or '.join(fits) or 'give --scale FACTOR, from its unit to mm'}"


def _fitting(longest: float) -> list[tuple[str, float]]:
    return [(unit, factor) for unit, factor in UNITS if SHORTEST <= longest * factor <= LONGEST]


def _unit(longest: float) -> tuple[float, str]:
    """A factor to mm by the longest extent, in words."""
    fits = _fitting(longest)
    if not fits:
        words = f"no vessel is {longest:.3g} mm, cm or m long; give --scale FACTOR, from the file's unit to mm."
        return 1.0, f"Unit: {words}"
    options = ", ".join(f"--scale {factor:g} if {unit}" for unit, factor in fits)
    said = "the file does not say it; by its size" if len(fits) > 1 else "by its size"
    unit, factor = fits[0]
    more = f"; the command below takes it for {unit}" if len(fits) > 1 else ""
    return factor, f"Unit: {said} {' or '.join(unit for unit, _ in fits)} ({options}){more}."


def _command(
    mesh: FoundMesh, volumes: Volumes, words: Sequence[str], sources: Sequence[Source], factor: float, join: float
) -> list[str]:
    """The call that makes the mesh of a case, with names where a guess is to be had."""
    given = [source.name for source in sources if source.name]
    groups = guessed_groups(mesh, volumes, given)
    target = Path(sources[0].path.name).with_suffix(".msh").name
    target = "imported.msh" if len(sources) > 1 or target == sources[0].path.name else target
    command = ["fsi-mesh", "import", *words, "-o", target]
    command += ["--scale", f"{factor:g}"] if factor != 1 else []
    command += ["--join", f"{join:g}"] if join else []
    for name, part in groups:
        command += ["--group", f"{name}={part}"]
    text = " ".join(shlex.quote(word) for word in command)
    openings = len(groups) > len(volumes) or len(given) > len(volumes)
    fluid = "fluid" in given or any(name == "fluid" for name, _ in groups)
    note = "" if openings or mesh.dimension == 2 or not fluid else " --flat-ends"
    found = ["The command; names are guesses:" if groups else "The command:", printable(f"  {text}{note}")]
    if note:
        words = "flat ends of the fluid end_1, end_2 ...; --opening NAME=X,Y,Z names one by a point, mm"
        found.append(f"  It calls the {words}")
    if len(volumes) == 1 and fluid and not given and not any(word in next(iter(volumes)).lower() for word in FLUID):
        faces = " --wall-faces" if mesh.dimension == 3 else ""
        found.append(f"  or, where that is a wall without fluid, --group wall={next(iter(volumes))}{faces}")
    return found


def guessed_groups(mesh: FoundMesh, volumes: Volumes, given: Sequence[str] = ()) -> list[tuple[str, str]]:
    """Names and parts: roles of the volumes, and flat surfaces, which may be openings. `given` have a name already."""
    groups = [] if given else list(_roles(mesh, volumes).items())
    surfaces = [name for name in mesh.cells if is_surface(mesh, name) and name not in given]
    if mesh.dimension == 3:
        surfaces = [name for name in surfaces if _measure(mesh.points, _cells(mesh, name))[1]]
    seen: list[set] = []
    # The same facets under a name and a number are one opening.
    for name in sorted(surfaces, key=lambda name: _rank(mesh, name)):
        here = {tuple(sorted(row)) for b in _cells(mesh, name) for row in b.nodes[:, : CORNERS[b.kind]].tolist()}
        if not any(here & other for other in seen):
            seen.append(here)
            groups.append((_name(name), name))
    if not surfaces and mesh.dimension == 3 and not given:
        flat = FoundMesh(mesh.points, [block for blocks in volumes.values() for block in blocks])
        for name, points in mesh.points_of.items():
            facets = facets_between(flat, points)
            if facets and _measure(mesh.points, facets)[1]:
                groups.append((_name(name), name))
    return groups


def _roles(mesh: FoundMesh, volumes: Volumes) -> dict[str, str]:
    """Names for the volumes: by what they are called, else the fluid is the one whose box lies within the others'."""
    roles: dict[str, str] = {}
    rest = []
    for part in volumes:
        if "fluid" not in roles and any(word in part.lower() for word in FLUID):
            roles["fluid"] = part
        elif any(word in part.lower() for word in SOLID):
            roles["wall" if "wall" not in roles else _name(part)] = part
        else:
            rest.append(part)
    rest.sort(key=lambda part: float(np.sort(_box(mesh.points, volumes[part]))[1]))
    for part in rest:
        free = next((name for name in ("fluid", "wall") if name not in roles), "")
        roles[free or _name(part)] = part
    return roles


def _name(part: str) -> str:
    """A part's name as a group's."""
    return "".join(c if c.isalnum() or c in "_-" else "_" for c in part)
