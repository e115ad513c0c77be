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
    """The swings over the last `count` periods (ms)."""
    last = times > times[-1] - count * period
    return Swings(times[last], values[last])


def free_swing(times: np.ndarray, values: np.ndarray, after: float, apart: float, terms: int = 4) -> complex:
    """s, in 1/ms, of the fastest of `terms` exponentials e^(s t) that values from `after` (ms) on are a sum of.

    Prony's method by least squares: values `apart` from each other obey one linear recurrence, whose roots are e^(s
    apart). What is smooth in time and decays is found as one or two real ones, beside the pair of a swing."""
    step = times[1] - times[0]
    n = max(1, int(round(apart / step)))
    v = values[times > after * (1 - 1e-9)]
    rows = np.stack([v[k * n : len(v) - (terms - k) * n] for k in range(terms + 1)], axis=1)
    factors = np.linalg.lstsq(rows[:, :-1], rows[:, -1], rcond=None)[0]
    roots = np.roots(np.concatenate([[1.0], -factors[::-1]])).astype(complex)
    of_swings = roots[np.abs(np.angle(roots)) < 0.999 * np.pi]  # one that changes its sign at each value is none
    exponents = np.log(of_swings) / (n * step)
    return complex(exponents[np.argmax(exponents.imag)])
