"""The error of one value in one thing that is refined, mesh or step, from three or more members of a family.

With y(h) = y0 + a h^p the differences of successive members give p (accuracy's observed order, [Celik2008]). The
error of the finest member is then e = d / (r^p - 1), d the last difference and r the ratio of its sizes. The bar of the
user's own member is what is known to be wrong, its difference from the finest, and FACTOR times what is not known, e:

    bar = |y(1) - y(finest)| + FACTOR |e|.

A sequence that swings is not extrapolated, neither is one whose differences do not fall. Of curves the differences are
norms: they cannot cancel, and what one member moves where another does not is in them, too. See
docs/guide/accuracy.md#verify."""

import functools
from dataclasses import dataclass, replace
from typing import Any, Callable, Sequence

import numpy as np

from .curve_norms import CurveNorm

AS_EXPECTED, WIDENED, OUTSIDE, SILENT = "as expected", "widened", "outside", "silent"

FACTOR = {AS_EXPECTED: 2.0, WIDENED: 3.0}  # on what is extrapolated
SWING = 3.0  # times the largest difference, where a sequence swings
LEAST_ORDER = 0.3  # below it the differences do not fall enough to say what is left
SHARE_OF_ORDER = 0.7  # of the elements' order that must be observed for them to converge as they do
LARGEST_ORDER = 8.0
SAME_SHAPE = 0.7  # cosine of two successive differences of a curve, below which they are not multiples of one error
TOO_FAST = 2.0  # times the order of theory: differences that fall faster do so by chance, as before a change of sign


@dataclass(frozen=True)
class Part:
    """Bar of a value at size 1, for its error in one direction, and at other sizes by `share`."""

    state: str  # AS_EXPECTED, WIDENED, OUTSIDE or SILENT
    bar: float  # in the value's unit
    order: float | None = None  # observed; None: none was
    used: float = 1.0  # order that the bar is expected to fall with, for predictions
    remaining: float = 0.0  # signed estimate of the finest member's error; 0 where nothing is extrapolated
    error: Any = 0.0  # signed estimate of the error at size 1; of a curve one at each level and point
    lacking: bool = False  # too few members

    def at(self, size: float) -> float:
        """The bar at another size."""
        return self.bar * float(size**self.used)


NOTHING = Part(SILENT, 0.0)


def part_of(
    sizes: Sequence[float], values: Sequence[float], expected: float, noise: float, curve: Part | None = None
) -> Part:
    """`sizes` relative to the user's own, which is 1 and among them; `expected`: the order of elements or scheme;
    `noise`: what differences may be by chance, of the solver or of a mesh's making. `curve`: the part of the curve that
    the values are norms of. A norm can fall faster than its curve converges, while the curve moves without growing: it
    is extrapolated by no larger order than the curve, and not at all where the curve's differences do not fall."""
    x, order = _falling(sizes)
    y = np.asarray(values, dtype=float)[order]
    steps = y[:-1] - y[1:]
    known = abs(_own(x, y) - float(y[-1]))
    spread = float(np.max(y) - np.min(y)) if len(y) else 0.0
    if len(x) < 2 or np.any(x[:-1] <= x[1:]):
        return NOTHING
    if spread <= 2 * noise or len(x) < 3:
        return _silent_or_lacking(spread, noise, expected)
    if _swings(steps, noise):
        falls = abs(steps[-1]) <= 0.7 * float(np.max(np.abs(steps[:-1]))) or abs(steps[-1]) <= noise
        last = float(np.max(np.abs(steps[-2:])))
        return Part(WIDENED if falls else OUTSIDE, SWING * last + noise)
    if curve is not None and curve.state == OUTSIDE:
        return Part(OUTSIDE, SWING * max(known, abs(float(steps[-1]))), curve.order)
    return _of_monotone(x, y, expected, noise, known, curve)


def part_of_curves(
    sizes: Sequence[float], curves: Sequence[np.ndarray], expected: float, noise: float, norm: CurveNorm
) -> Part:
    """Like part_of() for whole curves, (levels * points,): the sum of the norms of the differences from each member to
    the finest one is a sequence that falls, and whose order is that of the curve."""
    x, order = _falling(sizes)
    y = [curves[i] for i in order]
    if len(x) < 2 or np.any(x[:-1] <= x[1:]):
        return NOTHING
    steps = [one - other for one, other in zip(y, y[1:])]
    lengths = np.array([norm(step) for step in steps])
    own = y[int(np.argmin(np.abs(x - 1.0)))]
    known, spread = norm(own - y[-1]), float(np.max(lengths))
    if spread <= 2 * noise or len(x) < 3:
        return _silent_or_lacking(spread, noise, expected)
    part = _of_monotone(x, np.append(np.cumsum(lengths[::-1])[::-1], 0.0), expected, noise, known)
    if part.state == OUTSIDE:
        return part
    if part.state == AS_EXPECTED and norm.cosine(steps[-2], steps[-1]) < SAME_SHAPE:
        more = (FACTOR[WIDENED] - FACTOR[AS_EXPECTED]) * abs(part.remaining)
        part = replace(part, state=WIDENED, bar=part.bar + more)
    last = float(lengths[-1])
    return replace(part, error=own - y[-1] + (part.remaining / last if last > 0 else 0.0) * steps[-1])


def by_elements(
    own: Any, other: Any, finer: Any | None, own_is_linear: bool, noise: float, norm: Callable[[Any], float] = abs
) -> Part:
    """The part of a mesh with too few others, by both elements on it. The quadratic element's error is taken to be at
    most half of the linear one's (the saturation assumption of hierarchical estimates, [Bank1993]): of their difference
    d a linear result may then be off by 2 d and a quadratic one by d. A known linear result on a finer mesh must be
    nearer to the quadratic one."""
    apart = norm(own - other)
    if finer is not None and own_is_linear and norm(finer - other) > max(apart, noise):
        return Part(OUTSIDE, SWING * norm(finer - other))
    return Part(WIDENED, (2 if own_is_linear else 1) * apart + noise, error=own - other if own_is_linear else 0.0)


def _falling(sizes: Sequence[float]) -> tuple[np.ndarray, np.ndarray]:
    """The sizes from coarse to fine, and their places."""
    x = np.asarray(sizes, dtype=float)
    order = np.argsort(-x)
    return x[order], order


def _silent_or_lacking(spread: float, noise: float, expected: float) -> Part:
    """The part of members that are too near to each other, else too few."""
    if spread <= 2 * noise:
        return Part(SILENT, max(spread, noise), None, expected)
    return Part(OUTSIDE, SWING * spread, lacking=True)


def _swings(steps: np.ndarray, noise: float) -> bool:
    seen = steps[np.abs(steps) > noise]
    return bool(np.any(seen > 0) and np.any(seen < 0))


def _of_monotone(
    x: np.ndarray, y: np.ndarray, expected: float, noise: float, known: float, curve: Part | None = None
) -> Part:
    last = float(y[-2] - y[-1])
    promised = _promised(x, y, expected)
    most = expected if curve is None or curve.order is None else min(expected, curve.order)
    if abs(last) <= noise or abs(last) < promised * float((x[-1] / x[-2]) ** (expected * (TOO_FAST - 1))):
        left = max(abs(last), promised) / float((x[-2] / x[-1]) ** most - 1.0)
        chance = promised > SWING * noise  # else converged as far as can be seen
        bar = known + (FACTOR[WIDENED] * left if chance else 0.0) + SWING * noise
        error = _own(x, y) - float(y[-1])
        return Part(WIDENED, bar, None, expected, 0.0, error)
    order, scatter = observed(x, y)
    if order is None or order < LEAST_ORDER:
        return Part(OUTSIDE, SWING * max(known, abs(last)), order)
    used = min(order, most)
    remaining = last / float((x[-2] / x[-1]) ** used - 1.0)
    state = AS_EXPECTED if SHARE_OF_ORDER * expected <= order <= expected / SHARE_OF_ORDER else WIDENED
    if curve is not None and curve.state == WIDENED:
        state = WIDENED
    bar = known + FACTOR[state] * abs(remaining) + scatter + noise
    seen = order if order < LARGEST_ORDER - 0.1 else None  # faster than any power
    return Part(state, bar, seen, used, remaining, _own(x, y) - float(y[-1]) + remaining)


def _promised(x: np.ndarray, y: np.ndarray, expected: float) -> float:
    """The last difference as expected from its predecessor and the order of theory."""
    before = x[-3] ** expected - x[-2] ** expected
    return abs(float(y[-3] - y[-2])) * float((x[-2] ** expected - x[-1] ** expected) / before)


def _own(x: np.ndarray, y: np.ndarray) -> float:
    return float(y[int(np.argmin(np.abs(x - 1.0)))])


def observed(x: np.ndarray, y: np.ndarray) -> tuple[float | None, float]:
    """Order by least squares, weighted by 1/h as [Eca2014] do, and the standard deviation that it leaves; of three
    members the order that meets them. None: the differences do not fall."""
    orders = np.linspace(0.05, LARGEST_ORDER, 160)
    left = np.array([fit(x, y, p)[1] for p in orders])
    best = int(np.argmin(left))
    low, high = orders[max(best - 1, 0)], orders[min(best + 1, len(orders) - 1)]
    for _ in range(50):  # golden section
        a, b = high - 0.618034 * (high - low), low + 0.618034 * (high - low)
        low, high = (low, b) if fit(x, y, a)[1] < fit(x, y, b)[1] else (a, high)
    order = 0.5 * (low + high)
    if order < 0.06:
        return None, float(left[best])
    return float(order), fit(x, y, order)[1]


def fit(x: np.ndarray, y: np.ndarray, order: float) -> tuple[np.ndarray, float]:
    """(y0, a) of y0 + a x^order, and the weighted standard deviation of what is left."""
    weights, matrix, root, weighted = _equations(np.asarray(x, dtype=float).tobytes(), order)
    found = np.linalg.lstsq(weighted, y * root, rcond=None)[0]
    left = y - matrix @ found
    freedom = max(len(x) - 3, 1)
    return found, float(np.sqrt(len(x) * np.sum(weights * left**2) / freedom))


@functools.lru_cache(maxsize=4096)  # orders are tried for every quantity of a family, whose members are the same
def _equations(x_bytes: bytes, order: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Arrays for fit(), not to be changed: weights, columns, roots of the weights, weighted columns."""
    x = np.frombuffer(x_bytes)
    weights = 1.0 / x
    weights = weights / weights.sum()
    matrix = np.column_stack([np.ones_like(x), x**order])
    root = np.sqrt(weights)
    return weights, matrix, root, matrix * root[:, None]
