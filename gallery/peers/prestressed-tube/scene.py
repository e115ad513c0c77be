"""Prestressed tube: svFSI's wall that carries diastole

A wall of 20 mm inner radius, 2 mm thickness and 300 mm length, 400 kPa and Poisson's ratio 0.49, carries 8.0607 kPa
in the shape of its mesh, its ends clamped. There is no fluid. The hoop stress in the middle of the tube is compared,
on the inner and on the outer face.

The peer adds up linear increments of stress on the mesh as it is (Hsu and Bazilevs 2011), which leads towards Lame's
stresses, 84.83 and 76.77 kPa. Here the wall was stretched from the shape that it has without load: an incompressible
neo-Hookean wall of infinite length has 86.73 and 75.27 kPa then, by an integral over the wall. The peer's values are
means over the nodes of a face between 130 and 170 mm, of linear tetrahedra, where they scatter by 3.6 kPa.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo tube.geo --order 2"
QUICK_MESH = "geo tube.geo --order 2 --set through=2 --set along=60"

FACES = {"inside": (20.0, 85.666, 86.731), "outside": (22.0, 76.451, 75.267)}  # radius in mm; kPa: peer, finite strain
SOURCE = "svFSI-Tests of 2022, 07-fsi/ale/04-pipe_prestress"
MODEL = 0.016  # by which finite strain differs from the peer, 1.3 and 1.6 %
REASON = "it adds up increments on the mesh, as Lame, 84.8 and 76.8; a wall stretched from its own shape has 86.7, 75.3"


def hoop(run, radius):
    """The hoop stress in kPa in the middle of the tube."""
    wall = run.results.fields["wall"]
    points = wall.points
    stress = np.asarray(wall.at(wall.times[-1], "cauchy_stress"))
    node = np.argmin(np.hypot(np.hypot(points[:, 0], points[:, 1]) - radius, points[:, 2] - 150))
    return float(stress[node, 3])  # xx, xy, xz, yy, yz, zz; y is the hoop


def numbers(runs):
    found = []
    for run in runs:
        for face, (radius, peer, exact) in FACES.items():
            words = (f"hoop stress {face}", "kPa", run.program, hoop(run, radius))
            found.append(Number(*words, peer, 0.02, SOURCE, model=MODEL, reason=REASON))
            if runs.quick:
                found.append(Number(*words, exact, 1e-3, "an integral over an incompressible wall"))
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    radii = [radius for radius, _, _ in FACES.values()]
    axes.plot(radii, [peer for _, peer, _ in FACES.values()], "s-", color="gray", label="svFSI")
    axes.plot(
        radii, [exact for _, _, exact in FACES.values()], "-", color="black", label="finite strain, incompressible"
    )
    for run, mark in zip(runs, "ox"):
        axes.plot(radii, [hoop(run, radius) for radius in radii], mark, color="black", mfc="white", label=run.words)
    axes.set_xlabel("radius [mm]")
    axes.set_ylabel("hoop stress [kPa]")
    axes.legend()
    return figure
