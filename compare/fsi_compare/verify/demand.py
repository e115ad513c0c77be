"""Which sizes of elements and steps reach a demanded error at the lowest cost, as far as the family tells.

The bars of the family fall with their orders, its seconds grow with theirs (cost.py). Of all pairs of sizes on a grid
whose widest predicted bar is within the demand, the cheapest is taken. The family then moves there: a prediction is no
bar."""

from dataclasses import dataclass, replace
from typing import Sequence

from .cost import Costs
from .curve_norms import Curve
from .results import Judged
from .verdict import Bar

RESERVE = 0.9  # of the demanded error, that a prediction is held to
COARSEST, FINEST = -4, 12  # powers of a ratio
STEPS_COARSEST, STEPS_FINEST = -3, 10  # powers of two
SOLVER_SHARE = 0.1  # of the demanded error
# Factors by which a tolerance may be changed; looser ones than the family has tried are not taken.
TOLERANCES = (1e-4, 10.0)


@dataclass(frozen=True)
class Settings:
    """Sizes relative to those that the bars are of, and what they are predicted to give."""

    mesh: float
    step: float
    error: float  # the widest bar, relative
    seconds: float
    memory: float  # MiB


def widest(judged: Sequence[Judged], mesh: float = 1.0, step: float = 1.0) -> float:
    """The widest bar of those that are given, relative."""
    return max((one.bar.at(mesh, step) / one.bar.scale for one in judged if one.bar.given), default=0.0)


def cheapest(
    judged: Sequence[Judged], costs: Costs, demand: float, ratio: float, static: bool, coarsens: bool
) -> Settings | None:
    """The cheapest pair of sizes that is predicted to reach the demand; None: no pair on the grid is."""
    best: Settings | None = None
    steps = [1.0] if static else [2.0**-k for k in range(STEPS_COARSEST, STEPS_FINEST + 1)]
    for power in range(COARSEST if coarsens else 0, FINEST + 1):
        mesh = ratio**-power if power else 1.0
        for step in steps:
            seconds = costs.seconds(mesh, step)
            if best is not None and seconds >= best.seconds:
                continue
            error = widest(judged, mesh, step)
            if error <= RESERVE * demand:
                best = Settings(mesh, step, error, seconds, costs.memory(mesh))
    return best


def tolerance_factor(judged: Sequence[Judged], demand: float) -> float:
    """Factor by which the solver's tolerances may change so that it has SOLVER_SHARE of the demanded error."""
    solver = max((one.bar.solver / one.bar.scale for one in judged if one.bar.given), default=0.0)
    least, most = TOLERANCES
    factor = most if solver <= 0 else min(most, max(least, SOLVER_SHARE * demand / solver))
    return factor if factor < 0.5 or factor > 2 else 1.0


def shown_by(one: Judged, curve: Curve) -> Judged:
    """The bar of another run, coarser than the family's centre or solved otherwise: that of the centre, and how far the
    two are apart. Mesh and step share the distance as they share the bar."""
    bar, value, apart = one.bar, one.quantity.of(curve), one.apart(curve)
    share = bar.mesh.bar / (bar.mesh.bar + bar.step.bar) if bar.mesh.bar + bar.step.bar > 0 else 1.0
    mesh = replace(bar.mesh, bar=bar.mesh.bar + share * apart)
    step = replace(bar.step, bar=bar.step.bar + (1 - share) * apart)
    return replace(one, bar=replace(bar, value=value, mesh=mesh, step=step))


def reached(judged: Sequence[Judged], demand: float) -> bool:
    return all(one.bar.given and one.bar.relative <= demand for one in judged)


def outside(judged: Sequence[Judged]) -> list[Judged]:
    """Quantities without a bar."""
    return [one for one in judged if not one.bar.given]


def refinable(judged: Sequence[Judged]) -> list[Judged]:
    """Quantities without a bar that may get one by refinement: no mesh makes one line of several."""
    return [one for one in outside(judged) if "mesh" in one.bar.advice or "step" in one.bar.advice]


def direction_of(judged: Sequence[Judged]) -> str:
    """What to refine so that more of them get a bar: "mesh", "step" or "both"."""
    bars: list[Bar] = [one.bar for one in outside(judged)]
    mesh = sum("mesh" in bar.advice for bar in bars)
    step = sum("step" in bar.advice for bar in bars)
    return "both" if mesh and step else "mesh" if mesh else "step"
