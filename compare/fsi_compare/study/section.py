"""A section of a study file: its entries, each of the kind that is asked for."""

from pathlib import Path
from typing import Any, Iterator, Mapping, Sequence

from ..base.errors import InputError
from ..base.numbers import is_number
from ..base.suggestions import check_keys

LARGEST_COUNT = 10_000  # threads, processes, runs at once, repetitions
LARGEST_NUMBER = 10**15


class Section:
    """`key`: the section's own, e.g. "report.sweeps"; empty: the file itself. All raise InputError naming file and
    key."""

    def __init__(self, path: Path, key: str, entry: Any, known: Sequence[str]) -> None:
        self.path, self.key = path, key
        if not isinstance(entry, dict):
            raise InputError(path, key, "is not a section", f"its keys are {', '.join(known)}")
        check_keys(path, key, entry, known)
        self.entries: Mapping[str, Any] = entry

    def wrong(self, name: str, problem: str, remedy: str) -> InputError:
        return InputError(self.path, self.key_of(name), problem, remedy)

    def key_of(self, name: str) -> str:
        return f"{self.key}.{name}".lstrip(".")

    def table(self, name: str, needed: bool = False) -> Mapping[str, Any]:
        """Entries of names that only the study knows; empty where it is missing."""
        found = self.entries.get(name, {})
        if not isinstance(found, dict) or (needed and not found):
            problem = "is missing" if name not in self.entries else "is not a section"
            raise self.wrong(name, problem, f"write a section [{self.key_of(name)}]")
        return found

    def settings(self, name: str) -> dict[str, Any]:
        """Case-file entries, keys in quotes ("time.step" = 0.1) or nested (time.step = 0.1)."""
        return dict(flat(self.table(name)))

    def text(self, name: str, default: str | None = None) -> str:
        if name not in self.entries and default is not None:
            return default
        value = self.entries.get(name)
        if not isinstance(value, str) or not value.strip():
            raise self.wrong(name, "is missing" if value is None else "is not a text", "give it in quotes")
        return " ".join(value.split())

    def count(self, name: str, default: int) -> int:
        value = self.entries.get(name, default)
        if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= LARGEST_COUNT:
            problem = f"{value} is not a whole number from 1 to {LARGEST_COUNT}"
            raise self.wrong(name, problem, f"leave it out for {default}")
        return value

    def number(self, name: str, default: float | None = None) -> float:
        value = self.entries.get(name, default)
        if not is_positive(value):
            problem = "is missing" if value is None else f"{value} is not a positive number"
            raise self.wrong(name, problem, "give a number" if default is None else f"leave it out for {default:g}")
        return float(value)


def is_positive(value: Any) -> bool:
    return is_number(value) and 0 < value <= LARGEST_NUMBER


def flat(table: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """The entries of nested tables by dotted keys."""
    for key, value in table.items():
        if isinstance(value, dict):
            yield from flat(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value
