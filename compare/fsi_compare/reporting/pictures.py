"""Pictures of the pressure waves, laid out like the paper's figures: one panel per time, one line style per run."""

import textwrap
import warnings
from pathlib import Path
from typing import Any, Callable, Sequence

from matplotlib.artist import Artist
import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..base import interruption
from ..base.errors import shortened
from ..base.files import replacing
from ..results.units import time_words
from ..runs.pressure_waves import PressureWaves
from .coinciding import labels_that_say_so

DPI = 200
PICTURE_DPI = 150
LONGEST_TEXT = 500  # characters of a heading or a label: what is longer would make a picture of its own
PANEL_INCHES = (3.7, 2.15)

# Told apart without colour: by dash pattern and by lightness. The first run is drawn broad and dark and the others
# narrower and lighter on top of it, so that curves that coincide are all seen.
LINES = (
    {"linestyle": "-", "color": "#000000", "linewidth": 2.0},
    {"linestyle": "--", "color": "#e8871e", "linewidth": 1.4},
    {"linestyle": "-.", "color": "#2c6fbb", "linewidth": 1.4},
    {"linestyle": ":", "color": "#b02a5b", "linewidth": 1.8},
    {"linestyle": (0, (7, 2)), "color": "#5fa55a", "linewidth": 1.1},
    {"linestyle": (0, (4, 1, 1, 1, 1, 1)), "color": "#6a4c93", "linewidth": 1.1},
)

# Nothing of the day or the version of a program: the same data give the same file.
METADATA: dict[str, dict[str, None]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}

# Whatever the user's own matplotlib settings say, the same data give the same picture, byte by byte.
STYLE: dict[str, Any] = {"font.family": ["DejaVu Sans", "sans-serif"], "font.size": 9, "axes.titlesize": 9}
STYLE |= {"axes.grid": True, "axes.spines.top": False, "axes.spines.right": False}
STYLE |= {"grid.color": "#dddddd", "grid.linewidth": 0.5, "legend.frameon": False, "legend.handlelength": 3.4}
STYLE |= {"lines.scale_dashes": True, "svg.fonttype": "none", "svg.hashsalt": "fsi-compare"}


def write_figure(folder: Path, stem: str, draw: Callable[[], Figure]) -> list[Path]:
    """Writes `stem.png` and `.svg` of the figure that `draw` makes."""
    paths = [folder / f"{stem}.png", folder / f"{stem}.svg"]
    _save(paths, draw, DPI)
    return paths


def write_plot(path: Path, draw: Callable[[], Figure]) -> Path:
    """Writes the picture in the format of the file's suffix: .png, .svg or .pdf."""
    _save([path], draw, PICTURE_DPI)
    return path


def _save(paths: Sequence[Path], draw: Callable[[], Figure], dpi: int) -> None:
    with matplotlib.rc_context(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing")
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(STYLE)
        interruption.check()
        figure = draw()
        for path in paths:
            metadata = METADATA[path.suffix]
            with replacing(path) as temporary:
                figure.savefig(temporary, dpi=dpi, format=path.suffix[1:], metadata=metadata)


def pressure_figure(
    waves: Sequence[PressureWaves],
    labels: Sequence[str],
    times: Sequence[float],
    title: str,
    quantity: str = "pressure in Pa",
    place: str = "z in mm",
    styles: Sequence[int] = (),
    static: bool = False,
) -> Figure:
    """One panel per time, in reading order; the legend has its own strip below the panels. `styles`: numbers of the
    runs' line styles; without them those of their places."""
    columns = 1 if len(times) == 1 else 2 if len(times) <= 8 else 3
    rows = -(-len(times) // columns)
    width = columns * PANEL_INCHES[0] + (1.5 if columns == 1 else 0)
    figure = Figure(figsize=(width, rows * PANEL_INCHES[1]))
    grid = figure.subplots(rows, columns, squeeze=False)
    for axes in grid.flat[len(times) :]:
        axes.set_visible(False)
    for axes, time in zip(grid.flat, times):
        for i, (wave, label, style) in enumerate(zip(waves, labels, styles or range(len(waves)))):
            axes.plot(wave.z, wave.at(time), label=label, zorder=2 + 0.01 * i, **LINES[style % len(LINES)])
        axes.axhline(0, color="#999999", linewidth=0.6, zorder=1)
        axes.set_title(time_words(time_text(time), static, "t = "))
        axes.set_xlim(min(wave.z[0] for wave in waves), max(wave.z[-1] for wave in waves))
        axes.xaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 3, 5, 10]))
        axes.set_xlabel(place)
        axes.set_ylabel(quantity)
    _share_scales(grid, len(times))
    panels = [axes.get_lines()[: len(waves)] for axes in grid.flat[: len(times)]]
    return finish(figure, panels[0], labels_that_say_so(labels, panels), title, (width, rows * PANEL_INCHES[1]))


def finish(
    figure: Figure, handles: Sequence[Artist], labels: Sequence[str], title: str, panels: Sequence[float] = ()
) -> Figure:
    """The figure, done: puts the heading above the panels and the legend below them, each in a strip of its own so that
    it covers no curve, and sets the figure's size; `panels` are width and height of the panels together, in inches: the
    figure's own unless they are given."""
    width, panels_inches = panels or figure.get_size_inches()
    legend_inches = _place_legend(figure, handles, labels, width)
    title = "\n".join(textwrap.wrap(_plain(title), int(14 * width)))
    title_inches = 0.14 + 0.18 * len(title.splitlines())
    height = panels_inches + legend_inches + title_inches
    figure.set_size_inches(width, height)
    heading = figure.suptitle(title, y=1 - 0.08 / height, va="top", fontsize=10)
    heading.set_in_layout(False)  # its strip is reserved by rect
    figure.tight_layout(rect=(0, legend_inches / height, 1, 1 - title_inches / height), h_pad=0.8, w_pad=1.2)
    figure.legends[0].set_bbox_to_anchor((0.5, 0.06 / height), transform=figure.transFigure)
    return figure


def time_text(time: float) -> str:
    """1.5 -> '1.50', as in the paper; more digits only where they are needed."""
    text = f"{time:.2f}"
    return text if abs(float(text) - time) < 1e-9 else f"{time:g}"


def _share_scales(grid: np.ndarray, panels: int) -> None:
    """Panels of a row share the pressure axis unless that would squeeze one of them below a third of its height: the
    pulse decays fast at first, and a flat line shows nothing."""
    columns = grid.shape[1]
    for row in range(grid.shape[0]):
        shown = [grid[row, i] for i in range(columns) if row * columns + i < panels]
        limits = [axes.get_ylim() for axes in shown]
        low, high = min(l for l, _ in limits), max(h for _, h in limits)
        if all(h - l >= (high - low) / 3 for l, h in limits):
            for axes in shown:
                axes.set_ylim(low, high)


def _place_legend(figure: Figure, handles: Sequence[Artist], labels: Sequence[str], width: float) -> float:
    """Puts the legend at the bottom with as many columns as fit the width; returns the strip's height in inches."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    labels = ["\n".join(textwrap.wrap(_plain(label), int(12 * width))) for label in labels]
    for columns in range(min(len(labels), 4), 0, -1):
        legend = figure.legend(handles, labels, loc="lower center", ncol=columns, borderaxespad=0.0)
        box = legend.get_window_extent(renderer)
        if box.width <= 0.98 * width * figure.dpi or columns == 1:
            return box.height / figure.dpi + 0.12
        legend.remove()
    raise AssertionError("one column always ends the search")


def _plain(text: str) -> str:
    """Text that matplotlib shows as it stands: no formulas, and no label that it takes for a hidden one."""
    text = shortened(text, LONGEST_TEXT).replace("$", r"\$")
    return " " + text if text.startswith("_") else text
