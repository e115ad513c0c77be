"""Ring in an annulus of liquid: an oval that swings, with ten times its own mass

A ring of 1 m radius and 0.1 m thickness stands in a viscous liquid that fills the space up to a rigid circle of 1.5 m. It is
pushed to an oval for five seconds and let go. The liquid is 1.4 times as heavy as the ring, and squeezed through the gap: ten
times the ring's mass swings with it, and lowers its frequency to 0.29 of what it is dry.

Frequency and decay of small oscillations are exact (docs/theory.md, section 13.5), for a thick ring in plane strain and the
linear equations of a viscous liquid. Without viscosity the same relation gives the published 2.555042 rad/s of the dry ring, and
2.435615, 1.804513 and 0.768654 rad/s in liquids of 14, 140 and 1400 kg/m^3. This scene has 1400 kg/m^3 and 1 Pa s.

Computed numbers are those of the swing that is left once slower flow has been told from it: of a sum of four exponentials fitted
to the ring's ovality.
"""

from matplotlib.figure import Figure

from known_solutions.ring_modes import Ring
from fsi_compare.gallery.scene import Number
from known_solutions.swings import free_swing

MESH = "geo ring.geo --order 2"
QUICK_MESH = "geo ring.geo --order 2 --set around=12 --set through=1 --set across=6"
QUICK = {"time.step": 160}

RING = Ring(inner=950.0, outer=1050.0, rigid=1500.0, young=1000.0, poisson=0.3, density=1.0, liquid=1.4, viscosity=1.0)
EXACT = RING.mode(2, 0.77e-3j)  # 1/ms
FREE, APART = 5400.0, 800.0  # ms: when the push is over; between values of the fit


def ovality(run):
    """Times in ms, and half the difference of the inner face's displacements outwards at both axes, in mm."""
    points = run.table("points.csv")
    side, top = (points["point"] == name for name in ("side", "top"))
    return points["time_ms"][side], (points["displacement_x_mm"][side] - points["displacement_y_mm"][top]) / 2


def numbers(runs):
    frequency, decay = (0.02, 0.05) if runs.quick else (1e-3, 3e-3)
    source = "relation of Bessel functions"
    found = []
    for run in runs:
        s = 1000 * free_swing(*ovality(run), FREE, APART)  # 1/s
        found += [
            Number("frequency", "rad/s", run.program, s.imag, 1000 * EXACT.imag, frequency, source),
            Number("rate of decay", "1/s", run.program, -s.real, -1000 * EXACT.real, decay, source),
        ]
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        times, values = ovality(run)
        axes.plot(times / 1000, values, style, color=color, label=run.words)
    axes.axvspan(0, 5, color="0.9", label="pushed")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("ovality [mm]")
    axes.legend()
    return figure
