"""The kind `coupling`: passes per step of the coupling schemes, their agreement with the monolithic solution, what the
added mass does to them, and their cost beside the monolithic driver's.

Groups by name, or by name and a suffix (passes, passes-fine), each of which may be missing:
  passes     the schemes at their tolerance; varied: mesh
  agreement  the same with a tight tolerance, and the monolithic driver, for the same cases and meshes
  density, step   the schemes, and the monolithic driver, over structure.density and time.step (see sweeps)
  cost       the schemes and the monolithic driver; the first method is the reference
`[report]`: `sweeps` (see sweeps); `explicit` and `constant`, sections with what is bisected (see added_mass_runs)."""

from collections import Counter
from typing import Dict, List, Optional, Sequence, Tuple

from ...base.errors import InputError
from ...base.names import MATERIALS
from ...reporting.cost import Cost, cost_table, read_cost
from ...reporting.layout import Table, fixed
from ...runs.differences import largest_difference
from ..evidence.cross_check import WRONG, Cell
from ..running.context import Context
from ..running.study_file import Study, show
from ..running.study_run import DONE, StudyRun
from . import added_mass_runs, sweeps
from .pictures import passes_figure

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
    report.list(in_short(passes, agreement_table(agreement) if agreement else None, context.runs))
    report.section("Coupling iterations")
    if passes:
        report.text(
            "Coupling iterations per step, mean (range). A pass is one solve of the fluid and one of the wall; "
            "of `newton-krylov` every evaluation of the interface residual counts."
        )
        report.table(passes_table(context, passes))
        growth = growth_table(passes)
        if growth.rows:
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
        cost_section(context, runs)
    missing = [
        run for run in context.runs if base(run.request.group) in ("passes", "agreement", "cost") and not run.done
    ]
    report.section("Runs")
    report.text(count_in_words(context, bisected))
    for cell in wrong:
        report.text(
            f"**At fault:** {cell.run.request.group}, {cell.run.request.label}: {cell.outcome}"
            + (f", off by {cell.difference:.1e}" if cell.outcome == WRONG else f", {cell.run.message}")
        )
    for run in missing:
        report.text(f"**Missing:** {run.request.group}, {run.request.label}: {run.status}, {run.message}")
    return 2 if missing or wrong else 0


def in_short(passes: Sequence[StudyRun], agreement: Optional[Table], runs: Sequence[StudyRun]) -> List[str]:
    """The findings in words; of what was not run nothing is said. `agreement`: see agreement_table."""
    lines = []
    means: Dict[str, List[float]] = {}
    for run in passes:
        if run.done:
            means.setdefault(run.request.method.label, []).append(run.passes)
    if means:
        best, worst = (pick(means, key=lambda label: max(means[label])) for pick in (min, max))
        line = f"Fewest coupling iterations a step: {best}, {_span(means[best])} over walls and meshes"
        lines.append(line + (f"; most: {worst}, {_span(means[worst])}." if worst != best else "."))
    column = agreement.csv_columns.index("largest_relative_difference") if agreement else 0
    differences = [row[column] for row in agreement.csv_rows if row[column] is not None] if agreement else []
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


def methods(runs: Sequence[StudyRun]) -> List[str]:
    return list(dict.fromkeys(run.request.method.name for run in runs))


def mesh_name(run: StudyRun) -> str:
    return run.request.mesh.name if run.request.mesh else ""


def step_range(run: StudyRun) -> Tuple[float, int, int, int]:
    """Mean, least and most coupling iterations of a step, and the number of steps."""
    outer = run.columns("iterations.csv")["outer_iterations"]
    return float(outer.mean()), int(outer.min()), int(outer.max()), len(outer)


def passes_table(context: Context, runs: Sequence[StudyRun]) -> Table:
    """A line per scheme, a column per mesh and material."""
    columns = list(dict.fromkeys((mesh_name(run), run.request.case) for run in runs))
    names = {(mesh, case): (f"{mesh}, {steps(runs, mesh)} steps", MATERIALS.get(case, case)) for mesh, case in columns}
    table = Table(
        stem="coupling_passes",
        title="Coupling iterations per step, mean (range)",
        left=1,
        columns=[("", "scheme"), *(names[key] for key in columns)],
        csv_columns=["scheme", "mesh", "case", "tolerance", "steps", "mean", "least", "most", "status"],
    )
    for name in methods(runs):
        cells = []
        for mesh, case in columns:
            found = [
                r for r in runs if r.request.method.name == name and r.request.case == case and mesh_name(r) == mesh
            ]
            if not found:
                cells.append("")
                continue
            run = found[0]
            tolerance = run.request.settings.get("partitioned.tolerance")
            if run.done:
                mean, least, most, count = step_range(run)
                cells.append(f"{mean:.1f} ({least}-{most})")
                table.csv_rows.append([name, mesh, case, tolerance, count, mean, least, most, run.status])
            else:
                cells.append(run.status)
                table.csv_rows.append([name, mesh, case, tolerance, run.steps, None, None, None, run.status])
        table.rows.append([runs_label(runs, name), *cells])
    return table


def steps(runs: Sequence[StudyRun], mesh: str) -> int:
    return max(r.steps for r in runs if mesh_name(r) == mesh)


def runs_label(runs: Sequence[StudyRun], method: str) -> str:
    return next(run.request.method.label for run in runs if run.request.method.name == method)


def growth_table(runs: Sequence[StudyRun]) -> Table:
    """Mean over the steps that both runs have, on the finer mesh over the coarsest: the first steps take the most
    passes, so that only equal numbers of steps compare."""
    done = [run for run in runs if run.done]
    meshes = list(dict.fromkeys(mesh_name(run) for run in done))
    table = Table(
        stem="coupling_growth",
        title="Coupling iterations against the mesh, over the same steps",
        left=3,
        columns=[
            ("", "scheme"),
            ("", "material"),
            ("", "mesh"),
            ("", "steps"),
            ("", f"mean, {meshes[0] if meshes else ''}"),
            ("", "mean here"),
            ("", "ratio"),
        ],
        csv_columns=["scheme", "case", "mesh", "steps", "mean_coarsest", "mean", "ratio"],
    )
    for run in done:
        coarsest = [
            r
            for r in done
            if mesh_name(r) == meshes[0]
            and r.request.case == run.request.case
            and r.request.method.name == run.request.method.name
        ]
        if mesh_name(run) == meshes[0] or not coarsest:
            continue
        passes = [r.columns("iterations.csv")["outer_iterations"] for r in (coarsest[0], run)]
        count = min(len(p) for p in passes)
        base_mean, mean = (float(p[:count].mean()) for p in passes)
        r = run.request
        table.rows.append(
            [
                r.method.label,
                MATERIALS.get(r.case, r.case),
                mesh_name(run),
                str(count),
                f"{base_mean:.1f}",
                f"{mean:.1f}",
                f"{mean / base_mean:.2f}",
            ]
        )
        table.csv_rows.append([r.method.name, r.case, mesh_name(run), count, base_mean, mean, mean / base_mean])
    return table


def agreement_table(runs: Sequence[StudyRun]) -> Table:
    """A line per scheme, a column per mesh and material: difference (iterations per step)."""
    schemes = [run for run in runs if run.request.method.program != MONOLITHIC]
    tolerances = sorted({show(run.request.settings.get("partitioned.tolerance", "?")) for run in schemes})
    columns = list(dict.fromkeys((mesh_name(run), run.request.case) for run in schemes))
    table = Table(
        stem="coupling_agreement",
        left=1,
        title=f"Relative difference to the monolithic pressure at tolerance {', '.join(tolerances)} "
        "(iterations per step)",
        columns=[("", "scheme"), *((mesh, MATERIALS.get(case, case)) for mesh, case in columns)],
        csv_columns=[
            "scheme",
            "mesh",
            "case",
            "tolerance",
            "common_levels",
            "iterations_per_step",
            "largest_relative_difference",
            "status",
        ],
    )
    for name in methods(schemes):
        cells = []
        for mesh, case in columns:
            own = [r for r in schemes if (r.request.method.name, mesh_name(r), r.request.case) == (name, mesh, case)]
            cells.append(agreement_cell(table, own[0], runs) if own else "")
        table.rows.append([runs_label(runs, name), *cells])
    counts = [(row[1], row[4]) for row in table.csv_rows]
    for mesh in dict.fromkeys(mesh for mesh, _ in columns):
        levels = sorted({count for m, count in counts if m == mesh and count})
        table.notes.append(f"{mesh}: time levels compared {', '.join(map(str, levels))}.")
    return table


def agreement_cell(table: Table, run: StudyRun, runs: Sequence[StudyRun]) -> str:
    r = run.request
    whole = [
        m
        for m in runs
        if m.request.method.program == MONOLITHIC
        and m.request.case == r.case
        and mesh_name(m) == mesh_name(run)
        and m.done
    ]
    difference: Optional[float] = None
    levels = 0
    if whole and run.done:
        over_time = largest_difference(max(whole, key=lambda m: m.steps).pressure, run.pressure)
        levels, difference = over_time.levels, over_time.largest.max_relative if over_time.largest else None
    table.csv_rows.append(
        [
            r.method.name,
            mesh_name(run),
            r.case,
            r.settings.get("partitioned.tolerance"),
            levels,
            run.passes if run.done else None,
            difference,
            run.status,
        ]
    )
    return f"{fixed(difference, '.1e')} ({run.passes:.1f})" if run.done else run.status


def cost_section(context: Context, runs: Sequence[StudyRun]) -> None:
    done = [run for run in runs if run.done]
    for mesh in dict.fromkeys(mesh_name(run) for run in done):
        here = [run for run in done if mesh_name(run) == mesh]
        for case in dict.fromkeys(run.request.case for run in here):
            own = [run for run in here if run.request.case == case]
            costs = [read_cost(run.folder, run.request.method.label) for run in own]
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


def saving_table(runs: Sequence[StudyRun], costs: Sequence[Cost], stem: str, title: str) -> Optional[Table]:
    """What the cheapest monolithic run saves of each partitioned one: 1 - monolithic/partitioned, per step. The paper
    counts "almost 50 %"."""
    whole = [cost for run, cost in zip(runs, costs) if run.request.method.program == MONOLITHIC]
    if not whole:
        return None
    best = min(whole, key=lambda cost: cost.seconds_per_step)
    table = Table(
        stem=stem,
        title=title,
        left=1,
        columns=[
            ("", "scheme"),
            ("saved by the monolithic driver, %", "seconds"),
            ("saved by the monolithic driver, %", "linear solves"),
            ("saved by the monolithic driver, %", "linear iterations"),
        ],
        csv_columns=["scheme", "seconds_saved", "linear_solves_saved", "linear_iterations_saved"],
    )
    for run, cost in zip(runs, costs):
        if run.request.method.program == MONOLITHIC:
            continue
        saved = [
            share(best.seconds_per_step, cost.seconds_per_step),
            share(sum(best.solves.values()) / best.steps, sum(cost.solves.values()) / cost.steps),
            share(best.linear / best.steps, cost.linear / cost.steps),
        ]
        table.rows.append([cost.label, *(fixed(None if x is None else 100 * x, ".0f") for x in saved)])
        table.csv_rows.append([cost.label, *saved])
    table.notes.append(
        "Negative: the monolithic driver takes more. A linear solve of the whole system counts as one, "
        "like one of the fluid, the wall or the mesh motion."
    )
    return table


def share(whole: float, parts: float) -> Optional[float]:
    return 1 - whole / parts if parts else None
