"""Pulsating ring: fluid-structure interaction with an exact solution

Blood fills the space between a porous cylinder of radius 0.5 mm and an artery's wall of two neo-Hookean layers. The
cylinder presses with 0.1 kPa for 2 ms. Nothing depends on the angle or on z, so the wall stretches by 9 % and swings.

Continuity leaves one unknown, the inner radius a(t), whose equation of motion is exact at finite strain. The fluid is
four fifths of the swinging mass: a scheme that treats this added mass wrongly shows it here at once.
"""

import numpy as np
from matplotlib.figure import Figure

from known_solutions.layered_tube import holding_pressure, place, swing
from fsi_compare.gallery.scene import Number

MESH = "geo ring.geo --order 2"
QUICK = {"time.end": 4, "time.step": 0.0625}

# Inner radius in mm by time in ms, of the equation of motion (docs/theory.md, section 13.2).
EXACT = {
    0.5: 1.436427264,
    1: 1.454763790,
    2: 1.516247993,
    3: 1.562332206,
    4: 1.548498129,
    6: 1.398794775,
    8: 1.355349637,
    12: 1.541284940,
}
RADIUS = 1.43  # mm, at rest
CYLINDER, OUTER = 0.5, 1.82  # mm
LAYERS = ((1.43, 1.69, 3.0), (1.69, 1.82, 0.3))  # radii at rest in mm, shear modulus in kPa
BLOOD, WALL, VISCOSITY = 1.0, 1.2, 3.5e-3  # mg/mm^3, mg/mm^3, kPa ms
DRIVE, UNTIL = 0.10, 2.0  # kPa, ms


def acceleration(radius, rate, load):
    """Of the inner radius, from the equation of motion (docs/theory.md, section 13.2) with q = a a'."""
    outer = place(OUTER, RADIUS, radius)
    q = radius * rate
    mass = BLOOD * np.log(radius / CYLINDER) + WALL * np.log(outer / radius)
    moved = BLOOD * (radius**-2 - CYLINDER**-2) + WALL * (outer**-2 - radius**-2)
    friction = 2 * VISCOSITY * q * (CYLINDER**-2 - radius**-2)
    return ((load - holding_pressure(LAYERS, radius) - q**2 / 2 * moved - friction) / mass - rate**2) / radius


def exact(end, steps_per_ms=512):
    """Times in ms and inner radii in mm."""
    return swing(acceleration, RADIUS, DRIVE, UNTIL, end, steps_per_ms)


def known_curve(name, times):
    """The displacement of the inner wall, mm."""
    return np.interp(times, *exact(times[-1])) - RADIUS if name == "inner wall: radial" else None


def inner_radius(run):
    """Times in ms and radii in mm."""
    table = run.table("wall_displacement.csv")
    at = table["z_mm"] == table["z_mm"].min()
    return table["time_ms"][at], RADIUS + table["radial_mm"][at]


def numbers(runs):
    found = []
    for run in runs:
        times, radii = inner_radius(run)
        for time in (3, 4) if runs.quick else (3, 8, 12):
            found.append(
                Number(
                    f"inner radius at {time} ms",
                    "mm",
                    run.program,
                    float(radii[np.abs(times - time).argmin()]),
                    EXACT[time],
                    5e-3 if runs.quick else 2e-3,
                    "equation of motion",
                    scale=0.132,  # the largest displacement
                )
            )
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style in zip(runs, ("-", "--")):
        times, radii = inner_radius(run)
        axes.plot(times, radii, style, color="black" if style == "-" else "tab:orange", label=run.words)
    shown = [time for time in EXACT if time <= times[-1]]
    axes.plot(shown, [EXACT[time] for time in shown], "o", color="black", mfc="white", label="exact")
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("inner radius [mm]")
    axes.legend()
    return figure
