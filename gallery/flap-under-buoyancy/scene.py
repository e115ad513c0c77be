"""Flap under buoyancy: what fixes the modulus of an experiment

A silicone flap of 11 by 2 by 65 mm, held at one end, floats up in a heavier liquid at rest (Hessenthaler et al. 2017, phase I): its tip
was seen 29.50 mm above where it is held. Silicone goes on curing, so that this deflection tells its stiffness at the time of the
experiment, and tests on other days do not.

A neo-Hookean flap that keeps its volume needs a shear modulus of 60.6 kPa. Others found 61 kPa, and, with Poisson's ratio 0.45,
63.9 kPa. `flap-in-merging-jets` has the same flap in the flow of the experiment.
"""

from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo flap.geo --order 2"
QUICK_MESH = "geo flap.geo --order 2 --set wide=2 --set thick=1 --set along=14"
QUICK = {"static.load_steps": 6}

MEASURED = 29.50  # mm


def tip(run):
    """Parts of the load, and the tip's height and place along the flap's axis in mm."""
    points = run.table("points.csv")
    return points["time_ms"], points["displacement_y_mm"], 65 + points["displacement_z_mm"]


def numbers(runs):
    tolerance = 0.03 if runs.quick else 0.006
    source = "measured; it fixes the modulus"
    return [
        Number("height of the tip", "mm", run.program, float(tip(run)[1][-1]), MEASURED, tolerance, source)
        for run in runs
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        parts, height, along = tip(run)
        axes.plot(along, height, style, color=color, marker="o", mfc="white", label=run.words)
    axes.axhline(MEASURED, color="gray", linestyle=":", label="measured, whole load")
    axes.set_xlabel("tip along the flap's axis [mm]")
    axes.set_ylabel("height of the tip [mm]")
    axes.legend()
    return figure
