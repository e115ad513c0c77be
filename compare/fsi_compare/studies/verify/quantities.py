"""What is verified of a run: numbers read from all that the case samples, each with the largest value of the curve that it
is of, which its error is relative to.

| of a curve over time | of a line |
|---|---|
| largest and smallest value, by a parabola through the three levels about it | the same over all points |
| value at the end, and at times asked for | L2 norm along the line at these times |
| L2 norm over time | L2 norm over line and time |
| mean and swing over the last period, where the case has one | - |
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple

import numpy as np

from ...base.files import is_file
from ...results.fields import read_fields
from ...results.units import split_unit
from ...runs.samples import LINES, PLANES, POINTS, Samples, read_samples

TABLES = (POINTS, LINES, PLANES, "openings.csv", "surfaces.csv", "centerline_pressure.csv", "wall_displacement.csv")
WITHOUT_NAMES = {"centerline_pressure.csv": "centre line", "wall_displacement.csv": "inner wall", "flow.csv": "tube"}
SKIPPED = ("step",)  # columns that are no results
PRIMARY = ("displacement", "velocity", "pressure")  # fields that are solved for: samples have them, at any place
SEEN = 2e-5  # relative to the largest of all curves with the unit: what is smaller is zero but for round-off
ONE_SIDED = 0.02  # an extreme that is smaller than this part of the other is none


@dataclass(frozen=True)
class Curve:
    """A column of a sample over time; of lines at several points."""

    name: str  # "tip: displacement y"
    unit: str
    times: np.ndarray  # ms, (levels,)
    values: np.ndarray  # (levels, points)
    s: np.ndarray  # mm along the line, (points,)
    derived: bool = False  # of a field that is made of gradients of what is solved for

    @property
    def largest(self) -> float:
        return float(np.nanmax(np.abs(self.values))) if self.values.size else 0.0

    @property
    def is_pressure(self) -> bool:
        """Or of the order of one: stresses, forces, gradients of what is solved for."""
        words = self.name.rpartition(": ")[2]
        return self.derived or any(word in words for word in ("pressure", "stress", "force"))


@dataclass(frozen=True)
class Quantity:
    """`of` reads it from a member's curve of the same name."""

    name: str
    curve: str
    unit: str
    is_pressure: bool
    scale: float
    of: Callable[[Curve], float]
    is_extreme: bool = False


@dataclass(frozen=True)
class Asked:
    """What is asked for beside the usual numbers."""

    times: Tuple[float, ...] = ()  # ms
    period: Optional[float] = None  # ms
    static: bool = False  # no curve over time: the last level alone counts


def curves_of(folder: Path) -> Dict[str, Curve]:
    """Of a finished run, by name. Raises InputError for tables that cannot be read."""
    found: Dict[str, Curve] = {}
    tables = list(TABLES) + ([] if is_file(folder / "openings.csv") else ["flow.csv"])
    for table in tables:
        if is_file(folder / table):
            for sample, samples in read_samples(folder / table).items():
                for curve in _curves(sample or WITHOUT_NAMES.get(table, table), samples):
                    found.setdefault(curve.name, curve)
    for curve in _derived(folder):
        found.setdefault(curve.name, curve)
    return found


def _curves(sample: str, samples: Samples) -> Iterator[Curve]:
    for column, values in samples.values.items():
        if column in SKIPPED:
            continue
        points = ~np.isnan(values).any(axis=0)
        if not points.any():
            continue
        name, unit = split_unit(column)
        s = samples.places.get("s_mm", samples.places.get("z_mm", np.zeros(values.shape[1])))
        yield Curve(f"{sample}: {name.replace('_', ' ')}", unit, samples.times, values[:, points], s[points])


def _derived(folder: Path) -> Iterator[Curve]:
    """The largest of each derived field in the whole medium, at the levels of fields.h5."""
    for medium, fields in read_fields(folder).items():
        for field in fields.names:
            if field.startswith(PRIMARY) or "indicator" in field or not len(fields.times_of(field)):
                continue
            times = fields.times_of(field)
            sizes = []
            for time in times:
                values = np.asarray(fields.at(float(time), field), dtype=float)
                flat = values if values.ndim == 1 else np.sqrt(np.sum(values.reshape(len(values), -1) ** 2, axis=1))
                sizes.append(float(np.nanmax(np.abs(flat))) if np.isfinite(flat).any() else 0.0)
            name = f"{medium}: largest {field.replace('_', ' ')}"
            yield Curve(
                name, fields.units.get(field, ""), np.asarray(times), np.asarray(sizes)[:, None], np.zeros(1), True
            )


def quantities_of(curves: Mapping[str, Curve], asked: Asked) -> List[Quantity]:
    """Those of the user's own run, which decides which extremes there are."""
    sizes: Dict[str, float] = {}
    for curve in curves.values():
        sizes[curve.unit] = max(sizes.get(curve.unit, 0.0), curve.largest)
    found: List[Quantity] = []
    for curve in curves.values():
        if curve.largest > SEEN * sizes[curve.unit] and curve.largest > 0:
            found += _of_curve(curve, asked)
    return found


def _of_curve(curve: Curve, asked: Asked) -> List[Quantity]:
    def quantity(what: str, of: Callable[[Curve], float], extreme: bool = False) -> Quantity:
        name = f"{curve.name}, {what}"
        return Quantity(name, curve.name, curve.unit, curve.is_pressure, curve.largest, of, extreme)

    line = curve.values.shape[1] > 1
    at_end = quantity("L2 norm at the end" if line else "at the end", lambda c: _at(c, float(c.times[-1])))
    if asked.static or len(curve.times) < 3:
        return [at_end, *([quantity("largest at the end", _largest_at_end)] if line else [])]
    found = []
    most, least = float(np.max(curve.values)), float(np.min(curve.values))
    if most > ONE_SIDED * curve.largest:
        found.append(quantity("largest", lambda c: _extreme(c, 1.0), True))
    if least < -ONE_SIDED * curve.largest:
        found.append(quantity("smallest", lambda c: _extreme(c, -1.0), True))
    found += [at_end, quantity("L2 norm", _l2)]
    end = float(curve.times[-1])
    for time in asked.times:
        if curve.times[0] <= time < end:
            found.append(quantity(f"at {time:g} ms", lambda c, time=time: _at(c, time)))  # type: ignore[misc]
    if asked.period is not None and not line and asked.period <= end * (1 + 1e-9):
        last = end - asked.period
        found.append(quantity("mean of the last period", lambda c: _mean(c, last)))
        found.append(quantity("swing of the last period", lambda c: _swing(c, last), True))
    return found


def _extreme(curve: Curve, sign: float) -> float:
    """Of all points at once; between levels by a parabola, so that it does not jump with the step."""
    y = np.max(sign * curve.values, axis=1)
    return sign * peak(curve.times, y)


def peak(t: np.ndarray, y: np.ndarray) -> float:
    """The largest value of the parabola through the largest and its neighbours; the largest at an end."""
    i = int(np.argmax(y))
    if i == 0 or i == len(y) - 1:
        return float(y[i])
    t0, t1, t2 = (float(v) for v in t[i - 1 : i + 2])
    y0, y1, y2 = (float(v) for v in y[i - 1 : i + 2])
    first, second = (y1 - y0) / (t1 - t0), (y2 - y1) / (t2 - t1)
    bend = (second - first) / (t2 - t0)
    if bend >= 0:
        return y1
    slope = first + bend * (t1 - t0)  # at t1
    return y1 - slope**2 / (4 * bend)


def _at(curve: Curve, time: float) -> float:
    """At a point the value, along a line its L2 norm."""
    row = np.array([np.interp(time, curve.times, column) for column in curve.values.T])
    return float(row[0]) if len(row) == 1 else _norm(curve.s, row)


def _largest_at_end(curve: Curve) -> float:
    row = curve.values[-1]
    return float(row[int(np.argmax(np.abs(row)))])


def _norm(x: np.ndarray, y: np.ndarray) -> float:
    """(integral of y^2 over the length)^(1/2) by the trapezoidal rule, over the length's root: the unit stays."""
    length = float(x[-1] - x[0])
    if length <= 0:
        return float(np.sqrt(np.mean(y**2)))
    return float(np.sqrt(np.sum(0.5 * (y[1:] ** 2 + y[:-1] ** 2) * np.diff(x)) / length))


def _l2(curve: Curve) -> float:
    if curve.values.shape[1] > 1:
        return _norm(curve.times, np.array([_norm(curve.s, row) for row in curve.values]))
    return _norm(curve.times, curve.values[:, 0])


def _window(curve: Curve, begin: float) -> Tuple[np.ndarray, np.ndarray]:
    """Times and values from `begin` on, which gets a level of its own."""
    after = curve.times > begin + 1e-9 * abs(curve.times[-1])
    start = np.interp(begin, curve.times, curve.values[:, 0])
    return np.append(begin, curve.times[after]), np.append(start, curve.values[after, 0])


def _mean(curve: Curve, begin: float) -> float:
    t, y = _window(curve, begin)
    return float(np.sum(0.5 * (y[1:] + y[:-1]) * np.diff(t)) / (t[-1] - t[0]))


def _swing(curve: Curve, begin: float) -> float:
    """Half of the way from the smallest to the largest."""
    t, y = _window(curve, begin)
    return 0.5 * (peak(t, y) + peak(t, -y))


def chosen(quantities: Sequence[Quantity], names: Sequence[str]) -> List[Quantity]:
    """Those whose name holds one of `names`; all where none is given."""
    return [q for q in quantities if not names or any(name.lower() in q.name.lower() for name in names)]
