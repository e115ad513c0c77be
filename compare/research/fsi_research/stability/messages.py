"""What the programs say where a run does not reach its end: each message once."""

import re
from dataclasses import dataclass, field
from typing import Dict, List, Sequence

from ..evidence.cross_check import Cell

SAVED = re.compile(r"\s*\[the state after step [^\]]*\]")  # names a folder
FOLDERS = re.compile(r"(?<![\w.-])(?:/[^\s/:]+)+/(?=[^\s/:]+\.toml\b)")  # of a case file
NUMBER = re.compile(r"(?<![\w.-])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])")


@dataclass
class Message:
    text: str  # numbers as N
    example: str  # as the first run said it
    cells: List[Cell] = field(default_factory=list)

    @property
    def methods(self) -> List[str]:
        return list(dict.fromkeys(cell.method for cell in self.cells))


def without_folder(message: str) -> str:
    """A run's message without the part that names its folder, and without the case file's."""
    return FOLDERS.sub("", SAVED.sub("", message))


def distinct(cells: Sequence[Cell]) -> List[Message]:
    """The messages of all runs that are not done, those that differ in numbers alone as one; the commonest first."""
    found: Dict[str, Message] = {}
    for cell in cells:
        if cell.run.done:
            continue
        said = without_folder(cell.run.message) or "(nothing)"
        text = NUMBER.sub("N", said)
        found.setdefault(text, Message(text, said)).cells.append(cell)
    return sorted(found.values(), key=lambda message: -len(message.cells))
