"""Casson stenosis: blood with a yield stress where a vessel narrows

The vessel of the scene "Stenosis", with slow blood whose shear stress tau follows Casson's law,
sqrt(tau) = sqrt(tau_y) + sqrt(mu_p g), with a yield stress of 5 mPa, regularised below a shear rate of about 0.1/s.
Where the vessel is straight it takes 1.48 times the pressure that the plastic viscosity mu_p alone would take; at the
throat, where the shear rate is many times larger, far less.

In front of the stenosis flow and pressure gradient are those of Casson's pipe flow, which has a closed form; so has
the shear stress at the wall. The force on the whole wall balances what the pressures at both ends press. The picture has
the profile of the velocity there beside the exact one, and the shear stress along the wall.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo ../stenosis/stenosis.geo --order 2"
QUICK_MESH = "geo ../stenosis/stenosis.geo --order 2 --set size=0.5"
QUICK = {"time.step": 300}
DRIVERS = ("fsi-monolithic",)

RADIUS, FLOW = 2.0, 0.25  # mm, mm^3/ms
YIELD, PLASTIC = 5e-6, 3.5e-3  # kPa, kPa ms


def flow_of(stress):
    """Through a pipe whose wall bears this shear stress in kPa, x = yield stress / shear stress (the integral of r^2
    g / 2 over the radius, as Buckingham's for Bingham's law):
    Q = pi R^3 tau / (4 mu) (1 - 16/7 x^(1/2) + 4/3 x - x^4/21)."""
    x = YIELD / stress
    return np.pi * RADIUS**3 * stress / (4 * PLASTIC) * (1 - 16 / 7 * np.sqrt(x) + 4 / 3 * x - x**4 / 21)


def exact_stress():
    """At the wall in kPa, by bisection."""
    low, high = YIELD, 1.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if flow_of(middle) < FLOW else (low, middle)
    return high


def poiseuille():
    """Shear stress in kPa with the plastic viscosity alone."""
    return 4 * PLASTIC * FLOW / (np.pi * RADIUS**3)


def shear_at_wall(run):
    """z in mm along the wall and the shear stress there in Pa, along the axis."""
    fluid = run.results.fields["fluid"]
    stress = np.asarray(fluid.at(fluid.times[-1], "wall_shear_stress"))
    on_wall = np.flatnonzero(np.any(stress != 0, axis=1))
    order = on_wall[np.argsort(fluid.points[on_wall, 2])]
    size = np.linalg.norm(stress[order], axis=1) * np.sign(stress[order, 2])
    return fluid.points[order, 2], 1000 * size


def exact_velocity(r):
    """Axial, in mm/ms, at the radius r in mm of the straight vessel, tau = tau_w r / R. Where tau exceeds the yield stress,
    mu du/dr = -(sqrt(tau) - sqrt(tau_y))^2; so with s = max(r, R tau_y / tau_w)
    u = 1/mu (tau_w (R^2 - s^2) / (2 R) - 4/3 sqrt(tau_y tau_w / R) (R^(3/2) - s^(3/2)) + tau_y (R - s))."""
    wall = exact_stress()
    s = np.maximum(r, RADIUS * YIELD / wall)
    return (
        wall * (RADIUS**2 - s**2) / (2 * RADIUS)
        - 4 / 3 * np.sqrt(YIELD * wall / RADIUS) * (RADIUS**1.5 - s**1.5)
        + YIELD * (RADIUS - s)
    ) / PLASTIC


def velocity_across(run, z=9.0, near=0.2):
    """Radii in mm and axial velocity in mm/ms at the nodes about a cross-section."""
    fluid = run.results.fields["fluid"]
    there = np.abs(fluid.points[:, 2] - z) < near
    velocity = np.asarray(fluid.at(fluid.times[-1], "velocity"))
    return np.hypot(fluid.points[there, 0], fluid.points[there, 1]), velocity[there, 2]


def drop(run):
    """Of the pressure between the two planes in Pa."""
    planes = run.table("planes.csv").groups("plane")
    return float(planes["before"]["pressure"][-1] - planes["behind"]["pressure"][-1])


def numbers(runs):
    run = runs.first
    z, shear = shear_at_wall(run)
    openings = run.results.openings
    whole = float(openings["inlet"].mean_pressure[-1] - openings["outlet"].mean_pressure[-1]) / 1000
    force = float(run.table("surfaces.csv")["force_z_mN"][-1])
    stress = 1000 * exact_stress()
    exact = "Casson's pipe flow"
    return [
        Number("pressure drop from 6 to 12 mm", "Pa", run.program, drop(run), 2 * stress / RADIUS * 6.0, 0.003, exact),
        Number(
            "shear stress 9 mm behind the inlet",
            "Pa",
            run.program,
            float(np.interp(9.0, z, shear)),
            stress,
            0.003,
            exact,
        ),
        Number(
            "force on the wall",
            "mN",
            run.program,
            force,
            whole * np.pi * RADIUS**2,
            0.003,
            "pressures at the ends times their area",
        ),
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    across, axes = figure.subplots(1, 2, width_ratios=(2, 3))
    r = np.linspace(0, RADIUS, 101)
    across.plot(*velocity_across(runs.first), ".", color="black", label=runs.first.words)
    across.plot(r, exact_velocity(r), "-", color="tab:orange", label="Casson, exact")
    across.plot(
        r,
        2 * FLOW / (np.pi * RADIUS**2) * (1 - (r / RADIUS) ** 2),
        "--",
        color="tab:gray",
        label="without yield stress",
    )
    across.set_xlabel("r, 9 mm behind the inlet [mm]")
    across.set_ylabel("axial velocity [mm/ms]")
    across.set_ylim(bottom=0)
    across.legend(fontsize="small")
    z, shear = shear_at_wall(runs.first)
    axes.plot(z, shear, "-", color="black", label=runs.first.words)
    axes.axhline(1000 * exact_stress(), color="tab:orange", label="Casson, straight vessel")
    axes.axhline(1000 * poiseuille(), color="tab:gray", linestyle="--", label="without yield stress")
    axes.set_xlabel("z [mm]")
    axes.set_ylabel("shear stress at the wall [Pa]")
    axes.legend(fontsize="small")
    return figure
