"""Where one looks from: parallel projection, so that lengths can be compared."""

from dataclasses import dataclass

import numpy as np

MARGIN = 1.06  # of the picture over what it shows


@dataclass(frozen=True)
class Camera:
    """Looks along -`towards`, which points from the object to the eye."""

    towards: np.ndarray  # (3,)
    up: np.ndarray  # (3,), upwards in the picture as far as it is across the view

    @property
    def axes(self) -> np.ndarray:
        """Rows: right, up, towards the eye; of length 1, at right angles."""
        eye = self.towards / np.linalg.norm(self.towards)
        right = np.cross(self.up, eye)
        if np.linalg.norm(right) < 1e-6:
            right = np.cross([1.0, 0.0, 0.0] if abs(eye[0]) < 0.9 else [0.0, 1.0, 0.0], eye)
        right = right / np.linalg.norm(right)
        return np.stack([right, np.cross(eye, right), eye])


def best_camera(points: np.ndarray) -> Camera:
    """Onto the two longest directions of a body, a little from the side and from its end. The longest is upwards;
    across, where the body is slender."""
    directions = longest_directions(points)
    spans = np.ptp(points @ directions.T, axis=0)
    slender = spans[1] < 0.5 * spans[0]
    eye = directions[2] + 0.3 * directions[1] - 0.4 * directions[0] * (1 if slender else -0.5)
    return Camera(eye, np.cross(directions[2], directions[0]) if slender else directions[0])


def longest_directions(points: np.ndarray) -> np.ndarray:
    """Rows: directions in which the points spread most, less, and least; the right-handed three. Each points towards
    the coordinate axis that it has most of."""
    centred = points - points.mean(axis=0)
    rows: np.ndarray = np.linalg.svd(centred[:: max(1, len(points) // 20000)], full_matrices=False)[2]
    rows = rows * np.sign(rows[np.arange(3), np.argmax(np.abs(rows), axis=1)])[:, None]
    rows[2] = np.cross(rows[0], rows[1])
    return rows


def fitted(places: np.ndarray, width: int, height: int) -> tuple[float, np.ndarray]:
    """Pixels for each mm, and the place in the picture's plane that is its middle, of (points, 2)."""
    low, high = places.min(axis=0), places.max(axis=0)
    spans = np.maximum(high - low, 1e-12) * MARGIN
    return float(min(width / spans[0], height / spans[1])), 0.5 * (low + high)
