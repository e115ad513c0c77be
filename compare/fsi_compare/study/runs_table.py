"""All runs of a study with how they ended and what they took."""

from typing import Sequence

from ..starting.duration import duration
from ..reporting.column import Column, work_column
from ..reporting.layout import Table
from .study_file import show
from .study_run import StudyRun, known

RUNS: Sequence[Column[StudyRun]] = (
    Column("group", "group", lambda run: run.request.group, left=True),
    Column("case", "case", lambda run: run.request.case, left=True),
    Column("method", "method", lambda run: run.request.method.name, text=lambda run: run.method_label, left=True),
    Column("values", "values", lambda run: values_of(run), left=True),
    Column("outcome", "status", lambda run: run.status, text=lambda run: run.end_words, left=True),
    Column(csv="message", value=lambda run: run.message),
    Column("steps", "steps", lambda run: run.steps),
    Column("iterations per step", "iterations_per_step", lambda run: known(run.passes), ".2f"),
    work_column("work units per step", "work_units_per_step", lambda run: run.work_units_per_step),
    Column(csv="wall", unit="s", value=lambda run: known(run.wall_s)),
    Column("time", "process", lambda run: run.seconds, duration, "s"),
    Column(csv="folder", value=lambda run: run.folder.name),
    Column(csv="command", value=lambda run: run.command),
)


def values_of(run: StudyRun) -> str:
    return "; ".join(f"{name} = {show(value)}" for name, value in run.request.values.items())


def runs_table(runs: Sequence[StudyRun], stem: str = "runs", title: str = "All runs") -> Table:
    return Table(stem, title, RUNS, runs)
