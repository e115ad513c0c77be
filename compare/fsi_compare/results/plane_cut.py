"""The cut of a tetrahedral mesh by a plane: points on edges of its cells, and triangles."""

import numpy as np

EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
# Of 3 or 4 edges that are cut, in that order: the first and the last of 4 have no common node.
TRIANGLES = {3: [(0, 1, 2)], 4: [(0, 1, 3), (0, 3, 2)]}


def cut_by_plane(
    points: np.ndarray, cells: np.ndarray, origin: np.ndarray, normal: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Ends (points, 2), weights (points,) and triangles (triangles, 3) of the cut through cells with 4 or 10 nodes;
    quadratic ones count as eight straight ones, a node in the plane as above it. Point i lies between nodes ends[i], at
    ends[i, 0] + weight[i] (ends[i, 1] - ends[i, 0])."""
    straight = _straight(cells)
    above = (points - origin) @ normal >= 0
    pattern = above[straight] @ (1 << np.arange(4))
    pieces: list[np.ndarray] = []
    for code, joined in _patterns().items():
        some = np.flatnonzero(pattern == code)
        for triangle in joined:
            pieces.append(straight[some][:, [list(EDGES[e]) for e in triangle]])
    edges = np.concatenate(pieces) if pieces else np.zeros((0, 3, 2), dtype=straight.dtype)
    ends, triangles = np.unique(np.sort(edges.reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    distance = (points - origin) @ normal
    first, second = distance[ends[:, 0]], distance[ends[:, 1]]
    return ends, first / (first - second), triangles.reshape(-1, 3)


def _patterns() -> dict[int, list[list[int]]]:
    """Triangles by the edges that they join, for each set of nodes above the plane."""
    found = {}
    for code in range(1, 15):
        cut = [e for e, (a, b) in enumerate(EDGES) if (code >> a ^ code >> b) & 1]
        found[code] = [[cut[i] for i in corners] for corners in TRIANGLES[len(cut)]]
    return found


def _straight(cells: np.ndarray) -> np.ndarray:
    """Straight tetrahedra of the cells."""
    if cells.shape[1] == 4:
        return cells
    ab, bc, ac, ad, bd, cd = range(4, 10)  # the middles of edges in VTK's order
    parts = [[0, ab, ac, ad], [ab, 1, bc, bd], [ac, bc, 2, cd], [ad, bd, cd, 3]]
    parts += [[ab, bc, ac, bd], [ac, bc, cd, bd], [ac, cd, ad, bd], [ac, ad, ab, bd]]  # about the diagonal ac - bd
    return cells[:, parts].reshape(-1, 4)
