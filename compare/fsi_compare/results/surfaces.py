"""Surfaces of a run's meshes, with the fields on them over time: what pictures and the scene of a report show."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Mapping

import numpy as np

from ..base.errors import InputError
from ..base.suggestions import hint
from .boundary import CORNERS, Boundary, boundary_of
from .fields import MediumFields
from .opening_faces import named_openings
from .openings import Opening
from .plane_cut import cut_by_plane

NO_FIELDS = "the run has written no fields"
ASK = "set output.fields and output.every (not 0) in the case, and run it again"


@dataclass(frozen=True)
class Surface:
    """Triangles in space, or edges of a two-dimensional mesh, with the fields of fluid or wall.

    A point lies at a node, or of a cut between two.
    """

    name: str
    medium: MediumFields
    ends: np.ndarray  #: numbers of nodes of the medium, (points, 2): the same twice for a point at a node
    weight: np.ndarray  #: of the second of them, (points,)
    triangles: np.ndarray  #: numbers of points, (triangles, 3), outwards by the right hand; (edges, 2) of a line

    def __repr__(self) -> str:
        kind = "triangles" if self.triangles.shape[1] == 3 else "edges"
        return f"<Surface {self.name} of the {self.medium.name}: {len(self.ends)} points, {len(self.triangles)} {kind}>"

    @property
    def nodes(self) -> np.ndarray:
        """Number in the medium of the node at each point, or of the nearer of two, (points,)."""
        return np.where(self.weight <= 0.5, self.ends[:, 0], self.ends[:, 1])

    @cached_property
    def points(self) -> np.ndarray:
        """Reference positions, mm, (points, 3)."""
        return self._between(self.medium.points)

    @property
    def cells(self) -> np.ndarray:
        """Numbers of corners and points of each face or edge, one after the other, as pyvista.PolyData takes them."""
        count = np.full((len(self.triangles), 1), self.triangles.shape[1], dtype=np.int64)
        return np.hstack([count, self.triangles]).ravel()

    @property
    def names(self) -> list[str]:
        """Names of the fields."""
        return self.medium.names

    @property
    def units(self) -> dict[str, str]:
        return self.medium.units

    @property
    def times(self) -> np.ndarray:
        """ms, (entries,)."""
        return self.medium.times

    def at(self, time: float, field: str) -> np.ndarray:
        """Values at the points: (points,), (points, 3) or (points, 6); see MediumFields.at. A field of cells comes as
        the mean of the cells at each node."""
        return self.take(self.medium.at(time, field))

    def take(self, values: np.ndarray) -> np.ndarray:
        """Values at the points, of a field of the medium."""
        return self._between(at_nodes(self.medium, values))

    def _between(self, values: np.ndarray) -> np.ndarray:
        weight = self.weight if values.ndim == 1 else self.weight[:, None]
        first = values[self.ends[:, 0]]
        return first if not self.weight.any() else first + weight * (values[self.ends[:, 1]] - first)


def at_nodes(medium: MediumFields, values: np.ndarray) -> np.ndarray:
    """Values of nodes as they are, of cells as means of those at each node."""
    if len(values) == len(medium.points):
        return values
    count = np.bincount(medium.cells.ravel(), minlength=len(medium.points))
    total = np.zeros((len(medium.points), *values.shape[1:]))
    for i in range(medium.cells.shape[1]):
        np.add.at(total, medium.cells[:, i], values)
    return total / np.maximum(count, 1).reshape(-1, *[1] * (values.ndim - 1))


class Surfaces:
    """Surfaces of one run. Which there are depends on the scene: `names`."""

    def __init__(
        self, folder: Path, fields: Mapping[str, MediumFields], openings: Mapping[str, Opening], geometry: str
    ) -> None:
        if not fields:
            raise InputError(folder, "", NO_FIELDS, ASK)
        self._folder = folder
        self.media = fields
        self._known_openings = openings
        self.geometry = geometry
        self.up = np.array((0.0, -1.0, 0.0) if geometry == "axisymmetric" else (0.0, 0.0, 1.0))  # normal of a flat mesh

    @property
    def flat(self) -> bool:
        """Whether the scene is two-dimensional."""
        return CORNERS[next(iter(self.media.values())).cells.shape[1]] == 3

    @property
    def names(self) -> list[str]:
        """Names that get() knows."""
        return list(self._boundaries)

    @property
    def openings(self) -> list[str]:
        """Names of the openings that were found on the fluid's boundary."""
        return list(self._parts_of_fluid[1]) if "fluid" in self.media else []

    def get(self, name: str) -> Surface:
        """The surface of this name. Raises InputError."""
        if name not in self.names:
            raise InputError(self._folder, "", f"has no surface '{name}'", hint(name, self.names))
        which, boundary = self._boundaries[name]
        return made(name, self.media[which], boundary.straight())

    def cut(self, medium: str, origin: np.ndarray, normal: np.ndarray) -> Surface:
        """The cut of a three-dimensional medium by a plane, in the reference configuration."""
        of = self.media[medium]
        found = cut_by_plane(of.points, of.cells, np.asarray(origin, float), np.asarray(normal, float))
        return Surface(f"{medium} cut", of, *found)

    def faces(self, name: str) -> np.ndarray:
        """Corners of the faces of a boundary, by the nodes of its medium, (faces, dimension)."""
        return self._boundaries[name][1].faces

    @cached_property
    def _boundaries(self) -> dict[str, tuple[str, Boundary]]:
        found: dict[str, tuple[str, Boundary]] = {}
        if "fluid" in self.media:
            whole, openings, interface = self._parts_of_fluid
            closed = np.ones(len(whole.faces), dtype=bool)
            for faces in openings.values():
                closed[faces] = False
            if interface.any():
                found["interface"] = ("fluid", whole.some(interface))
            found["lumen"] = ("fluid", whole.some(closed))
            if openings:
                found["openings"] = ("fluid", whole.some(np.concatenate(list(openings.values()))))
            for name, faces in openings.items():
                found.setdefault(name, ("fluid", whole.some(faces)))
        if "wall" in self.media:
            whole, inner = self._wholes["wall"], self._shared["wall"]
            if inner.any():
                found["inner"] = ("wall", whole.some(inner))
            found["outer"] = ("wall", whole.some(~inner))
        sections = self.media if self.flat else ()
        found |= {f"{name} section": (name, Boundary(self.media[name].cells, 3)) for name in sections}
        return {name: (medium, part) for name, (medium, part) in found.items() if len(part.faces)}

    @cached_property
    def _parts_of_fluid(self) -> tuple[Boundary, dict[str, np.ndarray], np.ndarray]:
        """The fluid's boundary without the axis; its faces of each opening; whether each is on the wall."""
        fluid = self.media["fluid"]
        whole, interface = self._wholes["fluid"], self._shared["fluid"]
        free = np.flatnonzero(~interface)
        turned = self.geometry == "axisymmetric"
        found = named_openings(fluid, whole.some(free), self._known_openings, self.up, turned)
        return whole, {name: free[faces] for name, faces in found.items()}, interface

    @cached_property
    def _wholes(self) -> dict[str, Boundary]:
        """Boundary of each medium, without the axis of an axisymmetric scene and faces between layers, which two have."""
        found = {}
        for name, medium in self.media.items():
            whole = boundary_of(medium.points, medium.cells, self.up)
            if self.geometry == "axisymmetric":
                radius = np.abs(medium.points[whole.faces][:, :, 0])
                whole = whole.some(~np.all(radius < 1e-9 * np.ptp(medium.points), axis=1))
            found[name] = whole.some(_counts(np.sort(self._places[name][whole.faces], axis=1)) == 1)
        return found

    @cached_property
    def _places(self) -> dict[str, np.ndarray]:
        """Numbers of the places of each medium's nodes. Nodes of two media or layers have the same ones, to the bit."""
        points = [medium.points for medium in self.media.values()]
        numbers = np.unique(np.concatenate(points), axis=0, return_inverse=True)[1]
        return dict(zip(self.media, np.split(numbers, np.cumsum([len(each) for each in points])[:-1])))

    @cached_property
    def _shared(self) -> dict[str, np.ndarray]:
        """Whether each face of a medium is also one of the other."""
        keys = [np.sort(self._places[name][whole.faces], axis=1) for name, whole in self._wholes.items()]
        counts = _counts(np.concatenate(keys))
        return dict(zip(self.media, np.split(counts == 2, np.cumsum([len(each) for each in keys])[:-1])))


def _counts(keys: np.ndarray) -> np.ndarray:
    """How often each row is there."""
    of, counts = np.unique(keys, axis=0, return_inverse=True, return_counts=True)[1:]
    return counts[of]


def made(name: str, medium: MediumFields, parts: np.ndarray) -> Surface:
    """A surface from triangles or edges by nodes of the medium."""
    nodes, local = np.unique(parts, return_inverse=True)
    return Surface(name, medium, np.stack([nodes, nodes], axis=1), np.zeros(len(nodes)), local.reshape(parts.shape))


def displaced(surface: Surface, time: float, factor: float = 1.0) -> np.ndarray:
    """Positions at a time, mm, the displacement times a factor; reference positions where none was written."""
    if "displacement" not in surface.names or factor == 0:
        return surface.points
    return surface.points + factor * surface.at(time, "displacement")
