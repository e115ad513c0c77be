"""Values in time as svMultiPhysics takes them: a linear trend and a Fourier series of as many modes as the file says
(FourierInterpolation.cpp of its sources), or the trend alone where it is a ramp."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base.errors import InputError
from ..base.files import read_text
from ..base.numbers import parsed

SAMPLES_A_MODE = 64  # linear in between, the highest mode is off by 1/8 (2 pi/64)^2 of itself, 0.12 %
FEWEST, MOST = 128, 20000


@dataclass
class Waveform:
    """value(t) = first + slope t + sum of real[n] cos(2 pi n t/T) - imaginary[n] sin(2 pi n t/T), t in [0, T] from
    `start` on, and again with the period T; of a ramp the trend alone, which ends with its last value."""

    start: float
    period: float
    first: float
    slope: float
    real: np.ndarray
    imaginary: np.ndarray
    ramp: bool = False

    def __call__(self, time: np.ndarray) -> np.ndarray:
        """Within a period, from its start."""
        values = self.first + self.slope * time
        if not self.ramp:
            angle = 2 * np.pi * np.outer(np.arange(len(self.real)), time) / self.period
            values = values + self.real @ np.cos(angle) - self.imaginary @ np.sin(angle)
        return values

    def rows(self) -> list[tuple[float, float]]:
        """Times and values over a period from the case's start on; another start in the file is a shift in time."""
        if self.ramp:
            times = np.array([0.0, self.period])
            rows = list(zip((times + self.start).tolist(), self(times).tolist()))
            return rows if self.start == 0 else [(0.0, rows[0][1])] + rows
        count = min(max(FEWEST, SAMPLES_A_MODE * (len(self.real) - 1)), MOST)
        times = np.linspace(0.0, self.period, count + 1)
        # As C's fmod, which keeps the sign: before the file's start the trend goes on.
        inside = times if self.start == 0 else np.fmod(times - self.start, self.period)
        return list(zip(times.tolist(), self(inside).tolist()))


def read_series(path: Path, ramp: bool) -> tuple[Waveform, float]:
    """Reads a file of times and values, whose first line says how many there are and how many modes are taken. Also
    returns the largest difference of the series from the file's values. Raises InputError."""
    numbers = _numbers(path)
    if len(numbers) < 2 or len(numbers[0]) != 2:
        raise InputError(path, "line 1", "is no number of points and number of modes", "write, for one, 33 16")
    points, modes = numbers[0]
    rows = numbers[1:]
    if len(rows) != points or points < 2 or points != int(points):
        raise InputError(path, "line 1", f"says {points:g} points, there are {len(rows)}", "mend the number, 2 or more")
    if modes < 1 or modes != int(modes) or modes > 10000:
        raise InputError(path, "line 1", f"says {modes:g} modes", "give 1 or more")
    for i, row in enumerate(rows):
        if len(row) != 2:
            raise InputError(path, f"point {i + 1}", f"has {len(row)} numbers", "give a time and a value")
    times, values = np.array(rows).T
    if np.any(np.diff(times) <= 0):
        raise InputError(path, "", "has times that do not rise", "put them in order")
    period = float(times[-1] - times[0])
    slope = float((values[-1] - values[0]) / period)
    if ramp:
        nothing = np.zeros(1)
        return Waveform(float(times[0]), period, float(values[0]), slope, nothing, nothing, True), 0.0
    t = times - times[0]
    rest = values - values[0] - slope * t
    count = int(modes)
    real, imaginary = np.zeros(count), np.zeros(count)
    real[0] = np.sum(np.diff(t) * (rest[1:] + rest[:-1])) / (2 * period)
    s = np.diff(rest) / np.diff(t)
    for n in range(1, count):
        angle = 2 * np.pi * n * t / period
        factor = period / (2 * np.pi**2 * n**2)
        real[n] = factor * np.sum(s * np.diff(np.cos(angle)))
        imaginary[n] = -factor * np.sum(s * np.diff(np.sin(angle)))
    wave = Waveform(float(times[0]), period, float(values[0]), slope, real, imaginary)
    return wave, float(np.abs(wave(t) - values).max())


def read_coefficients(path: Path) -> Waveform:
    """Reads a file of start and period, trend, number of modes, and modes. Raises InputError."""
    numbers = _numbers(path)
    if [len(row) for row in numbers[:3]] != [2, 2, 1]:
        remedy = "give start and period, first value and slope, the number of modes, and a line for each"
        raise InputError(path, "", "is no file of Fourier coefficients", remedy)
    (start, period), (first, slope), (modes,) = numbers[:3]
    rows = numbers[3:]
    if period <= 0 or modes != len(rows) or modes < 1 or any(len(row) != 2 for row in rows):
        raise InputError(path, "", f"has {len(rows)} modes of {modes:g}, and a period of {period:g}", "mend the file")
    real, imaginary = np.array(rows).T
    return Waveform(start, period, first, slope, real, imaginary)


def _numbers(path: Path) -> list[list[float]]:
    text = read_text(path, "give the file that the case names", "write numbers", 64 << 20)
    rows = []
    for i, line in enumerate(text.splitlines(), 1):
        if line.strip():
            row = list(map(parsed, line.split()))
            if not np.isfinite(row).all():
                raise InputError(path, f"line {i}", f"'{line.strip()}' holds what is no finite number", "mend it")
            rows.append(row)
    return rows
