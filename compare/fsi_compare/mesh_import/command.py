"""`fsi-compare convert-mesh`: what `fsi-mesh import` asks for. It checks and writes the mesh; this reads what meshio
knows."""

import argparse
from pathlib import Path
from typing import List, TextIO, Tuple

import numpy as np

from ..base.errors import InputError, printable
from ..base.files import folder, replacing
from ..base.options import Commands, add_command
from .groups import Group, choose_groups
from .parts import FoundMesh, count_in, dimensions_of, found_mesh, shown_names
from .raw_mesh import ELEMENTS, KINDS, Block
from .readers import read_mesh


def add_parser(commands: Commands, version: str) -> None:
    command = add_command(
        commands,
        "convert-mesh",
        convert_mesh,
        "a mesh that meshio reads as a gmsh file; use fsi-mesh import, which checks it, too",
        "Writes a mesh of simplices that meshio reads (VTU, MED, Exodus, ...) as gmsh 2.2 with named groups.",
    )
    command.add_argument("mesh", metavar="FILE", type=folder)
    command.add_argument("-o", "--output", metavar="FILE.msh", type=Path)
    command.add_argument("--group", metavar="NAME=PART", action="append", default=[])
    command.add_argument("--scale", metavar="FACTOR", type=float, default=1.0, help="from the file's unit to mm")
    command.add_argument("--list", action="store_true", help="say what parts the file has, and write nothing")


def convert_mesh(options: argparse.Namespace) -> int:
    """The command. Raises InputError."""
    file = str(options.mesh)
    if not 0 < options.scale < float("inf"):
        raise InputError("", "--scale", f"{options.scale:g} is no factor", "give 1000 for a mesh in m")
    mesh = found_mesh(file, read_mesh(options.mesh), options.scale)
    if options.list:
        for name, places in mesh.cells.items():
            counts = [f"{count_in(mesh, places, d)} {ELEMENTS[d]}" for d in dimensions_of(mesh, places)]
            print(printable(f"{name:<32} {', '.join(counts)}"))
        for name, at in mesh.points_of.items():
            print(printable(f"{name:<32} {len(at)} points"))
    if mesh.passed_over:
        print(printable(f"Passed over, since they say no parts: {shown_names(mesh.passed_over)}"))
    if options.list:
        return 0
    if options.output is None:
        raise InputError("", "--output", "is not given", "give -o FILE.msh, or --list")
    groups = choose_groups(file, mesh, [_pair(text) for text in options.group])
    turned = _turn(mesh, groups)
    if turned:
        print(f"{turned} cells were turned inside out and are turned back")
    with replacing(options.output) as temporary, open(temporary, "w", encoding="utf-8") as out:
        _write(out, mesh, groups)
    return 0


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
