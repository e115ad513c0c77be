"""error_places.py ROOT: every InputError of the programs names a file.

A message without one, "inner wall at 2 mm: there is no surface", leaves its reader to guess which file is meant. Looks
at each `InputError(FILE, KEY, ...)` and refuses an empty FILE, unless the mistake is one of the command line.
"""

import re
import sys
from pathlib import Path

TOP_FOLDERS = ("common", "meshes", "monolithic", "partitioned")
# What users hand over on the command line comes from no file; the key is an option or the word itself.
OF_THE_COMMAND_LINE = ("common/run/command_line.cpp", "monolithic/study/linear_study.cpp", "meshes/fsi_mesh.cpp")
# Reached by a mistake in the program only: the case reader has refused what a user could have written.
BEHIND_THE_READER = (
    "common/linear/direct/gathered_matrix.cpp",
    "common/base/names.cpp",
    "common/materials/material.cpp",
    "common/mesh/axis.cpp",
)
# The mesh is too large or too flat for what is made of it; a case has one.
OF_THE_MESH = ("common/algebra/entry_count.cpp", "common/derived/gradient_recovery.cpp")
MADE = re.compile(r"\bInputError\(\s*(\"\"|std::string\(\)|\{\})\s*,")


def nameless(text):
    """Numbers of the lines of C++ text where an InputError names no file."""
    return [text.count("\n", 0, found.start()) + 1 for found in MADE.finditer(text)]


def problems(root):
    """'FILE:LINE: ...' for each nameless error that is not allowed."""
    found = []
    for top in TOP_FOLDERS:
        for path in sorted((root / top).rglob("*.[ch]pp")):
            name = path.relative_to(root).as_posix()
            if name in (*OF_THE_COMMAND_LINE, *BEHIND_THE_READER, *OF_THE_MESH):
                continue
            lines = nameless(path.read_text(encoding="utf-8"))
            found += [f"{name}:{line}: an InputError without file" for line in lines]
    return found


def main():
    found = problems(Path(sys.argv[1]))
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
