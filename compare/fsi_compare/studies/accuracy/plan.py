"""The section [report] of an accuracy-cost study."""

from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Mapping, Tuple

from ...base.errors import InputError
from ...base.suggestions import check_keys, nearest
from ..evidence.reference import WaveReference, read_reference
from ..evidence.waves import WINDOW
from ..running.study_file import Study

Wrong = Callable[[str, str, str], InputError]  # of key, problem and remedy

KEYS = ("references", "times", "targets", "method", "tight", "family")


@dataclass(frozen=True)
class Plan:
    references: Mapping[str, WaveReference]  # by case
    window: Tuple[float, float]  # ms, where waves are compared
    targets: List[float]  # relative errors, the largest first
    method: str  # whose runs show the discretisation's error: converged far below it
    tight: str  # whose runs solve each step as exactly as can be
    family: List[str]  # meshes refined alike in all directions, from coarse to fine

    def times(self, case: str) -> List[float]:
        """The reference's levels in the window, ms."""
        low, high = self.window
        return [float(t) for t in self.references[case].waves["pressure_Pa"].times if low - 1e-6 <= t <= high + 1e-6]


def read_plan(study: Study) -> Plan:
    """Raises InputError naming the key."""
    report = study.report

    def wrong(key: str, problem: str, remedy: str) -> InputError:
        return InputError(study.path, f"report.{key}", problem, remedy)

    check_keys(study.path, "report", report, KEYS)

    def numbers(key: str, default: List[float]) -> List[float]:
        values: Any = report.get(key, default)
        if (
            not isinstance(values, list)
            or not values
            or not all(isinstance(v, (int, float)) and not isinstance(v, bool) and v > 0 for v in values)
        ):
            raise wrong(key, "is not a list of positive numbers", f"write {default}")
        return [float(v) for v in values]

    def method(key: str) -> str:
        name = report.get(key)
        if not isinstance(name, str) or name not in study.methods:
            raise wrong(
                key,
                "is missing" if name is None else f"'{name}' is no method of this study",
                f"give one of {', '.join(study.methods)}",
            )
        return name

    window = numbers("times", [1.5, 9.0])
    if len(window) != 2 or window[0] >= window[1]:
        raise wrong("times", "is not an interval", "write [first, last] in ms")
    family = report.get("family", ["coarse", "intermediate", "fine"])
    if not isinstance(family, list) or any(name not in study.meshes for name in family):
        raise wrong("family", "names a mesh that the study does not have", f"choose from {', '.join(study.meshes)}")
    targets = sorted((t / 100 for t in numbers("targets", [10, 3, 1])), reverse=True)
    plan = Plan(
        _references(study, wrong), (window[0], window[1]), targets, method("method"), method("tight"), list(family)
    )
    _check_runs(study, plan, wrong)
    return plan


def _references(study: Study, wrong: Wrong) -> Dict[str, WaveReference]:
    folders = study.report.get("references")
    if not isinstance(folders, dict) or not folders:
        raise wrong(
            "references", "is missing", "write a section with a reference's folder per case, relative to the study"
        )
    for case, folder in folders.items():
        if case not in study.cases:
            raise wrong(
                f"references.{case}", "is no case of this study", f"did you mean '{nearest(case, list(study.cases))}'?"
            )
        if not isinstance(folder, str):
            raise wrong(f"references.{case}", "is not a folder's name", "give it relative to the study")
    return {case: read_reference((study.path.parent / folder).resolve()) for case, folder in folders.items()}


def _check_runs(study: Study, plan: Plan, wrong: Wrong) -> None:
    low, high = plan.window
    for case, reference in plan.references.items():
        for waves in reference.waves.values():
            if not (waves.covers(low) and waves.covers(high)):
                raise wrong(
                    "times",
                    f"{low:g} to {high:g} ms is not covered by the reference of '{case}', "
                    f"{waves.times[0]:g} to {waves.times[-1]:g} ms",
                    "shorten it",
                )
    for request in study.requests:
        if request.case not in plan.references:
            raise wrong(
                "references", f"has none for the case '{request.case}'", "make it with scripts/reference_waves.py"
            )
        step, end = request.settings.get("time.step"), request.settings.get("time.end")
        if not isinstance(step, (int, float)) or not isinstance(end, (int, float)):
            raise InputError(
                study.path,
                f"runs.{request.group}",
                "does not say time.step and time.end",
                "give both in [set] or in the group: errors depend on them",
            )
        if end < high + 0.5 * WINDOW - 1e-6:
            raise InputError(
                study.path,
                f"runs.{request.group}",
                f"ends at {end:g} ms, before report.times and half of the {WINDOW:g} ms of a mean",
                f"run to {high + 0.5 * WINDOW:g} ms or longer, or shorten report.times",
            )
