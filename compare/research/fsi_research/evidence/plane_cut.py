"""A plane through a mesh of tetrahedra: the triangles where it cuts them, with nodal values carried along."""

from typing import Tuple

import numpy as np

EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
# By the nodes on one side, as bits: edges around the polygon that the plane cuts out, from marching tetrahedra.
_TRIANGLE = {1: (0, 1, 2), 2: (0, 4, 3), 4: (1, 3, 5), 7: (2, 5, 4)}
_QUADRILATERAL = {3: (1, 2, 4, 3), 5: (0, 2, 5, 3), 6: (0, 1, 5, 4)}


def cut(cells: np.ndarray, distance: np.ndarray, values: np.ndarray) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Corners' values (triangles, 3, n), corner numbers for plotting and the cell of each triangle. `distance` is a
    node's signed distance from the plane, 0 counting as positive; `values` (nodes, n) are linear in each cell."""
    d = np.where(distance == 0, np.finfo(float).tiny, distance)[cells]
    code = ((d > 0) * np.array([1, 2, 4, 8])).sum(axis=1)
    code = np.minimum(code, 15 - code)  # the same cut with the sides exchanged
    triangles, owners = [], []
    for pattern, edges in (*_TRIANGLE.items(), *_QUADRILATERAL.items()):
        chosen = np.flatnonzero(code == pattern)
        if not len(chosen):
            continue
        corners = []
        for edge in edges:
            a, b = EDGES[edge]
            weight = (d[chosen, a] / (d[chosen, a] - d[chosen, b]))[:, None]
            corners.append((1 - weight) * values[cells[chosen, a]] + weight * values[cells[chosen, b]])
        for second in range(1, len(corners) - 1):
            triangles.append(np.stack((corners[0], corners[second], corners[second + 1]), axis=1))
            owners.append(chosen)
    if not triangles:
        return np.empty((0, 3, values.shape[1])), np.empty((0, 3), int), np.empty(0, int)
    joined = np.concatenate(triangles)
    return joined, np.arange(3 * len(joined)).reshape(-1, 3), np.concatenate(owners)
