"""Where a run stands that may still go on: numbers and curves from what it has written so far."""

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Sequence

import numpy as np

from ..base.errors import InputError, printable
from ..base.folder_lock import is_left
from ..results.run import open_run
from ..results.units import PER_KPA, time_words

KILLED = "killed"  # it still says that it runs, and holds its folder no more
OVER = ("done", "interrupted", "not converged", "failed", KILLED)  # how a run ends
PLANNED = re.compile(r", (\d+) steps\s*$")
LAST = 10  # steps that the speed is the mean of
BLOCKS, PLAIN = "▁▂▃▄▅▆▇█", "_.-=+*#@"


@dataclass(frozen=True)
class Curve:
    name: str
    unit: str
    values: np.ndarray


@dataclass
class State:
    title: str
    program: str
    status: str
    steps: int = 0
    planned: int | None = None
    time: float = 0.0  # ms
    clock: str = "t = 0 ms"  # the time in words
    step_seconds: float | None = None
    curves: list[Curve] = field(default_factory=list)

    @property
    def over(self) -> bool:
        return self.status in OVER

    @property
    def seconds_left(self) -> float | None:
        if self.planned is None or self.step_seconds is None or self.over:
            return None
        return max(self.planned - self.steps, 0) * self.step_seconds


def state_of(folder: Path) -> State:
    """Reads how far a run is. Raises InputError for a folder that is no run's."""
    left = is_left(folder)  # before its status is read: a run that ends well says so before it gives its folder up
    run = open_run(folder, unfinished=True)
    status = KILLED if left and run.status == "running" else run.status
    state = State(run.title, run.program, status, planned=planned_steps(folder / "run.log"))
    try:
        rows = run.iterations
    except InputError:  # not there yet, or a header without its end
        return state
    if not rows.rows:
        return state
    state.steps, state.time = int(rows["step"][-1]), float(rows["time"][-1])
    state.clock = time_words(f"{state.time:g}", run.static, "t = ")
    state.step_seconds = float(rows["wall"][-LAST:].mean())
    passes = "outer_iterations" if run.program == "fsi-partitioned" else "newton_iterations"
    state.curves.append(Curve("passes" if passes.startswith("outer") else "Newton iterations", "", rows[passes]))
    try:
        for name, opening in run.openings.items():
            state.curves.append(Curve(f"pressure, {printable(name)}", "kPa", opening.mean_pressure / PER_KPA["Pa"]))
            state.curves.append(Curve(f"flow outwards, {printable(name)}", "mm^3/ms", opening.flow))
    except (InputError, ValueError):  # rows of one step are written one by one
        pass
    return state


def planned_steps(log: Path) -> int | None:
    """The number of steps in the log's first line; None for adaptive steps, or without a log."""
    try:
        with open(log, encoding="utf-8", errors="replace") as file:
            found = PLANNED.search(file.readline())
    except OSError:
        return None
    return int(found[1]) if found else None


def thinned_to(values: np.ndarray, most: int) -> np.ndarray:
    """At most that many values, means of neighbours where there are more."""
    if len(values) <= most:
        return values
    return np.array([part.mean() for part in np.array_split(values, most)])


def sparkline(values: np.ndarray, width: int, marks: str = BLOCKS) -> str:
    """A line of marks, the highest for the largest value."""
    shown = thinned_to(values[np.isfinite(values)], width)
    if not len(shown):
        return ""
    low, span = float(shown.min()), float(np.ptp(shown))
    places = (shown - low) / span if span > 0 else np.zeros(len(shown))
    return "".join(marks[min(int(place * len(marks)), len(marks) - 1)] for place in places)


def lines_of(state: State, left: str, width: int, marks: str = BLOCKS) -> Sequence[str]:
    """The lines of the terminal; `left`: words for the seconds that are left."""
    of = f" of {state.planned}" if state.planned else ""
    speed = f", {state.step_seconds:.3g} s a step" if state.step_seconds is not None else ""
    lines = [f"{state.program}, {state.status}: step {state.steps}{of}, {state.clock}{speed}{left}"]
    names = max((len(curve.name) for curve in state.curves), default=0)
    for curve in state.curves:
        ends = f"{curve.values.min():.4g} to {curve.values.max():.4g} {curve.unit}".rstrip()
        now = f"{curve.values[-1]:.4g}"
        spark = sparkline(curve.values, max(10, width - names - len(ends) - len(now) - 10), marks)
        lines.append(f"  {curve.name:<{names}}  {spark}  {now} ({ends})")
    return lines
