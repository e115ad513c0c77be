"""What the runs of a family say: bars of all quantities by driver, and bands of curves."""

from dataclasses import dataclass, field, replace
from typing import Any, Callable, Mapping, Sequence

import numpy as np

from ..study.study_run import StudyRun
from .curve_norms import Curve, Stretch, norm_of, on, size_of
from .direction import FACTOR, LEAST_ORDER, WIDENED, Part
from .doubt import doubt, on_common_points
from .family import CaseFacts, Member
from .quantities import Quantity, chosen, curves_of, quantities_of
from .verdict import NOT_IN_RANGE, Bar, Value, bar_of, inherited

Curves = Mapping[Member, Mapping[str, Curve]]  # of each member, by name
Size = Callable[[Member], float]


@dataclass(frozen=True)
class Judged:
    """A quantity of a driver with its bar."""

    driver: str
    quantity: Quantity
    bar: Bar
    values: tuple[Value, ...]  # of all members; of a curve how far each is from the user's own
    own: Curve | None = None  # that the value is of; of the coarsest mesh where the user's own is missing

    def apart(self, other: Curve) -> float:
        """Difference of another run's value."""
        stretch = self.quantity.whole
        if stretch is None or self.own is None:
            return abs(self.quantity.of(other) - self.bar.value)
        return norm_of(self.own, stretch)(on(self.own, other, stretch) - on(self.own, self.own, stretch))


@dataclass(frozen=True)
class Band:
    """A curve over time, or a line at one time, with what it may be off by at each place."""

    driver: str
    name: str
    unit: str
    x: np.ndarray  # ms, or mm along a line
    values: np.ndarray
    half_width: np.ndarray
    along: bool = False  # a line


@dataclass
class FamilyRuns:
    """One driver's finished members, and why others are missing."""

    driver: str
    runs: dict[Member, StudyRun]

    @property
    def done(self) -> dict[Member, StudyRun]:
        return {member: run for member, run in self.runs.items() if run.done}

    @property
    def failures(self) -> dict[Member, StudyRun]:
        return {member: run for member, run in self.runs.items() if not run.done}

    @property
    def own(self) -> StudyRun | None:
        """The run that the bars are of; None: it is missing."""
        return next((run for member, run in self.done.items() if member.is_own), None)

    def read(self) -> dict[Member, dict[str, Curve]]:
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
    """The member with sizes relative to another's."""
    sizes_of = same_size(member.mesh / centre.mesh, 1e-6), same_size(member.step / centre.step, 1e-6)
    return Member(*sizes_of, member.looser, member.other)


def same_size(size: float, near: float = 1e-9) -> float:
    """The size without round-off, so that equal ones are the same."""
    return 1.0 if abs(size - 1) < near else round(size, 9)


def sizes(runs: Mapping[Member, StudyRun]) -> dict[float, float]:
    """Real sizes of elements relative to the user's own by their planned ones, from the numbers of cells: counts are
    whole, and a mesh generator makes of a size what it can. Cells go with size^-d; d, the number of directions that are
    refined, is that of all meshes together."""
    counts: dict[float, float] = {}
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


SAME_AS_ASKED = (0.5, 2.0)  # real ratio of two meshes' sizes, as a power of the planned one


def missed_sizes(runs: Mapping[Member, StudyRun]) -> str:
    """A sentence that meshes have other sizes than asked for, as where a script bounds them, so that they do not show
    what finer elements change; empty: they have not."""
    real = sizes(runs)
    planned = sorted(real, reverse=True)
    for coarse, fine in zip(planned, planned[1:]):
        power = np.log(max(real[coarse] / real[fine], 1e-9)) / np.log(coarse / fine)
        if not SAME_AS_ASKED[0] <= power <= SAME_AS_ASKED[1]:
            return (
                f"elements of sizes {coarse:.3g} and {fine:.3g} differ in length by a factor of {real[coarse] / real[fine]:.3g}, "
                f"not {coarse / fine:.3g}: let nothing but the script's sizes decide how long they are"
            )
    return ""


def judge(
    family: FamilyRuns,
    curves: Curves,
    facts: CaseFacts,
    times: Sequence[float],
    names: Sequence[str],
    additive: bool = False,
) -> list[Judged]:
    """Bars of all quantities of the user's own run. `additive`: it may be missing where column and row tell it
    (verdict.py); the quantities are then those of the coarsest mesh by the own step."""
    own = next((member for member in curves if member.is_own), None)
    if own is None and additive:
        row = [member for member in curves if member.step == 1 and not (member.looser or member.other)]
        own = max(row, key=lambda member: member.mesh) if row else None
    if own is None:
        return []
    curves = on_common_points(curves)
    real, missed = sizes(family.done), missed_sizes(family.done)
    judging = _Judging(family.driver, curves, curves[own], real, facts, additive, missed)
    found = (judging.judged(quantity) for quantity in chosen(quantities_of(curves[own], facts.asked(times)), names))
    return [one for one in found if one is not None]


@dataclass
class _Judging:
    """Judges the quantities of one driver's family."""

    driver: str
    curves: Curves
    own: Mapping[str, Curve]
    real: Mapping[float, float]
    facts: CaseFacts
    additive: bool
    missed: str  # what forbids all bars
    _whole: dict[tuple[str, Stretch], Bar | None] = field(default_factory=dict)

    def judged(self, quantity: Quantity) -> Judged | None:
        """The quantity's bar; None where nothing can be said of the user's own run."""
        if quantity.whole is not None:
            bar = self._of_curve(quantity, quantity.whole)
            return None if bar is None else self._doubted(quantity, bar, self._distances(quantity))
        values = self._values(quantity.curve, quantity.of)
        whole = None if quantity.held_by is None else self._of_curve(quantity, quantity.held_by)
        orders, held = self._orders(quantity), whole if quantity.is_norm else None
        bar = bar_of(values, quantity.scale, *orders, self.facts.element, self.additive, curve=held)
        if (
            bar is not None
            and whole is not None
            and not bar.given
            and whole.given
            and _bounds(whole, bar.value, values)
        ):
            bar = inherited(bar, whole)
        return None if bar is None else self._doubted(quantity, bar, values)

    def _orders(self, quantity: Quantity) -> tuple[float, float]:
        return self.facts.space_order(quantity.is_pressure), self.facts.time_order

    def _values(self, name: str, of: Callable[[Curve], Any]) -> tuple[Value, ...]:
        return tuple(
            Value(self.real.get(m.mesh, m.mesh), m.step, of(found[name]), m.looser, m.other)
            for m, found in self.curves.items()
            if name in found
        )

    def _of_curve(self, quantity: Quantity, stretch: Stretch) -> Bar | None:
        """The bar of the curve's error itself."""
        key = quantity.curve, stretch
        if key not in self._whole:
            grid = self.own[quantity.curve]
            norm = norm_of(grid, stretch)
            values = self._values(quantity.curve, lambda curve: on(grid, curve, stretch))
            orders = self._orders(quantity)
            self._whole[key] = bar_of(values, size_of(grid, stretch), *orders, self.facts.element, self.additive, norm)
        return self._whole[key]

    def _distances(self, quantity: Quantity) -> tuple[Value, ...]:
        """Distances of all members' curves from the user's own, or from what stands for it."""
        assert quantity.whole is not None
        grid, stretch = self.own[quantity.curve], quantity.whole
        norm, own = norm_of(grid, stretch), on(grid, grid, stretch)
        return self._values(quantity.curve, lambda curve: norm(on(grid, curve, stretch) - own))

    def _doubted(self, quantity: Quantity, bar: Bar, values: tuple[Value, ...]) -> Judged:
        curves = [of[quantity.curve] for of in self.curves.values() if quantity.curve in of]
        advice = self.missed or doubt(quantity, curves, self.facts)
        if advice:
            bar = replace(bar, verdict=NOT_IN_RANGE, advice=advice)
        return Judged(self.driver, quantity, bar, values, self.own[quantity.curve])


def _bounds(whole: Bar, own: float, values: Sequence[Value]) -> bool:
    """Whether the curve's bar holds the number of each finer member, as it must where both are read at the same levels:
    a norm over a kink in time depends on the levels themselves."""
    finer = [v.value for v in values if v.mesh <= 1 and v.step <= 1 and not (v.looser or v.other)]
    return all(abs(value - own) <= whole.total for value in finer)


def bands(family: FamilyRuns, curves: Curves, judged: Sequence[Judged]) -> list[Band]:
    """Bands of curves whose error has a bar: of points over time, of lines along them at the end and at the times asked
    for. At each place the own curve's distance from the finest in each direction, and what that direction's order says
    is left beyond it; the largest of the neighbourhood, since a wave that comes at another moment crosses the own curve
    where the distance is zero."""
    own = next((member for member in curves if member.is_own), None)
    found: list[Band] = []
    if own is None:
        return found
    curves = on_common_points(curves)
    for one in judged:
        stretch, grid = one.quantity.whole, curves[own].get(one.quantity.curve)
        if stretch is None or grid is None or stretch.largest or not one.bar.given:
            continue
        if stretch.time is None and grid.values.shape[1] > 1:
            continue
        rows = {m: on(grid, of[grid.name], stretch) for m, of in curves.items() if grid.name in of}
        width = np.full(len(rows[own]), one.bar.solver + one.bar.together)
        width = width + _width(rows, own, one.bar.mesh, lambda m: m.mesh, lambda m: m.step)
        width = width + _width(rows, own, one.bar.step, lambda m: m.step, lambda m: m.mesh)
        along = stretch.time is not None
        name, x = (one.quantity.name, grid.s) if along else (grid.name, grid.times)
        found.append(Band(family.driver, name, grid.unit, x, rows[own], _widest(width), along))
    return found


def _width(rows: Mapping[Member, np.ndarray], own: Member, part: Part, size: Size, other: Size) -> np.ndarray:
    """Part of a band by one direction, on either side of the curve; the factors are those of the bar."""
    line = sorted((m for m in rows if not (m.looser or m.other) and other(m) == 1), key=size)
    if len(line) < 2:
        return np.zeros(len(rows[own]))
    finest, coarser = line[:2]
    ratio = size(coarser) / size(finest)
    order = max(part.used, LEAST_ORDER)
    known = np.abs(rows[own] - rows[finest])
    left = FACTOR.get(part.state, FACTOR[WIDENED]) * np.abs(rows[coarser] - rows[finest]) / (ratio**order - 1)
    there = ~np.isnan(known + left)
    if not there.any():
        return np.full(len(known), part.bar)
    place = np.arange(len(known))
    return np.interp(place, place[there], (known + left)[there])


def _widest(width: np.ndarray) -> np.ndarray:
    """Over a fiftieth of the curve on both sides."""
    reach = max(1, len(width) // 50)
    padded = np.pad(width, reach, mode="edge")
    return np.max(np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1), axis=1)
