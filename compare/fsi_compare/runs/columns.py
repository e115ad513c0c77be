"""CSV files with one line of column names: the reader of all tables of a run."""

import math
from pathlib import Path
from typing import Mapping, Sequence

import numpy as np

from ..base.errors import InputError
from ..base.files import read_text
from .summary import FINISHED

ITERATIONS = "iterations.csv"
LARGEST = 1e100  # whose square, and sums of them, are still numbers
AGAIN = "run it again"
INTERRUPTED = "the run was interrupted while writing; run it again"
WENT_WRONG = "the run went wrong before this time; look at its run.log"


class Columns(dict[str, np.ndarray]):
    """Columns of a file. Asking for another one is an InputError about the file, not a KeyError of the program."""

    def __init__(self, path: Path, columns: Mapping[str, np.ndarray]) -> None:
        super().__init__(columns)
        self._path = path

    def __missing__(self, name: str) -> np.ndarray:
        raise InputError(self._path, "line 1", f"column '{name}' is missing", "run it again with this version")


def number(field: str) -> float:
    """Raises ValueError, also for Python's underscores between digits."""
    if "_" in field:
        raise ValueError(field)
    return float(field)


def read_fields(path: Path, finished: bool = True) -> dict[str, list[str]]:
    """The fields of each column by its name. `finished`: of a run that has ended, so that a last line without end is a
    mistake; else it is left out. Raises InputError."""
    text = read_text(path, FINISHED, AGAIN)
    if text and not text.endswith("\n"):
        if finished:
            raise InputError(path, f"line {len(text.splitlines())}", "is cut off", INTERRUPTED)
        text = text[: text.rfind("\n") + 1]
    lines = text.splitlines()
    if not lines:
        raise InputError(path, "", "is empty", "the run wrote no time step; run it again")
    names = [name.strip() for name in lines[0].split(",")]
    for name in names:
        if not name or names.count(name) > 1:
            problem = f"column '{name}' is there twice" if name else "a column has no name"
            raise InputError(path, "line 1", problem, AGAIN)
    for number_of_line, line in enumerate(lines[1:], 2):
        if line.count(",") != len(names) - 1:
            problem = f"has {line.count(',') + 1} values instead of {len(names)}"
            raise InputError(path, f"line {number_of_line}", problem, INTERRUPTED)
    fields = [field.strip() for field in ",".join(lines[1:]).split(",")] if len(lines) > 1 else []
    return {name: fields[place :: len(names)] for place, name in enumerate(names)}


def numbers(path: Path, name: str, fields: Sequence[str], gaps: bool = True, nan: bool = True) -> np.ndarray:
    """Numbers of a column; an empty field is NaN. `gaps`: there may be some; `nan`: a field may say so. Raises
    InputError naming the line."""
    try:
        found = np.array([float(field) for field in fields])
        if np.all(np.abs(found) <= LARGEST) and "_" not in "".join(fields):
            return found
    except ValueError:
        pass
    values = []
    for row, field in enumerate(fields):
        try:
            values.append(number(field) if field else math.nan)
        except ValueError:
            raise InputError(path, f"line {row + 2}", f"{name} '{field}' is not a number", AGAIN) from None
        if abs(values[-1]) <= LARGEST or (gaps and not field) or (nan and field and math.isnan(values[-1])):
            continue
        if math.isfinite(values[-1]):
            raise InputError(path, f"line {row + 2}", f"{name} {field} is too large", AGAIN)
        raise InputError(path, f"line {row + 2}", f"{name} is {field or 'empty'}", WENT_WRONG)
    return np.array(values, dtype=float)


def read_columns(path: Path, needed: Sequence[str] = ()) -> Columns:
    """Column name -> values; an empty field is NaN. Those `needed` must be there, with a finite number in each line and
    at least one line. Raises InputError naming line and column."""
    fields = read_fields(path)
    for name in needed:
        if name not in fields:
            raise InputError(path, "line 1", f"column '{name}' is missing", "run it again with this version")
        if not fields[name]:
            raise InputError(path, "", "holds no time step", "the run wrote no time step; run it again")
    found = {name: numbers(path, name, of, name not in needed, name not in needed) for name, of in fields.items()}
    return Columns(path, found)


def read_iterations(folder: Path, needed: Sequence[str]) -> Columns:
    """`iterations.csv`, a line for each time step. Raises InputError."""
    path = folder / ITERATIONS
    columns = read_columns(path, needed)
    wrong = [(columns[name] < 0, 2, f"{name} is negative") for name in needed]
    rising = [name for name in ("step", "time_ms") if name in columns]
    wrong += [(np.diff(columns[name]) <= 0, 3, f"{name} does not increase") for name in rising]
    for rows, first_line, problem in wrong:
        if rows.any():
            raise InputError(path, f"line {int(np.argmax(rows)) + first_line}", problem, AGAIN)
    return columns
