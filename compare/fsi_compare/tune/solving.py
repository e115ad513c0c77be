"""Values of the Windkessels with which the periodic state of the model has what is asked for.

Unknowns are the logarithms of each outlet's resistance, or of one factor of all where no flow is asked for, and of
the compliance of all outlets together, where a diastolic and a systolic pressure are. Two rules give the rest: the
proximal resistance is a share of an outlet's, or stays as the case has it; the compliance is shared out like the mean
flow. Least squares of the relative differences by Levenberg's and Marquardt's method ([More1978]).
"""

from dataclasses import dataclass
from typing import Callable, Mapping, Sequence

import numpy as np

from .beat import shown_by_model, with_values
from .circuit import End, State, Windkessel, mean_flows, periodic_state
from .targets import FLOW, SPLIT, SYSTOLIC, Target
from .vessel import Vessel

ITERATIONS, SMALL = 60, 1e-9
FURTHEST = float(np.log(1e4))  # of an unknown from its start
DIFFERENCE = 1e-5
DIGITS = 6  # of the values that a case gets


@dataclass(frozen=True)
class Rule:
    """Rule for proximal resistances."""

    share: float | None  # of an outlet's whole; None: the case's values stay

    def law(self, case: Windkessel, whole: float, compliance: float) -> Windkessel:
        proximal = case.proximal if self.share is None else self.share * whole
        return Windkessel(proximal, compliance, max(whole - proximal, 1e-6 * whole), case.distal_pressure)

    @property
    def words(self) -> str:
        return "as in the case" if self.share is None else f"{100 * self.share:g} % of an outlet's resistance"


@dataclass(frozen=True)
class Model:
    """The vessel with what its openings are given, and the Windkessels of the case."""

    vessel: Vessel
    ends: Mapping[str, End]
    case: Mapping[str, Windkessel]  # those that are tuned
    period: float

    def state(self, values: Mapping[str, Windkessel]) -> State:
        return periodic_state(self.vessel, with_values(self.ends, values), self.period)

    def shown(self, values: Mapping[str, Windkessel], targets: Sequence[Target]) -> np.ndarray:
        return shown_by_model(self.state(values), self.vessel, with_values(self.ends, values), targets)


class Unknowns:
    """Turns unknowns into Windkessels."""

    def __init__(self, model: Model, targets: Sequence[Target], rule: Rule) -> None:
        self.model, self.rule = model, rule
        self.each = any(target.kind in (SPLIT, FLOW) for target in targets)  # outlet has a resistance of its own
        self.pulse = any(target.kind == SYSTOLIC for target in targets)
        self.names = list(model.case)

    def start(self) -> np.ndarray:
        whole = [np.log(self.model.case[name].resistance) for name in self.names] if self.each else [0.0]
        compliance = sum(law.compliance for law in self.model.case.values())
        return np.array([*whole, *([np.log(compliance)] if self.pulse else [])])

    def values(self, unknowns: np.ndarray) -> dict[str, Windkessel]:
        factors = np.exp(unknowns)
        case = self.model.case
        shared = {} if self.each else {n: factors[0] * law.resistance for n, law in case.items()}
        whole = shared or dict(zip(self.names, factors))
        if not self.pulse:
            return {n: self.rule.law(law, whole[n], law.compliance) for n, law in case.items()}
        laws = {n: self.rule.law(law, whole[n], 1.0) for n, law in case.items()}
        flows = mean_flows(self.model.vessel, with_values(self.model.ends, laws))
        out = {name: max(flows[name], 0.0) for name in self.names}
        total = sum(out.values())
        shares = {n: out[n] / total if total > 0 else 1 / len(out) for n in out}
        compliance = {n: factors[-1] * max(shares[n], 1e-6) for n in out}
        return {n: self.rule.law(law, whole[n], compliance[n]) for n, law in case.items()}


@dataclass(frozen=True)
class Solution:
    values: dict[str, Windkessel]
    foreseen: np.ndarray  # the targets' values by the model, corrected, (targets,)
    unknowns: np.ndarray


def solved(model: Model, targets: Sequence[Target], rule: Rule, correction: np.ndarray) -> Solution:
    """`correction`: what a run shows beyond the model, (targets,). The nearest values where targets cannot be met."""
    unknowns = Unknowns(model, targets, rule)
    asked = np.array([target.value for target in targets])

    def left(x: np.ndarray) -> np.ndarray:
        return (model.shown(unknowns.values(x), targets) + correction - asked) / asked

    x = _least_squares(left, unknowns.start())
    values = {name: rounded(law) for name, law in unknowns.values(x).items()}
    return Solution(values, model.shown(values, targets) + correction, x)


def _least_squares(left: Callable[[np.ndarray], np.ndarray], start: np.ndarray) -> np.ndarray:
    x, damping = start.copy(), 1e-3
    residual = left(x)
    for _ in range(ITERATIONS):
        steps = DIFFERENCE * np.eye(len(x))
        jacobian = np.column_stack([(left(x + step) - left(x - step)) / (2 * DIFFERENCE) for step in steps])
        normal, slope = jacobian.T @ jacobian, jacobian.T @ residual
        for _ in range(12):
            scale = np.maximum(np.diag(normal), 1e-12 * max(float(normal.max()), 1e-300))
            move = -np.linalg.solve(normal + damping * np.diag(scale), slope)
            trial = np.clip(x + np.clip(move, -1.5, 1.5), start - FURTHEST, start + FURTHEST)
            there = left(trial)
            if there @ there < residual @ residual:
                break
            damping *= 10
        else:
            return x
        moved = float(np.abs(trial - x).max())
        x, residual, damping = trial, there, max(damping / 10, 1e-9)
        if moved < SMALL or float(np.abs(residual).max()) < SMALL:
            return x
    return x


def rounded(law: Windkessel) -> Windkessel:
    """The law with the digits that a case file gets, so that a beat and the case are the same."""
    proximal, compliance, distal = (float(f"{value:.{DIGITS}g}") for value in law.values.values())
    return Windkessel(proximal, compliance, distal, law.distal_pressure)


def reachable_pulse(
    model: Model, targets: Sequence[Target], rule: Rule, solution: Solution
) -> tuple[float, float] | None:
    """The smallest and largest pulse pressure in kPa that compliances behind the outlets can give with the resistances
    found; None where no pulse is asked for."""
    unknowns = Unknowns(model, targets, rule)
    opening = next((target.opening for target in targets if target.kind == SYSTOLIC), None)
    if opening is None:
        return None
    found = []
    for far in (FURTHEST, -FURTHEST):
        x = solution.unknowns.copy()
        x[-1] = unknowns.start()[-1] + far
        pressure = model.state(unknowns.values(x)).pressure[opening]
        found.append(float(pressure.max() - pressure.min()))
    return found[0], found[1]
