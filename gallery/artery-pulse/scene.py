"""Artery pulse: the scene of the paper

The rabbit carotid artery of Langer's and Yang's study: 18 mm of a vessel of two layers. A pressure of 1.332 kPa acts at its
inlet for an eighth of a millisecond, and a wave runs down the tube with about 0.6 mm/ms.

What is known comes from a separate code with other elements, converged in space and time to half a percent of the
displacement. The paper's own linear elements with backward Euler leave several times the error that is left here.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "artery --for p2p1 --axisymmetric --error 3% --waves resolved"
QUICK_MESH = "artery --for p2p1 --axisymmetric --error 5%"
QUICK = {"time.step": 0.0625, "time.end": 3}

KNOWN = {1.5: 0.0924, 3.0: 0.0875, 6.0: 0.0738}  # ms, mm: largest radial displacement of the inner wall


def wave(run, time):
    """z and radial displacement in mm at the level nearest to a time in ms."""
    table = run.table("wall_displacement.csv")
    times = table["time_ms"]
    at = times == times[np.abs(times - time).argmin()]
    return table["z_mm"][at], table["radial_mm"][at]


def numbers(runs):
    return [
        Number(
            f"largest radial displacement at {time:g} ms",
            "mm",
            run.program,
            float(wave(run, time)[1].max()),
            known,
            0.15 if runs.quick else 0.03,
            "a separate code, converged",
        )
        for run in runs
        for time, known in KNOWN.items()
        if time <= 3 or not runs.quick
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style in zip(runs, ("-", "--")):
        for time, color in ((1.5, "black"), (3.0, "tab:orange"), (6.0, "tab:blue")):
            z, radial = wave(run, time)
            axes.plot(z, radial, style, color=color, label=f"{time:g} ms, {run.words}")
    axes.set_xlabel("z [mm]")
    axes.set_ylabel("radial displacement [mm]")
    axes.legend()
    return figure
