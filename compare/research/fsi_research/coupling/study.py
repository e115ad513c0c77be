"""The kind `coupling`: passes per step of the coupling schemes, their agreement with the monolithic solution, what the
added mass does to them, and their cost beside the monolithic driver's.

Groups by name, or by name and a suffix (passes, passes-fine), each of which may be missing:
  passes     the schemes at their tolerance; varied: mesh
  agreement  the same with a tight tolerance, and the monolithic driver, for the same cases and meshes
  density, step   the schemes, and the monolithic driver, over structure.density and time.step (see sweeps)
  cost       the schemes and the monolithic driver; the first method is the reference
`[report]`: `sweeps` (see sweeps); `explicit` and `constant`, sections with what is bisected (see added_mass_runs)."""

from collections import Counter
from typing import Dict, List, Sequence

from fsi_compare.base.errors import InputError
from ..catalogue.names import MATERIALS
from fsi_compare.reporting.cost import Cost, cost_table, read_cost
from ..evidence.cross_check import WRONG, Cell
from fsi_compare.study.context import Context
from fsi_compare.study.study_file import Study
from fsi_compare.study.study_run import DONE, StudyRun
from . import added_mass_runs, sweeps
from .pictures import passes_figure
from .tables import Agreement, agreement_table, agreements, growth_table, mesh_name, passes_table, saving_table

GROUPS = ("passes", "agreement", "density", "step", "cost")
MONOLITHIC = sweeps.MONOLITHIC
AGREE = 1e-3  # relative difference of pressures that no picture shows


def check(study: Study) -> None:
    for request in study.requests:
        if base(request.group) not in GROUPS:
            raise InputError(
                study.path, f"runs.{request.group}", "is no group of a coupling study", f"there are {', '.join(GROUPS)}"
            )
    sweeps.settings_of(study)
    added_mass_runs.check(study)


def also_runs(study: Study) -> List[str]:
    """For `--list`: what is run beside the study's runs."""
    return [
        f"{name}: {entry.case}, {entry.method}, bisection of {added_mass_runs.QUANTITIES[name]} from "
        f"{entry.low:g} to {entry.high:g}, {len(entry.steps) * len(entry.stabilisations)} times"
        for name, entry in added_mass_runs.sections(study).items()
    ]


def evaluate(context: Context) -> int:
    report = context.report
    passes, agreement = chosen(context, "passes"), chosen(context, "agreement")
    report.section("In short")
    report.list(in_short(passes, agreements(agreement), context.runs))
    report.section("Coupling iterations")
    if passes:
        report.text(
            "Coupling iterations per step, mean (range). A pass is one solve of the fluid and one of the wall; "
            "of `newton-krylov` every evaluation of the interface residual counts."
        )
        report.table(passes_table(passes))
        growth = growth_table(passes)
        if growth.records:
            report.table(growth)
    if agreement:
        report.text(
            "The converged partitioned step and the monolithic step solve the same equations. Largest "
            "difference of the pressure along the centre line, relative to the largest pressure of the time "
            "level, worst of all levels:"
        )
        report.table(agreement_table(agreement))
    wrong: List[Cell] = []
    for group, quantity, unit in (("density", "density ratio of wall and fluid", ""), ("step", "time step", "ms")):
        wrong += sweep_section(context, group, quantity + (f" in {unit}" if unit else ""), f"Against the {quantity}")
    bisected = 0
    if added_mass_runs.sections(context.study):
        report.section("Added mass")
        bisected = added_mass_runs.report(context)
    runs = chosen(context, "cost")
    if runs:
        report.section("Cost at the same accuracy of the interface condition")
        loose = [name for name in sweeps.settings_of(context.study).one_pass if _is_among(name, runs)]
        if loose:
            report.text(
                f"But of {', '.join(f'`{name}`' for name in loose)}, which do not iterate, or not on all: theirs is the cost of a "
                "step of the same length, at which they leave what the sweeps above say."
            )
        cost_section(context, runs)
    missing = [
        run for run in context.runs if base(run.request.group) in ("passes", "agreement", "cost") and not run.done
    ]
    report.section("Runs")
    report.text(count_in_words(context, bisected))
    for cell in wrong:
        report.text(
            f"**At fault:** {cell.run.request.group}, {cell.run.request.label}: {cell.outcome}"
            + (f", off by {cell.off:.1e}" if cell.outcome == WRONG else f", {cell.run.message}")
        )
    for run in missing:
        report.text(f"**Missing:** {run.request.group}, {run.request.label}: {run.status}, {run.message}")
    return 2 if missing or wrong else 0


def in_short(passes: Sequence[StudyRun], agreement: Sequence[Agreement], runs: Sequence[StudyRun]) -> List[str]:
    """The findings in words; of what was not run nothing is said. `agreement`: see agreements()."""
    lines = []
    means: Dict[str, List[float]] = {}
    for run in passes:
        if run.done:
            means.setdefault(run.method_label, []).append(run.passes)
    if means:
        best, worst = (pick(means, key=lambda label: max(means[label])) for pick in (min, max))
        line = f"Fewest coupling iterations a step: {best}, {_span(means[best])} over walls and meshes"
        lines.append(line + (f"; most: {worst}, {_span(means[worst])}." if worst != best else "."))
    differences = [a.difference for a in agreement if a.difference is not None]
    if differences:
        lines.append(
            f"Converged steps and monolithic ones agree: the pressure differs by at most {max(differences):.1e} of the "
            f"largest pressure of a time level, in {len(differences)} runs."
            if max(differences) < AGREE
            else f"Converged steps and monolithic ones do not agree: the pressure differs by up to {max(differences):.1e} "
            "of the largest pressure of a time level."
        )
    statuses = {run.folder: run.status for run in runs}  # the same run asked for twice is one
    failed = Counter(status for status in statuses.values() if status != DONE)
    shown = ", ".join(f"{count} {status}" for status, count in failed.items())
    lines.append(
        f"{failed.total()} of {len(statuses)} runs did not come to their end: {shown}."
        if failed
        else f"All {len(statuses)} runs came to their end."
    )
    return lines


def _is_among(method: str, runs: Sequence[StudyRun]) -> bool:
    return any(run.request.method.name == method for run in runs)


def _span(values: Sequence[float]) -> str:
    low, high = f"{min(values):.1f}", f"{max(values):.1f}"
    return low if low == high else f"{low} to {high}"


def sweep_section(context: Context, group: str, label: str, heading: str) -> List[Cell]:
    """The runs at fault."""
    runs = chosen(context, group)
    if not runs:
        return []
    settings = sweeps.settings_of(context.study)
    found = sweeps.checked(runs, settings)
    context.report.section(heading)
    context.report.text(sweeps.in_words(found, settings))
    context.report.figure(
        f"passes_{group}",
        lambda: passes_figure(sweeps.series(found), label, runs[0].request.settings, settings.bound),
        f"Mean coupling iterations per step against the {label}."
        + (
            " In the strip above, a mark per scheme: the run failed there, i.e. it diverged or reached its limit of "
            "iterations, and said so."
            if any(value is None for line in sweeps.series(found) for value in line.passes)
            else ""
        )
        + (
            " Crossed out: the run came to its end with another answer than the monolithic one."
            if any(sweeps.off(cell) for cell in found)
            else ""
        ),
    )
    context.report.table(sweeps.sweep_table(group, label, found, settings))
    return sweeps.faults(found)


def count_in_words(context: Context, bisected: int) -> str:
    different = len({run.folder for run in context.runs})
    text = (
        f"The study file asks for {len(context.runs)} runs, {different} of them different: one that is asked for "
        "twice is made once."
    )
    return text + (f" Bisection added {bisected}, {different + bisected} in all." if bisected else "")


def base(group: str) -> str:
    return group.partition("-")[0]


def chosen(context: Context, group: str) -> List[StudyRun]:
    return [run for run in context.runs if base(run.request.group) == group]


def cost_section(context: Context, runs: Sequence[StudyRun]) -> None:
    done = [run for run in runs if run.done]
    for mesh in dict.fromkeys(mesh_name(run) for run in done):
        here = [run for run in done if mesh_name(run) == mesh]
        for case in dict.fromkeys(run.request.case for run in here):
            own = [run for run in here if run.request.case == case]
            costs = [read_cost(run.folder, run.method_label) for run in own]
            table = cost_table(costs, f"Cost, {MATERIALS.get(case, case)}, {mesh} mesh")
            table.stem = f"coupling_cost_{case}_{mesh}".strip("_")
            context.report.table(table)
            saving = saving_table(
                own,
                costs,
                f"coupling_saving_{case}_{mesh}".strip("_"),
                f"What is saved, {MATERIALS.get(case, case)}, {mesh} mesh",
            )
            if saving:
                context.report.table(saving)
