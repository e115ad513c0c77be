"""Viscoelastic tube: a pressure wave that its wall and its blood damp

The pressure at the inlet of a tube of 2 mm radius, 0.5 mm wall and 40 mm length swings once in 8 ms. Its wall is
neo-Hookean with a viscosity of Kelvin and Voigt's kind and one Maxwell branch; its outer face is held along the axis, as tissue
holds an artery. The wave runs towards the outlet, weakened by both, and partly back.

Pressures p along the axis are e^(i w t) times waves e^(-i k z) and e^(i k z), whatever their shares, so that p(z - h) + p(z + h) =
2 cos(k h) p(z): that finds the complex wave number k. Its real part is the frequency over the phase speed, its imaginary
part the attenuation.

The exact k is that of small waves in a thick viscoelastic tube filled with a viscous liquid (docs/theory.md, section 13.4):
potential and shear waves in both media, by Bessel functions, with the complex shear modulus
G = mu + i w eta/2 + G_1 i w tau/(1 + i w tau) of the wall.
"""

import numpy as np

from known_solutions.dispersion import (
    draw_swings,
    incompressible_waves,
    lack,
    root,
    speed_and_attenuation,
    swing_on_the_axis,
    wave_number,
)

MESH = "geo tube.geo --order 2"
QUICK_MESH = "geo tube.geo --order 2 --set along=16 --set across=4 --set through=1"
QUICK = {"time.step": 0.25, "time.end": 32}

INNER, OUTER, PERIOD = 2.0, 2.5, 8.0  # mm, mm, ms
BLOOD, VISCOSITY, WALL = 1.0, 0.02, 1.1  # mg/mm^3, kPa ms, mg/mm^3
SHEAR, ETA, BRANCH, TIME = 40.0, 4.0, 30.0, 1.5  # kPa, kPa ms, kPa, ms
OMEGA = 2 * np.pi / PERIOD
FIRST, LAST, APART = 8.0, 32.0, 4.0  # mm along the axis: where waves are alone; h


def shear_modulus(omega):
    """Complex, of the wall."""
    rate = 1j * omega
    return SHEAR + rate * ETA / 2 + BRANCH * rate * TIME / (1 + rate * TIME)


def lacking(k, omega):
    """Zero where blood and wall have a wave of this number."""
    blood = incompressible_waves(1j * omega * BLOOD, VISCOSITY, k, INNER)
    inner, outer = (incompressible_waves(-WALL * omega**2, shear_modulus(omega), k, r) for r in (INNER, OUTER))
    return lack(omega, blood, inner, (outer[1], outer[2]))  # held along the axis, free across


def exact_wave_number(omega=OMEGA):
    """From that of a thin wall held along its axis, without viscosity of the blood."""
    stiffness = 4 * shear_modulus(omega) * (OUTER - INNER)
    thin = omega / np.sqrt(stiffness / (2 * BLOOD * INNER))
    return root(lambda k: lacking(k, omega), thin, 1.05 * thin)


EXACT = exact_wave_number()


def numbers(runs):
    tolerances = (0.02, 0.03) if runs.quick else (0.003, 0.005)
    found = []
    for run in runs:
        k = wave_number(swing_on_the_axis(run, PERIOD).between(FIRST, LAST), APART)
        found += speed_and_attenuation(run, k, EXACT, OMEGA, tolerances)
    return found


def draw(runs):
    return draw_swings(runs, PERIOD, FIRST, LAST, [EXACT])
