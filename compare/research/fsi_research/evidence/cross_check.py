"""How each run ended, and whether what it says it solved is what the other driver finds."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

import numpy as np

from fsi_compare.base.errors import InputError
from fsi_compare.base.files import is_file
from fsi_compare.runs.differences import largest_difference
from fsi_compare.runs.pressure_waves import PressureWaves
from fsi_compare.runs.run_folder import ALONG_AXIS
from fsi_compare.runs.samples import LINES, requested_line
from fsi_compare.study.study_run import CRASHED, DONE, NOT_CONVERGED, OUT_OF_TIME, REFUSED, StudyRun
from fsi_compare.study.study_run import WRONG as NOT_FINITE

AGREES = "converged"  # and no time level is further from the other driver's than the bound
UNCHECKED = "converged, unchecked"  # the other driver was not run there, found nothing, or broke off earlier
DEVIATES = "deviates"  # of a method that does not iterate and so claims no agreement
FAR = "far off"  # of such a method: by more than what is of use
WRONG = "wrong"  # it says converged, and the other driver says otherwise
OUTCOMES = (AGREES, UNCHECKED, DEVIATES, FAR, NOT_CONVERGED, OUT_OF_TIME, REFUSED, WRONG, NOT_FINITE, CRASHED)
# Such a method misses a jump of the load by its nature, where the levels soon after are small: its difference is
# relative to the largest pressure of all levels. A short pulse is much of that, and the same in all methods: so the
# displacement counts, too. Beyond half of either nothing of the wave is right, and the run must say so (`unchecked` in
# its summary).
USABLE = 0.1
ONE_PASS_BOUND = 0.5
FAULTS = (WRONG, NOT_FINITE, CRASHED)  # what may happen nowhere
BOUND = 1e-3  # of the difference, relative to the largest value of a time level: a thousand interface tolerances

Point = Tuple[str, str, Any]  # case, quantity, value


@dataclass(frozen=True)
class Cell:
    """One method at one point: a case, and a value of what is varied."""

    run: StudyRun
    outcome: str  # one of OUTCOMES
    levels: int  # that the run finished, of failed runs too
    # Largest over the time levels in common, relative to the largest of each level; of a method with one pass, of all.
    difference: Optional[float]
    against: Optional[StudyRun]  # whose levels these are
    # Of a method that does not iterate: of the wall's radial displacement, Euclidean norm over levels and points,
    # relative.
    displacement: Optional[float] = None

    @property
    def method(self) -> str:
        return self.run.request.method.name

    @property
    def off(self) -> Optional[float]:
        """The larger of both differences."""
        return max((d for d in (self.difference, self.displacement) if d is not None), default=None)

    @property
    def warns(self) -> bool:
        """The run itself says that its error is not small."""
        return bool(self.run.summary.get("unchecked"))


def quantity(run: StudyRun) -> str:
    return next(iter(run.request.values))


def point_of(run: StudyRun) -> Point:
    name = quantity(run)
    return run.request.case, name, run.request.values[name]


def has_pressure(folder: Path) -> bool:
    """Whether there is a line to read the pressure along. Raises InputError."""
    lines = folder / LINES
    return is_file(folder / ALONG_AXIS) or (is_file(lines) and requested_line(lines) is not None)


def waves_of(run: StudyRun) -> Optional[PressureWaves]:
    """Pressure along the centre line, or the line that the case asks for, in Pa; of a wall without fluid its
    displacements (see below). None: no finished time level."""
    try:
        if has_pressure(run.folder):
            return run.pressure
    except (InputError, KeyError, IndexError, ValueError):
        return None
    return displacements_of(run)


def displacements_of(run: StudyRun) -> Optional[PressureWaves]:
    """The radial displacement of the wall's inner face in mm, in the pressure's place. None: no finished time level."""
    try:
        columns = run.columns("wall_displacement.csv")
        points = int((columns["time_ms"] == columns["time_ms"][0]).sum())
        shape = (-1, points)
        return PressureWaves(
            columns["time_ms"].reshape(shape)[:, 0], columns["z_mm"][:points], columns["radial_mm"].reshape(shape)
        )
    except (InputError, KeyError, IndexError, ValueError):
        return None


def cells(runs: Sequence[StudyRun], references: Sequence[str], one_pass: Sequence[str], bound: float) -> List[Cell]:
    """A cell for each run. `references`: methods of one driver that the others are held against, the best first;
    `one_pass`: methods that do not iterate until fluid and wall agree, or not on all that they share."""
    points: Dict[Point, List[StudyRun]] = {}
    for run in runs:
        points.setdefault(point_of(run), []).append(run)
    found = {}
    for there in points.values():
        found.update({id(run): cell for run, cell in _at_point(there, references, one_pass, bound)})
    return [found[id(run)] for run in runs]


def _at_point(
    runs: Sequence[StudyRun], references: Sequence[str], one_pass: Sequence[str], bound: float
) -> List[Tuple[StudyRun, Cell]]:
    waves = {run.request.method.name: waves_of(run) for run in runs}
    by_name = {run.request.method.name: run for run in runs}
    reference = next((by_name[name] for name in references if waves.get(name) is not None), None)
    return [(run, _cell(run, reference, by_name, waves, one_pass, bound)) for run in runs]


def _cell(
    run: StudyRun,
    reference: Optional[StudyRun],
    by_name: Mapping[str, StudyRun],
    waves: Mapping[str, Optional[PressureWaves]],
    one_pass: Sequence[str],
    bound: float,
) -> Cell:
    name = run.request.method.name
    own = waves[name]
    levels = 0 if own is None else len(own.times)
    against: Optional[StudyRun] = None
    difference: Optional[float] = None
    displacement: Optional[float] = None
    common = 0
    if own is not None and reference is not None:
        if run is reference:
            against, difference, common = _confirmed_by(run, own, by_name, waves, one_pass)
        else:
            against, expected = reference, waves[reference.request.method.name]
            assert expected is not None, "a reference has waves"
            difference, common = difference_of(expected, own, of_all=name in one_pass)
            displacement = _displacement(reference, run) if name in one_pass else None
    found = Cell(run, AGREES, levels, difference, against, displacement)
    outcome = run.status if run.status != DONE else AGREES
    if run.status == NOT_FINITE:
        outcome = NOT_FINITE
    elif found.off is not None and found.off > bound and run.status not in (CRASHED,):
        if name not in one_pass or (run.done and found.off > ONE_PASS_BOUND and not found.warns):
            outcome = WRONG
        elif run.done:
            outcome = FAR if found.off > USABLE else DEVIATES
    elif run.done and (difference is None or common < levels):
        outcome = UNCHECKED
    return replace(found, outcome=outcome)


def _displacement(reference: StudyRun, other: StudyRun) -> Optional[float]:
    """Difference at the wall's inner face over the levels and points in common; None: there are none, or no motion."""
    expected, own = displacements_of(reference), displacements_of(other)
    if expected is None or own is None or not own.covers_line(expected.z):
        return None
    own = own.on(expected.z)
    common = [t for t in expected.times if own.level(t) is not None]
    size = float(np.sqrt(sum(np.sum(expected.at(t) ** 2) for t in common)))
    return float(np.sqrt(sum(np.sum((own.at(t) - expected.at(t)) ** 2) for t in common))) / size if size > 0 else None


def _confirmed_by(
    run: StudyRun,
    own: PressureWaves,
    by_name: Mapping[str, StudyRun],
    waves: Mapping[str, Optional[PressureWaves]],
    one_pass: Sequence[str],
) -> Tuple[Optional[StudyRun], Optional[float], int]:
    """The run of the other driver that bears this one out best: over most time levels, then most closely."""
    best: Optional[Tuple[StudyRun, float, int]] = None
    for name, other in by_name.items():
        theirs = waves[name]
        if theirs is None or name in one_pass or other.request.method.program == run.request.method.program:
            continue
        difference, common = difference_of(own, theirs)
        if difference is not None and (best is None or (-common, difference) < (-best[2], best[1])):
            best = other, difference, common
    return best or (None, None, 0)


def difference_of(reference: PressureWaves, other: PressureWaves, of_all: bool = False) -> Tuple[Optional[float], int]:
    """(largest difference relative to the reference's largest of the same level, or `of_all`; levels in common)."""
    if not other.covers_line(reference.z):
        return None, 0
    over_time = largest_difference(reference, other)
    if over_time.largest is None:
        return None, over_time.levels
    if not of_all:
        return over_time.largest.max_relative, over_time.levels
    largest = max(float(abs(reference.at(t)).max()) for t in reference.times if other.level(t) is not None)
    return (over_time.largest.max_norm / largest if largest > 0 else None), over_time.levels
