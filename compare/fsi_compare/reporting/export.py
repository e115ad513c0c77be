"""`fsi-compare export`: a run's fields as VTU files with a PVD file for their times, for programs that read no XDMF."""

import argparse
from pathlib import Path

import numpy as np

from ..base.errors import InputError
from ..base.files import folder, together
from ..base.options import Commands, add_command, add_usual
from ..base.suggestions import hint
from ..results.fields import MediumFields
from ..results.run import open_run
from .pressure import read_times
from .vtu import write_pvd, write_vtu

AS_VTK = [0, 3, 5, 1, 4, 2]  # xx, yy, zz, xy, yz, xz from xx, xy, xz, yy, yz, zz of symmetric tensors

DESCRIPTION = """\
Writes the fields of a run to OUTDIR, a series for each medium: fluid.pvd and wall.pvd, which name a VTU file for
each time. ParaView and VisIt open the .pvd files with their times in ms; meshio opens the single .vtu files. Values
keep their bits, cells of quadratic elements their nodes in the middle of edges; "layer" numbers the wall's layers."""

EXAMPLES = """\
examples:
  fsi-compare export results/artery
  fsi-compare export results/artery --to pvd --fields displacement,pressure --times 2,4,6.5 -o results/artery/vtu
"""


def add_parser(commands: Commands, version: str) -> None:
    command = add_command(commands, "export", export, "the fields of a run as VTU and PVD files", DESCRIPTION, EXAMPLES)
    command.add_argument("folder", metavar="DIR", type=Path, help="result folder of a run")
    command.add_argument("--to", choices=("pvd",), default="pvd", help="format of the series (default: %(default)s)")
    command.add_argument("--fields", metavar="A,B,...", help="fields to write (default: all)")
    text = "times in ms; linear between those written (default: all that were written)"
    command.add_argument("--times", metavar="T,T,...", help=text)
    text = "folder for the files written (default: DIR/vtu)"
    command.add_argument("-o", "--output", metavar="OUTDIR", type=folder, help=text)
    add_usual(command, version, "accepted as by all programs; one thread writes the files")


def export(options: argparse.Namespace) -> int:
    """The command. Also of a run that has not ended well, whose fields are as good as they were. Raises InputError."""
    media = open_run(options.folder, unfinished=True).fields
    if not media:
        raise InputError(options.folder, "", "holds no fields", "set output.every in the case and run it again")
    wanted = _wanted_fields(options.fields, media)
    times = read_times(options.times) or None
    output = options.output or options.folder / "vtu"
    count = 0
    with together(output) as place:
        for name, medium in media.items():
            chosen = [field for field in medium.names if wanted is None or field in wanted]
            if chosen:
                count += write_series(place, name, medium, chosen, times)
    if not options.quiet:
        print(f"{count} files written to {output}")
    return 0


def write_series(
    place: Path, name: str, medium: MediumFields, fields: list[str], times: list[float] | None = None
) -> int:
    """NAME.pvd and a VTU file for each time, by default those that any of the fields was written at, with the fields
    of that time: a restart may have added some. Returns how many files. Raises InputError for a time outside of them.
    """
    written = {field: set(medium.times_of(field).tolist()) for field in fields}
    at = sorted(set.union(*written.values())) if times is None else times
    digits = max(4, len(str(len(at))))
    series: list[tuple[float, str]] = []
    for number, time in enumerate(at):
        of_points: dict[str, np.ndarray] = {}
        of_cells: dict[str, np.ndarray] = {}
        for field in (name for name in fields if times is not None or time in written[name]):
            values = medium.at(time, field)
            if values.ndim == 2 and values.shape[1] == 6:
                values = values[:, AS_VTK]
            (of_points if len(values) == len(medium.points) else of_cells)[field] = values
        if medium.layers is not None:
            of_cells["layer"] = medium.layers
        file = f"{name}-{number:0{digits}}.vtu"
        write_vtu(place / file, medium.points, medium.cells, of_points, of_cells, time)
        series.append((time, file))
    write_pvd(place / f"{name}.pvd", series)
    return len(series) + 1


def _wanted_fields(text: str | None, media: dict[str, MediumFields]) -> list[str] | None:
    if text is None:
        return None
    known = sorted({field for medium in media.values() for field in medium.names})
    wanted = [word.strip() for word in text.split(",")]
    for field in wanted:
        if field not in known:
            raise InputError("", "--fields", f"'{field}' is not in this run", hint(field, known))
    return wanted
