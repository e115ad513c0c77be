"""Boundary of a mesh of simplices: faces that one cell has alone, triangles or in two dimensions edges; smooth
pieces."""

from dataclasses import dataclass

import numpy as np

from ..mesh_import.joining import first_of_cluster
from ..mesh_import.raw_mesh import SIDES

# By the nodes of a cell, which are in VTK's order.
CORNERS = {3: 3, 6: 3, 4: 4, 10: 4}
SIDES_OF = {3: SIDES["triangle"][1], 6: SIDES["triangle6"][1], 4: SIDES["tetra"][1], 10: SIDES["tetra10"][1]}
IN_FOUR = [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]]  # straight parts of a quadratic triangle
PARTS = {3: [[0, 1]], 6: [[0, 2], [2, 1]], 4: [[0, 1, 2]], 10: IN_FOUR}  # of a side, in its own numbers
SMOOTH = 0.94  # cosine of the angle between faces of one piece, 20 degrees


@dataclass(frozen=True)
class Boundary:
    """Faces of cells, by the numbers of the mesh's nodes."""

    faces: np.ndarray  # corners, (faces, dimension), outwards by the right hand
    parts: np.ndarray  # straight parts of each face, (faces, parts, dimension): one of a linear cell

    def some(self, which: np.ndarray) -> "Boundary":
        """The faces that a mask or numbers choose."""
        return Boundary(self.faces[which], self.parts[which])

    def straight(self) -> np.ndarray:
        """(faces * parts, dimension)."""
        return self.parts.reshape(-1, self.parts.shape[-1])


def boundary_of(points: np.ndarray, cells: np.ndarray, up: np.ndarray) -> Boundary:
    """Boundary of cells with 3, 4, 6 or 10 nodes (see MediumFields.cells); `up`: see normals_of()."""
    nodes = cells.shape[1]
    corners = CORNERS[nodes]
    sides = np.concatenate([cells[:, list(side)] for side in SIDES_OF[nodes]])
    faces, parts = sides[:, : corners - 1], sides[:, PARTS[nodes]]
    _, first, counts = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    alone = np.sort(first[counts == 1])
    faces, parts, owners = faces[alone], parts[alone], cells[alone % len(cells)][:, :corners]
    outwards = points[faces].mean(axis=1) - points[owners].mean(axis=1)
    inside_out = np.einsum("ij,ij->i", normals_of(points, faces, up), outwards) < 0
    faces[inside_out], parts[inside_out] = faces[inside_out, ::-1], parts[inside_out, :, ::-1]
    return Boundary(faces, parts)


def straight_cells(cells: np.ndarray) -> np.ndarray:
    """Triangles of a two-dimensional mesh with straight sides, (triangles, 3): four of each quadratic one."""
    return cells if cells.shape[1] == 3 else cells[:, IN_FOUR].reshape(-1, 3)


def normals_of(points: np.ndarray, faces: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Area vectors of triangles, or length vectors of edges in the plane that `up` is normal to: (faces, 3)."""
    first = points[faces[:, 0]]
    along = points[faces[:, 1]] - first
    return np.cross(along, up) if faces.shape[1] == 2 else 0.5 * np.cross(along, points[faces[:, 2]] - first)


def smooth_pieces(faces: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """A number for each face: neighbours across a common edge (corner) have the same where there is no crease."""
    size = faces.shape[1]
    units = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    sides = np.concatenate([np.delete(faces, i, axis=1) for i in range(size)])
    owners = np.tile(np.arange(len(faces)), size)
    order = np.lexsort(np.sort(sides, axis=1).T[::-1])
    sides, owners = np.sort(sides, axis=1)[order], owners[order]
    same = np.all(sides[1:] == sides[:-1], axis=1)
    pairs = np.stack([owners[:-1][same], owners[1:][same]], axis=1)
    pairs = pairs[np.einsum("ij,ij->i", units[pairs[:, 0]], units[pairs[:, 1]]) > SMOOTH]
    return np.unique(first_of_cluster(len(faces), *pairs.T), return_inverse=True)[1]
