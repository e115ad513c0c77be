"""The energy balance over all runs of the paper's study: how far it closes, and what the discretisation takes."""

from dataclasses import dataclass
from typing import Dict, List, Sequence, Tuple

from ..catalogue.names import MATERIALS
from fsi_compare.reporting.column import Column
from fsi_compare.reporting.layout import Table
from fsi_compare.reporting.report import Report
from ..evidence.energy_plots import Balance, balance, energy_section
from fsi_compare.study.study_run import StudyRun
from .runs import GROUPS, MONOLITHIC, RESOLVED, STOPPED_EARLY, WAVES, PaperRuns
from .speeds import level_of

FIBRES_WALL = "artery"
APPROACHES = {"fsi-monolithic": "monolithic", "fsi-partitioned": "partitioned"}


@dataclass(frozen=True)
class Remainder:
    """The worst of a group's runs."""

    group: str
    approach: str
    wall: str
    runs: int
    worst: float  # relative to what was supplied
    run: str  # which


def write_energy(report: Report, runs: PaperRuns) -> None:
    """A section; none where the waves have no run."""
    waves = [(material, runs.wave(material, runs.finest)) for material in runs.materials]
    shown = [(material, run) for material, run in waves if run]
    if not shown:
        return
    report.section("Energy")
    found = energy_section(
        report, [run for _, run in shown], [f"{MATERIALS[material]}, {runs.finest}" for material, _ in shown]
    )
    if not found:
        return
    balances = _balances(runs)
    worst = remainders(balances)
    report.text(_closes(worst), _lost(balances))
    report.table(remainder_table(worst))


def _balances(runs: PaperRuns) -> List[Tuple[StudyRun, Balance]]:
    pairs = [(run, balance(run)) for group in GROUPS for run in runs.all(group)]
    return [(run, one) for run, one in pairs if one is not None and len(one.times)]


def remainders(balances: Sequence[Tuple[StudyRun, Balance]]) -> List[Remainder]:
    """The worst remainders by group, approach, and whether the wall has fibres."""
    rows: Dict[Tuple[str, str, str], List[Tuple[float, str]]] = {}
    for run, one in balances:
        wall = "with fibres" if run.request.case == FIBRES_WALL else "without fibres"
        key = run.request.group, APPROACHES[run.request.method.program], wall
        rows.setdefault(key, []).append((one.largest_remainder, run.request.label))
    return [Remainder(*key, len(values), *max(values)) for key, values in rows.items()]


REMAINDERS: Sequence[Column[Remainder]] = (
    Column("runs of", "group", lambda r: r.group, left=True),
    Column("approach", "approach", lambda r: r.approach, left=True),
    Column("wall", "wall", lambda r: r.wall, left=True),
    Column("runs", "runs", lambda r: r.runs),
    Column("left over at most", "largest_remainder_relative", lambda r: r.worst, ".1e"),
    Column(csv="run", value=lambda r: r.run),
)


def remainder_table(found: Sequence[Remainder]) -> Table:
    return Table(
        "energy_remainder",
        "What the energy balance leaves over: the worst of the runs, relative to what was supplied",
        REMAINDERS,
        found,
        notes=[
            "Partitioned runs leave over what their tolerance lets the interface mismatch. Fibres tighten at a kink of "
            "the stress: the balance integrates it with an error where that falls within a step."
        ],
    )


def _closes(found: Sequence[Remainder]) -> str:
    """The worst in a sentence: converged runs by approach and wall, then those that were stopped early."""
    parts = []
    for approach in APPROACHES.values():
        for wall in ("without fibres", "with fibres"):
            values = [r.worst for r in found if (r.approach, r.wall) == (approach, wall) and r.group != STOPPED_EARLY]
            if values:
                parts.append(f"{approach} {wall} {max(values):.1e}")
    early = [r.worst for r in found if r.group == STOPPED_EARLY]
    if early:
        parts.append(f"stopped early, at loose tolerances, {max(early):.1e}")
    return (
        "What the balance leaves over, relative to what was supplied, in the worst of all "
        f"{sum(r.runs for r in found)} runs: {'; '.join(parts)}."
    )


def _lost(balances: Sequence[Tuple[StudyRun, Balance]]) -> str:
    """Lost to the discretisation in whole monolithic runs, by mesh and step, in the first step and in all."""
    rows: Dict[Tuple[str, float, float], List[Tuple[float, float]]] = {}
    for run, one in balances:
        if run.request.group in (WAVES, RESOLVED) and run.request.method.name == MONOLITHIC and one.end("supplied") > 0:
            lost = one.parts["lost by discretisation"] / one.end("supplied")
            rows.setdefault((level_of(run), float(one.times[0]), float(one.times[-1])), []).append((lost[-1], lost[0]))
    if not rows:
        return "No run tells what the discretisation takes."
    parts = [
        f"{_percents([a for a, _ in values])} until {end:g} ms on the {level} mesh with steps of {step:g} ms, "
        f"{_percents([b for _, b in values])} in the first step"
        for (level, step, end), values in rows.items()
    ]
    steps = {step for _, step, _ in rows}
    only = f" The study has no other step than {steps.pop():g} ms." if len(steps) == 1 else ""
    return f"Lost to the discretisation, of what was supplied, over the walls: {'; '.join(parts)}.{only}"


def _percents(values: Sequence[float]) -> str:
    low, high = (f"{100 * value:.0f}" for value in (min(values), max(values)))
    return f"{low} %" if low == high else f"{low} to {high} %"
