"""Turek-Hron FSI1: flow around a cylinder with an elastic flag

The flow of CFD1 with the flag of CSM1: it bends a little and comes to rest. Both drivers march to the steady state with
large steps of first order; the two solve for one and the same state.

The benchmark's tip displacement is 0.82 mm across a channel of 410 mm, so it asks for accurate forces and for an accurate
wall at once.
"""

from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo ../turek-hron-cfd1/channel.geo --order 2"
QUICK_MESH = MESH + " --set far=60 --set near=15 --set flag=10"
QUICK = {"time.end": 5000}

# Of the benchmark.
TIP = (0.02270493, 0.8208773)  # mm
DRAG, LIFT = 14.29426, 0.763746  # N/m


def numbers(runs):
    found = []
    for run in runs:
        points, forces = run.table("points.csv"), run.table("surfaces.csv")
        for what, unit, value, known, scale in (
            ("tip's u_x", "mm", points["displacement_x_mm"], TIP[0], 0),
            ("tip's u_y", "mm", points["displacement_y_mm"], TIP[1], 0),
            ("drag", "N/m", forces["force_x_mN"], DRAG, 0),
            ("lift", "N/m", forces["force_y_mN"], LIFT, DRAG),
        ):
            found.append(
                Number(
                    what,
                    unit,
                    run.program,
                    float(value[-1]),
                    known,
                    0.1 if runs.quick else 5e-3,
                    "FeatFlow",
                    scale=scale,
                )
            )
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-o", "--s"), ("black", "tab:orange")):
        points = run.table("points.csv")
        axes.plot(
            points["time_ms"] / 1000, points["displacement_y_mm"], style, color=color, mfc="white", label=run.program
        )
    axes.axhline(TIP[1], color="black", linestyle=":", label="benchmark")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("tip's u_y [mm]")
    axes.legend()
    return figure
