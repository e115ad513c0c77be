"""Womersley flow: a rigid pipe with a flow that swings

The flow in a pipe of 2 mm radius swings with 5 ml/s and a period of 200 ms: Womersley's number is 3.0. Its profile at the
inlet is the exact one, by Bessel functions, so that the flow is developed everywhere, from the first period's transient on.

The swing of the pressure gradient and that of the shear stress at the wall follow from the same Bessel functions.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = (
    "artery --axisymmetric --order 2 --inner-radius 2 --media 0.2 --adventitia 0 --length 40 --lumen-cells 8 "
    "--lumen-grading 3 --axial-cells 30"
)
DRIVERS = ("fsi-monolithic",)
QUICK = {"time.end": 400}

RADIUS, PERIOD, FLOW = 2.0, 200.0, 5.0  # mm, ms, mm^3/ms
DENSITY, VISCOSITY = 1.0, 1.4e-2  # mg/mm^3, kPa ms
OMEGA = 2 * np.pi / PERIOD
LAMBDA = np.sqrt(-1j * OMEGA * DENSITY / VISCOSITY) * RADIUS


def bessel(order, z):
    """J of order 0 or 1, by its power series."""
    term = (z / 2) ** order
    total = term
    for k in range(1, 60):
        term = term * -(z**2) / 4 / (k * (k + order))
        total = total + term
    return total


# Amplitudes of -dp/dz in kPa/mm and of the shear stress at the wall in kPa, for a flow FLOW cos(omega t).
SHARE = 1 - 2 * bessel(1, LAMBDA) / (LAMBDA * bessel(0, LAMBDA))
GRADIENT = FLOW * 1j * OMEGA * DENSITY / (np.pi * RADIUS**2 * SHARE)
SHEAR = GRADIENT * RADIUS / LAMBDA * bessel(1, LAMBDA) / bessel(0, LAMBDA)


def gradient(run):
    """Times and -dp/dz in Pa/mm, from the pressures at two points of the axis."""
    points = run.table("points.csv").groups("point")
    return points["before"]["time"], (points["before"]["pressure"] - points["behind"]["pressure"]) / 8


def numbers(runs):
    run = runs.first
    times, found = gradient(run)
    last = times > times[-1] - PERIOD + 1e-6
    amplitude = 2 * np.mean(found[last] * np.exp(-1j * OMEGA * times[last]))
    fluid = run.results.fields["fluid"]
    stress = np.asarray(fluid.at(times[-1], "wall_shear_stress"))
    points = fluid.points
    middle = np.argmin(np.hypot(np.hypot(points[:, 0], points[:, 1]) - RADIUS, points[:, 2] - 10))
    return [
        Number(
            "pressure gradient, amplitude",
            "Pa/mm",
            run.program,
            abs(amplitude),
            1000 * abs(GRADIENT),
            0.01,
            "Bessel functions",
        ),
        Number(
            "pressure gradient, lead before the flow",
            "degrees",
            run.program,
            float(np.degrees(np.angle(amplitude))),
            float(np.degrees(np.angle(GRADIENT))),
            0.01,
            "Bessel functions",
            scale=90,
        ),
        Number(
            "shear stress at the wall, at the largest flow",
            "Pa",
            run.program,
            1000 * abs(float(stress[middle, 2])),
            1000 * abs(SHEAR.real),
            0.02,
            "Bessel functions",
        ),
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    times, found = gradient(runs.first)
    fine = np.linspace(0, times[-1], 400)
    axes.plot(fine, 1000 * (GRADIENT * np.exp(1j * OMEGA * fine)).real, "-", color="black", label="exact")
    axes.plot(times[::4], found[::4], "o", color="black", mfc="white", markersize=4, label=runs.first.words)
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("pressure gradient [Pa/mm]")
    axes.legend(loc="upper right")
    return figure
