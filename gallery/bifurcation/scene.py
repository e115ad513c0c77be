"""Bifurcation: two branches, each with a Windkessel

A vessel forks into two equal branches at 70 degrees. The flow that enters rises to 2 ml/s; behind each branch a Windkessel of
two resistances and a compliance stands for the vessels that follow. It is solved with the step, in both drivers.

Each Windkessel stores what comes in less what has gone on: its equation, integrated from the flow of the run, gives the
pressure that it must have.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo fork.geo"
QUICK = {"time.end": 10}

COMPLIANCE, DISTAL = 5.0, 2.0  # mm^3/kPa, kPa ms/mm^3


def stored(times, flow):
    """Pressure of the compliance in kPa by its equation C p' + p / R = Q, with the flow linear in each step."""
    pressures = [0.0]
    before_time, before = 0.0, 0.0
    for time, now in zip(times, flow):
        for k in range(20):  # steps of the midpoint rule, far finer than the run's
            h = (time - before_time) / 20
            q = before + (now - before) * (k + 0.5) / 20
            p = pressures[-1]
            p = (p * (1 - h / (2 * DISTAL * COMPLIANCE)) + h * q / COMPLIANCE) / (1 + h / (2 * DISTAL * COMPLIANCE))
            pressures[-1] = p
        pressures.append(pressures[-1])
        before_time, before = time, now
    return np.array(pressures[:-1])


def numbers(runs):
    found = []
    for run in runs:
        for name in ("left", "right"):
            opening = run.results.openings[name]
            found.append(
                Number(
                    f"pressure of the Windkessel, {name}",
                    "kPa",
                    run.program,
                    float(opening.windkessel_pressure[-1]) / 1000,
                    float(stored(opening.time, opening.flow)[-1]),
                    0.02,
                    "its equation, with the run's flow",
                )
            )
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style in zip(runs, ("-", "--")):
        openings = run.results.openings
        for name, color in (("inlet", "black"), ("left", "tab:orange"), ("right", "tab:blue")):
            axes.plot(
                openings[name].time,
                openings[name].mean_pressure / 1000,
                style,
                color=color,
                label=f"{name}, {run.words}",
            )
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("mean pressure [kPa]")
    axes.legend()
    return figure
