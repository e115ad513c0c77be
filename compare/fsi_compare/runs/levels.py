"""Values along a line over time, as tables hold them: a block of lines for each time level, the same points in each."""

from pathlib import Path
from typing import Callable

import numpy as np

from ..base.errors import InputError
from .columns import INTERRUPTED, numbers, read_fields


def between_levels(times: np.ndarray, time: float, tolerance: float, values: Callable[[int], np.ndarray]) -> np.ndarray:
    """Values at a time between the first and the last, linear between neighbouring levels; those of a level that is
    nearer than the tolerance as they are. `values`: of a level."""
    nearest = int(np.argmin(np.abs(times - time)))
    if abs(times[nearest] - time) <= tolerance:
        return values(nearest)
    after = int(np.searchsorted(times, time))
    weight = (time - times[after - 1]) / (times[after] - times[after - 1])
    return (1 - weight) * values(after - 1) + weight * values(after)


def thinned(count: int, most: int) -> np.ndarray:
    """Indices of at most `most` of `count` entries, evenly spread, the first and the last among them."""
    return np.arange(count) if count <= most else np.unique(np.linspace(0, count - 1, most).round().astype(int))


def integral(x: np.ndarray, y: np.ndarray) -> float:
    """Over x, by the trapezoidal rule; of (rows, x) the sum over the rows."""
    return float(np.sum(0.5 * (y[..., 1:] + y[..., :-1]) * np.diff(x)))


def read_levels(path: Path, column: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times (levels,), places z (points,) and values (levels, points) of a CSV with `time_ms`, `z_mm` and the column.
    Raises InputError."""
    wanted = ("time_ms", "z_mm", column)
    fields = read_fields(path)
    for name in wanted:
        if name not in fields:
            remedy = f"the first line must read {','.join(wanted)}"
            raise InputError(path, "line 1", f"column '{name}' is missing", remedy)
    if not fields[column]:
        raise InputError(path, "", "holds no time level", "the run wrote no time step; run it again")
    time, z, values = (numbers(path, name, fields[name], gaps=False, nan=False) for name in wanted)
    starts = np.array([0, *(np.flatnonzero(np.diff(time)) + 1), len(time)])
    points = int(starts[1])
    if points < 2:
        raise InputError(path, "line 2", "the first time level has a single point", "two or more are needed")
    falling = np.diff(z[:points]) <= 0
    if falling.any():
        line = int(np.argmax(falling)) + 3
        raise InputError(path, f"line {line}", "z_mm does not increase", "points must be ordered along the line")
    for start, stop in zip(starts[1:-1], starts[2:]):
        if time[start] < time[start - 1]:
            problem = f"time_ms goes back from {time[start - 1]:g} to {time[start]:g}"
            raise InputError(path, f"line {start + 2}", problem, "time levels must be ordered; run it again")
        if stop - start != points:
            problem = f"has {stop - start} of {points} points"
            raise InputError(path, f"time_ms {time[start]:g}", problem, INTERRUPTED)
        other = z[start:stop] != z[:points]
        if other.any():
            line = int(start + np.argmax(other)) + 2
            remedy = "all time levels must hold the same points; run it again"
            raise InputError(path, f"line {line}", "z_mm differs from the first time level's", remedy)
    return time[starts[:-1]], z[:points], values.reshape(-1, points)
