"""The map as pictures: a panel per quantity, a row per method, a column per value."""

import math
import textwrap
from typing import Any, Dict, List, Sequence, Set, Tuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from fsi_compare.reporting.pictures import finish
from ..evidence.cross_check import AGREES, DEVIATES, FAR, FAULTS, NOT_FINITE, UNCHECKED, USABLE, WRONG, Cell
from fsi_compare.study.study_file import show
from fsi_compare.study.study_run import CRASHED, NOT_CONVERGED, OUT_OF_TIME, REFUSED

CELL_INCHES = (0.92, 0.36)
MOST_ITERATIONS = 500.0  # darkest cell
# Told apart without colour: converged cells by lightness alone, all others by hatching and by what is written in them.
LOOK = {
    UNCHECKED: {"facecolor": "#ffffff", "edgecolor": "#555555", "hatch": "...."},
    DEVIATES: {"facecolor": "#ffffff", "edgecolor": "#555555", "hatch": "----"},
    FAR: {"facecolor": "#dddddd", "edgecolor": "#333333", "hatch": "----||||"},
    NOT_CONVERGED: {"facecolor": "#f6d5b8", "edgecolor": "#b06a2a", "hatch": "////"},
    OUT_OF_TIME: {"facecolor": "#e3d7ee", "edgecolor": "#6a4c93", "hatch": "\\\\\\\\"},
    REFUSED: {"facecolor": "#ffffff", "edgecolor": "#999999", "hatch": "xxxx"},
}
FAULT = {"facecolor": "#000000", "edgecolor": "#000000"}
WORDS = {WRONG: "WRONG", NOT_FINITE: "NaN", CRASHED: "CRASH"}


def map_figure(
    cells: Sequence[Cell], methods: Sequence[Tuple[str, str]], values: Sequence[Any], title: str, label: str, paper: Any
) -> Figure:
    """`methods` are (name, label), from top to bottom; `paper` is the value of the paper's case."""
    at: Dict[Tuple[str, Any], Cell] = {
        (cell.method, next(iter(cell.run.request.values.values()))): cell for cell in cells
    }
    longest = max(len(text) for _, text in methods)
    heads = [_head(value) for value in values]
    width = 0.5 + 0.075 * longest + CELL_INCHES[0] * len(values)
    height = 0.6 + 0.14 * max(head.count("\n") for head in heads) + CELL_INCHES[1] * len(methods)
    figure = Figure(figsize=(width, height))
    axes = figure.subplots()
    for row, (name, _) in enumerate(methods):
        for column, value in enumerate(values):
            cell = at.get((name, value))
            if cell is not None:
                _draw(axes, column, row, cell)
            else:
                axes.text(column + 0.5, row + 0.5, "not run", ha="center", va="center", fontsize=7.5, color="#777777")
    axes.set_xlim(0, len(values))
    axes.set_ylim(len(methods), 0)
    axes.set_xticks([i + 0.5 for i in range(len(values))], heads)
    axes.set_yticks([i + 0.5 for i in range(len(methods))], [text for _, text in methods])
    for tick, value in zip(axes.get_xticklabels(), values):
        tick.set_fontweight("bold" if value == paper else "normal")
    axes.set_xlabel(label + (" (bold: the paper's)" if paper in values else ""))
    axes.tick_params(length=0)
    axes.grid(False)
    for side in axes.spines.values():
        side.set_visible(False)
    handles, labels = _legend({cell.outcome for cell in cells})
    return finish(figure, handles, labels, title, (width, height))


def _head(value: Any) -> str:
    return "\n".join(textwrap.wrap(show(value), 11))


def shade(iterations: float) -> str:
    """White for one iteration a step to mid-grey blue for 500, by the logarithm: black text is readable on all."""
    part = min(1.0, math.log(max(iterations, 1.0)) / math.log(MOST_ITERATIONS))
    light, dark = (255, 255, 255), (120, 158, 196)
    return "#" + "".join(f"{round(a + part * (b - a)):02x}" for a, b in zip(light, dark))


def text_of(cell: Cell) -> str:
    """What is written in the cell."""
    if cell.outcome in FAULTS:
        return WORDS[cell.outcome]
    if cell.outcome in (AGREES, UNCHECKED):
        return f"{cell.run.passes:.1f}"
    if cell.outcome in (DEVIATES, FAR):
        assert cell.off is not None, "it deviates by what was measured"
        return f"off {100 * cell.off:.2g} %"
    if cell.outcome == NOT_CONVERGED:
        return f"\N{MULTIPLICATION SIGN} step {cell.levels + 1}"
    return f"time, step {cell.levels + 1}" if cell.outcome == OUT_OF_TIME else "refused"


def _draw(axes: Axes, column: int, row: int, cell: Cell) -> None:
    look = (
        FAULT
        if cell.outcome in FAULTS
        else LOOK.get(cell.outcome) or {"facecolor": shade(cell.run.passes), "edgecolor": "none"}
    )
    axes.add_patch(Rectangle((column + 0.02, row + 0.04), 0.96, 0.92, linewidth=0, zorder=1, **look))
    hatched = bool(look.get("hatch"))
    box = {"facecolor": "#ffffff", "edgecolor": "none", "pad": 1.2} if hatched else None
    axes.text(
        column + 0.5,
        row + 0.5,
        text_of(cell),
        ha="center",
        va="center",
        fontsize=7.5,
        zorder=2,
        bbox=box,
        color="#ffffff" if cell.outcome in FAULTS else "#000000",
        fontweight="bold" if cell.outcome in FAULTS else "normal",
    )


def _legend(outcomes: Set[str]) -> Tuple[List[Patch], List[str]]:
    handles = [Patch(facecolor=shade(n), edgecolor="#aaaaaa", linewidth=0.5) for n in (1, 30, 500)]
    labels = ["converged, 1 iteration a step", "30", "500"]
    names = {
        UNCHECKED: "converged, other driver did not",
        DEVIATES: "not iterated: off by",
        FAR: f"the same, more than {100 * USABLE:g} %",
        NOT_CONVERGED: "not converged in step",
        OUT_OF_TIME: "out of time in step",
        REFUSED: "refused",
    }
    for outcome, name in names.items():
        if outcome in outcomes:
            handles.append(Patch(linewidth=0.5, **LOOK[outcome]))
            labels.append(name)
    if outcomes & set(FAULTS):
        handles.append(Patch(**FAULT))
        labels.append("fault: wrong, not finite or crashed")
    return handles, labels
