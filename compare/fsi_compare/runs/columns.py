"""A CSV file of numbers with one line of column names."""

import math
from pathlib import Path
from typing import Dict, Mapping, Sequence

import numpy as np

from ..base.errors import InputError
from ..base.files import read_text
from .summary import FINISHED


ITERATIONS = "iterations.csv"
LARGEST = 1e100  # whose square, and sums of them, are still numbers


class Columns(Dict[str, np.ndarray]):
    """Of a file: to ask for one that it lacks is the file's fault, not the program's."""

    def __init__(self, path: Path, columns: Mapping[str, np.ndarray]) -> None:
        super().__init__(columns)
        self._path = path

    def __missing__(self, name: str) -> np.ndarray:
        raise InputError(self._path, "line 1", f"column '{name}' is missing", "run it again with this version")


def number(field: str) -> float:
    """Raises ValueError; Python's own underscores between digits are no number in a file."""
    if "_" in field:
        raise ValueError(field)
    return float(field)


def read_columns(path: Path, needed: Sequence[str] = ()) -> Columns:
    """Column name -> values; an empty field is NaN. Those `needed` must be there, with a finite number in each line and
    at least one line. Raises InputError naming line and column."""
    text = read_text(path, FINISHED, "run it again")
    lines = text.splitlines()
    if not lines:
        raise InputError(path, "", "is empty", "run it again")
    if not text.endswith("\n"):
        raise InputError(
            path, f"line {len(lines)}", "is cut off", "the run was interrupted while writing; run it again"
        )
    names = [name.strip() for name in lines[0].split(",")]
    for name in names:
        if names.count(name) > 1:
            raise InputError(path, "line 1", f"column '{name}' is there twice", "run it again")
    for name in needed:
        if name not in names:
            raise InputError(path, "line 1", f"column '{name}' is missing", "run it again with this version")
    if needed and len(lines) == 1:
        raise InputError(path, "", "holds no time step", "the run wrote no time step; run it again")
    values = np.full((len(lines) - 1, len(names)), np.nan)
    for row, line in enumerate(lines[1:]):
        fields = line.split(",")
        if len(fields) != len(names):
            raise InputError(
                path, f"line {row + 2}", f"has {len(fields)} values instead of {len(names)}", "run it again"
            )
        for column, (name, field) in enumerate(zip(names, fields)):
            if field.strip():
                try:
                    values[row, column] = number(field)
                except ValueError:
                    raise InputError(
                        path, f"line {row + 2}", f"{name} '{field}' is not a number", "run it again"
                    ) from None
            if name in needed and not math.isfinite(values[row, column]):
                raise InputError(path, f"line {row + 2}", f"{name} is {field.strip() or 'empty'}", "run it again")
            if abs(values[row, column]) > LARGEST:
                raise InputError(path, f"line {row + 2}", f"{name} {field} is too large", "run it again")
    return Columns(path, {name: values[:, column] for column, name in enumerate(names)})


def read_iterations(folder: Path, needed: Sequence[str]) -> Columns:
    """`iterations.csv`, a line for each time step. Raises InputError."""
    path = folder / ITERATIONS
    columns = read_columns(path, needed)
    for name in needed:
        if np.any(columns[name] < 0):
            line = int(np.flatnonzero(columns[name] < 0)[0]) + 2
            raise InputError(path, f"line {line}", f"{name} is negative", "run it again")
    for name in ("step", "time_ms"):
        if name in columns and np.any(np.diff(columns[name]) <= 0):
            line = int(np.flatnonzero(np.diff(columns[name]) <= 0)[0]) + 3
            raise InputError(path, f"line {line}", f"{name} does not increase", "run it again")
    return columns
