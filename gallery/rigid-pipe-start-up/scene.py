"""Rigid pipe: the flow starts when a pressure is put on

A pipe of 2 mm radius and 40 mm length is at rest; from the first moment on 4 Pa press at its inlet. Boundary layers grow
from the wall until the flow is Poiseuille's. There is no wall in the case file, so nothing of a wall is computed.

The flow follows from a series of Bessel functions. What the two open ends do to it, where the profile is free, is the
difference that is left.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "artery --axisymmetric --order 2 --inner-radius 2 --media 0.2 --adventitia 0 --length 40 --lumen-cells 6 --lumen-grading 3 --axial-cells 20"
DRIVERS = ("fsi-monolithic",)
QUICK = {"time.end": 20, "time.step": 1}

RADIUS, LENGTH = 2.0, 40.0  # mm
DENSITY, VISCOSITY, PRESSURE = 1.0, 0.035, 4e-3  # mg/mm^3, kPa ms, kPa
ZEROS_OF_J0 = (2.404825557695773, 5.520078110286311, 8.653727912911013, 11.791534439014281, 14.930917708487787)


def exact_flow(time):
    """mm^3/ms: Poiseuille's flow less what has not come yet, 1 - sum 32 / l^4 exp(-l^2 nu t / R^2)."""
    share = 1.0
    for zero in ZEROS_OF_J0:
        share = share - 32 / zero**4 * np.exp(-(zero**2) * VISCOSITY / DENSITY * time / RADIUS**2)
    return share * np.pi * RADIUS**4 / (8 * VISCOSITY) * PRESSURE / LENGTH


def numbers(runs):
    flow = runs.first.table("flow.csv")
    return [
        Number(
            f"flow at {time:g} ms",
            "mm^3/ms",
            runs.first.program,
            float(flow["outlet_flow_mm3_per_ms"][np.abs(flow["time_ms"] - time).argmin()]),
            float(exact_flow(time)),
            0.005,
            "series of Bessel functions",
        )
        for time in ((10, 20) if runs.quick else (10, 20, 60))
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    flow = runs.first.table("flow.csv")
    times = flow["time_ms"]
    axes.plot(times, exact_flow(times), "-", color="black", label="exact")
    axes.plot(
        times[::5],
        flow["outlet_flow_mm3_per_ms"][::5],
        "o",
        color="black",
        mfc="white",
        markersize=4,
        label=runs.first.words,
    )
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("flow [mm³/ms]")
    axes.legend()
    return figure
