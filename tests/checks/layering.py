"""layering.py ROOT: source files include downwards only, and never in a circle.

The folders are the floors of a house. A file may include from its own folder and from the floors below it; folders on
the same floor do not know each other. A file in a folder that is on no floor is an error too: decide where it belongs.
"""

import re
import sys
from pathlib import Path

from circles import circles

# Lowest first. Folders of one line share a floor.
FLOORS = (
    ("common/base",),
    ("common/host",),
    ("common/math",),
    ("common/parallel",),
    ("common/mesh",),
    ("common/mesh_io", "common/fields"),
    ("common/mesher",),
    ("common/algebra", "common/nonlinear"),
    ("common/linear/direct", "common/linear/krylov", "common/linear/policy"),
    ("common/linear/amg",),
    ("common/fem",),
    ("common/sampling",),
    ("common/materials",),
    ("common/network",),
    ("common/fluid", "common/wall", "common/mesh_motion"),
    ("common/openings", "common/time"),
    ("common/linear/interface",),
    ("common/case",),
    ("common/linear/velocity_pressure",),
    ("common/linear/distributed",),
    ("common/linear/choice",),
    ("common/scene",),
    ("common/system",),
    ("common/diagnostics",),
    ("common/derived",),
    ("common/io",),
    ("common/observers", "common/restart"),
    ("common/run",),
    ("meshes", "monolithic", "partitioned"),
    ("tests",),
    ("benchmarks",),
)
TOP_FOLDERS = ("common", "meshes", "monolithic", "partitioned", "tests", "benchmarks")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)
BLOCK_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)


def folder_of(path):
    """'common/mesh' for 'common/mesh/gmsh/reader.hpp', 'common/linear/amg' for 'common/linear/amg/cycle.hpp', 'monolithic'
    for 'monolithic/main.cpp'."""
    parts = path.split("/")
    if parts[0] != "common" or len(parts) < 3:
        return parts[0]
    deeper = "/".join(parts[:3])
    return deeper if floor_of(deeper) is not None else "/".join(parts[:2])


def floor_of(folder):
    """Number of the floor; None when the folder is on none."""
    return next((number for number, floor in enumerate(FLOORS) if folder in floor), None)


def allowed_folders(folder):
    below = [name for floor in FLOORS[: floor_of(folder)] for name in floor]
    return below + [folder]


def source_files(root):
    """Paths of all C++ files, relative to the root, with forward slashes."""
    return sorted(
        path.relative_to(root).as_posix()
        for top in TOP_FOLDERS
        for path in (root / top).rglob("*")
        if path.suffix in (".hpp", ".h", ".cpp")
    )


def includes(root, path):
    """(line number, included text, path from the root) of each include of a project file."""
    text = (root / path).read_text(encoding="utf-8")
    text = BLOCK_COMMENT.sub(lambda comment: "\n" * comment.group().count("\n"), text)
    for match in INCLUDE.finditer(text):
        target = resolve(root, path, match.group(1))
        if target is not None:
            yield text.count("\n", 0, match.start(1)) + 1, match.group(1), target


def resolve(root, path, included):
    """Where the compiler finds an include: beside the file, in common/ or at the root, and as a file that the build makes
    from a template. A name that is nowhere counts as what its folder says; None for headers of other libraries."""
    candidates = [(root / path).parent / included, root / "common" / included, root / included]
    for candidate in candidates:
        candidate = Path(*candidate.parts)
        if candidate.is_file() or candidate.with_name(candidate.name + ".in").is_file():
            return candidate.resolve().relative_to(root.resolve()).as_posix()
    first = included.split("/")[0]
    if "/" in included and (root / "common" / first).is_dir():
        return "common/" + included
    if "/" in included and (root / first).is_dir():
        return included
    return None


def wrong_includes(root):
    """One message for each include that goes up or sideways, and for each file on no floor."""
    for path in source_files(root):
        folder = folder_of(path)
        if floor_of(folder) is None:
            yield f'{path}:1: folder "{folder}" is on no floor; add it to FLOORS in tests/checks/layering.py'
            continue
        allowed = allowed_folders(folder)
        for line, included, target in includes(root, path):
            if folder_of(target) not in allowed:
                yield f'{path}:{line}: #include "{included}" from {folder}; allowed: {", ".join(allowed)}'


def cycles(root):
    """One message for each circle of includes."""
    graph = {path: [(line, target) for line, _, target in includes(root, path)] for path in source_files(root)}
    return [f"{path}:{line}: include cycle: {' -> '.join(circle)}" for path, line, circle in circles(graph)]


def main(arguments):
    if len(arguments) != 1 or not (Path(arguments[0]) / "common").is_dir():
        print("layering.py: error: give the root of the repository", file=sys.stderr)
        return 1
    root = Path(arguments[0])
    messages = list(wrong_includes(root)) + cycles(root)
    for message in messages:
        print(message)
    files = source_files(root)
    if not files:
        print("layering.py: error: no source files found", file=sys.stderr)
        return 1
    print(f"{len(files)} files, {len(messages)} problems")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
