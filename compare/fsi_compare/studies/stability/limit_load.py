"""The pressure that a tube of neo-Hookean or Mooney-Rivlin layers bears at rest, and what the runs make of it.

Closed form for an infinitely long, incompressible tube at unit axial stretch: with A, B inner and outer radius of a
layer at rest, a, b under pressure, mu its shear modulus and k = a_i^2 - A_i^2 of the inner face,
p = sum over layers of mu [ln(B a / (A b)) + (k/2) (1/a^2 - 1/b^2)]; its supremum is the sum of mu ln(B/A).
"""

import math
from dataclasses import dataclass
from typing import List, Mapping, Optional, Sequence, Tuple

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ...errors import InputError
from ...pictures import LINES, finish
from ..study_run import StudyRun


@dataclass(frozen=True)
class Tube:
    radii: Sequence[float]  # mm, from the inner face outward
    shear_moduli: Sequence[float]  # kPa, one a layer

    @property
    def layers(self) -> List[Tuple[float, float, float]]:
        return list(zip(self.radii, self.radii[1:], self.shear_moduli))

    @property
    def limit(self) -> float:
        """kPa"""
        return sum(mu * math.log(outer / inner) for inner, outer, mu in self.layers)

    def pressure(self, widening: float) -> float:
        """kPa at which the inner radius is `widening` times its own at rest."""
        k = self.radii[0] ** 2 * (widening ** 2 - 1)
        total = 0.0
        for inner, outer, mu in self.layers:
            a2, b2 = inner ** 2 + k, outer ** 2 + k
            total += mu * (math.log(outer / inner) + 0.5 * math.log(a2 / b2) + 0.5 * k * (1 / a2 - 1 / b2))
        return total

    def widening(self, pressure: float) -> Optional[float]:
        """The inverse of `pressure` for 0 <= pressure < limit; None beyond."""
        if not 0 <= pressure < self.limit:
            return None
        low, high = 1.0, 2.0
        while self.pressure(high) < pressure:
            high *= 2
            if high > 1e6:
                return None
        for _ in range(100):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.pressure(middle) < pressure else (low, middle)
        return 0.5 * (low + high)


def tube(settings: Mapping, wrong) -> Tube:
    """From the study's [report.tube]. `wrong(key, problem, remedy)` makes the error."""
    def numbers(name):
        values = settings.get(name)
        if not isinstance(values, list) or not values or any(isinstance(v, bool) or not isinstance(v, (int, float))
                                                             or not v > 0
                                                              for v in values):
            raise wrong(f"report.tube.{name}", "is not a list of positive numbers", "give them from the inside outward")
        return [float(value) for value in values]

    for name in settings:
        if name not in ("radii", "shear_moduli"):
            raise wrong(f"report.tube.{name}", "is unknown", "its keys are radii (mm) and shear_moduli (kPa)")
    made = Tube(numbers("radii"), numbers("shear_moduli"))
    if len(made.radii) != len(made.shear_moduli) + 1 or sorted(set(made.radii)) != list(made.radii):
        raise wrong("report.tube.radii", "are not one more than the layers, rising",
                    "give the radius of each face in mm")
    return made


@dataclass(frozen=True)
class Inflation:
    """How far a run's wall was inflated, level by level."""

    times: np.ndarray  # ms; fraction of the load in statics
    largest: np.ndarray  # radial displacement of the inner face in mm, its largest along the tube
    middle: np.ndarray  # the same half-way along the tube


def inflation(run: StudyRun) -> Optional[Inflation]:
    try:
        columns = run.columns("wall_displacement.csv")
        times, z, radial = (columns[name] for name in ("time_ms", "z_mm", "radial_mm"))
        if not len(times):
            return None
        points = int((times == times[0]).sum())
        radial = radial.reshape(-1, points)
        half = int(np.argmin(np.abs(z[:points] - 0.5 * (z[0] + z[points - 1]))))
        return Inflation(times.reshape(-1, points)[:, 0], radial.max(axis=1), radial[:, half])
    except (InputError, KeyError, ValueError):
        return None


def static_figure(runs: Sequence[Tuple[str, float, Inflation]], tube: Tube) -> Figure:
    """`runs`: label, full load in kPa, levels. The curves end where the run does."""
    size = (6.4, 3.6)
    figure = Figure(figsize=size)
    canvas = FigureCanvasAgg(figure)
    axes = figure.subplots()
    radius = tube.radii[0]
    largest = max([1.5, *(1 + float(levels.largest[-1]) / radius for _, _, levels in runs)]) * 1.03
    widenings = np.linspace(1, largest, 200)
    handles = axes.plot(widenings, [tube.pressure(w) for w in widenings], **LINES[0])
    handles.append(axes.axhline(tube.limit, color="#777777", linewidth=1.0, linestyle=(0, (5, 3))))
    labels = ["long tube, closed form", f"its limit, {tube.limit:.3f} kPa"]
    for i, (label, load, levels) in enumerate(runs):
        look = {"marker": "osD^v"[i % 5], "markersize": 3.5, "linewidth": 0.9,
                "linestyle": LINES[1 + i % 5]["linestyle"],
                "color": LINES[1 + i % 5]["color"], "markerfacecolor": "none"}
        handles += axes.plot(1 + levels.largest / radius, load * levels.times, **look)
        labels.append(label)
    axes.set_xlim(1, largest)
    axes.set_ylim(0, 1.08 * max([tube.limit, *(load * float(levels.times[-1]) for _, load, levels in runs)]))
    axes.set_xlabel("largest inner radius over that at rest")
    axes.set_ylabel("pressure in kPa")
    finish(figure, canvas, handles, labels, "Static inflation until no further solution is found", size)
    return figure


def pulse_figure(runs: Sequence[Tuple[str, bool, Inflation]], title: str) -> Figure:
    """`runs`: label, whether it reached its end, levels."""
    size = (6.4, 3.4)
    figure = Figure(figsize=size)
    canvas = FigureCanvasAgg(figure)
    axes = figure.subplots()
    handles, labels = [], []
    for i, (label, done, levels) in enumerate(runs):
        handles += axes.plot(levels.times, levels.largest, **LINES[i % len(LINES)])
        labels.append(label)
        if not done:
            axes.plot(levels.times[-1], levels.largest[-1], marker="X", markersize=9,
                      color=LINES[i % len(LINES)]["color"],
                      markeredgecolor="#ffffff", zorder=5)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("t in ms")
    axes.set_ylabel("largest radial displacement in mm")
    finish(figure, canvas, handles, labels, title, size)
    return figure
