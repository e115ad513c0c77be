"""[report] of a stability study."""

from dataclasses import dataclass
from typing import Any, List, Mapping, Optional, Sequence

from ...base.errors import InputError
from ...base.suggestions import check_keys, nearest
from ..evidence.cross_check import BOUND
from ..running.study_file import Study
from ..running.study_run import StudyRun
from .limit_load import Wall, read_wall

REPORT_KEYS = ("scope", "bound", "references", "one_pass", "quantities", "tube", "static", "pulse")
QUANTITY_KEYS = ("label", "paper")


@dataclass(frozen=True)
class Settings:
    scope: str  # in words: what was run, and so what the map holds for
    bound: float
    references: Sequence[str]
    one_pass: Sequence[str]
    quantities: Mapping[str, Mapping[str, Any]]  # label and the paper's value, by quantity
    wall: Optional[Wall]  # of [report.tube]
    static: str  # group of a wall alone under a static pressure, or its name before a hyphen; empty: none
    pulse: str  # quantity that is the pulse's length; empty: none

    def label(self, name: str) -> str:
        """Of a quantity, with its unit; its key where it has no label."""
        return str(self.quantities.get(name, {}).get("label", name))

    def at_rest(self, run: StudyRun) -> bool:
        return bool(self.static) and (run.request.group + "-").startswith(self.static + "-")

    def is_variant_at_rest(self, run: StudyRun) -> bool:
        """On another mesh or in other load steps."""
        return self.at_rest(run) and run.request.group != self.static


def settings_of(study: Study) -> Settings:
    def wrong(key: str, problem: str, remedy: str) -> InputError:
        return InputError(study.path, key, problem, remedy)

    def method_names(name: str, default: Sequence[str]) -> List[str]:
        given = study.report.get(name, default)
        if not isinstance(given, list):
            raise wrong(f"report.{name}", "is not a list", "name methods of the study")
        for entry in given:
            if entry not in study.methods:
                raise wrong(
                    f"report.{name}",
                    f"'{entry}' is no method of the study",
                    f"did you mean '{nearest(str(entry), list(study.methods))}'?",
                )
        return given

    check_keys(study.path, "report", study.report, REPORT_KEYS)
    bound = study.report.get("bound", BOUND)
    if isinstance(bound, bool) or not isinstance(bound, (int, float)) or not bound > 0:
        raise wrong("report.bound", f"{bound} is not a positive number", f"leave it out for {BOUND:g}")
    for request in study.requests:
        if len(request.values) != 1:
            raise wrong(
                f"runs.{request.group}.vary", f"varies {len(request.values)} quantities", "vary one in each group"
            )
    varied = list(dict.fromkeys(next(iter(request.values)) for request in study.requests))
    named = study.report.get("quantities", {})
    for name, entry in named.items():
        if not isinstance(entry, dict) or any(key not in QUANTITY_KEYS for key in entry):
            raise wrong(
                f"report.quantities.{name}", "is no section of " + " and ".join(QUANTITY_KEYS), "see the ready study"
            )
        if name not in varied and not study.quick:
            raise wrong(f"report.quantities.{name}", "is varied nowhere", f"did you mean '{nearest(name, varied)}'?")
    references = method_names("references", [m.name for m in study.methods.values() if m.program == "fsi-monolithic"])
    if len({study.methods[name].program for name in references}) != 1:
        raise wrong("report.references", "are not methods of one driver", "name those of fsi-monolithic")
    return Settings(
        str(study.report.get("scope", "")),
        float(bound),
        references,
        method_names("one_pass", []),
        named,
        read_wall(study.report["tube"], wrong) if "tube" in study.report else None,
        str(study.report.get("static", "")),
        str(study.report.get("pulse", "")),
    )
