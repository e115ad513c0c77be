"""How far two runs are apart along a line, in the norms of `fsi-compare pressure`."""

from dataclasses import dataclass
from typing import Sequence

import numpy as np

from ..base.errors import InputError
from ..runs.differences import OverTime, differences_at, largest_difference
from .line import Line


@dataclass(frozen=True)
class LineDifference:
    """Norms of run - reference along a line. Relative norms are NaN where the reference is zero."""

    times: np.ndarray  #: ms, (times,)
    unit: str  #: of the quantity
    max_norm: np.ndarray  #: largest absolute difference, (times,), in `unit`
    max_relative: np.ndarray  #: to the largest absolute value of the reference at the same time, (times,)
    l2_norm: np.ndarray  #: (integral of the squared difference dz)^(1/2), (times,), in `unit` mm^(1/2)
    l2_relative: np.ndarray  #: to that of the reference at the same time, (times,)
    largest: OverTime  #: of each norm by itself, over the levels that both runs have


def difference(
    line: Line | None, reference: Line | None, quantity: str, times: Sequence[float] | None = None
) -> LineDifference:
    """Difference of one quantity between the lines of two runs, on the points of the reference; linear between points
    and between time levels. `times` in ms; without them the levels of the reference that the other run reaches. Raises
    InputError for missing lines or quantities, and for times or points that one of them does not reach.
    """
    if line is None or reference is None:
        raise InputError("", "line", "is not there", "compare runs that have both written it")
    waves, base = line.waves(quantity), reference.waves(quantity)
    if not waves.covers_line(base.z):
        raise waves.elsewhere(base.z, "", f"line {line.name}", "the reference's")
    asked = [float(t) for t in base.times if waves.covers(t)] if times is None else [float(t) for t in times]
    for one, found in ((line, waves), (reference, base)):
        for time in asked:
            found.require(time, "", f"line {one.name}")
    rows = [(d.max_norm, d.max_relative, d.l2_norm, d.l2_relative) for d in differences_at(base, waves, asked)]
    most, most_relative, l2, l2_relative = np.array(rows, dtype=float).reshape(-1, 4).T  # None becomes NaN
    unit, largest = reference.units[quantity], largest_difference(base, waves.on(base.z))
    return LineDifference(np.array(asked), unit, most, most_relative, l2, l2_relative, largest)
