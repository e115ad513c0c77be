"""`fsi-compare cost`: what finished runs of either driver took, side by side."""

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

from ..base.errors import printable
from ..base.files import exists
from ..base.options import Commands, add_command, add_folders, add_labels, add_output, add_title, add_usual
from ..runs.columns import read_columns, read_iterations
from ..runs.coupling import chosen_scheme, coupling_kind, coupling_words
from ..runs.labels import folder_labels, read_labels
from ..runs.run_folder import read_finished
from ..runs.summary import PROGRAMS
from ..runs.work_units import notes_on_work, per_step
from .column import Column, work_column
from .layout import Table, hand_out

DESCRIPTION = """\
Tabulates what finished runs took: work units, wall time, coupling iterations, solves of the whole system and of the
sub-problems, Newton and linear iterations, factorisations, memory. The first run is the reference of what is
"relative". Writes to OUTDIR:
  cost.csv   all numbers, in full precision, with units in the column names
  cost.md    the table for documents
A work unit is the time of one product with the coupled matrix, measured in each run: work units can be read together
across machines. Seconds compare only between runs on the same, otherwise idle machine with the same number of threads;
a note says where runs are of several machines or builds. A run that was restarted counts its last part only, which a
note says."""

EXAMPLES = """\
examples:
  fsi-compare cost results/monolithic results/iqn-ils results/robin-neumann -o results/cost
  fsi-compare cost results/runs/* --labels fast,aitken,iqn-ils,robin-neumann
"""

COUPLING = "coupling.csv"
COUPLED, FLUID, WALL, MESH = "coupled", "fluid", "wall", "mesh motion"
PREPARATIONS = ("factorisation", "set-up")


@dataclass(frozen=True)
class Cost:
    """One run. None: it has no such part."""

    label: str
    program: str  # "monolithic" or "partitioned"
    mesh: str
    unknowns: int | None
    threads: int | None  # of each process
    processes: int
    steps: int
    seconds: float  # of all time steps
    coupling_mean: float | None  # coupling iterations per step; None: monolithic
    coupling_range: tuple | None
    newton: int
    linear: int
    solves: dict[str, int]  # linear solves, by system
    preparations: dict[str, int]  # factorisations or set-ups of a preconditioner, by system
    displacement_residual: float | None  # largest of the steps
    force_residual: float | None
    memory_mib: float | None
    restarted_from: int | None
    work_units: float | None  # per step; None: not measured
    summary: dict  # all of summary.json

    @property
    def seconds_per_step(self) -> float:
        return self.seconds / self.steps


def add_parser(commands: Commands, version: str) -> None:
    help = "wall time, solves and iterations of finished runs"
    command = add_command(commands, "cost", cost, help, DESCRIPTION, EXAMPLES)
    add_folders(command)
    add_output(command, "results/cost")
    add_labels(command)
    add_title(command, "Cost of the runs")
    add_usual(command, version, "accepted as by all programs; this comparison is quick on one thread")


def cost(options: argparse.Namespace) -> int:
    """Reads all runs before the first file is written."""
    labels = read_labels(options.labels, len(options.folders)) or folder_labels(options.folders)
    costs = [read_cost(folder, label) for folder, label in zip(options.folders, labels)]
    return hand_out(cost_table(costs, printable(options.title)), options.output, options.quiet)


def read_cost(folder: Path, label: str) -> Cost:
    """Reads a run. Raises InputError unless it is finished and its tables are complete."""
    summary = read_finished(folder)
    program = PROGRAMS[summary["program"]]
    iterations = read_iterations(folder, ("outer_iterations", "newton_iterations", "linear_iterations", "wall_s"))
    coupled = program == "partitioned" and exists(folder / COUPLING)
    coupling = read_columns(folder / COUPLING, ("displacement_residual", "force_residual")) if coupled else None
    outer = iterations["outer_iterations"].tolist()
    phases = summary.get("phases", {})
    mesh = summary.get("mesh", {})
    return Cost(
        label=label,
        program=program,
        mesh=f"{mesh['nodes']} nodes" if "nodes" in mesh else printable(mesh.get("name", "")),
        unknowns=summary.get("unknowns", {}).get("coupled"),
        threads=summary.get("threads"),
        processes=summary.get("processes", 1),
        steps=len(outer),
        seconds=float(iterations["wall_s"].sum()),
        coupling_mean=sum(outer) / len(outer) if coupled else None,
        coupling_range=(int(min(outer)), int(max(outer))) if coupled else None,
        newton=int(iterations["newton_iterations"].sum()),
        linear=int(iterations["linear_iterations"].sum()),
        solves=calls(phases, ("solve",)),
        preparations=calls(phases, PREPARATIONS),
        displacement_residual=float(coupling["displacement_residual"].max()) if coupling else None,
        force_residual=float(coupling["force_residual"].max()) if coupling else None,
        memory_mib=summary.get("peak_memory_MiB"),
        restarted_from=summary.get("restarted_from_step"),
        work_units=per_step(summary),
        summary=summary,
    )


def calls(phases: dict, kinds: Sequence[str]) -> dict[str, int]:
    """How often phases "KIND: SYSTEM" were entered, by system."""
    found: dict[str, int] = {}
    for name, phase in phases.items():
        kind, colon, system = name.partition(": ")
        if colon and kind in kinds:
            found[system] = found.get(system, 0) + int(phase.get("calls", 0))
    return found


def _solves(head: str, system: str) -> Column[Cost]:
    def per_step(cost: Cost) -> float | None:
        count = cost.solves.get(system)
        return None if count is None else count / cost.steps

    return Column(head, value=per_step, format=".1f", group="linear solves per step")


def _calls(counts: str, csv: str, system: str) -> Column[Cost]:
    return Column(csv=csv, value=lambda c: getattr(c, counts).get(system))


SYSTEMS = {"whole": COUPLED, "fluid": FLUID, "wall": WALL, "mesh": MESH}  # by their names in tables


def cost_columns(first: Cost) -> list[Column[Cost]]:
    """`first`: the run that the others' seconds and work units are relative to."""

    def relative(cost: Cost) -> float | None:
        return cost.seconds_per_step / first.seconds_per_step if first.seconds_per_step > 0 else None

    def relative_work(cost: Cost) -> float | None:
        return cost.work_units / first.work_units if cost.work_units and first.work_units else None

    def driver(cost: Cost) -> str:
        return coupling_words(f"fsi-{cost.program}", cost.summary)

    gap, passes, work = "interface residual", "coupling iterations", "work units"
    return [
        Column("run", "run", lambda c: c.label, left=True),
        Column("driver", "program", lambda c: c.program, left=True, text=driver),
        Column(csv="coupling_kind", value=lambda c: coupling_kind(c.summary), behind=True),
        Column(csv="coupling_scheme", value=lambda c: chosen_scheme(c.summary), behind=True),
        Column("mesh", "mesh", lambda c: c.mesh, left=True),
        Column(csv="unknowns", value=lambda c: c.unknowns),
        Column(csv="threads", value=lambda c: c.threads),
        Column("processes", "processes", lambda c: c.processes, behind=True),
        Column("steps", "steps", lambda c: c.steps),
        work_column("per step", "work_units_per_step", lambda c: c.work_units, group=work),
        Column("relative", "work_units_relative_to_first", relative_work, ".2f", group=work, missing="", behind=True),
        Column(csv="wall", unit="s", value=lambda c: c.seconds),
        Column("seconds per step", "wall_s_per_step", lambda c: c.seconds_per_step, ".3g"),
        Column("relative time", "wall_relative_to_first", relative, ".2f"),
        Column("mean", "coupling_iterations_mean", lambda c: c.coupling_mean, ".2f", group=passes),
        Column("range", value=lambda c: c.coupling_range, format=lambda r: f"{r[0]}-{r[1]}", group=passes),
        Column(csv="coupling_iterations_min", value=lambda c: c.coupling_range and c.coupling_range[0]),
        Column(csv="coupling_iterations_max", value=lambda c: c.coupling_range and c.coupling_range[1]),
        *(_solves(head, system) for head, system in SYSTEMS.items()),
        Column("per step", value=lambda c: c.linear / c.steps, format=".1f", group="linear iterations"),
        Column(csv="newton_iterations", value=lambda c: c.newton),
        Column(csv="linear_iterations", value=lambda c: c.linear),
        *(_calls("solves", f"solves_{name}", system) for name, system in SYSTEMS.items()),
        *(_calls("preparations", f"preparations_{name}", system) for name, system in SYSTEMS.items()),
        Column("set-ups", value=lambda c: sum(c.preparations.get(system, 0) for system in SYSTEMS.values())),
        Column("displacement", "displacement_residual_max", lambda c: c.displacement_residual, ".1e", group=gap),
        Column("force", "force_residual_max", lambda c: c.force_residual, ".1e", group=gap),
        Column("memory in {unit}", "peak_memory", lambda c: c.memory_mib, ".0f", "MiB"),
    ]


def cost_table(costs: Sequence[Cost], title: str) -> Table:
    return Table("cost", title, cost_columns(costs[0]), costs, notes=cost_notes(costs))


def cost_notes(costs: Sequence[Cost]) -> list[str]:
    notes = notes_on_work([c.summary for c in costs])
    passes = {coupling_kind(c.summary): c.summary.get("coupling_pass") for c in costs}
    notes += [f"`{kind}`: {printable(does)}." for kind, does in passes.items() if kind and does]
    notes += [
        "Relative time: seconds per step over the first run's. Solves: of the whole system (monolithic) or of the "
        "sub-problems (partitioned). Set-ups: factorisations, or set-ups of a preconditioner, in all steps.",
        "Interface residual: relative, largest of the steps; zero by construction in a monolithic run, "
        "up to Newton's tolerance.",
    ]
    threads = sorted({c.threads for c in costs if c.threads is not None})
    if len(threads) > 1:
        numbers = ", ".join(map(str, threads))
        notes.append(f"The runs had different numbers of threads ({numbers}): seconds do not compare.")
    processes = sorted({c.processes for c in costs})
    if len(processes) > 1:
        notes.append(f"The runs had different numbers of processes ({', '.join(map(str, processes))}).")
    if processes[-1] > 1:
        notes.append("Memory: of the process that needed most.")
    if len({(c.mesh, c.steps) for c in costs}) > 1:
        notes.append("The runs differ in mesh or number of steps.")
    parts = ", ".join(c.label for c in costs if c.restarted_from is not None)
    if parts:
        of = "work units, solves, factorisations and memory"
        notes.append(f"Restarted, so that {of} are those of the last part: {parts}.")
    return notes
