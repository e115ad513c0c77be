"""How far curves and lines of two members are apart: as a whole, at one time, in the mean square and where it is
largest.

    ||y||^2 = (1/T) (1/L) integral of y^2 over time and line,    |y| = the largest value at any level and point

Both have the unit of y. Curves are compared at the levels and points of one of them, the user's own.
"""

from dataclasses import dataclass

import numpy as np

LEAST_LEVELS = 1 / 8  # of the own levels that another member must have; else its curve is interpolated
SAME_LEVEL = 1e-6  # of a step
AT_REST = 0.01  # of the largest value: an error of a line that is below this at a time is relative to that


@dataclass(frozen=True)
class Curve:
    """A column of a sample over time; of lines at several points."""

    name: str  # "tip: displacement y"
    unit: str
    times: np.ndarray  # ms, (levels,)
    values: np.ndarray  # (levels, points)
    s: np.ndarray  # mm along the line, (points,)
    derived: bool = False  # of a field that is made of gradients of what is solved for

    @property
    def largest(self) -> float:
        return float(np.nanmax(np.abs(self.values))) if self.values.size else 0.0

    @property
    def is_pressure(self) -> bool:
        """Whether it is a pressure or of its order: stresses, forces, gradients of what is solved for."""
        return self.derived or any(word in self.name.rpartition(": ")[2] for word in ("pressure", "stress", "force"))


@dataclass(frozen=True)
class Stretch:
    """Which part of a curve is compared, and how."""

    largest: bool  # the largest difference, at any level and point; else the mean square
    time: float | None = None  # ms, along the line then; None: at all levels


@dataclass(frozen=True)
class CurveNorm:
    """Norms of differences of curves, (levels * points,); NaN: one of them has no level there."""

    weights: np.ndarray
    largest: bool

    def __call__(self, y: np.ndarray) -> float:
        there = ~np.isnan(y)
        if not there.any():
            return 0.0
        if self.largest:
            return float(np.max(np.abs(y[there])))
        return float(np.sqrt(np.sum(self.weights[there] * y[there] ** 2) / np.sum(self.weights[there])))

    def cosine(self, x: np.ndarray, y: np.ndarray) -> float:
        """1: one is a multiple of the other; 0 for what is zero."""
        both = ~(np.isnan(x) | np.isnan(y))
        w, x, y = self.weights[both], x[both], y[both]
        sizes = np.sum(w * x**2) * np.sum(w * y**2)
        return float(np.sum(w * x * y) / np.sqrt(sizes)) if sizes > 0 else 0.0


def trapezoidal(x: np.ndarray) -> np.ndarray:
    """Weights of the trapezoidal rule; equal ones where there is no length."""
    if len(x) < 2 or x[-1] <= x[0]:
        return np.ones(len(x))
    half = 0.5 * np.diff(x)
    return np.append(half, 0.0) + np.append(0.0, half)


def norm_of(curve: Curve, stretch: Stretch) -> CurveNorm:
    """Norm of differences from this curve, the user's own."""
    in_time = trapezoidal(curve.times) if stretch.time is None else np.ones(1)
    return CurveNorm(np.outer(in_time, trapezoidal(curve.s)).ravel(), stretch.largest)


def on(grid: Curve, curve: Curve, stretch: Stretch) -> np.ndarray:
    """A member's curve at the levels and points of the user's own, `grid`, (levels * points,). Levels that lie between
    this curve's own stay NaN: straight lines between them would be an error of their own."""
    times, levels = curve.times, grid.times
    if stretch.time is not None:
        row = np.array([np.interp(stretch.time, times, column) for column in curve.values.T])
        return _on_points(curve.s, row[None, :], grid.s).ravel()
    values = _on_points(curve.s, curve.values, grid.s)
    nearest = np.clip(np.searchsorted(times, levels), 1, max(len(times) - 1, 1))
    if len(times) > 1:
        nearest = nearest - (levels - times[nearest - 1] < times[nearest] - levels)
    else:
        nearest = np.zeros(len(levels), dtype=int)
    step = float(np.median(np.diff(levels))) if len(levels) > 1 else 1.0
    there = np.abs(times[nearest] - levels) <= SAME_LEVEL * step
    if np.count_nonzero(there) < LEAST_LEVELS * len(levels):
        return np.array([np.interp(levels, times, column) for column in values.T]).T.ravel()
    found = np.full((len(levels), values.shape[1]), np.nan)
    found[there] = values[nearest[there]]
    return found.ravel()


def size_of(curve: Curve, stretch: Stretch) -> float:
    """The size that the curve's error is relative to."""
    return max(norm_of(curve, stretch)(on(curve, curve, stretch)), AT_REST * curve.largest)


def _on_points(s: np.ndarray, values: np.ndarray, points: np.ndarray) -> np.ndarray:
    if len(s) == len(points) and (len(s) == 1 or np.array_equal(s, points)):
        return values
    return np.array([np.interp(points, s, row) for row in values])
