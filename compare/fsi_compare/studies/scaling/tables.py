"""Tables of the study of scaling."""

from typing import List, Optional, Sequence, Tuple

from ...reporting.layout import Table, fixed
from .measured import Measured, Spread
from .model import Step

MEANINGLESS = "-"  # where there were more processes than cores


def short(value: float) -> str:
    """Three digits, or all before the point."""
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def alone(runs: Sequence[Measured]) -> Optional[Measured]:
    return next((run for run in runs if run.processes == 1), None)


def strong_table(by_method: Sequence[Sequence[Measured]], fast: Sequence[Optional[Measured]], stem: str) -> Table:
    """`fast`: of each method, the run of its driver by the solver for one process."""
    table = Table(
        stem=stem,
        title="The same mesh on more processes",
        columns=[
            ("", "method"),
            ("", "processes"),
            ("seconds per step", "measured"),
            ("seconds per step", "of `fast` on one"),
            ("", "speed-up"),
            ("", "efficiency"),
            ("iterations per step", "Newton"),
            ("iterations per step", "linear"),
            ("memory per process in MiB", "largest"),
            ("memory per process in MiB", "mean"),
        ],
        csv_columns=[
            "method",
            "processes",
            "cores_suffice",
            "nodes",
            "unknowns",
            "seconds_per_step",
            "fast_seconds_per_step",
            "speed_up",
            "efficiency",
            "newton_per_step",
            "linear_per_step",
            "memory_max_MiB",
            "memory_mean_MiB",
            "folder",
        ],
    )
    for runs, reference in zip(by_method, fast):
        one = alone(runs)
        for run in runs:
            speed = None if run.crowded or one is None else one.seconds / run.seconds
            seconds = None if run.crowded else run.seconds
            against = reference and reference.seconds
            table.rows.append(
                [
                    run.label,
                    str(run.processes),
                    fixed(seconds, ".3g"),
                    fixed(against, ".3g"),
                    fixed(speed, ".2f"),
                    fixed(speed and speed / run.processes, ".0%"),
                    f"{run.newton:.2f}",
                    f"{run.linear:.1f}",
                    fixed(run.memory and run.memory.maximum, ".0f"),
                    fixed(run.memory and run.memory.mean, ".0f"),
                ]
            )
            table.csv_rows.append(
                [
                    run.run.request.method.name,
                    run.processes,
                    not run.crowded,
                    run.nodes,
                    run.unknowns,
                    run.seconds,
                    against,
                    speed,
                    speed and speed / run.processes,
                    run.newton,
                    run.linear,
                    run.memory and run.memory.maximum,
                    run.memory and run.memory.mean,
                    run.run.folder.name,
                ]
            )
    if any(run.crowded for runs in by_method for run in runs):
        table.notes.append(
            "A dash in place of seconds: there were more processes than cores, so that they mean nothing; iterations, memory "
            "and counts do."
        )
    return table


def weak_table(by_method: Sequence[Sequence[Measured]]) -> Table:
    table = Table(
        stem="weak",
        title="A mesh that grows with the processes",
        columns=[
            ("", "method"),
            ("", "processes"),
            ("", "nodes"),
            ("", "nodes per process"),
            ("", "seconds per step"),
            ("", "efficiency"),
            ("iterations per step", "Newton"),
            ("iterations per step", "linear"),
            ("", "largest memory per process in MiB"),
        ],
        csv_columns=[
            "method",
            "processes",
            "cores_suffice",
            "nodes",
            "seconds_per_step",
            "efficiency",
            "newton_per_step",
            "linear_per_step",
            "memory_max_MiB",
            "folder",
        ],
    )
    for runs in by_method:
        one = alone(runs)
        for run in runs:
            efficiency = None if run.crowded or one is None else weak_efficiency(one, run)
            table.rows.append(
                [
                    run.label,
                    str(run.processes),
                    str(run.nodes),
                    f"{run.nodes / run.processes:.0f}",
                    fixed(None if run.crowded else run.seconds, ".3g"),
                    fixed(efficiency, ".0%"),
                    f"{run.newton:.2f}",
                    f"{run.linear:.1f}",
                    fixed(run.memory and run.memory.maximum, ".0f"),
                ]
            )
            table.csv_rows.append(
                [
                    run.run.request.method.name,
                    run.processes,
                    not run.crowded,
                    run.nodes,
                    run.seconds,
                    efficiency,
                    run.newton,
                    run.linear,
                    run.memory and run.memory.maximum,
                    run.run.folder.name,
                ]
            )
    table.notes.append(
        "Efficiency: seconds of a step per node of a process, of the run on one process over these; meshes are not exactly "
        "in the ratio of the processes."
    )
    return table


def weak_efficiency(one: Measured, run: Measured) -> float:
    return (one.seconds / one.nodes) / (run.seconds * run.processes / run.nodes)


def counts_table(by_method: Sequence[Sequence[Measured]]) -> Table:
    quantities: List[Tuple[str, str, str, str]] = [  # attribute, group, name, of CSV
        ("owned", "nodes of a process", "own", "owned_nodes"),
        ("halo", "nodes of a process", "halo", "halo_nodes"),
        ("neighbours", "", "neighbours", "neighbours"),
        ("messages", "sent per step and process", "messages", "messages"),
        ("megabytes", "sent per step and process", "MB", "megabytes"),
    ]
    table = Table(
        stem="counts",
        title="What each process holds and sends: mean, and the largest in brackets",
        columns=[
            ("", "method"),
            ("", "mesh nodes"),
            ("", "processes"),
            ("", "linear iterations per step"),
            *((group, name) for _, group, name, _ in quantities),
            ("", "reductions per step"),
        ],
        csv_columns=[
            "method",
            "nodes",
            "processes",
            "linear_per_step",
            *(f"{name}_{part}" for *_, name in quantities for part in ("min", "mean", "max")),
            "reductions",
            "solver_counted",
        ],
    )
    for run in (run for runs in by_method for run in runs):
        spreads: List[Spread] = [getattr(run, name) for name, *_ in quantities]
        table.rows.append(
            [
                run.label,
                str(run.nodes),
                str(run.processes),
                f"{run.linear:.1f}",
                *(f"{s.mean:.4g} ({s.maximum:.4g})" for s in spreads),
                f"{run.reductions:.0f}",
            ]
        )
        table.csv_rows.append(
            [
                run.run.request.method.name,
                run.nodes,
                run.processes,
                run.linear,
                *(value for s in spreads for value in (s.minimum, s.mean, s.maximum)),
                run.reductions,
                run.solver_counted,
            ]
        )
    if any(run.processes > 1 and not run.solver_counted for runs in by_method for run in runs):
        table.notes.append("Messages, bytes and reductions within the linear solver's library are not among them.")
    return table


def model_table(steps: Sequence[Tuple[str, Step, Step]]) -> Table:
    """(method, step on one process, step)."""
    table = Table(
        stem="model",
        title="The model: seconds of a time step on processes that are not here",
        columns=[
            ("", "method"),
            ("", "mesh nodes"),
            ("", "processes"),
            ("", "own nodes"),
            ("", "halo"),
            ("milliseconds per step", "work"),
            ("milliseconds per step", "latency"),
            ("milliseconds per step", "transfer"),
            ("milliseconds per step", "reductions"),
            ("milliseconds per step", "output"),
            ("milliseconds per step", "in all"),
            ("", "speed-up"),
            ("", "efficiency"),
            ("MiB per process", "solving"),
            ("MiB per process", "reading"),
        ],
        csv_columns=[
            "method",
            "nodes",
            "processes",
            "own_nodes",
            "halo_nodes",
            "linear_per_step",
            "work_s",
            "latency_s",
            "transfer_s",
            "reductions_s",
            "output_s",
            "step_s",
            "speed_up",
            "messages",
            "megabytes",
            "reductions",
            "memory_MiB",
            "reading_MiB",
        ],
    )
    for method, one, step in steps:
        speed = one.seconds / step.seconds
        table.rows.append(
            [
                method,
                str(step.nodes),
                str(step.processes),
                f"{step.own:.0f}",
                f"{step.halo:.0f}",
                *(
                    short(1e3 * value)
                    for value in (step.work, step.latency, step.transfer, step.reductions, step.output, step.seconds)
                ),
                short(speed),
                f"{speed / step.processes:.0%}",
                fixed(step.memory, ".0f"),
                fixed(step.reading, ".0f"),
            ]
        )
        table.csv_rows.append(
            [
                method,
                step.nodes,
                step.processes,
                step.own,
                step.halo,
                step.iterations,
                step.work,
                step.latency,
                step.transfer,
                step.reductions,
                step.output,
                step.seconds,
                speed,
                step.messages,
                step.megabytes,
                step.reduction_count,
                step.memory,
                step.reading,
            ]
        )
    table.notes.append("Reading: before each process lets go of what is not its part of the mesh.")
    return table
