"""The commands of runs as tables show them."""

import shlex
from pathlib import Path


def with_name(command: str) -> str:
    """The command with the program's name in the place of its path: which copy of it ran is in the run's record."""
    words = shlex.split(command)
    return shlex.join([Path(words[0]).name, *words[1:]]) if words else ""
