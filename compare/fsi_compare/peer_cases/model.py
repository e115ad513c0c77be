"""A case of another program, as far as ours has words for it. In mm, mg, ms."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .geometry import CaseMesh, Face


@dataclass
class Note:
    """An entry that has no counterpart: what it is, where, and what is done in its place."""

    entry: str
    where: str
    instead: str
    matters: bool = False  # may change a result: a warning

    def __str__(self) -> str:
        return f"{self.entry} ({self.where}): {self.instead}"


Table = tuple[tuple[str, str], list[tuple[float, float]]]  # header; rows of a time in ms and a value


@dataclass
class PeerCase:
    """`sections` are the case file's, in its order; tables are files beside it, by name."""

    program: str
    file: Path
    sections: dict[str, Any] = field(default_factory=dict)
    tables: dict[str, Table] = field(default_factory=dict)
    said: list[str] = field(default_factory=list)  # what was made of what, for the log
    notes: list[Note] = field(default_factory=list)
    faces: list[Face] = field(default_factory=list)
    mesh: CaseMesh | None = None
