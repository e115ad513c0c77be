"""A tube of incompressible neo-Hookean layers that widens alike everywhere: its inner radius is the one unknown. What
scenes share whose exact solutions follow from that (docs/theory.md, section 13)."""

from typing import Callable, Sequence

import numpy as np

Layer = tuple[float, float, float]  # inner and outer radius at rest in mm, shear modulus in kPa
Acceleration = Callable[[float, float, float], float]  # of the inner radius, by radius, rate and load

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(20)


def holding_pressure(layers: Sequence[Layer], radius: float) -> float:
    """kPa that holds the inner radius (mm): the integral of (sigma_tt - sigma_rr) / r over the wall, with the
    difference of stresses mu (l^2 - 1 / l^2) at the stretch l = r / R, and dr = dR / l."""
    inner = layers[0][0]
    total = 0.0
    for low, high, modulus in layers:
        at_rest = low + (high - low) * (POINTS + 1) / 2
        now = place(at_rest, inner, radius)
        stretch = now / at_rest
        total += float(np.sum(WEIGHTS * (high - low) / 2 * modulus * (stretch**2 - stretch**-2) / now / stretch))
    return total


def place(at_rest, inner: float, radius):  # type: ignore[no-untyped-def]  # numbers or arrays
    """Where what was at a radius at rest is, when the inner radius has become another: the area between them stays."""
    return np.sqrt(at_rest**2 + radius**2 - inner**2)


def swing(
    acceleration: Acceleration, inner: float, load: float, until: float, end: float, steps_per_ms: int
) -> tuple[np.ndarray, np.ndarray]:
    """Times in ms and inner radii in mm, from rest, under a load that acts until a time, by the classical Runge-Kutta
    method."""
    step = 1 / steps_per_ms
    y = np.array([inner, 0.0])
    radii = [inner]
    for i in range(round(end * steps_per_ms)):
        now = load if (i + 0.5) * step < until else 0.0  # the jump is the end of a step

        def slope(v: np.ndarray, now: float = now) -> np.ndarray:
            return np.array([v[1], acceleration(v[0], v[1], now)])

        k1 = slope(y)
        k2 = slope(y + step / 2 * k1)
        k3 = slope(y + step / 2 * k2)
        k4 = slope(y + step * k3)
        y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        radii.append(float(y[0]))
    return np.arange(len(radii)) * step, np.array(radii)
