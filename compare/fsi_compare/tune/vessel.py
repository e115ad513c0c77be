"""The vessel without dimensions, from the curves at its openings.

Its openings meet in one point of pressure P. From there to opening i lead a resistance and an inertance, in the point
is a compliance (Q_i is the flow outwards):

    p_i = P - R_i Q_i - L_i dQ_i/dt,        C dP/dt = - sum Q_i.

P is in no table. The differences of pressures between the openings know nothing of it, so they give R_i and L_i
first, by non-negative least squares; P is then the mean of p_i + R_i Q_i + L_i dQ_i/dt, and C the slope of the stored
volume over it.
"""

from dataclasses import dataclass
from typing import Mapping

import numpy as np

from .curves import Curves

SWEEPS, SMALLEST_CHANGE = 2000, 1e-12


@dataclass(frozen=True)
class Vessel:
    resistance: Mapping[str, float]  # kPa ms/mm^3, by opening
    inertance: Mapping[str, float]  # kPa ms^2/mm^3, by opening
    compliance: float  # mm^3/kPa; 0: rigid
    unexplained_pressure: float = 0.0  # root mean square of what the model leaves of the differences, over theirs
    unexplained_volume: float = 0.0  # the same of the stored volume; 0 where it is rigid


def fitted_vessel(curves: Curves, elastic: bool) -> Vessel:
    """`curves`: of two or more openings, at three or more levels."""
    middle = {name: 0.5 * (q[1:] + q[:-1]) for name, q in curves.flow.items()}
    step = np.diff(curves.time)
    slope = {name: np.diff(q) / step for name, q in curves.flow.items()}
    pressure = {name: 0.5 * (p[1:] + p[:-1]) for name, p in curves.pressure.items()}
    first, *others = names = list(curves.flow)
    count = len(step)
    matrix = np.zeros((len(others) * count, 2 * len(names)))
    right = np.zeros(len(others) * count)
    for k, name in enumerate(others):  # p_first - p_i = Z_i Q_i - Z_first Q_first
        rows = slice(k * count, (k + 1) * count)
        right[rows] = pressure[first] - pressure[name]
        for sign, opening in ((1.0, name), (-1.0, first)):
            j = names.index(opening)
            matrix[rows, 2 * j] = sign * middle[opening]
            matrix[rows, 2 * j + 1] = sign * slope[opening]
    found = not_negative(matrix, right)
    resistance, inertance = dict(zip(names, map(float, found[0::2]))), dict(zip(names, map(float, found[1::2])))
    unexplained = _share(matrix @ found - right, right)
    if not elastic:
        return Vessel(resistance, inertance, 0.0, unexplained)
    inside = [pressure[n] + resistance[n] * middle[n] + inertance[n] * slope[n] for n in names]
    volume = -np.cumsum(step * sum(middle.values())) + 0.5 * step * sum(middle.values())
    compliance, left = _slope(np.mean(inside, axis=0), volume)
    return Vessel(resistance, inertance, compliance, unexplained, left)


def not_negative(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """x >= 0 with the least |A x - b|, by descent along one unknown after the other ([Lawson1995] states the
    problem), columns scaled to one length. Of unknowns that only their sum is known of each gets a part, for the
    descent begins with the shortest of all solutions."""
    length = np.linalg.norm(matrix, axis=0)
    used = length > 1e-12 * max(float(length.max(initial=0.0)), 1e-300)
    scaled = matrix[:, used] / length[used]
    normal, aim = scaled.T @ scaled, scaled.T @ right
    x = np.clip(np.linalg.lstsq(scaled, right, rcond=1e-9)[0], 0.0, None)  # the shortest of all solutions
    for _ in range(SWEEPS):
        before = x.copy()
        for j in range(len(x)):
            x[j] = max(0.0, x[j] + aim[j] - normal[j] @ x)  # the diagonal is 1
        if np.abs(x - before).max(initial=0.0) <= SMALLEST_CHANGE * np.abs(x).max(initial=1e-300):
            break
    found = np.zeros(matrix.shape[1])
    found[used] = x / length[used]
    return found


def _slope(pressure: np.ndarray, volume: np.ndarray) -> tuple[float, float]:
    """dV/dP by least squares, no less than 0, and what it leaves."""
    p, v = pressure - pressure.mean(), volume - volume.mean()
    slope = max(0.0, float(p @ v) / max(float(p @ p), 1e-300))
    return slope, _share(slope * p - v, v)


def _share(left: np.ndarray, of: np.ndarray) -> float:
    return float(np.linalg.norm(left) / max(float(np.linalg.norm(of)), 1e-300))
