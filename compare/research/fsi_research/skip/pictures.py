"""What each economy saves, as bars."""

import math
from typing import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, NullFormatter

from ..drawing.log_axes import plain_number
from fsi_compare.reporting.pictures import finish

WITH = {"facecolor": "#303030", "edgecolor": "#303030"}
WITHOUT = {"facecolor": "#ffffff", "edgecolor": "#b06a2a", "hatch": "////"}
NOISE = (
    {"facecolor": "#b8b8b8", "edgecolor": "#b8b8b8"},
    {"facecolor": "#ffffff", "edgecolor": "#b8b8b8", "hatch": "...."},
)  # with, without
NOISE_TEXT = "#8c8c8c"
BAR = 0.36  # of a row


def bars_figure(measured: Sequence) -> Figure:
    """Left seconds, those that differ by noise alone in grey, right counts; `measured` from top to bottom."""
    figure = Figure(figsize=(9.4, 0.7 + 0.52 * len(measured)))
    left, right = figure.subplots(1, 2, sharey=True)
    _bars(left, [(m.on_s, m.off_s) for m in measured], [m.in_noise for m in measured])
    _bars(right, [(m.on_count or 0, m.off_count or 0) for m in measured], [False] * len(measured))
    left.set_xlabel("seconds of the run (log scale)")
    right.set_xlabel("counted work (log scale)")
    left.set_ylim(len(measured) - 0.4, -0.6)
    left.set_yticks(range(len(measured)), [f"{m.economy.label}\n({m.economy.counter})" for m in measured])
    for axes in (left, right):
        axes.tick_params(axis="y", length=0, labelsize=7.5)
        axes.grid(axis="y", visible=False)
        axes.set_axisbelow(True)
    handles, names = [Patch(**WITH), Patch(**WITHOUT)], ["with the economy", "switched off"]
    if any(m.in_noise for m in measured):
        handles += [Patch(**look) for look in NOISE]
        names += ["with, ratio in the noise", "switched off, ratio in the noise"]
    return finish(figure, handles, names, "The same scenes with and without each economy")


def _bars(axes: Axes, pairs: Sequence, in_noise: Sequence[bool]) -> None:
    shown = [value for pair in pairs for value in pair if value > 0]
    low = 10 ** math.floor(math.log10(min(shown)) - 0.3) if shown else 0.1
    high = max(shown) if shown else 1.0
    for row, (on, off) in enumerate(pairs):
        looks = NOISE if in_noise[row] else (WITH, WITHOUT)
        for value, offset, look in ((on, -0.5 * BAR, looks[0]), (off, 0.5 * BAR, looks[1])):
            if value > 0:
                axes.barh(row + offset, value - low, left=low, height=0.9 * BAR, linewidth=0.8, **look)
            else:
                axes.text(low * 1.1, row + offset, "none", va="center", fontsize=7)
        if on > 0 and off > 0:
            ratio = f"{off / on:.2f}x" if off < 10 * on else f"{off / on:.0f}x"
            axes.text(
                max(on, off) * 1.12,
                row + 0.5 * BAR,
                ratio,
                va="center",
                fontsize=7.5,
                color=NOISE_TEXT if in_noise[row] else "#000000",
            )
    axes.set_xscale("log")
    axes.set_xlim(low, high * 4)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: plain_number(value)))
    axes.xaxis.set_minor_formatter(NullFormatter())
