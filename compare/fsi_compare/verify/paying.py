"""Whether a further adaptation has paid (`verify --adapt`): whether the results came nearer to each other by it.

fsi-mesh adapt takes the indicators of velocity, displacement and pressure alike. Of each kind k, with ||.|| the norm of
a curve,

    D_k(n) = root of the mean over its curves of (||y_n - y_(n-1)|| / ||y_n||)^2

is what the n-th adaptation has changed. The n-th has not paid for a kind where D_k(n) >= D_k(n-1), n >= 2: what finer
meshes still change can no longer be told from what they have changed."""

from dataclasses import dataclass
from typing import Mapping, Sequence

import numpy as np

from .adapting import RATIO
from .curve_norms import Curve, norm_of, on, size_of
from .doubt import on_common_points
from .family import CaseFacts, Member
from .quantities import chosen, quantities_of
from .verdict import NEGLIGIBLE

KINDS = ("velocity", "displacement", "pressure")  # of fsi-mesh adapt
ORDINALS = {1: "first", 2: "second", 3: "third", 4: "fourth", 5: "fifth"}


@dataclass(frozen=True)
class Unpaid:
    """A kind that an adaptation has brought no nearer."""

    kind: str
    before: float  # what the adaptation before has changed, relative
    now: float


def kind_of(curve: Curve) -> str:
    """The kind whose error the curve has, of those that meshes are adapted to: areas and volumes move with the wall."""
    words = curve.name.rpartition(": ")[2]
    if curve.is_pressure:
        return "pressure"
    return "velocity" if "velocity" in words or "flow" in words else "displacement"


def changes(
    coarse: Mapping[str, Curve], fine: Mapping[str, Curve], facts: CaseFacts, names: Sequence[str]
) -> dict[str, float]:
    """D_k between two meshes, by kind, of the curves that have a quantity whose name holds one of `names`."""
    squares: dict[str, list[float]] = {}
    quantities = quantities_of(fine, facts.asked(()))
    asked = {quantity.curve for quantity in chosen(quantities, names)}
    for curve in (fine[name] for name in sorted(asked) if name in coarse):
        whole = (q.whole for q in quantities if q.curve == curve.name and q.whole is not None and not q.whole.largest)
        stretch = next(whole, None)
        if stretch is not None:
            apart = norm_of(curve, stretch)(on(curve, coarse[curve.name], stretch) - on(curve, curve, stretch))
            squares.setdefault(kind_of(curve), []).append((apart / size_of(curve, stretch)) ** 2)
    return {kind: float(np.sqrt(np.mean(of))) for kind, of in squares.items()}


def unpaid(levels: Sequence[Mapping[str, Curve]], facts: CaseFacts, names: Sequence[str]) -> list[Unpaid]:
    """Kinds for which the last of three meshes, each adapted from its predecessor, has not paid. A kind that changes by
    less than a thousandth is as good as converged."""
    keyed = on_common_points({Member(float(-n), 1.0): dict(curves) for n, curves in enumerate(levels)})
    first, second, third = keyed.values()
    before, now = changes(first, second, facts, names), changes(second, third, facts, names)
    found = (Unpaid(kind, before[kind], now[kind]) for kind in KINDS if kind in before and kind in now)
    return [one for one in found if one.now >= one.before and one.now > NEGLIGIBLE]


def about_unpaid(level: int, found: Sequence[Unpaid]) -> str:
    """A sentence that adaptation stops, and why."""
    number = ORDINALS.get(level, f"{level}th")
    what = ", ".join(f"{one.kind} ({100 * one.now:.2g} %, before {100 * one.before:.2g} %)" for one in found)
    return (
        f"adaptation stops: the {number} one has changed {what} by as much as the one before, or by more. There is no finer mesh than "
        f"that of size {RATIO**-level:.3g}, and none with shorter steps finer than {RATIO**(1 - level):.3g}; bars are of the "
        "meshes that are there. --of NAME judges by what it names alone"
    )
