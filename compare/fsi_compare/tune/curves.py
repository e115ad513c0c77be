"""Pressures and flows at the openings over a beat."""

from dataclasses import dataclass
from typing import Mapping

import numpy as np

from ..results.openings import Opening
from ..runs.levels import integral

LEAD = 0.1  # of a beat, in which what the start at rest leaves dies out: not looked at


@dataclass(frozen=True)
class Curves:
    """Values at the levels of a run, all arrays of one length. The state at rest is none of them."""

    time: np.ndarray  # ms
    pressure: Mapping[str, np.ndarray]  # kPa, mean over the opening
    flow: Mapping[str, np.ndarray]  # mm^3/ms, outwards
    stored: Mapping[str, np.ndarray]  # kPa, of the Windkessels

    def after(self, time: float) -> "Curves":
        """The levels from `time` on."""
        kept = self.time >= time - 1e-9 * self.time[-1]
        parts = (self.pressure, self.flow, self.stored)
        return Curves(self.time[kept], *({name: values[kept] for name, values in part.items()} for part in parts))


def curves_of(openings: Mapping[str, Opening]) -> Curves:
    time = next(iter(openings.values())).time
    return Curves(
        time,
        {name: one.mean_pressure / 1000 for name, one in openings.items()},
        {name: one.flow for name, one in openings.items()},
        {n: one.windkessel_pressure / 1000 for n, one in openings.items() if one.windkessel_pressure is not None},
    )


def over_period(time: np.ndarray, values: np.ndarray, period: float, count: int) -> np.ndarray:
    """Values at `count` equal phases from 0 on, linear in between. A beat is taken to begin with its last value."""
    phases = np.arange(count) * period / count
    return np.interp(phases, time, values, period=period)


def mean(time: np.ndarray, values: np.ndarray, period: float) -> float:
    """The mean over one period, by the trapezoidal rule; before the first level that level's value holds."""
    return integral(np.append(0.0, time), np.append(values[0], values)) / period
