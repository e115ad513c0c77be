"""Pictures of a tube cut along its axis: the deformed wall, and the velocity of the fluid in it."""

from dataclasses import dataclass
from typing import List, Mapping, Optional, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.quiver import Quiver
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import LinearTriInterpolator, Triangulation

from fsi_compare.reporting.pictures import finish
from .fields import Medium
from .plane_cut import cut

# Turned a little about the axis, so that the plane runs through no row of nodes.
ANGLE = 0.07
SHOWN_MM = 0.5  # about what the largest displacement measures in the picture
LAYERS = ({"facecolor": "#c9c9c9", "hatch": ""}, {"facecolor": "#ffffff", "hatch": "////"})  # media, adventitia
EDGE = "#444444"
ARROWS = (28, 5)  # along the axis and across


@dataclass(frozen=True)
class TubeCut:
    """Triangles in the plane of the cut; coordinates (z, x) in mm, x across the axis."""

    fluid: np.ndarray  # deformed, (triangles, 3, 2)
    velocity: np.ndarray  # (v_z, v_x) at the corners, mm/ms
    speed: np.ndarray  # |v| at the corners
    wall: np.ndarray
    layer: np.ndarray  # of each wall triangle


def largest_displacement(media: Mapping[str, Medium]) -> float:
    return max(float(np.linalg.norm(medium.data["displacement"], axis=1).max()) for medium in media.values())


def round_factor(displacement: float, shown: float = SHOWN_MM) -> float:
    """The largest of 1, 2, 5, 10, ... that shows `displacement`, in mm, no larger than `shown`; 1 without any."""
    if not displacement > 0:
        return 1.0
    return max(1.0, round_below(shown / displacement))


def round_below(value: float) -> float:
    """The largest of ..., 0.1, 0.2, 0.5, 1, ... that is no larger than `value`, which is positive."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(factor * power for factor in (5, 2, 1) if factor * power <= value * (1 + 1e-12)))


def tube_cut(media: Mapping[str, Medium], factor: float) -> TubeCut:
    """`factor` magnifies the displacement."""
    fluid, wall = media["fluid"], media["wall"]
    corners, _, _ = cut(
        fluid.cells,
        _distance(fluid),
        np.column_stack(
            (
                _in_plane(fluid.points + factor * fluid.data["displacement"]),
                _in_plane(fluid.data["velocity"]),
                np.linalg.norm(fluid.data["velocity"], axis=1),
            )
        ),
    )
    shell, _, owners = cut(wall.cells, _distance(wall), _in_plane(wall.points + factor * wall.data["displacement"]))
    numbers = {value: i for i, value in enumerate(_from_inside(wall))}
    layer = np.array([numbers[value] for value in wall.data["layer"][owners]], int)
    return TubeCut(corners[:, :, :2], corners[:, :, 2:4], corners[:, :, 4], shell, layer)


def _distance(medium: Medium) -> np.ndarray:
    return medium.points @ np.array([-np.sin(ANGLE), np.cos(ANGLE), 0.0])


def _in_plane(vectors: np.ndarray) -> np.ndarray:
    return np.column_stack((vectors[:, 2], vectors @ np.array([np.cos(ANGLE), np.sin(ANGLE), 0.0])))


def _from_inside(wall: Medium) -> List[int]:
    """The layers' numbers, innermost first."""
    radius = np.linalg.norm(wall.points[:, :2], axis=1)[wall.cells].mean(axis=1)
    layers = np.unique(wall.data["layer"])
    return sorted(layers.tolist(), key=lambda layer: float(radius[wall.data["layer"] == layer].mean()))


def tube_figure(cuts: Sequence[TubeCut], labels: Sequence[str], time: float, factor: float) -> Figure:
    """One cut above the other, on one colour scale."""
    width, height = 8.0, 1.95 * len(cuts)
    figure = Figure(figsize=(width, height))
    grid = figure.subplots(len(cuts), 1, squeeze=False, sharex=True)[:, 0]
    fastest = max(float(one.speed.max()) for one in cuts)
    every = np.concatenate([one.wall.reshape(-1, 2) for one in cuts])
    low, high, reach = every[:, 0].min(), every[:, 0].max(), 1.06 * np.abs(every[:, 1]).max()
    for axes, one, label in zip(grid, cuts, labels):
        numbers = np.arange(3 * len(one.fluid)).reshape(-1, 3)
        z, x = one.fluid.reshape(-1, 2).T
        # One picture within the SVG in place of thousands of shaded triangles.
        shades = axes.tripcolor(
            Triangulation(z, x, numbers),
            one.speed.ravel(),
            shading="gouraud",
            cmap="cividis",
            vmin=0,
            vmax=fastest,
            rasterized=True,
        )
        layer = np.minimum(one.layer, len(LAYERS) - 1)
        for i, style in enumerate(LAYERS):
            axes.add_collection(
                PolyCollection(
                    one.wall[layer == i],
                    edgecolor=EDGE,
                    linewidth=0.25,
                    facecolor=style["facecolor"],
                    hatch=style["hatch"],
                )
            )
        arrows = _arrows(axes, one, fastest)
        if arrows is not None and axes is grid[0]:
            size = round_below(fastest)
            axes.quiverkey(arrows, 0.86, 1.09, size, f"{size:g} mm/ms", labelpos="E", fontproperties={"size": 8})
        axes.grid(visible=False)
        axes.set_aspect("equal")
        axes.set_xlim(low - 0.2, high + 0.2)
        axes.set_ylim(-reach, reach)
        axes.set_title(label)
        axes.set_ylabel("x in mm")
    grid[-1].set_xlabel("z in mm")
    grid[-1].xaxis.set_major_locator(MaxNLocator(nbins=8, steps=[1, 2, 3, 5, 10]))
    handles = [Patch(edgecolor=EDGE, facecolor=style["facecolor"], hatch=style["hatch"]) for style in LAYERS]
    times = "" if factor == 1 else f", displacement {factor:g} times"
    finish(
        figure,
        handles,
        ["media", "adventitia"],
        f"Deformed wall and velocity at t = {time:g} ms{times}",
        (width, height),
    )
    # Beside the panels that tight_layout has placed.
    figure.subplots_adjust(right=0.88)
    top, bottom = grid[0].get_position().y1, grid[-1].get_position().y0
    bar = figure.colorbar(shades, cax=figure.add_axes((0.9, bottom, 0.018, top - bottom)))
    bar.set_label("speed in mm/ms")
    return figure


def _arrows(axes: Axes, one: TubeCut, fastest: float) -> Optional[Quiver]:
    """Direction and size of the velocity on a regular grid of points."""
    z, x = one.fluid.reshape(-1, 2).T
    points, index = np.unique(np.round(one.fluid.reshape(-1, 2), 9), axis=0, return_inverse=True)
    index = index.reshape(-1, 3)
    proper = np.array([len(set(row)) == 3 for row in index])
    mesh = Triangulation(points[:, 0], points[:, 1], index[proper])
    values = np.zeros((len(points), 2))
    values[index.ravel()] = one.velocity.reshape(-1, 2)
    at_z, at_x = np.meshgrid(
        np.linspace(z.min(), z.max(), ARROWS[0] + 2)[1:-1], 0.8 * x.max() * np.linspace(-1, 1, ARROWS[1])
    )
    try:
        along = [LinearTriInterpolator(mesh, values[:, i])(at_z, at_x) for i in (0, 1)]
    except (RuntimeError, ValueError):
        return None  # a cut that matplotlib cannot search goes without arrows
    return axes.quiver(
        at_z,
        at_x,
        *along,
        color="#ffffff",
        edgecolor="#000000",
        linewidth=0.4,
        scale=30 * fastest,
        width=0.0022,
        zorder=3,
    )
