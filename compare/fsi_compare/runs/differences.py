"""How far two runs' pressure waves are apart."""

import math
from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np

from .pressure_waves import PressureWaves


@dataclass(frozen=True)
class Difference:
    """Norms of p - p_reference over the centre line; the relative ones are None where the reference is zero."""

    max_norm: float  # Pa
    max_relative: float | None  # to max |p_reference| at the same time
    l2_norm: float  # Pa mm^(1/2)
    l2_relative: float | None  # to the L2 norm of p_reference at the same time


def l2_norm(z: np.ndarray, values: np.ndarray) -> float:
    """(integral of values^2 dz)^(1/2) by the trapezoidal rule."""
    squares = values * values
    return math.sqrt(float(np.sum(0.5 * (squares[1:] + squares[:-1]) * np.diff(z))))


def difference(z: np.ndarray, reference: np.ndarray, other: np.ndarray) -> Difference:
    """Difference of two waves, in Pa, at the same points z, in mm."""
    max_norm = float(np.max(np.abs(other - reference)))
    l2 = l2_norm(z, other - reference)
    max_reference = float(np.max(np.abs(reference)))
    l2_reference = l2_norm(z, reference)
    return Difference(
        max_norm=max_norm,
        max_relative=max_norm / max_reference if max_reference > 0 else None,
        l2_norm=l2,
        l2_relative=l2 / l2_reference if l2_reference > 0 else None,
    )


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
