"""The command line of fsi-compare."""

import argparse
import math
import os
import sys
from pathlib import Path
from typing import List, Optional, Sequence

from .base.errors import InputError
from .base.files import make_folder
from .linear.command import add_parser as add_solvers, solvers
from .reporting.cost import add_parser as add_cost, cost
from .runs.run_folder import Run, default_labels, read_run
from .studies.command import add_parser as add_study, study

PAPER_TIMES = "1.5,3,4.5,6,7.5,9"

EXAMPLES = """\
examples:
  fsi-compare pressure results/monolithic results/partitioned -o results/compare
  fsi-compare pressure nh mr artery --labels neo-Hookean,Mooney-Rivlin,artery --times 1.75,3.5,5.25,7,8.75,10.5
"""


class _Parser(argparse.ArgumentParser):
    """Wrong use is reported in one line with exit code 1, as by the other programs."""

    def error(self, message):
        raise InputError("", "", message, f"see {self.prog} --help")


def parser(version: str) -> argparse.ArgumentParser:
    top = _Parser(prog="fsi-compare",
                  description="Compares finished runs and the linear solvers, and drives whole studies.",
                  allow_abbrev=False)
    top.add_argument("--version", action="version", version=f"fsi-compare {version}")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)
    pressure = commands.add_parser(
        "pressure", allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter, epilog=EXAMPLES,
        help="pressure waves along the centre line",
        description="Compares the pressure along the centre line. The first run is the reference.\n"
                    "Prints differences, peaks and peak speeds, and writes to OUTDIR:\n"
                    "  pressure_waves.csv         all runs at the selected times\n"
                    "  pressure_waves.png, .svg   one panel per time\n"
                    "  pressure_waves.json        the printed numbers in full precision")
    pressure.add_argument("folders", nargs="+", metavar="DIR", type=Path, help="result folder of a finished run")
    pressure.add_argument("-o", "--output", metavar="OUTDIR", type=Path, default=Path("results/compare"),
                          help="folder for the files written (default: %(default)s)")
    pressure.add_argument("--times", metavar="T,T,...", default=PAPER_TIMES,
                          help="times in ms; linear between time steps (default: %(default)s)")
    pressure.add_argument("--labels", metavar="A,B,...", help="names of the runs (default: program, case or folder)")
    pressure.add_argument("--title", help="heading of the picture (default: the runs' title)")
    pressure.add_argument("--threads", metavar="N", type=int,
                          help="accepted as by all programs; this comparison is quick on one thread")
    pressure.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")
    pressure.add_argument("--version", action="version", version=f"fsi-compare {version}")
    add_cost(commands, version)
    add_solvers(commands, "results/solvers", version)
    add_study(commands, version)
    return top


def main(arguments: Sequence[str], version: str = "unknown") -> int:
    """Exit code: 0 done, 1 wrong use or bad input, 2 done but something did not converge."""
    code = 0
    try:
        top = parser(version)
        options = top.parse_args(list(arguments))
        if options.command is None:
            top.error("no command")
        code = {"pressure": pressure, "cost": cost, "solvers": solvers, "study": study}[options.command](options)
        sys.stdout.flush()
    except InputError as error:
        print(f"fsi-compare: error: {error}", file=sys.stderr)
        return 1
    except BrokenPipeError:
        # The reader, e.g. `head`, has seen enough; nothing may be flushed into the closed pipe at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except KeyboardInterrupt:
        print("fsi-compare: interrupted", file=sys.stderr)
        return 130
    return code


def pressure(options: argparse.Namespace) -> int:
    """Reads all runs and checks everything before the first file is written."""
    if options.threads is not None and options.threads < 1:
        raise InputError("", "--threads", f"{options.threads} is not positive", "give 1 or more")
    times = read_times(options.times)
    labels = read_labels(options.labels, len(options.folders))
    runs = [read_run(folder) for folder in options.folders]
    labels = labels or default_labels(runs)
    check_comparable(runs, times)
    make_folder(options.output)

    # matplotlib takes a second to load: not before the input has proved right
    from .reporting import pictures, pressure_tables as tables

    comparison = tables.compare_pressure(runs, labels, times)
    written = [options.output / "pressure_waves.csv", options.output / "pressure_waves.json"]
    tables.write_waves_csv(written[0], runs, labels, times)
    tables.write_json(written[1], comparison)
    title = options.title if options.title is not None else default_title(runs)
    written += pictures.write_pressure_waves(options.output, [run.pressure for run in runs], labels, times, title)
    if not options.quiet:
        print(tables.text(runs, comparison))
        print("Written: " + ", ".join(str(path) for path in written))
    return 0


def read_times(text: str) -> List[float]:
    times = []
    for part in text.split(","):
        try:
            time = float(part)
        except ValueError:
            raise InputError("", "--times", f"'{part.strip()}' is not a number",
                             "give times in ms separated by commas") from None
        if not math.isfinite(time) or time < 0:
            raise InputError("", "--times", f"{part.strip()} is not a time", "give times in ms, zero or later")
        if time in times:
            raise InputError("", "--times", f"{part.strip()} is given twice", "give each time once")
        times.append(time)
    return sorted(times)


def read_labels(text: Optional[str], runs: int) -> Optional[List[str]]:
    if text is None:
        return None
    labels = [label.strip() for label in text.split(",")]
    if len(labels) != runs:
        raise InputError("", "--labels", f"{len(labels)} labels for {runs} runs",
                         "give one per run, separated by commas")
    for label in labels:
        if not label:
            raise InputError("", "--labels", "a label is empty", "give one per run, separated by commas")
        if labels.count(label) > 1:
            raise InputError("", "--labels", f"'{label}' is given twice", "give each run its own")
    return labels


def check_comparable(runs: Sequence[Run], times: Sequence[float]) -> None:
    """All runs must reach all times, and their centre lines must contain the first run's."""
    reference = runs[0]
    for run in runs:
        waves = run.pressure
        path = run.folder / "centerline_pressure.csv"
        for time in times:
            if not waves.covers(time):
                raise InputError(path, "--times", f"{time:g} ms is outside the run",
                                 f"give times between {waves.times[0]:g} and {waves.times[-1]:g} ms")
        if not waves.covers_line(reference.pressure.z):
            z = reference.pressure.z
            raise InputError(path, "z_mm", f"runs from {waves.z[0]:g} to {waves.z[-1]:g} mm, the first run's from "
                             f"{z[0]:g} to {z[-1]:g} mm", "compare runs on the same geometry")


def default_title(runs: Sequence[Run]) -> str:
    titles = {run.title for run in runs}
    if len(titles) == 1 and "" not in titles:
        return titles.pop()
    return "Pressure along the centre line"
