"""The section [report] of an accuracy-cost study."""

from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Mapping, Tuple

from fsi_compare.base.errors import InputError
from fsi_compare.base.files import absolute
from fsi_compare.base.suggestions import nearest
from fsi_compare.runs.reference import WaveReference, read_reference
from fsi_compare.runs.waves import WINDOW
from fsi_compare.study.section import is_positive
from fsi_compare.study.study_file import Study
from ..catalogue.report_section import report_of

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
    report = report_of(study, KEYS)
    wrong = report.wrong

    def method(key: str) -> str:
        return report.one_of(key, list(study.methods), "method of the study")

    window = report.numbers("times", [1.5, 9.0])
    if len(window) != 2 or window[0] >= window[1]:
        raise wrong("times", "is not an interval", "write [first, last] in ms")
    family = report.names("family", list(study.meshes), ["coarse", "intermediate", "fine"], "mesh of the study")
    targets = sorted((t / 100 for t in report.numbers("targets", [10, 3, 1])), reverse=True)
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
    return {case: read_reference(absolute(study.path.parent / folder)) for case, folder in folders.items()}


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
                "references",
                f"has none for the case '{request.case}'",
                "make it with scripts/evidence/reference_waves.py",
            )
        step: Any = request.settings.get("time.step")
        end: Any = request.settings.get("time.end")
        if not is_positive(step) or not is_positive(end):
            remedy = "give both in [set] or in the group: errors depend on them"
            raise InputError(study.path, f"runs.{request.group}", "does not say time.step and time.end", remedy)
        if end < high + 0.5 * WINDOW - 1e-6:
            problem = f"ends at {end:g} ms, before report.times and half of the {WINDOW:g} ms of a mean"
            remedy = f"run to {high + 0.5 * WINDOW:g} ms or longer, or shorten report.times"
            raise InputError(study.path, f"runs.{request.group}", problem, remedy)
