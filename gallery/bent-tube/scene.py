"""Bent tube: a flow that is given, around a bend

A quarter of a torus with an elastic wall. The flow at its inlet is given, with a parabolic profile, and rises within 4 ms to
1.5 ml/s; a resistance stands for what is behind the outlet. The pressure that it gives back is known once the flow is steady.

The flow through a plane across the middle of the bend is what enters, less what the wall makes room for. The centre line of
such a tube is found by the program.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo bend.geo"
QUICK = {"time.step": 0.5}

RESISTANCE = 0.2  # kPa ms/mm^3


def numbers(runs):
    found = []
    first = runs.first.results.openings["outlet"].flow[-1]
    for run in runs:
        openings = run.results.openings
        flow, pressure = float(openings["outlet"].flow[-1]), float(openings["outlet"].mean_pressure[-1]) / 1000
        found.append(
            Number(
                "mean pressure at the outlet",
                "kPa",
                run.program,
                pressure,
                RESISTANCE * flow,
                0.02,
                "resistance times flow",
            )
        )
        found.append(Number("flow at the outlet", "mm^3/ms", run.program, flow, first, 1e-4, "the other driver"))
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style in zip(runs, ("-", "--")):
        openings = run.results.openings
        for name, color, sign in (("inlet", "black", -1), ("outlet", "tab:orange", 1)):
            axes.plot(openings[name].time, sign * openings[name].flow, style, color=color, label=f"{name}, {run.words}")
    plane = runs.first.table("planes.csv")
    axes.plot(plane["time"], plane["flow"], ":", color="tab:blue", label=f"middle, {runs.first.words}")
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("flow [mm³/ms]")
    axes.legend()
    return figure
