"""Colours of values: maps of even perceived steps, and the range that they span."""

import math
from dataclasses import dataclass
from typing import Iterable

import numpy as np

SEQUENTIAL = "viridis"  # lightness grows evenly: readable in grey and by the colour-blind
DIVERGING = "RdBu_r"  # about zero; both halves darken evenly [ColorBrewer: safe for the colour-blind]
PERCENTILE = 99.0
BOTH_SIGNS = 0.02  # of the larger side, that the smaller one must have at least
COLOURS = 256
TICK_STEPS = 4  # that a range is divided into, at the most


@dataclass(frozen=True)
class Scale:
    """Range of values that the colours span; values outside have the last colour."""

    low: float
    high: float
    diverging: bool
    least: float  # that occurs
    largest: float

    @property
    def map(self) -> str:
        return DIVERGING if self.diverging else SEQUENTIAL

    def places(self, values: np.ndarray) -> np.ndarray:
        """0 to 1 within the range."""
        return np.clip((values - self.low) / (self.high - self.low), 0.0, 1.0)


def table(name: str) -> np.ndarray:
    """Red, green and blue of 0 to 255, (256, 3)."""
    import matplotlib

    colours: np.ndarray = matplotlib.colormaps[name](np.arange(COLOURS) / (COLOURS - 1))
    return np.round(255 * colours[:, :3]).astype(np.uint8)


def scale_of(levels: Iterable[np.ndarray], signed: bool) -> Scale:
    """Scale of values at some times and places. A single node cannot stretch it: of each array the 99th percentile
    counts, and of these the largest (below: the 1st, the least). Unsigned values begin at zero. Signed ones are centred
    about zero when both signs matter."""
    found = []
    for values in levels:
        finite = values[np.isfinite(values)]
        if len(finite):
            found.append([*np.percentile(finite, (100 - PERCENTILE, PERCENTILE)), finite.min(), finite.max()])
    if not found:
        return Scale(0.0, 1.0, False, float("nan"), float("nan"))
    lows, highs, leasts, most = np.array(found, dtype=float).T.tolist()
    low, high, least, largest = min(lows), max(highs), min(leasts), max(most)
    if not signed:
        return Scale(0.0, _above(0.0, high if high > 0 else largest), False, least, largest)
    smaller, larger = sorted((abs(low), abs(high)))
    if low < 0 < high and smaller >= BOTH_SIGNS * larger:
        return Scale(-larger, larger, True, least, largest)
    return Scale(low, _above(low, high), False, least, largest)


def scale_of_difference(levels: Iterable[np.ndarray]) -> Scale:
    """A scale centred about zero, whatever the signs."""
    found = scale_of((np.abs(values) for values in levels), signed=False)
    return Scale(-found.high, found.high, True, -found.largest, found.largest)


def round_ticks(low: float, high: float) -> list[float]:
    """Numbers for the legend of a range: multiples of 1, 2 or 5 times a power of ten, three to six of them, with zero
    where the range holds it. The page has the same (`vesselCurve.ticks`)."""
    raw = (high - low) / TICK_STEPS
    if not (math.isfinite(raw) and raw > 0):
        return [low]
    power = 10.0 ** math.floor(math.log10(raw) + 1e-9)
    step = next(part * power for part in (1.0, 2.0, 5.0, 10.0) if part * power >= 0.999 * raw)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [i * step for i in range(first, last + 1)]


def _above(low: float, high: float) -> float:
    return high if high > low else low + (abs(low) or 1.0)
