"""The part of a report that plays: the reader moves through time with a slider, switches runs on and off, reads values
under the pointer and zooms. Data and program (player.js) are in the page; without JavaScript, and in print, it does not
show, and the pictures beside it stay."""

import base64
import html
import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Dict, List, Sequence, Tuple

import numpy as np

from .pictures import LINES

MOST_NUMBERS = 1_000_000  # of moving lines in a page; 2.7 bytes each
MOST_LEVELS, FEWEST_LEVELS = 250, 20  # of a line over time
MOST_POINTS = 200  # of a line
MOST_OF_SERIES = 2000  # points of a curve over time
MOST_TIMES = 500  # that the slider stops at
NONE = 65535

# matplotlib's dash patterns in units of the page.
DASHES = {"-": "", "--": "7 4", "-.": "9 3 2 3", ":": "2 3"}

STYLE = """
.player { margin: 1.2rem 0; } .player .controls { position: sticky; top: 0; background: #fff; padding: .4rem 0;
  display: flex; gap: 1rem; align-items: center; z-index: 1; }
.player .controls label { flex: 1; display: flex; gap: .6rem; align-items: center; } .player input[type=range] { flex: 1; }
.player output { min-width: 7.5em; } .player button { font: inherit; padding: .1rem .8rem; }
.player .runs { border: none; padding: 0; margin: .2rem 0; display: flex; flex-wrap: wrap; gap: .2rem 1.4rem; }
.player .runs legend { float: left; padding: 0 1rem 0 0; } .player .runs label { font-size: .9rem; }
.player .sample { width: 48px; height: 12px; margin: 0 .4rem; }
.player .panels { display: grid; grid-template-columns: repeat(auto-fit, minmax(25rem, 1fr)); gap: .6rem 1.2rem; }
.player .panel { margin: 0; position: relative; } .player .panel > svg { width: 100%; touch-action: pan-y; cursor: crosshair; }
.player figcaption { font-weight: bold; } .player .readout { font-size: .85rem; margin: 0; min-height: 2.6em; }
.player .reset { position: absolute; top: 0; right: 0; } .player text { font-size: 12px; fill: #222; }
.player .grid { stroke: #ddd; stroke-width: .6; } .player .frame { stroke: #333; fill: none; }
.player .cursor { stroke: #333; stroke-width: .8; } .player .now { stroke: #777; stroke-dasharray: 1 3; }
.player .box { fill: #88888833; stroke: #555; stroke-width: .6; width: 0; height: 0; pointer-events: none; }
@media print { .player { display: none; } }
"""


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
    x: Tuple[str, str]
    y: Tuple[str, str]
    lines: List[MovingLine] = field(default_factory=list)
    series: List[Series] = field(default_factory=list)


@dataclass
class Player:
    runs: List[str]  # names
    panels: List[Panel]
    notes: List[str] = field(default_factory=list)  # filled by html(): what was left out to keep the page small

    def html(self) -> str:
        """The element of the page, with its data."""
        panels = [panel for panel in self.panels if panel.lines or panel.series]
        content = {
            "times": _short(self._times(panels)),
            "runs": [{"name": name, **_style(i)} for i, name in enumerate(self.runs)],
            "panels": [self._panel(panel, self._levels(panels)) for panel in panels],
        }
        data = json.dumps(content, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
        notes = "".join(f'<p class="note">{html.escape(note)}</p>' for note in dict.fromkeys(self.notes))
        return f'<div class="player" hidden><script type="application/json">{data}</script>{notes}</div>'

    def _levels(self, panels: Sequence[Panel]) -> int:
        """How many times of each line are kept."""
        points = sum(min(len(line.x), MOST_POINTS) for panel in panels for line in panel.lines)
        return max(FEWEST_LEVELS, min(MOST_LEVELS, MOST_NUMBERS // max(points, 1)))

    def _times(self, panels: Sequence[Panel]) -> np.ndarray:
        """Where the slider stops: the times of all curves; equally spaced ones in their place where they are too many."""
        levels = self._levels(panels)
        found = [line.times[thinned(len(line.times), levels)] for panel in panels for line in panel.lines]
        found = found or [one.times for panel in panels for one in panel.series]
        # Times of two runs are written with different round-off.
        times = np.unique(np.round(np.concatenate([np.atleast_1d(t) for t in found] or [np.zeros(1)]), 9))
        return times if len(times) <= MOST_TIMES else np.linspace(times[0], times[-1], MOST_TIMES)

    def _panel(self, panel: Panel, levels: int) -> Dict[str, Any]:
        curves = []
        for line in panel.lines:
            rows, points = thinned(len(line.times), levels), thinned(len(line.x), MOST_POINTS)
            if len(rows) < len(line.times):
                self.notes.append(
                    f"Of the time levels of {self.runs[line.run]} {len(rows)} of {len(line.times)} move here."
                )
            curves.append(
                {
                    "run": line.run,
                    "times": axis(line.times[rows]),
                    "x": axis(line.x[points]),
                    "values": packed(line.values[np.ix_(rows, points)]),
                }
            )
        for one in panel.series:
            rows = thinned(len(one.times), MOST_OF_SERIES)
            curves.append({"run": one.run, "x": axis(one.times[rows]), "values": packed(one.values[rows])})
        return {
            "title": panel.title,
            "kind": "line" if panel.lines else "series",
            "x": panel.x[0],
            "xUnit": panel.x[1],
            "y": panel.y[0],
            "yUnit": panel.y[1],
            "curves": curves,
        }


def program() -> str:
    """The script that a page with players ends with."""
    text = (Path(__file__).parent / "player.js").read_text(encoding="utf-8")
    return f"<script>\n{text}</script>"


def thinned(count: int, most: int) -> np.ndarray:
    """Indices of at most `most` of `count` entries, evenly spread, the first and the last among them."""
    return np.arange(count) if count <= most else np.unique(np.linspace(0, count - 1, most).round().astype(int))


def packed(values: np.ndarray) -> Dict[str, Any]:
    """Numbers in 16 bits each, to 1/65534 of their range; what is no number stays none."""
    flat = np.asarray(values, dtype=float).ravel()
    finite = np.isfinite(flat)
    low, high = (float(flat[finite].min()), float(flat[finite].max())) if finite.any() else (0.0, 0.0)
    step = (high - low) / (NONE - 1)
    numbers = np.full(len(flat), NONE, dtype="<u2")
    if step > 0:
        numbers[finite] = np.round((flat[finite] - low) / step).astype("<u2")
    else:
        numbers[finite] = 0
    return {"low": low, "step": step, "data": base64.b64encode(numbers.tobytes()).decode("ascii")}


def axis(values: np.ndarray) -> Dict[str, Any]:
    """Increasing numbers to nine digits."""
    steps = np.diff(values)
    if len(values) > 2 and np.ptp(steps) <= 1e-9 * abs(float(values[-1])):
        return {"low": float(values[0]), "step": float(values[-1] - values[0]) / len(steps), "count": len(values)}
    return {"numbers": _short(values)}


def _short(numbers: np.ndarray) -> List[float]:
    return [float(f"{number:.9g}") for number in numbers]


def _style(place: int) -> Dict[str, Any]:
    line = LINES[place % len(LINES)]
    kind = line["linestyle"]
    dash = DASHES[kind] if isinstance(kind, str) else " ".join(f"{1.5 * part:g}" for part in kind[1])  # type: ignore
    return {"color": line["color"], "dash": dash, "width": line["linewidth"]}
