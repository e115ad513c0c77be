"""How the error falls with seconds along the frontier, and what that says of an error that no run has reached."""

import math
from dataclasses import dataclass
from typing import Optional, Sequence

from .frontier import Point, frontier
from .observed_order import slope

SPAN = 3.0  # errors up to this multiple of the smallest make the trend: those of coarser settings fall otherwise
LEAST_POINTS = 3
FLATTEST = 0.05  # exponent below which there is no trend
FURTHEST = 4.0  # times below the smallest error: beyond it a trend over a factor of three says nothing


@dataclass(frozen=True)
class Trend:
    """error = smallest (seconds / its seconds)^-exponent."""

    largest: Point  # seconds and error of the ends
    smallest: Point
    exponent: float

    def seconds(self, target: float) -> Optional[float]:
        """For an error below the smallest; None: too far from it."""
        seconds, error = self.smallest
        return seconds * (error / target) ** (1 / self.exponent) if error <= FURTHEST * target else None


def trend(points: Sequence[Point], gain: float = 0.0) -> Optional[Trend]:
    """Trend of (seconds, error), by least squares in logarithms over the frontier's last points; None: there is
    none."""
    best = [points[i] for i in frontier(points, gain)]
    if not best or not best[-1][1] > 0:
        return None
    used = [point for point in best if point[1] <= SPAN * best[-1][1]]
    found = slope([s for s, _ in used], [e for _, e in used]) if len(used) >= LEAST_POINTS else None
    if found is None or not math.isfinite(found) or -found < FLATTEST:
        return None
    return Trend(used[0], used[-1], -found)
