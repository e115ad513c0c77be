"""Seconds of a time step on processes that are not there, from counted work, messages and reductions.

On P processes a step of a mesh of N nodes takes

    T = lambda (A (n + h) / n + S I(P) / I(1)) n + M t_latency + B / bandwidth + R ceil(log2 P) t_hop + W

with n = N / P own nodes and h copies of others' (halo) on each. A and S are the seconds per node of element loops and
of algebra, from a run on one process; element loops run over the halo's elements, too. I are the linear iterations of a
step, lambda is the largest part over the mean one, W the seconds of writing, which is not shared out. The halo grows as
the surface of a part, h = kappa f n^(2/3) (n^(1/2) in two dimensions): kappa as counted, f the faces that a part shares
with others, as many as there are others and at most those of a cube (a square). M and B are messages and bytes that a
process sends in a step: what was counted for a neighbour and for a copy, times how many there are. A part among many
touches more neighbours than it has faces, most of them at little more than a point."""

import math
from dataclasses import dataclass
from typing import List, Optional, Sequence, Tuple

from .measured import Measured


@dataclass(frozen=True)
class Machine:
    """The machine of the model. The defaults are round figures of an InfiniBand or Slingshot network."""

    latency: float = 2e-6  # s, of a message between two nodes
    bandwidth: float = 5e9  # bytes/s that a process may send
    hop: float = 3e-6  # s, of a reduction for each doubling of the processes
    neighbours: float = 0.0  # of a part among many; 0: 14 in space, 6 in the plane, as of packed bubbles
    solver_exchanges: float = 20.0  # of the linear solver in an iteration, where its library does not count them
    solver_halos: float = 4.0  # bytes of these, in halos of four numbers
    solver_reductions: float = 2.0  # in an iteration, likewise


@dataclass(frozen=True)
class Growth:
    """Linear iterations of a step: those on one process times 1 + rate log2 P."""

    rate: float
    most: int  # processes up to which it was observed

    def factor(self, processes: float) -> float:
        return 1.0 + self.rate * math.log2(processes)


def growth(runs: Sequence[Measured]) -> Growth:
    """Least squares through the run on one process; iterations that fall count as constant."""
    alone = next((run.linear for run in runs if run.processes == 1), None)
    more = [run for run in runs if run.processes > 1]
    most = max((run.processes for run in more), default=1)
    if not alone or not more:
        return Growth(0.0, most)
    steps = [math.log2(run.processes) for run in more]
    rises = [run.linear / alone - 1.0 for run in more]
    rate = sum(s * r for s, r in zip(steps, rises)) / sum(s * s for s in steps)
    return Growth(max(0.0, rate), most)


@dataclass(frozen=True)
class Counted:
    """What the model takes from the runs of one method."""

    nodes: int
    dimension: int
    assembly: float  # s per node and step
    algebra: float  # s per node and step, at the iterations of one process
    output: float  # s per step
    linear: float  # iterations per step on one process
    growth: Growth
    imbalance: float
    halo: float  # copies per face over (own nodes)^((d-1)/d)
    messages: float  # per neighbour and step
    bytes: float  # per copy and step
    reductions: float  # per step
    solver_counted: bool
    memory: Optional["Memory"]


@dataclass(frozen=True)
class Memory:
    """MiB of a process: base + local (n + h) when it solves, and while it reads reading_base + reading N, where there
    were meshes of several sizes to tell these."""

    base: float
    local: float
    reading_base: Optional[float]
    reading: Optional[float]

    def to_read(self, nodes: float) -> Optional[float]:
        if self.reading_base is None or self.reading is None:
            return None
        return self.reading_base + self.reading * nodes


def counted(runs: Sequence[Measured], dimension: int, others: Sequence[Measured] = ()) -> Optional[Counted]:
    """Counts from the run on one process and the one on most; None where one of them is missing. `others`: on other
    meshes, too, for the memory of the reading stage."""
    alone = next((run for run in runs if run.processes == 1), None)
    most = max((run for run in runs if run.processes > 1), key=lambda run: run.processes, default=None)
    if alone is None or most is None:
        return None
    surface = (dimension - 1) / dimension
    neighbours = max(most.neighbours.mean, 1e-9)
    halo, own = most.halo.mean / most.copies, most.nodes / most.processes
    return Counted(
        nodes=alone.nodes,
        dimension=dimension,
        assembly=alone.assembly / alone.nodes,
        algebra=alone.algebra / alone.nodes,
        output=alone.output,
        linear=alone.linear,
        growth=growth(runs),
        imbalance=most.owned.imbalance,
        halo=halo / min(neighbours, 2.0 * dimension) / own**surface,
        messages=most.messages.mean / neighbours,
        bytes=1e6 * most.megabytes.mean / max(halo, 1e-9),
        reductions=most.reductions,
        solver_counted=most.solver_counted,
        memory=_memory(runs, [*runs, *others]),
    )


def _memory(runs: Sequence[Measured], all_runs: Sequence[Measured]) -> Optional["Memory"]:
    """Least squares of peak memory over local nodes, of runs of one mesh, and of the reading stage over whole
    meshes."""
    solving = _line(
        [
            (run.nodes / run.processes + run.halo.mean / run.copies, run.memory.mean)
            for run in runs
            if run.memory is not None
        ]
    )
    reading = _line([(float(run.nodes), run.reading.maximum) for run in all_runs if run.reading is not None])
    return None if solving is None else Memory(*solving, *(reading or (None, None)))


def _line(points: Sequence[Tuple[float, float]]) -> Optional[Tuple[float, float]]:
    """(value at zero, slope) by least squares, neither negative; None for points of one place."""
    if len({x for x, _ in points}) < 2:
        return None
    mean_x, mean_y = (sum(values) / len(points) for values in zip(*points))
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points)
    slope = max(0.0, slope)
    return max(0.0, mean_y - slope * mean_x), slope


@dataclass(frozen=True)
class Step:
    """A time step as the model has it; seconds."""

    processes: int
    nodes: int
    own: float  # nodes of a process
    halo: float
    iterations: float  # linear, of a step
    work: float
    latency: float
    transfer: float
    reductions: float
    output: float
    messages: float  # sent by a process
    megabytes: float
    reduction_count: float
    memory: Optional[float]  # MiB of a process
    reading: Optional[float]

    @property
    def seconds(self) -> float:
        return self.work + self.latency + self.transfer + self.reductions + self.output


def most_neighbours(machine: Machine, dimension: int) -> float:
    return machine.neighbours or {2: 6.0, 3: 14.0}[dimension]


def step(counted: Counted, machine: Machine, nodes: int, processes: int) -> Step:
    own = nodes / processes
    factor = counted.growth.factor(processes)
    linear = counted.linear * factor
    neighbours = min(processes - 1.0, most_neighbours(machine, counted.dimension))
    surface = (counted.dimension - 1) / counted.dimension
    halo = min(min(neighbours, 2.0 * counted.dimension) * counted.halo * own**surface, nodes - own)
    imbalance = counted.imbalance if processes > 1 else 1.0
    work = imbalance * (counted.assembly * (own + halo) + counted.algebra * factor * own)
    messages, sent, reductions = neighbours * counted.messages, counted.bytes * halo, counted.reductions
    if processes == 1:
        messages = sent = reductions = 0.0
    elif not counted.solver_counted:
        messages += machine.solver_exchanges * linear * neighbours
        sent += machine.solver_halos * linear * halo * 4 * 8
        reductions += machine.solver_reductions * linear
    memory = counted.memory
    return Step(
        processes=processes,
        nodes=nodes,
        own=own,
        halo=halo,
        iterations=linear,
        work=work,
        latency=messages * machine.latency,
        transfer=sent / machine.bandwidth,
        reductions=reductions * machine.hop * math.ceil(math.log2(processes)),
        output=counted.output,
        messages=messages,
        megabytes=sent / 1e6,
        reduction_count=reductions,
        memory=None if memory is None else memory.base + memory.local * (own + halo),
        reading=None if memory is None else memory.to_read(nodes),
    )


def assumptions(counted: Counted, machine: Machine, cores: int) -> List[str]:
    """The model's assumptions in words."""
    seen = counted.growth.most
    power = "2/3" if counted.dimension == 3 else "1/2"
    lines = [
        f"A core is as fast as this machine's, whose {cores} {'cores were' if cores > 1 else 'core was'} used by one process "
        "each; cores that share a node's memory slow each other down, which is not in the model.",
        f"A message costs {1e6 * machine.latency:g} us and a process sends {machine.bandwidth / 1e9:g} GB/s; nothing is hidden "
        "behind work.",
        f"A reduction takes {1e6 * machine.hop:g} us for each doubling of the processes. The processes wait for the largest "
        f"part, {counted.imbalance:.2f} times the mean one as partitioned here, and for nothing else: no noise of the system.",
        f"The halo of a part grows as (own nodes)^({power}) and as the number of its faces, at most {2 * counted.dimension}. "
        f"Messages grow with its neighbours, at most {most_neighbours(machine, counted.dimension):g}, bytes with the halo, as "
        "counted here.",
        f"Linear iterations grow by {100 * counted.growth.rate:.1f} % with each doubling of the processes, as seen up to "
        f"{seen}; Newton and coupling iterations do not.",
        f"Writing takes {1e3 * counted.output:.2g} ms a step on any number of processes.",
    ]
    if not counted.solver_counted:
        lines.append(
            f"The linear solver's own messages are not counted by the runs. In an iteration it is taken to exchange "
            f"{machine.solver_exchanges:g} times with each neighbour, bytes of {machine.solver_halos:g} halos of four numbers "
            f"in all, and to reduce {machine.solver_reductions:g} times."
        )
    return lines
