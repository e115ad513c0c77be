"""Oscillating pipe: blood and a wall of two layers, shaken along their axis

A pressure gradient of 0.01 kPa/mm that swings once in 2 pi ms moves blood and wall along the axis of a straight pipe, whose
outer face is held. The wall's ends are free along the axis, each under the pressure of the opening beside it, and the
openings go with them. So 4 mm of the pipe do what an infinite one does.

Its solution is exact: Bessel functions of the radius in the blood and in each layer (docs/theory.md, section 13.3). The
pressure swings in over four and a half periods, so that little else swings; amplitudes and phases are those of the last
period.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo pipe.geo --order 2"
QUICK_MESH = "geo pipe.geo --order 2 --set across=6 --set media=2 --set adventitia=1 --set along=4"
QUICK = {"time.step": 0.2, "time.end": 35}

# Complex amplitudes at w = 1/ms and 0.1 kPa/mm (docs/theory.md, section 13.3), for a tenth of that.
WALL = 0.1 * (0.01873715503 - 0.002478210155j)  # of the axial displacement at the inner face, mm
BLOOD = 0.1 * (0.003009433989 - 0.1077371894j)  # of the axial velocity 1.2 mm off the axis, mm/ms


def wall(run):
    """Times in ms and axial displacement of the inner face half-way along the pipe, in mm."""
    line = run.results.wall_line
    return line.times, line["axial"][:, np.abs(line.s - 2).argmin()]


def blood(run):
    """Times in ms and axial velocity in mm/ms."""
    point = run.results.points["blood"]
    return point["time"], point["velocity_z"]


def amplitude(times, values):
    """Complex, of e^(i t) in the last period."""
    last = times > times[-1] - 2 * np.pi
    t = times[last]
    (cosine, sine, _), *_ = np.linalg.lstsq(
        np.stack([np.cos(t), np.sin(t), np.ones_like(t)], axis=1), values[last], rcond=None
    )
    return cosine - 1j * sine


def numbers(runs):
    tolerance = 0.04 if runs.quick else 0.01
    found = []
    for run in runs:
        for what, unit, course, exact in (
            ("axial displacement of the inner face", "mm", wall(run), WALL),
            ("axial velocity 1.2 mm off the axis", "mm/ms", blood(run), BLOOD),
        ):
            swing = amplitude(*course)
            phase = np.angle(exact) + np.angle(swing / exact)
            found += [
                Number(f"{what}: amplitude", unit, run.program, abs(swing), abs(exact), tolerance, "Bessel functions"),
                Number(
                    f"{what}: phase",
                    "rad",
                    run.program,
                    float(phase),
                    float(np.angle(exact)),
                    tolerance,
                    "Bessel functions",
                    scale=1.0,
                ),
            ]
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 4.4), layout="constrained")
    axes = figure.subplots(2, sharex=True)
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        for panel, (times, values), scale in zip(axes, (wall(run), blood(run)), (1000, 1)):
            panel.plot(times, scale * values, style, color=color, label=run.words)
    end = wall(runs.first)[0][-1]
    t = np.linspace(end - 2 * np.pi, end, 13)
    for panel, exact, scale in zip(axes, (WALL, BLOOD), (1000, 1)):
        panel.plot(t, scale * (exact * np.exp(1j * t)).real, "o", color="black", mfc="white", label="exact")
    axes[0].set_ylabel("displacement of the\ninner face [µm]")
    axes[1].set_ylabel("velocity at 1.2 mm [mm/ms]")
    axes[1].set_xlabel("time [ms]")
    axes[0].legend(loc="upper left")
    return figure
