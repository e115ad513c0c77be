"""All runs of a study with how they ended and what they took."""

from typing import Sequence

from ...base.progress import duration
from ...reporting.layout import Table, fixed
from ...runs.work_units import shown
from ..running.study_file import show
from ..running.study_run import StudyRun


def runs_table(runs: Sequence[StudyRun], stem: str = "runs", title: str = "All runs") -> Table:
    table = Table(
        stem=stem,
        title=title,
        left=5,
        columns=[
            ("", "group"),
            ("", "case"),
            ("", "method"),
            ("", "values"),
            ("", "outcome"),
            ("", "steps"),
            ("", "iterations per step"),
            ("", "work units per step"),
            ("", "time"),
        ],
        csv_columns=[
            "group",
            "case",
            "method",
            "values",
            "status",
            "message",
            "steps",
            "iterations_per_step",
            "wall_s",
            "process_s",
            "folder",
            "command",
            "work_units_per_step",
        ],
    )
    for run in runs:
        r = run.request
        values = "; ".join(f"{name} = {show(value)}" for name, value in r.values.items())
        passes = run.passes if run.passes == run.passes else None
        outcome = run.status if run.done else f"{run.status}: {run.message}"
        table.rows.append(
            [
                r.group,
                r.case,
                r.method.label,
                values,
                outcome,
                str(run.steps),
                fixed(passes, ".2f"),
                shown(run.work_units_per_step),
                duration(run.seconds),
            ]
        )
        wall = run.wall_s if run.wall_s == run.wall_s else None
        table.csv_rows.append(
            [
                r.group,
                r.case,
                r.method.name,
                values,
                run.status,
                run.message,
                run.steps,
                passes,
                wall,
                run.seconds,
                run.folder.name,
                run.command,
                run.work_units_per_step,
            ]
        )
    return table
