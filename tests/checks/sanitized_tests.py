"""sanitized_tests.py ROOT BUILD [--since FILE]: the programs of unit tests, a line each, that a change can have changed.

BUILD is a folder configured for Ninja, in which each program is one test; nothing need be built in it. FILE names a commit at which
these tests passed under the sanitizers. A program counts where code that it is made from is not as it was then: sources of its
libraries, headers, test data and CMake files of their folders. All count without FILE, where the clone does not have that
commit, and where a preset, a CMake module or a list of packages has changed.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from changed_code import INCLUDE, Includes, changed_since

# What each program is compiled by, or with.
EVERYTHING = ("CMakePresets.json", "cmake", "scripts/packages.txt", "scripts/packages-test.txt", "scripts/test.sh")


def output_of(words: list[str], build: Path) -> str:
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise SystemExit(
            f"sanitized_tests.py: error: {' '.join(words)}: {done.stderr.strip()}; configure {build} first"
        )
    return done.stdout


def programs_of(build: Path) -> list[str]:
    """Targets of the tests with the label unit, which are named "FOLDER: TARGET"."""
    listed = output_of(["ctest", "--test-dir", str(build), "-L", "^unit$", "--show-only=json-v1"], build)
    names = [test["name"].split(": ")[-1] for test in json.loads(listed)["tests"]]
    return sorted(names)


def sources_of(root: Path, build: Path, program: str) -> set[Path]:
    """C++ sources of a program and of its libraries; of those compiled as one text, each."""
    found: set[Path] = set()
    for name in output_of(["ninja", "-C", str(build), "-t", "inputs", program], build).splitlines():
        path = build / name
        if path.suffix == ".cxx" and path.is_relative_to(build):
            lines = (line for line in map(INCLUDE.match, path.read_text().split("\n")) if line)
            found |= {Path(line[1].strip('"')) for line in lines}
        elif path.suffix == ".cpp" and path.is_relative_to(root):
            found.add(path)
    return {path for path in found if path.is_relative_to(root) and not path.is_relative_to(build)}


def reads_the_tree(root: Path, sources: set[Path]) -> bool:
    """Whether a program is told where the sources lie, and so may read case files of any folder."""
    lists = {path.parent / "CMakeLists.txt" for path in sources if path.is_relative_to(root / "tests")}
    return any("PROJECT_SOURCE_DIR" in path.read_text() for path in lists if path.exists())


def is_touched(root: Path, sources: set[Path], headers: set[Path], changed: set[Path]) -> bool:
    code = sources | headers
    others = {path for path in changed if path.suffix not in (".cpp", ".hpp")}
    # Whatever else lies in a room, such as a header that CMake fills in, or its list.
    rooms = {path.parent for path in others if path.name == "CMakeLists.txt" or path.suffix == ".in"}
    tests = {path.parent for path in sources if path.is_relative_to(root / "tests")}
    return (
        bool(changed & code)
        or any(rooms & set(path.parents) for path in code)
        or any(tests & set(path.parents) for path in others)  # their data
        or (reads_the_tree(root, sources) and any(path.suffix == ".toml" for path in others))
    )


def touched(root: Path, build: Path, changed: set[Path] | None) -> list[str]:
    programs = programs_of(build)
    if not programs:
        raise SystemExit(f"sanitized_tests.py: error: {build}: there is no unit test; configure with -DFSI_TESTS=ON")
    everywhere = {root / name for name in EVERYTHING}
    if changed is None or any(everywhere & {path, *path.parents} for path in changed):
        return programs
    includes = Includes(root)
    found = []
    for program in programs:
        sources = sources_of(root, build, program)
        if is_touched(root, sources, includes.reached(sources), changed):
            found.append(program)
    return found


def main() -> int:
    root, build, *rest = sys.argv[1:]
    top = Path(root).resolve()
    changed = changed_since(top, Path(rest[1])) if rest[:1] == ["--since"] else None
    for program in touched(top, Path(build).resolve(), changed):
        print(program)
    return 0


if __name__ == "__main__":
    sys.exit(main())
