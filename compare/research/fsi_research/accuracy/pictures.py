"""Pictures of the accuracy-cost study: work against precision, and errors against element size and time step."""

from typing import Callable, List, Mapping, Sequence, Set, Tuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fsi_compare.reporting.coinciding import labels_that_say_so
from ..drawing.log_axes import log_axes, plain_log_axis
from fsi_compare.reporting.pictures import finish
from ..drawing.point_names import name_points
from fsi_compare.runs.waves import QUANTITIES, Quantity
from .convergence import SPACE, Series
from .frontier import frontier
from .measured import GAIN, Measured

REST, ON_FRONTIER = "#c4c4c4", "#000000"
FILLS = {
    "monolithic": ON_FRONTIER,
    "block": "#8a8a8a",
    "interface": "#ffffff",
}  # by kind of coupling; others as the last
WIDE_INCHES = (7.4, 3.3)  # of a panel whose points are named
AXES_PART = (0.86, 0.72)  # of it, that its axes take
PANEL_INCHES = (4.4, 3.6)
FLOOR = 1e-5  # %, below which a solver's error is drawn as this
NAMED_SERIES = (
    {"linestyle": "-", "marker": "o", "color": "#000000"},
    {"linestyle": "--", "marker": "s", "color": "#b02a5b"},
    {"linestyle": "-.", "marker": "^", "color": "#2c6fbb"},
)
SLOPES = {"first order": ":", "second order": "--"}
OTHER_SERIES = {"linestyle": "-", "linewidth": 0.9, "color": "#c4c4c4", "zorder": 1.5}


def work_precision(measured: Sequence[Measured], title: str) -> Figure:
    """Total error against seconds, a panel per quantity: the frontier is named, all other settings are grey."""
    figure, panels = _panels(len(QUANTITIES), WIDE_INCHES, 1)
    shown: Set[str] = set()
    for axes, quantity in zip(panels, QUANTITIES):
        points = [(m.seconds, 100 * m.total[quantity.column]) for m in measured]
        axes.set_title(quantity.name)
        axes.set_ylabel("error in % of the reference")
        shown |= _frontier(axes, points, measured, _setting(measured), GAIN)
    return finish(figure, *_kinds(shown), title)


def algebraic_work_precision(groups: Mapping[str, Sequence[Measured]], quantity: Quantity, title: str) -> Figure:
    """Error of stopping early against seconds, a panel per mesh and step: the frontier is named, grey lines join
    tolerances."""
    figure, panels = _panels(len(groups), WIDE_INCHES, 1)
    shown: Set[str] = set()
    for axes, (name, group) in zip(panels, groups.items()):
        points = [(m.seconds, max(100 * m.algebraic[quantity.column], FLOOR)) for m in group]
        for label in dict.fromkeys(m.run.method_label for m in group):
            own = sorted((p for p, m in zip(points, group) if m.run.method_label == label), key=lambda p: p[1])
            axes.plot([x for x, _ in own], [y for _, y in own], color=REST, linewidth=0.8, zorder=1)
        axes.set_title(name, wrap=True)
        axes.set_ylabel("error in % of the tight solution")
        shown |= _frontier(axes, points, group, lambda m: m.solving, 0.0)
    return finish(figure, *_kinds(shown), title)


def _setting(measured: Sequence[Measured]) -> Callable[[Measured], str]:
    """Mesh and step of a run, with the method where there are several for one driver."""
    methods = {(m.partitioned, m.run.method_label) for m in measured}
    several = {driver for driver in (True, False) if sum(1 for own, _ in methods if own == driver) > 1}

    def words(m: Measured) -> str:
        method = [m.run.method_label] if m.partitioned in several else []
        return ", ".join([f"{m.mesh_label} mesh", f"{m.step:g} ms", *method])

    return words


def orders(series: Sequence[Series], what: str, title: str) -> Figure:
    """Distance of each solution from the next finer one against its size, a panel per quantity. The longest three
    series have names; the others are grey, and in the table."""
    figure, panels = _panels(len(QUANTITIES), PANEL_INCHES, 2)
    longest = sorted(range(len(series)), key=lambda i: -len(series[i].sizes))[: len(NAMED_SERIES)]
    named = sorted(longest)
    drawn: List[List[Line2D]] = []
    for axes, quantity in zip(panels, QUANTITIES):
        drawn.append([])
        for i, one in enumerate(series):
            look = dict(NAMED_SERIES[named.index(i)], markersize=5, linewidth=1.3) if i in named else OTHER_SERIES
            ys = [100 * d for d in one.distances[quantity.column]]
            (line,) = axes.plot([_size(one, j) for j in range(len(ys))], ys, **look)
            if i in named:
                drawn[-1].append(line)
        _slopes(axes)
        axes.set_title(quantity.name)
        axes.set_ylabel("difference from the next finer")
        axes.set_xlabel("element size, (nodes of the finest / nodes)$^{1/3}$" if what == SPACE else "time step")
        log_axes(axes, "" if what == SPACE else "ms", "%")
    slopes = [Line2D([], [], color="#777777", linewidth=0.8, linestyle=style) for style in SLOPES.values()]
    labels = labels_that_say_so([series[i].fixed for i in named], drawn)
    return finish(figure, [*drawn[0], *slopes], [*labels, *SLOPES], title)


def _size(one: Series, j: int) -> float:
    return one.sizes[j] / one.sizes[-1] if one.what == SPACE else one.sizes[j]


def _slopes(axes: Axes) -> None:
    """Lines of first and second order through the picture's middle, for the eye."""
    xs = [x for line in axes.get_lines() for x in line.get_xdata() if x > 0]
    ys = [y for line in axes.get_lines() for y in line.get_ydata() if y > 0]
    if not xs or not ys:
        return
    x, y = (min(xs) * max(xs)) ** 0.5, (min(ys) * max(ys)) ** 0.5
    ends = (min(xs), max(xs)) if max(xs) > min(xs) else (0.7 * x, 1.4 * x)
    for order, style in zip((1, 2), SLOPES.values()):
        axes.plot(
            ends, [y * (end / x) ** order for end in ends], color="#777777", linewidth=0.8, linestyle=style, zorder=1
        )


def _panels(count: int, inches: Tuple[float, float], most: int) -> Tuple[Figure, List[Axes]]:
    columns = min(most, count)
    rows = -(-count // columns)
    figure = Figure(figsize=(columns * inches[0], rows * inches[1]))
    panels = figure.subplots(rows, columns, squeeze=False)
    for axes in panels.flat[count:]:
        axes.set_visible(False)
    return figure, list(panels.flat[:count])


def _frontier(
    axes: Axes,
    points: Sequence[Tuple[float, float]],
    measured: Sequence[Measured],
    name: Callable[[Measured], str],
    gain: float,
) -> Set[str]:
    """The frontier is numbered from the left, as its table is, and named; the rest are grey and lie below. Of which
    kinds of coupling it holds runs."""
    best = frontier(points, gain)
    others = [point for i, point in enumerate(points) if i not in best]
    axes.plot([x for x, _ in others], [y for _, y in others], linestyle="none", marker="o", markersize=3.5, color=REST)
    axes.plot([points[i][0] for i in best], [points[i][1] for i in best], color=ON_FRONTIER, linewidth=1.0, zorder=2.5)
    for i in best:
        axes.plot(*[[c] for c in points[i]], zorder=3, **_mark(measured[i].kind))
    axes.set_xlabel("seconds of the run")
    log_axes(axes, "s", "%")
    names = [f"{number}: {name(measured[i])}" for number, i in enumerate(best, 1)]
    name_points(axes, [points[i] for i in best], names, (WIDE_INCHES[0] * AXES_PART[0], WIDE_INCHES[1] * AXES_PART[1]))
    plain_log_axis(axes.xaxis, "s")
    plain_log_axis(axes.yaxis, "%")
    return {measured[i].kind for i in best}


def _mark(kind: str) -> dict:
    fill = FILLS.get(kind, FILLS["interface"])
    return {"linestyle": "none", "marker": "o", "markersize": 6, "color": ON_FRONTIER, "markerfacecolor": fill}


def _kinds(shown: Set[str]) -> Tuple[List[Line2D], List[str]]:
    """The legend: the marks of the frontier."""
    kinds = sorted(shown, key=[*FILLS, *shown].index)
    return [Line2D([], [], **_mark(kind)) for kind in kinds], [f"on the frontier, {kind}" for kind in kinds]
