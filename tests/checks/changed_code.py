"""Which code has changed since a commit, and what includes it: for checks that leave out what has not changed."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable
from pathlib import Path

FOLDERS = ("common", "monolithic", "partitioned", "meshes")
INCLUDE = re.compile(r"\s*#\s*include\s*(\S+)")
# A comment, the group; or what may look like one inside: strings and characters.
COMMENT = re.compile(
    r"""(//[^\n]*|/\*.*?\*/)|R"(?P<mark>[^(]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|(?<!\w)'(?:\\.|[^'\\\n])+'""",
    re.DOTALL,
)


def code_of(text: str) -> list[str]:
    """What a source says to the compiler and to clang-tidy: without comments, but for those that silence a finding, and
    without the blanks between words. Strings stay whole, as do the ends of preprocessor's lines."""
    found: list[str] = []
    end = 0
    for match in COMMENT.finditer(text):
        found += _words(text[end : match.start()])
        if match[1] is None or "NOLINT" in match[1]:
            found.append(match[0])
        end = match.end()
    return found + _words(text[end:])


def _words(code: str) -> list[str]:
    """Of code without strings and comments."""
    ended = re.sub(r"(?m)^([ \t]*#.*)$", "\\1 \n#end ", code) if "#" in code else code
    return ended.split()


def changed_since(root: Path, record: Path) -> set[Path] | None:
    """Files that are not as they were at the commit that the record names, C++ sources by their code; None: that cannot be
    told, as where the clone does not have that commit."""
    words = record.read_text().split() if record.exists() else []
    if not words:
        return None
    commit = words[0]
    git = ["git", "-C", str(root)]
    done = subprocess.run(
        [*git, "diff", "--name-only", "--no-renames", "-z", commit],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    new = subprocess.run([*git, "ls-files", "--others", "--exclude-standard", "-z"], stdout=subprocess.PIPE, text=True)
    if done.returncode != 0 or new.returncode != 0:
        return None

    def differs(name: str) -> bool:
        path = root / name
        if path.suffix not in (".cpp", ".hpp") or not path.exists():
            return True
        old = subprocess.run(
            [*git, "show", f"{commit}:{name}"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        return old.returncode != 0 or code_of(old.stdout) != code_of(path.read_text())

    def names(listed: str) -> list[str]:
        return [name for name in listed.split("\0") if name]

    return {root / name for name in (*filter(differs, names(done.stdout)), *names(new.stdout))}


class Includes:
    """What files of a tree include of each other. Headers are named from the folders that hold the rooms, as
    "fem/elements.hpp", from the top, or from the folder of the file that includes them."""

    def __init__(self, root: Path) -> None:
        self.headers = {path for folder in FOLDERS for path in (root / folder).rglob("*.hpp")}
        rooms = {str(path.relative_to(root)): path for path in self.headers}
        self._names = rooms | {name.split("/", 1)[1]: path for name, path in rooms.items()}
        self._names |= {str(path.relative_to(root / "tests")): path for path in (root / "tests").rglob("*.hpp")}
        self._included: dict[Path, set[Path]] = {}

    def of(self, file: Path) -> set[Path]:
        """What a file includes itself."""
        if file not in self._included:
            lines = (line for line in map(INCLUDE.match, file.read_text().split("\n")) if line)
            named = (line[1].strip('"<>') for line in lines)
            paths = (self._names.get(name, file.parent / name) for name in named)
            self._included[file] = {path for path in paths if path in self.headers or path.is_file()}
        return self._included[file]

    def reached(self, files: Iterable[Path]) -> set[Path]:
        """What files include, and what that includes."""
        found: set[Path] = set()
        last = set(files)
        while last:
            last = {header for file in last for header in self.of(file)} - found
            found |= last
        return found
