"""The cut of a tetrahedral mesh by a plane: points on edges of its cells, and triangles."""

from dataclasses import dataclass

import numpy as np

EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))


@dataclass(frozen=True)
class Cut:
    """Point i lies between nodes ends[i], at ends[i, 0] + weight[i] (ends[i, 1] - ends[i, 0])."""

    ends: np.ndarray  # (points, 2)
    weight: np.ndarray  # (points,)
    triangles: np.ndarray  # (triangles, 3)
    cells: np.ndarray  # that each triangle is in, (triangles,)


def cut_by_plane(points: np.ndarray, cells: np.ndarray, origin: np.ndarray, normal: np.ndarray) -> Cut:
    """Cuts cells with 4 or 10 nodes; quadratic ones as eight straight ones. A node in the plane counts as above it."""
    straight, owner = _straight(cells)
    above = (points - origin) @ normal >= 0
    pattern = above[straight] @ (1 << np.arange(4))
    pieces: list[np.ndarray] = []
    owners: list[np.ndarray] = []
    for code, joined in _patterns().items():
        some = np.flatnonzero(pattern == code)
        for triangle in joined:
            pieces.append(straight[some][:, [list(EDGES[e]) for e in triangle]])
            owners.append(owner[some])
    edges = np.concatenate(pieces) if pieces else np.zeros((0, 3, 2), dtype=straight.dtype)
    ends, triangles = np.unique(np.sort(edges.reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    distance = (points - origin) @ normal
    first, second = distance[ends[:, 0]], distance[ends[:, 1]]
    return Cut(ends, first / (first - second), triangles.reshape(-1, 3), np.concatenate(owners or [np.zeros(0, int)]))


def _patterns() -> dict[int, tuple[tuple[int, int, int], ...]]:
    """Triangles by the edges that they join, for each set of nodes above the plane."""
    found: dict[int, tuple[tuple[int, int, int], ...]] = {}
    for code in range(1, 15):
        inside = [i for i in range(4) if code >> i & 1]
        cut = [e for e, (a, b) in enumerate(EDGES) if (a in inside) != (b in inside)]
        if len(cut) == 3:
            found[code] = ((cut[0], cut[1], cut[2]),)
            continue
        # A quadrilateral: neighbours among its corners lie on edges with a common node.
        first, others = cut[0], cut[1:]
        far = next(e for e in others if not set(EDGES[e]) & set(EDGES[first]))
        near = [e for e in others if e != far]
        found[code] = ((first, near[0], far), (first, far, near[1]))
    return found


def _straight(cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Straight tetrahedra of the cells, and the cell of each."""
    if cells.shape[1] == 4:
        return cells, np.arange(len(cells))
    ab, bc, ac, ad, bd, cd = range(4, 10)  # the middles of edges in VTK's order
    parts = [[0, ab, ac, ad], [ab, 1, bc, bd], [ac, bc, 2, cd], [ad, bd, cd, 3]]
    parts += [[ab, bc, ac, bd], [ac, bc, cd, bd], [ac, cd, ad, bd], [ac, ad, ab, bd]]  # about the diagonal ac - bd
    return cells[:, parts].reshape(-1, 4), np.repeat(np.arange(len(cells)), 8)
