"""Tables of the study of accuracy and cost."""

from typing import Callable, List, NamedTuple, Optional, Sequence

from fsi_compare.starting.duration import duration
from fsi_compare.reporting.column import Column, Facts, work_column
from fsi_compare.reporting.layout import Table
from fsi_compare.runs.work_units import NOTE_IN_ALL
from fsi_compare.runs.waves import QUANTITIES, Quantity
from fsi_compare.study.study_run import known
from .advice import percent
from .convergence import SPACE, Series
from .frontier import frontier
from .measured import GAIN, Measured

SHORT = ("pressure", "averaged pressure", "displacement")  # of QUANTITIES, as heads of columns
CSV = ("pressure", "averaged_pressure", "displacement")


class Place(NamedTuple):
    """On the frontier."""

    number: int
    run: Measured


def frontier_table(measured: Sequence[Measured], quantity: Quantity, name: str, stem: str) -> Table:
    """`name`, `stem`: what title and file say of the case."""
    best = frontier([(m.seconds, m.total[quantity.column]) for m in measured], GAIN)
    columns: List[Column[Place]] = [
        Column("number", "number", lambda p: p.number, left=True),
        Column("equations", "equations", lambda p: p.run.equations, left=True),
        Column("solved by", "solved_by", lambda p: p.run.solving, left=True),
        Column("error", "relative_error", lambda p: p.run.total[quantity.column], percent),
        work_column("work units", "work_units", lambda p: p.run.work_units),
        Column("seconds", "seconds", lambda p: p.run.seconds, ".1f"),
    ]
    return Table(
        f"frontier_{quantity.file.split('.')[0]}{stem}",
        f"The frontier in {quantity.name}{name}",
        columns,
        [Place(number, measured[i]) for number, i in enumerate(best, 1)],
    )


class Three(NamedTuple):
    """Successive runs of a series, from the one at `first` on."""

    series: Series
    first: int

    @property
    def sizes(self) -> str:
        runs = self.series.runs[self.first : self.first + 3]
        return " / ".join(m.mesh_label if self.series.what == SPACE else f"{m.step:g} ms" for m in runs)

    def apart(self, q: Quantity) -> Sequence[float]:
        return self.series.distances[q.column][self.first : self.first + 2]

    def order(self, q: Quantity) -> Optional[float]:
        return self.series.orders[q.column][self.first].order

    def left(self, q: Quantity) -> Optional[float]:
        return self.series.orders[q.column][self.first].remaining

    def slope(self, q: Quantity) -> Optional[float]:
        """Against the reference: of the finest three alone."""
        return self.series.against_reference[q.column] if self.first == len(self.series.runs) - 3 else None


class OneOrder(NamedTuple):
    three: Three
    quantity: Quantity


THREES: Sequence[Column[Three]] = (
    Column("refined", "refined", lambda t: t.series.what, left=True),
    Column("all else", "fixed", lambda t: t.series.fixed, left=True),
    Column("sizes", "sizes", lambda t: t.sizes, left=True),
)


def _of_three(column: Column[Three]) -> Column[OneOrder]:
    return Column(csv=column.name, value=lambda o: column.value(o.three))


ORDERS: Sequence[Column[OneOrder]] = (
    *map(_of_three, THREES),
    Column(csv="quantity", value=lambda o: o.quantity.column),
    Column(csv="relative_differences", value=lambda o: " ".join(f"{d:.6g}" for d in o.three.apart(o.quantity))),
    Column(csv="order", value=lambda o: o.three.order(o.quantity)),
    Column(csv="estimated_error", value=lambda o: o.three.left(o.quantity)),
    Column(csv="slope_against_reference", value=lambda o: o.three.slope(o.quantity)),
)


def _of_quantity(q: Quantity) -> List[Column[Three]]:
    return [
        Column("differences", value=lambda t: ", ".join(map(percent, t.apart(q))), group=q.name),
        Column("order", value=lambda t: t.order(q), format=".2f", group=q.name),
        Column("left", value=lambda t: t.left(q), format=percent, group=q.name),
        Column("slope", value=lambda t: t.slope(q), format=".2f", group=q.name),
    ]


def orders_table(found: Sequence[Series]) -> Table:
    threes = [Three(one, first) for one in found for first in range(len(one.runs) - 2)]
    return Table(
        "orders",
        "Observed orders",
        [*THREES, *(column for q in QUANTITIES for column in _of_quantity(q))],
        threes,
        Facts(ORDERS, [OneOrder(three, q) for three in threes for q in QUANTITIES]),
    )


def _algebraic(m: Measured, q: Quantity) -> Optional[float]:
    return m.algebraic.get(q.column)


def _errors(group: str, kind: str, error: Callable[[Measured, Quantity], Optional[float]]) -> List[Column[Measured]]:
    """Columns of the quantities' errors, in the CSV named NAME_KIND."""

    def column(q: Quantity, head: str, csv: str) -> Column[Measured]:
        return Column(head, f"{csv}_{kind}", lambda m: error(m, q), percent, group=group)

    return [column(*one) for one in zip(QUANTITIES, SHORT, CSV)]


def algebraic_table(number: int, name: str, runs: Sequence[Measured]) -> Table:
    """The runs of one set of discrete equations, the quickest first."""
    best = frontier([(m.seconds, m.worst_algebraic) for m in runs])
    places = {id(runs[j]): place for place, j in enumerate(best, 1)}
    columns: List[Column[Measured]] = [
        Column(csv="equations", value=lambda m: name),
        Column("solved by", "solved_by", lambda m: m.solving, left=True),
        *_errors("error", "error", _algebraic),
        work_column("work units", "work_units", lambda m: m.work_units),
        Column("seconds", "seconds", lambda m: m.seconds, ".2f"),
        Column("iterations per step", "iterations_per_step", lambda m: known(m.run.passes), ".1f"),
        Column("frontier", "on_frontier", lambda m: id(m) in places, text=lambda m: str(places.get(id(m), ""))),
    ]
    return Table(
        f"algebraic_{number}",
        f"Solver's error, {name}",
        columns,
        sorted(runs, key=lambda m: m.seconds),
        notes=["Frontier: in the largest of the errors. Iterations: coupling passes, or Newton's."],
    )


SETTINGS: Sequence[Column[Measured]] = (
    Column("case", "case", lambda m: m.run.request.case, left=True),
    Column(csv="mesh", value=lambda m: m.mesh),
    Column(csv="nodes", value=lambda m: m.nodes),
    Column(csv="step", unit="ms", value=lambda m: m.step),
    Column("equations", "equations", lambda m: m.equations, left=True),
    Column("solved by", "solved_by", lambda m: m.solving, left=True),
    Column(csv="driver", value=lambda m: m.run.request.method.program),
    Column("group", "group", lambda m: m.run.request.group, left=True),
    Column("nodes", value=lambda m: m.nodes, format=","),
    *_errors("total error", "error", lambda m, q: m.total[q.column]),
    *_errors("solver's error", "solver_error", _algebraic),
    work_column("work units", "work_units", lambda m: m.work_units),
    Column("time", "seconds", lambda m: m.seconds, duration),
    Column(csv="process", unit="s", value=lambda m: m.run.seconds),
    Column(csv="folder", value=lambda m: m.run.folder.name),
)


def settings_table(measured: Sequence[Measured]) -> Table:
    """All runs."""
    ordered = sorted(measured, key=lambda m: (m.run.request.case, m.worst))
    notes = [NOTE_IN_ALL] if any(m.work_units is not None for m in measured) else []
    return Table("settings", "All settings, by total error", SETTINGS, ordered, notes=notes)
