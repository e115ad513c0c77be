"""Misspelt names: the nearest valid one, and the refusal of a key that is none."""

import difflib
from pathlib import Path
from typing import Iterable, Sequence

from .errors import InputError


def nearest(name: str, names: Iterable[str]) -> str:
    return next(iter(difflib.get_close_matches(name, list(names), n=1, cutoff=0.0)), "")


def hint(name: str, names: Iterable[str], there_are: str = "It has") -> str:
    """The remedy for a name that is none of those that there are."""
    known = list(names)
    return f"did you mean '{nearest(name, known)}'? {there_are} {', '.join(known)}"


def check_keys(file: Path, section: str, keys: Iterable[str], known: Sequence[str]) -> None:
    """Raises InputError for the first of a section's keys that is not known; an empty section is the file itself."""
    for key in keys:
        if key not in known:
            name = f"{section}.{key}".lstrip(".")
            raise InputError(file, name, "is unknown", f"did you mean '{nearest(key, known)}'?")
