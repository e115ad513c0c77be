"""Elastic pipe: svFSI's membrane wall

The pipe of 20 mm radius and 300 mm length has a wall of 2 mm with 400 kPa, inflated by the mean pressure of the run
with a rigid wall. The same flow enters, a Windkessel of a tenth of the compliance stands at the outlet. The wall
stores most of the flow's swing.

The peer's wall is a linear membrane on a fluid domain that stands still (the coupled momentum method), clamped at its
rims. No law here is one: the wall is a neo-Hookean tube of 2 mm whose tangent, under the prestress, is the
membrane's, E h/((1 - nu^2) R^2) = 2.667 kPa/mm.

The walls differ near their rims. Transverse shear is part of the membrane's stiffness: the radius comes back within R
sqrt(5 (1 - nu)/12), 9.1 mm, of each rim, and within (R h)^(1/2)/(3 (1 - nu^2))^(1/4), 5.2 mm, where a wall bends.
That is 2 % of the pipe's compliance.

The stored run's inflow is not its file's: at 0.25 s it has 6.28 ml/s in place of 62.83, which its mean of 61.06 ml/s
and a spike in its table of flows show. This scene has the inflow of the run. The compliance lets go of the start
within 1.9 s, so that the fourth second is compared with the fourth second.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo tube.geo --order 2"
QUICK_MESH = "geo tube.geo --order 2 --set across=3 --set along=8"
QUICK = {"time.step": 20.0, "time.end": 2000.0}

SOURCE = "svFSI-Tests of 2022, 07-fsi/cmm/01-pipe_RCR"
# Amplitudes of the first harmonic by the second of the stored run, 1 to 4: pressures in kPa, flow in ml/s.
PEER = {
    "inlet pressure, first harmonic": (0.7269, 0.7172, 0.7135, 0.7102),
    "outlet pressure, first harmonic": (0.7793, 0.7721, 0.7661, 0.7637),
    "outflow, first harmonic": (5.8806, 5.8320, 5.7812, 5.7663),
}
COLUMNS = {"inlet pressure": ("inlet", "mean_pressure", 1e-3), "outlet pressure": ("outlet", "mean_pressure", 1e-3)}
COLUMNS["outflow"] = ("outlet", "flow", 1.0)
MODEL = 0.02  # end zones of both walls, by formulas
REASON = "transverse shear holds its membrane back for 9 mm at a rim, bending this wall for 5 mm: up to 2 %"


def curve(run, name):
    """Times in ms and values in kPa or mm^3/ms."""
    opening, column, factor = COLUMNS[name]
    rows = run.table("openings.csv").groups("opening")[opening]
    return rows["time"], rows[column] * factor


def harmonic(times, values, period=1000.0):
    """Amplitude of the first harmonic in the last period."""
    last = times > times[-1] - period + 1e-6
    return 2 * abs(np.mean(values[last] * np.exp(-2j * np.pi * times[last] / period)))


def numbers(runs):
    found = []
    for run in runs:
        for what, of in PEER.items():
            times, values = curve(run, what.split(",")[0])
            second = round(times[-1] / 1000) - 1
            unit = "mm^3/ms" if what.startswith("outflow") else "kPa"
            words = (what, unit, run.program, float(harmonic(times, values)), of[second])
            found.append(Number(*words, 0.03, SOURCE, model=MODEL, reason=REASON))
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        axes.plot(*curve(run, "outlet pressure"), style, color=color, label=run.words)
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("pressure at the outlet [kPa]")
    axes.legend()
    return figure
