"""What of finished runs a report plays, and the pictures of the same that stay in print."""

import functools
import re
from typing import Sequence

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..base import interruption
from ..results.line import VECTOR, Line
from ..results.run import RunResults
from ..runs.pressure_waves import PressureWaves
from .pictures import LINES, PANEL_INCHES, finish, pressure_figure
from .player import MovingLine, Panel, Player, Series
from .report import Report

# (attribute of a run, quantity, its words, heading)
MOVING = (
    ("centre_line", "pressure", "pressure", "Pressure along the centre line"),
    ("wall_line", "radial", "radial displacement", "Radial displacement of the inner wall"),
    ("wall_line", "axial", "axial displacement", "Axial displacement of the inner wall"),
)
OF_OPENINGS = (
    ("flow", "flow outwards", "mm^3/ms"),
    ("mean_pressure", "mean pressure", "Pa"),
    ("windkessel_pressure", "Windkessel pressure", "Pa"),
)
OF_PLACES = {"planes": ("flow", "pressure"), "points": ("pressure",)}  # columns of their tables that are shown
MOST_PANELS = 8  # over time, in one picture
PICTURES = 6  # times in a picture, where none are asked for


def add_waves(report: Report, runs: Sequence[RunResults], labels: Sequence[str], times: Sequence[float] = ()) -> None:
    """The player of these runs and its pictures; `times` in ms are those of the pictures, which all lines must reach.
    What no run has is left out."""
    shown = [panel for panel in panels(runs) if panel.lines or panel.series]
    static = all(run.static for run in runs)
    report.player(Player(list(labels), shown, static))
    stems: list[str] = []
    for panel in shown:
        at = list(times) or picture_times(panel.lines) if panel.lines else []
        if at:
            stems.append(stem_of(panel.title, stems))
            report.figure(stems[-1], functools.partial(line_figure, panel, labels, at, static), f"{panel.title}.")
    series = [panel for panel in shown if panel.series]
    for first in range(0, len(series), MOST_PANELS):
        stems.append(stem_of("over time", stems))
        some = series[first : first + MOST_PANELS]
        report.figure(stems[-1], functools.partial(series_figure, some, labels), caption_of(some))


def caption_of(shown: Sequence[Panel]) -> str:
    """Names what the diagrams of a picture show; its title says that they are over time."""
    words = list(dict.fromkeys(panel.title.partition(":")[0] for panel in shown))
    return f"{', '.join([words[0], *(word[0].lower() + word[1:] for word in words[1:])])}."


def stem_of(title: str, taken: Sequence[str]) -> str:
    """A file's name for a picture, which none of the others has."""
    stem = re.sub(r"[^a-z0-9]+", "_", title.lower()).strip("_")[:60]
    names = [stem] + [f"{stem}_{number}" for number in range(2, len(taken) + 3)]
    return next(name for name in names if name not in taken)


def panels(runs: Sequence[RunResults]) -> list[Panel]:
    """Diagrams of all that the runs have: lines that move, then flow and pressure of each opening over time."""
    found = []
    for attribute, quantity, words, heading in MOVING:
        panel = Panel(heading, ("z", "mm"), (words, ""))
        for place, run in enumerate(runs):
            interruption.check()
            line: Line | None = getattr(run, attribute)
            if line is not None and quantity in line.values:
                panel.y = (words, line.units[quantity])
                panel.lines.append(MovingLine(place, line.times, line.s, line[quantity]))
        found.append(panel)
    for name in names_of(runs, "lines"):
        found += line_panels(runs, name)
    for name in names_of(runs, "openings"):
        for attribute, words, unit in OF_OPENINGS:
            panel = Panel(f"{words[0].upper()}{words[1:]}: {name}", ("time", "ms"), (words, unit))
            for place, run in enumerate(runs):
                if name in run.openings:
                    opening = run.openings[name]
                    values = getattr(opening, attribute)
                    if values is not None:
                        panel.series.append(Series(place, opening.time, values))
            found.append(panel)
    for kind, columns in OF_PLACES.items():
        for name in names_of(runs, kind):
            for column in columns:
                found.append(place_panel(runs, kind, name, column))
    return found


def line_panels(runs: Sequence[RunResults], name: str) -> list[Panel]:
    """Diagrams of a line that the cases ask for: its scalars, and the magnitudes of its vectors."""
    made: dict[str, Panel] = {}
    for place, run in enumerate(runs):
        if name not in run.lines:
            continue
        line = run.lines[name]
        parts = [vector + end for vector in line.vectors for end in VECTOR]
        values = {quantity: line[quantity] for quantity in line.values if quantity not in parts}
        units = {quantity: line.units[quantity] for quantity in values}
        for vector in line.vectors:
            values[vector], units[vector] = line.magnitude(vector), line.units[vector + VECTOR[0]]
        for quantity, numbers in values.items():
            words = quantity.replace("_", " ")
            heading = f"{words.capitalize()} along the line {name}"
            panel = made.setdefault(quantity, Panel(heading, ("distance", "mm"), (words, units[quantity])))
            panel.lines.append(MovingLine(place, line.times, line.s, numbers))
    return list(made.values())


def place_panel(runs: Sequence[RunResults], kind: str, name: str, column: str) -> Panel:
    """A column of the table of one point or plane, over time."""
    words = column.replace("_", " ")
    panel = Panel(f"{words.capitalize()}: {kind[:-1]} {name}", ("time", "ms"), (words, ""))
    for place, run in enumerate(runs):
        table = getattr(run, kind).get(name)
        if table is not None and column in table:
            panel.y = (words, table.unit(column))
            panel.series.append(Series(place, table["time"], table[column]))
    return panel


def names_of(runs: Sequence[RunResults], kind: str) -> list[str]:
    """Names of the lines, openings, points or planes of all runs, in the order in which they come."""
    return list(dict.fromkeys(name for run in runs for name in getattr(run, kind)))


def picture_times(lines: Sequence[MovingLine]) -> list[float]:
    """Levels of the first line, evenly spread over what all lines cover; none where they have no time in common."""
    first, last = max(line.times[0] for line in lines), min(line.times[-1] for line in lines)
    levels = [float(t) for t in lines[0].times if first <= t <= last]
    if len(levels) <= PICTURES:
        return levels
    return [levels[round(i * (len(levels) - 1) / PICTURES)] for i in range(1, PICTURES + 1)]


def line_figure(panel: Panel, labels: Sequence[str], times: Sequence[float], static: bool) -> Figure:
    """Curves keep the line styles of their runs' places in the player."""
    waves = [PressureWaves(line.times, line.x, line.values) for line in panel.lines]
    runs = [line.run for line in panel.lines]
    y, x = (f"{quantity} in {unit}" if unit else quantity for quantity, unit in (panel.y, panel.x))
    return pressure_figure(waves, [labels[run] for run in runs], times, panel.title, y, x, runs, static)


def series_figure(shown: Sequence[Panel], labels: Sequence[str]) -> Figure:
    """Two diagrams a row."""
    rows = -(-len(shown) // 2)
    figure = Figure(figsize=(2 * PANEL_INCHES[0], rows * PANEL_INCHES[1]))
    FigureCanvasAgg(figure)
    grid: np.ndarray = figure.subplots(rows, 2, squeeze=False)
    for axes in grid.flat[len(shown) :]:
        axes.set_visible(False)
    handles = {}
    for axes, panel in zip(grid.flat, shown):
        for one in panel.series:
            style = LINES[one.run % len(LINES)]
            handles[labels[one.run]] = axes.plot(one.times, one.values, label=labels[one.run], **style)[0]
        axes.set_title(panel.title)
        axes.set_xlabel(f"{panel.x[0]} in {panel.x[1]}")
        axes.set_ylabel(f"{panel.y[0]} in {panel.y[1]}")
    return finish(figure, list(handles.values()), list(handles), "Over time")
