"""What an error would take that no run has reached: element size, time step and seconds, by the observed orders."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Part:
    """An error C size^order, known as `error` at one size."""

    error: float
    order: float


@dataclass(frozen=True)
class Growth:
    """Seconds grow with nodes^nodes and steps^steps."""

    nodes: float
    steps: float


@dataclass(frozen=True)
class Reach:
    size_factor: float  # element size, relative to where the parts are known
    step_factor: float  # time step likewise
    nodes_factor: float
    seconds_factor: float


def reach(target: float, space: Part, time: Part, growth: Growth) -> Reach:
    """The cheapest element size and time step whose two errors add up to the target. Seconds grow with size^-a, a = 3
    times growth.nodes, and step^-b, b = growth.steps; at their least under C h^p + D k^q = target the two errors stand
    as a/p to b/q (Lagrange). Nothing is made coarser than where the parts are known: a part that is small enough
    already keeps its size, and the other takes what is left."""
    shares = (3 * growth.nodes / space.order, growth.steps / time.order)
    in_space = target * shares[0] / sum(shares)
    in_time = target - in_space
    if space.error <= in_space:
        in_space, in_time = space.error, target - space.error
    elif time.error <= in_time:
        in_time, in_space = time.error, target - time.error
    size = min(1.0, (in_space / space.error) ** (1 / space.order))
    step = min(1.0, (in_time / time.error) ** (1 / time.order))
    nodes = size ** -3
    return Reach(size, step, nodes, nodes ** growth.nodes * step ** -growth.steps)
