"""Carotid from a noisy surface: from a segmentation to two heart beats

A carotid bifurcation as a segmentation leaves it: triangles with edges of 0.6 mm, each node off by up to 0.05 mm along each
axis, open at its ends. `fsi-mesh lumen` smooths it, draws the branches out by one diameter, remeshes it by the local diameter
and fills it; `fsi-mesh thicken` grows a wall of two layers on it, a quarter of the local radius thick.

The surface is the vessel at its diastolic pressure. Blood is a Carreau-Yasuda fluid. Behind each branch stands a Windkessel,
which starts from the periodic state of the openings alone.

Over a beat that is like the one before, the mean pressure of a branch is the Windkessel's two resistances times its mean flow,
and as much flows out as in.

How far these values are from the exact ones is not known for all. `fsi-compare verify` with 6 edges per diameter and
steps of 16 ms gives at 160 ms, by the monolithic driver: mean pressure of the inner branch 13.198 ± 0.015 kPa, of the
outer one 13.14 ± 0.06 kPa, flow into the inner one 8.81 ± 0.03 mm^3/ms, whose bars are widened. The mean pressure of
the common branch is 13.35 ± 0.38 kPa. So the drop from there to the inner branch, 0.23, 0.15 and 0.10 kPa with 4, 6 and
9 edges per diameter, is not known (docs/guide/accuracy.md#verify, a vessel from a noisy surface).
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

OPENINGS = "--opening cca=0,0,-12 --opening ica=4.3,0.4,14 --opening eca=-5.2,0,14 --extension ica=1 --extension eca=1"
WALL = "thicken --thickness-ratio 0.25 --layer media=60% --layer adventitia=40%"
MESH = f"surface.py --jitter 0.05 | lumen {OPENINGS} --edges-per-diameter 5 | {WALL}"
QUICK_MESH = MESH.replace("diameter 5", "diameter 3")
QUICK = {"time.step": 20, "time.end": 100}

BEAT = 800.0  # ms
PROXIMAL = {"ica": 0.25, "eca": 0.4}  # kPa ms/mm^3
COMPLIANCE = {"ica": 450.0, "eca": 250.0}  # mm^3/kPa
DISTAL = {"ica": 3.2, "eca": 5.8}  # kPa ms/mm^3


def stored(name, opening):
    """The pressure of the compliance in kPa at the end, by its equation C p' + p / R = Q with the run's flow, linear in
    each step, from the run's first step on."""
    p = opening.windkessel_pressure[0] / 1000
    leak = 1 / (DISTAL[name] * COMPLIANCE[name])
    for i in range(1, len(opening.time)):
        h = (opening.time[i] - opening.time[i - 1]) / 20  # steps of the midpoint rule, far finer than the run's
        for k in range(20):
            q = opening.flow[i - 1] + (opening.flow[i] - opening.flow[i - 1]) * (k + 0.5) / 20
            p = (p * (1 - h * leak / 2) + h * q / COMPLIANCE[name]) / (1 + h * leak / 2)
    return float(p)


def numbers(runs):
    found = []
    for run in runs:
        openings = run.results.openings
        for name in ("ica", "eca"):
            opening = openings[name]
            value = float(opening.windkessel_pressure[-1]) / 1000
            words = ("kPa", run.program, value, stored(name, opening), 2e-3, "its equation, with the run's flow")
            found.append(Number(f"pressure behind {name}, at the end", *words))
            if runs.quick:
                continue
            last = opening.time > opening.time[-1] - BEAT + 1e-6
            mean = float(opening.mean_pressure[last].mean()) / 1000
            known = (PROXIMAL[name] + DISTAL[name]) * float(opening.flow[last].mean())
            words = ("kPa", run.program, mean, known, 2e-3, "resistances times mean flow")
            found.append(Number(f"mean pressure of {name}, second beat", *words))
        if not runs.quick:
            flows = {name: float(opening.flow[opening.time > BEAT + 1e-6].mean()) for name, opening in openings.items()}
            words = (run.program, flows["ica"] + flows["eca"], -flows["cca"], 1e-3, "what flows in")
            found.append(Number("mean flow out of both branches, second beat", "mm^3/ms", *words))
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 5.0), layout="constrained")
    pressure, flow = figure.subplots(2, 1, sharex=True)
    for run, width in zip(runs, (2.6, 1.0)):
        for (name, opening), style in zip(run.results.openings.items(), ("-", "--", ":")):
            color = "0.6" if width > 2 else "black"
            words = {"linestyle": style, "color": color, "linewidth": width, "label": f"{name}, {run.words}"}
            pressure.plot(opening.time, opening.mean_pressure / 1000, **words)
            flow.plot(opening.time, np.abs(opening.flow), **words)
    pressure.set_ylabel("mean pressure [kPa]")
    flow.set_ylabel("flow in (cca) or out [mm³/ms]")
    flow.set_ylim(0, 19)
    flow.set_xlabel("time [ms]")
    flow.legend(fontsize="small", ncols=2)
    return figure
