"""What scenes share in which something swings for ever: its last swings, their extremes and their frequency."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Swings:
    """The last swings of a quantity, `values` at `times` in ms."""

    times: np.ndarray
    values: np.ndarray

    @property
    def amplitude(self) -> float:
        return float(self.values.max() - self.values.min()) / 2

    @property
    def mean(self) -> float:
        """Midway between the extremes."""
        return float(self.values.max() + self.values.min()) / 2

    @property
    def frequency(self) -> float:
        """1/s, from where the quantity comes up through its mean."""
        t, v, middle = self.times, self.values, self.mean
        up = np.flatnonzero((v[:-1] <= middle) & (v[1:] > middle))
        crossings = t[up] + (middle - v[up]) / (v[up + 1] - v[up]) * (t[up + 1] - t[up])
        return float(1000 * (len(crossings) - 1) / (crossings[-1] - crossings[0]))


def last_swings(times: np.ndarray, values: np.ndarray, period: float, count: int = 4) -> Swings:
    """Those of the last `count` periods (ms)."""
    last = times > times[-1] - count * period
    return Swings(times[last], values[last])
