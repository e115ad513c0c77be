"""Draws triangles by a depth buffer in numpy: the same picture on every machine, without graphics hardware or X
server."""

from dataclasses import dataclass
from typing import Sequence

import numpy as np

from .camera import Camera, fitted

BACKGROUND = 255
GREY = np.array([205.0, 205.0, 205.0])  # of surfaces without values
AMBIENT = 0.58  # of the light; the rest comes from the eye
SAMPLES = 2  # in each direction of a pixel
MOST_AT_ONCE = 4_000_000  # pixels of the rectangles around triangles


@dataclass(frozen=True)
class Mesh:
    """Triangles with a place 0 to 1 in a table of colours for each point; None: grey."""

    points: np.ndarray  # (points, 3)
    triangles: np.ndarray  # (triangles, 3)
    places: np.ndarray | None  # (points,)
    lit: bool = True  # shaded by the angle to the eye; sections are not
    beyond: np.ndarray | None = None  # (points,): what is positive, linear between points, is cut away


def rendered(
    meshes: Sequence[Mesh], camera: Camera, width: int, height: int, colours: np.ndarray
) -> tuple[np.ndarray, float]:
    """Red, green, blue of 0 to 255, (height, width, 3), and the pixels for each mm. `colours` (256, 3). The picture
    holds all points."""
    wide, high = SAMPLES * width, SAMPLES * height
    axes = camera.axes
    shown = np.concatenate([mesh.points for mesh in meshes])
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
    size: tuple[int, int],
    image: np.ndarray,
    depth: np.ndarray,
    colours: np.ndarray,
) -> None:
    light = _light(mesh, eye) if mesh.lit else np.ones(len(mesh.points))
    for some in _chunks(screen[mesh.triangles]):
        triangles = mesh.triangles[some]
        pixel, weights, triangle = _covered(screen[triangles], size)
        nodes = triangles[triangle]
        if mesh.beyond is not None:
            kept = np.einsum("ij,ij->i", weights, mesh.beyond[nodes]) <= 0
            pixel, weights, nodes = pixel[kept], weights[kept], nodes[kept]
        near = np.einsum("ij,ij->i", weights, screen[nodes, 2])
        order = np.argsort(near, kind="stable")
        nearest = np.full(len(depth), -1)
        nearest[pixel[order]] = order  # of several the last stays
        found = nearest[pixel[order]] == order
        front = order[found][near[order[found]] > depth[pixel[order[found]]]]
        pixel, weights, nodes = pixel[front], weights[front], nodes[front]
        depth[pixel] = near[front]
        shade = np.einsum("ij,ij->i", weights, light[nodes])[:, None]
        if mesh.places is None:
            image[pixel] = GREY * shade
        else:
            place = np.einsum("ij,ij->i", weights, mesh.places[nodes])
            known = np.isfinite(place)
            at = np.round(np.where(known, place, 0.0) * (len(colours) - 1)).astype(int)
            image[pixel] = np.where(known[:, None], colours[at], GREY) * shade


def _chunks(corners: np.ndarray) -> list[np.ndarray]:
    """Triangles that cover few enough pixels to be drawn at once."""
    spans = np.ptp(corners[:, :, :2], axis=1) + 1
    covered = np.cumsum(spans[:, 0] * spans[:, 1])
    parts = np.split(np.arange(len(corners)), np.flatnonzero(np.diff(covered // MOST_AT_ONCE)) + 1)
    return [part for part in parts if len(part)]


def _covered(corners: np.ndarray, size: tuple[int, int]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pixels whose middles are in a triangle: (numbers, weights of the corners, triangle). Row by row: a row of pixels
    meets a triangle in the interval between its sides."""
    x, y = corners[:, :, 0], corners[:, :, 1]
    low = np.clip(np.ceil(y.min(axis=1) - 0.5), 0, size[1]).astype(int)
    high = np.clip(np.floor(y.max(axis=1) - 0.5) + 1, 0, size[1]).astype(int)
    triangle, row = _enumerated(low, high)
    middle = row + 0.5
    first, last = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for i in range(3):
        xa, ya, xb, yb = (values[triangle] for values in (x[:, i], y[:, i], x[:, i - 1], y[:, i - 1]))
        meets = (np.minimum(ya, yb) <= middle) & (middle <= np.maximum(ya, yb)) & (ya != yb)
        at = xa + (xb - xa) * (middle - ya) / np.where(meets, yb - ya, 1.0)
        first, last = np.where(meets, np.minimum(first, at), first), np.where(meets, np.maximum(last, at), last)
    left = np.clip(np.ceil(np.where(np.isfinite(first), first, 1.0) - 0.5), 0, size[0]).astype(int)
    right = np.clip(np.floor(np.where(np.isfinite(first), last, 0.0) - 0.5) + 1, 0, size[0]).astype(int)
    line, column = _enumerated(left, right)
    row, triangle = row[line], triangle[line]
    return row * size[0] + column, _weights(corners[:, :, :2], triangle, column + 0.5, row + 0.5), triangle


def _enumerated(first: np.ndarray, end: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(which, number): all numbers from first[which] to below end[which]."""
    counts = np.maximum(end - first, 0)
    which = np.repeat(np.arange(len(first)), counts)
    begins = np.cumsum(counts) - counts
    return which, np.arange(len(which)) - np.repeat(begins, counts) + first[which]


def _weights(corners: np.ndarray, triangle: np.ndarray, px: np.ndarray, py: np.ndarray) -> np.ndarray:
    """Barycentric coordinates of points, (points, 3)."""
    origin, along, across = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = along[:, 0] * across[:, 1] - across[:, 0] * along[:, 1]
    safe = np.where(area == 0, 1.0, area)[triangle]
    dx, dy = px - origin[triangle, 0], py - origin[triangle, 1]
    first = (dx * across[triangle, 1] - across[triangle, 0] * dy) / safe
    second = (along[triangle, 0] * dy - dx * along[triangle, 1]) / safe
    return np.stack([1 - first - second, first, second], axis=1)


def _light(mesh: Mesh, eye: np.ndarray) -> np.ndarray:
    """Light at each point, by the angle of its normal to the eye; both sides of a surface are lit."""
    a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
    of_triangle = np.cross(b - a, c - a)
    normals = np.zeros_like(mesh.points)
    for i in range(3):
        np.add.at(normals, mesh.triangles[:, i], of_triangle)
    length = np.maximum(np.linalg.norm(normals, axis=1), 1e-300)
    return AMBIENT + (1 - AMBIENT) * np.abs(normals @ eye) / length
