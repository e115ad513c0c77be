"""`fsi-compare accuracy`: how far finished runs are from a reference, in space and at chosen times, and their cost."""

import argparse
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Sequence

import numpy as np

from ..base.errors import InputError, printable
from ..base.files import exists
from ..base.options import Commands, add_command, add_folders, add_labels, add_output, add_times, add_title, add_usual
from .column import Column, Facts, work_column
from .layout import Table, hand_out
from .pressure import read_times
from ..runs.columns import read_iterations
from ..runs.labels import folder_labels, read_labels
from ..runs.run_folder import read_finished
from ..runs.work_units import in_all, notes_on_work
from ..runs.reference import FILE as DESCRIPTION_FILE, WaveReference, read_reference
from ..runs.waves import PRESSURE, QUANTITIES, WINDOW, WRITTEN, Quantity, Waves, read_run, relative_difference

TIMES = "1.5,3,4.5,6"
SAME_STEP = 1e-6  # relative

HEADS = {"pressure_Pa": "pressure, %", "averaged_pressure_Pa": "averaged pressure, %", "radial_mm": "displacement, %"}
CSV = {"pressure_Pa": "pressure", "averaged_pressure_Pa": "averaged_pressure", "radial_mm": "radial"}

DESCRIPTION = f"""\
How far runs are from a reference: relative L2 norm along z of the centre-line pressure, of its mean over {WINDOW} ms
around each time (where the run covers them) and of the radial displacement of the inner wall, at each of the times,
their mean and the worst of them. REFERENCE is a finished run, or a folder of
compare/research/studies/references in the source tree. Runs of any element and geometry may be mixed: a tube of
tetrahedra and its axisymmetric twin write the same files. With the reference's time step in all runs what is left is the error in space. Writes to OUTDIR:
  accuracy.csv   all errors, in full precision
  accuracy.md    the table for documents"""

EXAMPLES = """\
examples:
  fsi-compare accuracy results/axisymmetric-fine results/whole results/quarter results/axisymmetric
  fsi-compare accuracy compare/research/studies/references/neo-hookean results/small-steps --times 1.5,3,4.5,6,7.5,9
"""


@dataclass(frozen=True)
class Accuracy:
    """Errors and cost of one run."""

    label: str
    element: str
    geometry: str
    nodes: int | None
    step: float  # ms
    steps: int
    seconds: float  # of all time steps
    errors: dict[str, list[float]]  # by quantity's column: at each time, relative
    summary: dict  # all of summary.json

    def worst(self, quantity: Quantity) -> float:
        values = self.errors[quantity.column]
        return math.nan if any(math.isnan(value) for value in values) else max(values)

    def mean(self, quantity: Quantity) -> float:
        return float(np.mean(self.errors[quantity.column]))


def add_parser(commands: Commands, version: str) -> None:
    help = "errors of finished runs against a reference"
    command = add_command(commands, "accuracy", accuracy, help, DESCRIPTION, EXAMPLES)
    command.add_argument("reference", metavar="REFERENCE", type=Path, help="result folder, or a kept reference")
    add_folders(command)
    add_output(command, "results/accuracy")
    add_times(command, TIMES)
    add_labels(command)
    add_title(command, "Accuracy of the runs")
    add_usual(command, version, "accepted as by all programs; this comparison is quick on one thread")


def accuracy(options: argparse.Namespace) -> int:
    """Reads all runs before the first file is written."""
    times = read_times(options.times)
    labels = read_labels(options.labels, len(options.folders)) or folder_labels(options.folders)
    reference = read_any_reference(options.reference, times)
    found = [read_accuracy(folder, label, reference, times) for folder, label in zip(options.folders, labels)]
    return hand_out(accuracy_table(found, reference, times, printable(options.title)), options.output, options.quiet)


def read_any_reference(folder: Path, times: Sequence[float]) -> WaveReference:
    """A kept reference, or a finished run with its means around `times`. Raises InputError."""
    if exists(folder / DESCRIPTION_FILE):
        return read_reference(folder)
    read_finished(folder)
    require_lines(folder)
    waves = read_run(folder, times)
    return WaveReference(folder, "a finished run", {}, waves, {}, _step(waves))


def require_lines(folder: Path) -> None:
    """Refuses a finished run of a vessel that bends or branches, or without fluid or wall. Raises InputError."""
    for q in WRITTEN:
        if not exists(folder / q.file):
            problem = "is missing, though the run is finished: only straight tubes with fluid and wall have one"
            remedy = "compare others by fsi-compare pressure or fsi-compare report"
            raise InputError(folder / q.file, "", problem, remedy)


def _step(waves: dict[str, Waves]) -> float:
    """The last one, ms."""
    times = waves[PRESSURE.column].times
    return float(times[-1] - times[-2]) if len(times) > 1 else float(times[-1])


def read_accuracy(folder: Path, label: str, reference: WaveReference, times: Sequence[float]) -> Accuracy:
    """Reads a run. Raises InputError unless it is finished and it and the reference cover the times and the line."""
    summary = read_finished(folder)
    require_lines(folder)
    waves = read_run(folder, times)
    errors = {}
    for q in QUANTITIES:
        own, exact = waves[q.column], reference.waves[q.column]
        for where, one in ((reference.folder, exact), (folder, own)):
            outside = [time for time in times if not one.covers(time)]
            if outside:
                remedy = f"give times between {one.times[0]:g} and {one.times[-1]:g} ms"
                raise InputError(where / q.file, "--times", f"{outside[0]:g} ms is outside of it", remedy)
        if own.z[0] > exact.z[0] + 1e-6 or own.z[-1] < exact.z[-1] - 1e-6:
            spans = [f"from {z[0]:g} to {z[-1]:g} mm" for z in (own.z, exact.z)]
            problem = f"runs {spans[0]}, the reference {spans[1]}"
            raise InputError(folder / q.file, "z_mm", problem, "compare runs on the same geometry")
        errors[q.column] = [relative_difference(own, exact, [time]) for time in times]
    seconds = read_iterations(folder, ("wall_s",))["wall_s"]
    return Accuracy(
        label=label,
        element=printable(summary.get("element", "p1")),
        geometry=printable(summary.get("geometry", "3d")),
        nodes=summary.get("mesh", {}).get("nodes"),
        step=_step(waves),
        steps=len(seconds),
        seconds=float(seconds.sum()),
        errors=errors,
        summary=summary,
    )


RUNS: Sequence[Column[Accuracy]] = (
    Column("run", "run", lambda a: a.label, left=True),
    Column("element", "element", lambda a: a.element, left=True),
    Column("geometry", "geometry", lambda a: a.geometry, left=True),
    Column("nodes", "nodes", lambda a: a.nodes),
    Column("step", "step", lambda a: a.step, "g", "ms"),
    Column("steps", "steps", lambda a: a.steps),
    work_column("work units", "work_units", lambda a: in_all(a.summary)),
    Column("seconds", "wall", lambda a: a.seconds, ".3g", "s"),
)


def _percents(q: Quantity, times: Sequence[float]) -> list[Column[Accuracy]]:
    """Columns of the error at each time, its mean and its maximum."""

    def column(head: str, value: Callable[[Accuracy], float]) -> Column[Accuracy]:
        def percent(a: Accuracy) -> float | None:
            return None if math.isnan(value(a)) else 100 * value(a)

        return Column(head, value=percent, format=".3g", group=HEADS[q.column])

    def at(place: int) -> Callable[[Accuracy], float]:
        return lambda a: a.errors[q.column][place]

    return [
        *(column(f"{time:g} ms", at(place)) for place, time in enumerate(times)),
        column("mean", lambda a: a.mean(q)),
        column("worst", lambda a: a.worst(q)),
    ]


def _facts(found: Sequence[Accuracy], times: Sequence[float]) -> Facts:
    """A line for each time of each run."""

    def of_run(column: Column[Accuracy]) -> Column[tuple[Accuracy, int]]:
        return Column(csv=column.name, value=lambda r: column.value(r[0]), behind=column.behind)

    def of_quantity(q: Quantity) -> Column[tuple[Accuracy, int]]:
        return Column(csv=f"{CSV[q.column]}_relative_L2", value=lambda r: r[0].errors[q.column][r[1]])

    time: Column[tuple[Accuracy, int]] = Column(csv="time", unit="ms", value=lambda r: times[r[1]])
    columns = [*map(of_run, RUNS), time, *map(of_quantity, QUANTITIES)]
    return Facts(columns, [(one, place) for one in found for place in range(len(times))])


def accuracy_table(found: Sequence[Accuracy], reference: WaveReference, times: Sequence[float], title: str) -> Table:
    notes = [
        f"Relative L2 norm along z of the difference from {reference.folder}. Averaged: over {WINDOW} ms around the "
        "time; no number where run or reference do not cover that."
    ]
    notes += notes_on_work([one.summary for one in found], whole=True)
    steps = {reference.step, *(one.step for one in found)}
    if None in steps or max(steps) - min(steps) > SAME_STEP * max(steps):  # type: ignore[type-var,operator]
        notes.append("Time steps differ: the errors are of space and time together.")
    columns = [*RUNS, *(column for q in QUANTITIES for column in _percents(q, times))]
    return Table("accuracy", title, columns, found, _facts(found, times), notes)
