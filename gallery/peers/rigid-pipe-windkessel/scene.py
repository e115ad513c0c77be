"""Rigid pipe with a Windkessel: svFSI's pipe

A flow of 20 pi (1 - cos 2 pi t) ml/s enters a rigid pipe of 20 mm radius and 300 mm length, whose outlet has a
Windkessel of 121 and 1212 dyn s/cm^5 and 1.5e-4 cm^5/dyn. The pressure at the outlet becomes periodic within a
second.

The pressure at the outlet follows from the flow by the Windkessel's equation alone, whatever is solved in the pipe.
The inflow is linear between 33 values, so that its first harmonic is 0.9968 of the cosine's, in the peer's run as
here.

The peer's case is 04-fluid/01-pipe3D_RCR of SimVascular/svFSI-Tests. The case pipe_RCR_3d of svMultiPhysics has a
tenth of the compliance and two steps: its numbers are others.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number

MESH = "geo pipe.geo --order 2"
QUICK_MESH = "geo pipe.geo --order 2 --set across=3 --set along=8"
QUICK = {"time.step": 10.0}

PEER = {"mean": 8.37593, "largest": 13.90423, "smallest": 2.84759}  # kPa, fourth second of the stored run
SOURCE = "svFSI-Tests of 2022, 04-fluid/01-pipe3D_RCR"
REASON = "its equations are solved to 1e-3; the Windkessel's equation has 8.3755, 13.904 and 2.847"
PERIOD, PROXIMAL, COMPLIANCE, DISTAL = 1000.0, 0.0121, 1500.0, 0.1212
FLOW = 20 * np.pi


def exact():
    """Mean, largest and smallest pressure at the outlet in kPa, by harmonics of an inflow that is linear between values."""
    rows = np.arange(33) / 32
    time = np.arange(6400) / 6400
    flow = np.interp(time, rows, FLOW * (1 - np.cos(2 * np.pi * rows)))
    modes = np.fft.rfft(flow) / len(flow)
    omega = 2 * np.pi * np.arange(len(modes)) / PERIOD
    pressure = np.fft.irfft(modes * (PROXIMAL + DISTAL / (1 + 1j * omega * DISTAL * COMPLIANCE)), len(flow)) * len(flow)
    return {"mean": pressure.mean(), "largest": pressure.max(), "smallest": pressure.min()}


def outlet(run):
    """Times in ms and mean pressure in kPa, of the last period."""
    rows = run.table("openings.csv").groups("opening")["outlet"]
    last = rows["time"] > rows["time"][-1] - PERIOD + 1e-6
    return rows["time"][last], rows["mean_pressure"][last] / 1000


def numbers(runs):
    found = []
    for run in runs:
        pressure = outlet(run)[1]
        of = {"mean": pressure.mean(), "largest": pressure.max(), "smallest": pressure.min()}
        for name, peer in PEER.items():
            words = (f"{name} pressure at the outlet", "kPa", run.program, float(of[name]))
            found.append(Number(*words, peer, 2e-3, SOURCE, scale=PEER["mean"], reason=REASON))
            if runs.quick:
                found.append(Number(*words, exact()[name], 1e-3, "the Windkessel's equation", scale=PEER["mean"]))
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        axes.plot(*outlet(run), style, color=color, label=run.words)
    for value in PEER.values():
        axes.axhline(value, color="gray", linestyle=":")
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("pressure at the outlet [kPa]")
    axes.legend()
    return figure
