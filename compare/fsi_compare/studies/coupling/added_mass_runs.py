"""Critical density ratio of `explicit` and largest stable factor of `constant`, by bisection over runs, beside the theory.

`[report.explicit]` and `[report.constant]`: `method` (by name), `low`, `high` (density ratio, factor), `width` (relative, at
which bisection stops), `set` (entries of the case file for these runs); `steps`: list of time steps in ms."""

from typing import Any, Dict, Mapping

from ...errors import InputError
from ...layout import Table
from .added_mass import Tube
from .bisection import Bracket, bisect
from ..context import Context
from ..study_file import Study
from ..suggestions import nearest

KEYS = ("method", "case", "low", "high", "width", "steps", "levels", "set")
QUANTITIES = {"explicit": "structure.density", "constant": "partitioned.relaxation"}


def check(study: Study) -> None:
    for name, entry in study.report.items():
        if name not in QUANTITIES:
            raise InputError(study.path, f"report.{name}", "is unknown", f"did you mean '{nearest(name, list(QUANTITIES))}'?")
        for key in entry:
            if key not in KEYS:
                raise InputError(study.path, f"report.{name}.{key}", "is unknown", f"did you mean '{nearest(key, KEYS)}'?")
        for key in ("method", "case", "low", "high", "steps"):
            if key not in entry:
                raise InputError(study.path, f"report.{name}.{key}", "is missing", f"the keys are {', '.join(KEYS)}")
        if entry["method"] not in study.methods:
            raise InputError(study.path, f"report.{name}.method", f"'{entry['method']}' is unknown", "name one of [methods]")
        if entry["case"] not in study.cases:
            raise InputError(study.path, f"report.{name}.case", f"'{entry['case']}' is unknown", "name one of [cases]")
        if not 0 < entry["low"] < entry["high"]:
            raise InputError(study.path, f"report.{name}.low", "is not below `high`, or not positive", "give the ends of the search")


def report(context: Context) -> None:
    for name, entry in context.study.report.items():
        (explicit if name == "explicit" else constant)(context, entry)


def search(context: Context, name: str, entry: Mapping[str, Any], step: float, settings: Mapping[str, Any]) -> Bracket:
    quantity = QUANTITIES[name]

    def holds(value: float) -> bool:
        own: Dict[str, Any] = {**entry.get("set", {}), **settings, "time.step": step, quantity: value}
        if "levels" in entry:
            own["time.end"] = step * entry["levels"]
        flat = flatten(own)
        run, = context.run([context.study.request(name, entry["case"], entry["method"], {quantity: value, "time.step": step}, flat)])
        if run.status not in ("done", "not converged"):
            raise InputError(context.study.path, f"report.{name}", f"{run.status}: {run.message}", f"see {run.folder}")
        return run.done

    return bisect(holds, entry["low"], entry["high"], entry.get("width", 0.02))


def flatten(entries: Mapping[str, Any], prefix: str = "") -> Dict[str, Any]:
    found: Dict[str, Any] = {}
    for key, value in entries.items():
        if isinstance(value, Mapping):
            found.update(flatten(value, f"{prefix}{key}."))
        else:
            found[f"{prefix}{key}"] = value
    return found


def explicit(context: Context, entry: Mapping[str, Any]) -> None:
    tube = Tube()
    table = Table(stem="added_mass_explicit", title="Critical density ratio of the wall to the fluid, `explicit`: unstable below",
                  left=1, columns=[("", "time step"), ("", "measured"), ("", "theory"), ("", "runs")],
                  csv_columns=["time_step_ms", "unstable_below", "stable_above", "theory", "runs"])
    for step in entry["steps"]:
        bracket = search(context, "explicit", entry, step, {})
        theory = tube.critical_density_ratio()
        table.rows.append([f"{step:g} ms", text(bracket), f"{theory:.0f}", str(bracket.runs)])
        table.csv_rows.append([step, bracket.fails, bracket.holds, theory, bracket.runs])
    context.report.table(table)


def constant(context: Context, entry: Mapping[str, Any]) -> None:
    tube = Tube()
    table = Table(stem="added_mass_constant", title="Largest factor of `constant` that converges", left=1,
                  columns=[("", "time step"), ("", "measured"), ("", "theory 2/(1 + |G|)"), ("", "runs")],
                  csv_columns=["time_step_ms", "converges", "diverges", "theory", "runs"])
    for step in entry["steps"]:
        bracket = search(context, "constant", entry, step, {})
        theory = tube.largest_factor(step)
        table.rows.append([f"{step:g} ms", text(bracket), f"{theory:.4f}", str(bracket.runs)])
        table.csv_rows.append([step, bracket.holds, bracket.fails, theory, bracket.runs])
    context.report.table(table)


def text(bracket: Bracket) -> str:
    if bracket.value is not None:
        return f"{bracket.value:.3g} ± {bracket.width / 2:.0%}"
    return f"none: all fail up to {bracket.fails:g}" if bracket.fails else f"none: all hold from {bracket.holds:g}"
