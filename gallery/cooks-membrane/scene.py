"""Cook's membrane: bending and shear without locking

A tapered panel in plane strain is clamped at its left side and sheared upwards at its right side, so far that its tip rises
by 14 % of its height. The material is nearly incompressible: the ratio of bulk and shear modulus is 500.

Elements that lock stop at 2.3 to 4.7 mm. The quadratic element with linear pressure finds the tip on sixteen cells a side.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo membrane.geo --order 2 --set cells=16"
QUICK_MESH = "geo membrane.geo --order 2 --set cells=8"
DRIVERS = ("fsi-monolithic",)

TIP = 6.891  # mm: OpenGeoSys, 30 F-bar elements a side


def rise(run):
    """Parts of the load and the tip's displacement in mm."""
    points = run.table("points.csv")
    return points["time_ms"], points["displacement_y_mm"]


def numbers(runs):
    return [
        Number(
            "rise of the tip",
            "mm",
            runs.first.program,
            float(rise(runs.first)[1][-1]),
            TIP,
            0.012 if runs.quick else 0.003,
            "30 F-bar elements a side",
        )
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    parts, heights = rise(runs.first)
    axes.plot(
        np.append(0, heights), 6.25 * np.append(0, parts), "-o", color="black", mfc="white", label=runs.first.words
    )
    axes.axvline(TIP, color="black", linestyle=":", label="published, whole load")
    axes.set_xlabel("rise of the tip [mm]")
    axes.set_ylabel("shear traction [MPa]")
    axes.legend()
    return figure
