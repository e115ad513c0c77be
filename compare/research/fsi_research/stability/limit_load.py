"""The pressure that a tube of neo-Hookean or Mooney-Rivlin layers bears at rest, and what the runs make of it.

Closed form for an infinitely long, incompressible tube at unit axial stretch: with A, B inner and outer radius of a
layer at rest, a, b under pressure, mu its shear modulus and k = a_i^2 - A_i^2 of the inner face,
p = sum over layers of mu [ln(B a / (A b)) + (k/2) (1/a^2 - 1/b^2)]; its supremum is the sum of mu ln(B/A).

A long tube need not widen evenly: where the Jacobian of pressure and axial force by radius and axial stretch vanishes,
a bulge sets in [Fu2016], which lengthens where it widens.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.base.errors import InputError
from fsi_compare.reporting.pictures import LINES, finish
from fsi_compare.study.study_run import StudyRun
from ..catalogue.report_section import ReportSection
from ..evidence.tube import Layer

NODES, WEIGHTS = np.polynomial.legendre.leggauss(20)
LABEL = (0.1, 0.055)  # width and height of a label, of the picture's: nearer ones would cover each other


@dataclass(frozen=True)
class Wall:
    layers: Sequence[Layer]  # from the inside to the outside

    @property
    def radius(self) -> float:
        """mm, of the inner face at rest."""
        return self.layers[0].inner

    @property
    def limit(self) -> float:
        """kPa"""
        return sum(layer.shear * math.log(layer.outer / layer.inner) for layer in self.layers)

    def pressure(self, widening: float) -> float:
        """kPa at which the inner radius is `widening` times its own at rest."""
        k = self.radius**2 * (widening**2 - 1)
        total = 0.0
        for layer in self.layers:
            a2, b2 = layer.inner**2 + k, layer.outer**2 + k
            total += layer.shear * (
                math.log(layer.outer / layer.inner) + 0.5 * math.log(a2 / b2) + 0.5 * k * (1 / a2 - 1 / b2)
            )
        return total

    @cached_property
    def bulge(self) -> Optional[float]:
        """The widening at which a long tube at unit axial stretch begins to bulge; None: it does not below 10."""

        def turns(widening: float) -> bool:
            h = 1e-5
            by_radius = self.pressure_and_force(widening + h, 1) - self.pressure_and_force(widening - h, 1)
            by_stretch = self.pressure_and_force(widening, 1 + h) - self.pressure_and_force(widening, 1 - h)
            return bool(by_radius[0] * by_stretch[1] < by_radius[1] * by_stretch[0])

        low, high = 1.0, next((w for w in np.arange(1.1, 10, 0.1) if turns(w)), 0.0)
        for _ in range(50 if high else 0):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if turns(middle) else (middle, high)
        return float(high) or None

    def pressure_and_force(self, widening: float, stretch: float) -> np.ndarray:
        """Inner pressure in kPa and axial force, over pi, of the wall less the pressure on the bore, by quadrature."""
        total = np.zeros(2)
        for layer in self.layers:
            half = 0.5 * (layer.outer - layer.inner)
            at_rest = layer.inner + half * (1 + NODES)
            now = np.sqrt((widening * self.radius) ** 2 + (at_rest**2 - self.radius**2) / stretch)
            hoop, radial = now / at_rest, at_rest / (now * stretch)
            thickness = layer.shear * half * WEIGHTS * radial
            total += [
                np.sum(thickness * (hoop**2 - radial**2) / now),
                np.sum(thickness * (2 * stretch**2 - hoop**2 - radial**2) * now),
            ]
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


TUBE_KEYS = ("radii", "shear_moduli")


def read_wall(settings: ReportSection) -> Wall:
    """Reads [report.tube]: radii of the faces in mm and shear moduli of the layers in kPa, from the inside outward."""
    radii, moduli = settings.numbers("radii"), settings.numbers("shear_moduli")
    if len(radii) != len(moduli) + 1 or sorted(set(radii)) != radii:
        raise settings.wrong("radii", "are not one more than the layers, rising", "give the radius of each face in mm")
    return Wall([Layer(*layer) for layer in zip(radii, radii[1:], moduli)])


@dataclass(frozen=True)
class Inflation:
    """How far a run's wall was inflated, level by level."""

    times: np.ndarray  # ms; fraction of the load in statics
    largest: np.ndarray  # radial displacement of the inner face in mm, its largest along the tube
    middle: np.ndarray  # the same half-way along the tube

    @property
    def steps(self) -> int:
        """Number of equal load steps, from nothing to the whole load in statics."""
        return round(1 / float(self.times[0]))


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


@dataclass(frozen=True)
class Curve:
    label: str
    load: float  # in kPa, the whole; in time the pulse's length in ms
    done: bool
    levels: Inflation


def static_figure(runs: Sequence[Curve], wall: Wall) -> Figure:
    """The curves end where the run does."""
    figure = Figure(figsize=(6.4, 3.6))
    axes = figure.subplots()
    bulge = wall.bulge
    largest = max([1.5, bulge or 0, *(1 + float(run.levels.largest[-1]) / wall.radius for run in runs)]) * 1.03
    widenings = np.linspace(1, largest, 200)
    handles = axes.plot(widenings, [wall.pressure(w) for w in widenings], **LINES[0])
    handles.append(axes.axhline(wall.limit, color="#777777", linewidth=1.0, linestyle=(0, (5, 3))))
    labels = ["long tube that widens evenly, closed form", f"its limit, {wall.limit:.3f} kPa"]
    if bulge:
        handles += axes.plot(
            bulge,
            wall.pressure(bulge),
            linestyle="none",
            marker="*",
            markersize=11,
            color="#000000",
            markeredgecolor="#ffffff",
            zorder=4,
        )
        labels.append(f"a long tube begins to bulge, {wall.pressure(bulge):.3f} kPa")
    for i, run in enumerate(runs):
        look = {
            "marker": "osD^v"[i % 5],
            "markersize": 3.5,
            "linewidth": 0.9,
            "markerfacecolor": "none",
            "markevery": max(1, len(run.levels.times) // 25),
            "linestyle": LINES[1 + i % 5]["linestyle"],
            "color": LINES[1 + i % 5]["color"],
        }
        handles += axes.plot(1 + run.levels.largest / wall.radius, run.load * run.levels.times, **look)
        labels.append(run.label)
    axes.set_xlim(1, largest)
    axes.set_ylim(0, 1.08 * max([wall.limit, *(run.load * float(run.levels.times[-1]) for run in runs)]))
    axes.set_xlabel("largest inner radius over that at rest")
    axes.set_ylabel("pressure in kPa")
    return finish(figure, handles, labels, "Static inflation until no further solution is found")


def pulse_figure(runs: Sequence[Curve], title: str) -> Figure:
    """Each curve is named at its end; the longest pulse lies broad and dark beneath others, which coincide with it."""
    figure = Figure(figsize=(6.4, 3.6))
    axes = figure.subplots()
    runs = sorted(runs, key=lambda run: -run.load)
    handles, labels = [], []
    for i, run in enumerate(runs):
        handles += axes.plot(run.levels.times, run.levels.largest, zorder=2 + 0.01 * i, **LINES[i % len(LINES)])
        labels.append(run.label)
        axes.plot(run.levels.times[-1], run.levels.largest[-1], zorder=5, **end_marker(run.done))
    axes.set_ylim(0, 1.08 * max(float(run.levels.largest.max()) for run in runs))
    axes.set_xlim(0, 1.12 * max(float(run.levels.times[-1]) for run in runs))
    width, height = axes.get_xlim()[1], axes.get_ylim()[1]
    ends = [(float(run.levels.times[-1]) / width, float(run.levels.largest[-1]) / height) for run in runs]
    for run, (x, y) in zip(runs, apart(ends)):
        axes.text((x + 0.02) * width, y * height, f"{run.load:g} ms", va="center", fontsize=8, zorder=6)
    for done, label in ((True, "end of the run"), (False, "not converged in the next step")):
        if any(run.done == done for run in runs):
            handles += axes.plot([], [], **end_marker(done))
            labels.append(label)
    axes.set_xlabel("t in ms")
    axes.set_ylabel("largest radial displacement in mm")
    return finish(figure, handles, labels, title)


def end_marker(done: bool) -> Dict[str, Any]:
    look = {"marker": "o", "markersize": 6} if done else {"marker": "X", "markersize": 9}
    return {**look, "linestyle": "none", "color": "#000000", "markeredgecolor": "#ffffff"}


def apart(places: Sequence[Tuple[float, float]]) -> List[Tuple[float, float]]:
    """The places, parts of the picture's width and height, moved up where labels there would cover each other."""
    placed: Dict[int, Tuple[float, float]] = {}
    for i in sorted(range(len(places)), key=lambda i: places[i][1]):
        x, y = places[i]
        beneath = [v for u, v in placed.values() if abs(u - x) < LABEL[0]]
        placed[i] = x, max([y, *(v + LABEL[1] for v in beneath)])
    return [placed[i] for i in range(len(places))]
