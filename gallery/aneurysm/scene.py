"""Aneurysm: a bulge whose wall is held by tissue

A vessel of 2 mm radius widens to 4 mm. Up to 3 ml/s flow through it within 20 ms; springs and dampers on the outer
face stand for the tissue around, a resistance for the vessels that follow.

No closed form is known. The two drivers solve the same equations by different ways, so each is the other's reference.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo aneurysm.geo --order 2"
QUICK_MESH = "geo aneurysm.geo --order 2 --set size=0.8"
QUICK = {"time.step": 0.5, "time.end": 15}


def widening(run):
    """Times in ms and the radial displacement of the bulge in mm."""
    points = run.table("points.csv")
    return points["time_ms"], points["displacement_x_mm"]


def numbers(runs):
    known = float(widening(runs.first)[1].max())
    return [
        Number(
            "largest widening of the bulge",
            "mm",
            run.program,
            float(widening(run)[1].max()),
            known,
            1e-3,
            "the monolithic driver",
        )
        for run in list(runs)[1:]
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        axes.plot(*widening(run), style, color=color, label=run.words)
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("radial displacement of the bulge [mm]")
    axes.legend()
    return figure
