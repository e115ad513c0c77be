"""clang_tidy.py CLANG_TIDY ROOT BUILD COMPILER [--since FILE]: fails on any finding of .clang-tidy in the programs' and
libraries' sources and the headers they include. BUILD holds compile_commands.json, made for COMPILER. FILE names a commit at
which there was no finding: then only sources that have changed since, and those that include a changed header, are looked at;
all, where the clone does not have that commit or .clang-tidy has changed.

Much of the time goes to headers, which are searched anew for each source. So sources are put behind each other into few
texts, whose headers are searched once. Two that give one name to different things do not compile as one text: those whose own
names are alike are kept apart from the start, and of a text that does not compile those that the compiler stumbles over make
texts of their own. The analyser looks at each source by itself, with the flags of its own: in a longer text it finds less.
"""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from changed_code import FOLDERS, INCLUDE, Includes, changed_since

# Characters. The headers of a text take as long as 150,000 of the sources, so that few texts are cheap; the many short jobs
# behind them keep all cores busy to the end.
LARGEST_TEXT = 600_000
# The analyser follows this many steps through a function; with its own 225000 the whole takes three times as long.
STEPS = 20_000
UNNAMED = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.MULTILINE | re.DOTALL)
# What a line without indent defines: a class, a type, what stands before a value, or before parameters, which are a part of
# a function's name.
DEFINED = re.compile(
    r"^(?:struct|class|enum(?: class)?) (\w+)|^using (\w+)(?= =)|^(?=\w)[\w:<>,&* ]*?\b(\w+(?:\(.*|(?= = |\{|\[|;)))",
    re.MULTILINE,
)


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


def options(words: Iterable[str]) -> list[tuple[str, ...]]:
    """The words of a command, with a value that is a word of its own beside its option."""
    found: list[tuple[str, ...]] = []
    rest = iter(words)
    for word in rest:
        found.append((word, next(rest)) if word in ("-isystem", "-idirafter", "-Xclang") else (word,))
    return found


def text_kind(words: list[str]) -> tuple[tuple[str, ...], ...]:
    """Flags that sources must share to stand in one text.

    Not their order, nor what they say of warnings, which compiler_flags silences all, and of optimisation. Nor where headers
    are found and what other libraries' headers are told (-DSPDLOG_..., for one): sources that do not include them do not mind.
    """
    own = [option for option in options(words) if not re.match(r"-W|-O|-I|-isystem|-D(?!FSI_)", option[0])]
    return tuple(sorted(set(own)))


def text_flags(flags: dict[str, list[str]], sources: list[Path]) -> list[str]:
    """What any of the sources of a text is compiled with."""
    every = dict.fromkeys(option for source in sources for option in options(flags[str(source)]))
    return [word for option in every for word in option]


def sources_of(root: Path, flags: dict[str, list[str]]) -> list[Path]:
    """Those that are compiled; not those of an option that this build does without, such as MPI."""
    found = (path for folder in FOLDERS for path in (root / folder).rglob("*.cpp"))
    return sorted(path for path in found if str(path) in flags)


def touched(root: Path, sources: list[Path], changed: set[Path]) -> list[Path]:
    """The sources that have changed, or that include a header that has; of a header that other headers alone include, one
    source that it reaches: it is looked at there as well as in all of them."""
    includes = Includes(root)
    left = changed & includes.headers
    found = {source for source in sources if source in changed or includes.of(source) & left}
    for source in found:
        left = left - includes.reached([source])
    for source in sources if left else ():
        if fresh := left & includes.reached([source]):
            found.add(source)
            left = left - fresh
    return sorted(found)


@dataclass
class Text:
    """Sources that are read behind each other."""

    sources: list[Path] = field(default_factory=list)
    names: set[str] = field(default_factory=set)  # that are the sources' own
    size: int = 0  # characters


def own_names(source: Path) -> set[str]:
    """What its unnamed namespaces define, as far as that is seen without a compiler."""
    return {
        match[match.lastindex or 0] for part in UNNAMED.findall(source.read_text()) for match in DEFINED.finditer(part)
    }


def groups(flags: dict[str, list[str]], sources: list[Path]) -> list[list[Path]]:
    """The sources in lists that make texts of at most LARGEST_TEXT, in which no two have a name of their own in common;
    largest first."""
    found: dict[tuple[tuple[str, ...], ...], list[Text]] = {}
    for source in sources:
        texts = found.setdefault(text_kind(flags[str(source)]), [])
        names, size = own_names(source), source.stat().st_size
        fitting = (text for text in texts if not names & text.names and text.size + size <= LARGEST_TEXT)
        text = next(fitting, None)
        if text is None:
            texts.append(text := Text())
        text.sources.append(source)
        text.names |= names
        text.size += size
    everything = [text for texts in found.values() for text in texts]
    return [text.sources for text in sorted(everything, key=lambda text: -text.size)]


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
    there is."""
    if len(sources) == 1:
        return []
    said = written(clang_tidy, root, [*flags, "-ferror-limit=0"], sources, "-*,readability-misleading-indentation")
    if "[clang-diagnostic-error]" not in said:
        return []
    apart = in_the_way(said, {str(source.relative_to(root)): source for source in sources})
    return apart if 0 < len(apart) < len(sources) else sources[len(sources) // 2 :]


def in_the_way(said: str, sources: dict[str, Path]) -> list[Path]:
    """Of the sources that the compiler names in its errors, as few as will do.

    Who defines a name again goes. Of those that an ambiguous name belongs to, and of those in any other error, the one named
    most often goes; but not for errors of sources that have an ambiguous name, from which the others follow.
    """
    again: list[Path] = []
    ambiguous: list[list[Path]] = []
    others: list[list[Path]] = []
    conflict: list[Path] = []
    for name, kind, message in re.findall(r"^(\S+?):\d+:\d+: (error|note): (.*)", said, re.MULTILINE):
        source = sources.get(name)
        if kind == "error":
            conflict = []
            if source and "redefinition" in message:
                again.append(source)
            else:
                (ambiguous if "ambiguous" in message else others).append(conflict)
        if source and source not in conflict:
            conflict.append(source)
    apart = list(dict.fromkeys(again))
    known = {source for conflict in ambiguous for source in conflict}
    left = [*ambiguous, *(conflict for conflict in others if not known & set(conflict))]
    while left := [conflict for conflict in left if conflict and not set(conflict) & set(apart)]:
        named = Counter(source for conflict in left for source in conflict)
        apart.append(named.most_common(1)[0][0])
    return apart


def parted(clang_tidy: str, root: Path, flags: dict[str, list[str]], sources: list[Path]) -> list[list[Path]]:
    """The sources in two lists: those that compile as one text, and those that are to stand apart from them."""
    together = sources
    while apart := stumbling(clang_tidy, root, text_flags(flags, together), together):
        together = [source for source in together if source not in apart]
    return [together, [source for source in sources if source not in together]]


def check_text(clang_tidy: str, root: Path, flags: dict[str, list[str]], sources: list[Path]) -> str:
    """What all but the analyser finds in the sources, as one text where they compile as one; empty: nothing is wrong."""
    said = written(clang_tidy, root, text_flags(flags, sources), sources, "-clang-analyzer-*")
    if "[clang-diagnostic-error]" not in said or len(sources) == 1:
        return said
    parts = [part for part in parted(clang_tidy, root, flags, sources) if part]
    return "\n".join(found for part in parts if (found := check_text(clang_tidy, root, flags, part)))


def jobs(clang_tidy: str, root: Path, flags: dict[str, list[str]], sources: list[Path]) -> list[Callable[[], str]]:
    """What is to be done, each job for one core: the long ones first. Each gives its findings."""
    texts = groups(flags, sources)
    long = [partial(check_text, clang_tidy, root, flags, sources) for sources in texts]
    short = [partial(analysed, clang_tidy, root, flags[str(source)], source) for sources in texts for source in sources]
    return [*long, *short]


def main() -> int:
    clang_tidy, root, build, compiler, *rest = sys.argv[1:]
    return run(
        clang_tidy, Path(root).resolve(), Path(build), compiler, Path(rest[1]) if rest[:1] == ["--since"] else None
    )


def run(clang_tidy: str, root: Path, build: Path, compiler: str, record: Path | None) -> int:
    flags = compiler_flags(build, compiler)
    everything = sources_of(root, flags)
    if not everything:
        raise SystemExit(f"clang_tidy.py: error: no source files in {root}")
    changed = changed_since(root, record) if record else None
    if changed is not None and root / ".clang-tidy" in changed:
        changed = None
    sources = everything if changed is None else touched(root, everything, changed)
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        found = [result for result in pool.map(lambda job: job(), jobs(clang_tidy, root, flags, sources)) if result]
    print("\n".join(found))
    if found:
        print("clang_tidy.py: error: see the findings above; .clang-tidy says which checks there are", file=sys.stderr)
        return 1
    print(f"{len(sources)} of {len(everything)} files were looked at and have no findings")
    return 0


if __name__ == "__main__":
    sys.exit(main())
