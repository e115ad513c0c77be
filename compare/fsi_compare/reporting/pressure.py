"""`fsi-compare pressure`: the pressure waves of finished runs along the centre line, side by side."""

import argparse
import functools
import math
from typing import Sequence

from ..base.errors import InputError, say_warning
from ..base.files import together
from ..base.options import Commands, add_command, add_folders, add_labels, add_output, add_usual
from ..runs.labels import default_labels, read_labels, title_of
from ..runs.run_folder import ALONG_AXIS, Run, pressure_file, read_run
from .layout import say_written
from .matplotlib_loader import load_matplotlib
from .samples import compare_samples, without_centre_line

MOST_TIMES = 60
PARTS, PAPER_END = 6, 9.0  # ms: the paper compares at six equal parts of it

DESCRIPTION = """\
Compares the pressure along the centre line. The first run is the reference.
Prints differences, peaks and peak speeds, and writes to OUTDIR:
  pressure_waves.csv         all runs at the selected times
  pressure_waves.png, .svg   one panel per time
  pressure_waves.json        the printed numbers in full precision
Runs whose meshes, time steps or lengths differ are compared with a warning.
Of bent tubes the pressure is that along the centre line that was found, z being its arc length. Where a run
has none, flows, points, lines and planes that all runs have are compared, in sample_differences.csv."""

EXAMPLES = """\
examples:
  fsi-compare pressure results/monolithic results/partitioned -o results/compare
  fsi-compare pressure nh mr artery --labels neo-Hookean,Mooney-Rivlin,artery --times 1.75,3.5,5.25,7,8.75,10.5
"""


def add_parser(commands: Commands, version: str) -> None:
    command = add_command(commands, "pressure", pressure, "pressure waves along the centre line", DESCRIPTION, EXAMPLES)
    add_folders(command)
    add_output(command, "results/compare")
    end = f"{PAPER_END:g} ms, or of the shortest run if it ends earlier or not before {2 * PAPER_END:g} ms"
    command.add_argument(
        "--times",
        metavar="T,T,...",
        help=f"times in ms; linear between time steps (default: {PARTS} equal parts of {end})",
    )
    add_labels(command, "program, case or folder")
    command.add_argument("--title", help="heading of the picture (default: the runs' title)")
    add_usual(command, version, "accepted as by all programs; this comparison is quick on one thread")


def pressure(options: argparse.Namespace) -> int:
    """Reads all runs and checks everything before the first file is written."""
    times = read_times(options.times, MOST_TIMES)
    labels = read_labels(options.labels, len(options.folders))
    if any(without_centre_line(folder) for folder in options.folders):
        return compare_samples(options.folders, labels, options.output, options.quiet)
    runs = [read_run(folder) for folder in options.folders]
    labels = labels or default_labels(runs)
    if not times:
        end = min(float(run.pressure.times[-1]) for run in runs)
        end = PAPER_END if PAPER_END <= end < 2 * PAPER_END else end
        times = [end * part / PARTS for part in range(1, PARTS + 1)]
    check_comparable(runs, times)
    title = title_of(options.title, [run.title for run in runs], "Pressure along the centre line")
    with together(options.output) as place:
        # matplotlib takes a second to load: not before the input has proved right
        load_matplotlib()
        from . import pictures, pressure_tables as tables

        comparison = tables.compare_pressure(runs, labels, times)
        written = [tables.waves_table(runs, labels, times).write_csv(place), place / "pressure_waves.json"]
        tables.write_json(written[1], comparison)
        waves = [run.pressure for run in runs]
        figure = functools.partial(pictures.pressure_figure, waves, labels, times, title)
        written += pictures.write_figure(place, "pressure_waves", figure)
    if not options.quiet:
        for warning in comparison.warnings:
            say_warning(warning)
        print(tables.text(runs, comparison))
        say_written(options.output, written)
    return 0


def read_times(text: str | None, most: float = math.inf) -> list[float]:
    """Times in ms, in order; none where none are given. `most`: that fit a picture. Raises InputError."""
    times: list[float] = []
    for part in text.split(",") if text is not None else ():
        try:
            time = float(part)
        except ValueError:
            problem = f"'{part.strip()}' is not a number"
            raise InputError("", "--times", problem, "give times in ms separated by commas") from None
        if not math.isfinite(time) or time < 0:
            raise InputError("", "--times", f"{part.strip()} is not a time", "give times in ms, zero or later")
        if time in times:
            raise InputError("", "--times", f"{part.strip()} is given twice", "give each time once")
        times.append(time)
    if len(times) > most:
        raise InputError("", "--times", f"{len(times)} times do not fit a picture", f"give at most {most}")
    return sorted(times)


def check_comparable(runs: Sequence[Run], times: Sequence[float]) -> None:
    """Raises InputError for runs that do not reach all times, or whose centre line does not contain the first run's."""
    reference = runs[0]
    for run in runs:
        path = pressure_file(run.folder)
        for time in times:
            run.pressure.require(time, path, "--times")
        if not run.pressure.covers_line(reference.pressure.z):
            place = "z_mm" if path.name == ALONG_AXIS else "s_mm"
            raise run.pressure.elsewhere(reference.pressure.z, path, place, "the first run's")
