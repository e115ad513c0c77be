"""Womersley flow in an elastic tube: a wave in a long wall that is free

The pressure at the inlet of a tube of 1 m radius, 0.1 m wall and 60 m length swings by 1 Pa with a period of 50 s. Its wall is
compressible (20 kPa, Poisson's ratio 0.3) and as heavy as the liquid, whose viscosity of 5 Pa s makes Womersley's number 5.0.

Nothing holds the wall but its ends, so that two waves run in it: Young's, which the pressure drives, and a slow stretching
of the wall along the axis, which the ends send out. With the exact number k' of the second, p(z - h) + p(z + h) - 2 cos(k' h) p(z)
has none of it, and of the first a share; that gives k as in the viscoelastic tube.

Both exact numbers are those of small waves in a thick compressible tube filled with a viscous liquid (docs/theory.md, section
13.4). For this tube k = 0.143978 - 0.020727 i per m is published, a speed of 0.872796 m/s.
"""

import numpy as np

from known_solutions.dispersion import (
    compressible_waves,
    draw_swings,
    incompressible_waves,
    lack,
    root,
    speed_and_attenuation,
    swing_on_the_axis,
    wave_number,
)

MESH = "geo tube.geo --order 2"
QUICK_MESH = "geo tube.geo --order 2 --set along=40 --set across=4"
QUICK = {"time.step": 1250, "time.end": 300000}

INNER, OUTER, PERIOD = 1000.0, 1100.0, 50000.0  # mm, mm, ms
DENSITY, VISCOSITY = 1.0, 5.0  # mg/mm^3, of liquid and wall; kPa ms
YOUNG, POISSON = 20.0, 0.3  # kPa
OMEGA = 2 * np.pi / PERIOD
SHEAR = YOUNG / (2 * (1 + POISSON))
LAME = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
FIRST, LAST, APART = 6000.0, 54000.0, 5000.0  # mm along the axis: where these waves are alone; h


def lacking(k):
    """Zero where liquid and wall have a wave of this number."""
    liquid = incompressible_waves(1j * OMEGA * DENSITY, VISCOSITY, k, INNER)
    inner, outer = (compressible_waves(DENSITY, SHEAR, LAME, OMEGA, k, r) for r in (INNER, OUTER))
    return lack(OMEGA, liquid, inner, (outer[2], outer[3]))


THIN = OMEGA / np.sqrt(YOUNG * (OUTER - INNER) / (2 * DENSITY * INNER))  # Moens and Korteweg
BAR = OMEGA / np.sqrt(YOUNG / DENSITY)
EXACT = root(lacking, THIN, (1.1 - 0.15j) * THIN)
OTHER = root(lacking, BAR, (1.2 - 0.2j) * BAR)


def numbers(runs):
    tolerances = (0.02, 0.1) if runs.quick else (0.003, 0.01)
    found = []
    for run in runs:
        k = wave_number(swing_on_the_axis(run, PERIOD).between(FIRST, LAST), APART, [OTHER])
        found += speed_and_attenuation(run, k, EXACT, OMEGA, tolerances)
    return found


def draw(runs):
    return draw_swings(runs, PERIOD, FIRST, LAST, [EXACT, OTHER])
