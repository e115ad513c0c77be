"""`fsi-compare picture`: a still of the vessel with a result on it."""

import argparse
import math
from pathlib import Path

from ..base.errors import InputError, printable
from ..base.files import output_folder
from ..base.options import Commands, add_command, add_usual
from ..results.run import open_run
from .matplotlib_loader import load_matplotlib

DESCRIPTION = """\
A picture of the vessel of a finished run, coloured by one of its fields: the same
surfaces, colours and range as in the report. It needs fields.h5, and neither a
screen nor graphics hardware.
"""
EXAMPLES = """\
examples:
  fsi-compare picture results/monolithic --field wall_shear_stress --time 160 -o a.png
  fsi-compare picture results/monolithic --field velocity --cut --unit mmHg -o b.png
"""
KINDS = (".png", ".svg", ".pdf")


def add_parser(commands: Commands, version: str) -> None:
    command = add_command(commands, "picture", make, "a still of the vessel with a field on it", DESCRIPTION, EXAMPLES)
    command.add_argument("folder", metavar="RUN", type=Path, help="result folder of a finished run")
    text = "field, or a part of it: velocity:x (default: the first of the scene)"
    command.add_argument("--field", metavar="NAME", help=text)
    command.add_argument("--time", metavar="T", type=float, help="time in ms (default: the last of fields.h5)")
    text, output = "default: %(default)s", Path("vessel.png")
    command.add_argument("-o", "--output", metavar="FILE", type=Path, default=output, help=text)
    text = "displacement is shown F times (default: 1)"
    command.add_argument("--factor", metavar="F", type=float, default=1.0, help=text)
    text = "opened by a plane (default: for the velocity)"
    command.add_argument("--cut", action=argparse.BooleanOptionalAction, help=text)
    command.add_argument("--unit", metavar="UNIT", help="of stresses and pressures: kPa, Pa or mmHg")
    text = "of the colours, in the unit (default: 1st, or 0, and 99th percentile of all times)"
    command.add_argument("--range", metavar="LOW,HIGH", help=text)
    command.add_argument("--view", metavar="VIEW", help="look from x, -x, y, -y, z, -z or an opening")
    add_usual(command, version, "accepted as by all programs; a picture is drawn on one thread")


def make(options: argparse.Namespace) -> int:
    """Nothing is written where anything is wrong."""
    if options.output.suffix not in KINDS:
        raise InputError(options.output, "", "is no picture's name", f"end it with {', '.join(KINDS)}")
    if not (math.isfinite(options.factor) and options.factor >= 0):
        raise InputError("", "--factor", f"{options.factor} is no factor", "give 0 or more")
    span = read_range(options.range)
    run = open_run(options.folder)
    load_matplotlib()
    from .pictures import write_plot

    words = options.field, options.time, options.factor, options.cut, options.unit, span, options.view
    with output_folder(options.output.parent) as place:
        write_plot(place / options.output.name, lambda: run.picture(*words))
    if not options.quiet:
        print(f"Written: {printable(str(options.output))}")
    return 0


def read_range(text: str | None) -> tuple[float, float] | None:
    """Reads two increasing numbers. Raises InputError."""
    if text is None:
        return None
    try:
        low, high = (float(word) for word in text.split(","))
    except ValueError:
        raise InputError("", "--range", f"'{text}' is no range", "give two numbers: 0,2.5") from None
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise InputError("", "--range", f"{text} does not increase", "give the lower number first")
    return low, high
