"""Coronary artery: a closed circulation with a ventricle

Four beats of 800 ms in a coronary artery of 1.5 mm radius, between the root of the aorta and the vessels within the heart's muscle.
Nothing is prescribed at its ends: a network of lumped elements joins them. A ventricle of time-varying elastance fills through one
valve and empties through another; resistances and compliances stand for the body. The compliance of the muscle's vessels leads
back to the ventricle, whose pressure squeezes them, so that the artery's flow is largest when the ventricle is relaxed.

The loop is closed, and its volume stays what it is. Once a beat is like the one before, the mean flow through the artery is the mean
difference of pressure between its outlet and the veins over the resistances between the two.

`fsi-compare verify` with the first two beats (`end = 1600.0`) gives, by the monolithic driver: flow at the outlet at
the end 0.7293 ± 0.0001 mm^3/ms, which converges as its elements do; L2 norms over time of the flow there, 1.137 ±
0.003 mm^3/ms, and of its mean pressure, 12.751 ± 0.015 kPa, and the largest radial displacement of the inner wall,
0.0841 ± 0.0005 mm, whose bars are widened. The largest and smallest flow at the outlet are not in the range where an
error can be given; `verify` asks for steps shorter than 4 ms.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo coronary.geo --order 2"
QUICK_MESH = "geo coronary.geo --order 2 --set across=3 --set through=1 --set along=8"
QUICK = {"time.step": 16, "time.end": 1600}

BEAT = 800.0  # ms
RESISTANCE = 6.0 + 6.0  # kPa ms/mm^3, from the outlet to the veins
VOLUME = 1.2e5 + 11000 * 11 + 7.5e5 * 0.9 + 2 * 11  # mm^3, that the network begins with
STORING = ("ventricle", "arteries", "veins", "branches")  # between a node and the ground


def mean(times, values):
    """Over the last beat, by the trapezoidal rule."""
    last = times >= times[-1] - BEAT - 1e-6
    return float(np.trapz(values[last], times[last]) / BEAT)


def element(run, name):
    return run.table("network.csv").where(element=name)


def numbers(runs):
    found, largest = [], []
    for run in runs:
        venules = element(run, "venules")
        outlet = run.results.openings["outlet"]
        behind = element(run, "venules")["second_pressure"] / 1000
        drop = mean(outlet.time, outlet.mean_pressure / 1000) - mean(venules["time"], behind)
        found.append(
            Number(
                "mean flow through the artery, last beat",
                "mm^3/ms",
                run.program,
                mean(outlet.time, outlet.flow),
                drop / RESISTANCE,
                0.01,
                "mean pressures over resistances",
            )
        )
        volume = sum(element(run, name)["volume"][-1] for name in STORING)
        found.append(
            Number(
                "volume in the network after the last beat",
                "mm^3",
                run.program,
                float(volume),
                VOLUME,
                1e-5,
                "a closed loop",
            )
        )
        last = outlet.time >= outlet.time[-1] - BEAT - 1e-6
        largest.append((run.program, float(outlet.flow[last].max())))
    if len(largest) == 2:
        (_, first), (program, second) = largest
        found.append(
            Number(
                "largest flow at the outlet, last beat",
                "mm^3/ms",
                program,
                second,
                first,
                1e-3,
                "the monolithic driver",
            )
        )
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 4.4), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    for run, style in zip(runs, ("-", "--")):
        aortic, outlet = element(run, "aortic"), run.results.openings["outlet"]
        label = "" if style == "-" else f", {run.words}"
        for pressure, name, color in (("first", "ventricle", "tab:red"), ("second", "aorta", "black")):
            above.plot(aortic["time"], aortic[f"{pressure}_pressure"] / 1000, style, color=color, label=name + label)
        below.plot(outlet.time, outlet.flow, style, color="tab:blue", label=run.words)
    above.set_ylabel("pressure [kPa]")
    below.set_ylabel("flow out of the artery [mm³/ms]")
    below.set_xlabel("time [ms]")
    for axes in (above, below):
        axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1), fontsize="small")
    return figure
