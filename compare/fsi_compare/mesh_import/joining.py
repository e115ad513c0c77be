"""Points that are one: of meshes in several files, or doubled in one file.

Places are sorted into cubes as long as the tolerance, so that near ones lie in the same or in neighbouring cubes. The
work is that of sorting.
"""

from itertools import product

import numpy as np

MOST_PAIRS = 8  # a point and neighbouring cube; with more the tolerance is no small one


class TooMany(Exception):
    """The tolerance is so long that points have more neighbours than a joint of meshes has."""


def _keys(cubes: np.ndarray) -> np.ndarray:
    """A number for each cube; two cubes may share one, which distances tell apart."""
    with np.errstate(over="ignore"):
        a, b, c = (cubes[:, k].astype(np.uint64) for k in range(3))
        return a * np.uint64(73856093) ^ b * np.uint64(19349663) ^ c * np.uint64(83492791)


def near_pairs(first: np.ndarray, second: np.ndarray, tolerance: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """All pairs at most `tolerance` > 0 apart: places in the first, in the second, distances.

    Raises TooMany beyond MOST_PAIRS a point.
    """
    origin = np.minimum(first.min(axis=0), second.min(axis=0))
    span = float(np.max(np.maximum(first.max(axis=0), second.max(axis=0)) - origin))
    size = max(tolerance, span * 2.0**-50)  # cubes are counted in whole numbers
    mine = np.floor((first - origin) / size).astype(np.int64)
    theirs = _keys(np.floor((second - origin) / size).astype(np.int64))
    order = np.argsort(theirs, kind="stable")
    theirs = theirs[order]
    found = []
    most = MOST_PAIRS * (len(first) + len(second))
    for shift in product((-1, 0, 1), repeat=3):
        wanted = _keys(mine + np.array(shift))
        low, high = np.searchsorted(theirs, wanted, "left"), np.searchsorted(theirs, wanted, "right")
        counts = high - low
        total = int(counts.sum())
        if total > most:
            raise TooMany
        if not total:
            continue
        i = np.repeat(np.arange(len(first)), counts)
        j = order[np.arange(total) - np.repeat(np.cumsum(counts) - counts, counts) + np.repeat(low, counts)]
        distances = np.linalg.norm(first[i] - second[j], axis=1)
        near = distances <= tolerance
        found.append((i[near], j[near], distances[near]))
    if not found:
        return np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0)
    i, j, distances = (np.concatenate(parts) for parts in zip(*found))
    # Cubes that share a key may give a pair twice.
    _, once = np.unique(i * np.int64(len(second)) + j, return_index=True)
    return i[once], j[once], distances[once]


def first_of_cluster(count: int, i: np.ndarray, j: np.ndarray) -> np.ndarray:
    """For each of `count` points the lowest number among those that pairs join it to, however far along a chain."""
    lowest = np.arange(count)
    while len(i):
        before = lowest.copy()
        least = np.minimum(lowest[i], lowest[j])
        np.minimum.at(lowest, i, least)
        np.minimum.at(lowest, j, least)
        lowest = lowest[lowest]
        if np.array_equal(before, lowest):
            break
    return lowest


def nearest_distance(first: np.ndarray, second: np.ndarray, longest: float) -> float:
    """The least distance between points of the two, infinite beyond `longest`."""
    return float(distances_to(first, second, longest, least=True).min())


def distances_to(first: np.ndarray, second: np.ndarray, longest: float, least: bool = False) -> np.ndarray:
    """Distance of each point of `first` to the nearest of `second`, infinite beyond `longest`. Looks further by degrees;
    `least`: until the least of all is found."""
    found = np.full(len(first), np.inf)
    box = float(np.max(np.ptp(np.vstack([first, second]), axis=0)))
    radius, left = max(box * 1e-9, 1e-300), np.arange(len(first))
    while len(left):
        try:
            i, _, distances = near_pairs(first[left], second, min(radius, longest))
        except TooMany:
            found[left] = radius
            break
        np.minimum.at(found, left[i], distances)
        if radius >= longest or (least and len(distances)):
            break
        left = left[np.isinf(found[left])]
        radius *= 8 if least else 4
    return found
