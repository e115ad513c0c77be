"""Pictures of the study of scaling."""

from typing import Any, List, Sequence, Tuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, NullFormatter, NullLocator

from fsi_compare.reporting.pictures import finish
from ..drawing.coinciding import note_coinciding
from .measured import Measured
from .model import Step
from .tables import alone, weak_efficiency

# Points joined by lines, told apart without colour by marker, dash pattern and lightness.
MARKED_LINES = (
    {"linestyle": "-", "marker": "o", "color": "#000000"},
    {"linestyle": "--", "marker": "s", "color": "#e8871e"},
    {"linestyle": "-.", "marker": "^", "color": "#2c6fbb"},
    {"linestyle": ":", "marker": "D", "color": "#b02a5b"},
    {"linestyle": (0, (7, 2)), "marker": "v", "color": "#3d8338"},
    {"linestyle": (0, (4, 1, 1, 1, 1, 1)), "marker": "P", "color": "#6a4c93"},
    {"linestyle": (0, (1, 3)), "marker": "X", "color": "#555555"},
    {"linestyle": (0, (9, 1, 1, 1)), "marker": "<", "color": "#00798c"},
    {"linestyle": (0, (3, 3)), "marker": ">", "color": "#8a6d00"},
)

IDEAL = {"linestyle": "-", "color": "#aaaaaa", "linewidth": 2.5, "zorder": 1}
PARTS = {  # of a modelled step, told apart in grey by lightness and hatch
    "work": {"facecolor": "#2c4a6e", "hatch": ""},
    "latency": {"facecolor": "#e8871e", "hatch": "///"},
    "transfer": {"facecolor": "#ffffff", "hatch": "xxxx"},
    "reductions": {"facecolor": "#a9cbe8", "hatch": ""},
    "output": {"facecolor": "#ffffff", "hatch": "...."},
}

Lines = Sequence[Sequence[Measured]]  # of each method, by processes


def times_figure(strong: Lines, weak: Lines) -> Figure:
    """Speed-up on one mesh and, if there are such runs, efficiency on a growing one; of runs with meaningful
    seconds."""
    panels = 2 if any(_shown(runs) for runs in weak) else 1
    figure = Figure(figsize=(4.2 * panels + (1.4 if panels == 1 else 0), 3.1))
    grid = figure.subplots(1, panels, squeeze=False)[0]
    handles: List[Any] = []
    labels: List[str] = []
    most = max([run.processes for runs in [*strong, *weak] for run in _shown(runs)], default=1)
    counts = sorted({run.processes for runs in [*strong, *weak] for run in _shown(runs)})
    handles += grid[0].plot([1, most], [1, most], **IDEAL)
    labels.append("ideal")
    for i, runs in enumerate(strong):
        shown, one = _shown(runs), alone(runs)
        if one is None:
            continue
        style = _style(i)
        handles += grid[0].plot([r.processes for r in shown], [one.seconds / r.seconds for r in shown], **style)
        labels.append(runs[0].label)
    grid[0].set_yscale("log", base=2)
    _processes(grid[0], counts)
    note_coinciding(grid[0], handles[1:], labels[1:])
    grid[0].set_ylabel("speed-up over one process")
    grid[0].set_title("the same mesh", loc="left")
    _plain(grid[0].yaxis, counts)
    if panels == 2:
        grid[1].plot([1, most], [100, 100], **IDEAL)
        for i, runs in enumerate(weak):
            shown, one = _shown(runs), alone(runs)
            if one is not None:
                values = [100 * weak_efficiency(one, run) for run in shown]
                grid[1].plot([run.processes for run in shown], values, **_style(_place(strong, runs, i)))
        grid[1].set_ylim(0, max(110.0, grid[1].get_ylim()[1]))
        grid[1].set_ylabel("efficiency in %")
        grid[1].set_title("a mesh that grows with the processes", loc="left")
        _processes(grid[1], counts)
    return finish(figure, handles, labels, "Time steps on more processes")


def counts_figure(lines: Lines) -> Figure:
    """Iterations, halo and messages over processes; counts do not mind how many cores there are."""
    figure = Figure(figsize=(9.6, 2.9))
    grid = figure.subplots(1, 3)
    handles, labels = [], []
    counts = sorted({run.processes for runs in lines for run in runs})
    for i, runs in enumerate(lines):
        x = [run.processes for run in runs]
        handles += grid[0].plot(x, [run.linear for run in runs], **_style(i))
        labels.append(runs[0].label)
        grid[1].plot(x, [100 * run.halo.mean / max(run.owned.mean, 1e-9) for run in runs], **_style(i))
        grid[2].plot(x, [run.megabytes.mean for run in runs], **_style(i))
    for axes, name in zip(
        grid, ("linear iterations per step", "halo in % of own nodes", "MB sent per step and process")
    ):
        axes.set_ylabel(name)
        axes.set_ylim(0, max(1.08 * axes.get_ylim()[1], 1e-9))
        _processes(axes, counts)
        note_coinciding(axes, axes.get_lines(), labels)
    return finish(figure, handles, labels, "What is counted, per time step")


def model_figure(rows: Sequence[Tuple[str, Step]]) -> Figure:
    """Shares of a modelled step as bars; its milliseconds behind them."""
    width, height = 8.6, 0.7 + 0.3 * len(rows)
    figure = Figure(figsize=(width, height))
    axes = figure.subplots()
    for row, (_, step) in enumerate(rows):
        left = 0.0
        for value, look in zip((step.work, step.latency, step.transfer, step.reductions, step.output), PARTS.values()):
            share = 100 * value / step.seconds
            axes.barh(row, share, left=left, height=0.7, edgecolor="#222222", linewidth=0.5, **look)
            left += share
        axes.text(101, row, _duration(step.seconds), va="center", fontsize=7.5)
    axes.set_xlim(0, 112)
    axes.set_xticks(range(0, 101, 20))
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_yticks(range(len(rows)), [name for name, _ in rows], fontsize=7.5)
    axes.set_xlabel("share of a time step in %")
    axes.grid(axis="y", visible=False)
    axes.set_axisbelow(True)
    handles = [Patch(edgecolor="#222222", linewidth=0.5, **look) for look in PARTS.values()]
    return finish(figure, handles, list(PARTS), "The model: where a time step goes", (width, height))


def _duration(seconds: float) -> str:
    return f"{1e3 * seconds:.3g} ms" if seconds < 0.9995 else f"{seconds:.3g} s"


def _shown(runs: Sequence[Measured]) -> List[Measured]:
    return [run for run in runs if not run.crowded]


def _style(i: int) -> Any:
    return dict(MARKED_LINES[i % len(MARKED_LINES)], markersize=5, linewidth=1.3, zorder=2)


def _place(strong: Lines, runs: Sequence[Measured], otherwise: int) -> int:
    """One method has one style in both panels."""
    return next((i for i, others in enumerate(strong) if others[0].label == runs[0].label), otherwise)


def _processes(axes: Axes, counts: Sequence[int]) -> None:
    axes.set_xscale("log", base=2)
    axes.set_xlabel("processes")
    _plain(axes.xaxis, counts)


def _plain(axis: Any, counts: Sequence[int]) -> None:
    axis.set_ticks(list(counts) or [1])
    axis.set_minor_locator(NullLocator())
    axis.set_minor_formatter(NullFormatter())
    axis.set_major_formatter(FuncFormatter(lambda value, _: format(value, "g")))
