"""`fsi-compare convert-case`: what `fsi-mesh import CASE -o FOLDER` asks for. It checks and writes the mesh."""

import argparse
from pathlib import Path

from ..base.errors import InputError, printable, say_warning
from ..base.files import folder
from ..base.options import Commands, add_command
from ..mesh_import.command import add_join
from . import precice, svmultiphysics
from .case_file import write_case
from .model import PeerCase
from .units import SYSTEMS, Units, units_of
from .xml_file import read_xml


def add_parser(commands: Commands, version: str) -> None:
    help = "a case of another program as a case file and a mesh; use fsi-mesh import, which checks both"
    what = "case.toml, tables, import.log and given.msh of a case of another program"
    command = add_command(commands, "convert-case", convert_case, help, f"Writes {what} into a folder that is there.")
    command.add_argument("case", metavar="CASE", type=Path)
    command.add_argument("-o", "--output", metavar="FOLDER", type=folder, required=True)
    command.add_argument("--units", metavar="NAME", default="cgs", help=f"of a case without any: {', '.join(SYSTEMS)}")
    text = "of fibres that the case gives by vectors"
    command.add_argument("--fibre-angle", metavar="DEGREES", type=float, help=text)
    add_join(command)


def convert_case(options: argparse.Namespace) -> int:
    """The command. Raises InputError."""
    angle = options.fibre_angle
    if angle is not None and not 0 <= angle <= 90:
        remedy = "give 0 to 90 degrees: the other family mirrors it"
        raise InputError("", "--fibre-angle", f"{angle:g} is no angle to the circumference", remedy)
    case = read_peer_case(options.case, units_of(options.units), angle, options.join)
    lines: list[str] = [f"{case.file}, a case of {case.program}, taken in {options.units}."]
    lines += case.said + [f"No counterpart: {note}" for note in case.notes]
    try:
        write_case(case, options.output)
        (options.output / "import.log").write_text("\n".join(printable(line) for line in lines) + "\n", "utf-8")
        if case.mesh is not None:
            case.mesh.write(options.output / "given.msh")
    except OSError as error:
        raise InputError(options.output, "", f"cannot be written: {error.strerror}", "name another with -o") from None
    for line in lines:
        print(printable(line))
    for note in case.notes:
        if note.matters:
            say_warning(str(note))
    return 0


def read_peer_case(path: Path, units: Units, fibre_angle: float | None, tolerance: float) -> PeerCase:
    """Reads the case of another program, which the root of its XML names. Raises InputError."""
    root = read_xml(path)
    if root.name == "svMultiPhysicsFile":
        root.taken = True
        return svmultiphysics.read_case(root, units, fibre_angle, tolerance)
    if root.name == "precice-configuration":
        raise precice.refusal(root)
    if root.name == "dolfin":
        problem = "is a mesh of dolfin, which holds no case: materials and conditions are Python of turtleFSI or VaSP"
        raise InputError(path, "", problem, "import the mesh with -o FILE.msh, and write the case file by hand")
    raise InputError(path, root.name, "is no case that ours reads", "give solver.xml of svMultiPhysics")
