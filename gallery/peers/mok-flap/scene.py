"""Mok's flap: a flap in a channel that narrows

A flap of 5 by 250 mm (2.3 MPa, Poisson's ratio 0.45, plane stress) stands on the floor of half a channel that narrows
behind it. The flow rises within 10 s, bends the flap, and comes to rest. Steps are of 0.1 s.

Plane stress is plane strain with other constants, exactly for the law of Saint Venant and Kirchhoff. Kratos' flap of
4 by 100 bilinear cells locks in shear, by 10 % of its stiffness (docs/evidence/references.md): with a flap that much stiffer
this program gives Kratos' numbers. Mok's own are 7.8 and 6.0 cm, Valdes' 8.2 and 6.25 cm.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo channel.geo --order 2"
QUICK_MESH = "geo channel.geo --order 2 --set far=100 --set near=40 --set gap=25 --set flap=12"
QUICK = {"time.step": 500.0, "time.end": 10000.0}

PEAK, LAST = 8.35, 6.23  # cm: Kratos
SPREAD = {PEAK: (8.35 - 7.8) / 8.35, LAST: (6.25 - 6.0) / 6.23}  # Mok, Valdes, Kratos
SOURCE = "Kratos Examples of 2022, fsi_mok"
REASON = "the peer's bilinear cells of 1.25 by 2.5 mm lock in shear: its flap is 10 % too stiff, worth 0.55 and 0.42 cm"
MODEL = 0.067


def tip(run):
    """Times in s and displacement along the channel in cm."""
    table = run.table("points.csv")
    return table["time"] / 1000, table["displacement_x"] / 10


def numbers(runs):
    found = []
    for run in runs:
        times, shift = tip(run)
        of = [("largest displacement of the tip", shift.max(), PEAK)]
        if not runs.quick:
            of.append(("displacement of the tip at 25 s", shift[-1], LAST))
        for what, value, known in of:
            words = (what, "cm", run.program, float(value), known, 0.1)
            found.append(Number(*words, SOURCE, spread=SPREAD[known], model=MODEL, reason=REASON))
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        axes.plot(*tip(run), style, color=color, label=run.words)
    for value in (PEAK, LAST):
        axes.axhline(value, color="gray", linestyle=":")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("displacement of the tip [cm]")
    axes.legend()
    return figure
