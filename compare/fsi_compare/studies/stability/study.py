"""Kind `stability`: a map over one quantity at a time, each method at each value: converged in how many iterations, or
how and with which message it ended. What a run says it solved is checked against the other driver; a difference beyond
the bound is a fault, as are crashes and values that are not finite, and gives exit code 2."""

import re
from typing import Dict, List, Sequence, Tuple

from ...base.progress import duration
from ...reporting.layout import Table, fixed
from ..evidence.cross_check import AGREES, DEVIATES, FAULTS, OUTCOMES, UNCHECKED, WRONG, Cell, cells, point_of, quantity
from ..running.commands import with_name
from ..running.context import Context
from ..running.study_file import Study, show
from ..running.study_run import NOT_CONVERGED, OUT_OF_TIME, REFUSED
from .beyond_limit_load import beyond_limit_load
from .messages import distinct, without_folder
from .ringing import ringing
from .settings import Settings, settings_of


def check(study: Study) -> None:
    settings_of(study)


def evaluate(context: Context) -> int:
    settings = settings_of(context.study)
    found = cells(context.runs, settings.references, settings.one_pass, settings.bound)
    _summary(context, found, settings)
    _maps(context, found, settings)
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
    if count[DEVIATES]:
        report.text(
            f"{count[DEVIATES]} run{'s' if count[DEVIATES] > 1 else ''} of methods with one pass a step "
            f"({', '.join(settings.one_pass)}) came to their end further away than that, by up to the stated "
            "part of the run's largest pressure: they do not iterate until fluid and wall agree, and "
            "`coupling.csv` states what they lack."
        )
    report.table(_by_method(context, found))


def _detail(cell: Cell) -> str:
    command = with_name(cell.run.command)
    if cell.outcome == WRONG:
        assert cell.against is not None, "a wrong run was held against another"
        return f", off by {cell.difference:.1e} from {cell.against.request.method.label}; `{command}`"
    return f": {without_folder(cell.run.message)}; `{command}`"


def _by_method(context: Context, found: Sequence[Cell]) -> Table:
    shown = [outcome for outcome in OUTCOMES if any(cell.outcome == outcome for cell in found)]
    table = Table(
        stem="by_method",
        title="Outcomes by method",
        columns=[
            ("", "method"),
            ("", "runs"),
            *(("", o) for o in shown),
            ("", "largest relative difference from the other driver"),
        ],
        csv_columns=["method", "runs", *(o.replace(", ", "_").replace(" ", "_") for o in shown), "largest_difference"],
    )
    for name, method in context.study.methods.items():
        own = [cell for cell in found if cell.method == name]
        if not own:
            continue
        counts = [sum(cell.outcome == outcome for cell in own) for outcome in shown]
        worst = max(
            (cell.difference for cell in own if cell.outcome == AGREES and cell.difference is not None), default=None
        )
        table.rows.append([method.label, str(len(own)), *(str(n) if n else "" for n in counts), fixed(worst, ".1e")])
        table.csv_rows.append([name, len(own), *counts, worst])
    return table


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
            (m.name, m.label) for m in context.study.methods.values() if m.name in present
        ]
        label, paper = settings.label(name), settings.quantities.get(name, {}).get("paper")
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


def _messages(context: Context, found: Sequence[Cell]) -> None:
    report = context.report
    report.section("Messages")
    table = Table(
        stem="messages",
        title="What the programs say, numbers aside",
        left=4,
        columns=[
            ("", "message, as the first run said it"),
            ("", "outcome"),
            ("", "methods"),
            ("", "where"),
            ("", "runs"),
        ],
        csv_columns=["message", "first_example", "outcomes", "methods", "points", "runs"],
    )
    for message in distinct(found):
        outcomes = list(dict.fromkeys(cell.outcome for cell in message.cells))
        points = list(dict.fromkeys(_point_text(cell) for cell in message.cells))
        where = ", ".join(points[:4]) + (f" and {len(points) - 4} more" if len(points) > 4 else "")
        table.rows.append(
            [message.example, ", ".join(outcomes), ", ".join(message.methods), where, str(len(message.cells))]
        )
        table.csv_rows.append(
            [
                message.text,
                message.example,
                ", ".join(outcomes),
                ", ".join(message.methods),
                "; ".join(points),
                len(message.cells),
            ]
        )
    if not table.rows:
        table.notes.append("Every run came to its end.")
    report.table(table)


def _point_text(cell: Cell) -> str:
    _, name, value = point_of(cell.run)
    return f"{name.rsplit('.', 1)[-1]} {show(value)}"


def _all_runs(found: Sequence[Cell], settings: Settings) -> Table:
    """Quantities by their labels, which hold the units of their values; in the CSV by their keys."""
    table = Table(
        stem="runs",
        title="All runs",
        left=4,
        columns=[
            ("", "quantity"),
            ("", "value"),
            ("", "method"),
            ("", "outcome"),
            ("", "steps"),
            ("", "iterations per step"),
            ("", "relative difference"),
            ("", "time"),
        ],
        csv_columns=[
            "group",
            "case",
            "quantity",
            "value",
            "method",
            "outcome",
            "status",
            "message",
            "steps",
            "iterations_per_step",
            "largest_difference",
            "compared_with",
            "process_s",
            "folder",
            "command",
        ],
    )
    for cell in found:
        run = cell.run
        name = quantity(run)
        value = run.request.values[name]
        passes = run.passes if run.passes == run.passes else None
        table.rows.append(
            [
                settings.label(name),
                show(value),
                run.request.method.label,
                cell.outcome,
                str(cell.levels),
                fixed(passes, ".2f"),
                fixed(cell.difference, ".1e"),
                duration(run.seconds),
            ]
        )
        table.csv_rows.append(
            [
                run.request.group,
                run.request.case,
                name,
                value,
                cell.method,
                cell.outcome,
                run.status,
                without_folder(run.message),
                cell.levels,
                passes,
                cell.difference,
                cell.against.request.method.name if cell.against else None,
                run.seconds,
                run.folder.name,
                with_name(run.command),
            ]
        )
    table.notes.append(
        "Difference: largest over the time levels in common with the other driver's run, relative to "
        "the largest value of the level; of methods with one pass a step, of all levels."
    )
    return table


def _lower(label: str) -> str:
    return label[:1].lower() + label[1:]


def _upper(label: str) -> str:
    return label[:1].upper() + label[1:]
