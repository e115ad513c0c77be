"""Values along a line of a run over time: the centre line of a vessel, the inner wall, a line of the user's own."""

from dataclasses import dataclass
from pathlib import Path
from typing import Mapping

import numpy as np

from ..base.errors import InputError
from ..base.suggestions import hint
from ..runs.pressure_waves import PressureWaves
from ..runs.samples import Samples, read_samples
from .units import split_unit


@dataclass(frozen=True)
class Line:
    """Values at the points of a line, the same at all time levels."""

    name: str
    times: np.ndarray  #: ms, increasing, (levels,)
    s: np.ndarray  #: mm along the line in the reference configuration, increasing, (points,)
    values: Mapping[str, np.ndarray]  #: by quantity, (levels, points)
    units: Mapping[str, str]  #: of each quantity
    points: np.ndarray | None = None  #: reference positions, mm, (points, 3); None: not recorded

    def __getitem__(self, quantity: str) -> np.ndarray:
        """(levels, points). Raises InputError."""
        if quantity not in self.values:
            raise InputError("", f"line {self.name}", f"has no '{quantity}'", hint(quantity, self.values))
        return self.values[quantity]

    def __repr__(self) -> str:
        quantities = ", ".join(f"{name} in {self.units[name]}" for name in self.values)
        return f"<Line {self.name}: {len(self.times)} levels, {len(self.s)} points; {quantities}>"

    @property
    def vectors(self) -> list[str]:
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
        waves.require(time, "", f"line {self.name}")
        return waves.at(time)


VECTOR = ("_x", "_y", "_z")


def line_of(name: str, path: Path, samples: Samples, position: str = "z_mm") -> Line:
    """A line from its samples in a table; `position`: the column of the place along the line. Columns of other places
    are those of the points. Raises InputError."""
    if position not in samples.places:
        raise InputError(path, "line 1", f"column '{position}' is missing", "run it again")
    s = samples.places[position]
    if not np.all(np.diff(s) > 0):
        raise InputError(path, position, "does not increase along the line", "run it again")
    columns = {column: split_unit(column) for column in samples.values}
    points = [place for place in ("x_mm", "y_mm", "z_mm") if place in samples.places and place != position]
    at = np.stack([samples.places[place] for place in points], axis=1) if len(points) == 3 else None
    values = {columns[column][0]: found for column, found in samples.values.items()}
    return Line(name, samples.times, s, values, dict(columns.values()), at)


def lines_of(path: Path, finished: bool = True) -> dict[str, Line]:
    """All lines of `lines.csv` by name; `finished`: see read_samples(). Raises InputError."""
    return {name: line_of(name, path, line, "s_mm") for name, line in read_samples(path, finished).items()}
