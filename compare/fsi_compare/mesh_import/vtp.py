"""Reads surfaces of VTK's XML format (.vtp)."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..base.errors import InputError
from .raw_mesh import RawMesh
from .vtk_xml import VtkFile, pieces, read_by, require_points, scalars_of


@dataclass
class Surface:
    """Points, mm or whatever the file has; polygons as lists of points; fields of the points."""

    points: np.ndarray
    polygons: list[list[int]] = field(default_factory=list)
    fields: dict[str, np.ndarray] = field(default_factory=dict)


def read_vtp(path: Path) -> Surface:
    """The polygons of all pieces. Raises InputError."""
    return read_by(_read, path, "PolyData", "surface")


def _read(file: VtkFile) -> Surface:
    surface = Surface(np.zeros((0, 3)))
    parts: dict[str, list[np.ndarray]] = {}
    for piece, points in pieces(file):
        if int(piece.get("NumberOfStrips") or 0) > 0:
            raise InputError(file.path, "", "holds strips of triangles", "write its surface as polygons")
        first = len(surface.points)
        surface.points = np.vstack((surface.points, points))
        arrays = {a.get("Name"): a for a in piece.findall("Polys/DataArray")}
        if "offsets" in arrays:
            corners, ends = file.array(arrays["connectivity"]), file.array(arrays["offsets"])
            surface.polygons += [[int(p) + first for p in part] for part in np.split(corners, ends[:-1]) if len(part)]
        for element in piece.findall("PointData/DataArray"):
            parts.setdefault(element.get("Name", ""), []).append(file.array(element))
    surface.fields = {name: np.concatenate(found) for name, found in parts.items()}
    return surface


def read_faces(path: Path) -> RawMesh:
    """Its triangles as a mesh, with fields of one number a triangle or point. Raises InputError."""
    return read_by(_read_faces, path, "PolyData", "surface")


def _read_faces(file: VtkFile) -> RawMesh:
    points: list[np.ndarray] = []
    triangles: list[np.ndarray] = []
    cell_data: dict[str, list[np.ndarray]] = {}
    passed_over: dict[str, None] = {}
    first = 0
    for piece, there in pieces(file):
        if any(int(piece.get(f"NumberOf{kind}") or 0) for kind in ("Verts", "Lines", "Strips")):
            raise InputError(file.path, "", "holds vertices, lines or strips", "write its surface as triangles")
        points.append(there)
        arrays = {a.get("Name"): a for a in piece.findall("Polys/DataArray")}
        if "offsets" in arrays:
            nodes, ends = file.array(arrays["connectivity"]).astype(np.int64), file.array(arrays["offsets"])
            if np.any(np.diff(ends.astype(np.int64), prepend=0) != 3) or len(nodes) != 3 * len(ends):
                raise InputError(file.path, "Polys", "holds polygons that are no triangles", "triangulate the surface")
            require_points(file, nodes, len(there))
            triangles.append(nodes.reshape(-1, 3) + first)
            for name, values in scalars_of(file, piece, "CellData", len(ends), passed_over).items():
                cell_data.setdefault(name, []).append(values)
        first += len(there)
    if not triangles:
        raise InputError(file.path, "", "holds no polygons", "write the surface anew as .vtp")
    whole = {name: [np.concatenate(parts)] for name, parts in cell_data.items() if len(parts) == len(triangles)}
    blocks = [("triangle", np.concatenate(triangles))]
    return RawMesh(np.concatenate(points), blocks, whole, passed_over=list(passed_over))


def scalar_field(surface: Surface, name: str, path: Path) -> np.ndarray:
    """A field of one number a point. Raises InputError that lists those there are."""
    scalars = [n for n, values in surface.fields.items() if values.ndim == 1 and len(values) == len(surface.points)]
    if name not in scalars:
        remedy = f"those there are: {', '.join(scalars) or 'none'}"
        raise InputError(path, name, "is no field of one number at each point", remedy)
    return surface.fields[name]
