"""What to use for a wanted error, in plain words, from measured runs."""

from typing import List, Optional, Sequence, Tuple

from fsi_compare.starting.duration import duration
from fsi_compare.runs.waves import PRESSURE, QUANTITIES, Quantity
from .convergence import SPACE, TIME, Series
from .frontier import cheapest
from .measured import GAIN, JUDGED, Measured
from .plan import Plan
from .trend import trend


def percent(value: float) -> str:
    if not value == value:
        return "-"
    if value < 1e-6:
        return "< 0.0001 %"
    form = ".0f" if value >= 0.1 else ".1f" if value >= 0.01 else ".2g"
    return f"{100 * value:{form}} %"


def total_advice(measured: Sequence[Measured], plan: Plan, case: str) -> List[str]:
    """A line per target: the fastest setting whose errors of averaged pressure and displacement stay below it, and the
    fastest whose raw pressure does so too."""
    own = max(plan.references[case].own_error[q.column] for q in JUDGED)
    lines, missed = [], False
    for target in plan.targets:
        found = cheapest([(m.seconds, m.worst) for m in measured], target)
        if found is not None:
            chosen = measured[found]
            line = f"**{percent(target)}**: {_use(chosen)}." + _other_driver(measured, chosen, target)
            line += _raw_too(measured, chosen, target)
        else:
            best = min(measured, key=lambda m: m.worst)
            line = (
                f"**{percent(target)}**: no setting of this study reaches it in both; the best is "
                + percent(best.worst)
                + (f" ({_use(best)})" if not missed else "")
                + "."
                + _one_alone(measured, target)
                + _beyond(measured, target, own)
            )
            missed = True
        if own > target / 3:
            line += (
                f" The reference is itself uncertain by about {percent(own)}, which is not small beside this target."
            )
        lines.append(line)
    return lines


def _use(m: Measured) -> str:
    errors = " and ".join(f"{percent(m.total[q.column])} in {q.name}" for q in QUANTITIES)
    return f"{m.words}, {duration(m.seconds)} ({errors})"


def _raw_too(measured: Sequence[Measured], chosen: Measured, target: float) -> str:
    """What the raw pressure asks for beyond the averaged one."""
    if chosen.worst_of_all <= target:
        return ""
    found = cheapest([(m.seconds, m.worst_of_all) for m in measured], target)
    if found is not None:
        return f" With the raw {PRESSURE.name} below it too: {_use(measured[found])}."
    best = min(measured, key=lambda m: m.total[PRESSURE.column])
    return f" No setting brings the raw {PRESSURE.name} below it; the best is {_use(best)}."


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
    if found is not None:
        other = others[found]
        return (
            f" With the {name} driver: {other.words}, {duration(other.seconds)}, "
            f"{other.seconds / chosen.seconds:.2g} times as long."
        )
    if all(m.discretisation != chosen.discretisation for m in others):
        return f" The {name} driver was not tried on these equations."
    return f" No {name} setting of this study reaches it."


def estimate(series: Sequence[Series], case: str, quantity: Quantity) -> Optional[Tuple[Series, Series]]:
    """The series in which the quantity converges that have the finest end, in element size and in time step."""
    own = [s for s in series if s.finest.run.request.case == case and s.last(quantity.column).order]
    space = [s for s in own if s.what == SPACE]
    time = [s for s in own if s.what == TIME]
    if not space or not time:
        return None
    return (
        min(space, key=lambda s: (s.finest.step, s.finest.worst)),
        max(time, key=lambda s: (s.finest.nodes, -s.finest.step)),
    )


def _beyond(measured: Sequence[Measured], target: float, own: float) -> str:
    """What an error that no run has reached would take."""
    if own > target:
        return " Nor could it be judged by this reference."
    found = trend([(m.seconds, m.worst) for m in measured], GAIN)
    seconds = found.seconds(target) if found else None
    if not found or seconds is None:
        return " The runs are too far from it to say what it would take."
    return (
        f" Along the frontier the larger error has fallen as seconds^-{found.exponent:.2f}, from "
        f"{percent(found.largest[1])} in {duration(found.largest[0])} to {percent(found.smallest[1])} in "
        f"{duration(found.smallest[0])}; going on like that, mesh and step refined together, it would take about "
        f"{_long(seconds)}. That is an extrapolation by {found.smallest[1] / target:.2g} in the error, good for "
        "the order of magnitude."
    )


def _long(seconds: float) -> str:
    days = seconds / 86400
    return duration(seconds) if days < 2 else f"{days:.0f} days"


def algebraic_advice(group: Sequence[Measured], targets: Sequence[float]) -> List[str]:
    """For runs that solve the same equations: the fastest of each kind of coupling that stays below each target."""
    lines = []
    for target in targets:
        words = []
        kinds = sorted({m.kind for m in group}, key=lambda kind: (kind != "monolithic", kind))
        for name, members in [(kind, [m for m in group if m.kind == kind]) for kind in kinds]:
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
    return (
        f"The discretisation's own error is {percent(tight.worst)} here; a solver's error of a tenth of that does "
        f"not matter, and the fastest that keeps to it is {m.solving}, {duration(m.seconds)}."
    )


def small_steps(series: Sequence[Series]) -> str:
    """Where a smaller time step raised an error against the reference; empty: nowhere."""
    worse = []
    for one in series:
        for q in QUANTITIES if one.what == TIME else ():
            errors = [m.total[q.column] for m in one.runs]
            best = min(range(len(errors)), key=lambda i: errors[i])
            if best < len(errors) - 1 and errors[-1] > 1.1 * errors[best]:
                worse.append(
                    f"{one.fixed}: {q.name} {percent(errors[best])} with {one.runs[best].step:g} ms, "
                    f"{percent(errors[-1])} with {one.runs[-1].step:g} ms"
                )
    if not worse:
        return ""
    return (
        "A smaller step raised the error on an unchanged mesh (" + "; ".join(worse) + "). With a smaller step the "
        "time scheme damps short waves less, which the mesh carries at a wrong speed, and the fluid's pressure "
        "stabilisation, proportional to the step when that is small, fades; the study does not tell the two apart. "
        "Refine mesh and step together."
    )
