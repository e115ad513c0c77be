"""Values along a line over time, such as centre-line pressure or wall displacement, and how far they are apart."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

import numpy as np

from .levels import between_levels, integral, read_levels


@dataclass(frozen=True)
class Quantity:
    file: str  # in a result folder
    column: str
    name: str


# ms: takes most of the wall's thickness shear, of 0.4 and 0.9 ms, off the pressure (docs/evidence/evidence.md).
WINDOW = 0.7

PRESSURE = Quantity("centerline_pressure.csv", "pressure_Pa", "centre-line pressure")
AVERAGED = Quantity("averaged_pressure.csv", "averaged_pressure_Pa", f"centre-line pressure averaged over {WINDOW} ms")
DISPLACEMENT = Quantity("wall_displacement.csv", "radial_mm", "wall displacement")
WRITTEN = (PRESSURE, DISPLACEMENT)  # by the programs
QUANTITIES = (PRESSURE, AVERAGED, DISPLACEMENT)  # in a reference's folder


@dataclass(frozen=True)
class Waves:
    times: np.ndarray  # ms, increasing
    z: np.ndarray  # mm, increasing
    values: np.ndarray  # (times, z)

    def covers(self, time: float) -> bool:
        return self.times[0] - 1e-6 <= time <= self.times[-1] + 1e-6

    def at(self, times: Sequence[float] | np.ndarray, z: np.ndarray) -> np.ndarray:
        """(times, z), linear between levels and points; a level nearer than 1e-6 ms is taken as it is."""
        rows = []
        for time in times:
            if not self.covers(time):
                raise ValueError(f"{time} ms is not between {self.times[0]} and {self.times[-1]} ms")
            row = between_levels(self.times, time, 1e-6, self.values.__getitem__)
            rows.append(row if np.array_equal(z, self.z) else np.interp(z, self.z, row))
        return np.array(rows)


def read_waves(path: Path, column: str) -> Waves:
    """Reads a table of a line. Raises InputError."""
    return Waves(*read_levels(path, column))


def averaged(waves: Waves, times: Sequence[float], window: float = WINDOW) -> Waves:
    """Mean over [t - window/2, t + window/2] of the waves, linear between levels; NaN where they do not cover that."""
    widths = np.diff(waves.times)[:, None]
    sums = np.cumsum(0.5 * widths * (waves.values[1:] + waves.values[:-1]), axis=0)
    integral = np.concatenate([np.zeros((1, len(waves.z))), sums])

    def until(time: float) -> np.ndarray:
        """Integral from the first level."""
        before = min(max(int(np.searchsorted(waves.times, time, side="right")) - 1, 0), len(waves.times) - 2)
        part = time - waves.times[before]
        return integral[before] + 0.5 * part * (waves.values[before] + waves.at([time], waves.z)[0])

    rows, times = [], sorted(times)
    for time in times:
        first, last = time - 0.5 * window, time + 0.5 * window
        covered = waves.covers(first) and waves.covers(last) and len(waves.times) > 1
        rows.append((until(last) - until(first)) / window if covered else np.full(len(waves.z), math.nan))
    return Waves(np.array(times, dtype=float), waves.z, np.array(rows))


def read_run(folder: Path, times: Sequence[float]) -> dict[str, Waves]:
    """All quantities of a result folder by column, the averaged pressure at `times` (ms). Raises InputError."""
    waves = {q.column: read_waves(folder / q.file, q.column) for q in WRITTEN}
    return {**waves, AVERAGED.column: averaged(waves[PRESSURE.column], times)}


def norm(z: np.ndarray, values: np.ndarray) -> float:
    """(sum over the levels of the integral of values^2 dz)^(1/2), by the trapezoidal rule. Relative norms of equally
    spaced levels are those over space and time."""
    return math.sqrt(integral(z, values * values))


def relative_difference(other: Waves, reference: Waves, times: Sequence[float]) -> float:
    """L2 over z and `times` (ms) of other - reference, relative to the reference's, on the reference's points."""
    expected = reference.at(times, reference.z)
    size = norm(reference.z, expected)
    return norm(reference.z, other.at(times, reference.z) - expected) / size if size > 0 else math.nan
