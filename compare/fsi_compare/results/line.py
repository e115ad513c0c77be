"""Values along a line of a run over time: the centre line of a vessel, the inner wall, a line of the user's own."""

from dataclasses import dataclass
from typing import Dict, List, Mapping, Optional

import numpy as np

from ..base.errors import InputError
from ..base.suggestions import nearest
from ..runs.pressure_waves import PressureWaves
from .table import Table


@dataclass(frozen=True)
class Line:
    """The same points at all time levels."""

    name: str
    times: np.ndarray  #: ms, increasing, (levels,)
    s: np.ndarray  #: mm along the line in the reference configuration, increasing, (points,)
    values: Mapping[str, np.ndarray]  #: by quantity, (levels, points)
    units: Mapping[str, str]  #: of each quantity
    points: Optional[np.ndarray] = None  #: reference positions, mm, (points, 3); None: not recorded

    def __getitem__(self, quantity: str) -> np.ndarray:
        """(levels, points). Raises InputError."""
        if quantity not in self.values:
            known = list(self.values)
            raise InputError(
                "",
                f"line {self.name}",
                f"has no '{quantity}'",
                f"did you mean '{nearest(quantity, known)}'? It has {', '.join(known)}",
            )
        return self.values[quantity]

    def __repr__(self) -> str:
        quantities = ", ".join(f"{name} in {self.units[name]}" for name in self.values)
        return f"<Line {self.name}: {len(self.times)} levels, {len(self.s)} points; {quantities}>"

    @property
    def vectors(self) -> List[str]:
        """Quantities of which all three components are there: 'velocity' for 'velocity_x', ..."""
        heads = [name[:-2] for name in self.values if name.endswith(VECTOR[0])]
        return [head for head in heads if all(head + end in self.values for end in VECTOR)]

    def magnitude(self, vector: str) -> np.ndarray:
        """Length of a vector, (levels, points). Raises InputError."""
        return np.sqrt(sum((self[vector + end] ** 2 for end in VECTOR), start=np.zeros(self[vector + "_x"].shape)))

    def waves(self, quantity: str) -> PressureWaves:
        """One quantity in the form that comparisons take."""
        return PressureWaves(self.times, self.s, self[quantity])

    def at(self, time: float, quantity: str) -> np.ndarray:
        """(points,) at a time in ms; linear between levels. Raises InputError for a time outside of the run."""
        waves = self.waves(quantity)
        if not waves.covers(time):
            raise InputError(
                "",
                f"line {self.name}",
                f"{time:g} ms is outside the run",
                f"give a time between {self.times[0]:g} and {self.times[-1]:g} ms",
            )
        return waves.at(time)


VECTOR = ("_x", "_y", "_z")


def line_of(name: str, table: Table, position: str = "z") -> Line:
    """From a table with one block of rows for each time, the same points in each; `position`: the column of the place along
    the line. Columns of other places are those of the points. Raises InputError."""
    times, first, counts = np.unique(table["time"], return_index=True, return_counts=True)
    points = int(counts[0]) if len(counts) else 0
    s = table[position][:points]
    whole = len(times) > 0 and bool(np.all(counts == points)) and bool(np.all(np.diff(first) > 0))
    if not whole or not np.array_equal(table[position].reshape(-1, points), np.tile(s, (len(times), 1))):
        raise InputError(table.path, "", "has not the same points at each time", "run it again")
    if points > 1 and not np.all(np.diff(s) > 0):
        raise InputError(table.path, position, "does not increase along the line", "run it again")
    places = [axis for axis in ("x", "y", "z") if axis in table and axis != position]
    values: Dict[str, np.ndarray] = {}
    for column in table:
        if column not in ("time", position, *places) and table[column].dtype.kind == "f":
            values[column] = table[column].reshape(-1, points)
    at = np.stack([table[axis][:points] for axis in places], axis=1) if len(places) == 3 else None
    return Line(name, times, s, values, {column: table.unit(column) for column in values}, at)


def lines_of(table: Table) -> Dict[str, Line]:
    """By name, from `lines.csv`: blocks of rows for each time and line. Raises InputError."""
    return {name: line_of(name, rows, "s") for name, rows in table.groups("line").items()}
