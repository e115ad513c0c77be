"""A half plane of radius (x) and axis (z), turned about the axis."""

import numpy as np

OPEN = 90.0  # degrees that are left out, about the direction of x, so that one sees inside
STEPS = 48  # of the whole circle


def angles() -> np.ndarray:
    """Angles of the copies of an edge, in radians."""
    count = round(STEPS * (1 - OPEN / 360)) + 1
    return np.radians(np.linspace(OPEN / 2, 360 - OPEN / 2, count))


def turned(points: np.ndarray, angle: float) -> np.ndarray:
    """(points, 3) turned about z."""
    x, y, z = points.T
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * x - s * y, s * x + c * y, z], axis=1)


def swept(points: np.ndarray, edges: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Surface of edges: points, triangles, and the point of the half plane that each point comes from."""
    around = angles()
    made = np.concatenate([turned(points, angle) for angle in around])
    a, b = edges.T
    n = len(points)
    strips = [
        np.concatenate([np.stack([a, b, b + n], axis=1), np.stack([a, b + n, a + n], axis=1)]) + i * n
        for i in range(len(around) - 1)
    ]
    return made, np.concatenate(strips), np.tile(np.arange(n), len(around))
