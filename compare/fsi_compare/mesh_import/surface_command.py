"""`fsi-compare convert-surface`: what `fsi-mesh lumen` and `fsi-mesh thicken` ask for, to read surfaces of VTK."""

import argparse

from ..base.files import folder
from ..base.options import Commands, add_command
from .vtp import read_vtp, scalar_field


def add_parser(commands: Commands, version: str) -> None:
    help = "a surface of VTK (.vtp) as text; use fsi-mesh lumen, which checks it, too"
    description = "Prints the surface as OBJ, or its points with one field as a table."
    command = add_command(commands, "convert-surface", convert_surface, help, description)
    command.add_argument("surface", metavar="FILE.vtp", type=folder)
    command.add_argument("--field", metavar="NAME", help="print x,y,z and this field of the points, as CSV")


def convert_surface(options: argparse.Namespace) -> int:
    """The command. Raises InputError."""
    surface = read_vtp(options.surface)
    lines = []
    if options.field is not None:
        lines.append("x,y,z,value")
        values = scalar_field(surface, options.field, options.surface)
        lines += [f"{x!r},{y!r},{z!r},{v!r}" for (x, y, z), v in zip(surface.points.tolist(), values.tolist())]
    else:
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in surface.points.tolist()]
        lines += ["f " + " ".join(str(p + 1) for p in polygon) for polygon in surface.polygons]
    print("\n".join(lines))
    return 0
