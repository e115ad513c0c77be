"""Kind `scaling`: one case on more and more processes, on the cores that are here, and a model of what more of them
would give.

`[report.scaling]` names groups of runs: `strong`, one mesh on varied processes; `weak`, meshes that grow with them;
`counts`, on more processes than cores, whose iterations and messages count and whose seconds do not. `[report.model]`:
processes and nodes that the model is asked for, and the machine that it imagines."""

from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

from fsi_compare.base.errors import InputError
from fsi_compare.starting.launch import usable_cores
from fsi_compare.study.runs_table import runs_table
from fsi_compare.study.context import Context
from fsi_compare.study.study_file import Study
from ..catalogue.report_section import ReportSection, report_of
from fsi_compare.study.study_run import StudyRun
from .measured import Measured, measure
from .model import Counted, Machine, Step, assumptions, counted, step
from .tables import alone, counts_table, short, model_table, strong_table, weak_efficiency, weak_table

GROUPS = ("strong", "weak", "counts")
MODEL_KEYS = (
    "processes",
    "nodes",
    "latency_us",
    "bandwidth_GB_s",
    "reduction_us",
    "neighbours",
    "solver_exchanges",
    "solver_halos",
    "solver_reductions",
)
REPORT_KEYS = ("scaling", "model")


@dataclass(frozen=True)
class Asked:
    """What the study's [report] says."""

    groups: Any  # name in the study of each of GROUPS
    processes: Sequence[int]
    nodes: Sequence[int]  # of meshes beside the study's own
    machine: Machine


def check(study: Study) -> None:
    found = asked(study)
    groups = {request.group for request in study.requests}
    if found.groups["strong"] not in groups:
        remedy = "name the group in which processes are varied on one mesh"
        raise InputError(study.path, "report.scaling.strong", f"'{found.groups['strong']}' is no group of runs", remedy)
    for request in study.requests:
        if request.group in (found.groups["strong"], found.groups["counts"]) and request.processes is None:
            raise InputError(
                study.path, f"runs.{request.group}.vary", "does not vary processes", 'write processes = "cores"'
            )


def asked(study: Study) -> Asked:
    report = report_of(study, REPORT_KEYS)
    groups, model = report.section("scaling", GROUPS), report.section("model", MODEL_KEYS)
    default = Machine()
    return Asked(
        {name: groups.text(name, name) for name in GROUPS},
        _whole(model, "processes", [64, 1024]),
        _whole(model, "nodes", []) if "nodes" in model else [],
        Machine(
            latency=1e-6 * model.number("latency_us", 1e6 * default.latency),
            bandwidth=1e9 * model.number("bandwidth_GB_s", default.bandwidth / 1e9),
            hop=1e-6 * model.number("reduction_us", 1e6 * default.hop),
            neighbours=model.number("neighbours") if "neighbours" in model else default.neighbours,
            solver_exchanges=model.number("solver_exchanges", default.solver_exchanges),
            solver_halos=model.number("solver_halos", default.solver_halos),
            solver_reductions=model.number("solver_reductions", default.solver_reductions),
        ),
    )


def _whole(section: ReportSection, name: str, default: Sequence[int]) -> List[int]:
    values = section.numbers(name, [float(value) for value in default])
    for value in values:
        if value != int(value) or value < 1:
            raise section.wrong(name, f"{value:g} is no whole number", "write [64, 1024]")
    return [int(value) for value in values]


def evaluate(context: Context) -> int:
    report, study, runner = context.report, context.study, context.runner
    cores = usable_cores()
    settings = asked(study)
    broken = [run for run in context.runs if not run.done]

    def lines(group: str) -> List[List[Measured]]:
        """Finished runs of each method (and mesh, unless that grows with the processes) of a group, by processes."""
        found = [run for run in context.runs if run.done and run.request.group == settings.groups[group]]
        meshes = {_mesh(run) for run in found} if group != "weak" else set()
        by_line: Dict[str, List[Measured]] = {}
        for run in found:
            method = run.method_label
            label = f"{method}, {_mesh(run)}" if len(meshes) > 1 else method
            processes = runner.processes_of(run.request)
            by_line.setdefault(label, []).append(measure(run, label, processes, runner.threads, cores))
        return [sorted(runs, key=lambda run: run.processes) for runs in by_line.values()]

    strong, weak, counts = (lines(group) for group in GROUPS)
    everything = [run for lines_of_group in (strong, weak, counts) for runs in lines_of_group for run in runs]
    models = [(runs, _counted(_with_counts(runs, counts), everything)) for runs in strong]
    modelled = _modelled([(runs, model) for runs, model in models if model is not None], settings)

    report.section("In short")
    if broken:
        report.text(f"**{len(broken)} runs did not come to their end:**")
        report.list([f"{run.request.label}: {run.status}, {run.message}" for run in broken])
    report.list([*_in_short(strong, cores), *_weak_in_short(weak), *_model_in_short(modelled)])
    from .pictures import counts_figure, model_figure, times_figure  # matplotlib takes a second to load

    report.section("On the cores that are here")
    report.figure(
        "scaling",
        lambda: times_figure(strong, weak),
        f"Seconds of time steps on up to {cores} processes, as many as there are cores; grey: ideal. Above that number "
        "seconds mean nothing and are not drawn.",
    )
    report.table(strong_table(strong, "strong"))
    if weak:
        report.table(weak_table(weak))
    if counts or strong:
        shown = counts or strong
        report.section("What is counted")
        report.text(
            "Iterations, halos and messages do not depend on how many cores there are. A process counts itself; the means "
            "are drawn."
        )
        report.figure("counts", lambda: counts_figure(shown), "Left: how the preconditioner bears being shared out.")
        report.table(counts_table(shown))
    if modelled:
        report.section("What more processes would give")
        report.text("A model, not a measurement. It assumes:")
        for runs, model in models:
            if model is not None:
                if len(models) > 1:
                    report.subsection(runs[0].label)
                report.list(assumptions(model, settings.machine, cores))
        report.figure(
            "model",
            lambda: model_figure([(_row(name, one), one) for name, _, one in modelled]),
            "Each bar is a time step; behind it its length.",
        )
        report.table(model_table(modelled))
    report.folded("All runs", [runs_table(context.runs)])
    return 2 if broken else 0


def _with_counts(runs: Sequence[Measured], counts: Sequence[Sequence[Measured]]) -> List[Measured]:
    """And those on more processes that differ in nothing else."""

    def same(other: Measured) -> bool:
        a, b = runs[0].run.request, other.run.request
        return (a.case, a.method.name, runs[0].nodes) == (b.case, b.method.name, other.nodes)

    there = {run.processes for run in runs}
    more = [run for others in counts for run in others if same(run) and run.processes not in there]
    return sorted([*runs, *more], key=lambda run: run.processes)


def _counted(runs: Sequence[Measured], others: Sequence[Measured]) -> Optional[Counted]:
    return counted(runs, _dimension(runs[0].run), others) if runs else None


def _mesh(run: StudyRun) -> str:
    return run.request.mesh.label if run.request.mesh else ""


def _dimension(run: StudyRun) -> int:
    return 3 if run.summary.get("geometry", "3d") == "3d" else 2


def _modelled(models: Sequence[Tuple[Sequence[Measured], Counted]], settings: Asked) -> List[Tuple[str, Step, Step]]:
    """(method, step on one process, step) for the study's mesh and those that it names beside it."""
    found = []
    for runs, model in models:
        for nodes in dict.fromkeys([model.nodes, *settings.nodes]):
            one = step(model, settings.machine, nodes, 1)
            for processes in settings.processes:
                found.append((runs[0].label, one, step(model, settings.machine, nodes, processes)))
    return found


def _row(name: str, one: Step) -> str:
    return f"{name}\n{one.nodes:,} nodes on {one.processes:,} processes"


def _in_short(strong: Sequence[Sequence[Measured]], cores: int) -> List[str]:
    lines = []
    for runs in strong:
        one, most = alone(runs), max(runs, key=lambda run: (not run.crowded, run.processes))
        if one is None:
            continue
        words = f"{runs[0].label}, {one.nodes:,} nodes: "
        if most.processes > 1 and not most.crowded:
            words += (
                f"a step on {most.processes} processes takes {most.seconds / one.seconds:.2f} of the time on one (speed-up "
                f"{one.seconds / most.seconds:.2f}). "
            )
        elif cores == 1:
            words += "there is one core, so that no speed-up can be measured. "
        last = runs[-1]
        words += f"Linear iterations: {one.linear:.1f} a step on one process, {last.linear:.1f} on {last.processes}."
        lines.append(words)
    return lines


def _weak_in_short(weak: Sequence[Sequence[Measured]]) -> List[str]:
    lines = []
    for runs in weak:
        one = alone(runs)
        shown = [run for run in runs if not run.crowded and run.processes > 1]
        if one is not None and shown:
            lines.append(
                f"{runs[0].label}, {one.nodes / one.processes:,.0f} nodes a process: on {shown[-1].processes} processes "
                f"{weak_efficiency(one, shown[-1]):.0%} of the efficiency of one."
            )
    return lines


def _model_in_short(modelled: Sequence[Tuple[str, Step, Step]]) -> List[str]:
    tell: Callable[
        [Step, Step], str
    ] = (
        lambda one, many: f"{many.nodes:,} nodes on {many.processes:,} processes {short(one.seconds / many.seconds)} times faster"
    )
    names = list(dict.fromkeys(name for name, _, _ in modelled))
    return [
        f"Modelled, {name}: " + "; ".join(tell(one, many) for other, one, many in modelled if other == name) + "."
        for name in names
    ]
