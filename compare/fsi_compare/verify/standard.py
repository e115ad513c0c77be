"""Samples for a case that asks for none: a point for each medium, where most happens at the end of the run."""

from pathlib import Path
from typing import Any

import numpy as np

from ..results.fields import read_fields

FIELDS = {"wall": "displacement", "fluid": "velocity"}
DIGITS = 9  # significant, of a coordinate: as a case file has them


def standard_points(folder: Path) -> dict[str, Any]:
    """Entries of a case by their full keys, from the fields of its own run; empty where it has written none. A point
    lies in the middle of the element whose nodes move most together, so that finer meshes have it inside, too."""
    found: dict[str, Any] = {}
    for medium, fields in read_fields(folder).items():
        field = FIELDS.get(medium, "")
        if field not in fields.names:
            continue
        times = fields.times_of(field)
        values = np.asarray(fields.at(float(times[-1]), field), dtype=float)
        corners = fields.cells[:, : 3 if fields.cells.shape[1] in (3, 6) else 4]
        sizes = np.linalg.norm(values.reshape(len(values), -1), axis=1)
        cell = int(np.argmax(np.mean(sizes[corners], axis=1)))
        middle = np.mean(fields.points[corners[cell]], axis=0)
        found[f"output.points.{medium}_most"] = [float(f"{x:.{DIGITS}g}") for x in middle]
    return found
