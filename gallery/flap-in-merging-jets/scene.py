"""Flap in merging jets: an experiment

Two pipes of 21.9 mm let a liquid of 1163.3 kg/m^3 and 12.5 mPa s into a tube of 76.2 mm, at most 630 and 615 mm/s. Between them a
silicone flap of 11 by 2 by 65 mm is held; it is lighter than the liquid and floats up, and the upper jet pushes it down again
(Hessenthaler et al. 2017, phase I). Its modulus is about that of the scene `flap-under-buoyancy`.

Its tip was measured at 16.41 mm by magnetic resonance, whose voxels are 0.98 mm wide. Others computed 16.54, 16.66 and 17.02 mm.

The published surface of the vessel is not in this repository. Pipes, flap and their places are as published. Between the pipes'
ends and the tube, the section is taken for an ellipse that becomes a circle within 40 mm: the places at which velocities were measured
10 and 30 mm behind the pipes leave its half width 24.4 to 25.3 and 33.1 to 35 mm there. The ellipse is 0.9 mm higher than the pipes, so that no
cells are flat. The tube ends free of traction 240 mm behind the pipes, 340 mm with others. Whoever has the surface puts it in its
place by `fsi-mesh import` or `fsi-mesh lumen`.
"""

from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo jets.geo --order 2"
QUICK_MESH = "geo jets.geo --order 2 --set near=8 --set pipes=9 --set jets=14 --set far=28"
QUICK = {"time.end": 120}
LONG = True

MEASURED = 16.41  # mm
OTHERS = (16.54, 17.02)  # mm
SETTLED = 1600.0  # ms


def tip(run):
    """Times in s and the tip's height in mm."""
    points = run.table("points.csv")
    return points["time_ms"] / 1000, points["displacement_y_mm"]


def numbers(runs):
    if runs.quick:
        first = float(tip(runs.first)[1][-1])
        return [
            Number("height of the tip", "mm", run.program, float(tip(run)[1][-1]), first, 1e-3, "the other driver")
            for run in runs
        ]
    found = []
    for run in runs:
        times, heights = tip(run)
        mean = float(heights[times > SETTLED / 1000].mean())
        spread = (OTHERS[1] - OTHERS[0]) / MEASURED
        found.append(Number("height of the tip", "mm", run.program, mean, MEASURED, 0.06, "measured", spread=spread))
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        axes.plot(*tip(run), style, color=color, label=run.words)
    axes.axhline(MEASURED, color="black", linestyle=":", label="measured")
    axes.axhspan(*OTHERS, color="0.85", label="computed by others")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("height of the tip [mm]")
    axes.legend()
    return figure
