"""The part of a report that plays: the reader moves through time with a slider, switches runs on and off, reads values
under the pointer and zooms. Data and program (templates/player.js) are in the page; without JavaScript, and in print,
it does not show, and the pictures beside it stay."""

import base64
from dataclasses import dataclass, field
from typing import Any, Sequence

import numpy as np

from ..results.units import time_words
from ..runs.levels import thinned
from .pictures import LINES
from .scene_packing import in_16_bits, short

MOST_NUMBERS = 1_000_000  # of moving lines in a page; 2.7 bytes each
MOST_LEVELS, FEWEST_LEVELS = 250, 20  # of a line over time
MOST_POINTS = 200  # of a line
MOST_OF_SERIES = 2000  # points of a curve over time
MOST_TIMES = 500  # that the slider stops at
# matplotlib's dash patterns in units of the page.
DASHES = {"-": "", "--": "7 4", "-.": "9 3 2 3", ":": "2 3"}


@dataclass(frozen=True)
class MovingLine:
    """A run's values along a line, at all times."""

    run: int  # place in the player's runs
    times: np.ndarray  # ms, (levels,)
    x: np.ndarray  # (points,), increasing
    values: np.ndarray  # (levels, points)


@dataclass(frozen=True)
class Series:
    """A run's value over time."""

    run: int
    times: np.ndarray  # ms, (levels,)
    values: np.ndarray  # (levels,)


@dataclass
class Panel:
    """One diagram; its curves are all of one kind. Axes are (quantity, unit)."""

    title: str
    x: tuple[str, str]
    y: tuple[str, str]
    lines: list[MovingLine] = field(default_factory=list)
    series: list[Series] = field(default_factory=list)


@dataclass
class Player:
    runs: list[str]  # names
    panels: list[Panel]
    static: bool = False

    def values(self) -> dict[str, Any]:
        """The data of the page's element, and notes on what was left out to keep the page small."""
        panels = [panel for panel in self.panels if panel.lines or panel.series]
        notes: list[str] = []
        runs = [{"name": name, **_style(i)} for i, name in enumerate(self.runs)]
        shown = [self._panel(panel, self._levels(panels), notes) for panel in panels]
        clock = time_words("{}", self.static, "t = ")
        content = {"times": short(self._times(panels)), "clock": clock, "runs": runs, "panels": shown}
        return {"content": content, "notes": list(dict.fromkeys(notes))}

    def _levels(self, panels: Sequence[Panel]) -> int:
        """How many times of each line are kept."""
        points = sum(min(len(line.x), MOST_POINTS) for panel in panels for line in panel.lines)
        return max(FEWEST_LEVELS, min(MOST_LEVELS, MOST_NUMBERS // max(points, 1)))

    def _times(self, panels: Sequence[Panel]) -> np.ndarray:
        """Where the slider stops: the times of all curves, or equally spaced ones where they are too many."""
        found = [line.times[thinned(len(line.times), self._levels(panels))] for panel in panels for line in panel.lines]
        found = found or [one.times for panel in panels for one in panel.series]
        # Times of two runs are written with different round-off.
        times = np.unique(np.round(np.concatenate([np.atleast_1d(t) for t in found] or [np.zeros(1)]), 9))
        return times if len(times) <= MOST_TIMES else np.linspace(times[0], times[-1], MOST_TIMES)

    def _panel(self, panel: Panel, levels: int, notes: list[str]) -> dict[str, Any]:
        curves = []
        for line in panel.lines:
            rows, points = thinned(len(line.times), levels), thinned(len(line.x), MOST_POINTS)
            if len(rows) < len(line.times):
                notes.append(f"Of the time levels of {self.runs[line.run]} {len(rows)} of {len(line.times)} move here.")
            values = packed(line.values[np.ix_(rows, points)])
            curve = {"run": line.run, "times": axis(line.times[rows]), "x": axis(line.x[points]), "values": values}
            curves.append(curve)
        for one in panel.series:
            rows = thinned(len(one.times), MOST_OF_SERIES)
            curves.append({"run": one.run, "x": axis(one.times[rows]), "values": packed(one.values[rows])})
        (x, x_unit), (y, y_unit) = panel.x, panel.y
        kind = "line" if panel.lines else "series"
        return {"title": panel.title, "kind": kind, "x": x, "xUnit": x_unit, "y": y, "yUnit": y_unit, "curves": curves}


def packed(values: np.ndarray) -> dict[str, Any]:
    """Numbers in 16 bits each; see in_16_bits()."""
    low, step, numbers = in_16_bits(np.asarray(values, dtype=float).ravel())
    return {"low": low, "step": step, "data": base64.b64encode(numbers.tobytes()).decode("ascii")}


def axis(values: np.ndarray) -> dict[str, Any]:
    """Increasing numbers to nine digits."""
    steps = np.diff(values)
    if len(values) > 2 and np.ptp(steps) <= 1e-9 * abs(float(values[-1])):
        return {"low": float(values[0]), "step": float(values[-1] - values[0]) / len(steps), "count": len(values)}
    return {"numbers": short(values)}


def _style(place: int) -> dict[str, Any]:
    line = LINES[place % len(LINES)]
    kind = line["linestyle"]
    dash = DASHES[kind] if isinstance(kind, str) else " ".join(f"{1.5 * part:g}" for part in kind[1])  # type: ignore
    return {"color": line["color"], "dash": dash, "width": line["linewidth"]}
