"""What a beat shows: of a run, and of the periodic state of the model."""

from dataclasses import dataclass
from typing import Callable, Mapping, Sequence

import numpy as np

from .circuit import End, GivenFlow, GivenPressure, State, Windkessel, mean_flows
from .curves import LEAD, Curves, mean, over_period
from .scene import Scene
from .targets import DIASTOLIC, FLOW, MEAN, SPLIT, SYSTOLIC, Target
from .vessel import Vessel


def given_ends(scene: Scene, curves: Curves, phases: int) -> dict[str, End]:
    """Ends of all openings, with the laws of the case; what the case gives there, as a run shows it."""
    found: dict[str, End] = {}
    for name in curves.flow:
        kind = scene.kind(name)
        if kind in ("resistance", "windkessel"):
            found[name] = scene.law(name)
        elif kind == "flow_rate":
            found[name] = GivenFlow(over_period(curves.time, curves.flow[name], scene.period, phases))
        else:
            found[name] = GivenPressure(over_period(curves.time, curves.pressure[name], scene.period, phases))
    return found


def with_values(ends: Mapping[str, End], values: Mapping[str, Windkessel]) -> dict[str, End]:
    return {name: values.get(name, end) for name, end in ends.items()}


def shown_by_run(curves: Curves, targets: Sequence[Target], outlets: Sequence[str], period: float) -> np.ndarray:
    """The targets' values, (targets,): extremes behind the first LEAD of the beat, means over all of it."""
    late = curves.after(LEAD * period)
    flows = {name: mean(curves.time, curves.flow[name], period) for name in outlets}
    means = {t.opening: mean(curves.time, curves.pressure[t.opening], period) for t in targets if t.kind == MEAN}
    return _shown(targets, late.pressure, means, flows)


def cut_off(curves: Curves, targets: Sequence[Target], period: float) -> list[str]:
    """Extremes that a beat has at the end of its lead, so that they may lie within it; in words."""
    late = curves.after(LEAD * period).pressure
    first = {SYSTOLIC: np.argmax, DIASTOLIC: np.argmin}
    return [
        f"The {target.kind} at {target.opening} is that at the end of the beat's first tenth, which is not looked at: "
        "let the tables begin in diastole."
        for target in targets
        if target.kind in first and first[target.kind](late[target.opening]) == 0
    ]


def shown_by_model(state: State, vessel: Vessel, ends: Mapping[str, End], targets: Sequence[Target]) -> np.ndarray:
    flows = mean_flows(vessel, ends)
    outlets = outlets_of(ends)
    means = {t.opening: float(state.pressure[t.opening].mean()) for t in targets if t.kind == MEAN}
    return _shown(targets, state.pressure, means, {name: flows[name] for name in outlets})


def outlets_of(ends: Mapping[str, End]) -> list[str]:
    """Openings by which flow leaves that is not given: laws, and free ones where something else drives the flow."""
    laws = [name for name, end in ends.items() if isinstance(end, Windkessel)]
    free = [name for name, end in ends.items() if isinstance(end, GivenPressure)]
    return laws + free if any(isinstance(end, GivenFlow) for end in ends.values()) else laws


def _shown(
    targets: Sequence[Target], pressure: Mapping[str, np.ndarray], means: Mapping[str, float], flows: dict[str, float]
) -> np.ndarray:
    total = sum(flows.values())
    of_kind: dict[str, Callable[[str], float]] = {
        DIASTOLIC: lambda opening: float(pressure[opening].min()),
        SYSTOLIC: lambda opening: float(pressure[opening].max()),
        MEAN: lambda opening: means[opening],
        FLOW: lambda opening: flows[opening],
        SPLIT: lambda opening: flows[opening] / total if total else 0.0,
    }
    return np.array([of_kind[target.kind](target.opening) for target in targets])


@dataclass(frozen=True)
class Repetition:
    """Pressure that a Windkessel stores at the beginning and at the end of a beat."""

    begin: float  # kPa
    end: float  # kPa
    kept: float  # share of a difference from the periodic state that is left after the beat

    @property
    def periodic(self) -> float:
        """Where it would begin if it were periodic with the flow of this beat, kPa."""
        return (self.end - self.kept * self.begin) / (1 - self.kept)

    @property
    def distance(self) -> float:
        """Distance at the beat's beginning, where it is largest, from the periodic state, kPa."""
        return abs(self.begin - self.periodic)


def repetitions(
    curves: Curves, values: Mapping[str, Windkessel], starts: Mapping[str, float], period: float
) -> dict[str, Repetition]:
    """Repetitions of all Windkessels. `starts`: their pressures in kPa at the start; without them the first level's."""
    found = {}
    for name, law in values.items():
        stored = curves.stored.get(name, np.zeros(1))
        kept = float(np.exp(-period / (law.distal * law.compliance)))
        found[name] = Repetition(starts.get(name, float(stored[0])), float(stored[-1]), kept)
    return found
