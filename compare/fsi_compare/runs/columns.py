"""A CSV file of numbers with one line of column names."""

import math
from pathlib import Path
from typing import Dict, Sequence

import numpy as np

from ..base.errors import InputError


def read_columns(path: Path, needed: Sequence[str] = ()) -> Dict[str, np.ndarray]:
    """Column name -> values; an empty field is NaN. Those `needed` must be there, with a finite number in each line and
    at least one line. Raises InputError naming line and column."""
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise InputError(path, "", "is missing", "give the result folder of a finished run") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(path, "", f"cannot be read: {error}", "run it again") from None
    lines = text.splitlines()
    if not lines:
        raise InputError(path, "", "is empty", "run it again")
    if not text.endswith("\n"):
        raise InputError(
            path, f"line {len(lines)}", "is cut off", "the run was interrupted while writing; run it again"
        )
    names = [name.strip() for name in lines[0].split(",")]
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
                    values[row, column] = float(field)
                except ValueError:
                    raise InputError(
                        path, f"line {row + 2}", f"{name} '{field}' is not a number", "run it again"
                    ) from None
            if name in needed and not math.isfinite(values[row, column]):
                raise InputError(path, f"line {row + 2}", f"{name} is {field.strip() or 'empty'}", "run it again")
    return {name: values[:, column] for column, name in enumerate(names)}
