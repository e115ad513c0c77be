"""Surfaces with fewer triangles, for a page: points near each other become one of them."""

import numpy as np

from ..results.scene_parts import Part
from ..results.surfaces import Surface

MOST_TRIANGLES = 60_000  # of all parts of a run


def thinned_part(part: Part, triangles: int) -> Part:
    """The part itself where a run's parts have few enough `triangles`; else clustered to its share."""
    if triangles <= MOST_TRIANGLES:
        return part
    share = int(MOST_TRIANGLES * len(part.surface.triangles) / triangles)
    return Part(part.name, part.group, clustered(part.surface, share))


def clustered(surface: Surface, most: int) -> Surface:
    """A surface of at most `most` triangles (or edges). Points within a cube become one; the cubes are as small as that
    allows. The point nearest to their mean stands for all, so that values remain those of nodes."""
    points = surface.points
    size = float(np.ptp(points, axis=0).max())
    low, high = 0.0, 0.5
    best = surface
    for _ in range(12):  # bisection of the side of a cube
        middle = 0.5 * (low + high)
        made = _merged(surface, middle * size)
        if len(made.triangles) > most:
            low = middle
        else:
            high, best = middle, made
    return best


def _merged(surface: Surface, side: float) -> Surface:
    points = surface.points
    cubes = np.floor((points - points.min(axis=0)) / side).astype(np.int64)
    cluster = np.unique(cubes, axis=0, return_inverse=True)[1]
    count = np.bincount(cluster)
    means = np.stack([np.bincount(cluster, weights=points[:, k]) / count for k in range(3)], axis=1)
    far = np.linalg.norm(points - means[cluster], axis=1)
    order = np.lexsort((far, cluster))
    kept = order[np.concatenate([[0], np.cumsum(count)[:-1]])]
    cells = cluster[surface.triangles]
    cells = cells[np.all(cells != np.roll(cells, 1, axis=1), axis=1)]
    alone = np.unique(np.sort(cells, axis=1), axis=0, return_index=True)[1]
    used, local = np.unique(cells[np.sort(alone)], return_inverse=True)
    nodes = kept[used]
    triangles = local.reshape(len(alone), cells.shape[1])
    return Surface(surface.name, surface.medium, surface.ends[nodes], surface.weight[nodes], triangles)
