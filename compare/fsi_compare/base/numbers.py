"""Whether entries of files, and words, are numbers."""

import math
from typing import Any, Mapping, TypeGuard


def is_number(value: Any) -> TypeGuard[float]:
    """Whether it is one, which true and false are not."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def number_of(entries: Mapping[str, Any], name: str) -> float | None:
    """The number of this name; None where it is missing, or something else."""
    value = entries.get(name)
    return float(value) if is_number(value) else None


def parsed(text: str) -> float:
    """The number that a text says; NaN where it says none."""
    try:
        return float(text)
    except ValueError:
        return math.nan
