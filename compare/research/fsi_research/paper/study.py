"""The kind `paper`: the paper's tables and figures beside ours, and each of its claims with what became of it.

Groups of runs by name, all but `waves` may be missing: waves, resolved, newton, fixed-point, cost, stopped-early,
fibres, printed-density (see paper.runs). `[report.linear]`: meshes and methods of the linear-solver tables (see
paper.linear)."""

from pathlib import Path
from typing import Dict, List, Mapping, Sequence

from ..catalogue import paper
from fsi_compare.base.errors import InputError
from ..catalogue.names import MATERIALS
from fsi_compare.base.suggestions import check_keys, nearest
from ..linear import solver_pictures
from ..linear.grid import Grid
from ..linear.solver_tables import solver_tables
from fsi_compare.reporting.report import Report
from ..evidence.mesh_error import MeshError, error_words
from ..evidence.phase_bars import MEANING, phase_figure, phase_table
from ..evidence.tube import Tube, read_tube
from fsi_compare.study.context import Context
from fsi_compare.study.runner import Runner, Standing
from fsi_compare.study.study_file import Study
from fsi_compare.study.study_run import StudyRun
from . import cost as paper_cost, linear as paper_linear, speeds as paper_speeds, tables as paper_tables
from . import waves as paper_waves
from .answer import Found, answer
from .claims import claims_table, rules_table, tally
from .energy import write_energy
from .runs import DENSITY, GROUPS, MONOLITHIC, PARTITIONED, WAVES, PaperRuns, mesh_of
from .solver_claims import comparisons, solver_claims
from .speeds import Speeds
from .wave_claims import wave_claims
from .waves import Stopped

REPORT_KEYS = ("linear",)


def check(study: Study) -> None:
    for case in study.cases:
        if case not in MATERIALS:
            remedy = f"did you mean '{nearest(case, list(MATERIALS))}'? There are {', '.join(MATERIALS)}"
            raise InputError(study.path, f"cases.{case}", "is none of the paper's materials", remedy)
    for request in study.requests:
        if request.group not in GROUPS:
            remedy = f"did you mean '{nearest(request.group, GROUPS)}'? There are {', '.join(GROUPS)}"
            raise InputError(study.path, f"runs.{request.group}", "is no group of this kind of study", remedy)
    check_keys(study.path, "report", study.report, REPORT_KEYS)
    if not any(request.group == WAVES and request.method.name == MONOLITHIC for request in study.requests):
        raise InputError(
            study.path, f"runs.{WAVES}", f"has no runs of a method '{MONOLITHIC}'", "the whole report stands on them"
        )
    paper_linear.check(study)


def also_runs(study: Study) -> List[str]:
    """For `--list`: what is run beside the study's runs."""
    chosen = paper_linear.chosen(study)
    if chosen is None:
        return []
    methods = ", ".join(chosen.methods)
    return [
        f"linear systems: {material}, {mesh}{which}: {methods}"
        for meshes, which in ((chosen.meshes, ""), (chosen.later_meshes, ", later ones"))
        for mesh in meshes
        for material in study.cases
    ]


def also_standing(study: Study, runner: Runner) -> Standing:
    """How many of also_runs() are there, for the list of studies."""
    return paper_linear.standing(study, runner)


def evaluate(context: Context) -> int:
    """Exit code 2 when a run is missing."""
    grid, later = paper_linear.solve(context)
    runs = PaperRuns(context.runs)
    meshes = paper_tables.mesh_counts(runs, grid)
    agreements = paper_waves.agreements(runs)
    reference, stopped = paper_waves.stopped_early(runs)
    speeds = paper_speeds.speeds(runs)
    costs = paper_cost.costs(runs, grid)
    cycles = paper_cost.cycles_per_iteration(grid, mesh_of(costs[-1].run)) if costs else None
    claims = [
        *solver_claims(grid, later, meshes),
        *wave_claims(agreements, stopped, speeds),
        *paper_cost.cost_claims(runs, costs, cycles),
    ]
    claims.sort(key=lambda claim: claim.section)  # keeps the order within a section
    claims += comparisons(grid)

    grids = [one for one in (grid, later) if one]
    missing = _missing(context.runs, grids)
    errors = paper_waves.wave_errors(runs)

    report = context.report
    report.answer(answer(Found(runs, claims, agreements, speeds, errors, costs, missing)))
    report.section("The waves")
    paper_waves.three_walls(report, runs, errors)
    paper_waves.through_time(report, runs)
    report.section("Claims")
    report.text(
        f"{paper.source().split(', section')[0]}. {tally(claims)} What each verdict asks for stands at the end."
    )
    report.table(claims_table(claims))
    if agreements:
        report.section("Both drivers beside each other")
        paper_waves.driver_pictures(report, runs, errors)
        report.table(paper_waves.agreement_table(agreements))
    paper_waves.tube_picture(report, runs, errors)
    if reference and stopped:
        _stopped(report, runs, reference, stopped, errors)
    if speeds:
        _speeds(report, runs, speeds)
    write_energy(report, runs)
    if costs:
        _cost(report, costs)
    _phases(report, runs, costs)
    report.section("Parameters, meshes, solvers: the paper's tables")
    report.table(paper_tables.parameter_table(context.study.cases, printed_density=bool(runs.all(DENSITY))))
    if meshes:
        report.table(paper_tables.mesh_table(meshes))
    if grid:
        _linear(report, grid, paper_linear.systems_at_once(context))
    if missing:
        report.section("Missing")
        report.list(missing)
    report.section("Rules")
    report.folded("What each verdict asks for", [rules_table(claims)])
    return 2 if missing else 0


def _stopped(
    report: Report, runs: PaperRuns, reference: StudyRun, stopped: Sequence[Stopped], errors: Mapping[Path, MeshError]
) -> None:
    report.section("Why a partitioned wave can differ")
    report.text("The same partitioned program, told to accept an interface that does not match yet:")
    error = errors.get(reference.folder)
    report.figure(
        "stopped_early",
        lambda: paper_waves.stopped_figure(reference, runs),
        "The wave when the interface iteration is stopped early, beside the monolithic one."
        + (f" {error_words([('', error)])[:-1]}, of the monolithic one." if error else ""),
    )
    report.table(paper_waves.stopped_table(reference, stopped))


def _linear(report: Report, grid: Grid, at_once: int) -> None:
    if at_once > 1:
        report.text(
            f"The linear systems were solved {at_once} at once: their iterations and cycles are exact, their seconds are "
            "longer than on a machine of one's own."
        )
    for table in solver_tables(grid):
        report.table(table)
    if len(grid.meshes) < 2:
        return  # a single mesh makes no curve
    for path in solver_pictures.write_solver_pictures(report.folder, grid):
        report.written.append(path)
        if path.suffix == ".png":
            what = (
                "Iterations of the linear solvers against the number of unknowns"
                if path.stem.startswith("iterations")
                else f"Cost of the linear solvers, timed once: differences "
                f"within a factor of {paper_cost.NOISE:g} say nothing"
            )
            report.image(path, f"{what}; first Newton system from rest.")


def _speeds(report: Report, runs: PaperRuns, speeds: Sequence[Speeds]) -> None:
    report.section("Speed of the wave")
    tubes: Dict[str, Tube] = {
        material: read_tube(runs.all(WAVES, material)[0].request.case_file) for material in runs.materials
    }
    levels = paper_speeds.levels_of(runs)
    bars = any(s.finest and s.finest.speed_error is not None for s in speeds)
    crests = any(m.speed is not None for s in speeds for m in s.measured.values())
    report.figure(
        "wave_speed",
        lambda: paper_speeds.speed_figure(speeds, tubes, levels),
        "Left: phase speed in the thick wall against the wave number. Right: theory as lines"
        + (", the crest's speed in the runs as marks" if crests else "")
        + ("; their bars are the difference of the two finest levels" if bars else "")
        + f". {paper_speeds.MEANING} The error of mesh and step of these waves: table `mesh_error`.",
    )
    report.table(paper_speeds.speed_table(speeds, levels))


def _cost(report: Report, costs: Sequence[paper_cost.StepCost]) -> None:
    report.section("Cost")
    own = paper_cost.paper_rounds()
    report.text(
        f"The paper counts {own['partitioned']:.0f} rounds of sub-problem solves a step for the partitioned approach "
        f"(50 to 55 fixed-point iterations of 4 to 5 Newton iterations) and {own['monolithic']:.0f} for the monolithic "
        "one (4 Newton iterations of 10 coupled iterations), and states a saving of almost 50 %. It gives no seconds."
    )
    report.table(paper_cost.cost_table(costs))
    saved = paper_cost.savings(costs)
    if saved:
        report.table(paper_cost.saving_table(saved))


def _phases(report: Report, runs: PaperRuns, costs: Sequence[paper_cost.StepCost]) -> None:
    shown: List[StudyRun] = [c.run for c in costs]
    if not shown:
        shown = [run for method in (MONOLITHIC, PARTITIONED) for run in runs.all(WAVES, method=method)]
    if shown and not costs:
        report.section("Cost")
    by_mesh: Dict[str, List[StudyRun]] = {}
    for run in shown:
        by_mesh.setdefault(mesh_of(run), []).append(run)
    for mesh, group in by_mesh.items():
        labels = [run.method_label for run in group]
        report.figure(
            f"phases_{mesh}",
            lambda: phase_figure(group, labels, f"Where the time goes, {mesh} mesh"),
            f"Wall time of a step by phase. {MEANING}",
        )
        report.table(
            phase_table(group, labels, stem=f"phases_{mesh}", title=f"Milliseconds per time step by phase, {mesh} mesh")
        )


def _missing(all_runs: Sequence[StudyRun], grids: Sequence[Grid]) -> List[str]:
    """What did not come to its end, one line each."""
    lines = [
        f"{run.request.group}, {run.request.label}: {run.status}: {run.message}" for run in all_runs if not run.done
    ]
    for grid in grids:
        for material in grid.materials:
            for mesh in grid.meshes:
                outcome = grid.outcome(material, mesh)
                if outcome and not outcome.results:
                    lines.append(f"linear systems, {material}, {mesh}: {outcome.failure}")
    return lines
