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
    data: Dict[str, np.ndarray]  # by name: at nodes (mm, mm/ms, kPa), `layer` at cells


def read_fields(folder: Path, time: float) -> Dict[str, Medium]:
    """Media by name at `time` in ms. Raises InputError when the run wrote nothing then."""
    path = folder / FILE
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise InputError(path, "", f"cannot be read: {error}", "run it with output.every above 0") from None
    media = {}
    for collection in root.iter("Grid"):
        if collection.get("CollectionType") != "Temporal":
            continue
        for grid in collection.findall("Grid"):
            written = grid.find("Time")
            if written is not None and abs(float(written.get("Value", "nan")) - time) < 1e-6:
                media[collection.get("Name", "")] = _medium(folder, grid)
    if not media:
        raise InputError(
            path, f"time {time:g} ms", "is not among the times written", "choose output.every so that it is"
        )
    return media


def _medium(folder: Path, grid: Any) -> Medium:
    data = {attribute.get("Name"): _item(folder, attribute) for attribute in grid.findall("Attribute")}
    cells = _item(folder, grid.find("Topology")).astype(np.int64)
    if cells.shape[1] not in (4, 10):
        raise InputError(folder / FILE, "", "shows a scene in two dimensions", 'give a run with geometry = "3d"')
    if cells.shape[1] == 10:
        cells = cells[:, TETRAHEDRA].reshape(-1, 4)
        if "layer" in data:
            data["layer"] = np.repeat(data["layer"], len(TETRAHEDRA))
    return Medium(_item(folder, grid.find("Geometry")), cells, data)


def _item(folder: Path, element: Any) -> np.ndarray:
    """The data set named by the element, `FILE:/PATH`."""
    file, _, name = element.find("DataItem").text.strip().partition(":")
    try:
        with h5py.File(folder / file, "r") as data:
            return data[name][()]
    except (OSError, KeyError) as error:
        raise InputError(folder / file, name, f"cannot be read: {error}", "run it again") from None
