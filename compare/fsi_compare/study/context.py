"""What a kind of study is given: the finished runs, a way to make more, and the report to fill."""

from dataclasses import dataclass
from typing import Any, Sequence

from ..reporting.report import Report
from .runner import Runner
from .study_file import Request, Study
from .study_run import StudyRun


@dataclass
class Context:
    study: Study
    runs: Sequence[StudyRun]  # of study.requests, in their order
    runner: Runner
    report: Report

    def run(self, requests: Sequence[Request]) -> list[StudyRun]:
        """More runs, for kinds that decide on the next one from the last."""
        return self.runner.run(requests)

    def select(self, group: str = "", case: str = "", method: str = "", **values: Any) -> list[StudyRun]:
        """Runs by their place in the study; a value's name is given with _ for each dot."""

        def fits(run: StudyRun) -> bool:
            r = run.request
            own = {name.replace(".", "_"): value for name, value in r.values.items()}
            return (
                (not group or r.group == group)
                and (not case or r.case == case)
                and (not method or r.method.name == method)
                and all(own.get(name) == value for name, value in values.items())
            )

        return [run for run in self.runs if fits(run)]
