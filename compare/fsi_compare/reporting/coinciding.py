"""Curves that lie on each other: found, and said, since the eye takes them for one."""

import re
from typing import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

NEAR = 0.01  # of the height of the axes: less than a line is broad
SHORT = 30  # characters, of a name that is said again
MOST = 6  # groups that a caption names
SAID = re.compile(r"lies? on ")
SHARED = 0.9  # of the longer curve, that both must span


def coinciding(panels: Sequence[Sequence[Line2D]]) -> list[list[int]]:
    """Groups of curves, by their places, that lie on each other in each of the panels, which have the same curves."""
    groups: list[list[int]] = []
    for i in range(min((len(lines) for lines in panels), default=0)):
        for group in groups:
            if all(_near(lines[i], lines[j]) for lines in panels for j in group):
                group.append(i)
                break
        else:
            groups.append([i])
    return [group for group in groups if len(group) > 1]


def labels_that_say_so(labels: Sequence[str], panels: Sequence[Sequence[Line2D]]) -> list[str]:
    """Names for the legend: 'partitioned (lies on monolithic)'."""
    on: dict[int, int] = {i: group[0] for group in coinciding(panels) for i in group[1:]}

    def first(place: int) -> str:
        return labels[place] if len(labels[place]) <= SHORT else f"line {place + 1} of this legend"

    return [f"{label} (lies on {first(on[i])})" if i in on else label for i, label in enumerate(labels)]


def sentence_of_coinciding(figure: Figure) -> str:
    """A sentence for a caption: which curves with a name in a legend lie on each other in all panels that have them;
    empty where none do, or a legend or panel says it already."""
    texts = [text for axes in figure.axes for text in axes.texts]
    texts += [text for axes in figure.axes if (legend := axes.get_legend()) for text in legend.get_texts()]
    if any(SAID.search(text.get_text()) for text in texts):
        return ""
    said: dict[str, None] = {}  # in their order, each once
    for axes in figure.axes:
        lines = [line for line in axes.get_lines() if not str(line.get_label()).startswith("_")]
        labels = [str(line.get_label()) for line in lines]
        for group in coinciding([lines]):
            said[" and ".join(labels[i] for i in group)] = None
        apart = [label for i, label in enumerate(labels) if all(i not in group for group in coinciding([lines]))]
        for names in list(said):
            if any(label in names.split(" and ") for label in apart):
                del said[names]  # in another panel they part
    if not said:
        return ""
    groups = list(said)
    more = f"; {len(groups) - MOST} more" if len(groups) > MOST else ""
    return f"Lines that lie on each other: {'; '.join(groups[:MOST])}{more}."


def _near(one: Line2D, other: Line2D) -> bool:
    a, b = _on_the_axes(one), _on_the_axes(other)
    if min(len(a), len(b)) < 2:
        return False
    low, high = max(a[0, 0], b[0, 0]), min(a[-1, 0], b[-1, 0])
    if high - low < SHARED * (max(a[-1, 0], b[-1, 0]) - min(a[0, 0], b[0, 0])):
        return False
    x = np.unique(np.concatenate([a[:, 0], b[:, 0]]))
    x = x[(x >= low) & (x <= high)]
    apart = np.abs(np.interp(x, a[:, 0], a[:, 1]) - np.interp(x, b[:, 0], b[:, 1]))
    return len(x) > 1 and bool(apart.max() <= NEAR)


def _on_the_axes(line: Line2D) -> np.ndarray:
    """Places as parts of the width and height of the axes, from left to right."""
    axes = line.axes
    assert axes is not None, "it has been drawn"
    axes.get_xlim(), axes.get_ylim()  # decides them, where they are left to the data
    points = np.column_stack([np.asarray(line.get_xdata(), float), np.asarray(line.get_ydata(), float)])
    with np.errstate(all="ignore"):
        placed = (axes.transScale + axes.transLimits).transform(points[np.isfinite(points).all(axis=1)])
    placed = placed[np.isfinite(placed).all(axis=1)]
    found: np.ndarray = placed[np.argsort(placed[:, 0], kind="stable")]
    return found
