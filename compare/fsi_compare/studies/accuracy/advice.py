"""What to use for a wanted error, in plain words, from measured runs."""

import math
from typing import List, Optional, Sequence, Tuple

from ...progress import duration
from .plan import Plan
from .convergence import SPACE, TIME, Series, growth
from .frontier import cheapest
from .measured import Measured
from .reach import Part, Reach, reach
from .waves import QUANTITIES, Quantity

OUT_OF_REACH = 86400.0  # s, a day


def percent(value: float) -> str:
    if not value == value:
        return "-"
    if value < 1e-6:
        return "< 0.0001 %"
    form = ".0f" if value >= 0.1 else ".1f" if value >= 0.01 else ".2g"
    return f"{100 * value:{form}} %"


def total_advice(measured: Sequence[Measured], series: Sequence[Series], plan: Plan, case: str) -> List[str]:
    """A line per target: the fastest setting whose two errors against the reference stay below it."""
    own = max(plan.references[case].own_error.values())
    lines, missed = [], False
    for target in plan.targets:
        found = cheapest([(m.seconds, m.worst) for m in measured], target)
        if found is not None:
            line = f"**{percent(target)}**: {_use(measured[found])}." + _other_driver(measured, measured[found], target)
        else:
            best = min(measured, key=lambda m: m.worst)
            line = (f"**{percent(target)}**: no setting of this study reaches it in both; the best is "
                    + percent(best.worst) + (f" ({_use(best)})" if not missed else "") + "."
                    + _one_alone(measured, target) + " " + _extrapolation(measured, series, plan, case, target))
            missed = True
        if own > target / 3:
            line += (f" The reference is itself uncertain by about {percent(own)}, which is not small beside this "
                     "target.")
        lines.append(line)
    return lines


def _use(m: Measured) -> str:
    errors = " and ".join(f"{percent(m.total[q.column])} in {q.name}" for q in QUANTITIES)
    return f"{m.words}, {duration(m.seconds)} ({errors})"


def _one_alone(measured: Sequence[Measured], target: float) -> str:
    """For a target that is not reached in both quantities: the fastest for one of them."""
    text = ""
    for quantity in QUANTITIES:
        found = cheapest([(m.seconds, m.total[quantity.column]) for m in measured], target)
        if found is not None:
            text += f" For {quantity.name} alone: {_use(measured[found])}."
    return text


def _other_driver(measured: Sequence[Measured], chosen: Measured, target: float) -> str:
    others = [m for m in measured if m.partitioned != chosen.partitioned]
    found = cheapest([(m.seconds, m.worst) for m in others], target)
    name = "monolithic" if chosen.partitioned else "partitioned"
    if found is None:
        return f" No {name} setting of this study reaches it."
    other = others[found]
    return (f" With the {name} driver: {other.words}, {duration(other.seconds)}, "
            f"{other.seconds / chosen.seconds:.2g} times as long.")


def estimate(series: Sequence[Series], case: str, quantity: Quantity) -> Optional[Tuple[Series, Series]]:
    """Of the series in which the quantity converges: that with the finest end in element size, and in time step."""
    own = [s for s in series if s.finest.run.request.case == case and s.last(quantity.column).order]
    space = [s for s in own if s.what == SPACE]
    time = [s for s in own if s.what == TIME]
    if not space or not time:
        return None
    return (min(space, key=lambda s: (s.finest.step, s.finest.worst)),
            max(time, key=lambda s: (s.finest.nodes, -s.finest.step)))


def _extrapolation(measured: Sequence[Measured], series: Sequence[Series], plan: Plan, case: str, target: float) -> str:
    method = [m for m in measured if m.run.request.method.name == plan.method and m.mesh in plan.family]
    try:
        exponents, constant = growth(method)
    except ValueError:
        return "The runs do not vary mesh and step enough to extrapolate their seconds."
    demands: List[Tuple[float, float, float, Reach, str]] = []
    for quantity in QUANTITIES:
        chosen = estimate(series, case, quantity)
        if chosen is None:
            continue
        space, time = (one.last(quantity.column) for one in chosen)
        need = reach(target, Part(space.remaining, space.order), Part(time.remaining, time.order), exponents)
        nodes, step = chosen[0].finest.nodes * need.nodes_factor, chosen[1].finest.step * need.step_factor
        seconds = math.exp(constant) * nodes ** exponents.nodes * step ** -exponents.steps
        demands.append((seconds, nodes, step, need, quantity.name))
    if not demands:
        return "The observed orders do not allow an extrapolation."
    seconds, nodes, step, need, name = max(demands, key=lambda demand: demand[0])
    return (f"Extrapolated by the observed orders in {name} it would take about {_round(nodes)} nodes, steps of "
            f"{step:.2g} ms and {_long(seconds)} with the monolithic driver (seconds grow with nodes to the "
            f"{exponents.nodes:.2f} and steps to the {exponents.steps:.2f}); an extrapolation by "
            f"{_round(need.nodes_factor)} in nodes and {_round(1 / need.step_factor)} in steps, good "
            "for the order of magnitude."
            + (" That is out of reach: other elements, or an axisymmetric scene, are the way there."
               if seconds > OUT_OF_REACH else ""))


def _long(seconds: float) -> str:
    days = seconds / 86400
    return duration(seconds) if days < 2 else f"{days:.0f} days" if days < 700 else f"{_round(days / 365)} years"


def _round(value: float) -> str:
    """Two digits."""
    digits = 1 - int(math.floor(math.log10(value)))
    return f"{round(value, digits):,.{max(0, digits)}f}"


def algebraic_advice(group: Sequence[Measured], targets: Sequence[float]) -> List[str]:
    """Of runs that solve the same equations: the fastest of each driver that stays below each target."""
    lines = []
    for target in targets:
        words = []
        for name, members in (("monolithic", [m for m in group if not m.partitioned]),
                              ("partitioned", [m for m in group if m.partitioned])):
            found = cheapest([(m.seconds, m.worst_algebraic) for m in members], target)
            if found is not None:
                m = members[found]
                words.append(f"{m.solving}, {duration(m.seconds)} (error {percent(m.worst_algebraic)})")
            elif members:
                words.append(f"no {name} setting of this study")
        lines.append(f"**{percent(target)}**: " + "; ".join(words) + ".")
    return lines


def enough(group: Sequence[Measured], tight: Measured) -> str:
    """A solver's error that does not matter beside the discretisation's: a tenth of it."""
    limit = tight.worst / 10
    found = cheapest([(m.seconds, m.worst_algebraic) for m in group], limit)
    if found is None:
        return f"No setting stays below a tenth of the discretisation's own error of {percent(tight.worst)}."
    m = group[found]
    return (f"The discretisation's own error is {percent(tight.worst)} here; a solver's error of a tenth of that does "
            f"not matter, and the fastest that keeps to it is {m.solving}, {duration(m.seconds)}.")


def small_steps(series: Sequence[Series]) -> str:
    """Where a smaller time step raised an error against the reference; empty: nowhere."""
    worse = []
    for one in series:
        for q in QUANTITIES if one.what == TIME else ():
            errors = [m.total[q.column] for m in one.runs]
            best = min(range(len(errors)), key=lambda i: errors[i])
            if best < len(errors) - 1 and errors[-1] > 1.1 * errors[best]:
                worse.append(f"{one.fixed}: {q.name} {percent(errors[best])} with {one.runs[best].step:g} ms, "
                             f"{percent(errors[-1])} with {one.runs[-1].step:g} ms")
    if not worse:
        return ""
    return ("A smaller step raised the error on an unchanged mesh (" + "; ".join(worse) + "). With a smaller step the "
            "time scheme damps short waves less, which the mesh carries at a wrong speed, and the fluid's pressure "
            "stabilisation, proportional to the step when that is small, fades; the study does not tell the two apart. "
            "Refine mesh and step together.")
