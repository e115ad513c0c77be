"""The plain kind: a table of all runs with how they ended and what they took; in a browser, the runs through time."""

from ..reporting.player import Player
from ..reporting.run_player import panels
from ..results.run import RunResults
from .runs_table import runs_table
from .context import Context
from .study_file import Study

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
    some = f"The first {MOST_RUNS} of {len(done)} runs. " if len(done) > MOST_RUNS else ""
    context.report.text(f"{some}Needs JavaScript; `fsi-compare report` makes pictures for print of any runs.")
    context.report.player(Player([run.request.label for run, _ in shown], panels([results for _, results in shown])))
