"""Which faces of the fluid's boundary are its openings. `fields.h5` has no names of surfaces; an opening is a flat
piece of the boundary whose flow and mean pressure are those of a name in `openings.csv` or `flow.csv`."""

from itertools import compress
from typing import Mapping, Sequence

import numpy as np

from ..runs.levels import thinned
from .boundary import Boundary, normals_of, smooth_pieces
from .fields import MediumFields
from .openings import Opening
from .units import PER_KPA

FLAT = 1e-3  # of the normals of a flat piece: how far apart their components are
# Of the largest flow and pressure of any opening; where the mesh's motion was not written, an opening may have moved.
AGREES, AGREES_UNMOVED = 1e-4, 0.05
TELLS, EXACT = 3.0, 1e-9  # one fit is better than another: how many times; and what is rounding
LEVELS = 4  # times at which flow and pressure are compared


def flat_pieces(points: np.ndarray, boundary: Boundary, up: np.ndarray) -> list[np.ndarray]:
    """Numbers of the faces of each flat piece."""
    normals = normals_of(points, boundary.faces, up)
    units = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    numbers = smooth_pieces(boundary.faces, normals)
    pieces = (np.flatnonzero(numbers == number) for number in np.unique(numbers))
    return [faces for faces in pieces if np.ptp(units[faces], axis=0).max() < FLAT]


def named_openings(
    fluid: MediumFields, boundary: Boundary, openings: Mapping[str, Opening], up: np.ndarray, turned: bool
) -> dict[str, np.ndarray]:
    """Numbers of an opening's faces by its name, 'left or right 1' where each of several fits; what matches none is left
    out. `turned`: axisymmetric, x is the radius."""
    levels, pieces = _levels(fluid, openings), flat_pieces(fluid.points, boundary, up)
    if not len(levels) or not pieces:
        return {}
    measured = _measured(fluid, [boundary.some(piece) for piece in pieces], levels, up, turned)
    curves = [(opening.time, (opening.flow, opening.mean_pressure)) for opening in openings.values()]
    given = np.array([[np.interp(levels, time, row) for row in rows] for time, rows in curves])
    scale = np.abs(given).max(axis=(0, 2))
    scale[scale == 0] = np.nan
    apart = np.abs(measured[:, None] - given) / scale[:, None]
    if np.isnan(apart).all():  # nothing tells an opening from a wall
        return {}
    misfit = np.nan_to_num(apart, nan=0.0).max(axis=(2, 3))
    fits = misfit < (AGREES if "displacement" in fluid.names else AGREES_UNMOVED)
    for axis in (0, 1):  # no other piece fits the name better, no other name the piece
        fits &= misfit <= np.maximum(TELLS * misfit.min(axis=axis, keepdims=True), EXACT)
    found: dict[str, np.ndarray] = {}
    for row in sorted(set(map(tuple, fits.tolist())), reverse=True):
        alike = np.flatnonzero((fits == row).all(axis=1))
        name = " or ".join(compress(openings, row))
        if len(alike) <= row.count(True):  # else there are walls among them
            found |= {f"{name} {i}" if len(alike) > 1 else name: pieces[piece] for i, piece in enumerate(alike, 1)}
    return found


def _levels(fluid: MediumFields, openings: Mapping[str, Opening]) -> np.ndarray:
    """Some times that fields and openings both have."""
    first = max((float(opening.time[0]) for opening in openings.values()), default=np.inf)
    last = min((float(opening.time[-1]) for opening in openings.values()), default=0.0)
    times = fluid.times[(fluid.times >= first * (1 - 1e-9)) & (fluid.times <= last * (1 + 1e-9))]
    return times[thinned(len(times), LEVELS)]


def _measured(
    fluid: MediumFields, pieces: Sequence[Boundary], levels: np.ndarray, up: np.ndarray, turned: bool
) -> np.ndarray:
    """Flow and mean pressure of pieces of the boundary where they are, (pieces, 2, levels); NaN for a field that is not
    there. As the drivers have it: integrals of u . n and p over faces, which may be curved, with p linear in them."""
    places, weights = _rule(pieces[0].corners)
    count = pieces[0].nodes.shape[1]
    shapes, (origin, *ends) = _shapes(places, count), np.eye(pieces[0].corners)
    slopes = [0.5 * (_shapes(places + end - origin, count) - _shapes(places - end + origin, count)) for end in ends]
    rows = np.full((len(pieces), 2, len(levels)), np.nan)
    names = [name if name in fluid.names else None for name in ("velocity", "pressure", "displacement")]
    for i, time in enumerate(levels):
        velocity, pressure, displacement = (fluid.at(float(time), name) if name else None for name in names)
        points = fluid.points if displacement is None else fluid.points + displacement
        for row, piece in zip(rows, pieces):
            x = points[piece.nodes]
            normals = np.cross(slopes[0] @ x, slopes[1] @ x if len(slopes) > 1 else up) * weights[:, None]
            if turned:
                normals *= 2 * np.pi * (shapes @ x)[:, :, :1]
            if velocity is not None:
                row[0, i] = np.sum(shapes @ velocity[piece.nodes] * normals)
            if pressure is not None:
                areas = np.linalg.norm(normals, axis=2)
                row[1, i] = PER_KPA["Pa"] * np.sum(pressure[piece.faces] @ places.T * areas) / areas.sum()
    return rows


def _rule(corners: int) -> tuple[np.ndarray, np.ndarray]:
    """Barycentric coordinates (points, corners) and weights of a rule of degree 6 on an edge or triangle."""
    x, weights = (values / 2 for values in np.polynomial.legendre.leggauss(4))
    x = x + 0.5
    if corners == 2:
        return np.stack([1 - x, x], axis=1), weights
    u, v = (values.ravel() for values in np.meshgrid(x, x))
    return np.stack([(1 - u) * (1 - v), u, (1 - u) * v], axis=1), np.outer(weights, weights).ravel() * (1 - u)


def _shapes(places: np.ndarray, count: int) -> np.ndarray:
    """Shape functions of a face with that many nodes at barycentric coordinates, (points, count)."""
    if places.shape[1] == count:
        return places
    middles = 4 * places * np.roll(places, -1, axis=1)
    return np.hstack([places * (2 * places - 1), middles])[:, :count]


def middle_of(points: np.ndarray, faces: np.ndarray, up: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Middle of a piece, mm, and its normal outwards, of length 1."""
    normals = normals_of(points, faces, up)
    area = np.linalg.norm(normals, axis=1)
    normal = normals.sum(axis=0)
    return (points[faces].mean(axis=1) * area[:, None]).sum(axis=0) / area.sum(), normal / np.linalg.norm(normal)
