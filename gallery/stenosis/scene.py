"""Stenosis: shear stress where a vessel narrows

A rigid vessel of 2 mm radius narrows to half of that. Steady flow enters with a parabolic profile, at a Reynolds number of
100. At the throat the shear stress at the wall is many times that of the straight vessel, and behind it the flow turns back
along the wall.

In front of the stenosis the shear stress is Poiseuille's. The force on the whole wall, a sum of the fluid's residuals,
balances what the pressures at both ends press, since as much momentum leaves as enters.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo stenosis.geo --order 2"
QUICK_MESH = "geo stenosis.geo --order 2 --set size=0.5"
DRIVERS = ("fsi-monolithic",)

RADIUS, FLOW, VISCOSITY = 2.0, 1.1, 3.5e-3  # mm, mm^3/ms, kPa ms
POISEUILLE = 4 * VISCOSITY * FLOW / (np.pi * RADIUS**3) * 1000  # Pa


def shear_at_wall(run):
    """z in mm along the wall and the shear stress there in Pa, along the axis."""
    fluid = run.results.fields["fluid"]
    stress = np.asarray(fluid.at(fluid.times[-1], "wall_shear_stress"))
    on_wall = np.flatnonzero(np.any(stress != 0, axis=1))
    order = on_wall[np.argsort(fluid.points[on_wall, 2])]
    size = np.linalg.norm(stress[order], axis=1) * np.sign(stress[order, 2])
    return fluid.points[order, 2], 1000 * size


def numbers(runs):
    run = runs.first
    z, shear = shear_at_wall(run)
    openings = run.results.openings
    drop = float(openings["inlet"].mean_pressure[-1] - openings["outlet"].mean_pressure[-1]) / 1000
    force = float(run.table("surfaces.csv")["force_z_mN"][-1])
    return [
        Number(
            "shear stress 6 mm behind the inlet",
            "Pa",
            run.program,
            float(np.interp(6.0, z, shear)),
            POISEUILLE,
            0.01,
            "Poiseuille's law",
        ),
        Number(
            "force on the wall",
            "mN",
            run.program,
            force,
            drop * np.pi * RADIUS**2,
            0.02,
            "pressures at the ends times their area",
        ),
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    z, shear = shear_at_wall(runs.first)
    axes.plot(z, shear, "-", color="black", label=runs.first.words)
    axes.axhline(POISEUILLE, color="black", linestyle=":", label="Poiseuille, straight vessel")
    axes.set_xlabel("z [mm]")
    axes.set_ylabel("shear stress at the wall [Pa]")
    axes.legend()
    return figure
