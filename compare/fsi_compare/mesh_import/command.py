"""`fsi-compare convert-mesh`: what `fsi-mesh import` asks for. It checks and writes the mesh; this reads what meshio
knows."""

import argparse
from pathlib import Path
from typing import Dict, List, Sequence, TextIO, Tuple

import numpy as np

from ..base.errors import InputError, printable, say_warning
from ..base.files import replacing
from ..base.options import Commands, add_command
from .examining import examined
from .groups import Group, as_sides, choose_groups, left_out, named_parts
from .joining import distances_to
from .listing import guessed_groups, listing, separate_volumes, unit_words
from .parts import FoundMesh, dimensions_of, shown_names
from .raw_mesh import ELEMENTS, KINDS, Block
from .sources import Source, join, read_sources, source_of
from .touching import contacts, doubled_words, gap_words


def add_parser(commands: Commands, version: str) -> None:
    command = add_command(
        commands,
        "convert-mesh",
        convert_mesh,
        "a mesh that meshio reads as a gmsh file; use fsi-mesh import, which checks it, too",
        "Writes a mesh of simplices that meshio reads (VTU, MED, Exodus, ...) as gmsh 2.2 with named groups.",
    )
    command.add_argument("meshes", metavar="FILE", nargs="+", help="or NAME=FILE: all cells of it are NAME")
    command.add_argument("-o", "--output", metavar="FILE.msh", type=Path)
    command.add_argument("--group", metavar="NAME=PART", action="append", default=[])
    command.add_argument("--scale", metavar="FACTOR", type=float, default=1.0, help="from the file's unit to mm")
    command.add_argument("--join", metavar="TOLERANCE", type=float, help="points so far apart are one, mm")
    command.add_argument(
        "--examine", action="store_true", help="say size, gaps and doubled points; with -o a mesh of all"
    )
    command.add_argument("--list", action="store_true", help="say what parts the file has, and write nothing")


def convert_mesh(options: argparse.Namespace) -> int:
    """The command. Raises InputError."""
    if not 0 < options.scale < float("inf"):
        raise InputError("", "--scale", f"{options.scale:g} is no factor", "give 1000 for a mesh in m")
    if options.join is not None and not 0 < options.join < float("inf"):
        raise InputError("", "--join", f"{options.join:g} is no distance", "give mm, for one 0.001")
    if not options.list and not options.examine and options.output is None:
        raise InputError("", "--output", "is not given", "give -o FILE.msh, or --list")
    sources = [source_of(text) for text in options.meshes]
    file = sources[0].file if len(sources) == 1 else " ".join(options.meshes)
    mesh, ends = read_sources(sources, options.scale)
    said = join(file, mesh, ends, options.join or 0.0)
    if mesh.passed_over:
        said.append(f"Passed over, since they say no parts: {shown_names(mesh.passed_over)}")
    if options.examine:
        said = examined(file, mesh, options.scale)
        if options.output is not None:
            said += _convert_all(file, mesh, options)
    elif options.list:
        said = listing(mesh, options.meshes, sources, options.scale, options.join or 0.0) + said
    else:
        said += _convert(file, mesh, sources, options)
    for line in said:
        print(printable(line))
    return 0


def _convert(file: str, mesh: FoundMesh, sources: Sequence[Source], options: argparse.Namespace) -> List[str]:
    """Writes the mesh; returns what was done to it."""
    wanted = [(source.name, source.name) for source in sources if source.name]
    groups = choose_groups(file, mesh, wanted + [_pair(text) for text in options.group])
    _require_sides(file, mesh, groups, sources)
    _warn_of_gaps(mesh, groups)
    if options.scale == 1:
        used = np.concatenate([block.nodes.ravel() for group in groups for block in group.parts])
        if words := unit_words(float(np.ptp(mesh.points[used], axis=0).max())):
            say_warning(words)
    turned = _turn(mesh, groups)
    with replacing(options.output) as temporary, open(temporary, "w", encoding="utf-8") as out:
        _write(out, mesh, groups)
    said = [f"{turned} cells were turned inside out and are turned back"] if turned else []
    others = [] if wanted or options.group else left_out(mesh)
    return said + ([f"Left out, since no --group names them: {shown_names(others)}"] if others else [])


def _convert_all(file: str, mesh: FoundMesh, options: argparse.Namespace) -> List[str]:
    """Writes all volumes, and the surfaces that are named or flat, by names that are guesses."""
    wanted = guessed_groups(mesh, separate_volumes(mesh))
    known = {part for _, part in wanted}
    wanted += [(name, name) for name in named_parts(mesh) if name not in known and _is_surface(mesh, name)]
    groups = choose_groups(file, mesh, wanted)
    turned = _turn(mesh, groups)
    with replacing(options.output) as temporary, open(temporary, "w", encoding="utf-8") as out:
        _write(out, mesh, groups)
    said = [f"taken for: {', '.join(f'{name}={part}' for name, part in wanted)}"]
    return said + ([f"{turned} cells are inside out; fsi-mesh import turns them"] if turned else [])


def _is_surface(mesh: FoundMesh, name: str) -> bool:
    return dimensions_of(mesh, mesh.cells[name]) == [mesh.dimension - 1]


def _require_sides(file: str, mesh: FoundMesh, groups: List[Group], sources: Sequence[Source]) -> None:
    """Facets of another file than the cells' are to be sides of cells."""
    missing = as_sides(mesh, groups)
    if not missing or len(sources) == 1:
        return
    group, corners = missing[0]
    at = next((source.file for source in sources if source.name == group.name), file)
    used = [block.nodes.ravel() for g in groups if g.dimension == mesh.dimension for block in g.parts]
    cells, loose = np.unique(np.concatenate(used)), np.setdiff1d(np.unique(corners), np.concatenate(used))
    count = sum(len(block.nodes) for block in group.parts)
    problem = f"{len(corners)} of its {count} {ELEMENTS[group.dimension]} are sides of no cell"
    if not len(loose):
        raise InputError(at, group.name, f"{problem}, though their corners are", "give the faces of this very mesh")
    span = float(np.ptp(mesh.points[cells], axis=0).max())
    farthest = float(distances_to(mesh.points[loose], mesh.points[cells], span).max())
    problem += f"; {len(loose)} of their corners are up to {farthest:.3g} mm from the cells' points"
    raise InputError(at, group.name, problem, f"give --join {1.1 * farthest:.2g}, if that is a small part of an edge")


def _warn_of_gaps(mesh: FoundMesh, groups: List[Group]) -> None:
    """A volume that shares no side with another one is alone: no interface."""
    volumes: Dict[str, List[Block]] = {}
    for group in groups:
        if group.dimension == mesh.dimension:
            volumes.setdefault(group.name, []).extend(group.parts)
    found = contacts(mesh.points, volumes, mesh.dimension)
    alone = False
    for name in volumes:
        mine = [contact for contact in found if name in (contact.first, contact.second)]
        if mine and not any(contact.sides for contact in mine):
            say_warning(f"{name} touches no other part: {'; '.join(gap_words(contact) for contact in mine)}")
            alone = True
    doubled = "" if alone else doubled_words(mesh.points, [block for parts in volumes.values() for block in parts])
    if doubled:
        say_warning(doubled)


def _pair(text: str) -> Tuple[str, str]:
    name, equals, part = text.partition("=")
    if not (name and equals and part) or '"' in name:
        raise InputError("", "--group", f"'{text}' is no NAME=PART", "write, for one, --group fluid=region:1")
    return name, part


def _turn(mesh: FoundMesh, groups: List[Group]) -> int:
    """Turns linear and quadratic tetrahedra of negative volume; how many there were."""
    swap = {"tetra": (0, 2, 1, 3), "tetra10": (0, 2, 1, 3, 6, 5, 4, 7, 9, 8)}
    count = 0
    for group in groups:
        for block in group.parts:
            if block.kind not in swap:
                continue
            a, b, c, d = (mesh.points[block.nodes[:, k]] for k in range(4))
            wrong = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) < 0
            count += int(wrong.sum())
            block.nodes[wrong] = block.nodes[wrong][:, list(swap[block.kind])]
    return count


def _write(out: TextIO, mesh: FoundMesh, groups: List[Group]) -> None:
    """Not by meshio's own writer: it knows a name once, and volumes and surfaces may share one."""
    used = np.unique(np.concatenate([block.nodes.ravel() for group in groups for block in group.parts]))
    number = np.zeros(len(mesh.points), dtype=np.int64)
    number[used] = np.arange(1, len(used) + 1)
    names: dict = {}
    for group in groups:
        names.setdefault((group.dimension, group.name), len(names) + 1)
    out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n")
    out.write(f"{len(names)}\n")
    for (dimension, name), tag in names.items():
        out.write(f'{dimension} {tag} "{name}"\n')
    out.write(f"$EndPhysicalNames\n$Nodes\n{len(used)}\n")
    for i, (x, y, z) in enumerate(mesh.points[used].tolist(), 1):
        out.write(f"{i} {x!r} {y!r} {z!r}\n")
    blocks: List[Tuple[int, Block]] = [(names[g.dimension, g.name], block) for g in groups for block in g.parts]
    out.write(f"$EndNodes\n$Elements\n{sum(len(block.nodes) for _, block in blocks)}\n")
    at = 0
    for tag, block in blocks:
        _, _, kind, order = KINDS[block.kind]
        for nodes in number[block.nodes[:, list(order)]]:
            at += 1
            out.write(f"{at} {kind} 2 {tag} {tag} {' '.join(map(str, nodes))}\n")
    out.write("$EndElements\n")
