"""Static tube: an artery's wall under pressure, at finite strain

A long tube of two neo-Hookean layers is held at its ends and pressed from within, up to 0.4 kPa. Incompressibility leaves
the inner radius as the one unknown, so pressure and radius are tied by an integral over the wall, which is exact at any
strain.

There is no time and no fluid in it: the case has a load in steps, and one driver.
"""

import numpy as np
from matplotlib.figure import Figure

from known_solutions.layered_tube import holding_pressure, place
from fsi_compare.gallery.scene import Number

MESH = "geo tube.geo --order 2"
DRIVERS = ("fsi-monolithic",)

INNER = 1.43  # mm
LAYERS = ((1.43, 1.69, 3.0), (1.69, 1.82, 0.3))  # radii at rest in mm, shear modulus in kPa
POINTS = {"inner wall": 1.43, "media": 1.56, "adventitia": 1.75, "outer": 1.82}  # mm


def exact_radius(load):
    """By bisection."""
    low, high = INNER, 3 * INNER
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if holding_pressure(LAYERS, middle) < load else (low, middle)
    return (low + high) / 2


def known_curve(name, times):
    """The wall's displacement outwards, mm, at the inner wall and at the points whose radii at rest are in POINTS."""
    point, _, what = name.partition(": ")
    if what not in ("radial", "displacement x") or point not in POINTS:
        return None
    inner = np.array([exact_radius(0.4 * time) for time in times])
    return place(POINTS[point], INNER, inner) - POINTS[point]


def inner_radius(run):
    """Pressures in kPa and radii in mm. The time of a static case is the load's fraction."""
    table = run.table("wall_displacement.csv")
    at = table["z_mm"] == table["z_mm"].min()
    return 0.4 * table["time_ms"][at], INNER + table["radial_mm"][at]


def numbers(runs):
    loads, radii = inner_radius(runs.first)
    return [
        Number(
            f"inner radius under {load:.1f} kPa",
            "mm",
            runs.first.program,
            float(radii[np.abs(loads - load).argmin()]),
            exact_radius(load),
            1e-5,
            "integral over the wall",
        )
        for load in (0.2, 0.4)
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    loads, radii = inner_radius(runs.first)
    line = np.linspace(INNER, radii[-1], 60)
    axes.plot(line, [holding_pressure(LAYERS, radius) for radius in line], "-", color="black", label="exact")
    axes.plot(radii, loads, "o", color="black", mfc="white", label=runs.first.words)
    axes.set_xlabel("inner radius [mm]")
    axes.set_ylabel("pressure [kPa]")
    axes.legend()
    return figure
