"""What a curve over time tells of its run: whether it alternates from step to step, and whether it repeats."""

from typing import Mapping

import numpy as np

SAME = 1e-6  # of the range: a curve that was prescribed repeats to round-off


def sawtooth(values: np.ndarray) -> float:
    """Largest part of a curve that changes its sign from step to step: (v[n-1] - 2 v[n] + v[n+1])/4 where it alternates
    with the next of its kind, the smaller of the two."""
    part = (values[:-2] - 2 * values[1:-1] + values[2:]) / 4
    pairs = np.minimum(np.abs(part[:-1]), np.abs(part[1:]))[part[:-1] * part[1:] < 0]
    return float(pairs.max()) if len(pairs) else 0.0


def period_of(times: np.ndarray, flows: Mapping[str, np.ndarray]) -> float | None:
    """The shortest time in ms after which a flow repeats, twice at least; None where none does, or for unequal
    steps."""
    steps = np.diff(times)
    if len(times) < 8 or np.ptp(steps) > 1e-6 * steps.mean():
        return None
    found = [lag for lag in map(_repeats, flows.values()) if lag]
    return float(min(found) * steps.mean()) if found else None


def _repeats(values: np.ndarray) -> int:
    """Steps after which a curve repeats; 0 where it does not, or is constant."""
    span = float(np.ptp(values))
    if not span > 0 or float(np.ptp(values[len(values) // 2 :])) < 0.1 * span:
        return 0
    near = SAME * span
    for lag in range(2, len(values) // 2 + 1):
        if abs(values[-1] - values[-1 - lag]) <= near and np.all(np.abs(values[lag:] - values[:-lag]) <= near):
            return lag
    return 0


def cycle_change(times: np.ndarray, values: np.ndarray, period: float) -> float:
    """Largest difference of the last two cycles, relative to the range of the last."""
    lag = round(period / float(np.diff(times).mean()))
    last, before = values[-lag:], values[-2 * lag : -lag]
    span = float(np.ptp(last))
    return float(np.abs(last - before).max()) / span if span > 0 else 0.0
