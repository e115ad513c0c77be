"""Iterations and cost against the number of unknowns."""

from pathlib import Path
from typing import Any, Dict, List, Sequence, Tuple

from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from ..catalogue import paper
from ..catalogue.names import BLOCK_PRECONDITIONERS, EXACT, MATERIALS, MULTILEVEL
from ..drawing.coinciding import note_coinciding
from ..drawing.log_axes import log_axes, plain_log_axis
from fsi_compare.reporting.pictures import finish, write_figure
from .results import System
from .grid import Grid, suffix

# By material: dash pattern, marker and lightness differ, so that they are told apart in grey. Later ones are narrower,
# so that curves that coincide are all seen.
MATERIAL_LINES: Dict[str, Dict[str, Any]] = {
    "neo-hookean": {"linestyle": "-", "marker": "o", "color": "#000000", "linewidth": 2.4, "markersize": 7},
    "mooney-rivlin": {"linestyle": "--", "marker": "s", "color": "#e8871e", "linewidth": 1.6, "markersize": 4.5},
    "artery": {"linestyle": "-.", "marker": "^", "color": "#2c6fbb", "linewidth": 1.0, "markersize": 3},
}
PAPER_LINE: Dict[str, Any] = {"linestyle": (0, (1, 2)), "linewidth": 0.8, "markerfacecolor": "none", "markersize": 9}
# By mesh, from light to dark.
MESH_MARKS: Dict[str, Dict[str, Any]] = {
    "coarse": {"marker": "o", "markerfacecolor": "#ffffff"},
    "intermediate": {"marker": "s", "markerfacecolor": "#a9cbe8"},
    "fine": {"marker": "D", "markerfacecolor": "#2c4a6e"},
}
PANEL_INCHES = (2.9, 2.2)


def write_solver_pictures(folder: Path, grid: Grid) -> List[Path]:
    """For each system `iterations_*` and `cost_*` as PNG and SVG; none for which nothing has converged."""

    def anything(key: System, methods: Sequence[str], quantity: str) -> bool:
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
    panels = figure.subplots(rows, columns, squeeze=False)
    for axes in panels.flat[len(methods) :]:
        axes.set_visible(False)
    for axes, method in zip(panels.flat, methods):
        own = []
        for material in grid.materials:
            own += axes.plot(*_columns(_curve(grid, material, key, method, "iterations")), **MATERIAL_LINES[material])
            axes.plot(*_columns(_paper_points(grid.meshes, material, method)), **_paper_line(material))
        axes.set_title(method)
        log_axes(axes, least=(12, 4))
        low, high = axes.get_xlim()
        if high > 30 * low:  # numbers of five digits between powers of ten would touch in so small a panel
            axes.xaxis.set_major_locator(LogLocator(subs=(1,)))
        note_coinciding(axes, own, [MATERIALS[material] for material in grid.materials])
        axes.set_xlabel("unknowns")
        axes.set_ylabel("iterations")
    handles, labels = [], []
    for material in grid.materials:
        handles += [Line2D([], [], **MATERIAL_LINES[material]), Line2D([], [], **_paper_line(material))]
        labels += [MATERIALS[material], f"{MATERIALS[material]}, paper{'' if key == (1, 1) else ' (first system)'}"]
    return finish(
        figure,
        handles,
        labels,
        f"Iterations, {grid.heading(key)}",
        (max(columns * PANEL_INCHES[0], 4.5), rows * PANEL_INCHES[1]),
    )


def cost_figure(grid: Grid, key: System) -> Figure:
    """Work units above and seconds below, one column per material. A line for each method, named beside it, with a mark
    per mesh: as curves they would lie on each other."""
    methods = [method for method in grid.methods if method not in EXACT.values()]
    quantities = (("work_units", "work units of the solve"), ("total_seconds", "set-up and solve in s"))
    columns = len(grid.materials)
    figure = Figure(figsize=(columns * PANEL_INCHES[0] + 1.2, len(quantities) * (0.8 + 0.2 * len(methods))))
    panels = figure.subplots(len(quantities), columns, squeeze=False, sharex="row", sharey=True)
    for row, (quantity, name) in zip(panels, quantities):
        for axes, material in zip(row, grid.materials):
            for mesh in grid.meshes:
                axes.plot(
                    *_columns(_points(grid, material, mesh, key, methods, quantity)),
                    linestyle="none",
                    **_mesh_mark(mesh),
                )
            axes.set_xscale("log")
            axes.set_xlabel(name)
    for row, _ in zip(panels, quantities):
        for axes in row:
            plain_log_axis(axes.xaxis)
    panels[0, 0].set_yticks(range(len(methods)), methods)
    panels[0, 0].set_ylim(len(methods) - 0.4, -0.6)
    for axes, material in zip(panels[0], grid.materials):
        axes.set_title(MATERIALS[material])
    handles = [Line2D([], [], linestyle="none", **_mesh_mark(mesh)) for mesh in grid.meshes]
    return finish(figure, handles, [f"{mesh} mesh" for mesh in grid.meshes], f"Cost, {grid.heading(key)}")


def _mesh_mark(mesh: str) -> dict:
    return {"markersize": 5, "color": "#000000", "markeredgewidth": 0.8, **MESH_MARKS[mesh]}


def _points(
    grid: Grid, material: str, mesh: str, key: System, methods: Sequence[str], quantity: str
) -> List[Tuple[float, float]]:
    """(value, line) of the methods that have converged; the axis is logarithmic."""
    solves = [(grid.entry(material, mesh, key, method).solve, line) for line, method in enumerate(methods)]
    values = [(getattr(solve, quantity), line) for solve, line in solves if solve is not None]
    return [(value, line) for value, line in values if value is not None and value > 0]


def _paper_line(material: str) -> dict:
    return {**PAPER_LINE, **{name: MATERIAL_LINES[material][name] for name in ("marker", "color")}}


def _counted(grid: Grid) -> List[str]:
    """Methods whose iterations mean something; those with exact sub-solves stay in the table."""
    return [name for name in grid.methods if name in (*BLOCK_PRECONDITIONERS, *MULTILEVEL, "fast", "petsc")]


def _curve(grid: Grid, material: str, key: System, method: str, quantity: str) -> List[Tuple[float, float]]:
    """(unknowns, value) of the meshes where the method has converged."""
    points: List[Tuple[float, float]] = []
    for mesh in grid.meshes:
        solve = grid.entry(material, mesh, key, method).solve
        system = grid.system(material, mesh, key)
        if solve is None or system is None:
            continue
        value = getattr(solve, quantity)
        if value is not None and value > 0:  # the axes are logarithmic
            points.append((system.unknowns["total"], value))
    return points


def _paper_points(meshes: Sequence[str], material: str, method: str) -> List[Tuple[float, float]]:
    """(unknowns, iterations) of the meshes for which the paper has both."""
    points = [(paper.unknowns(mesh), paper.iterations(method, material, mesh)) for mesh in meshes]
    return [(unknowns, count) for unknowns, count in points if unknowns is not None and count is not None]


def _columns(points: Sequence[Tuple[float, float]]) -> Tuple[List[float], List[float]]:
    return [x for x, _ in points], [y for _, y in points]
