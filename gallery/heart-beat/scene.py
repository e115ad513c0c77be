"""Heart beats: a carotid artery with prestress and Windkessel

Five beats of 800 ms in a carotid of 3 mm radius. The mesh is the vessel as it is imaged at its diastolic pressure of 10.7 kPa:
its unloaded shape is found first, so that it is at rest under that pressure. Flow comes in with Womersley's profile, a
Windkessel stands for the vessels that follow, and tissue around the wall holds it.

Once a beat is like the one before, the Windkessel's mean pressure is its two resistances times the mean flow. With a
compliance that empties in 1.4 s this takes some beats.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo carotid.geo --order 2"
QUICK_MESH = "geo carotid.geo --order 2 --set across=3 --set through=1 --set along=8"
QUICK = {"time.step": 8}

BEAT = 800.0  # ms
RESISTANCE = 0.15 + 2.06  # kPa ms/mm^3
MEAN_FLOW = 5.2890  # mm^3/ms, of the table


def mean(times, values):
    """Over the last beat, by the trapezoidal rule."""
    last = times >= times[-1] - BEAT - 1e-6
    return float(np.trapz(values[last], times[last]) / BEAT)


def numbers(runs):
    found = []
    for run in runs:
        outlet = run.results.openings["outlet"]
        times, pressure = outlet.time, outlet.mean_pressure / 1000
        peaks = [
            float(pressure[(times > times[-1] - (k + 1) * BEAT) & (times <= times[-1] - k * BEAT + 1e-6)].max())
            for k in (0, 1)
        ]
        found += [
            Number(
                "mean pressure at the outlet, last beat",
                "kPa",
                run.program,
                mean(times, pressure),
                RESISTANCE * MEAN_FLOW,
                0.02,
                "resistances times mean flow",
            ),
            Number(
                "largest pressure of the last beat", "kPa", run.program, peaks[0], peaks[1], 0.01, "the beat before"
            ),
        ]
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 4.4), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        openings = run.results.openings
        above.plot(
            openings["outlet"].time, openings["outlet"].mean_pressure / 1000, style, color=color, label=run.words
        )
        below.plot(openings["outlet"].time, openings["outlet"].flow, style, color=color, label=f"out, {run.words}")
    below.plot(openings["inlet"].time, -openings["inlet"].flow, ":", color="tab:blue", label="in")
    above.set_ylabel("pressure at the outlet [kPa]")
    below.set_ylabel("flow [mm³/ms]")
    below.set_xlabel("time [ms]")
    above.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1))
    below.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1))
    return figure
