"""What the runs of a family say: bars of all quantities by driver, and bands of curves."""

from dataclasses import dataclass, replace
from typing import Dict, List, Mapping, Optional, Sequence, Tuple

import numpy as np

from ..running.study_run import StudyRun
from .direction import FACTOR, OUTSIDE, WIDENED
from .doubt import doubt, on_common_points
from .family import CaseFacts, Member
from .quantities import Curve, Quantity, chosen, curves_of, quantities_of
from .verdict import NOT_IN_RANGE, Bar, Value, bar_of


@dataclass(frozen=True)
class Judged:
    """A quantity of a driver with its bar."""

    driver: str
    quantity: Quantity
    bar: Bar
    values: Tuple[Value, ...]  # of all members


@dataclass(frozen=True)
class Band:
    """A curve over time with what it may be off by at each level."""

    driver: str
    name: str
    unit: str
    times: np.ndarray
    values: np.ndarray
    half_width: np.ndarray


@dataclass
class FamilyRuns:
    """Of one driver: finished members, and why others are not."""

    driver: str
    runs: Dict[Member, StudyRun]

    @property
    def done(self) -> Dict[Member, StudyRun]:
        return {member: run for member, run in self.runs.items() if run.done}

    @property
    def failures(self) -> Dict[Member, StudyRun]:
        return {member: run for member, run in self.runs.items() if not run.done}

    @property
    def own(self) -> Optional[StudyRun]:
        """The run that the bars are of; None: it is missing."""
        return next((run for member, run in self.done.items() if member.is_own), None)

    def read(self) -> Dict[Member, Dict[str, Curve]]:
        return {member: curves_of(run.folder) for member, run in self.done.items()}


@dataclass(frozen=True)
class BarsOfRun:
    """Bars with the one run that they are of: another mesh, step or tolerance has others."""

    driver: str
    run: StudyRun
    judged: Sequence[Judged]


def about(family: FamilyRuns, centre: Member) -> FamilyRuns:
    """The same runs with sizes relative to another member's."""
    return FamilyRuns(family.driver, {relative(member, centre): run for member, run in family.runs.items()})


def relative(member: Member, centre: Member) -> Member:
    """With sizes relative to another's."""
    return Member(_same(member.mesh / centre.mesh), _same(member.step / centre.step), member.looser, member.other)


def _same(size: float) -> float:
    return 1.0 if abs(size - 1) < 1e-6 else round(size, 9)


def sizes(runs: Mapping[Member, StudyRun]) -> Dict[float, float]:
    """Real sizes of elements relative to the user's own by their planned ones, from the numbers of cells: counts are whole,
    and a mesh generator makes of a size what it can. Cells go with size^-d; d, the number of directions that are refined,
    is that of all meshes together."""
    counts: Dict[float, float] = {}
    for member, run in runs.items():
        mesh = run.summary.get("mesh", {})
        cells = mesh.get("tetrahedra", mesh.get("triangles", mesh.get("nodes")))
        if cells:
            counts[member.mesh] = float(cells)
    own = counts.get(1.0)
    if not own or len(counts) < 2:
        return {member.mesh: member.mesh for member in runs}
    x = np.array([-np.log(mesh) for mesh in counts])
    y = np.array([np.log(cells / own) for cells in counts.values()])
    directions = float(np.clip(np.sum(x * y) / np.sum(x * x), 0.7, 3.3))
    return {mesh: 1.0 if mesh == 1 else (own / cells) ** (1 / directions) for mesh, cells in counts.items()}


def judge(
    family: FamilyRuns,
    curves: Mapping[Member, Mapping[str, Curve]],
    facts: CaseFacts,
    times: Sequence[float],
    names: Sequence[str],
    additive: bool = False,
) -> List[Judged]:
    """Of all quantities of the user's own run. `additive`: it may be missing where column and row tell it (verdict.py); the
    quantities are then those of the coarsest mesh by the own step."""
    own = next((member for member in curves if member.is_own), None)
    if own is None and additive:
        row = [member for member in curves if member.step == 1 and not (member.looser or member.other)]
        own = max(row, key=lambda member: member.mesh) if row else None
    if own is None:
        return []
    curves = on_common_points(curves)
    real = sizes(family.done)
    found = []
    for quantity in chosen(quantities_of(curves[own], facts.asked(times)), names):
        values = tuple(
            Value(
                real.get(member.mesh, member.mesh),
                member.step,
                quantity.of(of[quantity.curve]),
                member.looser,
                member.other,
            )
            for member, of in curves.items()
            if quantity.curve in of
        )
        orders = facts.space_order(quantity.is_pressure), facts.time_order
        bar = bar_of(values, quantity.scale, *orders, facts.element, additive)
        advice = doubt(quantity, [of[quantity.curve] for of in curves.values() if quantity.curve in of], facts)
        if bar is not None and advice:
            bar = replace(bar, verdict=NOT_IN_RANGE, advice=advice)
        if bar is not None:
            found.append(Judged(family.driver, quantity, bar, values))
    return found


def bands(family: FamilyRuns, curves: Mapping[Member, Mapping[str, Curve]], judged: Sequence[Judged]) -> List[Band]:
    """Of curves at one point whose L2 norm has a bar. At each level the own curve's distance from the finest in each
    direction, and what that direction's order says is left beyond it; the largest over the neighbouring levels, since a wave
    that comes at another moment crosses the own curve where the distance is zero."""
    own = next((member for member in curves if member.is_own), None)
    found: List[Band] = []
    if own is None:
        return found
    for one in judged:
        curve = curves[own].get(one.quantity.curve)
        if (
            curve is None
            or not one.quantity.name.endswith(", L2 norm")
            or not one.bar.given
            or curve.values.shape[1] > 1
        ):
            continue
        width = np.zeros(len(curve.times))
        for along, part in ((0, one.bar.mesh), (1, one.bar.step)):
            line = [
                m
                for m in curves
                if not (m.looser or m.other) and (m.step if along == 0 else m.mesh) == 1 and curve.name in curves[m]
            ]
            line.sort(key=lambda m: m.mesh if along == 0 else m.step)
            if len(line) < 2:
                continue
            finest, next_one = (_at(curves[m][curve.name], curve.times) for m in line[:2])
            ratio = (line[1].mesh / line[0].mesh) if along == 0 else (line[1].step / line[0].step)
            factor = FACTOR.get(part.state, FACTOR[WIDENED])
            order = max(part.used, 1.0) if part.state != OUTSIDE else 1.0
            width += np.abs(curve.values[:, 0] - finest) + factor * np.abs(next_one - finest) / (ratio**order - 1)
        width += one.bar.solver + one.bar.together
        found.append(Band(family.driver, curve.name, curve.unit, curve.times, curve.values[:, 0], _widest(width)))
    return found


def _at(curve: Curve, times: np.ndarray) -> np.ndarray:
    return np.interp(times, curve.times, curve.values[:, 0])


def _widest(width: np.ndarray) -> np.ndarray:
    """Over a fiftieth of the curve on both sides."""
    reach = max(1, len(width) // 50)
    padded = np.pad(width, reach, mode="edge")
    return np.max(np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1), axis=1)
