"""Tables of the study of scaling."""

from typing import Callable, List, NamedTuple, Optional, Sequence, Tuple

from fsi_compare.reporting.column import Column, fixed
from fsi_compare.reporting.layout import Table
from .measured import Measured, Spread
from .model import Step


def short(value: float) -> str:
    """Three digits, or all before the point."""
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def alone(runs: Sequence[Measured]) -> Optional[Measured]:
    return next((run for run in runs if run.processes == 1), None)


class Strong(NamedTuple):
    """A run, and that on one process."""

    run: Measured
    one: Optional[Measured]

    @property
    def speed_up(self) -> Optional[float]:
        return None if self.run.crowded or self.one is None else self.one.seconds / self.run.seconds

    @property
    def efficiency(self) -> Optional[float]:
        return self.speed_up and self.speed_up / self.run.processes


MEMORY = "memory per process in {unit}"
STRONG: Sequence[Column[Strong]] = (
    Column("method", "method", lambda s: s.run.method, text=lambda s: s.run.label, left=True),
    Column("processes", "processes", lambda s: s.run.processes),
    Column(csv="cores_suffice", value=lambda s: not s.run.crowded),
    Column(csv="nodes", value=lambda s: s.run.nodes),
    Column(csv="unknowns", value=lambda s: s.run.unknowns),
    Column(
        "seconds per step",
        "seconds_per_step",
        lambda s: s.run.seconds,
        text=lambda s: fixed(s.run.meaningful_seconds, ".3g"),
    ),
    Column("speed-up", "speed_up", lambda s: s.speed_up, ".2f"),
    Column("efficiency", "efficiency", lambda s: s.efficiency, ".0%"),
    Column("Newton", "newton_per_step", lambda s: s.run.newton, ".2f", group="iterations per step"),
    Column("linear", "linear_per_step", lambda s: s.run.linear, ".1f", group="iterations per step"),
    Column("largest", "memory_max", lambda s: s.run.memory and s.run.memory.maximum, ".0f", "MiB", MEMORY),
    Column("mean", "memory_mean", lambda s: s.run.memory and s.run.memory.mean, ".0f", "MiB", MEMORY),
    Column(csv="folder", value=lambda s: s.run.run.folder.name),
)


def strong_table(by_method: Sequence[Sequence[Measured]], stem: str) -> Table:
    found = [Strong(run, alone(runs)) for runs in by_method for run in runs]
    table = Table(stem, "The same mesh on more processes", STRONG, found)
    if any(s.run.crowded for s in found):
        table.notes.append(
            "A dash in place of seconds: there were more processes than cores, so that they mean nothing; iterations, memory "
            "and counts do."
        )
    return table


class Weak(NamedTuple):
    """A run, and that on one process."""

    run: Measured
    one: Optional[Measured]

    @property
    def efficiency(self) -> Optional[float]:
        return None if self.run.crowded or self.one is None else weak_efficiency(self.one, self.run)


WEAK: Sequence[Column[Weak]] = (
    Column("method", "method", lambda w: w.run.method, text=lambda w: w.run.label, left=True),
    Column("processes", "processes", lambda w: w.run.processes),
    Column(csv="cores_suffice", value=lambda w: not w.run.crowded),
    Column("nodes", "nodes", lambda w: w.run.nodes),
    Column("nodes per process", value=lambda w: w.run.nodes / w.run.processes, format=".0f"),
    Column(
        "seconds per step",
        "seconds_per_step",
        lambda w: w.run.seconds,
        text=lambda w: fixed(w.run.meaningful_seconds, ".3g"),
    ),
    Column("efficiency", "efficiency", lambda w: w.efficiency, ".0%"),
    Column("Newton", "newton_per_step", lambda w: w.run.newton, ".2f", group="iterations per step"),
    Column("linear", "linear_per_step", lambda w: w.run.linear, ".1f", group="iterations per step"),
    Column(
        "largest memory per process in {unit}",
        "memory_max",
        lambda w: w.run.memory and w.run.memory.maximum,
        ".0f",
        "MiB",
    ),
    Column(csv="folder", value=lambda w: w.run.run.folder.name),
)


def weak_table(by_method: Sequence[Sequence[Measured]]) -> Table:
    return Table(
        "weak",
        "A mesh that grows with the processes",
        WEAK,
        [Weak(run, alone(runs)) for runs in by_method for run in runs],
        notes=[
            "Efficiency: seconds of a step per node of a process, of the run on one process over these; meshes are not "
            "exactly in the ratio of the processes."
        ],
    )


def weak_efficiency(one: Measured, run: Measured) -> float:
    return (one.seconds / one.nodes) / (run.seconds * run.processes / run.nodes)


def _spread(name: str, csv: str, group: str, value: Callable[[Measured], Spread]) -> List[Column[Measured]]:
    """For people mean and largest; in the CSV the least, too."""
    return [
        Column(name, value=value, format=lambda spread: f"{spread.mean:.4g} ({spread.maximum:.4g})", group=group),
        Column(csv=f"{csv}_min", value=lambda run: value(run).minimum),
        Column(csv=f"{csv}_mean", value=lambda run: value(run).mean),
        Column(csv=f"{csv}_max", value=lambda run: value(run).maximum),
    ]


COUNTS: Sequence[Column[Measured]] = (
    Column("method", "method", lambda run: run.method, text=lambda run: run.label, left=True),
    Column("mesh nodes", "nodes", lambda run: run.nodes),
    Column("processes", "processes", lambda run: run.processes),
    Column("linear iterations per step", "linear_per_step", lambda run: run.linear, ".1f"),
    *_spread("own", "owned_nodes", "nodes of a process", lambda run: run.owned),
    *_spread("halo", "halo_nodes", "nodes of a process", lambda run: run.halo),
    *_spread("neighbours", "neighbours", "", lambda run: run.neighbours),
    *_spread("messages", "messages", "sent per step and process", lambda run: run.messages),
    *_spread("MB", "megabytes", "sent per step and process", lambda run: run.megabytes),
    Column("reductions per step", "reductions", lambda run: run.reductions, ".0f"),
    Column(csv="solver_counted", value=lambda run: run.solver_counted),
)


def counts_table(by_method: Sequence[Sequence[Measured]]) -> Table:
    found = [run for runs in by_method for run in runs]
    table = Table("counts", "What each process holds and sends: mean, and the largest in brackets", COUNTS, found)
    if any(run.processes > 1 and not run.solver_counted for run in found):
        table.notes.append("Messages, bytes and reductions within the linear solver's library are not among them.")
    return table


class Modelled(NamedTuple):
    method: str
    one: Step  # on one process
    step: Step

    @property
    def speed_up(self) -> float:
        return self.one.seconds / self.step.seconds


def _part(name: str, csv: str, value: Callable[[Step], float]) -> Column[Modelled]:
    """A part of a step's time: seconds in the CSV, for people milliseconds."""
    return Column(
        name, csv, lambda m: value(m.step), lambda seconds: short(1e3 * seconds), "s", "milliseconds per step"
    )


MODEL: Sequence[Column[Modelled]] = (
    Column("method", "method", lambda m: m.method, left=True),
    Column("mesh nodes", "nodes", lambda m: m.step.nodes),
    Column("processes", "processes", lambda m: m.step.processes),
    Column("own nodes", "own_nodes", lambda m: m.step.own, ".0f"),
    Column("halo", "halo_nodes", lambda m: m.step.halo, ".0f"),
    Column(csv="linear_per_step", value=lambda m: m.step.iterations),
    _part("work", "work", lambda step: step.work),
    _part("latency", "latency", lambda step: step.latency),
    _part("transfer", "transfer", lambda step: step.transfer),
    _part("reductions", "reductions", lambda step: step.reductions),
    _part("output", "output", lambda step: step.output),
    _part("in all", "step", lambda step: step.seconds),
    Column("speed-up", "speed_up", lambda m: m.speed_up, short),
    Column("efficiency", value=lambda m: m.speed_up / m.step.processes, format=".0%"),
    Column(csv="messages", value=lambda m: m.step.messages),
    Column(csv="megabytes", value=lambda m: m.step.megabytes),
    Column(csv="reductions", value=lambda m: m.step.reduction_count),
    Column("solving", "memory", lambda m: m.step.memory, ".0f", "MiB", "{unit} per process"),
    Column("reading", "reading", lambda m: m.step.reading, ".0f", "MiB", "{unit} per process"),
)


def model_table(steps: Sequence[Tuple[str, Step, Step]]) -> Table:
    """(method, step on one process, step)."""
    return Table(
        "model",
        "The model: seconds of a time step on processes that are not here",
        MODEL,
        [Modelled(*one) for one in steps],
        notes=["Reading: before each process lets go of what is not its part of the mesh."],
    )
