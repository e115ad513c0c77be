"""Names of runs in tables and pictures: those that the user gives, or the shortest that tell the runs apart."""

from pathlib import Path
from typing import Iterable, Sequence

from ..base.errors import InputError, printable
from ..base.files import absolute
from .coupling import coupling_words
from .run_folder import Run


def read_labels(text: str | None, runs: int) -> list[str] | None:
    if text is None:
        return None
    labels = [printable(label.strip()) for label in text.split(",")]
    remedy = "give one per run, separated by commas"
    if len(labels) != runs:
        raise InputError("", "--labels", f"{len(labels)} labels for {runs} runs", remedy)
    for label in labels:
        if not label:
            raise InputError("", "--labels", "a label is empty", remedy)
        if labels.count(label) > 1:
            raise InputError("", "--labels", f"'{label}' is given twice", "give each run its own")
    return labels


def title_of(asked: str | None, titles: Iterable[str], otherwise: str) -> str:
    """The heading that is asked for, else the runs' own where they have one title, else another."""
    own = set(titles)
    return printable(asked) if asked is not None else own.pop() if len(own) == 1 and "" not in own else otherwise


def default_labels(runs: Sequence[Run]) -> list:
    """Names that tell the runs apart, as short as possible: the program with its coupling, then its case or folder
    beside it."""
    programs = [coupling_words(run.program, run.summary) for run in runs]
    places = [printable(str(run.folder)) for run in runs]
    choices = (
        programs,
        [f"{p}, {run.title}" if run.title else p for p, run in zip(programs, runs)],
        [f"{p}, {printable(absolute(run.folder).name)}" for p, run in zip(programs, runs)],
        [f"{p}, {place}" for p, place in zip(programs, places)],
    )
    for labels in choices:
        if len(set(labels)) == len(runs):
            return labels
    return [f"{label} ({i})" for i, label in enumerate(choices[-1], 1)]


def folder_labels(folders: Sequence[Path]) -> list[str]:
    """The folders' names, or their paths where two names are the same."""
    names = [printable(absolute(folder).name) for folder in folders]
    return [name if names.count(name) == 1 else printable(str(folder)) for name, folder in zip(names, folders)]
