"""A mesh that is made by one command or by several, each of which takes the file of its predecessor:

    geo lumen.geo | thicken --thickness-from thickness.csv --layer wall=100%:2
    surface.py --jitter 0.05 | lumen --edge 0.6 | thicken --layer wall=0.4:2

A command is one of fsi-mesh without -o, and without its input where it is not the first; or, as the first, a script in
Python, which writes a surface of triangles, .stl, to the file named behind its -o.
"""

import hashlib
import os
import shlex
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Sequence

from ..base.errors import InputError
from ..base.files import TEMPORARY, is_file, make_folder, read_bytes
from ..starting.processes import End, execute

MARK = "|"  # between two commands
SCRIPT = ".py"
READ = (".geo", ".msh", ".csv", ".vtp", ".ply", ".obj", ".stl", SCRIPT)  # what decides a mesh beside the words


@dataclass(frozen=True)
class Link:
    """One command, with the file that it takes and the one that it makes."""

    words: tuple[str, ...]
    source: Path | None  # None: the first
    made: Path

    @property
    def is_script(self) -> bool:
        return self.words[0].endswith(SCRIPT)

    def command(self, mesh_maker: Any, python: Sequence[Any], quiet: bool) -> list[Any]:
        name, *others = self.words
        if self.is_script:
            return [*python, name, *others, "-o", self.made]
        before = [] if self.source is None else [self.source]
        return [mesh_maker, name, *before, *others, *(["-q"] if quiet else []), "-o", self.made]


def commands_of(words: Sequence[str]) -> list[list[str]]:
    """The words of each command."""
    marks = [place for place, word in enumerate(words) if word == MARK]
    return [list(words[first + 1 : end]) for first, end in zip([-1, *marks], [*marks, len(words)])]


def links(words: Sequence[str], target: Path, source: str) -> list[Link]:
    """`target`: file of the last; those of the others lie beside it. `source`: where the words are. Raises InputError."""
    parts = commands_of(words)
    found: list[Link] = []
    for number, part in enumerate(parts, 1):
        if not part:
            raise InputError(source, "", "a command of the mesh is empty", "give the words of an fsi-mesh command")
        ending = ".stl" if part[0].endswith(SCRIPT) else ".msh"
        made = target if number == len(parts) else target.with_name(f"{target.stem}-{number}{ending}")
        found.append(Link(tuple(part), found[-1].made if found else None, made))
        if found[-1].is_script and (number > 1 or number == len(parts)):
            problem = "a script makes a surface, so that it comes first and a command follows"
            raise InputError(source, "", problem, f'write "{Path(part[0]).name} | lumen ..."')
    return found


def as_typed(words: Sequence[str], target: Path, source: str) -> list[str]:
    """The commands as a user would type them. Raises InputError."""
    return [shlex.join(map(str, link.command("fsi-mesh", ["python3"], False))) for link in links(words, target, source)]


def make_mesh(words: Sequence[str], target: Path, mesh_maker: Path, source: str, kept: Path | None = None) -> End:
    """Makes `target`. Returns how the last command that was started ended: code 0 where all are done. Files between are
    removed, or, with `kept`, stay in that folder, named by their recipe, so that other chains take them up."""
    chain = links(words, target, source)
    if kept is not None:
        chain = _with_kept(chain, kept)
    try:
        for link in chain:
            last = link is chain[-1]
            if kept is not None and not last and is_file(link.made):
                end = End(0, "", 0.0)
                continue
            end = _make(link, mesh_maker, kept is not None and not last)
            if end.code:
                break
    finally:
        if kept is None:
            for link in chain[:-1]:
                link.made.unlink(missing_ok=True)
    return end


def _make(link: Link, mesh_maker: Path, whole: bool) -> End:
    """`whole`: its file has its name only when it is finished."""
    python = [sys.executable, "-E", "-B"]
    if not whole:
        return execute(link.command(mesh_maker, python, True))
    make_folder(link.made.parent)
    unfinished = link.made.with_name(f".{link.made.stem}{TEMPORARY}{link.made.suffix}")
    end = execute(Link(link.words, link.source, unfinished).command(mesh_maker, python, True))
    if end.code == 0:
        os.replace(unfinished, link.made)
    else:
        unfinished.unlink(missing_ok=True)
    return end


def _with_kept(chain: Sequence[Link], folder: Path) -> list[Link]:
    """The same commands; files, but for the last one, named by what each is made of."""
    found: list[Link] = []
    words: list[str] = []
    for link in chain:
        words += [*link.words, MARK]
        digest = hashlib.sha256("\0".join([*words, *contents(words)]).encode()).hexdigest()
        name = f"{Path(link.words[0]).stem}-{digest[:12]}{link.made.suffix}"
        made = link.made if link is chain[-1] else folder / name
        found.append(Link(link.words, found[-1].made if found else None, made))
    return found


def contents(words: Sequence[str]) -> list[str]:
    """Digests of the files that the words name."""
    named = [Path(word) for word in words if word.endswith(READ) and is_file(Path(word))]
    return [hashlib.sha256(read_bytes(path, "make it again", "make it again")).hexdigest() for path in named]


def with_places(words: Sequence[str], folder: Path) -> list[str]:
    """Files of `folder` by their full names; other words as they are."""
    return [str(folder / word) if word.endswith(READ) and is_file(folder / word) else word for word in words]
