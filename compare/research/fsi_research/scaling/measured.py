"""What a run on some processes took and counted, per time step."""

from dataclasses import dataclass
from typing import Any, Mapping, Optional

from fsi_compare.base.errors import InputError
from fsi_compare.runs.summary import FILE
from ..evidence.phase_bars import phase_seconds
from fsi_compare.study.study_run import StudyRun

ASSEMBLY = ("assembly",)  # parts of a run's time, as phase_seconds names them
ALGEBRA = ("set-up", "solve", "coupling", "other")


@dataclass(frozen=True)
class Spread:
    """Spread of a number over the processes."""

    minimum: float
    mean: float
    maximum: float

    @property
    def imbalance(self) -> float:
        """Largest over mean."""
        return self.maximum / self.mean if self.mean > 0 else 1.0


@dataclass(frozen=True)
class Measured:
    run: StudyRun
    label: str  # method, and mesh where there are several
    processes: int
    crowded: bool  # more processes than cores: its seconds mean nothing
    nodes: int
    unknowns: int
    seconds: float  # of a time step
    newton: float  # iterations
    linear: float
    assembly: float  # s, element loops
    algebra: float  # s, all else that is shared out: solvers, nodewise operations
    output: float  # s, files, which the first process writes
    memory: Optional[Spread]  # MiB, peak
    reading: Optional[Spread]  # MiB, peak of the stage in which each process holds the whole mesh
    owned: Spread  # nodes
    halo: Spread  # copies of other processes' nodes
    neighbours: Spread
    messages: Spread  # sent by a process, those of the linear solver's library included where it counts them
    megabytes: Spread
    reductions: float
    solver_counted: bool  # whether messages, bytes and reductions hold the linear solver's

    @property
    def method(self) -> str:
        return self.run.request.method.name

    @property
    def meaningful_seconds(self) -> Optional[float]:
        return None if self.crowded else self.seconds

    @property
    def copies(self) -> float:
        """Nodes that processes count in all, over the mesh's: those on the interface are the fluid's and the wall's."""
        return self.owned.mean * self.processes / self.nodes


def measure(run: StudyRun, label: str, processes: int, threads: int, cores: int) -> Measured:
    """Measures a finished run. Raises InputError where its summary is incomplete, or says that it was made by another
    number of processes than the study asked for."""
    summary = run.summary
    path = run.folder / FILE
    try:
        nodes, totals = int(summary["mesh"]["nodes"]), summary["totals"]
        steps = float(totals["steps"])
        seconds, newton = float(totals["wall_s"]) / steps, float(totals["newton_iterations"]) / steps
        linear = float(totals["linear_iterations"]) / steps
        unknowns = int(summary["unknowns"]["coupled"])
    except (KeyError, ZeroDivisionError) as missing:
        raise InputError(path, "", f"lacks {missing}", "make the run again with --fresh") from None
    there = int(summary.get("processes", 1))
    if there != processes:
        raise InputError(path, "processes", f"is {there}, not {processes}", "build the programs with MPI: -DFSI_MPI=ON")
    parts = phase_seconds(run)
    own: Mapping[str, Any] = summary.get("per_process", {})

    def spread(name: str, alone: float) -> Spread:
        value = own.get(name, alone)
        if isinstance(value, Mapping):
            return Spread(*(float(value[key]) for key in ("minimum", "mean", "maximum")))
        return Spread(float(value), float(value), float(value))

    peak = summary.get("peak_memory_MiB")
    traffic = spread("bytes_per_step", 0.0)
    return Measured(
        run=run,
        label=label,
        processes=processes,
        crowded=processes * threads > cores,
        nodes=nodes,
        unknowns=unknowns,
        seconds=seconds,
        newton=newton,
        linear=linear,
        assembly=sum(parts[name] for name in ASSEMBLY) / steps,
        algebra=sum(parts[name] for name in ALGEBRA) / steps,
        output=parts["output"] / steps,
        memory=None if peak is None else spread("peak_memory_MiB", float(peak)),
        reading=spread("reading_memory_MiB", 0.0) if "reading_memory_MiB" in own else None,
        owned=spread("owned_nodes", float(nodes)),
        halo=spread("halo_nodes", 0.0),
        neighbours=spread("neighbours", 0.0),
        messages=spread("messages_per_step", 0.0),
        megabytes=Spread(traffic.minimum / 1e6, traffic.mean / 1e6, traffic.maximum / 1e6),
        reductions=spread("reductions_per_step", 0.0).maximum,
        solver_counted=str(summary.get("linear_solver", "")).startswith("fast"),
    )
