"""Pictures of the accuracy-cost study: work against precision, and errors against element size and time step."""

from typing import Callable, Dict, List, Mapping, Sequence, Tuple

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from ...reporting.pictures import finish
from ...runs.waves import QUANTITIES, Quantity
from .convergence import SPACE, Series
from .frontier import frontier
from .measured import GAIN, Measured

MARKERS = ("o", "s", "D", "^", "v", "P", "X", "p", "h", "<", ">", "*")
DOMINATED, ON_FRONTIER, PARTITIONED_FILL = "#b5b5b5", "#000000", "#ffffff"
PANEL_INCHES = (4.4, 3.6)
FLOOR = 1e-5  # %, below which a solver's error is drawn as this
DASHES = ("-", "--", "-.", ":", (0, (7, 2)), (0, (4, 1, 1, 1, 1, 1)))
GREYS = ("#000000", "#b02a5b", "#2c6fbb", "#e8871e", "#5fa55a", "#6a4c93")


def work_precision(measured: Sequence[Measured], title: str) -> Figure:
    """Total error against seconds, a panel per quantity: shape by mesh, size by time step, hollow partitioned."""
    meshes = _named(measured, lambda m: (m.nodes, m.mesh_label))
    steps = sorted({m.step for m in measured})

    def size(m: Measured) -> float:
        return 4.0 + 5.5 * (steps.index(m.step) / max(1, len(steps) - 1))

    figure, panels = _panels(len(QUANTITIES))
    for axes, quantity in zip(panels, QUANTITIES):
        points = [(m.seconds, 100 * m.total[quantity.column]) for m in measured]
        _scatter(axes, points, measured, lambda m: meshes[m.mesh_label], size, GAIN)
        axes.set_title(quantity.name)
        axes.set_ylabel("error in % of the reference")
        _log(axes, "seconds")
    handles, labels = _mesh_handles(meshes)
    for step in steps if len(steps) > 1 else ():
        handles.append(
            Line2D(
                [],
                [],
                linestyle="none",
                marker="o",
                color=ON_FRONTIER,
                markersize=4.0 + 5.5 * steps.index(step) / max(1, len(steps) - 1),
            )
        )
        labels.append(f"step {step:g} ms")
    return _finish(figure, handles, labels, measured, title)


def algebraic_work_precision(groups: Mapping[str, Sequence[Measured]], quantity: Quantity, title: str) -> Figure:
    """Error of stopping early against seconds, a panel per mesh and step: shape by method, a line along tolerances."""
    everyone = [m for group in groups.values() for m in group]
    methods = _named(everyone, lambda m: (m.partitioned, m.run.request.method.label))
    figure, panels = _panels(len(groups))
    for axes, (name, group) in zip(panels, groups.items()):
        points = [(m.seconds, max(100 * m.algebraic[quantity.column], FLOOR)) for m in group]
        for label in methods:
            own = sorted((p for p, m in zip(points, group) if m.run.request.method.label == label), key=lambda p: p[1])
            axes.plot([x for x, _ in own], [y for _, y in own], color="#d8d8d8", linewidth=0.8, zorder=1)
        _scatter(axes, points, group, lambda m: methods[m.run.request.method.label], lambda m: 6.0, 0.0)
        axes.set_title(name, wrap=True)
        axes.set_ylabel("error in % of the tight solution")
        _log(axes, "seconds")
    handles = [
        Line2D(
            [],
            [],
            linestyle="none",
            marker=marker,
            color=ON_FRONTIER,
            markersize=6,
            markerfacecolor=PARTITIONED_FILL
            if any(m.partitioned for m in everyone if m.run.request.method.label == label)
            else ON_FRONTIER,
        )
        for label, marker in methods.items()
    ]
    return _finish(figure, handles, list(methods), everyone, title, drivers=False)


def orders(series: Sequence[Series], what: str, title: str) -> Figure:
    """Distance of each solution from the next finer one against its size, a panel per quantity."""
    figure, panels = _panels(len(QUANTITIES))
    handles: List[Line2D] = []
    for axes, quantity in zip(panels, QUANTITIES):
        for i, one in enumerate(series):
            style = {
                "linestyle": DASHES[i % len(DASHES)],
                "marker": MARKERS[i % len(MARKERS)],
                "color": GREYS[i % len(GREYS)],
                "markersize": 5,
                "linewidth": 1.3,
            }
            ys = [100 * d for d in one.distances[quantity.column]]
            (line,) = axes.plot([_size(one, j) for j in range(len(ys))], ys, **style)
            if quantity is QUANTITIES[0]:
                handles.append(line)
        _slopes(axes)
        axes.set_title(quantity.name)
        axes.set_ylabel("difference from the next finer in %")
        _log(axes, "element size, (nodes of the finest / nodes)$^{1/3}$" if what == SPACE else "time step in ms")
    return _finish(
        figure,
        handles + [Line2D([], [], color="#999999", linewidth=0.8, linestyle=s) for s in (":", "--")],
        [one.fixed for one in series] + ["first order", "second order"],
        [],
        title,
        drivers=False,
    )


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
    for order, style in ((1, ":"), (2, "--")):
        axes.plot(
            ends, [y * (end / x) ** order for end in ends], color="#999999", linewidth=0.8, linestyle=style, zorder=1
        )


def _panels(count: int) -> Tuple[Figure, List[Axes]]:
    columns = min(2, count)
    rows = -(-count // columns)
    figure = Figure(figsize=(columns * PANEL_INCHES[0], rows * PANEL_INCHES[1]))
    panels = figure.subplots(rows, columns, squeeze=False)
    for axes in panels.flat[count:]:
        axes.set_visible(False)
    return figure, list(panels.flat[:count])


def _named(measured: Sequence[Measured], key: Callable[[Measured], Tuple]) -> Dict[str, str]:
    """Name -> marker, in the order of the key, whose last part is the name."""
    names = list(dict.fromkeys(k[-1] for k in sorted({key(m) for m in measured})))
    return {name: MARKERS[i % len(MARKERS)] for i, name in enumerate(names)}


def _scatter(
    axes: Axes,
    points: Sequence[Tuple[float, float]],
    measured: Sequence[Measured],
    marker: Callable[[Measured], str],
    size: Callable[[Measured], float],
    gain: float,
) -> None:
    """The frontier is numbered from the left, as its table is; dominated settings are grey and lie below."""
    best = frontier(points, gain)
    for i, ((x, y), m) in enumerate(zip(points, measured)):
        colour = ON_FRONTIER if i in best else DOMINATED
        axes.plot(
            [x],
            [y],
            linestyle="none",
            marker=marker(m),
            markersize=size(m),
            color=colour,
            markeredgewidth=1.0,
            markerfacecolor=PARTITIONED_FILL if m.partitioned else colour,
            zorder=3 if i in best else 2,
        )
    axes.plot([points[i][0] for i in best], [points[i][1] for i in best], color=ON_FRONTIER, linewidth=1.0, zorder=2.5)
    for number, i in enumerate(best, 1):
        # On alternate sides of the frontier, which falls to the right: neighbours' numbers stay apart.
        axes.annotate(
            str(number),
            points[i],
            textcoords="offset points",
            xytext=(-6, -11) if number % 2 else (6, 5),
            fontsize=7,
            ha="center",
            zorder=4,
        )


def _mesh_handles(meshes: Mapping[str, str]) -> Tuple[List[Artist], List[str]]:
    handles = [
        Line2D([], [], linestyle="none", marker=marker, color=ON_FRONTIER, markersize=6) for marker in meshes.values()
    ]
    return handles, [f"{name} mesh" for name in meshes]


def _finish(
    figure: Figure,
    handles: List[Artist],
    labels: List[str],
    measured: Sequence[Measured],
    title: str,
    drivers: bool = True,
) -> Figure:
    if drivers:
        handles.append(Line2D([], [], color=ON_FRONTIER, linewidth=1.0, marker="o", markersize=5))
        labels.append("on the frontier")
        handles.append(Line2D([], [], linestyle="none", marker="o", markersize=5, color=DOMINATED))
        labels.append("dominated")
        if any(m.partitioned for m in measured):
            handles.append(
                Line2D(
                    [],
                    [],
                    linestyle="none",
                    marker="o",
                    markersize=6,
                    color=ON_FRONTIER,
                    markerfacecolor=PARTITIONED_FILL,
                )
            )
            labels.append("hollow: partitioned")
    return finish(figure, handles, labels, title)


def _log(axes: Axes, name: str) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.margins(x=0.1, y=0.12)
    axes.set_xlabel(name)
    for axis, (low, high) in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        if high < 4 * low:  # a difference of a percent should look like no more
            low, high = (low * high) ** 0.5 / 2, (low * high) ** 0.5 * 2
            (axes.set_xlim if axis is axes.xaxis else axes.set_ylim)(low, high)
        subs = (1, 2, 3, 5, 7) if high < 12 * low else (1, 2, 5) if high < 400 * low else (1,)
        axis.set_major_locator(LogLocator(subs=subs, numticks=20))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_locator(NullLocator())
