"""Curves of a panel that lie on each other, said in the panel itself."""

from typing import Sequence

from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from fsi_compare.reporting.coinciding import coinciding


def note_coinciding(axes: Axes, lines: Sequence[Line2D], labels: Sequence[str]) -> str | None:
    """Writes into a panel which of its curves lie on each other; for panels of a figure that differ in that."""
    said = []
    for group in coinciding([lines]):
        names = [labels[i] for i in group]
        if len(group) == len(lines):
            said.append("all lines" if len(lines) > 2 else "both lines")
        else:
            said.append(f"{', '.join(names[:-1])} and {names[-1]}")
    if not said:
        return None
    text = "\n".join(f"{names} lie on each other" for names in said)
    axes.text(0.98, 0.03, text, transform=axes.transAxes, ha="right", va="bottom", fontsize=6.5, color="#444444")
    return text
