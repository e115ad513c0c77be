"""A CSV file of numbers with one line of column names."""

from pathlib import Path
from typing import Dict

import numpy as np

from .errors import InputError


def read_columns(path: Path) -> Dict[str, np.ndarray]:
    """Column name -> values; an empty field is NaN. Raises InputError naming the line when the file is missing, cut off
    or not of numbers."""
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(path, "", f"cannot be read: {error.strerror}", "give the result folder of a finished run") from None
    lines = text.splitlines()
    if not lines:
        raise InputError(path, "", "is empty", "run it again")
    if not text.endswith("\n"):
        raise InputError(path, f"line {len(lines)}", "is cut off", "the run was interrupted while writing; run it again")
    names = [name.strip() for name in lines[0].split(",")]
    values = np.full((len(lines) - 1, len(names)), np.nan)
    for row, line in enumerate(lines[1:]):
        fields = line.split(",")
        if len(fields) != len(names):
            raise InputError(path, f"line {row + 2}", f"has {len(fields)} values instead of {len(names)}", "run it again")
        for column, field in enumerate(fields):
            if field.strip():
                try:
                    values[row, column] = float(field)
                except ValueError:
                    raise InputError(path, f"line {row + 2}", f"{names[column]} '{field}' is not a number",
                                     "run it again") from None
    return {name: values[:, column] for column, name in enumerate(names)}
