"""[report] of a stability study."""

from dataclasses import dataclass
from typing import Any, Mapping, Optional, Sequence

from fsi_compare.base.errors import InputError
from fsi_compare.base.suggestions import nearest
from ..evidence.cross_check import BOUND
from fsi_compare.study.section import Section
from fsi_compare.study.study_file import Study
from ..catalogue.report_section import report_of
from fsi_compare.study.study_run import StudyRun
from .limit_load import TUBE_KEYS, Wall, read_wall

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
        """A quantity's label, with its unit; its key where it has none."""
        return str(self.quantities.get(name, {}).get("label", name))

    def at_rest(self, run: StudyRun) -> bool:
        return bool(self.static) and (run.request.group + "-").startswith(self.static + "-")

    def is_variant_at_rest(self, run: StudyRun) -> bool:
        """On another mesh or in other load steps."""
        return self.at_rest(run) and run.request.group != self.static


def settings_of(study: Study) -> Settings:
    report = report_of(study, REPORT_KEYS)
    for request in study.requests:
        if len(request.values) != 1:
            problem = f"varies {len(request.values)} quantities"
            raise InputError(study.path, f"runs.{request.group}.vary", problem, "vary one in each group")
    varied = list(dict.fromkeys(next(iter(request.values)) for request in study.requests))
    named = report.table("quantities")
    for name in named:
        entry = Section(study.path, f"report.quantities.{name}", named[name], QUANTITY_KEYS)
        entry.text("label", name)
        if not isinstance(entry.entries.get("paper", 0), (int, float, str)):
            raise entry.wrong("paper", "is no value", "give the paper's value of the quantity")
        if name not in varied and not study.quick:
            raise report.wrong(f"quantities.{name}", "is varied nowhere", f"did you mean '{nearest(name, varied)}'?")
    monolithic = [m.name for m in study.methods.values() if m.program == "fsi-monolithic"]
    references = report.names("references", list(study.methods), monolithic, "method of the study")
    if len({study.methods[name].program for name in references}) != 1:
        raise report.wrong("references", "are not methods of one driver", "name those of fsi-monolithic")
    return Settings(
        report.text("scope", ""),
        report.number("bound", BOUND),
        references,
        report.names("one_pass", list(study.methods), [], "method of the study"),
        named,
        read_wall(report.section("tube", TUBE_KEYS)) if "tube" in report else None,
        report.text("static", ""),
        report.text("pulse", ""),
    )
