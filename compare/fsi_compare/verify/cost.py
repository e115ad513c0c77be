"""Seconds and memory of a member before it is started, from those that have run.

    seconds = start + c h^-alpha (steps)^1,    memory = m0 + m1 h^-beta

start, of the program itself, does not grow. alpha is fitted to the members of several meshes; of too few it is a usual
one, of quadratic elements that of a sparse factorisation."""

from dataclasses import dataclass
from typing import Mapping, Sequence

import numpy as np

from ..study.study_run import StudyRun
from .family import Member

USUAL_POWER = {2: 2.6, 3: 4.2}  # of 1/h, by dimension: a little more than the number of cells
LINEAR_POWER = {2: 2.3, 3: 3.3}  # the same of linear elements
LONGEST_START = 1.0  # s: what a start takes beyond grows with the mesh
RANGE = {2: (1.5, 3.6), 3: (2.5, 6.5)}  # what a fit is held within


@dataclass(frozen=True)
class Costs:
    """Seconds and memory at sizes of elements and steps relative to the user's own."""

    seconds_own: float
    power: float
    memory_own: float  # MiB
    memory_power: float
    step_power: float
    start: float = 0.0  # s, of each run

    def seconds(self, mesh: float, step: float) -> float:
        return float(self.start + self.seconds_own * mesh**-self.power * step**-self.step_power)

    def memory(self, mesh: float) -> float:
        return float(self.memory_own * mesh**-self.memory_power)


def learn(runs: Mapping[Member, StudyRun], dimension: int, element: str = "p2p1") -> Costs | None:
    """Fits costs to the runs; None where no member has run."""
    done = {member: run for member, run in runs.items() if run.done and not member.looser and run.seconds > 0}
    if not done:
        return None
    low, high = RANGE[dimension]
    usual = (LINEAR_POWER if element == "p1" else USUAL_POWER)[dimension]
    start = min(_start(run) for run in done.values())
    seconds = {member: run.seconds - start for member, run in done.items()}
    steps, meshes = {m.step for m in done}, {m.mesh for m in done}
    rows = [{1 / m.mesh: s for m, s in seconds.items() if m.step == step} for step in steps]
    columns = [{1 / m.step: s for m, s in seconds.items() if m.mesh == mesh} for mesh in meshes]
    power = _slope(_dearest(rows), usual, low, high)
    step_power = _slope(_dearest(columns), 1.0, 0.5, 1.0)
    memory = {m: float(r.summary.get("peak_memory_MiB", 0.0)) for m, r in done.items()}
    of_mesh = {1 / m.mesh: value for m, value in memory.items() if value > 0}
    memory_power = _slope(of_mesh, power * 0.8, 0.0, high)
    base = max(done, key=lambda m: seconds[m])  # the longest run tells most
    seconds_own = seconds[base] * base.mesh**power * base.step**step_power
    widest = min(memory, key=lambda m: m.mesh)
    return Costs(seconds_own, power, memory[widest] * widest.mesh**memory_power, memory_power, step_power, start)


def _start(run: StudyRun) -> float:
    """Seconds that are none of the time steps; 0 where it is not known."""
    stepping = run.summary.get("totals", {}).get("wall_s")
    return max(0.0, min(run.seconds - float(stepping), LONGEST_START)) if isinstance(stepping, (int, float)) else 0.0


def _dearest(lines: Sequence[Mapping[float, float]]) -> Mapping[float, float]:
    """The line of the longest run, of those with two members at least."""
    return max((line for line in lines if len(line) > 1), key=lambda line: max(line.values()), default={})


def _slope(points: Mapping[float, float], usual: float, low: float, high: float) -> float:
    """Slope of the logarithms, by the two longest: a start-up time flattens the cheap end."""
    if len(points) < 2:
        return usual
    (x0, y0), (x1, y1) = sorted(points.items())[-2:]
    if x1 <= x0 or y0 <= 0 or y1 <= 0:
        return usual
    return float(np.clip(np.log(y1 / y0) / np.log(x1 / x0), low, high))
