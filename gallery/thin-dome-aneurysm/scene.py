"""Thin-dome aneurysm: a wall whose thickness varies

A vessel of 1.5 mm radius bears a spherical aneurysm of 3.5 mm radius on its side. The wall is grown on its lumen by a
table of thicknesses: 0.35 mm on the vessel and at the neck, falling like the cosine of the angle from the top to 0.15
mm there. The mesh is the vessel as it is imaged, under 12 kPa; then a pulse of flow passes, and a Windkessel stands
for the vessels that follow.

Whatever the material and wherever it is thin, a sphere under a pressure p carries p R / 2 along each line of its wall
(Laplace's law), so the stress in the wall is this over its thickness there, and that across it minus half of p on
average. It is read at the top, and on the side, where the wall is nearly twice as thick. Cells of 0.7, 0.5 and 0.35
mm differ from it by 2.9, 0.5 and 0.3 % at the top, and by 4.4, 2.2 and 0.7 % on the side, where it begins to turn
into the neck. The rise of the top in the pulse is the other driver's.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo lumen.geo | thicken --thickness-from thickness.csv --layer wall=100%:2"
QUICK_MESH = "geo lumen.geo --set size=1.0 | thicken --thickness-from thickness.csv --layer wall=100%:2"
QUICK = {"time.end": 4, "output.every": 4}
STILL = {"field": "von_mises_stress", "time": 0.0}

RADIUS, CENTRE = 3.5, (0.0, 0.0, 3.2)  # mm
PRESSURE = 12.0  # kPa
PLACES = {"at the top": (0.0, 0.4), "on the side": (1.2, 1.5)}  # angles from the top


def dome(run):
    """Angle from the top, distance from the centre in mm and stress (von Mises) at rest in kPa, of the wall's nodes."""
    wall = run.results.fields["wall"]
    stress = np.asarray(wall.at(0.0, "von_mises_stress"))
    away = wall.points - np.array(CENTRE)
    distance = np.linalg.norm(away, axis=1)
    return np.arccos(away[:, 2] / distance), distance, stress


def laplace(thickness):
    """kPa: the force p pi R^2 over the section pi ((R + t)^2 - R^2), less the mean of the radial stress, -p / 2."""
    return PRESSURE * RADIUS**2 / ((RADIUS + thickness) ** 2 - RADIUS**2) + PRESSURE / 2


def around(run, low, high):
    """Mean stress in kPa between two angles, over inner, middle and outer nodes alike, and Laplace's with the
    thickness there."""
    angle, distance, stress = dome(run)
    there = (angle >= low) & (angle < high) & (distance > RADIUS - 0.1) & (distance < RADIUS + 0.6)
    outer = distance[there] > np.quantile(distance[there], 2 / 3)  # nodes lie at three depths
    thickness = distance[there][outer] - RADIUS
    return float(stress[there].mean()), float(laplace(thickness).mean())


def rise(run):
    """Times in ms and the displacement of the top outwards in mm."""
    points = run.table("points.csv")
    return points["time_ms"], points["displacement_z_mm"]


def numbers(runs):
    found = []
    allowed = 0.05 if runs.quick else 0.03  # the facets of linear cells of 1 mm, and of 0.5 mm
    for run in runs:
        for place, angles in PLACES.items():
            stress, known = around(run, *angles)
            found.append(Number(f"stress {place}", "kPa", run.program, stress, known, allowed, "Laplace's law"))
    known = float(rise(runs.first)[1].max())
    for run in list(runs)[1:]:
        top = float(rise(run)[1].max())
        found.append(Number("largest rise of the top", "mm", run.program, top, known, 1e-3, "the monolithic driver"))
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    angle, distance, stress = dome(runs.first)
    on_dome = (angle < 1.6) & (distance > RADIUS - 0.1) & (distance < RADIUS + 0.6)
    axes.plot(angle[on_dome], stress[on_dome], ".", color="black", markersize=3, label=runs.first.words)
    angles = np.linspace(0, 1.6, 60)
    exact = laplace(0.15 + 0.2 * (1 - np.cos(angles)) / (1 - np.cos(2.05)))
    axes.plot(angles, exact, "-", color="tab:orange", label="Laplace's law")
    axes.set_xlabel("angle from the top [rad]")
    axes.set_ylabel("stress at rest (von Mises) [kPa]")
    axes.legend()
    return figure
