"""The error bar of one value at the user's own settings: its parts by mesh, step, their product and the solver, and
what can be said of it. A value is a number, or a whole curve with a norm.

    y(h, dt) = y0 + a h^p + b dt^q + c h^p dt^q

a and b come from members that differ in one thing only (direction.py): a from a column of meshes, all by one step, b
from a row of steps, all on one mesh. These are the user's own, or cheaper ones. c comes from members refined in both:
of four members at the corners of a rectangle y11 - y10 - y01 + y00 = c (1 - h^p) (1 - dt^q), which is how much a
difference of meshes changes when the step does. The parts are added up, not their squares: nothing says that they are
independent."""

from dataclasses import dataclass, replace
from typing import Any, Callable, Iterable, Mapping, Sequence

from .curve_norms import CurveNorm
from .direction import NOTHING, OUTSIDE, SILENT, WIDENED, Part, by_elements, part_of, part_of_curves

CONVERGES, BAR_WIDENED = "converges as its elements do", "converges, bar widened"
NOT_IN_RANGE = "not in the range where an error can be given"
TOGETHER_FACTOR = 2.0  # on the product's part
SOLVER_FACTOR = 3.0  # on what a tolerance leaves, whose order in the tolerance is not observed
LOOSER = 10.0  # by which the tolerances of a member are looser
SMALL = 0.1  # share of the bar below which a part does not decide the verdict
NEGLIGIBLE = 1e-3  # of the largest of the curve: so small a part without order widens the bar, and does not forbid it
DETECTED = 1e-7  # relative to the curve's largest: differences below are round-off

Table = Mapping[tuple[float, float], Any]  # values by mesh and step
Measure = Callable[[Any], float]  # norm of a value


@dataclass(frozen=True)
class Value:
    """Value of one member."""

    mesh: float  # size of elements relative to the user's own
    step: float  # the same of steps
    value: Any  # a number, or a curve's values at all levels and points
    looser: bool = False  # solved with looser tolerances
    other: bool = False  # by the other element


@dataclass(frozen=True)
class Bar:
    value: float  # of the user's own member; of a curve its norm
    scale: float  # what a relative error is relative to
    mesh: Part
    step: Part
    together: float
    solver: float
    verdict: str
    advice: str  # what to refine; empty: nothing needs it
    best: float  # estimate of the exact value; the finest member's where nothing is extrapolated
    off: float = 0.0  # what the value and that estimate are apart; of a curve in its norm

    @property
    def parts(self) -> dict[str, float]:
        return {"mesh": self.mesh.bar, "step": self.step.bar, "both": self.together, "solver": self.solver}

    @property
    def total(self) -> float:
        return sum(self.parts.values())

    @property
    def given(self) -> bool:
        """Whether there is a bar."""
        return self.verdict != NOT_IN_RANGE

    @property
    def relative(self) -> float:
        return self.total / self.scale if self.scale else 0.0

    def at(self, mesh: float, step: float) -> float:
        """The bar at other sizes of elements and steps."""
        both = self.together * mesh**self.mesh.used * step**self.step.used
        return self.mesh.at(mesh) + self.step.at(step) + both + self.solver


def bar_of(
    values: Sequence[Value],
    scale: float,
    space_order: float,
    time_order: float,
    element: str = "p2p1",
    additive: bool = False,
    norm: CurveNorm | None = None,
    curve: Bar | None = None,
) -> Bar | None:
    """The bar; None where the user's own member is missing. `scale`: the largest of the curve that the value is of.
    `additive`: that member may be missing; the value is then made of column and row, y(1, column) + y(row, 1) - y(row,
    column), which leaves out c (1 - row^p) (1 - column^q). `norm`: of values that are curves. `curve`: the bar of the
    curve that the values are norms of."""
    measured: Measure = norm or abs
    table = {(v.mesh, v.step): v.value for v in values if not (v.looser or v.other)}
    column, row = _most_varied((step, mesh) for mesh, step in table), _most_varied(table)
    own = table.get((1.0, 1.0))
    if own is None and additive and all(key in table for key in ((1.0, column), (row, 1.0), (row, column))):
        own = table[1.0, column] + table[row, 1.0] - table[row, column]
    if own is None:
        return None
    loose = [(v.value, table[v.mesh, v.step]) for v in values if v.looser and (v.mesh, v.step) in table]
    solver = SOLVER_FACTOR * max((measured(y - tight) for y, tight in loose), default=0.0) / (LOOSER - 1)
    noise = max(solver, DETECTED * scale)
    of_column = [(m, y) for (m, s), y in table.items() if s == column]
    mesh = _along(of_column, space_order, noise, norm, None if curve is None else curve.mesh)
    others = [v.value for v in values if v.other and (v.mesh, v.step) == (1.0, 1.0)]
    if others and (mesh is NOTHING or mesh.lacking):
        finer = [y for (m, s), y in sorted(table.items()) if s == 1.0 and m < 1]
        mesh = by_elements(own, others[0], finer[0] if finer else None, element == "p1", noise, measured)
    elif mesh is NOTHING:  # all other meshes are missing
        mesh = Part(OUTSIDE, scale, lacking=True)
    of_row = [(s, y) for (m, s), y in table.items() if m == row]
    step = _along(of_row, time_order, noise, norm, None if curve is None else curve.step)
    together = _together(table, row, column, mesh, step, noise, measured)
    error = mesh.error + step.error
    value, best = (own, own - error) if norm is None else (norm(own), norm(own - error))
    verdict, advice = _judged(mesh, step, together, solver, NEGLIGIBLE * scale)
    return Bar(value, scale, mesh, step, together, solver, verdict, advice, best, measured(error + 0.0 * own))


def _along(
    points: Sequence[tuple[float, Any]], expected: float, noise: float, norm: CurveNorm | None, curve: Part | None
) -> Part:
    if len(points) < 2:
        return NOTHING
    sizes, values = [x for x, _ in points], [y for _, y in points]
    if norm is not None:
        return part_of_curves(sizes, values, expected, noise, norm)
    return part_of(sizes, values, expected, noise, curve)


def _most_varied(table: Iterable[tuple[float, float]]) -> float:
    """The first of two sizes, of which members with all values of the second tell the error: the user's own, or that
    with the most."""
    pairs = list(table)
    numbers = {x: sum(1 for other, _ in pairs if other == x) for x, y in pairs if y == 1.0}
    return max(numbers, key=lambda x: (numbers[x] >= 3 and x == 1.0, numbers[x], -abs(x - 1.0)), default=1.0)


def _together(
    table: Table, row: float, column: float, mesh: Part, step: Part, noise: float, measured: Measure
) -> float:
    """Error by mesh and step together, from the finest of the members refined in both. Where row and column are not the
    user's own mesh and step, the sum of both parts is off by c (row^p + column^q - 1)."""
    known = table.keys()
    corners = [(m, s) for m, s in known if m != row and s != column and {(m, column), (row, s), (row, column)} <= known]
    if not corners:
        return 0.0
    m, s = min(corners, key=lambda corner: corner[0] * corner[1])
    mixed = measured(table[m, s] - table[m, column] - table[row, s] + table[row, column])
    if mixed <= 2 * noise:
        return 0.0
    share = abs(row**mesh.used - m**mesh.used) * abs(column**step.used - s**step.used)
    return TOGETHER_FACTOR * mixed * max(1.0, row**mesh.used + column**step.used - 1) / max(share, 0.25)


def _judged(mesh: Part, step: Part, together: float, solver: float, negligible: float) -> tuple[str, str]:
    total = mesh.bar + step.bar + together + solver
    counting = [(name, part) for name, part in (("mesh", mesh), ("step", step)) if part.bar > SMALL * total]
    outside = [name for name, part in counting if part.state == OUTSIDE and part.bar > negligible]
    if outside:
        return NOT_IN_RANGE, _advice(outside, [name for name, part in counting if part.lacking])
    if together > mesh.bar + step.bar + solver and together > negligible:
        return NOT_IN_RANGE, _advice(["mesh", "step"])
    widened = any(part.state in (WIDENED, OUTSIDE) for _, part in counting) or together > 0.5 * (mesh.bar + step.bar)
    # No order is seen for the solver's error.
    drowned = (mesh.state, step.state) == (SILENT, SILENT) and solver > negligible
    return (BAR_WIDENED if widened or drowned else CONVERGES), ""


def _advice(what: Sequence[str], lacking: Sequence[str] = ()) -> str:
    if lacking:
        return " and ".join(f"a third {name} is missing" for name in lacking)
    words: list[str] = [{"mesh": "refine the mesh", "step": "shorten the step"}[name] for name in what]
    return " and ".join(words) + (", both together" if len(words) > 1 else "")


def inherited(bar: Bar, curve: Bar) -> Bar:
    """Bar of a number whose members say nothing: it is off by no more than its curve is. Nothing is extrapolated."""
    parts = replace(curve.mesh, error=0.0), replace(curve.step, error=0.0)
    return Bar(bar.value, bar.scale, *parts, curve.together, curve.solver, BAR_WIDENED, "", bar.value)
