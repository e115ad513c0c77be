"""Pictures of the coupling study."""

from dataclasses import dataclass
from typing import Any, List, Mapping, Optional, Sequence

from matplotlib.figure import Figure

from ...reporting.pictures import MARKED_LINES, finish

OFF = {"linestyle": "none", "marker": "x", "color": "#000000", "markersize": 15, "markeredgewidth": 2.5, "zorder": 1.5}


@dataclass(frozen=True)
class Series:
    label: str
    x: Sequence[float]
    passes: Sequence[Optional[float]]  # None: failed
    off: Sequence[bool]  # it did not fail, and its answer is another than the monolithic one


def passes_figure(all_series: List[Series], xlabel: str, settings: Mapping[str, Any], bound: float) -> Figure:
    """Two logarithmic axes; above them a strip with a row per scheme that marks where it failed. Answers further than
    `bound` from the monolithic ones are crossed out."""
    figure = Figure(figsize=(7.4, 5.4))
    strip, axes = figure.subplots(2, 1, sharex=True, height_ratios=[1.5, 3])
    handles = []
    for i, line in enumerate(all_series):
        style = dict(MARKED_LINES[i % len(MARKED_LINES)], markersize=5, linewidth=1.3, label=line.label)
        y = [float("nan") if value is None else value for value in line.passes]
        handles += axes.plot(line.x, y, **style)
        failed = [x for x, value in zip(line.x, line.passes) if value is None]
        strip.plot(
            failed,
            [i] * len(failed),
            linestyle="none",
            marker=style["marker"],
            color=style["color"],
            markersize=6,
            fillstyle="none",
        )
    wrong = [(x, value) for line in all_series for x, value, off in zip(line.x, line.passes, line.off) if off]
    labels = [line.label for line in all_series]
    if wrong:
        handles += axes.plot(*zip(*wrong), **OFF)
        labels.append(f"pressure off by more than {100 * bound:g} %")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(xlabel)
    axes.set_ylabel("coupling iterations per step")
    strip.set_ylim(len(all_series) - 0.4, -0.6)
    strip.set_yticks(range(len(all_series)), [line.label for line in all_series], fontsize=6.5)
    strip.set_title("failed", loc="left")
    tolerance = settings.get("partitioned.tolerance", 1e-6)
    return finish(figure, handles, labels, f"Coupling iterations, tolerance {tolerance:g}")
