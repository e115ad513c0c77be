"""Orders of convergence from results at several sizes (of elements, of time steps)."""

import math
from dataclasses import dataclass
from typing import Optional, Sequence

ORDERS = (0.05, 6.0)  # outside of these a triple says nothing of convergence


@dataclass(frozen=True)
class SelfConvergence:
    """Order from the distances between solutions of three successive sizes."""

    order: Optional[float]  # None: the distances do not fall, or faster than any order
    remaining: Optional[float]  # estimated error of the finest of the three, in the unit of the distances


def slope(sizes: Sequence[float], errors: Sequence[float]) -> Optional[float]:
    """Slope of the least-squares line through (log size, log error); None for fewer than two sizes."""
    points = [(math.log(h), math.log(e)) for h, e in zip(sizes, errors) if h > 0 and e > 0]
    if len({x for x, _ in points}) < 2:
        return None
    mx, my = (sum(values) / len(points) for values in zip(*points))
    return sum((x - mx) * (y - my) for x, y in points) / sum((x - mx) ** 2 for x, _ in points)


def self_convergence(sizes: Sequence[float], distances: Sequence[float]) -> SelfConvergence:
    """`sizes` h1 > h2 > h3, `distances` |u1 - u2|, |u2 - u3|. With an error C h^p the distances are C (h1^p - h2^p) and
    C (h2^p - h3^p), which gives p for any ratio of the sizes (the grid convergence index's way,
    [Celik2008]), and what is left, C h3^p. It holds in norms as long as the error keeps its shape."""
    h1, h2, h3 = sizes
    first, second = distances
    if not (h1 > h2 > h3 > 0 and first > 0 and second > 0):
        return SelfConvergence(None, None)

    def ratio(p: float) -> float:
        return (h1**p - h2**p) / (h2**p - h3**p)  # grows with p

    low, high = ORDERS
    wanted = first / second
    if not ratio(low) <= wanted <= ratio(high):
        return SelfConvergence(None, None)
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ratio(middle) < wanted else (low, middle)
    order = 0.5 * (low + high)
    return SelfConvergence(order, second * h3**order / (h2**order - h3**order))
