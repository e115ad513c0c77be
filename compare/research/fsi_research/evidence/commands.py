"""The commands of runs as tables show them."""

import shlex
from pathlib import Path

from fsi_compare.study.study_file import PROGRAMS


def with_name(command: str) -> str:
    """The command with the program's name in the place of its path: which copy of it ran is in the run's record."""
    words = shlex.split(command)
    program = next((i for i, word in enumerate(words) if Path(word).name in PROGRAMS), 0)  # behind mpirun's words
    return shlex.join(Path(word).name if i in (0, program) else word for i, word in enumerate(words))
