"""The settings of a study's report."""

from typing import Sequence

from fsi_compare.study.section import Section
from fsi_compare.study.study_file import Study


def report_of(study: Study, known: Sequence[str]) -> Section:
    return Section(study.path, "report", study.report, known)
