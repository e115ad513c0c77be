"""Kind `stability`: a map over one quantity at a time, each method at each value: converged in how many iterations, or
how and with which message it ended. What a run says it solved is checked against the other driver; a difference beyond
the bound is a fault, as are crashes and values that are not finite, and gives exit code 2."""

from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

from ...errors import InputError
from ...layout import Table, fixed
from ...progress import duration
from ..context import Context
from .limit_load import Tube, inflation, tube
from .map import (AGREES, DEVIATES, FAULTS, OUTCOMES, UNCHECKED, WRONG, Cell, cells, point_of, quantity)
from .messages import distinct, without_folder
from ..study_file import Study, show
from ..study_run import NOT_CONVERGED, OUT_OF_TIME, REFUSED
from ..suggestions import nearest

REPORT_KEYS = ("bound", "references", "one_pass", "quantities", "tube", "static", "pulse")
QUANTITY_KEYS = ("label", "paper")
BOUND = 1e-3  # of the difference, relative to the largest value of a time level: a thousand interface tolerances


@dataclass(frozen=True)
class Settings:
    bound: float
    references: Sequence[str]
    one_pass: Sequence[str]
    quantities: Mapping[str, Mapping[str, Any]]  # label and the paper's value, by quantity
    tube: Optional[Tube]
    static: str  # group of a wall alone under a static pressure; empty: none
    pulse: str  # quantity that is the pulse's length; empty: none


def check(study: Study) -> None:
    settings_of(study)


def settings_of(study: Study) -> Settings:
    def wrong(key: str, problem: str, remedy: str) -> InputError:
        return InputError(study.path, key, problem, remedy)

    def method_names(name: str, default: Sequence[str]) -> List[str]:
        given = study.report.get(name, default)
        if not isinstance(given, list):
            raise wrong(f"report.{name}", "is not a list", "name methods of the study")
        for entry in given:
            if entry not in study.methods:
                raise wrong(f"report.{name}", f"'{entry}' is no method of the study",
                            f"did you mean '{nearest(str(entry), list(study.methods))}'?")
        return given

    for name in study.report:
        if name not in REPORT_KEYS:
            raise wrong(f"report.{name}", "is unknown", f"did you mean '{nearest(name, REPORT_KEYS)}'?")
    bound = study.report.get("bound", BOUND)
    if isinstance(bound, bool) or not isinstance(bound, (int, float)) or not bound > 0:
        raise wrong("report.bound", f"{bound} is not a positive number", f"leave it out for {BOUND:g}")
    for request in study.requests:
        if len(request.values) != 1:
            raise wrong(f"runs.{request.group}.vary", f"varies {len(request.values)} quantities",
                        "vary one in each group")
    varied = list(dict.fromkeys(next(iter(request.values)) for request in study.requests))
    named = study.report.get("quantities", {})
    for name, entry in named.items():
        if not isinstance(entry, dict) or any(key not in QUANTITY_KEYS for key in entry):
            raise wrong(f"report.quantities.{name}", "is no section of " + " and ".join(QUANTITY_KEYS),
                        "see the ready study")
        if name not in varied and not study.quick:
            raise wrong(f"report.quantities.{name}", "is varied nowhere", f"did you mean '{nearest(name, varied)}'?")
    references = method_names("references", [m.name for m in study.methods.values() if m.program == "fsi-monolithic"])
    if len({study.methods[name].program for name in references}) != 1:
        raise wrong("report.references", "are not methods of one driver", "name those of fsi-monolithic")
    return Settings(float(bound), references, method_names("one_pass", []), named,
                    tube(study.report["tube"], wrong) if "tube" in study.report else None,
                    str(study.report.get("static", "")), str(study.report.get("pulse", "")))


def evaluate(context: Context) -> int:
    settings = settings_of(context.study)
    found = cells(context.runs, settings.references, settings.one_pass, settings.bound)
    _summary(context, found, settings)
    _maps(context, found, settings)
    _limit_load(context, found, settings)
    _messages(context, found)
    context.report.section("All runs")
    context.report.table(_all_runs(found))
    return 2 if any(cell.outcome in FAULTS for cell in found) else 0


def _summary(context: Context, found: Sequence[Cell], settings: Settings) -> None:
    report = context.report
    report.section("In short")
    faults = [cell for cell in found if cell.outcome in FAULTS]
    checked = [cell for cell in found if cell.outcome == AGREES]
    count = {outcome: sum(cell.outcome == outcome for cell in found) for outcome in OUTCOMES}
    if faults:
        report.text(f"**{len(faults)} of {len(found)} runs are at fault**: a crash, a value that is not finite, or an "
                    f"answer that the other driver contradicts by more than {settings.bound:g}.")
        report.list([f"{cell.run.request.label}: **{cell.outcome}**" + _detail(cell) for cell in faults])
    else:
        report.text(f"**No crash, no value that is not finite and no wrong answer in {len(found)} runs.**")
    worst = max((cell.difference for cell in checked if cell.difference is not None), default=None)
    report.text(f"{count[AGREES]} runs converged, and every time level of theirs is within {settings.bound:g} of the "
                f"other driver's" + (f" (the furthest {worst:.1e})" if worst is not None else "") +
                f", relative to the largest pressure of the level; of failed runs the levels before the failure are "
                f"checked too. {count[UNCHECKED]} converged where the other driver found no answer to compare with. "
                f"{count[NOT_CONVERGED]} ended with a message and exit code 2, {count[REFUSED]} were refused as bad "
                f"input, {count[OUT_OF_TIME]} were stopped after {context.study.time_limit:g} s.")
    if count[DEVIATES]:
        report.text(f"{count[DEVIATES]} runs of methods with one pass a step ({', '.join(settings.one_pass)}) came to "
                    "their end further away than that, by up to the stated part of the run's largest pressure: they do "
                    "not iterate until fluid and wall agree, and `coupling.csv` states what they lack.")
    report.table(_by_method(context, found))


def _detail(cell: Cell) -> str:
    if cell.outcome == WRONG:
        return f", off by {cell.difference:.1e} from {cell.against.request.method.label}; `{cell.run.command}`"
    return f": {without_folder(cell.run.message)}; `{cell.run.command}`"


def _by_method(context: Context, found: Sequence[Cell]) -> Table:
    shown = [outcome for outcome in OUTCOMES if any(cell.outcome == outcome for cell in found)]
    table = Table(stem="by_method", title="Outcomes by method",
                  columns=[("", "method"), ("", "runs"), *(("", o) for o in shown),
                                                                          ("", "furthest from the other driver")],
                  csv_columns=["method", "runs", *(o.replace(", ", "_").replace(" ", "_") for o in shown),
                               "largest_difference"])
    for name, method in context.study.methods.items():
        own = [cell for cell in found if cell.method == name]
        if not own:
            continue
        counts = [sum(cell.outcome == outcome for cell in own) for outcome in shown]
        worst = max((cell.difference for cell in own if cell.outcome == AGREES and cell.difference is not None),
                    default=None)
        table.rows.append([method.label, str(len(own)), *(str(n) if n else "" for n in counts), fixed(worst, ".1e")])
        table.csv_rows.append([name, len(own), *counts, worst])
    return table


def _maps(context: Context, found: Sequence[Cell], settings: Settings) -> None:
    from .pictures import map_figure

    report = context.report
    report.section("The map")
    report.text("One quantity at a time leaves the paper's case. In the cells: iterations a step (of monolithic runs "
                "Newton iterations, of partitioned ones passes through both sub-problems), or how the run ended.")
    for name in dict.fromkeys(quantity(cell.run) for cell in found):
        there = [cell for cell in found if quantity(cell.run) == name]
        values = list(dict.fromkeys(next(iter(cell.run.request.values.values())) for cell in there))
        present = {cell.method for cell in there}
        methods: List[Tuple[str, str]] = [(m.name, m.label) for m in context.study.methods.values()
                                          if m.name in present]
        entry = settings.quantities.get(name, {})
        label = str(entry.get("label", name))
        stem = "map_" + "".join(c if c.isalnum() else "_" for c in name)
        report.figure(stem, lambda: map_figure(there, methods, values, f"Stability: {_lower(label)}", label,
                                               entry.get("paper")),
                      f"{_upper(label)}: {_in_words(there)}.")


def _in_words(there: Sequence[Cell]) -> str:
    counts: Dict[str, int] = {}
    for cell in there:
        counts[cell.outcome] = counts.get(cell.outcome, 0) + 1
    return f"{len(there)} runs, " + ", ".join(f"{counts[outcome]} {outcome}" for outcome in OUTCOMES
                                              if outcome in counts)


def _limit_load(context: Context, found: Sequence[Cell], settings: Settings) -> None:
    from .limit_load import pulse_figure, static_figure

    report, bore = context.report, settings.tube
    static = [cell for cell in found if settings.static and cell.run.request.group == settings.static]
    pulses = [cell for cell in found if settings.pulse and quantity(cell.run) == settings.pulse]
    if bore is None or not (static or pulses):
        return
    report.section("Beyond the limit load")
    report.text(f"A long tube of these layers bears less than {bore.limit:.3f} kPa at rest, at unit axial stretch and "
                "whatever its radius. A longer pulse above that has no rest to tend to: only inertia holds the wall, "
                "and the wall widens until the run can no longer follow it. The runs at rest end below the limit: a "
                "coarse mesh is softer than the closed form, and a finite tube with clamped ends can bulge, which "
                "costs less than widening evenly.")
    table = Table(stem="limit_load", title="How far the wall is inflated", left=3,
                  columns=[("", "load"), ("", "method"), ("", "outcome"), ("", "reached"),
                           ("inner radius over that at rest", "largest"),
                           ("inner radius over that at rest", "half-way"),
                           ("inner radius over that at rest", "long tube, closed form")],
                  csv_columns=["group", "value", "method", "outcome", "reached_time_ms_or_load_fraction",
                               "largest_widening",
                               "middle_widening", "closed_form_widening", "message"])
    radius = bore.radii[0]
    curves, waves = [], []
    for cell in [*static, *pulses]:
        levels = inflation(cell.run)
        value = next(iter(cell.run.request.values.values()))
        at_rest = cell.run.request.group == settings.static
        reached, largest, middle, exact = None, None, None, None
        if levels is not None:
            reached = float(levels.times[-1])
            largest, middle = (1 + float(values[-1]) / radius for values in (levels.largest, levels.middle))
            if at_rest:
                exact = bore.widening(reached * float(value))
                if cell.method == settings.references[0]:
                    curves.append((f"run to {show(value)} kPa", float(value), levels))
            elif cell.method == settings.references[0]:
                waves.append((f"pulse of {show(value)} ms", cell.run.done, levels))
        table.rows.append([f"{show(value)} kPa at rest" if at_rest else f"pulse of {show(value)} ms",
                           cell.run.request.method.label,
                           cell.outcome, "-" if reached is None else f"{reached * float(value):.3f} kPa" if at_rest
                           else f"{reached:g} ms",
                           fixed(largest, ".3f"), fixed(middle, ".3f"), fixed(exact, ".3f")])
        table.csv_rows.append([cell.run.request.group, value, cell.method, cell.outcome, reached, largest, middle,
                               exact,
                               without_folder(cell.run.message)])
    if curves:
        chosen = [curves[round(i)] for i in _spread(len(curves), 4)]
        report.figure("limit_load", lambda: static_figure(chosen, bore),
                      "The wall alone under a static pressure, raised in equal steps; a curve ends where no further "
                      "solution was found.")
    if waves:
        report.figure("long_pulses", lambda: pulse_figure(waves[:6], "Inflation by pulses of different length"),
                      "Largest radial displacement of the inner face; a cross marks where a run ended with a message.")
    report.table(table)


def _spread(count: int, wanted: int) -> List[float]:
    """`wanted` indices out of `count`, first and last among them."""
    return list(range(count)) if count <= wanted else [i * (count - 1) / (wanted - 1) for i in range(wanted)]


def _messages(context: Context, found: Sequence[Cell]) -> None:
    report = context.report
    report.section("Messages")
    table = Table(stem="messages", title="What the programs say, numbers aside", left=4,
                  columns=[("", "message, as the first run said it"), ("", "outcome"), ("", "methods"), ("", "where"),
                           ("", "runs")],
                  csv_columns=["message", "first_example", "outcomes", "methods", "points", "runs"])
    for message in distinct(found):
        outcomes = list(dict.fromkeys(cell.outcome for cell in message.cells))
        points = list(dict.fromkeys(_point_text(cell) for cell in message.cells))
        where = ", ".join(points[:4]) + (f" and {len(points) - 4} more" if len(points) > 4 else "")
        table.rows.append([message.example, ", ".join(outcomes), ", ".join(message.methods), where,
                           str(len(message.cells))])
        table.csv_rows.append([message.text, message.example, ", ".join(outcomes), ", ".join(message.methods),
                               "; ".join(points),
                               len(message.cells)])
    if not table.rows:
        table.notes.append("Every run came to its end.")
    report.table(table)


def _point_text(cell: Cell) -> str:
    _, name, value = point_of(cell.run)
    return f"{name.rsplit('.', 1)[-1]} {show(value)}"


def _all_runs(found: Sequence[Cell]) -> Table:
    table = Table(stem="runs", title="All runs", left=4,
                  columns=[("", "quantity"), ("", "value"), ("", "method"), ("", "outcome"), ("", "steps"),
                           ("", "iterations per step"),
                           ("", "difference"), ("", "time")],
                  csv_columns=["group", "case", "quantity", "value", "method", "outcome", "status", "message", "steps",
                               "iterations_per_step", "largest_difference", "compared_with", "process_s", "folder",
                               "command"])
    for cell in found:
        run = cell.run
        name = quantity(run)
        value = run.request.values[name]
        passes = run.passes if run.passes == run.passes else None
        table.rows.append([name, show(value), run.request.method.label, cell.outcome, str(cell.levels),
                           fixed(passes, ".2f"),
                           fixed(cell.difference, ".1e"), duration(run.seconds)])
        table.csv_rows.append([run.request.group, run.request.case, name, value, cell.method, cell.outcome, run.status,
                               without_folder(run.message), cell.levels, passes, cell.difference,
                               cell.against.request.method.name if cell.against else None, run.seconds, run.folder.name,
                               run.command])
    table.notes.append("Difference: largest over the time levels in common with the other driver's run, relative to "
                       "the largest value of the level; of methods with one pass a step, of all levels.")
    return table


def _lower(label: str) -> str:
    return label[:1].lower() + label[1:]


def _upper(label: str) -> str:
    return label[:1].upper() + label[1:]
