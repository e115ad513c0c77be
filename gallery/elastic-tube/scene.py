"""Elastic tube: the benchmark of codes for blood vessels

A tube of 5 mm radius, 1 mm wall and 50 mm length, clamped at both ends, gets 1.3332 kPa at its inlet for 3 ms. The wave that
follows widens it in its middle to 0.1585 mm, the converged value of published runs; backward Euler with 0.1 ms, which most
of them use, stops at 0.121 mm.

The material is Saint Venant's and Kirchhoff's with Poisson's ratio 0.3. The scene is axisymmetric and runs in seconds.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.studies.gallery.scene import Number

MESH = "geo tube.geo --order 2"
QUICK_MESH = "geo tube.geo --order 2 --set along=25 --set across=3 --set through=1"
QUICK = {"time.step": 0.125, "time.end": 8}

CONVERGED, EULER = 0.1585, 0.121  # mm


def middle(run):
    """Times in ms and radial displacement at half of the length, in mm."""
    table = run.table("wall_displacement.csv")
    z = table["z_mm"]
    at = z == z[np.abs(z - 25).argmin()]
    return table["time_ms"][at], table["radial_mm"][at]


def numbers(runs):
    return [
        Number(
            "largest radial displacement in the middle",
            "mm",
            run.program,
            float(middle(run)[1].max()),
            CONVERGED,
            0.12 if runs.quick else 0.02,
            "published, converged",
        )
        for run in runs
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        axes.plot(*middle(run), style, color=color, label=run.program)
    axes.axhline(CONVERGED, color="black", linestyle=":", label="published peak, converged")
    axes.axhline(EULER, color="gray", linestyle="-.", label="published peak, backward Euler, 0.1 ms")
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("radial displacement in the middle [mm]")
    axes.legend()
    return figure
