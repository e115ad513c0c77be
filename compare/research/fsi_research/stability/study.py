"""Kind `stability`: a map over one quantity at a time, each method at each value: converged in how many iterations, or
how and with which message it ended. What a run says it solved is checked against the other driver; a difference beyond
the bound is a fault, as are crashes and values that are not finite, and gives exit code 2."""

import re
from typing import Dict, List, NamedTuple, Optional, Sequence, Tuple

from fsi_compare.starting.duration import duration
from fsi_compare.reporting.column import Column
from fsi_compare.reporting.layout import Table
from ..evidence.cross_check import (
    AGREES,
    DEVIATES,
    FAR,
    FAULTS,
    OUTCOMES,
    UNCHECKED,
    USABLE,
    WRONG,
    Cell,
    cells,
    point_of,
    quantity,
)
from ..evidence.commands import with_name
from fsi_compare.study.context import Context
from fsi_compare.study.study_file import Study, show
from fsi_compare.study.study_run import NOT_CONVERGED, OUT_OF_TIME, REFUSED, known
from .beyond_limit_load import beyond_limit_load
from .messages import Message, distinct, without_folder
from .ringing import ringing
from .settings import Settings, settings_of
from .splitting import splitting


def check(study: Study) -> None:
    settings_of(study)


def evaluate(context: Context) -> int:
    settings = settings_of(context.study)
    found = cells(context.runs, settings.references, settings.one_pass, settings.bound)
    _summary(context, found, settings)
    _maps(context, found, settings)
    splitting(context.report, found, settings)
    ringing(context.report, found, settings)
    beyond_limit_load(context.report, found, settings)
    _messages(context, found)
    context.report.section("All runs")
    context.report.table(_all_runs(found, settings))
    return 2 if any(cell.outcome in FAULTS for cell in found) else 0


def _summary(context: Context, found: Sequence[Cell], settings: Settings) -> None:
    report = context.report
    report.section("In short")
    if settings.scope:
        report.text(settings.scope)
    faults = [cell for cell in found if cell.outcome in FAULTS]
    checked = [cell for cell in found if cell.outcome == AGREES]
    count = {outcome: sum(cell.outcome == outcome for cell in found) for outcome in OUTCOMES}
    if faults:
        report.text(
            f"**{len(faults)} of {len(found)} runs are at fault**: a crash, a value that is not finite, or an "
            f"answer that the other driver contradicts by more than {settings.bound:g}."
        )
        report.list([f"{cell.run.request.label}: **{cell.outcome}**" + _detail(cell) for cell in faults])
    else:
        report.text(f"**No crash, no value that is not finite and no wrong answer in {len(found)} runs.**")
    worst = max((cell.difference for cell in checked if cell.difference is not None), default=None)
    report.text(
        f"{count[AGREES]} runs converged, and every time level of theirs is within {settings.bound:g} of the "
        f"other driver's"
        + (f" (the furthest {worst:.1e})" if worst is not None else "")
        + f", relative to the largest pressure of the level; of failed runs the levels before the failure are "
        f"checked too. {count[UNCHECKED]} converged where there is no answer of the other driver to compare "
        f"with. {count[NOT_CONVERGED]} ended with a message and exit code 2, {count[REFUSED]} were refused as "
        f"bad input, {count[OUT_OF_TIME]} were stopped after {context.study.time_limit:g} s."
    )
    off = count[DEVIATES] + count[FAR]
    if off:
        report.text(
            f"{off} run{'s' if off > 1 else ''} of methods that do not iterate, or not on all that fluid and wall share "
            f"({', '.join(settings.one_pass)}), came to their end further away than that, {count[FAR]} of them by more than "
            f"{100 * USABLE:g} %: of the largest pressure of the run, or of the displacement, whichever is more. They do not "
            "claim that fluid and wall agree, and `coupling.csv` states what they lack."
        )
    report.table(_by_method(context, found))


def _detail(cell: Cell) -> str:
    command = with_name(cell.run.command)
    if cell.outcome == WRONG:
        assert cell.against is not None, "a wrong run was held against another"
        return f", off by {cell.off:.1e} from {cell.against.method_label}; `{command}`"
    return f": {without_folder(cell.run.message)}; `{command}`"


class Outcomes(NamedTuple):
    """Outcomes of a method's runs."""

    name: str
    label: str
    cells: Sequence[Cell]

    @property
    def worst(self) -> Optional[float]:
        """Difference of those that agree."""
        agreeing = [cell.difference for cell in self.cells if cell.outcome == AGREES and cell.difference is not None]
        return max(agreeing, default=None)


def _count(outcome: str) -> Column[Outcomes]:
    return Column(
        outcome,
        outcome.replace(", ", "_").replace(" ", "_"),
        lambda o: sum(cell.outcome == outcome for cell in o.cells),
        lambda count: str(count or ""),
    )


def _by_method(context: Context, found: Sequence[Cell]) -> Table:
    columns: List[Column[Outcomes]] = [
        Column("method", "method", lambda o: o.name, text=lambda o: o.label, left=True),
        Column("runs", "runs", lambda o: len(o.cells)),
        *(_count(outcome) for outcome in OUTCOMES if any(cell.outcome == outcome for cell in found)),
        Column("largest relative difference from the other driver", "largest_difference", lambda o: o.worst, ".1e"),
    ]
    methods = context.study.methods.items()
    rows = [
        Outcomes(name, _with_kind(method.label, own), own)
        for name, method in methods
        for own in [[cell for cell in found if cell.method == name]]
    ]
    return Table("by_method", "Outcomes by method", columns, [row for row in rows if row.cells])


def _with_kind(label: str, cells: Sequence[Cell]) -> str:
    """The method's label with its kind of coupling, which a run that was refused does not say."""
    return max((cell.run.method_label for cell in cells), key=len, default=label)


def _maps(context: Context, found: Sequence[Cell], settings: Settings) -> None:
    from .pictures import map_figure

    report = context.report
    report.section("The map")
    report.text(
        "One quantity at a time leaves the paper's case. In the cells: iterations a step (of monolithic runs "
        "Newton iterations, of partitioned ones passes through both sub-problems), or how the run ended."
    )
    found = [cell for cell in found if not settings.is_variant_at_rest(cell.run)]  # one method, in the table of loads
    cases = {
        name: list(dict.fromkeys(cell.run.request.case for cell in found if quantity(cell.run) == name))
        for name in dict.fromkeys(quantity(cell.run) for cell in found)
    }
    for name, case in [(name, case) for name, own in cases.items() for case in own]:
        there = [cell for cell in found if point_of(cell.run)[:2] == (case, name)]
        values = list(dict.fromkeys(next(iter(cell.run.request.values.values())) for cell in there))
        present = {cell.method for cell in there}
        methods: List[Tuple[str, str]] = [
            (m.name, _with_kind(m.label, [cell for cell in found if cell.method == m.name]))
            for m in context.study.methods.values()
            if m.name in present
        ]
        label, paper = settings.label(name), settings.quantities.get(name, {}).get("paper")
        paper = None if case in context.study.scenes else paper  # those of the gallery are not the paper's
        stem = name
        if case != cases[name][0]:
            label, stem = f"{label}, {case}", f"{name} {case}"
        stem = "map_" + re.sub(r"\W+", "_", stem)
        report.figure(
            stem,
            lambda: map_figure(there, methods, values, f"Stability: {_lower(label)}", label, paper),
            f"{_upper(label)}: {_in_words(there)}.",
        )


def _in_words(there: Sequence[Cell]) -> str:
    counts: Dict[str, int] = {}
    for cell in there:
        counts[cell.outcome] = counts.get(cell.outcome, 0) + 1
    return f"{len(there)} runs, " + ", ".join(
        f"{counts[outcome]} {outcome}" for outcome in OUTCOMES if outcome in counts
    )


def _points(message: Message) -> List[str]:
    return list(dict.fromkeys(_point_text(cell) for cell in message.cells))


def _first_points(message: Message) -> str:
    points = _points(message)
    return ", ".join(points[:4]) + (f" and {len(points) - 4} more" if len(points) > 4 else "")


MESSAGES: Sequence[Column[Message]] = (
    Column(csv="message", value=lambda m: m.text),
    Column("message, as the first run said it", "first_example", lambda m: m.example, left=True),
    Column("outcome", "outcomes", lambda m: ", ".join(dict.fromkeys(c.outcome for c in m.cells)), left=True),
    Column("methods", "methods", lambda m: ", ".join(m.methods), left=True),
    Column("where", "points", lambda m: "; ".join(_points(m)), text=_first_points, left=True),
    Column("runs", "runs", lambda m: len(m.cells)),
)


def _messages(context: Context, found: Sequence[Cell]) -> None:
    context.report.section("Messages")
    messages = distinct(found)
    notes = [] if messages else ["Every run came to its end."]
    context.report.table(Table("messages", "What the programs say, numbers aside", MESSAGES, messages, notes=notes))


def _point_text(cell: Cell) -> str:
    _, name, value = point_of(cell.run)
    return f"{name.rsplit('.', 1)[-1]} {show(value)}"


def _columns(settings: Settings) -> List[Column[Cell]]:
    """Quantities by their labels, which hold the units of their values; in the CSV by their keys."""
    return [
        Column(csv="group", value=lambda c: c.run.request.group),
        Column(csv="case", value=lambda c: c.run.request.case),
        Column("quantity", "quantity", lambda c: quantity(c.run), settings.label, left=True),
        Column("value", "value", lambda c: c.run.request.values[quantity(c.run)], show, left=True),
        Column("method", "method", lambda c: c.method, text=lambda c: c.run.method_label, left=True),
        Column("outcome", "outcome", lambda c: c.outcome, left=True),
        Column(csv="status", value=lambda c: c.run.status),
        Column(csv="message", value=lambda c: without_folder(c.run.message)),
        Column("steps", "steps", lambda c: c.levels),
        Column("iterations per step", "iterations_per_step", lambda c: known(c.run.passes), ".2f"),
        Column("relative difference", "largest_difference", lambda c: c.difference, ".1e"),
        Column(csv="compared_with", value=lambda c: c.against and c.against.request.method.name),
        Column("time", "process", lambda c: c.run.seconds, duration, "s"),
        Column(csv="folder", value=lambda c: c.run.folder.name),
        Column(csv="command", value=lambda c: with_name(c.run.command)),
        Column(csv="displacement_difference", value=lambda c: c.displacement),
    ]


def _all_runs(found: Sequence[Cell], settings: Settings) -> Table:
    return Table(
        "runs",
        "All runs",
        _columns(settings),
        found,
        notes=[
            "Difference: largest over the time levels in common with the other driver's run, relative to "
            "the largest value of the level; of methods that do not iterate, of all levels."
        ],
    )


def _lower(label: str) -> str:
    return label[:1].lower() + label[1:]


def _upper(label: str) -> str:
    return label[:1].upper() + label[1:]
