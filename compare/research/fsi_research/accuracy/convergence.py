"""Observed orders in element size and time step, from the runs of a study that differ in nothing else."""

from dataclasses import dataclass
from typing import Dict, List, Sequence, Tuple

from fsi_compare.runs.waves import QUANTITIES, relative_difference
from .measured import SOLVERS, STEP, Measured
from .observed_order import SelfConvergence, self_convergence, slope
from .plan import Plan

SPACE, TIME = "element size", "time step"


@dataclass(frozen=True)
class Series:
    """At least three runs from coarse to fine in one thing, all else equal."""

    what: str  # SPACE or TIME
    runs: Sequence[Measured]
    sizes: Sequence[float]  # nodes^(-1/3), or ms
    fixed: str  # what the runs have in common
    distances: Dict[str, List[float]]  # by quantity's column: from each run to the next, relative to that
    orders: Dict[str, List[SelfConvergence]]  # of each three successive ones
    against_reference: Dict[str, float]  # slope of all errors against the reference; NaN: there is none

    @property
    def finest(self) -> Measured:
        return self.runs[-1]

    def last(self, column: str) -> SelfConvergence:
        return self.orders[column][-1]


def series(measured: Sequence[Measured], plan: Plan) -> List[Series]:
    found: List[Series] = []
    chosen = [m for m in measured if m.run.request.method.name == plan.method and _plain(m)]
    for what in (SPACE, TIME):
        groups: Dict[Tuple, List[Measured]] = {}
        for m in chosen:
            case, mesh, settings = m.discretisation
            if what == SPACE and mesh in plan.family:
                groups.setdefault((case, settings), []).append(m)
            elif what == TIME:
                groups.setdefault((case, mesh, tuple(s for s in settings if s[0] != STEP)), []).append(m)
        for group in groups.values():
            sizes = {id(m): m.nodes ** (-1 / 3) if what == SPACE else m.step for m in group}
            group = sorted(group, key=lambda m: -sizes[id(m)])
            if len({sizes[id(m)] for m in group}) == len(group) >= 3:
                found.append(_series(what, group, [sizes[id(m)] for m in group], plan))
    return found


def _plain(m: Measured) -> bool:
    """Whether nothing of the solver is varied."""
    own = m.run.request.method.settings
    return all(not key.startswith(SOLVERS) or own.get(key) == value for key, value in m.run.request.settings.items())


def _series(what: str, runs: Sequence[Measured], sizes: Sequence[float], plan: Plan) -> Series:
    times = plan.times(runs[0].run.request.case)
    distances, orders, slopes = {}, {}, {}
    for quantity in QUANTITIES:
        name = quantity.column
        apart = [relative_difference(a.waves[name], b.waves[name], times) for a, b in zip(runs, runs[1:])]
        distances[name] = apart
        orders[name] = [self_convergence(sizes[i : i + 3], apart[i : i + 2]) for i in range(len(runs) - 2)]
        found = slope(sizes, [m.total[name] for m in runs])
        slopes[name] = float("nan") if found is None else found
    finest = runs[-1]
    words = finest.equations.split(", ")
    fixed = ", ".join([finest.run.request.case, *(words[1:] if what == SPACE else [words[0], *words[2:]])])
    return Series(what, runs, sizes, fixed, distances, orders, slopes)
