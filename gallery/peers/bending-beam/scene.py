"""Bending plate: svFSI's beam of quadratic tetrahedra

A plate of 5 by 2.5 by 0.5 m, 2.1e11 Pa and Poisson's ratio 0.3, is held at one end and sheared down at the other by
105.5 MPa. Strains are small in its law, so that the tip's displacement of 0.98 m is linear in the load. There is no
fluid.

Euler's and Bernoulli's beam has 1.005 m: the clamped end keeps the plate from narrowing. The peer's number is the
mean over the nodes of its end face; here it is the mean over those of this mesh.

The peer's load rises within 100 steps of generalised-alpha. Its equation holds at two thirds of a step, with the load
of the step's end: the displacement runs a third of a step ahead of the load.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo beam.geo --order 2 --set along=24 --set wide=12 --set thick=3"
QUICK_MESH = "geo beam.geo --order 2 --set along=8 --set wide=4 --set thick=1"

PEER = -0.979818  # m
SOURCE = "svFSI-Tests of 2022, 02-lelas, tet10, 12 cells"
MODEL = 1 / 300  # a third of a step of its ramp
REASON = "its load is that of the end of a step, its balance within it: a third of one of 100 steps ahead, 0.33 %"


def sinking(run):
    """Of the end face in m: the mean over its nodes."""
    wall = run.results.fields["wall"]
    points = wall.points
    shift = np.asarray(wall.at(wall.times[-1], "displacement"))
    return float(shift[points[:, 0] > 5000 - 1e-6, 2].mean()) / 1000


def numbers(runs):
    tolerance = 0.03 if runs.quick else 0.005
    return [
        Number(
            "mean displacement of the end",
            "m",
            run.program,
            sinking(run),
            PEER,
            tolerance,
            SOURCE,
            model=MODEL,
            reason=REASON,
        )
        for run in runs
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, mark in zip(runs, "ox"):
        wall = run.results.fields["wall"]
        shift = np.asarray(wall.at(wall.times[-1], "displacement"))
        line = np.flatnonzero(np.hypot(wall.points[:, 1] - 1250, wall.points[:, 2]) < 1e-6)
        line = line[np.argsort(wall.points[line, 0])]
        axes.plot(wall.points[line, 0] / 1000, shift[line, 2] / 1000, mark, color="black", mfc="white", label=run.words)
    axes.axhline(PEER, color="gray", linestyle=":", label="svFSI, end")
    axes.set_xlabel("along the plate [m]")
    axes.set_ylabel("displacement [m]")
    axes.legend()
    return figure
