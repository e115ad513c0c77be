"""Plots of runs for scripts and notebooks. Each draws into the axes that it is given, or into new ones, and returns
them; curves are told apart without colour, too."""

from typing import Any, Sequence

import matplotlib.pyplot as pyplot
from matplotlib.axes import Axes

from ..base.errors import InputError
from ..results.line import Line
from ..results.run import RunResults
from ..results.units import time_words
from .pictures import LINES

Runs = Sequence[RunResults]
OF_RUNS = ("centre_line", "wall_line")  # lines that are attributes of a run
TITLES = {"flow": "flow outwards in mm^3/ms", "mean_pressure": "mean pressure in Pa"}


def plot_line(
    runs: Runs, time: float, line: str = "centre_line", quantity: str = "pressure", axes: Axes | None = None
) -> Axes:
    """A quantity along a line at one time in ms, a curve for each run that has the line: `line` is 'centre_line'
    ('pressure'), 'wall_line' ('radial', 'axial') or a line of the case. Raises InputError when no run has it."""
    axes = axes or pyplot.subplots()[1]
    drawn = 0
    for run in runs:
        found: Line | None = getattr(run, line) if line in OF_RUNS else run.lines.get(line)
        if found is not None:
            axes.plot(found.s, found.at(time, quantity), label=run.label, **_style(drawn))
            axes.set_ylabel(f"{quantity} in {found.units[quantity]}")
            drawn += 1
    _require(drawn, line)
    axes.set_title(time_words(f"{time:g}", all(run.static for run in runs), "t = "))
    return _finished(axes, "z in mm" if line in OF_RUNS else f"mm along {line}")


def plot_openings(runs: Runs, quantity: str = "flow", axes: Axes | None = None) -> Axes:
    """'flow' (positive outwards) or 'mean_pressure' of all openings over time, a curve for each run and opening. Raises
    InputError when no run has openings."""
    axes = axes or pyplot.subplots()[1]
    if quantity not in TITLES:
        raise InputError("", "quantity", f"'{quantity}' is unknown", f"it must be {' or '.join(TITLES)}")
    drawn = 0
    for run in runs:
        for name, opening in run.openings.items():
            axes.plot(opening.time, getattr(opening, quantity), label=f"{run.label}: {name}", **_style(drawn))
            drawn += 1
    _require(drawn, "opening")
    axes.set_ylabel(TITLES[quantity])
    return _finished(axes, "time in ms")


def plot_energy(run: RunResults, columns: Sequence[str] = (), axes: Axes | None = None) -> Axes:
    """Columns of the energy balance over time, without names those that end in 'energy'. Raises InputError when the run
    has no such column."""
    axes = axes or pyplot.subplots()[1]
    energy = run.energy
    if energy is None:
        raise InputError(run.folder / "energy.csv", "", "no such file", "ask for it in the case")
    for place, name in enumerate(columns or [name for name in energy if name.endswith("energy")]):
        axes.plot(energy["time"], energy[name], label=name.replace("_", " "), **_style(place))
    axes.set_ylabel("energy in uJ")
    return _finished(axes, "time in ms")


def _finished(axes: Axes, along: str) -> Axes:
    axes.set_xlabel(along)
    axes.legend()
    return axes


def _style(place: int) -> Any:
    return LINES[place % len(LINES)]


def _require(drawn: int, what: str) -> None:
    if not drawn:
        raise InputError("", what, "is in none of the runs", "give runs that have written it")
