"""Draws triangles by a depth buffer, in numpy alone: the same picture on every machine, without graphics hardware, an X server
or JavaScript."""

from dataclasses import dataclass
from typing import List, Optional, Sequence, Tuple

import numpy as np

from .camera import Camera, fitted

BACKGROUND = 255
GREY = np.array([205.0, 205.0, 205.0])  # of surfaces without values
AMBIENT = 0.58  # of the light; the rest comes from the eye
SAMPLES = 2  # in each direction of a pixel
MOST_AT_ONCE = 2_000_000  # candidates for pixels


@dataclass(frozen=True)
class Mesh:
    """Triangles with a place 0 to 1 in a table of colours for each point; None: grey."""

    points: np.ndarray  # (points, 3)
    triangles: np.ndarray  # (triangles, 3)
    places: Optional[np.ndarray]  # (points,)
    lit: bool = True  # shaded by the angle to the eye; sections are not
    beyond: Optional[np.ndarray] = None  # (points,): what is positive, linear between points, is cut away


def rendered(
    meshes: Sequence[Mesh],
    camera: Camera,
    width: int,
    height: int,
    colours: np.ndarray,
    fit: Optional[np.ndarray] = None,
) -> Tuple[np.ndarray, float]:
    """Red, green, blue of 0 to 255, (height, width, 3), and the pixels for each mm. `colours` (256, 3). The picture holds all
    points, or those of `fit` (points, 3)."""
    wide, high = SAMPLES * width, SAMPLES * height
    axes = camera.axes
    shown = fit if fit is not None else np.concatenate([mesh.points for mesh in meshes])
    scale, middle = fitted((shown @ axes.T)[:, :2], wide, high)
    image = np.full((wide * high, 3), float(BACKGROUND))
    depth = np.full(wide * high, -np.inf)
    for mesh in meshes:
        if len(mesh.triangles):
            seen = mesh.points @ axes.T
            screen = (seen[:, :2] - middle) * [scale, -scale] + [wide / 2, high / 2]
            _draw(mesh, np.column_stack([screen, seen[:, 2]]), axes[2], (wide, high), image, depth, colours)
    small = image.reshape(height, SAMPLES, width, SAMPLES, 3).mean(axis=(1, 3))
    return np.round(small).astype(np.uint8), scale / SAMPLES


def _draw(
    mesh: Mesh,
    screen: np.ndarray,
    eye: np.ndarray,
    size: Tuple[int, int],
    image: np.ndarray,
    depth: np.ndarray,
    colours: np.ndarray,
) -> None:
    light = _light(mesh, eye) if mesh.lit else np.ones(len(mesh.points))
    corners = screen[mesh.triangles]  # (triangles, 3, 3)
    low = np.clip(np.floor(corners[:, :, :2].min(axis=1)), 0, np.array(size) - 1).astype(int)
    high = np.clip(np.ceil(corners[:, :, :2].max(axis=1)), 0, np.array(size) - 1).astype(int)
    span = (high - low).max(axis=1) + 1
    for some, side in _classes(span):
        pixel, weights, triangle = _covered(corners[some], low[some], side, size)
        if mesh.beyond is not None:
            kept = np.einsum("ij,ij->i", weights, mesh.beyond[mesh.triangles[some][triangle]]) <= 0
            pixel, weights, triangle = pixel[kept], weights[kept], triangle[kept]
        near = np.einsum("ij,ij->i", weights, corners[some][triangle, :, 2])
        np.maximum.at(depth, pixel, near)
        front = near >= depth[pixel]
        pixel, weights, nodes = pixel[front], weights[front], mesh.triangles[some][triangle[front]]
        shade = np.einsum("ij,ij->i", weights, light[nodes])[:, None]
        if mesh.places is None:
            image[pixel] = GREY * shade
        else:
            place = np.einsum("ij,ij->i", weights, mesh.places[nodes])
            known = np.isfinite(place)
            at = np.round(np.where(known, place, 0.0) * (len(colours) - 1)).astype(int)
            image[pixel] = np.where(known[:, None], colours[at], GREY) * shade


def _classes(span: np.ndarray) -> List[Tuple[np.ndarray, int]]:
    """Triangles of about the same size, few enough to be drawn at once: their numbers and the side of a square that covers
    each."""
    found = []
    side = 2
    done = np.zeros(len(span), dtype=bool)
    while not done.all():
        some = np.flatnonzero(~done & (span <= side))
        done[some] = True
        step = max(1, MOST_AT_ONCE // side**2)
        found += [(some[at : at + step], side) for at in range(0, len(some), step)]
        side *= 2
    return found


def _covered(
    corners: np.ndarray, low: np.ndarray, side: int, size: Tuple[int, int]
) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pixels whose middles are in a triangle: (numbers, weights of the corners, triangle)."""
    y, x = np.divmod(np.arange(side * side), side)
    px, py = low[:, :1] + x, low[:, 1:] + y
    (x0, y0), (x1, y1), (x2, y2) = (corners[:, i, :2].T[:, :, None] for i in range(3))
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    safe = np.where(area == 0, 1.0, area)
    cx, cy = px + 0.5, py + 0.5
    w1 = ((cx - x0) * (y2 - y0) - (x2 - x0) * (cy - y0)) / safe
    w2 = ((x1 - x0) * (cy - y0) - (cx - x0) * (y1 - y0)) / safe
    inside = (w1 >= 0) & (w2 >= 0) & (w1 + w2 <= 1) & (area != 0) & (px < size[0]) & (py < size[1])
    triangle, place = np.nonzero(inside)
    first, second = w1[triangle, place], w2[triangle, place]
    weights = np.stack([1 - first - second, first, second], axis=1)
    return py[triangle, place] * size[0] + px[triangle, place], weights, triangle


def _light(mesh: Mesh, eye: np.ndarray) -> np.ndarray:
    """At each point, by the angle of its normal to the eye; both sides of a surface are lit."""
    a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
    of_triangle = np.cross(b - a, c - a)
    normals = np.zeros_like(mesh.points)
    for i in range(3):
        np.add.at(normals, mesh.triangles[:, i], of_triangle)
    length = np.maximum(np.linalg.norm(normals, axis=1), 1e-300)
    return AMBIENT + (1 - AMBIENT) * np.abs(normals @ eye) / length
