"""Ring in time: a wall that swings after a push

The tube of the static scene gets 0.2 kPa for one millisecond and then swings freely. With its incompressible wall it has
one degree of freedom, whose equation of motion is integrated here beside the finite elements.

Second order in time shows in how little the swing is damped: the energy table of the run tells how much.
"""

import numpy as np
from matplotlib.figure import Figure

from known_solutions.layered_tube import holding_pressure, place, swing
from fsi_compare.gallery.scene import Number

MESH = "geo tube.geo --order 2"
DRIVERS = ("fsi-monolithic",)
QUICK = {"time.end": 2.0}

INNER, OUTER = 1.43, 1.82  # mm
LAYERS = ((1.43, 1.69, 3.0), (1.69, 1.82, 0.3))  # radii at rest in mm, shear modulus in kPa
DENSITY = 1.2  # mg/mm^3
PUSH, UNTIL = 0.2, 1.0  # kPa, ms
PLACES = {"inner wall": 1.43, "media": 1.56, "outer": 1.82}  # mm


def acceleration(radius, rate, load):
    """Of the inner radius a, from rho (q' ln(b/a) + q^2/2 (1/b^2 - 1/a^2)) + S(a) = p with q = a a' and
    b^2 = a^2 + Ro^2 - Ri^2."""
    outer = place(OUTER, INNER, radius)
    q = radius * rate
    inertia = DENSITY * q**2 / 2 * (1 / outer**2 - 1 / radius**2)
    change = (load - holding_pressure(LAYERS, radius) - inertia) / (DENSITY * np.log(outer / radius))
    return (change - rate**2) / radius


def exact(end, steps_per_ms=2000):
    """Times in ms and radii in mm."""
    return swing(acceleration, INNER, PUSH, UNTIL, end, steps_per_ms)


def known_curve(name, times):
    """The wall's displacement outwards, mm, at the inner wall and at the points whose radii at rest are in PLACES."""
    point, _, what = name.partition(": ")
    if what not in ("radial", "displacement x") or point not in PLACES:
        return None
    inner = np.interp(times, *exact(times[-1], 1024))
    return place(PLACES[point], INNER, inner) - PLACES[point]


def inner_radius(run):
    table = run.table("wall_displacement.csv")
    at = table["z_mm"] == table["z_mm"].min()
    return table["time_ms"][at], INNER + table["radial_mm"][at]


def numbers(runs):
    times, radii = inner_radius(runs.first)
    known, exact_radii = exact(times[-1], 500)
    wanted = (1.0, 2.0) if runs.quick else (1.0, 2.0, 6.0)
    return [
        Number(
            f"inner radius at {time:g} ms",
            "mm",
            runs.first.program,
            float(radii[np.abs(times - time).argmin()]),
            float(np.interp(time, known, exact_radii)),
            0.002,
            "equation of motion",
            scale=float(np.max(np.abs(exact_radii - INNER))),
        )
        for time in wanted
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    times, radii = inner_radius(runs.first)
    axes.plot(*exact(times[-1], 500), "-", color="black", label="exact")
    axes.plot(times[::4], radii[::4], "o", color="black", mfc="white", markersize=3, label=runs.first.words)
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("inner radius [mm]")
    axes.legend()
    return figure
