"""A mesh that is made by one command or by several, each of which takes the file that the one before has made:

    geo lumen.geo | thicken --thickness-from thickness.csv --layer wall=100%:2
    surface.py --jitter 0.05 | lumen --edge 0.6 | thicken --layer wall=0.4:2

A command is one of fsi-mesh without -o, and without its input where it is not the first; or, as the first, a script in
Python, which writes a surface of triangles, .stl, to the file named behind its -o.
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, List, Optional, Sequence, Tuple

from ...base.errors import InputError
from ...base.files import is_file
from ..starting.processes import End, execute

MARK = "|"  # between two commands
SCRIPT = ".py"
READ = (".geo", ".msh", ".csv", ".vtp", ".ply", ".obj", ".stl", SCRIPT)  # what decides a mesh beside the words


@dataclass(frozen=True)
class Link:
    """One command, with the file that it takes and the one that it makes."""

    words: Tuple[str, ...]
    source: Optional[Path]  # None: the first
    made: Path

    @property
    def is_script(self) -> bool:
        return self.words[0].endswith(SCRIPT)

    def command(self, mesh_maker: Any, python: Sequence[Any], quiet: bool) -> List[Any]:
        name, *others = self.words
        if self.is_script:
            return [*python, name, *others, "-o", self.made]
        before = [] if self.source is None else [self.source]
        return [mesh_maker, name, *before, *others, *(["-q"] if quiet else []), "-o", self.made]


def links(words: Sequence[str], target: Path, source: str) -> List[Link]:
    """`target`: of the last; the others' files lie beside it. `source`: who names the words. Raises InputError."""
    parts: List[List[str]] = [[]]
    for word in words:
        if word == MARK:
            parts.append([])
        else:
            parts[-1].append(word)
    found: List[Link] = []
    for number, part in enumerate(parts, 1):
        if not part:
            raise InputError(source, "", "a command of the mesh is empty", "give the words of an fsi-mesh command")
        ending = ".stl" if part[0].endswith(SCRIPT) else ".msh"
        made = target if number == len(parts) else target.with_name(f"{target.stem}-{number}{ending}")
        found.append(Link(tuple(part), found[-1].made if found else None, made))
        if found[-1].is_script and (number > 1 or number == len(parts)):
            remedy = f'write "{Path(part[0]).name} | lumen ..."'
            raise InputError(
                source, "", "a script makes a surface, so that it comes first and a command follows", remedy
            )
    return found


def make_mesh(words: Sequence[str], target: Path, mesh_maker: Path, source: str) -> End:
    """Makes `target`; files between are removed. How the last command ended that was started: 0 where all are done."""
    chain = links(words, target, source)
    try:
        for link in chain:
            end = execute(link.command(mesh_maker, [sys.executable, "-E", "-B"], True))
            if end.code:
                break
    finally:
        for link in chain[:-1]:
            link.made.unlink(missing_ok=True)
    return end


def with_places(words: Sequence[str], folder: Path) -> List[str]:
    """Files of `folder` by their full names; other words as they are."""
    return [str(folder / word) if word.endswith(READ) and is_file(folder / word) else word for word in words]
