"""Misspelt names: the nearest valid one, and the refusal of a key that is none."""

import difflib
from pathlib import Path
from typing import Iterable, Sequence

from .errors import InputError


def nearest(name: str, names: Sequence[str]) -> str:
    if not names:
        return ""
    close = difflib.get_close_matches(name, list(names), n=1, cutoff=0.0)
    return close[0]


def check_keys(file: Path, section: str, keys: Iterable[str], known: Sequence[str]) -> None:
    """Raises InputError for the first of a section's keys that is not known; an empty section is the file itself."""
    for key in keys:
        if key not in known:
            raise InputError(
                file, f"{section}.{key}".lstrip("."), "is unknown", f"did you mean '{nearest(key, known)}'?"
            )
