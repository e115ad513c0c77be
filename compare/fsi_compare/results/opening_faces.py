"""Which faces of the fluid's boundary are its openings. `fields.h5` has no names of surfaces; an opening is a flat
piece of the boundary whose flow and mean pressure are those of a name in `openings.csv` or `flow.csv`."""

from typing import Mapping

import numpy as np

from ..runs.levels import thinned
from .boundary import Boundary, normals_of, smooth_pieces
from .fields import MediumFields
from .openings import Opening

FLAT = 1e-3  # of the normals of a flat piece: how far they are from their mean
AGREES = 0.05  # of the largest flow and pressure of any opening; the parts of a quadratic face are straight here
LEVELS = 4  # times at which flow and pressure are compared
PA_PER_KPA = 1000.0


def flat_pieces(points: np.ndarray, boundary: Boundary, up: np.ndarray) -> list[np.ndarray]:
    """Numbers of the faces of each flat piece."""
    normals = normals_of(points, boundary.faces, up)
    numbers = smooth_pieces(boundary.faces, normals)
    units = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    found = []
    for number in range(numbers.max() + 1 if len(numbers) else 0):
        faces = np.flatnonzero(numbers == number)
        mean = normals[faces].sum(axis=0)
        mean = mean / max(float(np.linalg.norm(mean)), 1e-300)
        if np.all(np.linalg.norm(units[faces] - mean, axis=1) < FLAT):
            found.append(faces)
    return found


def named_openings(
    fluid: MediumFields,
    boundary: Boundary,
    pieces: list[np.ndarray],
    openings: Mapping[str, Opening],
    up: np.ndarray,
    turned: bool,
) -> dict[str, np.ndarray]:
    """Faces by the name of the opening; those that match none are left out. `turned`: axisymmetric, x is the radius."""
    levels = _levels(fluid, openings)
    if not len(levels) or not pieces:
        return {}
    measured = np.array([_measured(fluid, boundary.some(piece), levels, up, turned) for piece in pieces])
    given = np.array([_given(opening, levels) for opening in openings.values()])
    scale = np.nanmax(np.abs(given), axis=(0, 2))
    scale[~(scale > 0)] = np.inf
    apart = np.abs(measured[:, None] - given[None]) / scale[None, None, :, None]
    misfit = np.nanmax(np.nan_to_num(apart, nan=0.0), axis=(2, 3))
    found: dict[str, np.ndarray] = {}
    taken: list[int] = []
    names = list(openings)
    for flat in np.argsort(misfit, axis=None):
        piece, name = int(flat) // len(names), names[int(flat) % len(names)]
        if misfit.flat[flat] < AGREES and piece not in taken and name not in found:
            found[name] = pieces[piece]
            taken.append(piece)
    return {name: found[name] for name in names if name in found}


def _levels(fluid: MediumFields, openings: Mapping[str, Opening]) -> np.ndarray:
    """Some times that fields and openings both have."""
    if not openings or not {"velocity", "pressure"} & set(fluid.names):
        return np.zeros(0)
    first = max(float(opening.time[0]) for opening in openings.values())
    last = min(float(opening.time[-1]) for opening in openings.values())
    times = fluid.times[(fluid.times >= first * (1 - 1e-9)) & (fluid.times <= last * (1 + 1e-9))]
    return times[thinned(len(times), LEVELS)]


def _given(opening: Opening, levels: np.ndarray) -> np.ndarray:
    """(2, levels): flow and mean pressure."""
    return np.array([np.interp(levels, opening.time, row) for row in (opening.flow, opening.mean_pressure)])


def _measured(fluid: MediumFields, piece: Boundary, levels: np.ndarray, up: np.ndarray, turned: bool) -> np.ndarray:
    """Flow and mean pressure of a piece of the boundary, (2, levels); NaN for a field that is not there."""
    parts = piece.straight()
    normals = normals_of(fluid.points, parts, up)
    area = np.linalg.norm(normals, axis=1)
    if turned:
        radius = fluid.points[parts][:, :, 0]  # values and radius are linear along an edge
        weights = 2 * np.pi * area[:, None] * (radius / 6 + radius.sum(axis=1, keepdims=True) / 6)
    else:
        weights = np.repeat(area[:, None] / parts.shape[1], parts.shape[1], axis=1)
    units = normals / np.maximum(area[:, None], 1e-300)
    rows = np.full((2, len(levels)), np.nan)
    for i, time in enumerate(levels):
        velocity, pressure = (_at(fluid, time, name) for name in ("velocity", "pressure"))
        if velocity is not None:
            rows[0, i] = np.sum(weights * np.einsum("fpi,fi->fp", velocity[parts], units))
        if pressure is not None:
            rows[1, i] = PA_PER_KPA * np.sum(weights * pressure[parts]) / weights.sum()
    return rows


def _at(fluid: MediumFields, time: float, name: str) -> np.ndarray | None:
    return fluid.at(float(time), name) if name in fluid.names else None


def middle_of(points: np.ndarray, faces: np.ndarray, up: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Middle of a piece, mm, and its normal outwards, of length 1."""
    normals = normals_of(points, faces, up)
    area = np.linalg.norm(normals, axis=1)
    normal = normals.sum(axis=0)
    return (points[faces].mean(axis=1) * area[:, None]).sum(axis=0) / area.sum(), normal / np.linalg.norm(normal)
