"""Where the largest values of a run are: a table whose rows turn the view to their place."""

from typing import Any, NamedTuple, Sequence

import numpy as np

from ..results.quantities import Quantity
from .column import Column
from .layout import Table
from .scene import ReportScene, RunScene, words_of

KEYS = ("displacement", "wall_shear_stress", "tawss", "osi", "von_mises_stress", "velocity", "pressure")


class Place(NamedTuple):
    run: str
    number: int  # of the run in the scene
    key: str
    quantity: Quantity
    value: float
    time: float
    part: str
    point: np.ndarray  # mm, (3,), reference

    @property
    def look(self) -> dict[str, Any]:
        """The place that the page's view turns to."""
        point = [float(f"{x:.7g}") for x in self.point]
        return {"quantity": self.key, "time": self.time, "run": self.number, "part": self.part, "point": point}


class Apart(NamedTuple):
    run: str
    words: str
    unit: str
    largest: float
    of: float  # the largest value of the first run


def _coordinate(i: int, axis: str) -> Column[Place]:
    return Column(axis, axis, lambda r: float(r.point[i]), ".4g", "mm", "place, {unit}")


PLACES: Sequence[Column[Place]] = (
    Column("run", "run", lambda r: r.run, left=True),
    Column("quantity", "quantity", lambda r: r.quantity.words, left=True),
    Column("largest", "largest", lambda r: r.value, ".4g"),
    Column("unit", "unit", lambda r: r.quantity.shown_unit, left=True),
    Column("time, {unit}", "time", lambda r: r.time, ".4g", "ms"),
    Column("on", "surface", lambda r: r.part, left=True),
    *map(_coordinate, range(3), "xyz"),
)
APART: Sequence[Column[Apart]] = (
    Column("run", "run", lambda r: r.run, left=True),
    Column("quantity", "quantity", lambda r: r.words, left=True),
    Column("difference", "largest_difference", lambda r: r.largest, ".3e"),
    Column("of", "largest_value", lambda r: r.of, ".3e"),
    Column("unit", "unit", lambda r: r.unit, left=True),
)


def places_table(scene: ReportScene) -> tuple[Table, list[dict[str, Any]]]:
    """The table, and what each row turns the view to."""
    places = (largest_of(run, number, key) for number, run in enumerate(scene.runs) for key in KEYS)
    records = [place for place in places if place is not None]
    notes = [
        "Of the times and points that the scene shows: surfaces, and the cut through the middle. Places are those of the mesh at rest."
    ]
    table = Table("places", "Largest values and their places", PLACES, records, notes=notes)
    return table, [record.look for record in records]


def largest_of(run: RunScene, number: int, key: str) -> Place | None:
    """Where a field is largest; None where the run has no such quantity, or where it is zero throughout."""
    best: Place | None = None
    for part in run.parts:
        for time, numbers in zip(run.times, run.levels(part, key)):
            if not np.isfinite(numbers).any():
                continue
            node = int(np.nanargmax(numbers))
            if numbers[node] > (best.value if best else 0.0):
                quantity, value = run.scene.quantities[key][part.surface.medium.name], float(numbers[node])
                place, size = part.surface.points[node], float(np.ptp(part.surface.points))
                point = np.where(np.abs(place) < 1e-9 * size, 0.0, place)  # without round-off of zeros
                best = Place(run.name, number, key, quantity, value, float(time), part.name, point)
    return best


def apart_table(scene: ReportScene) -> Table:
    """Largest differences of fields of runs on the same mesh; empty where there are none."""
    records = []
    for run in scene.runs[1:]:
        for key, quantities in run.scene.quantities.items() if run.apart else ():
            levels = scene.apart(run, key)
            if ":" not in key and levels:
                quantity = next(iter(quantities.values()))
                of = max(float(np.nanmax(np.abs(level))) for level in scene.levels(scene.runs[0], key))
                largest = max(float(np.nanmax(np.abs(level))) for level in levels)
                records.append(Apart(run.name, words_of(key, quantity), quantity.shown_unit, largest, of))
    title = f"Largest differences of fields from {scene.runs[0].name}"
    notes = ["At the times and points that the scene shows. `of`: the largest value of the first run."]
    return Table("field_differences", title, APART, records, notes=notes)
