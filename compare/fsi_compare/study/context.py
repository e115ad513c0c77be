"""What a kind of study is given: the finished runs, a way to make more, and the report to fill."""

from dataclasses import dataclass
from typing import Sequence

from ..reporting.report import Report
from .runner import Runner
from .study_file import Study
from .study_run import StudyRun


@dataclass
class Context:
    study: Study
    runs: Sequence[StudyRun]  # of study.requests, in their order
    runner: Runner
    report: Report
