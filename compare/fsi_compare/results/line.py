"""Values along a line of a run over time: the centre line of a vessel, the inner wall, a line of the user's own."""

from dataclasses import dataclass
from typing import Dict, Mapping

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
    z: np.ndarray  #: mm along the line in the reference configuration, increasing, (points,)
    values: Mapping[str, np.ndarray]  #: by quantity, (levels, points)
    units: Mapping[str, str]  #: of each quantity

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
        return f"<Line {self.name}: {len(self.times)} levels, {len(self.z)} points; {quantities}>"

    def waves(self, quantity: str) -> PressureWaves:
        """One quantity in the form that comparisons take."""
        return PressureWaves(self.times, self.z, self[quantity])

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


def line_of(name: str, table: Table, position: str = "z") -> Line:
    """From a table with one block of rows for each time, the same points in each. Raises InputError."""
    times, first, counts = np.unique(table["time"], return_index=True, return_counts=True)
    points = int(counts[0]) if len(counts) else 0
    z = table[position][:points]
    whole = len(times) > 0 and bool(np.all(counts == points)) and bool(np.all(np.diff(first) > 0))
    if not whole or not np.array_equal(table[position].reshape(-1, points), np.tile(z, (len(times), 1))):
        raise InputError(table.path, "", "has not the same points at each time", "run it again")
    if points > 1 and not np.all(np.diff(z) > 0):
        raise InputError(table.path, position, "does not increase along the line", "run it again")
    values: Dict[str, np.ndarray] = {}
    for column in table:
        if column not in ("time", position) and table[column].dtype.kind == "f":
            values[column] = table[column].reshape(-1, points)
    return Line(name, times, z, values, {column: table.unit(column) for column in values})
