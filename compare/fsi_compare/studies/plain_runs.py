"""The plain kind: a table of all runs with how they ended and what they took, and the runs through time."""

from ..reporting.run_player import add_waves
from ..results.run import RunResults
from .evidence.runs_table import runs_table
from .running.context import Context
from .running.study_file import Study

MOST_RUNS = 12  # that are told apart in one diagram


def check(study: Study) -> None:
    """Any runs will do."""


def evaluate(context: Context) -> None:
    context.report.section("Runs")
    context.report.table(runs_table(context.runs))
    done = [run for run in context.runs if run.done]
    shown = [(run, RunResults(run.folder, run.summary)) for run in done[:MOST_RUNS]]
    shown = [(run, results) for run, results in shown if results.has_samples]
    if not shown:
        return
    context.report.section("Through time")
    if len(done) > MOST_RUNS:
        context.report.text(f"The first {MOST_RUNS} of {len(done)} runs; `fsi-compare report` shows others.")
    add_waves(context.report, [results for _, results in shown], [run.request.label for run, _ in shown])
