"""`fsi-compare pressure`: the pressure waves of finished runs along the centre line, side by side."""

import argparse
import math
from typing import Sequence

from ..base.errors import InputError, printable, say_warning
from ..base.files import folder, together
from ..base.options import Commands, add_command, add_folders, add_output, add_times, add_usual
from ..runs.labels import default_labels, read_labels
from ..runs.run_folder import Run, read_run
from .layout import say_written
from .matplotlib_loader import load_matplotlib
from .samples import compare_samples, without_centre_line

MOST_TIMES = 60
PAPER_TIMES = "1.5,3,4.5,6,7.5,9"

EXAMPLES = """\
examples:
  fsi-compare pressure results/monolithic results/partitioned -o results/compare
  fsi-compare pressure nh mr artery --labels neo-Hookean,Mooney-Rivlin,artery --times 1.75,3.5,5.25,7,8.75,10.5
"""


def add_parser(commands: Commands, version: str) -> None:
    command = add_command(
        commands,
        "pressure",
        pressure,
        "pressure waves along the centre line",
        "Compares the pressure along the centre line. The first run is the reference.\n"
        "Prints differences, peaks and peak speeds, and writes to OUTDIR:\n"
        "  pressure_waves.csv         all runs at the selected times\n"
        "  pressure_waves.png, .svg   one panel per time\n"
        "  pressure_waves.json        the printed numbers in full precision\n"
        "Runs whose meshes, time steps or lengths differ are compared with a warning.\n"
        "Of bent tubes the pressure is that along the centre line that was found, z being its arc length. Where a run\n"
        "has none, flows, points, lines and planes that all runs have are compared, in sample_differences.csv.",
        EXAMPLES,
    )
    add_folders(command)
    add_output(command, "results/compare")
    add_times(command, PAPER_TIMES)
    command.add_argument("--labels", metavar="A,B,...", help="names of the runs (default: program, case or folder)")
    command.add_argument("--title", help="heading of the picture (default: the runs' title)")
    add_usual(command, version, "accepted as by all programs; this comparison is quick on one thread")


def pressure(options: argparse.Namespace) -> int:
    """Reads all runs and checks everything before the first file is written."""
    times = read_times(options.times)
    if len(times) > MOST_TIMES:
        raise InputError("", "--times", f"{len(times)} times do not fit a picture", f"give at most {MOST_TIMES}")
    labels = read_labels(options.labels, len(options.folders))
    if any(without_centre_line(folder) for folder in options.folders):
        return compare_samples(options.folders, labels, options.output, options.quiet)
    runs = [read_run(folder) for folder in options.folders]
    labels = labels or default_labels(runs)
    check_comparable(runs, times)
    title = printable(options.title) if options.title is not None else default_title(runs)
    with together(options.output) as place:
        # matplotlib takes a second to load: not before the input has proved right
        load_matplotlib()
        from . import pictures, pressure_tables as tables

        comparison = tables.compare_pressure(runs, labels, times)
        written = [tables.waves_table(runs, labels, times).write_csv(place), place / "pressure_waves.json"]
        tables.write_json(written[1], comparison)
        written += pictures.write_pressure_waves(place, [run.pressure for run in runs], labels, times, title)
    if not options.quiet:
        for warning in comparison.warnings:
            say_warning(warning)
        print(tables.text(runs, comparison))
        say_written(options.output, written)
    return 0


def read_times(text: str) -> list[float]:
    times = []
    for part in text.split(","):
        try:
            time = float(part)
        except ValueError:
            raise InputError(
                "", "--times", f"'{part.strip()}' is not a number", "give times in ms separated by commas"
            ) from None
        if not math.isfinite(time) or time < 0:
            raise InputError("", "--times", f"{part.strip()} is not a time", "give times in ms, zero or later")
        if time in times:
            raise InputError("", "--times", f"{part.strip()} is given twice", "give each time once")
        times.append(time)
    return sorted(times)


def check_comparable(runs: Sequence[Run], times: Sequence[float]) -> None:
    """Raises InputError for runs that do not reach all times, or whose centre line does not contain the first run's."""
    reference = runs[0]
    for run in runs:
        waves = run.pressure
        path = run.folder / "centerline_pressure.csv"
        for time in times:
            if not waves.covers(time):
                remedy = f"give times between {waves.times[0]:g} and {waves.times[-1]:g} ms"
                raise InputError(path, "--times", f"{time:g} ms is outside the run", remedy)
        if not waves.covers_line(reference.pressure.z):
            z = reference.pressure.z
            problem = f"runs from {waves.z[0]:g} to {waves.z[-1]:g} mm, the first run's from {z[0]:g} to {z[-1]:g} mm"
            raise InputError(path, "z_mm", problem, "compare runs on the same geometry")


def default_title(runs: Sequence[Run]) -> str:
    titles = {run.title for run in runs}
    if len(titles) == 1 and "" not in titles:
        return titles.pop()
    return "Pressure along the centre line"
