"""What of a run is shown together: its surfaces by group, and which fields each has."""

from dataclasses import dataclass

import numpy as np

from ..drawing.camera import Camera, best_camera, longest_directions
from .fields import MediumFields
from .opening_faces import middle_of
from .quantities import Quantity, quantities_of
from .surfaces import Surface, Surfaces

ON_LUMEN = ("wall_shear_stress", "tawss", "osi", "rrt")  # fields that are zero elsewhere
FIRST = {False: ("wall_shear_stress", "displacement", "pressure"), True: ("velocity", "displacement", "pressure")}
SNAPS = 0.995  # cosine of the angle to a coordinate axis that a cut's normal takes
# Surfaces that are there by their group. Those of two-dimensional meshes are edges, which are swept around the axis.
IN_SPACE = (("lumen", "lumen"), ("openings", "openings"), ("inner", "wall"), ("outer", "wall"))
GROUPS = {False: IN_SPACE, True: (("fluid section", "section"), ("wall section", "section"), *IN_SPACE)}


@dataclass(frozen=True)
class Part:
    name: str
    group: str  # lumen, openings, wall, cut, section
    surface: Surface

    def shows(self, field: str) -> bool:
        return field in self.surface.names and (field not in ON_LUMEN or self.name == "lumen")


@dataclass(frozen=True)
class CutPlane:
    origin: np.ndarray  # mm, (3,)
    normal: np.ndarray  # of length 1, (3,)


def parts_of(meshes: Surfaces, plane: CutPlane | None) -> list[Part]:
    found = [Part(name, group, meshes.get(name)) for name, group in GROUPS[meshes.flat] if name in meshes.names]
    if plane is not None and not meshes.flat:
        cuts = [(medium, meshes.cut(medium, plane.origin, plane.normal)) for medium in meshes.media]
        found += [Part(f"{medium} cut", "cut", cut) for medium, cut in cuts if len(cut.triangles)]
    return found


def middle_plane(meshes: Surfaces) -> CutPlane | None:
    """Through the middle of the fluid (without one, of the wall), spanned by the directions in which it spreads most;
    None in two dimensions."""
    if meshes.flat:
        return None
    medium = _main_medium(meshes)
    normal = longest_directions(medium.points)[2]
    nearest = int(np.argmax(np.abs(normal)))
    if abs(normal[nearest]) > SNAPS:
        normal = np.eye(3)[nearest]
    return CutPlane(0.5 * (medium.points.min(axis=0) + medium.points.max(axis=0)), normal)


def _main_medium(meshes: Surfaces) -> MediumFields:
    """The fluid; without one the wall."""
    return meshes.media.get("fluid") or next(iter(meshes.media.values()))


def scene_quantities(meshes: Surfaces) -> dict[str, dict[str, Quantity]]:
    """Quantities by key, then by medium. The pressures of fluid and wall are two."""
    found: dict[str, dict[str, Quantity]] = {}
    idle = ":y" if meshes.geometry == "axisymmetric" else ":z"  # what vectors of a two-dimensional scene do not have
    for name, medium in meshes.media.items():
        for quantity in quantities_of(medium):
            if not (meshes.flat and quantity.key.endswith(idle)):
                other = name == "wall" and quantity.field == "pressure"
                found.setdefault(f"wall_{quantity.key}" if other else quantity.key, {})[name] = quantity
    return found


def camera_of(meshes: Surfaces, swept: bool = False) -> Camera:
    """The usual view: two-dimensional scenes straight on, the axis across; swept ones from the open side."""
    if not meshes.flat:
        return best_camera(_main_medium(meshes).points)
    if meshes.geometry != "axisymmetric":
        return Camera(np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0]))
    if swept:
        return Camera(np.array([1.0, -0.45, -0.35]), np.array([0.0, -1.0, 0.0]))
    return Camera(np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0]))


def views_of(meshes: Surfaces) -> list[tuple[str, Camera, np.ndarray | None]]:
    """Names, directions to look from (the usual one, along the axes, from the openings), and the middle to look at in
    mm."""
    found: list[tuple[str, Camera, np.ndarray | None]] = [
        ("section" if meshes.flat else "oblique", camera_of(meshes), None)
    ]
    if meshes.geometry == "axisymmetric":
        found.append(("swept", camera_of(meshes, swept=True), None))
    if meshes.flat:
        return found
    for i, axis in enumerate("xyz"):
        for sign, word in ((1.0, ""), (-1.0, "-")):
            found.append((f"{word}{axis}", Camera(sign * np.eye(3)[i], np.eye(3)[1 if i == 2 else 2]), None))
    for name in meshes.openings:
        middle, normal = middle_of(meshes.media["fluid"].points, meshes.faces(name), meshes.up)
        found.append((name, Camera(normal, np.eye(3)[int(np.argmin(np.abs(normal)))]), middle))
    return found
