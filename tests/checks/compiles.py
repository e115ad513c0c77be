"""What no build of the tests compiles: the benchmarks, and the way to a first report by linear tetrahedra alone.

compiles.py ROOT COMPILER [OPTION...]: the sources by the compiler, no output; then that elements are named by the elements
and by load_scene.cpp alone, since a program for one element links no other.
"""

import re
import subprocess
import sys
from pathlib import Path
from typing import List

FIRST_ELEMENT = ["common/run/load_scene.cpp", "common/wall/wall_problem.cpp", "common/mesh_motion/mesh_motion.cpp"]
NAMES = re.compile(r"\b(P1|P2P1)(Tetrahedron|AxisymmetricTriangle|PlaneTriangle)\b")
NAME_ELEMENTS = ("common/fem/", "common/run/load_scene.cpp")


def naming_sources(root: Path) -> List[str]:
    """Sources of the libraries and programs that name an element and may not, relative to root."""
    found = []
    for folder in ("common", "monolithic", "partitioned", "meshes"):
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            name = path.relative_to(root).as_posix()
            if not name.startswith(NAME_ELEMENTS) and NAMES.search(path.read_text()):
                found.append(name)
    return found


def main(root: Path, compiler: str, options: List[str]) -> int:
    benchmarks = [str(path.relative_to(root)) for path in sorted((root / "benchmarks").glob("*.cpp"))]
    failures = 0
    jobs = [(name, options) for name in benchmarks]
    jobs += [(name, ["-DFSI_FIRST_ELEMENT", *options]) for name in FIRST_ELEMENT]
    for name, words in jobs:
        command = [compiler, "-std=c++17", "-fsyntax-only", *words, str(root / name)]
        failures += subprocess.run(command, check=False).returncode != 0
    for name in naming_sources(root):
        print(f"{name}: names an element; only {' and '.join(NAME_ELEMENTS)} do: see fem/elements.hpp")
        failures += 1
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2], sys.argv[3:]))
