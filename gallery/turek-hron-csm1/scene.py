"""Turek-Hron CSM1: an elastic flag under its weight

The flag of Turek's and Hron's benchmark, 350 mm long and 20 mm thick, hangs from the rigid cylinder and bends under gravity
by a fifth of its length. Its material is Saint Venant's and Kirchhoff's. There is no fluid.

All scenes of the benchmark share one mesh: volumes and surfaces that a case does not name are left out.
"""

from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo ../turek-hron-cfd1/channel.geo --order 2"
DRIVERS = ("fsi-monolithic",)

TIP = (-7.187, -66.10)  # mm, of the benchmark


def tip(run):
    points = run.table("points.csv")
    return points["time_ms"], points["displacement_x_mm"], points["displacement_y_mm"]


def numbers(runs):
    _, x, y = tip(runs.first)
    return [
        Number(f"tip's {name}", "mm", runs.first.program, float(value[-1]), known, 5e-3, "Turek and Hron 2006")
        for name, value, known in (("u_x", x, TIP[0]), ("u_y", y, TIP[1]))
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    _, x, y = tip(runs.first)
    axes.plot([0, *x], [0, *y], "-o", color="black", mfc="white", label="tip, load by load")
    axes.plot(*TIP, "x", color="black", markersize=10, label="benchmark")
    axes.set_xlabel("u_x [mm]")
    axes.set_ylabel("u_y [mm]")
    axes.legend()
    return figure
