"""Result folders of runs that never happened, with waves whose peaks, speeds and differences are known exactly."""

import json
import sys
from pathlib import Path

import numpy as np

TOP = Path(__file__).resolve().parents[3]
COMPARE = TOP / "compare"
sys.path[:0] = [str(TOP / folder) for folder in ("compare", "compare/research", "gallery")]

TIMES = 0.125 * np.arange(1, 97)  # the paper's 96 steps
Z = np.arange(181) / 10


def parabola(speed, start=1.0, height=50.0, half_width=2.0):
    """A travelling parabolic cap: the three points about its top fix vertex and height without error."""
    return lambda t, z: np.maximum(0.0, height * (1 - ((z - start - speed * t) / half_width) ** 2))


def gaussian(speed, start=1.0, height=50.0, width=1.2):
    return lambda t, z: height * np.exp(-(((z - start - speed * t) / width) ** 2))


def artery_like(speed, height=90.0):
    """A decaying, spreading main crest with ripples behind it and a small precursor at 2.4 mm/ms."""

    def wave(t, z):
        width = 0.9 + 0.1 * t
        x = (z - 0.8 - speed * t) / width
        main = height / (1 + 0.25 * t) * np.exp(-(x**2))
        ripples = -0.45 * height / (1 + 0.25 * t) * np.exp(-((x + 1.7) ** 2)) * np.cos(2.2 * (x + 1.7))
        precursor = 6.0 * np.exp(-(((z - 2.4 * t) / 1.5) ** 2))
        return (main + ripples + precursor) * (1 - np.exp(-3 * z))

    return wave


def pressure_csv(wave, times=TIMES, z=Z):
    lines = ["time_ms,z_mm,pressure_Pa"]
    for t in times:
        lines += [f"{float(t)!r},{float(x)!r},{float(p)!r}" for x, p in zip(z, wave(t, z))]
    return "\n".join(lines) + "\n"


def write_run(folder, wave, times=TIMES, z=Z, program="fsi-monolithic", title="Synthetic tube", **summary):
    """Writes what fsi-compare reads of a result folder; returns the folder."""
    folder = Path(folder)
    folder.mkdir(parents=True)
    content = {"program": program, "version": "0.1.0", "title": title, "status": "done", **summary}
    (folder / "summary.json").write_text(json.dumps(content))
    (folder / "centerline_pressure.csv").write_text(pressure_csv(wave, times, z))
    return folder
