"""Where a quantity turns a method from failing to holding, by runs."""

import math
from dataclasses import dataclass
from typing import Callable, Optional


@dataclass(frozen=True)
class Bracket:
    """The turn lies between `fails` and `holds`. One of them is None when the whole range is of one kind."""

    fails: Optional[float]
    holds: Optional[float]
    runs: int

    @property
    def value(self) -> Optional[float]:
        """Geometric mean; None without a turn."""
        return math.sqrt(self.fails * self.holds) if self.fails and self.holds else None

    @property
    def width(self) -> Optional[float]:
        """Ratio of the ends, minus 1."""
        if not (self.fails and self.holds):
            return None
        return max(self.fails, self.holds) / min(self.fails, self.holds) - 1


def bisect(holds: Callable[[float], bool], low: float, high: float, width: float) -> Bracket:
    """Halves [low, high] on a logarithmic scale until the ratio of its ends is below 1 + `width`. Tries which end
    holds."""
    low_holds, high_holds = holds(low), holds(high)
    runs = 2
    if low_holds == high_holds:
        return Bracket(None, low, runs) if low_holds else Bracket(high, None, runs)
    good, bad = (low, high) if low_holds else (high, low)
    while max(good, bad) / min(good, bad) > 1 + width:
        middle = math.sqrt(good * bad)
        runs += 1
        if holds(middle):
            good = middle
        else:
            bad = middle
    return Bracket(bad, good, runs)
