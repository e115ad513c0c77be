"""How far two runs' pressure waves are apart."""

from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np

from .pressure_waves import PressureWaves
from .waves import norm


@dataclass(frozen=True)
class Difference:
    """Norms of p - p_reference over the centre line; the relative ones are None where the reference is zero."""

    max_norm: float  # Pa
    max_relative: float | None  # to max |p_reference| at the same time
    l2_norm: float  # Pa mm^(1/2)
    l2_relative: float | None  # to the L2 norm of p_reference at the same time


def difference(z: np.ndarray, reference: np.ndarray, other: np.ndarray) -> Difference:
    """Difference of two waves, in Pa, at the same points z, in mm."""
    largest, size = (float(np.max(np.abs(values))) for values in (other - reference, reference))
    l2, l2_size = norm(z, other - reference), norm(z, reference)
    return Difference(largest, largest / size if size > 0 else None, l2, l2 / l2_size if l2_size > 0 else None)


def differences_at(reference: PressureWaves, other: PressureWaves, times: Sequence[float]) -> list[Difference]:
    """Differences at the given times, in ms, on the reference's points."""
    other = other.on(reference.z)
    return [difference(reference.z, reference.at(time), other.at(time)) for time in times]


@dataclass(frozen=True)
class OverTime:
    """Each norm's largest value over the time levels that both runs have."""

    levels: int
    largest: Difference | None  # None when there is no common level


def largest_difference(reference: PressureWaves, other: PressureWaves) -> OverTime:
    """The maximum over time of each column by itself, so the four may stem from different times. Levels where the
    reference is zero do not enter the relative ones."""
    common = [t for t in reference.times if other.level(t) is not None]
    if not common:
        return OverTime(0, None)
    all_levels = differences_at(reference, other, common)

    def largest(name: str) -> Any:
        values = [getattr(d, name) for d in all_levels if getattr(d, name) is not None]
        return max(values) if values else None

    return OverTime(len(common), Difference(*(largest(name) for name in Difference.__dataclass_fields__)))
