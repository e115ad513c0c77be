"""Beam in cross flow: an elastic block on the floor of a channel

A block of 100 by 200 by 400 mm stands on the floor of a channel, 400 mm high and 800 mm wide, and is bent by the flow over and around
it (Richter 2012). Reynolds' number is 40 with the block's height. The flow and the block come to rest; both drivers march there with
few large steps, in one half of the channel.

What is published are the displacement along the channel of the point 50 mm below the top and 50 mm inside the side, 0.05924 mm, and the
force on half of the block, 1.327 N, from five meshes of linear elements, extrapolated, to 1 %. The publication prints
an inflow of at most 0.3 m/s beside a mean of 0.2 m/s and Reynolds' number 40. Its numbers are those of at most 0.2 m/s, a parabola
along each side of the inlet; with 0.3 m/s the force would be twice the published.
"""

from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo channel.geo --order 2"
QUICK_MESH = (
    "geo channel.geo --order 2 --set before=4 --set block=2 --set behind=5 --set up=3 --set above=2 --set wide=2 "
    "--set edge=1 --set beside=1 --set far=1"
)
STILL = {"field": "velocity", "cut": True}  # the channel would hide the block

SOURCE = "Richter 2012"
KNOWN = {  # value, unit, file, column, by which the published value may be off
    "displacement along the channel": (0.05924, "mm", "points.csv", "displacement_x_mm", 1e-4 / 0.05924),
    "force on half of the block": (1327.0, "mN", "surfaces.csv", "force_x_mN", 10 / 1327.0),
}


def history(run, what):
    """Times in s, and the quantity."""
    _, _, file, column, _ = KNOWN[what]
    table = run.table(file)
    return table["time_ms"] / 1000, table[column]


def numbers(runs):
    return [
        Number(
            what,
            unit,
            run.program,
            float(history(run, what)[1][-1]),
            known,
            0.1 if runs.quick else 0.02,
            SOURCE,
            spread=spread,
        )
        for run in runs
        for what, (known, unit, _, _, spread) in KNOWN.items()
    ]


def draw(runs):
    figure = Figure(figsize=(6.4, 4.2), layout="constrained")
    for axes, (what, (known, unit, *_)) in zip(figure.subplots(2, 1, sharex=True), KNOWN.items()):
        for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
            axes.plot(*history(run, what), style, color=color, marker="o", mfc="white", label=run.words)
        axes.axhline(known, color="gray", linestyle=":", label="published")
        axes.set_ylabel(f"{what.split(' ')[0]} [{unit}]")
    axes.set_xlabel("time [s]")
    figure.axes[0].legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3)
    return figure
