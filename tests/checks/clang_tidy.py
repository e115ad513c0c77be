"""clang_tidy.py CLANG_TIDY ROOT BUILD COMPILER: fails on any finding of .clang-tidy in the programs' and libraries' sources
and the headers they include. BUILD holds compile_commands.json, made for COMPILER.

Most of the time goes to headers, which are searched anew for each source. So sources are put behind each other into one
text, whose headers are searched once. Where they do not compile as one text, because two of them give one name to different
things, those that the compiler stumbles over make a text of their own. The analyser looks at each source by itself: in a
longer text it finds less.
"""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

FOLDERS = ("common", "monolithic", "partitioned", "meshes")
LARGEST_TEXT = 200_000  # characters: texts of about equal size keep all cores busy to the end
# The analyser follows this many steps through a function; with its own 225000 the whole takes three times as long.
STEPS = 20_000
INCLUDE = re.compile(r"\s*#\s*include\s*(\S+)")


def compiler_flags(build: Path, compiler: str) -> dict[str, list[str]]:
    """Flags of each source that is compiled: without output and input, with those for the analysis.

    omp.h is clang's own where libomp-dev is installed, else that of the compiler. What warnings there are is the
    compiler's affair, which knows others; but names that hide others are looked for here, since a build that takes
    several sources as one text cannot. Assertions are on: they tell the analyser what holds.
    """
    headers = subprocess.run([compiler, "-print-file-name=include"], stdout=subprocess.PIPE, text=True, check=True)
    added = ["-Wno-everything", "-Wshadow", "-UNDEBUG", "-idirafter", headers.stdout.strip()]
    added += ["-Xclang", "-analyzer-config", "-Xclang", f"max-nodes={STEPS}"]
    flags = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        words = shlex.split(entry["command"])
        for option, values in (("-o", 1), ("-c", 1)):
            if option in words:
                at = words.index(option)
                del words[at : at + 1 + values]
        flags[entry["file"]] = words + added
    return flags


def groups(root: Path, flags: dict[str, list[str]]) -> list[list[Path]]:
    """The compiled sources by flags, in lists that make texts of at most LARGEST_TEXT; largest first.

    The order of the flags, and what they say of warnings, is no matter: compiler_flags silences all.
    """
    found: dict[tuple[str, ...], list[list[Path]]] = {}
    for source in sorted(path for folder in FOLDERS for path in (root / folder).rglob("*.cpp")):
        if str(source) not in flags:
            continue  # of an option that this build does without, such as MPI
        words = {word for word in flags[str(source)] if not word.startswith("-W")}
        lists = found.setdefault(tuple(sorted(words)), [[]])
        if lists[-1] and sum(path.stat().st_size for path in lists[-1] + [source]) > LARGEST_TEXT:
            lists.append([])
        lists[-1].append(source)
    everything = [sources for lists in found.values() for sources in lists]
    return sorted(everything, key=lambda sources: -sum(path.stat().st_size for path in sources))


def text_of(sources: list[Path]) -> tuple[str, list[tuple[Path, int]]]:
    """The sources behind each other, and of each line of it where it is from.

    An include that stands in an earlier one already leaves an empty line: the second in one text would be a finding.
    """
    lines: list[str] = []
    places: list[tuple[Path, int]] = []
    earlier: set[str] = set()
    for source in sources:
        own: set[str] = set()
        for number, line in enumerate(source.read_text().split("\n"), 1):
            header = INCLUDE.match(line)
            if header:
                first = header[1] not in own
                own.add(header[1])
                if first and header[1] in earlier:
                    line = ""
            lines.append(line)
            places.append((source, number))
        earlier |= own
    return "\n".join(lines) + "\n", places


def written(clang_tidy: str, root: Path, flags: list[str], sources: list[Path], checks: str) -> str:
    """What clang-tidy writes of the sources as one text, with the files and lines that they have by themselves."""
    with tempfile.TemporaryDirectory() as folder:
        text, places = text_of(sources)
        file = Path(folder) / "text.cpp"
        file.write_text(text)
        command = [
            clang_tidy,
            "--quiet",
            f"--config-file={root / '.clang-tidy'}",
            f"--checks={checks}",
            str(file),
            "--",
            *flags[1:],
        ]
        for parent in dict.fromkeys(source.parent for source in sources):
            command += ["-iquote", str(parent)]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        said = done.stdout if done.stdout.strip() or done.returncode == 0 else done.stderr
        if done.returncode != 0 and not said.strip():
            said = f"clang-tidy ended with exit code {done.returncode}"

        def original(match: re.Match[str]) -> str:
            source, number = places[min(int(match[1]), len(places)) - 1]
            return f"{source.relative_to(root)}:{number}:"

        return re.sub(re.escape(str(file)) + r":(\d+):", original, said).strip()


def analysed(clang_tidy: str, root: Path, flags: list[str], source: Path) -> str:
    """What the analyser finds in a source; empty: nothing is wrong."""
    without = re.findall(r"-clang-analyzer-\w[\w.]*", (root / ".clang-tidy").read_text())
    checks = ["-*", "clang-diagnostic-shadow", "clang-analyzer-*", *without]
    return written(clang_tidy, root, flags, [source], ",".join(checks))


def stumbling(clang_tidy: str, root: Path, flags: list[str], sources: list[Path]) -> list[Path]:
    """Sources that are to stand apart, since all do not compile as one text; none: they do. The one check is the cheapest
    there is. Where the compiler stumbles in a header it says whose name is in the way, else half of the sources go."""
    said = written(clang_tidy, root, flags, sources, "-*,readability-misleading-indentation")
    if "[clang-diagnostic-error]" not in said:
        return []
    for kind in ("error", "note"):
        files = set(re.findall(rf"^(\S+?):\d+:\d+: {kind}: ", said, re.MULTILINE))
        apart = [source for source in sources if str(source.relative_to(root)) in files]
        if apart and len(apart) < len(sources):
            return apart
    return sources[len(sources) // 2 :]


def check_text(clang_tidy: str, root: Path, flags: list[str], sources: list[Path]) -> str:
    """What all but the analyser finds in the sources, as one text or as few as compile; empty: nothing is wrong."""
    apart = stumbling(clang_tidy, root, flags, sources) if len(sources) > 1 else []
    if not apart:
        return written(clang_tidy, root, flags, sources, "-clang-analyzer-*")
    parts = [[source for source in sources if source not in apart], apart]
    each = [check_text(clang_tidy, root, flags, part) for part in parts]
    return "\n".join(found for found in each if found)


def jobs(clang_tidy: str, root: Path, flags: dict[str, list[str]], texts: list[list[Path]]) -> list[Callable[[], str]]:
    """What is to be done, each job for one core: the long ones first. Each gives its findings."""
    long = [partial(check_text, clang_tidy, root, flags[str(sources[0])], sources) for sources in texts]
    short = [partial(analysed, clang_tidy, root, flags[str(source)], source) for sources in texts for source in sources]
    return [*long, *short]


def main() -> int:
    clang_tidy, root, build, compiler = sys.argv[1], Path(sys.argv[2]).resolve(), Path(sys.argv[3]), sys.argv[4]
    flags = compiler_flags(build, compiler)
    texts = groups(root, flags)
    if not texts:
        raise SystemExit(f"clang_tidy.py: error: no source files in {root}")
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        found = [result for result in pool.map(lambda job: job(), jobs(clang_tidy, root, flags, texts)) if result]
    print("\n".join(found))
    if found:
        print("clang_tidy.py: error: see the findings above; .clang-tidy says which checks there are", file=sys.stderr)
        return 1
    print(f"{sum(len(sources) for sources in texts)} files have no findings")
    return 0


if __name__ == "__main__":
    sys.exit(main())
