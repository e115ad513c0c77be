"""Nodal fields of a run at one time, found through `fields.xdmf` and read from the HDF5 file that it names."""

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict

import h5py
import numpy as np

from ...base.errors import InputError

FILE = "fields.xdmf"

# A quadratic tetrahedron as eight linear ones on its nodes, vertices and then middles of edges in VTK's order: four at the
# vertices, and the octahedron between them about the line from the middle of edge (2, 0) to that of edge (1, 3).
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
    path = folder / FILE
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ValueError, ElementTree.ParseError) as error:
        raise InputError(path, "", f"cannot be read: {error}", "run it with output.every above 0") from None
    media = {}
    for collection in root.iter("Grid"):
        if collection.get("CollectionType") != "Temporal":
            continue
        for grid in collection.findall("Grid"):
            written = grid.find("Time")
            if written is not None and abs(_value(written) - time) < 1e-6:
                media[collection.get("Name", "")] = _medium(folder, grid)
    if not media:
        raise InputError(
            path, f"time {time:g} ms", "is not among the times written", "choose output.every so that it is"
        )
    return media


def _value(written: Any) -> float:
    try:
        return float(written.get("Value", "nan"))
    except ValueError:
        return float("nan")


def _medium(folder: Path, grid: Any) -> Medium:
    attributes = {attribute.get("Name"): attribute for attribute in grid.findall("Attribute")}
    data = {name: _item(folder, attribute) for name, attribute in attributes.items()}
    cells, points = _item(folder, grid.find("Topology")), _item(folder, grid.find("Geometry"))
    if cells.ndim != 2 or cells.shape[1] not in (4, 10):
        raise InputError(folder / FILE, "", "shows a scene in two dimensions", 'give a run with geometry = "3d"')
    cells = cells.astype(np.int64)
    if points.ndim != 2 or points.shape[1] != 3 or not len(cells) or cells.min() < 0 or cells.max() >= len(points):
        raise InputError(folder / FILE, "", "names nodes that are not there", "run it again")
    for name, values in data.items():
        if not len(values) or len(values) not in (len(points), len(cells)):
            raise InputError(folder / FILE, str(name), f"has {len(values)} values", "run it again")
    if cells.shape[1] == 10:
        cells = cells[:, TETRAHEDRA].reshape(-1, 4)
        for name, attribute in attributes.items():
            if attribute.get("Center") == "Cell":
                data[name] = np.repeat(data[name], len(TETRAHEDRA), axis=0)
    return Medium(points, cells, data)


def _item(folder: Path, element: Any) -> np.ndarray:
    """The data set named by the element, `FILE:/PATH`."""
    item = element.find("DataItem") if element is not None else None
    if item is None or not item.text or ":" not in item.text:
        raise InputError(folder / FILE, "", "does not say where the values are", "run it again")
    file, _, name = item.text.strip().partition(":")
    try:
        with h5py.File(folder / file, "r") as data:
            values = np.asarray(data[name][()])
    except (OSError, KeyError, ValueError, TypeError, AttributeError, RuntimeError) as error:
        raise InputError(folder / file, name, f"cannot be read: {error}", "run it again") from None
    if values.dtype.kind not in "fiu" or not values.ndim or not np.all(np.isfinite(values)):
        raise InputError(folder / file, name, "is not an array of finite numbers", "run it again")
    return values
