"""What of finished runs a report plays, and the pictures of the same that stay in print."""

from typing import Dict, List, Optional, Sequence, Tuple

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..base import interruption
from ..results.line import Line
from ..results.run import RunResults
from .pictures import LINES, PANEL_INCHES, finish, pressure_figure
from .player import MovingLine, Panel, Player, Series
from .report import Report

# (attribute of a run, quantity, its words, heading)
MOVING = (
    ("centre_line", "pressure", "pressure", "Pressure along the centre line"),
    ("wall_line", "radial", "radial displacement", "Radial displacement of the inner wall"),
    ("wall_line", "axial", "axial displacement", "Axial displacement of the inner wall"),
)
OF_OPENINGS = (("flow", "flow outwards", "mm^3/ms"), ("mean_pressure", "mean pressure", "Pa"))
PICTURES = 6  # times in a picture, where none are asked for


def add_waves(report: Report, runs: Sequence[RunResults], labels: Sequence[str], times: Sequence[float] = ()) -> None:
    """The player of these runs and its pictures; `times` in ms are those of the pictures. What no run has is left out."""
    report.player(Player(list(labels), panels(runs)))
    for attribute, quantity, words, heading in MOVING:
        found = lines_of(runs, labels, attribute, quantity)
        if not found:
            continue
        shown = list(times) or picture_times([line for _, line in found])
        if shown:
            waves = [line.waves(quantity) for _, line in found]
            label = f"{words} in {found[0][1].units[quantity]}"
            names = [name for name, _ in found]
            report.figure(
                f"{attribute}_{quantity}",
                lambda waves=waves, names=names, shown=shown, heading=heading, label=label: pressure_figure(  # type: ignore
                    waves, names, shown, heading, label
                ),
                f"{heading}.",
            )
    names = opening_names(runs)
    if names:
        report.figure(
            "openings", lambda: openings_figure(runs, labels, names), "Flow and mean pressure of each opening."
        )


def panels(runs: Sequence[RunResults]) -> List[Panel]:
    """Diagrams of all that the runs have: lines that move, then flow and pressure of each opening over time."""
    found = []
    for attribute, quantity, words, heading in MOVING:
        panel = Panel(heading, ("z", "mm"), (words, ""))
        for place, run in enumerate(runs):
            interruption.check()
            line: Optional[Line] = getattr(run, attribute)
            if line is not None and quantity in line.values:
                panel.y = (words, line.units[quantity])
                panel.lines.append(MovingLine(place, line.times, line.z, line[quantity]))
        found.append(panel)
    for name in opening_names(runs):
        for attribute, words, unit in OF_OPENINGS:
            panel = Panel(f"{words.capitalize()}: {name}", ("time", "ms"), (words, unit))
            for place, run in enumerate(runs):
                if name in run.openings:
                    opening = run.openings[name]
                    panel.series.append(Series(place, opening.time, getattr(opening, attribute)))
            found.append(panel)
    return found


def lines_of(
    runs: Sequence[RunResults], labels: Sequence[str], attribute: str, quantity: str
) -> List[Tuple[str, Line]]:
    """(label, line) of the runs that have the quantity."""
    pairs = [(label, getattr(run, attribute)) for run, label in zip(runs, labels)]
    return [(label, line) for label, line in pairs if line is not None and quantity in line.values]


def opening_names(runs: Sequence[RunResults]) -> List[str]:
    """Of all runs, in the order in which they come."""
    names: Dict[str, None] = {}
    for run in runs:
        names.update(dict.fromkeys(run.openings))
    return list(names)


def picture_times(lines: Sequence[Line]) -> List[float]:
    """Levels of the first line, evenly spread over what all lines cover; none where they have no time in common."""
    first, last = max(line.times[0] for line in lines), min(line.times[-1] for line in lines)
    levels = [float(t) for t in lines[0].times if first <= t <= last]
    if len(levels) <= PICTURES:
        return levels
    return [levels[round(i * (len(levels) - 1) / PICTURES)] for i in range(1, PICTURES + 1)]


def openings_figure(runs: Sequence[RunResults], labels: Sequence[str], names: Sequence[str]) -> Figure:
    """A row for each opening: its flow and its mean pressure over time."""
    width, height = 2 * PANEL_INCHES[0], len(names) * PANEL_INCHES[1]
    figure = Figure(figsize=(width, height))
    FigureCanvasAgg(figure)
    grid: np.ndarray = figure.subplots(len(names), 2, squeeze=False)
    handles = {}
    for row, name in zip(grid, names):
        for axes, (attribute, words, unit) in zip(row, OF_OPENINGS):
            for place, (run, label) in enumerate(zip(runs, labels)):
                if name in run.openings:
                    opening = run.openings[name]
                    style = LINES[place % len(LINES)]
                    handles[label] = axes.plot(opening.time, getattr(opening, attribute), label=label, **style)[0]
            axes.set_title(name)
            axes.set_xlabel("time in ms")
            axes.set_ylabel(f"{words} in {unit}")
    finish(figure, list(handles.values()), list(handles), "Openings", (width, height))
    return figure
