"""Pictures of the coupling study."""

from dataclasses import dataclass
from typing import Any, List, Mapping, Optional, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fsi_compare.reporting.coinciding import coinciding
from ..drawing.log_axes import log_axes
from fsi_compare.reporting.pictures import finish

OFF = {"linestyle": "none", "marker": "x", "color": "#000000", "markersize": 15, "markeredgewidth": 2.5, "zorder": 1.5}
BEST = (  # the three schemes that need the fewest passes
    {"linestyle": "-", "marker": "o", "color": "#000000", "linewidth": 1.6, "zorder": 3},
    {"linestyle": "--", "marker": "s", "color": "#b02a5b", "linewidth": 1.4, "zorder": 3.1},
    {"linestyle": "-.", "marker": "^", "color": "#2c6fbb", "linewidth": 1.2, "zorder": 3.2},
)
REST = {"linestyle": "-", "marker": None, "color": "#b0b0b0", "linewidth": 1.0, "zorder": 2}
NAME_SIZE, NAME_LINE = 7, 0.034  # points; of the height of the axes
NAMES_FROM = 0.66  # of the figure's width: what is right of it is for the names


@dataclass(frozen=True)
class Series:
    label: str
    x: Sequence[float]
    passes: Sequence[Optional[float]]  # None: failed
    off: Sequence[bool]  # it did not fail, and its answer is another than the monolithic one


def passes_figure(all_series: List[Series], xlabel: str, settings: Mapping[str, Any], bound: float) -> Figure:
    """Two logarithmic axes; above them a strip with a row per scheme that marks where it failed. Each line has its name
    at its right end; three have shapes. Answers further than `bound` from the monolithic ones are crossed out."""
    figure = Figure(figsize=(9.6, 6.2))
    strip, axes = figure.subplots(2, 1, sharex=True, height_ratios=[1.5, 3])
    best = fewest_passes(all_series)
    lines: List[Line2D] = []
    for i, line in enumerate(all_series):
        look: Any = dict(BEST[best.index(i)], markersize=5) if i in best else REST
        y = [float("nan") if value is None else value for value in line.passes]
        lines += axes.plot(line.x, y, **look)
        failed = [x for x, value in zip(line.x, line.passes) if value is None]
        strip.plot(failed, [i] * len(failed), linestyle="none", marker="x", color="#000000", markersize=5)
    wrong = [(x, value) for line in all_series for x, value, off in zip(line.x, line.passes, line.off) if off]
    crossed = axes.plot(*zip(*wrong), **OFF) if wrong else []
    axes.set_xlabel(xlabel)
    axes.set_ylabel("coupling iterations per step")
    log_axes(axes)
    _name_ends(axes, lines, [line.label for line in all_series])
    strip.set_ylim(len(all_series) - 0.4, -0.6)
    strip.set_yticks(range(len(all_series)), [line.label for line in all_series], fontsize=6.5)
    strip.set_title("failed", loc="left")
    handles = [lines[i] for i in best] + crossed
    labels = [all_series[i].label for i in best] + [f"off by more than {100 * bound:g} %"] * len(crossed)
    tolerance = settings.get("partitioned.tolerance", 1e-6)
    figure = finish(figure, handles, labels, f"Coupling iterations, tolerance {tolerance:g}")
    figure.subplots_adjust(right=NAMES_FROM)
    return figure


def fewest_passes(all_series: Sequence[Series]) -> List[int]:
    """At most three series: right at the most places, and of these with the fewest passes in all."""

    def worth(i: int) -> Any:
        right = [v for v, off in zip(all_series[i].passes, all_series[i].off) if v is not None and not off]
        return -len(right), sum(right)

    found = [i for i in sorted(range(len(all_series)), key=worth) if worth(i)[0] < 0]
    return sorted(found[: len(BEST)])


def _name_ends(axes: Axes, lines: Sequence[Line2D], labels: Sequence[str]) -> None:
    """Right of the axes, apart from each other; lines that lie on each other have their names below each other."""
    on = {i: group for group in coinciding([lines]) for i in group}
    texts = []
    for i, line in enumerate(lines):
        group = on.get(i, [i])
        points = [(x, y) for x, y in zip(line.get_xdata(), line.get_ydata()) if y == y]
        if points and i == group[0]:
            words = "\n= ".join(labels[k] for k in group)
            place = (axes.transScale + axes.transLimits).transform([points[-1]])[0]
            texts.append((float(place[1]), float(place[0]), words, line.get_color()))
    below = 2.0
    for height, across, words, color in sorted(texts, reverse=True):
        half = NAME_LINE * (words.count("\n") + 1) / 2
        middle = min(height, below - half)
        below = middle - half
        shade = "#606060" if color == REST["color"] else color
        name = axes.annotate(
            words,
            (across, height),
            (1.01, middle),
            xycoords="axes fraction",
            textcoords="axes fraction",
            fontsize=NAME_SIZE,
            color=shade,
            va="center",
            arrowprops={
                "arrowstyle": "-",
                "color": "#bbbbbb",
                "linewidth": 0.5,
                "shrinkA": 0,
                "shrinkB": 3,
                "relpos": (0, 0.5),
            },
        )
        name.set_in_layout(False)
