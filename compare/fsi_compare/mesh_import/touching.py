"""Where volumes of a mesh touch: by which sides, or how far they are apart."""

from dataclasses import dataclass
from itertools import combinations, product
from typing import Mapping, Sequence

import numpy as np

from .groups import boundary_of, corner_keys
from .joining import TooMany, near_pairs, nearest_distance
from .raw_mesh import CORNERS, Block


@dataclass
class Contact:
    """How two volumes, or two areas in two dimensions, touch."""

    first: str
    second: str
    dimension: int  # of the mesh
    sides: int  # that both have
    points: int  # that both have, on the surfaces
    distance: float  # mm between the nearest points where no side is shared, infinite beyond a tenth of the mesh
    edge: float = float("inf")  # the shortest of both, mm


def contacts(
    points: np.ndarray, volumes: Mapping[str, Sequence[Block]], dimension: int, distances: bool = True
) -> list[Contact]:
    """The contacts between each two volumes, by name. Without distances only of those that share a side."""
    if len(volumes) < 2:
        return []
    surfaces = {name: boundary_of(blocks, dimension) for name, blocks in volumes.items()}
    nodes = {name: _vertices(blocks) for name, blocks in surfaces.items()}
    span = float(np.ptp(points[np.concatenate(list(nodes.values()))], axis=0).max())
    boxes = {name: (points[there].min(axis=0), points[there].max(axis=0)) for name, there in nodes.items()}
    found = []
    for a, b in combinations(volumes, 2):
        common = len(np.intersect1d(nodes[a], nodes[b], assume_unique=True))
        shared = _shared_sides(surfaces[a], surfaces[b]) if common else 0
        distance = 0.0
        if not shared:
            if not distances:
                continue
            apart = np.maximum(boxes[a][0] - boxes[b][1], boxes[b][0] - boxes[a][1]).max()
            near = apart <= span / 10
            distance = nearest_distance(points[nodes[a]], points[nodes[b]], span / 10) if near else float("inf")
        edge = float("inf") if shared else min(shortest_edge(volumes[name], points) for name in (a, b))
        found.append(Contact(a, b, dimension, shared, common, distance, edge))
    return found


def _vertices(blocks: Sequence[Block]) -> np.ndarray:
    return np.unique(np.concatenate([b.nodes[:, : CORNERS[b.kind]].ravel() for b in blocks]))


def _shared_sides(first: Sequence[Block], second: Sequence[Block]) -> int:
    count = 0
    for a, b in product(first, second):
        corners = CORNERS[a.kind]
        if corners == CORNERS[b.kind]:
            keys = corner_keys(a.kind, np.concatenate([a.nodes[:, :corners], b.nodes[:, :corners]]))
            count += len(np.intersect1d(keys[: len(a.nodes)], keys[len(a.nodes) :]))
    return count


def lonely(volumes: Mapping[str, Sequence[Block]], found: Sequence[Contact]) -> list[str]:
    """Volumes that share no side with another one, where there are several."""
    touching = {name for contact in found if contact.sides for name in (contact.first, contact.second)}
    return [name for name in volumes if name not in touching] if len(volumes) > 1 else []


def touch_words(contact: Contact) -> str:
    sides = "triangles" if contact.dimension == 3 else "edges"
    return f"{contact.first} and {contact.second} touch: {contact.sides} {sides}, {contact.points} points"


def gap_words(contact: Contact) -> str:
    """The gap between two volumes without a side in common, in words."""
    what = f"{contact.first} and {contact.second} share {contact.points or 'no'} points and no side"
    if contact.distance == float("inf"):
        return f"{what}, and are far apart"
    if contact.distance == 0 and contact.points:
        return what
    near = f"their nearest points are {contact.distance:.3g} mm apart"
    if join_for(contact.distance) > contact.edge / 2:
        return f"{what}, {near}, as far as points of one of them"
    return f"{what}, {near}: try --join {join_for(contact.distance):.2g}"


def join_for(distance: float) -> float:
    """A tolerance for --join, mm."""
    return max(2 * distance, 1e-6)


def shortest_edge(blocks: Sequence[Block], points: np.ndarray) -> float:
    """The shortest edge between vertices, mm."""
    shortest = float("inf")
    for block in blocks:
        corners = points[block.nodes[:, : CORNERS[block.kind]]]
        for a, b in combinations(range(corners.shape[1]), 2):
            shortest = min(shortest, float(np.linalg.norm(corners[:, a] - corners[:, b], axis=1).min()))
    return shortest


def doubled_words(points: np.ndarray, blocks: Sequence[Block]) -> str:
    """A warning about vertices that are nearer to each other than any edge of a cell is long: doubled, or left of an
    interface that does not fit. Empty where there are none."""
    edge = shortest_edge(blocks, points)
    corners = _vertices(blocks)
    if edge <= 0:
        return ""  # flat cells are the mesh check's
    try:
        i, j, distances = near_pairs(points[corners], points[corners], edge / 4)
    except TooMany:
        return ""
    kept = i < j
    if not kept.any():
        return ""
    place = ", ".join(f"{x if abs(x) >= 1e-9 else 0.0:.4g}" for x in points[corners[i[kept][0]]])
    farthest = float(distances[kept].max())
    return (
        f"{int(kept.sum())} pairs of points are at most {farthest:.3g} mm apart, a part of the shortest edge ({edge:.3g} mm), one "
        f"at ({place}) mm: where they are doubled, --join {join_for(farthest):.2g} makes them one"
    )
