"""Artery segment: ambit's quarter, incompressible

A piece of an artery, 10 mm inner radius, 1 mm thick, 5 mm long, with a shear modulus of 100 kPa, slides between two
planes, and the openings with it. The same small pressure acts at both, 0.05 kPa (1 - cos pi t/2 s). The radial
displacement of the inner face after 100 ms is 1.77e-4 mm.

The peer meshes a quarter with quadratic hexahedra and steps of 20 ms; here the section is turned about the axis. At
100 ms the fluid has long come to rest, so that the displacement is that of a thick tube under the pressure: p/(2 mu R
(1/R^2 - 1/R_o^2)), 1.7735e-4 mm.
"""

from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo segment.geo --order 2"
QUICK_MESH = "geo segment.geo --order 2 --set across=3 --set along=2"

PEER = 2**0.5 * 1.2538882  # 1e-4 mm: of both components at 45 degrees
PRESSURE = 6.15582970e-4  # kPa at 100 ms
EXACT = 1e4 * PRESSURE / (2 * 100 * 10 * (1 / 10**2 - 1 / 11**2))  # 1e-4 mm, an incompressible tube in plane strain
REASON = "nothing: a thick tube has 1.7735"
SOURCE = "ambit 2026.1, test_fsi_taylorhood_artseg_fluidgov_neumann_neumann"


def radial(run):
    """Times in ms and displacement in 1e-4 mm."""
    table = run.table("points.csv")
    return table["time"], 1e4 * table["displacement_x"]


def numbers(runs):
    found = []
    for run in runs:
        words = ("radial displacement at 100 ms", "1e-4 mm", run.program, float(radial(run)[1][-1]))
        found.append(Number(*words, PEER, 1e-3, SOURCE, reason=REASON))
        if runs.quick:
            found.append(Number(*words, EXACT, 1e-3, "a thick tube in plane strain"))
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        axes.plot(*radial(run), style, color=color, label=run.words)
    axes.plot(100, PEER, "o", color="black", mfc="white", label="ambit")
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("radial displacement [1e-4 mm]")
    axes.legend()
    return figure
