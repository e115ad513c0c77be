"""The periodic state of a vessel without dimensions between what its openings are given.

All is linear, so that each harmonic stands for itself. With the admittances Y_i = 1 / (R_i + j w L_i + Z_i) of
openings with a law, where that of a Windkessel is Z = R_p + R_d / (1 + j w R_d C) ([Westerhof2009]), the sum of all
flows out of the point gives

    P = (sum of Y_i e_i - sum of the given Q_i) / (sum of Y_i + j w C),        Q_i = Y_i (P - e_i),

where e_i is the pressure that opening i is given, or the distal one behind its law (harmonic 0 only).
"""

from dataclasses import dataclass
from typing import Mapping

import numpy as np

from .vessel import Vessel

PHASES = 1024  # of a period
SHORT = 1e-9  # of the largest resistance: what stands for none between the point and a given pressure


@dataclass(frozen=True)
class GivenFlow:
    flow: np.ndarray  # mm^3/ms outwards, (PHASES,)


@dataclass(frozen=True)
class GivenPressure:
    pressure: np.ndarray  # kPa, (PHASES,)


@dataclass(frozen=True)
class Windkessel:
    """The law of an outlet; with `distal` 0 a resistance."""

    proximal: float  # kPa ms/mm^3
    compliance: float  # mm^3/kPa
    distal: float  # kPa ms/mm^3
    distal_pressure: float = 0.0  # kPa

    @property
    def resistance(self) -> float:
        return self.proximal + self.distal

    @property
    def values(self) -> dict[str, float]:
        """Entries of a case that are tuned."""
        return {"proximal": self.proximal, "compliance": self.compliance, "distal": self.distal}

    def behind(self, frequency: np.ndarray) -> np.ndarray:
        """R_d / (1 + j w R_d C): pressure stored over flow."""
        return self.distal / (1 + 1j * frequency * self.distal * self.compliance)


End = GivenFlow | GivenPressure | Windkessel


@dataclass(frozen=True)
class State:
    """Over one period, by opening, arrays (PHASES,) from time 0 on."""

    pressure: Mapping[str, np.ndarray]  # kPa
    flow: Mapping[str, np.ndarray]  # mm^3/ms outwards
    stored: Mapping[str, np.ndarray]  # kPa, of Windkessels


def periodic_state(vessel: Vessel, ends: Mapping[str, End], period: float) -> State:
    """One end at least is a pressure or a law."""
    frequency = 2 * np.pi / period * np.arange(PHASES // 2 + 1)
    serial = {n: vessel.resistance[n] + 1j * frequency * vessel.inertance[n] for n in ends}
    short = _short(vessel, ends)
    admittance, source, given = {}, {}, {}
    for name, end in ends.items():
        if isinstance(end, GivenFlow):
            given[name] = np.fft.rfft(end.flow)
            continue
        law: float | np.ndarray = end.proximal + end.behind(frequency) if isinstance(end, Windkessel) else 0.0
        admittance[name] = 1 / (serial[name] + law + short)
        source[name] = _source(end, len(frequency))
    total = sum(admittance.values()) + 1j * frequency * vessel.compliance
    point = (sum(admittance[n] * source[n] for n in admittance) - sum(given.values(), np.zeros(1))) / total
    flows = {n: given[n] if n in given else admittance[n] * (point - source[n]) for n in ends}
    pressure = {n: _in_time(point - serial[n] * flows[n]) for n in ends}
    laws = {n: end for n, end in ends.items() if isinstance(end, Windkessel)}
    stored = {n: _in_time(source[n] + law.behind(frequency) * flows[n]) for n, law in laws.items()}
    return State(pressure, {n: _in_time(q) for n, q in flows.items()}, stored)


def mean_flows(vessel: Vessel, ends: Mapping[str, End]) -> dict[str, float]:
    """Outwards, of harmonic 0 alone."""
    short = _short(vessel, ends)
    laws = {n: end.resistance if isinstance(end, Windkessel) else 0.0 for n, end in ends.items()}
    given = {n: float(end.flow.mean()) for n, end in ends.items() if isinstance(end, GivenFlow)}
    weight = {n: 1 / (vessel.resistance[n] + laws[n] + short) for n in ends if n not in given}
    level = {n: float(_source(ends[n], 1)[0].real) / PHASES for n in weight}
    point = (sum(weight[n] * level[n] for n in weight) - sum(given.values())) / sum(weight.values())
    return {n: given[n] if n in given else weight[n] * (point - level[n]) for n in ends}


def _short(vessel: Vessel, ends: Mapping[str, End]) -> float:
    laws = [end.resistance for end in ends.values() if isinstance(end, Windkessel)]
    return SHORT * max([*vessel.resistance.values(), *laws, 1e-300])


def _source(end: End, count: int) -> np.ndarray:
    """Harmonics of the pressure at the far end, (count,)."""
    if isinstance(end, GivenPressure):
        return np.fft.rfft(end.pressure)[:count]
    found = np.zeros(count, dtype=complex)
    found[0] = PHASES * end.distal_pressure if isinstance(end, Windkessel) else 0.0
    return found


def _in_time(harmonics: np.ndarray) -> np.ndarray:
    return np.fft.irfft(harmonics, PHASES)
