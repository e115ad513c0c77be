"""surface.py -o FILE.stl [--edge MM] [--jitter MM] [--closed] [--seed N]: the surface of a carotid-like bifurcation, as a
segmentation leaves it.

The lumen is where a field is negative: the smooth minimum of the distances from tapered tubes, with a bulb at the root of the
inner branch. Its zero surface is found on a grid by surface nets [Gibson1998]: a node in each cell through which it goes, the
mean of where it cuts the cell's edges, and two triangles around each edge that it cuts. The ends are cut off flat.
"""

import argparse
import itertools
import struct
from pathlib import Path
from typing import Dict, List, Sequence, Tuple

import numpy as np

# Ends of tubes and their radii, mm: common carotid artery, internal one with its bulb, external one.
TUBES = (
    ((0.0, 0.0, -16.0), (0.0, 0.0, 2.0), 3.1, 3.2),
    ((0.0, 0.0, 0.0), (2.6, 0.2, 6.5), 3.1, 3.3),
    ((2.6, 0.2, 6.5), (5.2, 0.5, 18.0), 3.1, 2.2),
    ((0.0, 0.0, 0.0), (-3.8, 0.0, 7.0), 2.7, 2.1),
    ((-3.8, 0.0, 7.0), (-6.0, 0.0, 18.0), 2.1, 1.8),
)
BLEND = 0.6  # mm, over which the tubes flow into each other
ENDS = {"cca": (2, -12.0), "branches": (2, 14.0)}  # axis and place of the planes of the ends
OPENINGS = {"cca": (0.0, 0.0, -12.0), "ica": (4.3, 0.4, 14.0), "eca": (-5.2, 0.0, 14.0)}  # near their centres


def level(points: np.ndarray) -> np.ndarray:
    """The field at points (..., 3), mm."""
    distances = []
    for start, end, first, last in TUBES:
        a, direction = np.array(start), np.subtract(end, start)
        along = np.clip((points - a) @ direction / (direction @ direction), 0, 1)
        away = np.linalg.norm(points - a - along[..., None] * direction, axis=-1)
        distances.append(away - first - (last - first) * along)
    return -BLEND * np.log(sum(np.exp(-d / BLEND) for d in distances))


def surface_nets(edge: float) -> Tuple[np.ndarray, np.ndarray]:
    """Nodes and triangles, seen from outside counter-clockwise, of the tubes with round ends."""
    low, high = np.array((-10.0, -6.0, -20.0)), np.array((10.0, 6.0, 22.0))
    shape = np.ceil((high - low) / edge).astype(int) + 1
    grid = np.stack(np.meshgrid(*(low[k] + edge * np.arange(shape[k]) for k in range(3)), indexing="ij"), axis=-1)
    value = level(grid)
    sums = np.zeros((*(shape - 1), 3))
    counts = np.zeros(shape - 1)
    quads = []
    number = np.arange(counts.size).reshape(counts.shape)
    for axis in range(3):
        near, far = np.moveaxis(value, axis, 0)[:-1], np.moveaxis(value, axis, 0)[1:]
        for i, j, k in np.argwhere((near < 0) != (far < 0)):
            at = np.insert((j, k), axis, i)
            inside, outside = near[i, j, k], far[i, j, k]
            crossing = grid[tuple(at)].copy()
            crossing[axis] += edge * inside / (inside - outside)
            u, v = (axis + 1) % 3, (axis + 2) % 3
            around = []
            for du, dv in ((0, 0), (-1, 0), (-1, -1), (0, -1)):
                cell = at.copy()
                cell[u] += du
                cell[v] += dv
                sums[tuple(cell)] += crossing
                counts[tuple(cell)] += 1
                around.append(number[tuple(cell)])
            quads.append(around if inside < 0 else around[::-1])
    used = np.flatnonzero(counts.ravel())
    renumber = np.full(counts.size, -1)
    renumber[used] = np.arange(used.size)
    nodes = sums.reshape(-1, 3)[used] / counts.ravel()[used, None]
    corners = renumber[np.array(quads)]
    return nodes, np.vstack((corners[:, (0, 1, 2)], corners[:, (0, 2, 3)]))


def cut(nodes: np.ndarray, triangles: np.ndarray, axis: int, place: float, side: int) -> Tuple[np.ndarray, np.ndarray]:
    """What lies on one side of a plane; nodes near the plane are put onto it first, lest slivers be left."""
    nodes = nodes.copy()
    edge = np.linalg.norm(nodes[triangles[:, 0]] - nodes[triangles[:, 1]], axis=1).mean()
    nodes[np.abs(nodes[:, axis] - place) < 0.25 * edge, axis] = place
    height = side * (nodes[:, axis] - place)
    more: List[np.ndarray] = []
    between: Dict[Tuple[int, int], int] = {}

    def crossing(a: int, b: int) -> int:
        key = (min(a, b), max(a, b))
        if key not in between:
            between[key] = len(nodes) + len(more)
            more.append(nodes[a] + height[a] / (height[a] - height[b]) * (nodes[b] - nodes[a]))
        return between[key]

    left = []
    for triangle in triangles:
        polygon: List[int] = []
        for a, b in zip(triangle, np.roll(triangle, -1)):
            if height[a] >= 0:
                polygon.append(int(a))
            if height[a] * height[b] < 0:
                polygon.append(crossing(int(a), int(b)))
        if len(polygon) > 2 and max(height[p] if p < len(nodes) else 0.0 for p in polygon) > 0:
            left += [(polygon[0], polygon[k - 1], polygon[k]) for k in range(2, len(polygon))]
    nodes = np.vstack((nodes, *more))
    used, numbers = np.unique(np.array(left), return_inverse=True)
    return nodes[used], numbers.reshape(-1, 3)


def rims(triangles: np.ndarray) -> List[List[int]]:
    """Closed lines of edges that have one triangle, in its direction."""
    edges = {(int(a), int(b)) for t in triangles for a, b in zip(t, np.roll(t, -1))}
    after = {a: b for a, b in edges if (b, a) not in edges}
    found = []
    while after:
        line = [next(iter(after))]
        while line[-1] in after:
            line.append(after.pop(line[-1]))
        found.append(line[:-1])
    return found


def capped(nodes: np.ndarray, triangles: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """The surface with a fan of triangles over each rim."""
    for rim in rims(triangles):
        centre = len(nodes)
        nodes = np.vstack((nodes, nodes[rim].mean(axis=0)))
        triangles = np.vstack((triangles, [(rim[i - 1], centre, rim[i]) for i in range(len(rim))]))
    return nodes, triangles


def carotid(
    edge: float = 0.6, jitter: float = 0.0, closed: bool = False, seed: int = 1
) -> Tuple[np.ndarray, np.ndarray]:
    """Nodes and triangles. jitter: each node is off by up to this, mm, along each axis."""
    nodes, triangles = surface_nets(edge)
    for (axis, place), side in zip(ENDS.values(), (1, -1)):
        nodes, triangles = cut(nodes, triangles, axis, place, side)
    if closed:
        nodes, triangles = capped(nodes, triangles)
    return nodes + np.random.default_rng(seed).uniform(-jitter, jitter, nodes.shape), triangles


def write_stl(path: Path, nodes: np.ndarray, triangles: Sequence[Sequence[int]], scale: float = 1.0) -> None:
    """Binary; the normals are zero: whoever reads the file finds them."""
    with open(path, "wb") as out:
        out.write(bytes(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            corners = itertools.chain.from_iterable(scale * nodes[list(triangle)])
            out.write(struct.pack("<12fH", 0, 0, 0, *corners, 0))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--edge", type=float, default=0.6)
    parser.add_argument("--jitter", type=float, default=0.0)
    parser.add_argument("--closed", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    write_stl(options.output, *carotid(options.edge, options.jitter, options.closed, options.seed))


if __name__ == "__main__":
    main()
