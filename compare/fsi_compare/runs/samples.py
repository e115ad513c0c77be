"""The samples of a run: `points.csv`, `lines.csv`, `planes.csv`, and other tables with the same rows at each time.

A column of names says which point, line or plane a row belongs to; columns of coordinates say where in it. All else are
values, NaN where the file has an empty cell: no velocity in a wall.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base.errors import InputError
from ..base.files import is_file
from .columns import AGAIN, numbers, read_fields
from .pressure_waves import PressureWaves

POINTS, LINES, PLANES = "points.csv", "lines.csv", "planes.csv"
CENTRE_LINE = "centerline"  # the line that a tube gets which does not follow its axis
TIME = "time_ms"
NAMES = ("point", "line", "plane", "opening", "surface", "element")  # columns of words, though one be named 1
PLACES = ("s_mm", "x_mm", "y_mm", "z_mm")


@dataclass(frozen=True)
class Samples:
    """One point, line or plane over time."""

    times: np.ndarray  # ms, (levels,)
    places: dict[str, np.ndarray]  # of PLACES, (points,)
    values: dict[str, np.ndarray]  # by column, (levels, points)


def read_samples(path: Path, finished: bool = True) -> dict[str, Samples]:
    """The samples of a table by name, in the order in which they come; the whole of a table without a column of names
    is one sample "". `finished`: of a run that has ended; else an incomplete last level is left out. Raises
    InputError naming line and column unless each has the same places at each time."""
    fields = read_fields(path, finished)
    if TIME not in fields:
        raise InputError(path, "line 1", f"column '{TIME}' is missing", AGAIN)
    if not fields[TIME]:
        raise InputError(path, "", "holds no time level", AGAIN)
    label = next((name for name in fields if name in NAMES), None)
    labels = np.array([""] * len(fields[TIME]) if label is None else fields.pop(label))
    columns = {name: numbers(path, name, of, name not in (TIME, *PLACES), nan=False) for name, of in fields.items()}
    return {
        one: _by_level(path, one, {name: values[labels == one] for name, values in columns.items()}, finished)
        for one in dict.fromkeys(labels.tolist())
    }


def _by_level(path: Path, name: str, columns: dict[str, np.ndarray], finished: bool) -> Samples:
    time = columns[TIME]
    points = int(np.argmax(time != time[0])) or len(time)
    whole = len(time) if finished else len(time) - len(time) % points
    if whole % points != 0 or np.any(np.diff(time[:whole].reshape(-1, points)) != 0):
        raise InputError(path, name, "has not the same points at each time", AGAIN)
    levels = {column: values[:whole].reshape(-1, points) for column, values in columns.items()}
    times = levels.pop(TIME)[:, 0]
    if np.any(np.diff(times) <= 0):
        raise InputError(path, name, "its times do not increase", AGAIN)
    places = {column: levels.pop(column) for column in PLACES if column in levels}
    if any(np.any(place != place[0]) for place in places.values()):
        raise InputError(path, name, "has not the same points at each time", AGAIN)
    return Samples(times, {column: place[0] for column, place in places.items()}, levels)


def requested_line(path: Path) -> str | None:
    """The line of `lines.csv` along which a vessel's pressure is read: the centre line that was found, else the first
    that the case asks for with a pressure all along it. None where no line has one. Raises InputError."""
    for name, line in sorted(read_samples(path).items(), key=lambda entry: entry[0] != CENTRE_LINE):
        pressure = line.values.get("pressure_Pa")
        if pressure is not None and len(line.places.get("s_mm", ())) > 1 and not np.isnan(pressure).any():
            return name
    return None


def waves_along(path: Path, name: str) -> PressureWaves:
    """The pressure along a line of `lines.csv`, its arc length in place of z. Raises InputError when there is none."""
    lines = read_samples(path)
    if name not in lines:
        raise InputError(path, "", f"has no line '{name}'", f"ask for one with [output.lines.{name}] and run it again")
    line = lines[name]
    pressure = line.values.get("pressure_Pa")
    if "s_mm" not in line.places or pressure is None or len(line.places["s_mm"]) < 2 or np.isnan(pressure).any():
        raise InputError(path, name, "has no pressure along it", AGAIN)
    return PressureWaves(line.times, line.places["s_mm"], pressure)


@dataclass(frozen=True)
class Difference:
    """How far a column of a sample is apart in two runs, at the times that both have."""

    table: str
    sample: str
    column: str
    largest: float  # difference, in the column's unit
    size: float  # largest value of the first run
    levels: int  # compared


def differences_of_tables(one: Path, other: Path, tables: tuple[str, ...]) -> list[Difference]:
    """Differences between the columns of samples that two runs have in common, at the same places."""
    found = []
    for table in tables:
        if not (is_file(one / table) and is_file(other / table)):
            continue
        first, second = read_samples(one / table), read_samples(other / table)
        for name in first:
            if name in second:
                found += _differences(table, name, first[name], second[name])
    return found


def _differences(table: str, name: str, one: Samples, other: Samples) -> list[Difference]:
    tolerance = 1e-9 * max(abs(one.times[-1]), abs(other.times[-1]))
    pairs = [(i, int(np.argmin(np.abs(other.times - time)))) for i, time in enumerate(one.times)]
    pairs = [(i, j) for i, j in pairs if abs(other.times[j] - one.times[i]) <= tolerance]
    points = next(iter(one.values.values())).shape[1]

    def is_at(there: np.ndarray | None, at: np.ndarray) -> bool:
        near = 1e-9 * (np.abs(at).max() + 1)
        return there is not None and len(at) == len(there) and np.allclose(at, there, rtol=0, atol=near)

    if not pairs or not all(is_at(other.places.get(place), at) for place, at in one.places.items()):
        return []
    mine, theirs = (list(level) for level in zip(*pairs))
    found = []
    for column, values in one.values.items():
        theirs_of = other.values.get(column)
        if theirs_of is None or theirs_of.shape[1] != points:
            continue
        a, b = values[mine], theirs_of[theirs]
        both = ~(np.isnan(a) | np.isnan(b))
        if both.any():
            apart, size = float(np.abs(a - b)[both].max()), float(np.abs(a[both]).max())
            found.append(Difference(table, name, column, apart, size, len(pairs)))
    return found
