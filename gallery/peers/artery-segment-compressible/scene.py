"""Artery segment, compressible: ambit's quarter of linear elements

The segment of ambit's other test, with a bulk modulus of 500 kPa: Poisson's ratio is 0.406. The peer's linear
tetrahedra and its trapezoidal rule stop at 1.4136e-4 and 1.4219e-4 mm in two directions that should be the same.

A thick compressible tube in plane strain has p R (1 + nu)/E ((1 - 2 nu) R^2 + R_o^2)/(R_o^2 - R^2), 2.048e-4 mm.
"""

from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo ../artery-segment/segment.geo --order 2"
QUICK_MESH = "geo ../artery-segment/segment.geo --order 2 --set across=3 --set along=2"

PEER = (1.4135667**2 + 1.4218660**2) ** 0.5  # 1e-4 mm, by its components at 45 degrees
PRESSURE = 6.15582970e-4  # kPa at 100 ms
YOUNG, POISSON = 281.25, 0.40625  # kPa; of 100 kPa of shear and 500 kPa of bulk modulus
EXACT = 1e4 * PRESSURE * 10 * (1 + POISSON) / YOUNG * ((1 - 2 * POISSON) * 100 + 121) / 21  # 1e-4 mm
SOURCE = "ambit 2026.1, test_fsi_p1p1_artseg_fluidgov_neumann_neumann"
REASON = "the peer's linear tetrahedra: its components differ by 0.6 %, and a thick tube has 2.048e-4 mm"


def radial(run):
    """Times in ms and displacement in 1e-4 mm."""
    table = run.table("points.csv")
    return table["time"], 1e4 * table["displacement_x"]


def numbers(runs):
    found = []
    for run in runs:
        words = ("radial displacement at 100 ms", "1e-4 mm", run.program, float(radial(run)[1][-1]))
        found.append(Number(*words, PEER, 0.025, SOURCE, reason=REASON))
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
