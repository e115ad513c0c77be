"""The pressure along the centre line over time, and the wave in it: crests and their speed."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base.errors import InputError
from .levels import between_levels

SPEED_WINDOW_MS = (4.5, 9.0)  # between start-up at the inlet and the arrival of reflections


@dataclass(frozen=True)
class Crest:
    pressure: float  # Pa
    z: float  # mm


@dataclass(frozen=True)
class PressureWaves:
    """Pressure along the centre line at all time levels of a run."""

    times: np.ndarray  # ms, increasing, (levels,)
    z: np.ndarray  # mm, reference coordinates, increasing, (points,)
    pressure: np.ndarray  # Pa, (levels, points)

    @property
    def time_tolerance(self) -> float:
        """Two times closer than this, in ms, are the same time level written with different round-off."""
        step = np.min(np.diff(self.times)) if len(self.times) > 1 else 1.0
        return 1e-6 * step

    def covers(self, time: float) -> bool:
        """Whether `time`, in ms, lies between the first and the last level."""
        return self.times[0] - self.time_tolerance <= time <= self.times[-1] + self.time_tolerance

    def require(self, time: float, file: str | Path, key: str) -> None:
        """Raises InputError about a file and key for a time, in ms, that is not covered."""
        if not self.covers(time):
            remedy = f"give times between {self.times[0]:g} and {self.times[-1]:g} ms"
            raise InputError(file, key, f"{time:g} ms is outside the run", remedy)

    def level(self, time: float) -> int | None:
        """Index of the level at `time`, in ms; None when no level is there."""
        nearest = int(np.argmin(np.abs(self.times - time)))
        return nearest if abs(self.times[nearest] - time) <= self.time_tolerance else None

    def at(self, time: float) -> np.ndarray:
        """Pressure in Pa at `time` in ms, (points,); linear between the neighbouring levels. `time` must be covered."""
        assert self.covers(time)
        return between_levels(self.times, time, self.time_tolerance, self.pressure.__getitem__)

    def covers_line(self, z: np.ndarray) -> bool:
        """Whether all points `z`, in mm, lie on this run's centre line."""
        tolerance = 1e-9 * (self.z[-1] - self.z[0])
        return self.z[0] - tolerance <= z[0] and z[-1] <= self.z[-1] + tolerance

    def elsewhere(self, z: np.ndarray, file: str | Path, key: str, whose: str) -> InputError:
        """About a line that does not cover the points `z`, which are `whose`."""
        problem = f"runs from {self.z[0]:g} to {self.z[-1]:g} mm, {whose} from {z[0]:g} to {z[-1]:g} mm"
        return InputError(file, key, problem, "compare runs on the same geometry")

    def on(self, z: np.ndarray) -> "PressureWaves":
        """The waves at other points, in mm; linear between this run's points, which must cover them."""
        assert self.covers_line(z)
        if np.array_equal(z, self.z):
            return self
        return PressureWaves(self.times, z, np.array([np.interp(z, self.z, row) for row in self.pressure]))


def crest_at(z: np.ndarray, pressure: np.ndarray, i: int) -> Crest:
    """Vertex of the parabola through point i, a maximum, and its two neighbours; point i itself at an end of the line
    or where the three lie on a straight line."""
    if i in (0, len(z) - 1):
        return Crest(float(pressure[i]), float(z[i]))
    slope_left = (pressure[i] - pressure[i - 1]) / (z[i] - z[i - 1])
    slope_right = (pressure[i + 1] - pressure[i]) / (z[i + 1] - z[i])
    curvature = (slope_right - slope_left) / (z[i + 1] - z[i - 1])  # second divided difference, half of p''
    if curvature >= 0:
        return Crest(float(pressure[i]), float(z[i]))
    # Newton form about z_{i-1}, z_i: p = p_{i-1} + slope_left (z - z_{i-1}) + curvature (z - z_{i-1}) (z - z_i)
    vertex = 0.5 * (z[i - 1] + z[i]) - 0.5 * slope_left / curvature
    value = pressure[i - 1] + (slope_left + curvature * (vertex - z[i])) * (vertex - z[i - 1])
    return Crest(float(value), float(vertex))


def peak(z: np.ndarray, pressure: np.ndarray) -> Crest:
    """The largest maximum of one wave, between the points by a parabola."""
    return crest_at(z, pressure, int(np.argmax(pressure)))


def crest_speed(waves: PressureWaves, window: tuple[float, float] = SPEED_WINDOW_MS) -> float | None:
    """Speed in mm/ms of the main crest: slope of the least-squares line through its positions at the levels of
    `window`.

    The crest is the largest maximum at the first of these levels. From one level to the next it is the largest maximum
    within the stretch around its last position where the pressure was above half of its peak, so that another crest
    that grows taller on the way is not mistaken for it. None when it cannot be followed: run too short, pressure not
    positive, maximum at an end of the line, crest gone or moved further than its own width between two levels.
    """
    if not (waves.covers(window[0]) and waves.covers(window[1])):
        return None
    tolerance = waves.time_tolerance
    levels = np.flatnonzero((waves.times >= window[0] - tolerance) & (waves.times <= window[1] + tolerance))
    if len(levels) < 3:
        return None
    before = waves.pressure[levels[0]]
    here = int(np.argmax(before))
    if not 0 < here < len(waves.z) - 1 or before[here] <= 0:
        return None
    positions = []
    for level in levels:
        pressure = waves.pressure[level]
        crests = [i for i in _maxima(pressure) if pressure[i] > 0 and _on_same_hump(before, here, i)]
        if not crests:
            return None
        here = max(crests, key=lambda i: pressure[i])
        positions.append(crest_at(waves.z, pressure, here).z)
        before = pressure
    times = waves.times[levels]
    return float(np.polyfit(times - times.mean(), positions, 1)[0])


def _maxima(pressure: np.ndarray) -> np.ndarray:
    """Indices of the local maxima away from the ends; the first point of a plateau stands for it."""
    inner = pressure[1:-1]
    return np.flatnonzero((inner > pressure[:-2]) & (inner >= pressure[2:])) + 1


def _on_same_hump(pressure: np.ndarray, top: int, other: int) -> bool:
    """Whether the pressure stays above half of its value at `top` all the way from there to `other`."""
    low, high = sorted((top, other))
    return bool(np.all(pressure[low : high + 1] >= 0.5 * pressure[top]))
