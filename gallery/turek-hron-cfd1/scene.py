"""Turek-Hron CFD1: flow around a cylinder with a rigid flag

A channel of 410 mm height with a parabolic inflow of 0.2 m/s on average; the cylinder stands a little below its middle, which
makes a lift. The Reynolds number is 20 and the flow steady, so time steps are large and of first order.

Drag and lift are the sums of the fluid's own residuals over the surface, which are far more accurate than integrals of
stresses. All scenes of the benchmark share one mesh; this case has no structure, so the flag is a rigid obstacle.
"""

from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo channel.geo --order 2"
DRIVERS = ("fsi-monolithic",)

DRAG, LIFT = 14.29, 1.119  # N/m, of the benchmark


def numbers(runs):
    table = runs.first.table("surfaces.csv")
    program, source = runs.first.program, "Turek and Hron 2006"
    return [
        Number("drag", "N/m", program, float(table["force_x_mN"][-1]), DRAG, 5e-3, source),
        Number("lift", "N/m", program, float(table["force_y_mN"][-1]), LIFT, 5e-3, source, scale=DRAG),
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    table = runs.first.table("surfaces.csv")
    seconds = table["time_ms"] / 1000
    axes.plot(seconds, table["force_x_mN"], "-o", color="black", mfc="white", label="drag")
    axes.plot(seconds, 10 * table["force_y_mN"], "--s", color="tab:orange", mfc="white", label="lift, ten times")
    for value, what in ((DRAG, "benchmark"), (10 * LIFT, None)):
        axes.axhline(value, color="black", linestyle=":", label=what)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("force [N/m]")
    axes.legend()
    return figure
