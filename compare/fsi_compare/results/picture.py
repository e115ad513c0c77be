"""A run's vessel with a result on it, as a figure."""

from typing import TYPE_CHECKING, Sequence

import numpy as np

from ..base.errors import InputError
from ..base.suggestions import hint
from ..drawing.camera import Camera
from ..drawing.colours import PERCENTILE, Scale, round_ticks, scale_of, table
from ..drawing.raster import Mesh, rendered
from ..drawing.sweep import angles, swept, turned
from ..runs.levels import thinned
from .quantities import Quantity
from .scene_parts import FIRST, CutPlane, Part, camera_of, middle_plane, parts_of, scene_quantities, views_of
from .surfaces import Surfaces, displaced
from .units import PER_KPA, time_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PIXELS, BORDER = (900, 580), 8  # of a picture, and around what it shows
MOST_LEVELS = 40  # that the range of colours is found from
VISIBLE = 0.05  # of the scene's size
INCHES_WIDE, MOST_HIGH = 7.0, 4.6


class Scene:
    """Parts of one run that pictures are made from, read once for many pictures."""

    def __init__(self, meshes: Surfaces, file: str, static: bool) -> None:
        self.meshes = meshes
        self.file = file
        self.static = static
        self.plane = middle_plane(meshes)
        self.parts = parts_of(meshes, self.plane)
        self.quantities = scene_quantities(meshes)
        self._ranges: dict[str, tuple[Scale, float]] = {}
        if not self.quantities:
            raise InputError(file, "", "holds no field that can be shown", "set output.fields in the case")

    @property
    def first(self) -> str:
        """The quantity that a reader is shown first."""
        return next(key for key in (*FIRST[self.meshes.flat], *self.quantities) if key in self.quantities)

    def check(self, key: str) -> None:
        if key not in self.quantities:
            raise InputError(self.file, "", f"has no field '{key}'", hint(key, self.quantities))

    def times(self, key: str) -> np.ndarray:
        """Times of the entries that have the quantity, ms."""
        (name, quantity), *_ = self.quantities[key].items()
        return self.meshes.media[name].times_of(quantity.field)

    def quantity(self, key: str) -> Quantity:
        return next(iter(self.quantities[key].values()))

    def values(self, part: Part, key: str, time: float) -> np.ndarray | None:
        """Values at the points of a part; None where the part has none."""
        quantity = self.quantities[key].get(part.surface.medium.name)
        if quantity is None or not part.shows(quantity.field):
            return None
        return quantity.of(part.surface.at(time, quantity.field))

    def scale(self, key: str) -> Scale:
        """One for all times."""
        return self._range(key)[0]

    def peak(self, key: str) -> float:
        """The time in ms at which the 99th percentile of its size is largest."""
        return self._range(key)[1]

    def visible_factor(self) -> float:
        """1, 2 or 5 times a power of ten by which the largest displacement is a twentieth of the scene's size; 1 where
        it is as large by itself, or where there is none."""
        if "displacement" not in self.quantities:
            return 1.0
        size = max(float(np.ptp(medium.points, axis=0).max()) for medium in self.meshes.media.values())
        largest = self.scale("displacement").largest
        wanted = VISIBLE * size / largest if largest > 0 else 1.0
        power = 10.0 ** np.floor(np.log10(wanted)) if wanted > 1 else 1.0
        return float(max(step * power for step in (1.0, 2.0, 5.0) if step * power <= max(wanted, 1.0)))

    def _range(self, key: str) -> tuple[Scale, float]:
        if key not in self._ranges:
            times = self.times(key)
            times = times[thinned(len(times), MOST_LEVELS)]
            levels = [self._level(key, float(time)) for time in times]
            parts = [[np.abs(v) for v in level if len(v)] for level in levels]
            sizes = [max((float(np.percentile(v, PERCENTILE)) for v in part), default=0.0) for part in parts]
            scale = scale_of((v for level in levels for v in level), self.quantity(key).signed)
            self._ranges[key] = scale, float(times[int(np.nanargmax(sizes))])
        return self._ranges[key]

    def _level(self, key: str, time: float) -> list[np.ndarray]:
        """Values of all parts; each medium is read once."""
        found: list[np.ndarray] = []
        for name, quantity in self.quantities[key].items():
            values = self.meshes.media[name].at(time, quantity.field)
            parts = [part for part in self.parts if part.surface.medium.name == name and part.shows(quantity.field)]
            found += [quantity.of(part.surface.take(values)) for part in parts]
        return found

    def shown(self, key: str, cut: bool) -> list[Part]:
        """The section in two dimensions; else the surfaces that have the quantity, or what a cut leaves of them."""
        fields = {name: q.field for name, q in self.quantities[key].items()}
        has = [part for part in self.parts if part.shows(fields.get(part.surface.medium.name, ""))]
        if self.meshes.flat:
            return self.parts
        if cut:
            return [part for part in self.parts if part.group in {"cut", "lumen", "openings", "wall"}]
        solid = [part for part in has if part.group != "cut"]
        of_fluid_alone = "fluid" in fields and "wall" not in fields
        return [part for part in solid if not (part.group == "wall" and of_fluid_alone)]


def meshes_to_draw(
    scene: Scene, key: str, time: float, scale: Scale, factor: float, cut: bool, eye: np.ndarray
) -> list[Mesh]:
    """Triangles with the places of their colours."""
    found: list[Mesh] = []
    turns = scene.meshes.geometry == "axisymmetric"
    for part in scene.shown(key, cut):
        values = scene.values(part, key, time)
        places = None if values is None else scale.places(values)
        points, cells = displaced(part.surface, time, factor), part.surface.triangles
        if cells.shape[1] == 2:
            if turns and not (part.group == "wall" and part.name == "inner"):
                points, cells, source = swept(points, cells)
                found.append(Mesh(points, cells, None if places is None else places[source]))
        elif part.group == "section" and turns:
            found += [Mesh(turned(points, angle), cells, places, lit=False) for angle in angles()[[0, -1]]]
        elif part.group in ("section", "cut"):
            found.append(Mesh(points, cells, places, lit=False))
        else:
            found.append(Mesh(points, cells, places, beyond=_beyond(part, scene.plane, eye) if cut else None))
    return found


def _beyond(part: Part, plane: CutPlane | None, eye: np.ndarray) -> np.ndarray | None:
    """How far each point is from the plane, towards the eye."""
    if plane is None:
        return None
    normal = plane.normal if plane.normal @ eye > 0 else -plane.normal
    return (part.surface.points - plane.origin) @ normal


def picture(
    scene: Scene,
    field: str | None = None,
    time: float | None = None,
    factor: float = 1.0,
    cut: bool | None = None,
    unit: str | None = None,
    span: tuple[float, float] | None = None,
    view: str | None = None,
    title: str = "",
) -> "Figure":
    """The vessel at a time in ms (default: the last) coloured by a field, moved by `factor` times the displacement.
    `cut`: opened by a plane (default: for fields of the inside, as velocity). `span`: colours in `unit`. Raises
    InputError."""
    eye = camera_named(scene, view)
    key = field or scene.first
    scene.check(key)
    quantity = scene.quantity(key)
    times = scene.times(key)
    at = float(times[-1]) if time is None else time
    shown_unit, times_unit = unit_of(quantity.unit, unit)
    scale = scale_in(scene.scale(key), span, times_unit)
    opened = quantity.field == "velocity" if cut is None else cut
    meshes = meshes_to_draw(scene, key, at, scale, factor, opened, eye.towards)
    image, _ = rendered(meshes, eye, *PIXELS, table(scale.map))
    bar_unit = "" if shown_unit == "1" else shown_unit
    words = quantity.words + (f" in {bar_unit}" if bar_unit else "")
    moves = any("displacement" in medium.names for medium in scene.meshes.media.values())
    clock = time_words(f"{at:g}", scene.static, "t = ")
    notes = [title, clock, f"displacement x {factor:g}" if factor != 1 and moves else ""]
    return framed(image, scale, times_unit, words, bar_unit, " · ".join(filter(None, notes)), span is None)


def camera_named(scene: Scene, view: str | None) -> Camera:
    """One of views_of(); without a name the usual one, from the open side. Raises InputError."""
    if view is None:
        return camera_of(scene.meshes, swept=True)
    views = {name: camera for name, camera, _ in views_of(scene.meshes)}
    if view not in views:
        raise InputError("", "view", f"'{view}' is unknown", hint(view, views))
    return views[view]


def unit_of(own: str, wanted: str | None) -> tuple[str, float]:
    """(unit, how many of it are one of the own). Raises InputError."""
    if wanted is None or wanted == own:
        return own, 1.0
    if own not in PER_KPA or wanted not in PER_KPA:
        remedy = f"give {' or '.join(PER_KPA) if own in PER_KPA else own}"
        raise InputError("", "unit", f"'{wanted}' does not fit a field in {own}", remedy)
    return wanted, PER_KPA[wanted] / PER_KPA[own]


def scale_in(scale: Scale, span: Sequence[float] | None, per_own: float) -> Scale:
    """The scale with the range that was asked for, `span` in the unit of the picture."""
    if span is None:
        return scale
    low, high = (end / per_own for end in span)
    return Scale(low, high, low < 0 < high and abs(low + high) < 1e-9 * high, scale.least, scale.largest)


def framed(
    image: np.ndarray, scale: Scale, per_own: float, words: str, unit: str, title: str, robust: bool
) -> "Figure":
    """The picture with its legend: what the colours mean, and what occurs."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

    image = cropped(image)
    ratio = image.shape[0] / image.shape[1]
    figure = Figure(figsize=(INCHES_WIDE, 1.35 + min(INCHES_WIDE * 0.96 * ratio, MOST_HIGH)))
    FigureCanvasAgg(figure)
    height = figure.get_size_inches()[1]
    axes = figure.add_axes((0.02, 0.95 / height, 0.96, 1 - 1.3 / height))
    axes.imshow(image, interpolation="lanczos")
    axes.set_axis_off()
    figure.text(0.02, 1 - 0.22 / height, title, fontsize=9, va="center", parse_math=False)
    bar = figure.add_axes((0.14, 0.62 / height, 0.72, 0.14 / height))
    bar.grid(False)
    shades = ScalarMappable(Normalize(scale.low * per_own, scale.high * per_own), scale.map)
    below, above = scale.least < scale.low * (1 + 1e-9), scale.largest > scale.high * (1 + 1e-9)
    extend = {(True, True): "both", (True, False): "min", (False, True): "max"}.get((below, above), "neither")
    legend = figure.colorbar(shades, cax=bar, orientation="horizontal", extend=extend)
    ticks = round_ticks(scale.low * per_own, scale.high * per_own)
    legend.set_ticks(ticks, labels=[f"{tick:.12g}" for tick in ticks])
    legend.minorticks_off()
    legend.ax.tick_params(labelsize=8)
    figure.text(0.885, 0.69 / height, unit, fontsize=8, va="center", parse_math=False)
    how = f"colours end at the {PERCENTILE:g}th percentile" if robust else "range as asked for"
    known = scale.least == scale.least
    occurs = f"{how}; {scale.least * per_own:.4g} to {scale.largest * per_own:.4g} occur" if known else ""
    figure.text(0.5, 0.08 / height, f"{words} ({occurs})", fontsize=8, ha="center", va="bottom", parse_math=False)
    return figure


def cropped(image: np.ndarray) -> np.ndarray:
    """The image without the empty rows and columns around it."""
    rows, columns = np.flatnonzero((image < 255).any(axis=(1, 2))), np.flatnonzero((image < 255).any(axis=(0, 2)))
    if not len(rows):
        return image
    top, left = max(rows[0] - BORDER, 0), max(columns[0] - BORDER, 0)
    return image[top : rows[-1] + 1 + BORDER, left : columns[-1] + 1 + BORDER]
