"""What forbids a bar however a sequence looks, because its members do not show all of the error."""

from dataclasses import replace
from typing import Mapping, Sequence

import numpy as np

from .curve_norms import Curve
from .family import CaseFacts, Member
from .quantities import Quantity

SAME_LENGTH = 0.02  # of a line's length: what members may differ by
WITHIN = 0.25  # of the distance of two points: what one of them may differ by in members
PER_INTERVAL = 4  # steps within an interval of a table, below which its kinks are not resolved


def doubt(quantity: Quantity, curves: Sequence[Curve], facts: CaseFacts) -> str:
    """What to do so that a bar can be given; empty: nothing forbids one. `curves`: that of the quantity in each member.

    A pressure follows the derivative of a given flow, which jumps at the points of its table. Steps about as long as
    the table's intervals see the mean of each interval, and halves of them the same."""
    if is_another_line(curves):
        return "the line is another one in each member: give a line with ends in [output.lines.NAME]"
    interval = facts.flow_interval
    if not (interval and quantity.is_extreme and quantity.is_pressure) or curves[0].derived:
        return ""
    finest = min(float(np.median(np.diff(curve.times))) for curve in curves)
    if finest * PER_INTERVAL <= interval * (1 + 1e-9):
        return ""
    return f"shorten the step until {PER_INTERVAL} are in an interval of the flow's table, {interval:g} ms"


def step_within(facts: CaseFacts) -> float | None:
    """Steps, relative to the case's, that resolve the table of its flow; None: it has none, or no steps of its own."""
    if not facts.flow_interval or facts.adaptive or facts.static:
        return None
    return facts.flow_interval / PER_INTERVAL / facts.step


def is_another_line(curves: Sequence[Curve]) -> bool:
    """A centre line that a driver finds in the mesh may take other ways through it."""
    lengths = [float(curve.s[-1] - curve.s[0]) for curve in curves if len(curve.s) > 1]
    return bool(lengths) and max(lengths) - min(lengths) > SAME_LENGTH * max(lengths)


def on_common_points(curves: Mapping[Member, Mapping[str, Curve]]) -> dict[Member, dict[str, Curve]]:
    """Lines at the points that all members have: where one leaves the mesh, a curved edge decides which are within."""
    found = {member: dict(of) for member, of in curves.items()}
    for name in {name for of in curves.values() for name in of}:
        having = [of[name] for of in curves.values() if name in of]
        if len({len(curve.s) for curve in having}) == 1 or is_another_line(having):
            continue
        for of in found.values():
            if name in of:
                of[name] = _common(of[name], having)
    return found


def _common(curve: Curve, others: Sequence[Curve]) -> Curve:
    within = WITHIN * float(np.min(np.diff(curve.s))) if len(curve.s) > 1 else 0.0
    kept = [all(np.min(np.abs(other.s - s)) <= within for other in others) for s in curve.s]
    return replace(curve, values=curve.values[:, kept], s=curve.s[kept]) if any(kept) else curve
