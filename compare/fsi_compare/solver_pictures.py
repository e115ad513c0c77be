"""Iterations and cost against the number of unknowns."""

from pathlib import Path
from typing import List, Sequence, Tuple

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from . import paper
from .linear_solvers import System
from .names import BLOCK_PRECONDITIONERS, MATERIALS, MULTILEVEL
from .pictures import finish, write_figure
from .solver_tables import Grid, suffix

# By material: dash pattern, marker and lightness differ, so that they are told apart in grey. Later ones are narrower, so
# that curves that coincide are all seen.
MATERIAL_LINES = {
    "neo-hookean": {"linestyle": "-", "marker": "o", "color": "#000000", "linewidth": 2.4, "markersize": 7},
    "mooney-rivlin": {"linestyle": "--", "marker": "s", "color": "#e8871e", "linewidth": 1.6, "markersize": 4.5},
    "artery": {"linestyle": "-.", "marker": "^", "color": "#8fc1f0", "linewidth": 1.0, "markersize": 3},
}
PAPER_LINE = {"linestyle": (0, (1, 2)), "linewidth": 0.8, "markerfacecolor": "none", "markersize": 9}
# By method: one colour to a family, one dash pattern and marker to a method; AMG broad and light below AMLI, which
# often coincides with it.
_BLOCK, _AMG, _AMLI = "#e8871e", "#7fb0e0", "#7a2150"
METHOD_LINES = {
    "direct": {"linestyle": ":", "marker": "x", "color": "#000000"},
    "fast": {"linestyle": "-", "marker": "*", "color": "#000000", "linewidth": 2.2, "markersize": 9},
    "diagonal": {"linestyle": "-", "marker": "o", "color": _BLOCK},
    "lower": {"linestyle": "--", "marker": "v", "color": _BLOCK},
    "upper": {"linestyle": "-.", "marker": "^", "color": _BLOCK},
    "ssor": {"linestyle": (0, (6, 2)), "marker": "s", "color": _BLOCK},
    "ilu": {"linestyle": ":", "marker": "D", "color": _BLOCK},
    "amg": {"linestyle": "-", "marker": "P", "color": _AMG, "linewidth": 2.2, "markersize": 7},
    "amg_gmres": {"linestyle": "--", "marker": "<", "color": _AMG, "linewidth": 2.2, "markersize": 7},
    "amg_fgmres": {"linestyle": "-.", "marker": ">", "color": _AMG, "linewidth": 2.2, "markersize": 7},
    "amli": {"linestyle": "-", "marker": "X", "color": _AMLI},
    "amli_gmres": {"linestyle": "--", "marker": "h", "color": _AMLI},
    "amli_fgmres": {"linestyle": "-.", "marker": "d", "color": _AMLI},
}
PANEL_INCHES = (2.9, 2.2)


def write_solver_pictures(folder: Path, grid: Grid) -> List[Path]:
    """For each system `iterations_*` and `cost_*` as PNG and SVG; none for which nothing has converged."""
    def anything(key, methods, quantity):
        return any(_curve(grid, material, key, method, quantity) for material in grid.materials for method in methods)

    written = []
    for key in grid.systems:
        if anything(key, _counted(grid), "iterations"):
            written += write_figure(folder, f"iterations_{suffix(key)}", lambda: iterations_figure(grid, key))
        if anything(key, grid.methods, "solve_seconds"):
            written += write_figure(folder, f"cost_{suffix(key)}", lambda: cost_figure(grid, key))
    return written


def iterations_figure(grid: Grid, key: System) -> Figure:
    """One panel per method, one curve per material; the paper's counts as open markers, at its own numbers of
    unknowns. A point that is missing did not converge or was not run."""
    methods = _counted(grid)
    columns = min(3, len(methods))
    rows = -(-len(methods) // columns)
    figure = Figure(figsize=(columns * PANEL_INCHES[0], rows * PANEL_INCHES[1]))
    canvas = FigureCanvasAgg(figure)
    panels = figure.subplots(rows, columns, squeeze=False)
    for axes in panels.flat[len(methods):]:
        axes.set_visible(False)
    for axes, method in zip(panels.flat, methods):
        for material in grid.materials:
            axes.plot(*_columns(_curve(grid, material, key, method, "iterations")), **MATERIAL_LINES[material])
            theirs = [(paper.unknowns(mesh), paper.iterations(method, material, mesh)) for mesh in grid.meshes]
            axes.plot(*_columns([point for point in theirs if None not in point]), **_paper_line(material))
        axes.set_title(method)
        _log_axes(axes)
        axes.set_xlabel("unknowns")
        axes.set_ylabel("iterations")
    handles, labels = [], []
    for material in grid.materials:
        handles += [Line2D([], [], **MATERIAL_LINES[material]), Line2D([], [], **_paper_line(material))]
        labels += [MATERIALS[material], f"{MATERIALS[material]}, paper{'' if key == (1, 1) else ' (first system)'}"]
    finish(figure, canvas, handles, labels, f"Iterations, {grid.heading(key)}",
           (max(columns * PANEL_INCHES[0], 4.5), rows * PANEL_INCHES[1]))
    return figure


def cost_figure(grid: Grid, key: System) -> Figure:
    """Work units above and seconds below, one column per material, one curve per method."""
    methods = [method for method in grid.methods if method in METHOD_LINES]
    quantities = (("work_units", "work units of the solve"), ("solve_seconds", "solve in s"),
                  ("total_seconds", "set-up and solve in s"))
    columns = len(grid.materials)
    size = (PANEL_INCHES[0] + (1.6 if columns == 1 else 0.3), PANEL_INCHES[1] + 0.4)
    figure = Figure(figsize=(columns * size[0], len(quantities) * size[1]))
    canvas = FigureCanvasAgg(figure)
    panels = figure.subplots(len(quantities), columns, squeeze=False, sharex="col", sharey="row")
    for row, (quantity, name) in zip(panels, quantities):
        for axes, material in zip(row, grid.materials):
            for method in methods:
                axes.plot(*_columns(_curve(grid, material, key, method, quantity)),
                          **{"linewidth": 1.2, "markersize": 5, **METHOD_LINES[method]})
        for axes in row:  # only now: the first limits set would hold for the whole row
            _log_axes(axes)
        row[0].set_ylabel(name)
    for axes, material in zip(panels[0], grid.materials):
        axes.set_title(MATERIALS[material])
    for axes in panels[-1]:
        axes.set_xlabel("unknowns")
    handles = [Line2D([], [], **{"linewidth": 1.2, "markersize": 5, **METHOD_LINES[method]}) for method in methods]
    finish(figure, canvas, handles, methods, f"Cost, {grid.heading(key)}", (columns * size[0], len(quantities) * size[1]))
    return figure


def _paper_line(material: str) -> dict:
    return {**PAPER_LINE, **{name: MATERIAL_LINES[material][name] for name in ("marker", "color")}}


def _counted(grid: Grid) -> List[str]:
    """Methods whose iterations mean something; those with exact sub-solves stay in the table."""
    return [name for name in grid.methods if name in (*BLOCK_PRECONDITIONERS, *MULTILEVEL, "fast")]


def _curve(grid: Grid, material: str, key: System, method: str, quantity: str) -> List[Tuple[float, float]]:
    """(unknowns, value) of the meshes where the method has converged."""
    points = []
    for mesh in grid.meshes:
        solve = grid.entry(material, mesh, key, method).solve
        if solve is None:
            continue
        value = getattr(solve, quantity)
        if value is not None and value > 0:  # the axes are logarithmic
            points.append((grid.system(material, mesh, key).unknowns["total"], value))
    return points


def _columns(points: Sequence[Tuple[float, float]]):
    return [x for x, _ in points], [y for _, y in points]


def _log_axes(axes) -> None:
    """Logarithmic axes: at least one decade of unknowns, so that there is a tick, and a factor of 4 of values, so that one
    iteration more looks like no more."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.margins(x=0.12, y=0.15)
    axes.set_xlim(_widened(*axes.get_xlim(), 12))
    low, high = _widened(*axes.get_ylim(), 4)
    axes.set_ylim(low, high)
    subs = (1, 2, 3, 5, 7) if high < 12 * low else (1, 2, 5) if high < 150 * low else (1,)
    axes.yaxis.set_major_locator(LogLocator(subs=subs, numticks=20))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda y, _: f"{y:g}"))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_locator(NullLocator())


def _widened(low: float, high: float, factor: float) -> Tuple[float, float]:
    middle = (low * high) ** 0.5
    return (low, high) if high >= factor * low else (middle / factor ** 0.5, middle * factor ** 0.5)
