"""`fsi-compare convert-mesh`: the part of `fsi-mesh import` that reads by meshio; fsi-mesh checks and writes the
mesh."""

import argparse
from pathlib import Path
from typing import Sequence

import numpy as np

from ..base.errors import InputError, printable, say_warning
from ..base.files import replacing
from ..base.options import Commands, add_command, positive_number
from .conversion import require_sides, turn, warn_of_gaps, write_gmsh
from .examining import examined
from .groups import Group, choose_groups, left_out, named_parts
from .listing import guessed_groups, listing, separate_volumes, unit_words
from .parts import FoundMesh, is_surface, shown_names
from .sources import Source, join, read_sources, source_of


def add_parser(commands: Commands, version: str) -> None:
    help = "a mesh that meshio reads as a gmsh file; use fsi-mesh import, which checks it, too"
    description = "Writes a mesh of simplices that meshio reads (VTU, MED, Exodus, ...) as gmsh 2.2 with named groups."
    command = add_command(commands, "convert-mesh", convert_mesh, help, description)
    command.add_argument("meshes", metavar="FILE", nargs="+", help="or NAME=FILE: all cells of it are NAME")
    command.add_argument("-o", "--output", metavar="FILE.msh", type=Path)
    command.add_argument("--group", metavar="NAME=PART", action="append", default=[])
    command.add_argument("--scale", metavar="FACTOR", type=float, default=1.0, help="from the file's unit to mm")
    add_join(command)
    text = "say size, gaps and doubled points; with -o a mesh of all"
    command.add_argument("--examine", action="store_true", help=text)
    command.add_argument("--list", action="store_true", help="say what parts the file has, and write nothing")


def add_join(command: argparse.ArgumentParser) -> None:
    distance = positive_number("--join", "is no distance", "give mm, for one 0.001")
    text = "points so far apart are one, mm"
    command.add_argument("--join", metavar="TOLERANCE", type=distance, default=0.0, help=text)


def convert_mesh(options: argparse.Namespace) -> int:
    """The command. Raises InputError."""
    if not 0 < options.scale < float("inf"):
        raise InputError("", "--scale", f"{options.scale:g} is no factor", "give 1000 for a mesh in m")
    if not options.list and not options.examine and options.output is None:
        raise InputError("", "--output", "is not given", "give -o FILE.msh, or --list")
    sources = [source_of(text) for text in options.meshes]
    file = sources[0].file if len(sources) == 1 else " ".join(options.meshes)
    mesh, ends = read_sources(sources, options.scale)
    said = join(file, mesh, ends, options.join)
    if mesh.passed_over:
        said.append(f"Passed over, since they say no parts: {shown_names(mesh.passed_over)}")
    if options.examine:
        wanted = _all_parts(mesh) if options.output is not None else []
        said = examined(file, mesh, options.scale, wanted)
        if options.output is not None:
            said += _convert_all(file, mesh, wanted, options.output)
    elif options.list:
        said = listing(mesh, options.meshes, sources, options.scale, options.join) + said
    else:
        said += _convert(file, mesh, sources, options)
    for line in said:
        print(printable(line))
    return 0


def _convert(file: str, mesh: FoundMesh, sources: Sequence[Source], options: argparse.Namespace) -> list[str]:
    """Writes the mesh; returns what was done to it."""
    wanted = [(source.name, source.name) for source in sources if source.name]
    groups = choose_groups(file, mesh, wanted + [_pair(text) for text in options.group])
    require_sides(file, mesh, groups, sources)
    warn_of_gaps(mesh, groups)
    if options.scale == 1:
        used = np.concatenate([block.nodes.ravel() for group in groups for block in group.parts])
        if words := unit_words(float(np.ptp(mesh.points[used], axis=0).max())):
            say_warning(words)
    turned = _turn_and_write(mesh, groups, options.output)
    said = [f"{turned} cells were turned inside out and are turned back"] if turned else []
    others = [] if wanted or options.group else left_out(mesh)
    return said + ([f"Left out, since no --group names them: {shown_names(others)}"] if others else [])


def _all_parts(mesh: FoundMesh) -> list[tuple[str, str]]:
    """All volumes, and the surfaces that are named or flat: (guessed name, the file's name)."""
    wanted = guessed_groups(mesh, separate_volumes(mesh))
    known = {part for _, part in wanted}
    return wanted + [(name, name) for name in named_parts(mesh) if name not in known and is_surface(mesh, name)]


def _convert_all(file: str, mesh: FoundMesh, wanted: Sequence[tuple[str, str]], output: Path) -> list[str]:
    """Writes them; returns what was done."""
    turned = _turn_and_write(mesh, choose_groups(file, mesh, wanted), output)
    said = [f"taken for: {', '.join(f'{name}={part}' for name, part in wanted)}"]
    return said + ([f"{turned} cells are inside out; fsi-mesh import turns them"] if turned else [])


def _turn_and_write(mesh: FoundMesh, groups: list[Group], output: Path) -> int:
    """How many cells were turned."""
    turned = turn(mesh, groups)
    with replacing(output) as temporary, open(temporary, "w", encoding="utf-8") as out:
        write_gmsh(out, mesh, groups)
    return turned


def _pair(text: str) -> tuple[str, str]:
    name, equals, part = text.partition("=")
    if not (name and equals and part) or '"' in name:
        raise InputError("", "--group", f"'{text}' is no NAME=PART", "write, for one, --group fluid=region:1")
    return name, part
