"""The settings of a study's report."""

from typing import Any, List, Optional, Sequence

from fsi_compare.base.suggestions import nearest
from fsi_compare.study.section import Section, is_positive
from fsi_compare.study.study_file import Study


def report_of(study: Study, known: Sequence[str]) -> "ReportSection":
    return ReportSection(study.path, "report", study.report, known)


class ReportSection(Section):
    """A section of [report], or [report] itself. All raise InputError naming file and key."""

    def __contains__(self, name: str) -> bool:
        return name in self.entries

    def section(self, name: str, known: Sequence[str]) -> "ReportSection":
        """The section of this name, empty where it is missing."""
        return ReportSection(self.path, self.key_of(name), self.entries.get(name, {}), known)

    def numbers(self, name: str, default: Optional[Sequence[float]] = None) -> List[float]:
        values = self.entries.get(name, default and list(default))
        if not isinstance(values, list) or not values or not all(map(is_positive, values)):
            problem = "is missing" if values is None else "is not a list of positive numbers"
            raise self.wrong(name, problem, "write [a, b, ...]" if default is None else f"write {list(default)}")
        return [float(value) for value in values]

    def one_of(self, name: str, known: Sequence[str], what: str) -> str:
        value = self.entries.get(name)
        self._require_known(name, value, known, what)
        return str(value)

    def names(self, name: str, known: Sequence[str], default: Sequence[str], what: str) -> List[str]:
        """`what` they are, e.g. "method of the study"."""
        values = self.entries.get(name, list(default))
        if not isinstance(values, list):
            raise self.wrong(name, "is not a list", f"write [a, b, ...], each a {what}")
        for value in values:
            self._require_known(name, value, known, what)
        return values

    def _require_known(self, name: str, value: Any, known: Sequence[str], what: str) -> None:
        if not isinstance(value, str) or value not in known:
            problem = "is missing" if value is None else f"'{value}' is no {what}"
            raise self.wrong(name, problem, f"did you mean '{nearest(str(value), list(known))}'?")
