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
PARTS = {(2, 2): [[0, 1]], (2, 3): [[0, 2], [2, 1]], (3, 3): [[0, 1, 2]], (3, 6): IN_FOUR}  # by corners and nodes
TURNED = [1, 0, 2, 3, 5, 4]  # nodes of a face the other way around, as many as it has
SMOOTH = 0.94  # cosine of the angle between faces of one piece, 20 degrees


@dataclass(frozen=True)
class Boundary:
    """Faces of cells, or triangles of a flat mesh, by the numbers of the mesh's nodes."""

    nodes: np.ndarray  # (faces, nodes of one), corners first, outwards by the right hand; then middles of edges
    corners: int  # of a face: the dimension

    @property
    def faces(self) -> np.ndarray:
        """Their corners, (faces, corners)."""
        return self.nodes[:, : self.corners]

    def some(self, which: np.ndarray) -> "Boundary":
        """The faces that a mask or numbers choose."""
        return Boundary(self.nodes[which], self.corners)

    def straight(self) -> np.ndarray:
        """Straight parts of the faces, (faces * parts, corners): one of a linear face."""
        return self.nodes[:, PARTS[self.corners, self.nodes.shape[1]]].reshape(-1, self.corners)


def boundary_of(points: np.ndarray, cells: np.ndarray, up: np.ndarray) -> Boundary:
    """Boundary of cells with 3, 4, 6 or 10 nodes (see MediumFields.cells); `up`: see normals_of()."""
    corners = CORNERS[cells.shape[1]]
    sides = np.concatenate([cells[:, list(side)] for side in SIDES_OF[cells.shape[1]]])
    faces = sides[:, : corners - 1]
    _, first, counts = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    alone = np.sort(first[counts == 1])
    sides, faces, owners = sides[alone], faces[alone], cells[alone % len(cells)][:, :corners]
    outwards = points[faces].mean(axis=1) - points[owners].mean(axis=1)
    inside_out = np.einsum("ij,ij->i", normals_of(points, faces, up), outwards) < 0
    sides[inside_out] = sides[inside_out][:, TURNED[: sides.shape[1]]]
    return Boundary(sides, corners - 1)


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
