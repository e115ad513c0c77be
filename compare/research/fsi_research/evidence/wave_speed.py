"""Speed of a pressure wave in a layered elastic tube filled with an inviscid incompressible fluid, from the constants
of fluid and wall. Units: mm, ms, mg, kPa; so speeds are in mm/ms."""

import math
from typing import Sequence, Tuple

import numpy as np

from .tube import Tube


def moens_korteweg(tube: Tube, restrained: bool = False) -> float:
    """c^2 = E h / (2 rho R) of a thin wall, R the inner radius ([Moens1878], [Korteweg1878]). E is the hoop modulus of
    a wall free to shorten; `restrained`: of one held at its length, E / (1 - nu^2) = 4 E / 3 without fibres."""
    hoop, coupling, axial = _sums(tube, [True] * len(tube.layers))
    stiffness = hoop
    if not restrained:
        active = [True] * len(tube.layers)
        for _ in range(len(tube.layers) + 1):  # fibres that the shortening slackens do not act
            hoop, coupling, axial = _sums(tube, active)
            strain = -coupling / axial
            found = [layer.stretches_fibres(1.0, strain) for layer in tube.layers]
            if found == active:
                break
            active = found
        stiffness = hoop - coupling**2 / axial
    return math.sqrt(stiffness / (2 * tube.fluid_density * tube.radius))


def _sums(tube: Tube, active: Sequence[bool]) -> Tuple[float, float, float]:
    total = np.sum([layer.thickness * layer.stiffness(on) for layer, on in zip(tube.layers, active)], axis=0)
    return float(total[0, 0]), float(total[0, 1]), float(total[1, 1])


def wall_stiffness(tube: Tube) -> float:
    """dp/du in kPa/mm: inner pressure over radial displacement of the inner face, of the thick wall at its length.
    There e_h = -e_r = u R / r^2, so that p = u R sum over layers H/2 (1/A^2 - 1/B^2), H = 4 mu + 8 k1 cos^4 alpha, A
    and B the layer's radii. For small u the derivative of the closed-form inflation pressure."""
    return tube.radius * sum(
        0.5 * float(layer.stiffness()[0, 0]) * (layer.inner**-2 - layer.outer**-2) for layer in tube.layers
    )


def long_wave(tube: Tube) -> float:
    """c^2 = A/rho dp/dA = R/(2 rho) dp/du: the limit of long waves in the thick wall at its length."""
    return math.sqrt(tube.radius / (2 * tube.fluid_density) * wall_stiffness(tube))


def phase_speed(tube: Tube, wave_number: float) -> float:
    """Dispersion at `wave_number` k in 1/mm: (rho m + rho_s h) c^2 k^2 = dp/du with the added masses per area of
    the fluid, rho m, and of the wall, rho_s h."""
    added = tube.added_mass_length(wave_number)
    mass = tube.fluid_density * added + tube.wall_density * tube.thickness
    return math.sqrt(wall_stiffness(tube) / mass) / wave_number
