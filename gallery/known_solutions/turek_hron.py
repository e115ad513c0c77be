"""What the scenes of Turek's and Hron's benchmark share: how its quantities are read off a run and held against what
was published, and their pictures. A scene names what is known of it.

A quantity is steady, and its last value counts; or it swings, and its mean and amplitude count, midway between and half
the distance of the extremes of the last periods, as in the publication.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number, SceneRun, SceneRuns
from .swings import Swings, last_swings

SOURCE = "Turek and Hron"

# The mesh that all share: volumes and surfaces that a case does not name are left out.
CHANNEL = "geo ../turek-hron-cfd1/channel.geo --order 2"
# Where vortices are shed: on the other one the lift of CFD3 swings 3 % too far, with 5 mm along the flag as with 3.
FINE_CHANNEL = CHANNEL + " --set far=15 --set near=3 --set flag=3 --set tip=2 --set wake=8"
COARSE_CHANNEL = CHANNEL + " --set far=80 --set near=20 --set flag=14 --set tip=14 --set wake=50"

COLUMNS = {  # file, column and unit of a quantity; a force on 1 mm of thickness in mN is one on 1 m in N
    "u_x": ("points.csv", "displacement_x_mm", "mm"),
    "u_y": ("points.csv", "displacement_y_mm", "mm"),
    "drag": ("surfaces.csv", "force_x_mN", "N/m"),
    "lift": ("surfaces.csv", "force_y_mN", "N/m"),
}
LINES = (("-", "black"), ("--", "tab:orange"))  # of the drivers


@dataclass(frozen=True)
class Known:
    """A published value. A mean may differ by `mean_tolerance` of the amplitude where that is larger: it is the small
    difference of two extremes."""

    name: str  # of COLUMNS
    mean: float
    amplitude: float = 0.0  # 0: steady
    tolerance: float = 5e-3  # of value or amplitude
    mean_tolerance: float = 0.0  # 0: the same
    spread: float = 0.0  # by which the amplitudes of published codes differ, relative; 0: not known
    scale: float = 0.0  # in which the tolerance of a steady value counts; 0: the value


class Benchmark:
    """One scene: `numbers` and `draw` are the scene's functions."""

    def __init__(
        self,
        *known: Known,
        frequency: float = 0.0,
        of: str = "u_y",
        frequency_tolerance: float = 5e-3,
        window: int = 4,
        quick: float = 0.0,
        static: bool = False,
    ):
        """`frequency` in 1/s, that of `of`, where the scene swings; the last `window` periods count. `quick`: what the
        numbers of the short form may differ by; 0: it ends before anything is known, and the drivers must agree.
        `static`: the time is the share of the load."""
        self.known, self.frequency, self.of, self.window, self.quick = known, frequency, of, window, quick
        self.frequency_tolerance, self.static = frequency_tolerance, static

    def values(self, run: SceneRun, name: str) -> tuple[np.ndarray, np.ndarray]:
        """Times in ms, and the quantity."""
        file, column, _ = COLUMNS[name]
        table = run.table(file)
        return table["time_ms"], table[column]

    def swings(self, run: SceneRun, name: str) -> Swings:
        return last_swings(*self.values(run, name), 1000 / self.frequency, self.window)

    def numbers(self, runs: SceneRuns) -> list[Number]:
        if runs.quick and not self.quick:
            return self._agreement(runs)
        return [number for run in runs for known in self.known for number in self._of(run, known, runs.quick)]

    def _of(self, run: SceneRun, known: Known, quick: bool) -> list[Number]:
        def number(what: str, value: float, published: float, tolerance: float, **more: Any) -> Number:
            tolerance = max(self.quick, tolerance) if quick else tolerance
            unit = COLUMNS[known.name][2]
            return Number(what, unit, run.program, value, published, tolerance, SOURCE, **more)

        if not known.amplitude:
            last = float(self.values(run, known.name)[1][-1])
            return [number(known.name, last, known.mean, known.tolerance, scale=known.scale)]
        found = self.swings(run, known.name)
        scale = max(abs(known.mean), known.amplitude)
        numbers = [
            number(
                f"mean of {known.name}", found.mean, known.mean, known.mean_tolerance or known.tolerance, scale=scale
            ),
            number(
                f"amplitude of {known.name}", found.amplitude, known.amplitude, known.tolerance, spread=known.spread
            ),
        ]
        if known.name == self.of:
            rate = number(f"frequency of {known.name}", found.frequency, self.frequency, self.frequency_tolerance)
            numbers.append(replace(rate, unit="1/s"))
        return numbers

    def _agreement(self, runs: SceneRuns) -> list[Number]:
        first = float(self.values(runs.first, self.of)[1][-1])
        return [
            Number(
                self.of,
                COLUMNS[self.of][2],
                run.program,
                float(self.values(run, self.of)[1][-1]),
                first,
                1e-2,
                "the other driver",
            )
            for run in runs
        ]

    def draw(self, runs: SceneRuns) -> Figure:
        """The quantity that swings through time, or all that become steady, beside what is published."""
        shown = [known for known in self.known if not self.frequency or known.name == self.of]
        figure = Figure(figsize=(6.4, 3.2 if len(shown) == 1 else 4.2), layout="constrained")
        for axes, known in zip(figure.subplots(len(shown), 1, sharex=True, squeeze=False)[:, 0], shown):
            self._draw(axes, runs, known)
        axes.set_xlabel("share of the load" if self.static else "time [s]")
        figure.axes[0].legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3)  # above, beside no curve
        return figure

    def _draw(self, axes: Any, runs: SceneRuns, known: Known) -> None:
        for run, (style, color) in zip(runs, LINES):
            times, values = self.values(run, known.name)
            axes.plot(times / (1 if self.static else 1000), values, style, color=color, linewidth=0.8, label=run.words)
        for side in (1, -1) if known.amplitude else (0,):
            label = "published extremes" if side else "published"
            axes.axhline(
                known.mean + side * known.amplitude, color="gray", linestyle=":", label=None if side < 0 else label
            )
        axes.set_ylabel(f"{known.name} [{COLUMNS[known.name][2]}]")
