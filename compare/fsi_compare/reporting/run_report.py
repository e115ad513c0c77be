"""`fsi-compare report`: finished runs beside each other in one HTML file through which the reader moves in time."""

import argparse
from typing import TYPE_CHECKING, NamedTuple, Sequence

from ..base.errors import InputError, say_note
from ..base.files import together
from ..base.options import Commands, add_command, add_count, add_folders, add_labels, add_output, add_usual
from ..results.comparison import difference
from ..results.line import Line
from ..results.run import RunResults, open_run
from ..runs.differences import Difference
from ..runs.coupling import with_coupling
from ..runs.labels import folder_labels, read_labels, title_of
from ..runs.samples import CENTRE_LINE
from ..runs.verification import find_verification
from ..runs.work_units import about_machines, notes_on_work, per_step
from .column import Column, Facts, work_column
from .error_bars import add_error_bars
from .first_read import case_lines, constants_table, cost_table, cycles_table, openings_table, thickness_table
from .first_read import trust_table, word_of
from .layout import Table, say_written
from .matplotlib_loader import load_matplotlib
from .pressure import MOST_TIMES, read_times
from .samples import sample_differences, sample_table

if TYPE_CHECKING:
    from .report import Report

MOST_RUNS = 24
MOST_ROWS = 40  # of a table that is open from the start

DESCRIPTION = """\
One HTML file of finished runs, which needs no network: pressure along the centre
line, displacement of the wall, flow and pressure of each opening. The reader moves
through time with a slider, switches runs on and off, reads values under the pointer
and zooms. Pictures of the same stay for print and without JavaScript. Writes to
OUTDIR: report.html, report.md, and every table and picture as a file of its own.
"""


EXAMPLE = """\
example:
  fsi-compare report results/monolithic results/partitioned -o results/report
"""


def add_parser(commands: Commands, version: str) -> None:
    command = add_command(commands, "report", report, "finished runs in one HTML file that plays", DESCRIPTION, EXAMPLE)
    add_folders(command)
    add_output(command, "results/report")
    command.add_argument("--times", metavar="T,T,...", help="times of the pictures in ms (default: six over the runs)")
    add_labels(command, "their folders'")
    command.add_argument("--title", help="heading of the report (default: the runs' title)")
    add_count(command, "--frames", "times at which the vessel is shown (default: up to 100, fewer of large meshes)")
    add_usual(command, version, "accepted as by all programs; a report is quick on one thread")


def report(options: argparse.Namespace) -> int:
    """Reads all runs and checks everything before the first file is written."""
    if len(options.folders) > MOST_RUNS:
        raise InputError("", "DIR", f"{len(options.folders)} runs do not fit a report", f"give at most {MOST_RUNS}")
    times = read_times(options.times, MOST_TIMES)
    labels = read_labels(options.labels, len(options.folders))
    runs = [open_run(folder) for folder in options.folders]
    if labels is None:
        pairs = zip(folder_labels(options.folders), runs)
        labels = [with_coupling(label, run.program, run.summary) for label, run in pairs]
    check_runs(runs, times)
    bars = [find_verification(run.folder, run.summary) for run in runs]
    tables = [differences_table(runs, labels), sample_table(sample_differences(options.folders), labels)]
    title = title_of(options.title, [run.title for run in runs], "Runs beside each other")
    with together(options.output) as place:
        load_matplotlib()
        from .report import Report
        from .run_player import add_waves
        from .vessel import add_vessel, vessel_of

        vessel = vessel_of(runs, labels)
        page = Report(place, title)
        page.section("What was computed")
        add_first_read(page, runs, labels)
        add_error_bars(page, runs, labels, bars)
        page.section("The vessel")
        of_fields = add_vessel(page, runs, labels, vessel, options.frames)
        page.section("Through time")
        add_waves(page, runs, labels, times)
        if len(runs) > 1:
            page.section("Differences")
            add_differences(page, *tables)
            if of_fields is not None and of_fields.rows:
                page.table(of_fields)
        page.write()
    if not options.quiet:
        machines = about_machines([run.summary for run in runs])
        if machines:
            say_note(machines)
        say_written(options.output, page.written)
    return 0


def add_first_read(page: "Report", runs: Sequence[RunResults], labels: Sequence[str]) -> None:
    """Adds the tables that a reader looks at first."""
    page.list(case_lines(runs, labels))
    page.table(runs_table(runs, labels))
    page.table(trust_table(runs, labels))
    made = (openings_table, cycles_table, constants_table, thickness_table)
    for table in (make(runs, labels) for make in made):
        if table.rows:
            page.table(table)
    page.table(cost_table(runs, labels))


def check_runs(runs: Sequence[RunResults], times: Sequence[float]) -> None:
    """Raises InputError unless there is something to show, and all lines reach the times asked for."""
    if not any(run.has_samples for run in runs):
        remedy = "ask for them in the case, and run it again"
        raise InputError(runs[0].folder, "", "has neither lines nor openings", remedy)
    for run in runs:
        for line in (run.centre_line, run.wall_line, *run.lines.values()):
            for time in times:
                if line is not None:
                    line.at(time, next(iter(line.values)))


RUNS: Sequence[Column[tuple[str, RunResults]]] = (
    Column("run", "run", lambda r: r[0], left=True),
    Column("program", "program", lambda r: r[1].program, left=True),
    Column("case", "title", lambda r: r[1].title, left=True),
    Column(
        "element", "element", lambda r: word_of(r[1].summary, "element"), text=lambda r: element_of(r[1]), left=True
    ),
    Column(csv="geometry", value=lambda r: word_of(r[1].summary, "geometry")),
    Column("nodes", "nodes", lambda r: r[1].summary.get("mesh", {}).get("nodes"), "d"),
    Column("processes", "processes", lambda r: r[1].processes, behind=True),
    Column("steps", "steps", lambda r: r[1].summary.get("totals", {}).get("steps"), "g"),
    Column("end, {unit}", "end", lambda r: end_of(r[1]), "g", "ms"),
    work_column("work units per step", "work_units_per_step", lambda r: per_step(r[1].summary)),
    Column("seconds", "wall", lambda r: r[1].summary.get("totals", {}).get("wall_s"), ".1f", "s"),
)


def runs_table(runs: Sequence[RunResults], labels: Sequence[str]) -> Table:
    return Table("runs", "Runs", RUNS, list(zip(labels, runs)), notes=notes_on_work([run.summary for run in runs]))


def element_of(run: RunResults) -> str:
    return ", ".join(part for part in (word_of(run.summary, name) for name in ("element", "geometry")) if part)


def end_of(run: RunResults) -> float | None:
    """ms, the last time that a line or an opening has; None where there is neither, and in a static run."""
    ends = [line.times[-1] for line in (run.centre_line, run.wall_line) if line is not None]
    ends += [opening.time[-1] for opening in run.openings.values()]
    return float(max(ends)) if ends and not run.static else None


def add_differences(page: "Report", lines: Table, samples: Table) -> None:
    """Along the lines that `fsi-compare pressure` compares, where runs have them, and of all samples. One of them may
    be empty; where both are, the first says so."""
    samples.facts = Facts(samples.columns, samples.records)  # the CSV has all
    samples.records = [(label, found) for label, found in samples.records if found.largest != 0 or found.size != 0]
    if lines.rows or not samples.rows:
        page.table(lines)
    samples.title += " in flows, openings, points, lines and planes"
    samples.notes.append(
        "Of all times that both runs have, in the unit of the column. `of`: the largest value of the first run. What is zero in both is in "
        "the CSV only."
    )
    if len(samples.rows) > MOST_ROWS:
        page.folded(samples.title, [samples])
    elif samples.rows:
        page.table(samples)


def pressure_line(run: RunResults) -> "Line | None":
    """The centre line: along the axis, or the one that was found of a bent tube."""
    return run.centre_line if run.centre_line is not None else run.lines.get(CENTRE_LINE)


class Apart(NamedTuple):
    """A line of a run and that of the first."""

    run: str
    quantity: str
    difference: Difference | None
    levels: int


def _norm(head: str, name: str) -> Column[Apart]:
    return Column(head, name, lambda a: a.difference and getattr(a.difference, name), ".2e", group="relative")


LINES: Sequence[Column[Apart]] = (
    Column("run", "run", lambda a: a.run, left=True),
    Column("quantity", "quantity", lambda a: a.quantity, left=True),
    _norm("maximum norm", "max_relative"),
    _norm("L2 norm", "l2_relative"),
    Column("levels", "levels", lambda a: a.levels, "d"),
)


def differences_table(runs: Sequence[RunResults], labels: Sequence[str]) -> Table:
    """Differences of each run from the first, where both have the line and it has the same extent."""
    records = []
    for run, label in zip(runs[1:], labels[1:]):
        for line, reference, quantity, words in (
            (pressure_line(run), pressure_line(runs[0]), "pressure", "pressure"),
            (run.wall_line, runs[0].wall_line, "radial", "radial displacement"),
        ):
            if line is not None and reference is not None and line.waves(quantity).covers_line(reference.s):
                largest = difference(line, reference, quantity, times=[]).largest
                records.append(Apart(label, words, largest.largest, largest.levels))
    title = f"Largest difference from {labels[0]} over the common time levels"
    note = (
        "The first norm is relative to the largest value of the reference at the same time, the second to its L2 norm "
        "along the line; the largest of all levels that both runs have. A dash: no level in common, or a reference of "
        "zero."
    )
    return Table("differences", title, LINES, records, notes=[note])
