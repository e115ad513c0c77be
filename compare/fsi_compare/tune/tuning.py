"""Beat after beat: run, fit the model, find values, until a beat shows what is asked for."""

from dataclasses import dataclass, field
from typing import Any, Callable, Mapping, Sequence

import numpy as np

from ..base.errors import InputError
from .beat import Repetition, cut_off, given_ends, outlets_of, repetitions, shown_by_run
from .circuit import PHASES, GivenFlow, Windkessel
from .curves import LEAD, Curves
from .scene import WINDKESSEL, Scene
from .solving import DIGITS, Model, Rule, reachable_pulse, solved
from .targets import FLOW, SYSTOLIC, Target
from .vessel import Vessel, fitted_vessel

NEAR = 0.01  # of the pressure: beats that begin further from periodic say nothing of the model's error
FEWEST_LEVELS = 16  # behind the lead of a beat

Laws = Mapping[str, Windkessel]  # by outlet
Starts = Mapping[str, float]  # pressures in kPa, by outlet


@dataclass(frozen=True)
class Demand:
    targets: Sequence[Target]
    rule: Rule
    tolerance: float  # relative
    beats: int


@dataclass(frozen=True)
class Beat:
    """One that was run."""

    number: int
    values: Laws
    starts: Starts  # kPa, of the Windkessels; empty: as the case says
    got: np.ndarray  # (targets,)
    foreseen: np.ndarray | None  # by the model of the beat before; None: there was none
    repeats: Mapping[str, Repetition]
    vessel: Vessel
    period_share: float  # distance from the periodic state over the largest pressure of the beat
    seconds: float

    @property
    def about(self) -> dict[str, float]:
        return {"beat": self.number, "seconds": self.seconds, "distance_from_periodic": self.period_share}

    def differences(self, targets: Sequence[Target]) -> np.ndarray:
        """Relative, (targets,)."""
        asked = np.array([target.value for target in targets])
        return (self.got - asked) / asked

    def holds(self, demand: Demand) -> bool:
        near = bool(np.all(np.abs(self.differences(demand.targets)) <= demand.tolerance))
        return near and self.period_share <= demand.tolerance


@dataclass
class Outcome:
    beats: list[Beat] = field(default_factory=list)
    reached: bool = False
    lines: list[str] = field(default_factory=list)  # what was decided and found, in sentences


@dataclass(frozen=True)
class Ran:
    """What a run of one beat gave."""

    curves: Curves
    seconds: float


class BeatFailed(Exception):
    """A beat behind the first did not come to its end; why."""


RunBeat = Callable[[int, Mapping[str, Any]], Ran]  # number and entries over the case's


def tune(scene: Scene, demand: Demand, run_beat: RunBeat, tell: Callable[[str], None]) -> Outcome:
    """Runs beats until one shows what is asked for. Raises InputError where a beat cannot be looked at."""
    outcome = Outcome()
    case = {name: scene.law(name) for name in scene.windkessels}
    values, starts = case, _starts_of_case(scene)
    settings: dict[str, Any] = {}
    foreseen: np.ndarray | None = None
    limits: list[str] = []
    for number in range(1, demand.beats + 1):
        try:
            ran = run_beat(number, settings)
        except BeatFailed as failure:
            had = [f"{key} = {value:g}" for key, value in settings.items() if isinstance(value, float)]
            outcome.lines += [f"Beat {number} did not come to its end: {failure}", f"It had {', '.join(had)}."]
            return outcome
        beat = _beat(scene, demand, number, ran, values, starts, foreseen)
        outcome.beats.append(beat)
        tell(_words(beat, demand))
        if beat.holds(demand):
            outcome.reached = True
            outcome.lines += cut_off(ran.curves, demand.targets, scene.period)
            outcome.lines.append(f"Beat {number} shows all that is asked for within {100 * demand.tolerance:g} %.")
            return outcome
        model = Model(beat.vessel, given_ends(scene, ran.curves, PHASES), case, scene.period)
        entering = _entering(model)
        if entering is not None and not entering > 0:
            said = f"the mean flow into the vessel is {entering:.3g} mm^3/ms"
            outcome.lines.append(f"Nothing can be found: {said}. Give a table with a positive mean.")
            return outcome
        state = model.state(values)
        near = beat.period_share <= NEAR
        correction = beat.got - model.shown(values, demand.targets) if near else np.zeros(len(demand.targets))
        offset = {n: r.periodic - float(state.stored[n][0]) if near else 0.0 for n, r in beat.repeats.items()}
        solution = solved(model, demand.targets, demand.rule, correction)
        pulse = reachable_pulse(model, demand.targets, demand.rule, solution)
        limits = _limits(model, demand, solution.foreseen, pulse)
        values, foreseen = solution.values, solution.foreseen
        stored = model.state(values).stored
        starts = {n: float(f"{float(stored[n][0]) + offset[n]:.{DIGITS}g}") for n in values}
        settings = settings_of(scene, values, starts)
    outcome.lines += [*_missed(outcome.beats[-1], demand), *cut_off(ran.curves, demand.targets, scene.period), *limits]
    return outcome


def _starts_of_case(scene: Scene) -> dict[str, float]:
    """Pressures that the case gives at the start; with a lumped start the driver finds them."""
    if scene.entries["time"].get("start") == "lumped":
        return {}
    return {n: float(scene.openings[n][WINDKESSEL].get("initial_pressure", 0.0)) for n in scene.windkessels}


def settings_of(scene: Scene, values: Laws, starts: Starts) -> dict[str, Any]:
    """Entries of a case by their full keys."""
    found: dict[str, Any] = {}
    for name, law in values.items():
        values_of = {**law.values, "initial_pressure": starts[name]}
        found |= {f"opening.{name}.windkessel.{key}": value for key, value in values_of.items()}
    if "start" in scene.entries["time"]:
        found["time.start"] = "given"
    return found


def _beat(
    scene: Scene, demand: Demand, number: int, ran: Ran, values: Laws, starts: Starts, foreseen: np.ndarray | None
) -> Beat:
    curves, period = ran.curves, scene.period
    for name in [*scene.windkessels, *(target.opening for target in demand.targets)]:
        if name not in curves.flow:
            raise InputError(scene.path, "opening", f"the beat has no rows of '{name}' in openings.csv", "see run.log")
    late = curves.after(LEAD * period)
    if len(late.time) < FEWEST_LEVELS:
        problem = f"a beat has {len(late.time)} levels behind its first tenth"
        raise InputError(scene.path, "time.step", problem, f"take steps that give {FEWEST_LEVELS} or more")
    ends = given_ends(scene, curves, PHASES)
    got = shown_by_run(curves, demand.targets, outlets_of(ends), period)
    repeats = repetitions(curves, values, starts, period)
    largest = max(float(np.abs(pressure).max()) for pressure in late.pressure.values())
    away = max(one.distance for one in repeats.values()) / largest
    return Beat(number, values, starts, got, foreseen, repeats, fitted_vessel(late, scene.elastic), away, ran.seconds)


def _words(beat: Beat, demand: Demand) -> str:
    worst = 100 * float(np.abs(beat.differences(demand.targets)).max())
    away = 100 * beat.period_share
    return f"beat {beat.number}: largest difference {worst:.2g} %, {away:.2g} % from its periodic state at the start"


def _entering(model: Model) -> float | None:
    """The mean flow into the vessel; None where a pressure is given, which decides it."""
    if not all(isinstance(end, (GivenFlow, Windkessel)) for end in model.ends.values()):
        return None
    return -sum(float(end.flow.mean()) for end in model.ends.values() if isinstance(end, GivenFlow))


def _limits(model: Model, demand: Demand, foreseen: np.ndarray, pulse: tuple[float, float] | None) -> list[str]:
    """Why the model itself does not come to what is asked for, with what to try."""
    asked = np.array([target.value for target in demand.targets])
    if bool(np.all(np.abs(foreseen - asked) <= 0.5 * demand.tolerance * asked)):
        return []
    lines = []
    if pulse is not None:
        values = {target.kind: target.value for target in demand.targets if target.is_pressure}
        wanted = values[SYSTOLIC] - min(values.values())
        said = f"between {pulse[0]:.3g} and {pulse[1]:.3g} kPa; {wanted:.3g} kPa are asked for"
        if not pulse[0] <= wanted <= pulse[1]:
            lines.append(f"With these resistances any compliance behind the outlets gives a pulse pressure {said}.")
        if wanted < pulse[0]:
            lines.append("Try a smaller --proximal, which lowers the least pulse pressure.")
        elif wanted > pulse[1]:
            own = model.vessel.compliance
            stored = f"the vessel's own compliance of {own:.3g} mm^3/kPa" if own else "the flow"
            remedy = "try a stiffer wall, a larger pulse of the flow, or less pulse pressure."
            lines.append(f"What limits it is {stored}: {remedy}")
    flows = [target.value for target in demand.targets if target.kind == FLOW]
    entering = _entering(model)
    if flows and entering is not None:
        if len(flows) == len(model.case) and abs(sum(flows) / entering - 1) > demand.tolerance:
            lines.append(f"The flows asked for are {sum(flows):.4g} mm^3/ms together, and {entering:.4g} enter.")
    if not lines:
        lines.append("The model has no values that give all targets: change one of them, or --proximal.")
    return lines


def _missed(beat: Beat, demand: Demand) -> list[str]:
    lines = [f"Not reached in {demand.beats} beat{'s' if demand.beats > 1 else ''}."]
    if beat.period_share > demand.tolerance:
        begins = f"Beat {beat.number} begins {100 * beat.period_share:.2g} % from its periodic state"
        lines.append(f"{begins}: try a wall with prestress, or more --beats.")
    for target, got, far in zip(demand.targets, beat.got, beat.differences(demand.targets)):
        if abs(far) > demand.tolerance:
            numbers = f"{target.value:.4g} asked for, {got:.4g} found, {100 * far:+.2g} %."
            lines.append(f"{target.opening}, {target.kind}: {numbers}")
    left = beat.vessel.unexplained_pressure
    if left > 0.2:
        lines.append(f"The model leaves {100 * left:.0f} % of the pressure differences within the vessel unexplained.")
    return lines
