"""The members of a family: which runs are made around the user's own, and what the case says that decides it."""

import copy
import math
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Mapping, Sequence

from ..base.case_names import with_present_names
from ..base.errors import InputError
from ..base.files import read_toml
from ..base.numbers import is_number
from ..study.study_file import Request, Study, StudyMesh, method_of, study_of_case
from .flow_tables import flow_interval
from .mesh_family import Recipe
from .quantities import Asked
from .tolerances import governing, names_scheme
from .verdict import LOOSER

STEP_RATIO = 2.0
ORDERS = {"euler": 1.0}  # of time schemes; all others are of second order
# Of quantities by element: what is solved for, and pressures with all that is made of gradients.
SPACE_ORDERS = {"p1": (2.0, 1.0), "p2p1": (3.0, 2.0)}
OTHER_ELEMENT = {"p1": "p2p1", "p2p1": "p1"}
INDICATOR = "output.error_indicator"
GIVE = "give a case file that a driver runs"


@dataclass(frozen=True)
class CaseFacts:
    """What in a case file decides its family."""

    path: Path
    entries: Mapping[str, Any]
    element: str
    static: bool
    adaptive: bool
    step: float  # ms, or the tolerance of adaptive steps
    end: float  # ms
    scheme: str
    period: float | None  # ms
    flow_interval: float | None = None  # ms, between the points of the given flow's table

    @property
    def time_order(self) -> float:
        """Order of the error in the size of steps. Adaptive ones are counted by the root of their tolerance."""
        return ORDERS.get(self.scheme, 2.0)

    def space_order(self, is_pressure: bool) -> float:
        return SPACE_ORDERS[self.element][1 if is_pressure else 0]

    def asked(self, times: Sequence[float]) -> Asked:
        return Asked(tuple(times), self.period, self.static)


@dataclass(frozen=True)
class Member:
    """A run of the family: sizes relative to the user's own, where 1 is that itself and 0.5 is half of it."""

    mesh: float
    step: float
    looser: bool = False
    other: bool = False  # by the other element, on the same mesh

    @property
    def is_own(self) -> bool:
        return self.mesh == 1 and self.step == 1 and not self.looser and not self.other

    @property
    def name(self) -> str:
        if self.is_own:
            return "own"
        parts = [f"mesh {self.mesh:.3g}"] if self.mesh != 1 else []
        parts += [f"step {self.step:.3g}"] if self.step != 1 else []
        return ", ".join(parts + (["looser"] if self.looser else []) + (["other element"] if self.other else []))


def with_settings(entries: Mapping[str, Any], settings: Mapping[str, Any]) -> dict[str, Any]:
    """The entries of a case file with others over them, by their full keys."""
    found = copy.deepcopy(dict(entries))
    for key, value in settings.items():
        *sections, name = key.split(".")
        place = found
        for section in sections:
            inner = place.setdefault(section, {})
            if not isinstance(inner, dict):  # [[opening]]: its keys decide nothing here
                break
            place = inner
        else:
            place[name] = value
    return found


def read_case(path: Path, settings: Mapping[str, Any] = MappingProxyType({})) -> CaseFacts:
    """`settings`: entries over those of the file. Raises InputError; what the drivers check is left to them."""
    entries = with_settings(with_present_names(read_toml(path, GIVE, GIVE)), settings)
    time = entries.get("time", {})
    if not isinstance(time, dict) or not ("time" in entries or "static" in entries):
        raise InputError(path, "time", "is missing", "a case has a section [time] or [static]")
    for name in ("end", "tolerance"):
        if not is_number(time.get(name, 0.0)) or not math.isfinite(time.get(name, 0.0)):
            raise InputError(path, f"time.{name}", f"{time[name]} is no number", "give one")
    element = entries.get("element", "p2p1")
    if not isinstance(element, str) or element not in SPACE_ORDERS:
        raise InputError(path, "element", f"'{element}' is unknown", f"choose {' or '.join(SPACE_ORDERS)}")
    step = time.get("step", 1.0)
    adaptive = step == "adaptive"
    if not adaptive and not (is_number(step) and step > 0):
        raise InputError(path, "time.step", f"{step} is no step", 'give a number of ms, or "adaptive"')
    openings = entries.get("opening", [])
    periods = [one["period"] for one in openings if isinstance(one, dict) and is_number(one.get("period"))]
    return CaseFacts(
        path=path,
        entries=entries,
        element=element,
        static="static" in entries,
        adaptive=adaptive,
        step=float(time.get("tolerance", 0.01)) if adaptive else float(step),
        end=float(time.get("end", 0.0)),
        scheme=str(time.get("scheme", "midpoint")),
        period=float(max(periods)) if periods else None,
        flow_interval=flow_interval(path, openings, entries.get("network")),
    )


def mesh_ratio(recipe: Recipe, levels: int, finer: bool) -> float:
    """Ratio between the meshes of members()."""
    below = -1 if finer else 0
    return recipe.ratio([-k for k in range(below, levels + below)])


def members(recipe: Recipe, facts: CaseFacts, ratio: float, levels: int, finer: bool) -> list[Member]:
    """Members from cheap to dear. `levels` meshes; `finer`: one is finer than the user's own. A mesh file has no
    coarser ones."""
    below = -1 if finer else 0
    powers = range(levels + below - 1, below - 1, -1) if recipe.coarsens else range(0, -levels, -1)
    meshes = [ratio**k if k else 1.0 for k in powers]
    beside = [] if recipe.coarsens or recipe.adapts else [Member(1.0, 1.0, False, True)]
    if facts.static:
        return [Member(m, 1.0) for m in meshes] + [Member(1.0, 1.0, True)] + beside
    steps = [STEP_RATIO, 1.0, 1 / STEP_RATIO] if finer else [STEP_RATIO**2, STEP_RATIO, 1.0]
    found = [Member(m, 1.0) for m in meshes] + [Member(1.0, s) for s in steps if s != 1]
    corner = (min(meshes), min(steps)) if finer else (meshes[-2], steps[1])
    found += [Member(1.0, 1.0, True) if finer else Member(1.0, steps[0], True), Member(*corner), *beside]
    return sorted(dict.fromkeys(found), key=lambda m: (m.mesh**-2.0 / m.step, m.looser))  # by their work, about


class Requests:
    """Requests to the runner, by member and driver."""

    def __init__(
        self,
        facts: CaseFacts,
        recipe: Recipe,
        folder: Path,
        drivers: Sequence[str],
        time_limit: float,
        settings: Mapping[str, Any] = MappingProxyType({}),
        name: str = "",
    ) -> None:
        self.name = name or facts.path.stem
        self.settings = dict(settings)  # of all members, over the case file's
        self.facts, self.recipe, self.folder = facts, recipe, folder
        self.methods = {name: method_of(name) for name in drivers}
        self.time_limit = time_limit
        self.scheme: str | None = None  # which fsi-partitioned took where the case names none, once a run has told

    def study(self, threads: int) -> Study:
        """The study of all runs, for the runner."""
        path = self.facts.path
        return study_of_case(path, "verify", self.name, path, self.methods, threads, self.time_limit)

    def mesh(self, member: Member) -> StudyMesh | None:
        return self.recipe.mesh(1 / member.mesh, self.folder, self.name)

    def of(self, member: Member, driver: str) -> Request:
        method = self.methods.get(driver) or method_of(driver)
        settings = {**self.settings, **self._step(member)}
        if member.looser:
            settings.update(self.tolerances(method.program, LOOSER))
        if member.other:
            settings["element"] = OTHER_ELEMENT[self.facts.element]
        if self.recipe.adapts and member.step == 1 and not (member.looser or member.other):
            settings[INDICATOR] = True  # a finer mesh may be made from it
        case = self.facts.path
        values = {"mesh": f"{member.mesh:.4g}", "step": f"{member.step:.4g}"}
        values |= {"looser": "yes"} if member.looser else {}
        values |= {"element": OTHER_ELEMENT[self.facts.element]} if member.other else {}
        return Request("family", self.name, method, values, case, self.mesh(member), settings, self.time_limit)

    def _step(self, member: Member) -> dict[str, Any]:
        facts = self.facts
        if member.step == 1 or facts.static:
            return {}
        if facts.adaptive:
            return {"time.tolerance": facts.step * member.step**facts.time_order}
        return {"time.step": facts.step * member.step}

    def tolerances(self, program: str, factor: float) -> dict[str, Any]:
        """Tolerances that a driver stops by, changed by a factor. For a case that awaits_scheme() they are a guess."""
        return {key: factor * value for key, value in governing(program, self.facts.entries, self.scheme).items()}

    def awaits_scheme(self, driver: str) -> bool:
        """Whether a run has to tell which tolerances the driver stops by."""
        return driver == "partitioned" and self.scheme is None and not names_scheme(self.facts.entries)
