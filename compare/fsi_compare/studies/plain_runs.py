"""The plain kind: a table of all runs with how they ended and what they took."""

from .evidence.runs_table import runs_table
from .running.context import Context
from .running.study_file import Study


def check(study: Study) -> None:
    """Any runs will do."""


def evaluate(context: Context) -> None:
    context.report.section("Runs")
    context.report.table(runs_table(context.runs))
