"""Names at the points of a frontier, which falls to the right: they stand below and left of it, where nothing is
drawn."""

from typing import List, Sequence, Tuple

import numpy as np
from matplotlib.axes import Axes

SIZE, LINE = 6.5, 8.5  # points, of letters and of lines
LETTER = 0.56  # of the size, mean width
AWAY = 5.0  # points, from a point to its name
LEADER = 6.0  # points, that a name is moved by before a line leads to it


def name_points(
    axes: Axes, points: Sequence[Tuple[float, float]], names: Sequence[str], inches: Tuple[float, float]
) -> None:
    """On logarithmic axes of about `inches`; their limits are widened so that all names have room."""
    order = sorted(range(len(points)), key=lambda i: (-points[i][1], points[i][0]))
    at = np.log10(np.array([points[i] for i in order], dtype=float).reshape(-1, 2))
    words = [names[i] for i in order]
    width, height = 72 * inches[0], 72 * inches[1]
    room = np.array([LETTER * SIZE * len(word) + 2 * AWAY for word in words]) / width
    low, high = np.log10(axes.get_xlim())
    needed = [(x - part * high) / (1 - part) for x, part in zip(at[:, 0], np.minimum(room, 0.8))]
    low = min([low, *needed])
    axes.set_xlim(10**low, 10**high)
    bottom, top = np.log10(axes.get_ylim())
    for _ in range(6):
        own = height * (at[:, 1] - bottom) / (top - bottom)
        heights = _apart(own - AWAY)
        lowest = min(heights, default=LINE)
        if lowest >= 0.9 * LINE:
            break
        bottom -= (top - bottom) * (LINE - lowest) / height
    axes.set_ylim(10**bottom, 10**top)
    for (x, y), word, here, there in zip(at, words, own, heights):
        far = here - AWAY - there > LEADER
        axes.annotate(
            word,
            (10**x, 10**y),
            (-AWAY, there - here),
            textcoords="offset points",
            fontsize=SIZE,
            ha="right",
            va="top",
            zorder=4,
            arrowprops={"arrowstyle": "-", "color": "#999999", "linewidth": 0.5, "shrinkA": 0, "shrinkB": 2}
            if far
            else None,
        )


def _apart(own: Sequence[float]) -> List[float]:
    """Heights from the top, each at least a line below the last."""
    found: List[float] = []
    for height in own:
        found.append(min(height, found[-1] - LINE) if found else height)
    return found
