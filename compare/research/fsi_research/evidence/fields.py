"""Fields of a run at one time on linear tetrahedra, for cuts through them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Dict

import numpy as np

from fsi_compare.base.errors import InputError
from fsi_compare.results import fields
from fsi_compare.results.fields import FIRST as FILE

# A quadratic tetrahedron as eight linear ones on its nodes, vertices and then middles of edges in VTK's order: four at
# the vertices, and the octahedron between them about the line from the middle of edge (2, 0) to that of edge (1, 3).
TETRAHEDRA = np.array(
    [(0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3), (6, 8, 4, 5), (6, 8, 5, 9), (6, 8, 9, 7), (6, 8, 7, 4)]
)


@dataclass(frozen=True)
class Medium:
    """Fluid or wall on its tetrahedra, in reference coordinates. Quadratic ones are cut into linear ones."""

    points: np.ndarray  # mm, (nodes, 3)
    cells: np.ndarray  # (tetrahedra, 4)
    data: Dict[str, np.ndarray]  # by name: at nodes or cells, as the run has written it


def read_fields(folder: Path, time: float) -> Dict[str, Medium]:
    """Media by name at `time` in ms. Raises InputError when the run wrote nothing then."""
    media = {}
    for name, found in fields.read_fields(folder).items():
        written = [field for field in found.names if np.any(np.abs(found.times_of(field) - time) < 1e-6)]
        data = {field: found.at(time, field) for field in written}
        if found.layers is not None:
            data["layer"] = found.layers
        if written:
            media[name] = _medium(folder / FILE, found.points, found.cells, data)
    if not media:
        remedy = "choose output.every so that it is"
        raise InputError(folder / FILE, f"time {time:g} ms", "is not among the times written", remedy)
    return media


def _medium(path: Path, points: np.ndarray, cells: np.ndarray, data: Dict[str, np.ndarray]) -> Medium:
    if cells.ndim != 2 or cells.shape[1] not in (4, 10):
        raise InputError(path, "", "shows a scene in two dimensions", 'give a run with geometry = "3d"')
    cells = cells.astype(np.int64)
    if points.ndim != 2 or points.shape[1] != 3 or not len(cells) or cells.min() < 0 or cells.max() >= len(points):
        raise InputError(path, "", "names nodes that are not there", "run it again")
    for name, values in {"points": points, **data}.items():
        if values.dtype.kind not in "fiu" or not values.ndim or not np.all(np.isfinite(values)):
            raise InputError(path, name, "is not an array of finite numbers", "run it again")
        if len(values) not in (len(points), len(cells)):
            raise InputError(path, name, f"has {len(values)} values", "run it again")
    if cells.shape[1] == 10:
        parts = {len(cells): len(TETRAHEDRA), len(points): 1}  # what becomes of an entry
        data = {name: np.repeat(values, parts[len(values)], axis=0) for name, values in data.items()}
        cells = cells[:, TETRAHEDRA].reshape(-1, 4)
    return Medium(points, cells, data)
