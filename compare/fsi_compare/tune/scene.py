"""What the tuning needs of a case file: its openings, their Windkessels, the period."""

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Mapping, Sequence

from ..base.errors import InputError
from ..base.numbers import is_number
from ..base.suggestions import nearest
from .circuit import Windkessel
from .targets import FLOW, MEAN, SPLIT, SPLITS_MISS, SYSTOLIC, Target, no_pressure

WINDKESSEL = "windkessel"
LAWS = ("pressure", "flow_rate", "resistance", WINDKESSEL)
GIVE_PERIOD = "give period in its [[opening]], in ms"


@dataclass(frozen=True)
class Scene:
    path: Path
    entries: Mapping[str, Any]
    openings: Mapping[str, Mapping[str, Any]]  # sections [[opening]] by surface
    period: float  # ms

    @property
    def windkessels(self) -> list[str]:
        return [name for name, one in self.openings.items() if WINDKESSEL in one]

    @property
    def elastic(self) -> bool:
        return "structure" in self.entries

    def kind(self, opening: str) -> str:
        """One of LAWS, or "" for what is free or the case does not list."""
        return next((law for law in LAWS if law in self.openings.get(opening, {})), "")

    def law(self, opening: str) -> Windkessel:
        """The law of an opening, a resistance or Windkessel, as the case has it."""
        section = self.openings[opening]
        if WINDKESSEL not in section:
            return Windkessel(float(section["resistance"]), 1.0, 0.0, float(section.get("distal_pressure", 0.0)))
        values = section[WINDKESSEL]
        return Windkessel(*(float(values.get(k, 0.0)) for k in ("proximal", "compliance", "distal", "distal_pressure")))


def read_scene(path: Path, entries: Mapping[str, Any]) -> Scene:
    """Reads the openings of a case. What the drivers check is left to them. Raises InputError."""
    if "network" in entries:
        problem = "what is tuned are the Windkessels of [[opening]], not a network"
        remedy = "write the outlets as Windkessels, tune them, and take their values over"
        raise InputError(path, "network", problem, remedy)
    listed = entries.get("opening", [])
    sections = [one for one in (listed if isinstance(listed, list) else []) if isinstance(one, dict)]
    openings = {str(one.get("surface")): one for one in sections}
    if "static" in entries or not isinstance(entries.get("time"), dict):
        raise InputError(path, "time", "is missing, and a beat takes some", "give a case with a section [time]")
    scene = Scene(path, entries, openings, _period(path, entries, openings))
    for name in (name for name, one in openings.items() if "windkessel4" in one):
        raise InputError(path, f"opening.{name}.windkessel4", "is not tuned", "take a windkessel there")
    if not scene.windkessels:
        remedy = "give one: windkessel = { proximal = ..., compliance = ..., distal = ... }"
        raise InputError(path, "opening", "none has a Windkessel, so that nothing can be tuned", remedy)
    for name in scene.windkessels:
        _require_numbers(path, name, openings[name][WINDKESSEL])
    for name, section in openings.items():
        if scene.kind(name) == "resistance":
            for key in ("resistance", "distal_pressure"):
                _require_number(path, f"opening.{name}.{key}", section.get(key, 0.0))
    return scene


def _require_numbers(path: Path, name: str, values: Any) -> None:
    given = values if isinstance(values, dict) else {}
    for key in ("proximal", "compliance", "distal"):
        _require_number(path, f"opening.{name}.windkessel.{key}", given.get(key), 0.0)
    for key in ("distal_pressure", "initial_pressure"):
        _require_number(path, f"opening.{name}.windkessel.{key}", given.get(key, 0.0))


def _require_number(path: Path, key: str, value: Any, least: float = -math.inf) -> None:
    if not is_number(value) or not math.isfinite(value) or value < least:
        problem = f"is no number{' from 0 on' if least == 0 else ''}"
        raise InputError(path, key, problem, "give one: the first beat begins from it")


def _period(path: Path, entries: Mapping[str, Any], openings: Mapping[str, Mapping[str, Any]]) -> float:
    own = entries["time"].get("period")
    given = [own, *(one.get("period") for one in openings.values())]
    found = {float(period) for period in given if is_number(period) and 0 < period < math.inf}
    if not found:
        raise InputError(path, "opening", "nothing repeats itself, so that there is no beat", GIVE_PERIOD)
    longest = max(found)
    for period in found:
        if abs(longest / period - round(longest / period)) > 1e-6:
            problem = f"periods of {min(found):g} and {longest:g} ms have no beat in common"
            raise InputError(path, "opening", problem, "give them one period")
    return longest


def checked_targets(scene: Scene, targets: Sequence[Target]) -> list[Target]:
    """The targets, with the remaining share for an outlet without a target. Raises InputError."""
    for target in targets:
        if target.opening not in scene.openings:
            remedy = f"did you mean {nearest(target.opening, scene.openings)}?"
            raise InputError(scene.path, "opening", f"'{target.opening}' is no opening", remedy)
        kind = scene.kind(target.opening)
        if target.is_pressure and kind in ("pressure", ""):
            problem = f"'{target.opening}' has its pressure from the case, not from the Windkessels"
            raise InputError("", "--pressure", problem, "name an opening with a Windkessel or a given flow")
        if target.kind in (SPLIT, FLOW) and kind != WINDKESSEL:
            problem = f"'{target.opening}' has no Windkessel, so that its flow cannot be tuned"
            option = "--split" if target.kind == SPLIT else "--flow"
            raise InputError("", option, problem, f"those with one: {', '.join(scene.windkessels)}")
        if target.kind in (SYSTOLIC, MEAN):
            _require_above_distal(scene, target)
    driven = any(scene.kind(name) == "pressure" for name in scene.openings) or "inlet" in scene.entries
    if not driven and not any(target.is_pressure for target in targets):
        raise no_pressure()  # flows that the case gives leave the level of the pressure open
    return _with_rest(scene, list(targets))


def _require_above_distal(scene: Scene, target: Target) -> None:
    for name in scene.windkessels:
        behind = scene.law(name).distal_pressure
        if not target.value > behind:
            what = f"the {target.kind} of {target.value:g} kPa"
            problem = f"{what} is not above the distal_pressure of {name}, {behind:g} kPa"
            raise InputError("", "--pressure", problem, "give a higher one")


def _with_rest(scene: Scene, targets: list[Target]) -> list[Target]:
    named: dict[str, Target] = {t.opening: t for t in targets if t.kind in (SPLIT, FLOW)}
    missing = [name for name in scene.windkessels if name not in named]
    if not named:
        return targets
    kind = next(iter(named.values())).kind
    others = any(scene.kind(n) in ("resistance", "") for n in scene.openings)  # that flow leaves by, too
    total = sum(t.value for t in named.values())
    if kind == SPLIT and total > 1 + SPLITS_MISS:
        raise InputError("", "--split", f"the shares are {100 * total:g} % together", "give 100 %")
    if len(missing) > 1 or (missing and (kind == FLOW or others)):
        option, names = "--split" if kind == SPLIT else "--flow", ", ".join(missing)
        raise InputError("", option, f"is missing for {names}", "name all outlets with a Windkessel, or none")
    if missing:
        if not total < 1:
            problem = f"the shares are {100 * total:g} % together, which leaves nothing for {missing[0]}"
            raise InputError("", "--split", problem, "leave some of the flow for it")
        return [*targets, Target(missing[0], SPLIT, 1 - total)]
    if kind == SPLIT and not others:
        if total < 1 - SPLITS_MISS:
            raise InputError("", "--split", f"the shares are {100 * total:g} % together", "give 100 %")
        return [replace(t, value=t.value / total) if t.kind == SPLIT else t for t in targets]
    return targets
