"""Critical density ratio of `explicit` and largest stable factor of `constant`, by bisection over runs, beside the
theory.

`[report.explicit]` and `[report.constant]`: `method` and `case` (by name), `low`, `high` (density ratio, factor),
`width` (relative, at which bisection stops), `steps` (list of time steps in ms), `stabilisations` (list of the wall's
alpha), `levels` (time steps of a run), `set` (entries of the case file for these runs)."""

from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, NamedTuple, Sequence

import numpy as np

from fsi_compare.base.errors import ProgramError
from fsi_compare.reporting.column import Column
from fsi_compare.reporting.layout import Table
from fsi_compare.study.context import Context
from fsi_compare.study.study_file import Request, Study, mesh_of_scene
from fsi_compare.study.study_run import DONE, NOT_CONVERGED, StudyRun
from ..catalogue.report_section import ReportSection
from .added_mass import AddedMass
from .bisection import Bracket, bisect

KEYS = ("method", "case", "low", "high", "width", "steps", "stabilisations", "levels", "set")
QUANTITIES = {"explicit": "structure.density", "constant": "partitioned.relaxation"}


@dataclass(frozen=True)
class Search:
    """What one of the two sections asks for."""

    method: str
    case: str
    low: float
    high: float
    width: float
    steps: List[float]  # ms
    stabilisations: List[float]
    levels: float
    settings: Mapping[str, Any]


def check(study: Study) -> None:
    """Raises InputError."""
    sections(study)


def sections(study: Study) -> Mapping[str, Search]:
    """What is bisected, by the name of its section. Raises InputError."""
    return {name: _search(study, name) for name in QUANTITIES if name in study.report}


def _search(study: Study, name: str) -> Search:
    entry = ReportSection(study.path, f"report.{name}", study.report[name], KEYS)
    found = Search(
        entry.one_of("method", list(study.methods), "method of the study"),
        entry.one_of("case", list(study.cases), "case of the study"),
        entry.number("low"),
        entry.number("high"),
        entry.number("width", 0.02),
        entry.numbers("steps"),
        entry.numbers("stabilisations"),
        entry.number("levels", 1),
        flatten(entry.table("set")),
    )
    if not found.low < found.high:
        raise entry.wrong("low", "is not below `high`", "give the ends of the search")
    if not 1e-12 <= found.width < 1:
        raise entry.wrong("width", f"{found.width:g} is no relative width", "give a number below 1, e.g. 0.02")
    return found


def report(context: Context) -> int:
    """The number of runs made or taken up for it."""
    brackets: List[Bracket] = []
    for name, entry in sections(context.study).items():
        brackets += (explicit if name == "explicit" else constant)(context, entry)
    return sum(bracket.runs for bracket in brackets)


def _request(study: Study, group: str, entry: Search, values: Mapping[str, Any], own: Mapping[str, Any]) -> Request:
    """One more run. `own`: its settings, over those of the study."""
    method = study.methods[entry.method]
    settings = {**study.settings, **study.case_settings.get(entry.case, {}), **method.settings, **own}
    mesh = mesh_of_scene(study.scenes.get(entry.case), study.quick)
    return Request(group, entry.case, method, values, study.cases[entry.case], mesh, settings, study.time_limit)


def search(context: Context, name: str, entry: Search, step: float, stabilisation: float) -> Bracket:
    quantity = QUANTITIES[name]

    def holds(value: float) -> bool:
        own = {
            **entry.settings,
            "time.step": step,
            "structure.stabilisation": stabilisation,
            "time.end": step * entry.levels,
            quantity: value,
        }
        values = {quantity: value, "time.step": step, "structure.stabilisation": stabilisation}
        (run,) = context.runner.run([_request(context.study, name, entry, values, own)])
        if run.status not in (DONE, NOT_CONVERGED):
            raise ProgramError(
                context.study.path, f"report.{name}", f"{run.status}: {run.message}", f"see {run.folder}"
            )
        return run.done and not (name == "explicit" and alternates_ever_more(run))

    return bisect(holds, entry.low, entry.high, entry.width)


def alternates_ever_more(run: StudyRun) -> bool:
    """Close to its limit an unstable march outlives any run. It shows in third differences of the wall's radial
    displacement in time, which weigh a motion that alternates with each step eightfold: they are larger over the last
    eight steps than a quarter into the run, and not small."""
    columns = run.columns("wall_displacement.csv")
    levels = len(np.unique(columns["time_ms"]))
    radial = columns["radial_mm"].reshape(levels, -1)
    third = np.abs(np.diff(radial, n=3, axis=0)).max(axis=1)
    if len(third) < 24:
        return False
    early, late = third[len(third) // 4 : len(third) // 4 + 8].max(), third[-8:].max()
    return bool(late > early and late > 0.05 * np.abs(radial).max())


def flatten(entries: Mapping[str, Any], prefix: str = "") -> Dict[str, Any]:
    found: Dict[str, Any] = {}
    for key, value in entries.items():
        if isinstance(value, Mapping):
            found.update(flatten(value, f"{prefix}{key}."))
        else:
            found[f"{prefix}{key}"] = value
    return found


class Found(NamedTuple):
    """Between which values of a quantity it turns, for one stabilisation and time step."""

    stabilisation: float
    step: float
    bracket: Bracket


FOUND: Sequence[Column[Found]] = (
    Column("wall's stabilisation", "stabilisation", lambda f: f.stabilisation, "g", left=True),
    Column("time step", "time_step", lambda f: f.step, lambda step: f"{step:g} ms", "ms", left=True),
    Column("measured", value=lambda f: text(f.bracket)),
)
RUNS: Column[Found] = Column("runs", "runs", lambda f: f.bracket.runs)


def search_all(context: Context, name: str, entry: Search) -> List[Found]:
    return [
        Found(stabilisation, step, search(context, name, entry, step, stabilisation))
        for stabilisation in entry.stabilisations
        for step in entry.steps
    ]


def explicit(context: Context, entry: Search) -> List[Bracket]:
    theory, found = AddedMass(), search_all(context, "explicit", entry)
    columns: List[Column[Found]] = [
        *FOUND,
        Column(csv="unstable_at", value=lambda f: f.bracket.fails),
        Column(csv="stable_at", value=lambda f: f.bracket.holds),
        Column("as published", "theory_published", lambda f: theory.critical_density_ratio(), ".0f", group="theory"),
        Column("for this scheme", "theory_this_scheme", lambda f: theory.explicit_limit(1), ".0f", group="theory"),
        RUNS,
    ]
    table = Table(
        "added_mass_explicit",
        "Critical density ratio of the wall to the fluid: `explicit` is unstable below",
        columns,
        found,
        notes=[
            "As published (Causin, Gerbeau and Nobile): rho_s h = rho_f m. For this scheme: rho_s h e = 2 rho_f m, since "
            "Newmark's beta = gamma = 1 leaves the wall half as heavy when steps alternate, e = (R/h) ln(1 + h/R) for a "
            "thick wall.",
            "The quasi-static stabilisation of the wall, tau = alpha h^2/(2 mu), lets volume leak through heavy elements, "
            "so that only the nodes of the inner face answer: with alpha = 0.5 the limit lies higher still "
            "(docs/coupling.md).",
        ],
    )
    context.report.table(table)
    return [one.bracket for one in found]


def constant(context: Context, entry: Search) -> List[Bracket]:
    theory, found = AddedMass(), search_all(context, "constant", entry)
    columns: List[Column[Found]] = [
        *FOUND,
        Column(csv="converges_at", value=lambda f: f.bracket.holds),
        Column(csv="diverges_at", value=lambda f: f.bracket.fails),
        Column("theory 2/(1 + |G|)", "theory", lambda f: theory.largest_factor(f.step), ".4f"),
        RUNS,
    ]
    table = Table(
        "added_mass_constant",
        "Largest factor of `constant` that converges",
        columns,
        found,
        notes=[
            "Within one step the discrete fluid is 1.17 times as heavy as the theory's and the wall answers "
            "with 0.74 (alpha = 0.5) to 0.87 (alpha small) of its mass and stiffness: docs/coupling.md."
        ],
    )
    context.report.table(table)
    return [one.bracket for one in found]


def text(bracket: Bracket) -> str:
    if bracket.value is not None and bracket.width is not None:
        return f"{bracket.value:.3g} ± {bracket.width / 2:.0%}"
    return f"none: all fail up to {bracket.fails:g}" if bracket.fails else f"none: all hold from {bracket.holds:g}"
