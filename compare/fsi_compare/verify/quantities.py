"""What is verified of a run: numbers read from all that the case samples, each with the largest value of the curve that
it is of, which its error is relative to.

| of a curve over time | of a line |
|---|---|
| the curve: norm of its error | the line over time: the same |
| the largest error at any time | anywhere, at any time |
| - | the line, and anywhere on it, at the end and at times asked for |
| largest and smallest value, by a parabola through the three levels about it where the curve is smooth | the same over all points |
| value at the end, and at times asked for | L2 norm along the line at these times |
| L2 norm over time | L2 norm over line and time |
| mean and swing over the last period, where the case has one | - |
"""

import functools
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Iterator, Mapping, Sequence

import numpy as np

from ..base.files import is_file
from ..results.fields import read_fields
from ..results.units import split_unit
from ..runs.levels import integral
from ..runs.samples import LINES, PLANES, POINTS, Samples, read_samples
from .curve_norms import Curve, Stretch, norm_of, on, size_of

TABLES = (POINTS, LINES, PLANES, "openings.csv", "surfaces.csv", "centerline_pressure.csv", "wall_displacement.csv")
WITHOUT_NAMES = {"centerline_pressure.csv": "centre line", "wall_displacement.csv": "inner wall", "flow.csv": "tube"}
PRIMARY = ("displacement", "velocity", "pressure")  # fields that are solved for: samples have them, at any place
SEEN = 2e-5  # relative to the largest of all curves with the unit: what is smaller is zero but for round-off
ONE_SIDED = 0.02  # an extreme that is smaller than this part of the other is none
SMOOTH = 2.5  # times the bend one level beside over that at the largest, which is 0.41 at least of 8 levels a period

Reading = Callable[[Curve], float]


@dataclass(frozen=True)
class Quantity:
    """`of` reads it from a member's curve of the same name."""

    name: str
    curve: str
    unit: str
    is_pressure: bool
    scale: float
    of: Reading
    is_extreme: bool = False
    whole: Stretch | None = None  # the curve itself, whose error has a norm; `of` is then that of the curve
    held_by: Stretch | None = None  # the curve's error that this number's cannot exceed
    is_norm: bool = False


@dataclass(frozen=True)
class Asked:
    """What is asked for in addition to the usual numbers."""

    times: tuple[float, ...] = ()  # ms
    period: float | None = None  # ms
    static: bool = False  # no curve over time: the last level alone counts


def curves_of(folder: Path) -> dict[str, Curve]:
    """Curves of a finished run, by name. Raises InputError for tables that cannot be read."""
    found: dict[str, Curve] = {}
    for table in list(TABLES) + ([] if is_file(folder / "openings.csv") else ["flow.csv"]):
        if is_file(folder / table):
            for sample, samples in read_samples(folder / table).items():
                for curve in _curves(sample or WITHOUT_NAMES.get(table, table), samples):
                    found.setdefault(curve.name, curve)
    for curve in _derived(folder):
        found.setdefault(curve.name, curve)
    return found


def _curves(sample: str, samples: Samples) -> Iterator[Curve]:
    for column, values in samples.values.items():
        points = ~np.isnan(values).any(axis=0)
        if column == "step" or not points.any():
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
            name, values = f"{medium}: largest {field.replace('_', ' ')}", np.asarray(sizes)[:, None]
            yield Curve(name, fields.units.get(field, ""), np.asarray(times), values, np.zeros(1), True)


def quantities_of(curves: Mapping[str, Curve], asked: Asked) -> list[Quantity]:
    """Quantities of the user's own run, which decides which extremes there are."""
    sizes: dict[str, float] = {}
    for curve in curves.values():
        sizes[curve.unit] = max(sizes.get(curve.unit, 0.0), curve.largest)
    found: list[Quantity] = []
    for curve in curves.values():
        if curve.largest > SEEN * sizes[curve.unit] and curve.largest > 0:
            found += _of_curve(curve, asked)
    return found


def _of_curve(curve: Curve, asked: Asked) -> list[Quantity]:
    line = curve.values.shape[1] > 1
    end = float(curve.times[-1])
    if asked.static or len(curve.times) < 3:
        return [*_whole(curve, end, " at the end"), *_at_end(curve)]
    times = [time for time in asked.times if curve.times[0] <= time < end]
    found = _whole(curve)
    if line:
        found += [one for time in times for one in _whole(curve, time, f" at {time:g} ms")]
        found += _whole(curve, end, " at the end")
    found += [*_extremes(curve), *_at_end(curve)[:1], _number(curve, "L2 norm", _l2, Stretch(False), is_norm=True)]
    for time in times:
        at = Stretch(False, time) if line else Stretch(True)
        name = f"L2 norm at {time:g} ms" if line else f"at {time:g} ms"
        found.append(_number(curve, name, functools.partial(_at, time=time), at, line))
    if asked.period is not None and not line and asked.period <= end * (1 + 1e-9):
        period, anywhere = asked.period, Stretch(True)
        found.append(_number(curve, "mean of the last period", lambda c: _mean(c, period), anywhere))
        found.append(_number(curve, "swing of the last period", lambda c: _swing(c, period), anywhere, extreme=True))
    return found


def _number(
    curve: Curve, what: str, of: Reading, held_by: Stretch, is_norm: bool = False, extreme: bool = False
) -> Quantity:
    name = f"{curve.name}, {what}"
    return Quantity(name, curve.name, curve.unit, curve.is_pressure, curve.largest, of, extreme, None, held_by, is_norm)


def _whole(curve: Curve, time: float | None = None, when: str = "") -> list[Quantity]:
    """The error of the curve itself: its norm, and the largest. A point has none at a single time."""
    line = curve.values.shape[1] > 1
    if time is not None and not line:
        return []
    names = (f"line{when or ' over time'}", f"anywhere{when}") if line else ("curve", "at any time")
    return [_error(curve, name, Stretch(largest, time)) for name, largest in zip(names, (False, True))]


def _error(curve: Curve, what: str, stretch: Stretch) -> Quantity:
    def size(c: Curve) -> float:
        return norm_of(c, stretch)(on(c, c, stretch))

    name, scale, extreme = f"{curve.name}, {what}", size_of(curve, stretch), stretch.largest and stretch.time is None
    return Quantity(name, curve.name, curve.unit, curve.is_pressure, scale, size, extreme, stretch)


def _extremes(curve: Curve) -> Iterator[Quantity]:
    most, least = float(np.max(curve.values)), float(np.min(curve.values))
    if most > ONE_SIDED * curve.largest:
        yield _number(curve, "largest", lambda c: _extreme(c, 1.0), Stretch(True), extreme=True)
    if least < -ONE_SIDED * curve.largest:
        yield _number(curve, "smallest", lambda c: _extreme(c, -1.0), Stretch(True), extreme=True)


def _at_end(curve: Curve) -> list[Quantity]:
    end = float(curve.times[-1])
    if curve.values.shape[1] > 1:
        norm = _number(curve, "L2 norm at the end", lambda c: _at(c, end), Stretch(False, end), True)
        largest: Reading = lambda c: float(c.values[-1][np.argmax(np.abs(c.values[-1]))])
        return [norm, _number(curve, "largest at the end", largest, Stretch(True, end))]
    return [_number(curve, "at the end", lambda c: _at(c, float(c.times[-1])), Stretch(True))]


def _extreme(curve: Curve, sign: float) -> float:
    """The extreme over all points; between levels by a parabola, so that it does not jump with the step."""
    y = np.max(sign * curve.values, axis=1)
    return sign * peak(curve.times, y)


def peak(t: np.ndarray, y: np.ndarray) -> float:
    """The largest value, between levels by the parabola through the largest and its neighbours as far as the curve
    bends there as it does one level before and behind: where it jumps or has a kink no parabola passes through it, and
    the largest value itself counts."""
    i = int(np.argmax(y))
    if i == 0 or i == len(y) - 1:
        return float(y[i])
    bend = _bend(t, y, i)
    if bend >= 0:
        return float(y[i])
    beside = [_bend(t, y, j) / bend for j in (i - 1, i + 1) if 0 < j < len(y) - 1]
    smooth = min(1.0, SMOOTH * max(0.0, min(beside, default=0.0)))
    slope = float((y[i] - y[i - 1]) / (t[i] - t[i - 1])) + bend * float(t[i] - t[i - 1])  # at the largest
    return float(y[i]) - smooth * slope**2 / (4 * bend)


def _bend(t: np.ndarray, y: np.ndarray, i: int) -> float:
    """Half of the second derivative of the parabola through three levels."""
    first, second = (y[i] - y[i - 1]) / (t[i] - t[i - 1]), (y[i + 1] - y[i]) / (t[i + 1] - t[i])
    return float((second - first) / (t[i + 1] - t[i - 1]))


def _at(curve: Curve, time: float) -> float:
    """The value of a point, or the L2 norm along a line."""
    row = np.array([np.interp(time, curve.times, column) for column in curve.values.T])
    return float(row[0]) if len(row) == 1 else _norm(curve.s, row)


def _norm(x: np.ndarray, y: np.ndarray) -> float:
    """(integral of y^2 over the length)^(1/2) by the trapezoidal rule, over the length's root: the unit stays."""
    length = float(x[-1] - x[0])
    return float(np.sqrt(integral(x, y**2) / length if length > 0 else np.mean(y**2)))


def _l2(curve: Curve) -> float:
    if curve.values.shape[1] > 1:
        return _norm(curve.times, np.array([_norm(curve.s, row) for row in curve.values]))
    return _norm(curve.times, curve.values[:, 0])


def _last(curve: Curve, period: float) -> tuple[np.ndarray, np.ndarray]:
    """Times and values of the curve's own last period, in ms, whose beginning gets a level of its own: time.periods may
    end each member after another number of them."""
    begin = float(curve.times[-1]) - period
    after = curve.times > begin + 1e-9 * abs(curve.times[-1])
    start = np.interp(begin, curve.times, curve.values[:, 0])
    return np.append(begin, curve.times[after]), np.append(start, curve.values[after, 0])


def _mean(curve: Curve, period: float) -> float:
    t, y = _last(curve, period)
    return integral(t, y) / float(t[-1] - t[0])


def _swing(curve: Curve, period: float) -> float:
    """Half of the way from the smallest to the largest."""
    t, y = _last(curve, period)
    return 0.5 * (peak(t, y) + peak(t, -y))


def chosen(quantities: Sequence[Quantity], names: Sequence[str]) -> list[Quantity]:
    """Quantities whose name holds one of `names`; all where none is given."""
    return [q for q in quantities if not names or any(name.lower() in q.name.lower() for name in names)]
