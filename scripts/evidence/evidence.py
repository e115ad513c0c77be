"""Makes the kept tables, pages and pictures anew, each by the commands of scripts/evidence/items.toml.

usage: scripts/evidence.sh [--list | --check] [--work FOLDER] [--programs BIN] [ITEM...]
  --list      the items with their minutes and the age of what they made; makes nothing
  --check     exit code 1 where something is of other programs than those of BIN; makes nothing
  --work      keeps meshes and runs, so that a stopped item goes on; default: results/evidence
  --programs  default: build/release/bin
  ITEM        only these; without one, all but the long ones that are due or of other programs
An item that is done is of the age of the sources that it was made from: version, commit and, by scripts/evidence/short_runs.py,
results of the programs. docs/data/made-by.csv keeps that, a row for each file. Exit code 1: an item failed; the others are made.
"""

import argparse
import datetime
import glob
import hashlib
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path
from typing import Any, Dict, List, NamedTuple, NoReturn, Optional, Tuple

from kept_tables import DATA, TOP, read_table, write_table
from short_runs import RunError, kept_values, name_of_results, other_results, values_of

ITEMS = Path(__file__).with_name("items.toml")
MADE_BY = DATA / "made-by.csv"
ORIGIN = "made by scripts/evidence.sh: what made each kept table, page and picture; results: a name for what docs/data/short-runs.csv holds"
SOURCES = ("common", "monolithic", "partitioned")


class Item(NamedTuple):
    name: str
    minutes: float
    commands: Tuple[str, ...]
    makes: Tuple[str, ...]  # patterns below the top
    idle: bool
    long: bool
    codes: Tuple[int, ...]  # exit codes of commands that are no failure
    due: bool  # what it made is of an earlier version, or nobody knows of which; the mark leaves with the item's next run

    def files(self) -> List[str]:
        """What there is of it, below the top."""
        found = [path for pattern in self.makes for path in glob.glob(pattern, root_dir=TOP)]
        return sorted(found)


class Age(NamedTuple):
    """What the programs and the machine are that made a file."""

    version: str
    commit: str
    results: str
    processor: str
    date: str


COLUMNS = ("file", "item", *Age._fields)


def read_items(path: Path = ITEMS) -> List[Item]:
    entries: List[Dict[str, Any]] = tomllib.loads(path.read_text(encoding="utf-8"))["item"]
    return [
        Item(
            entry["name"],
            float(entry["minutes"]),
            tuple(entry["commands"]),
            tuple(entry["makes"]),
            bool(entry.get("idle", False)),
            bool(entry.get("long", False)),
            tuple(entry.get("codes", (0,))),
            bool(entry.get("due", False)),
        )
        for entry in entries
    ]


def without_due(text: str, name: str) -> str:
    """The list of items, one of which is no longer due."""
    head, *parts = text.split("[[item]]\n")
    made = [part.replace("due = true\n", "") if part.startswith(f'name = "{name}"') else part for part in parts]
    return "[[item]]\n".join((head, *made))


def read_ages() -> Dict[str, Tuple[str, Age]]:
    """By file: the item and the age."""
    if not MADE_BY.exists():
        return {}
    return {row["file"]: (row["item"], Age(*(row[name] for name in Age._fields))) for row in read_table(MADE_BY)}


def write_ages(ages: Dict[str, Tuple[str, Age]]) -> None:
    rows = [(file, item, *age) for file, (item, age) in sorted(ages.items()) if (TOP / file).exists()]
    write_table(MADE_BY, ORIGIN, COLUMNS, rows)


def age_of(programs: Path) -> Age:
    version = output_of([str(programs / "fsi-monolithic"), "--version"]).split()[-1]
    commit = output_of(["git", "log", "-1", "--format=%h", "--abbrev=8", "--", *SOURCES]).strip()
    if output_of(["git", "status", "--porcelain", "--", *SOURCES]).strip():
        fail(f"{', '.join(SOURCES)}: there are changes that are in no commit; commit or take them back, and build")
    return Age(version, commit, name_of_results(), processor(), datetime.date.today().isoformat())


def processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    except OSError:
        names = []
    return names[0] if names else platform.machine()


def output_of(command: List[str]) -> str:
    try:
        return subprocess.run(command, cwd=TOP, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        fail(f"{shlex.join(command)}: {error}; build first, in a clone of the repository")


def oldest(item: Item, ages: Dict[str, Tuple[str, Age]]) -> Optional[Age]:
    """The age of what an item made; None where a file is missing or nobody knows."""
    found = [ages.get(file, (None, None))[1] for file in item.files()]
    known = [age for age in found if age is not None]
    return min(known, key=lambda age: age.date) if known and len(known) == len(found) else None


def show(items: List[Item], ages: Dict[str, Tuple[str, Age]]) -> None:
    print(f"{'item':16} {'minutes':>7}  made by")
    for item in items:
        age = oldest(item, ages)
        told = f"{age.version}, commit {age.commit}, {age.date}, {age.processor}" if age else "unknown programs"
        marks = (("due", item.due), ("idle machine", item.idle), ("by name only", item.long))
        notes = [note for note, holds in marks if holds]
        print(f"{item.name:16} {item.minutes:7g}  {told}{'; ' if notes else ''}{', '.join(notes)}")
    print(f"{'in all':16} {sum(item.minutes for item in items if not item.long):7g}  without those by name only")


def stale(items: List[Item], ages: Dict[str, Tuple[str, Age]], version: str, results: str) -> List[str]:
    """What is of another minor version or of programs with other results, or of nobody knows which, a line for each. Not of items
    that are due, of which the list says so."""
    lines = []
    for item in items:
        files = item.files()
        if not files:
            lines.append(f"{item.name}: there is nothing of {', '.join(item.makes)}")
        for file in () if item.due else files:
            age = ages.get(file, (None, None))[1]
            if age is None:
                lines.append(f"{file}: docs/data/made-by.csv does not say by which programs it was made")
            elif minor(age.version) != minor(version):
                lines.append(f"{file}: made by version {age.version}, the programs are of {version}")
            elif age.results != results:
                lines.append(f"{file}: made by programs of commit {age.commit}, whose results were others")
    return lines


def minor(version: str) -> str:
    return ".".join(version.split(".")[:2])


def check(items: List[Item], programs: Path) -> int:
    version = output_of([str(programs / "fsi-monolithic"), "--version"]).split()[-1]
    lines = stale(items, read_ages(), version, name_of_results())
    try:
        with tempfile.TemporaryDirectory() as work:
            lines += other_results(kept_values(), values_of(programs, Path(work)))
    except (RunError, OSError, ValueError) as error:
        fail(str(error))
    for line in lines:
        print(line, file=sys.stderr)
    if lines:
        fail(f"{len(lines)} of what documents show is of other programs; run scripts/evidence.sh")
    return 0


def programs_name(programs: Path) -> str:
    """A name for what the programs are."""
    digest = hashlib.sha256()
    for path in sorted(path for path in programs.glob("fsi-*") if path.is_file()):
        digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()


def make(item: Item, programs: Path, work: Path) -> bool:
    """Whether all commands ended well. Runs of other programs in the item's folder are removed."""
    folder, of = work / item.name, work / f"{item.name}.programs"
    name = programs_name(programs)
    if not of.exists() or of.read_text(encoding="utf-8") != name:
        shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True, exist_ok=True)
    of.write_text(name, encoding="utf-8")
    log = work / f"{item.name}.log"
    with log.open("a", encoding="utf-8") as told:
        for command in item.commands:
            words = [word.format(bin=programs, work=folder) for word in shlex.split(command)]
            if words[0] == "python3":
                words[:1] = [sys.executable, "-B"]
            print(f"  {shlex.join(words)}", flush=True)
            code = subprocess.run(words, cwd=TOP, stdout=told, stderr=subprocess.STDOUT, check=False).returncode
            if code not in item.codes:
                print(f"evidence: error: {item.name}: exit code {code}; {log} tells why", file=sys.stderr)
                return False
    return True


def not_written(item: Item, since: float) -> List[str]:
    """What it should have made and has left as it was. `since`: seconds of time.time()"""
    return [file for file in item.files() if (TOP / file).stat().st_mtime < since]


def main(words: List[str]) -> int:
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("-h", "--help", action="store_true")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--work", type=Path, default=TOP / "results/evidence")
    parser.add_argument("--programs", type=Path, default=TOP / "build/release/bin")
    parser.add_argument("items", nargs="*", metavar="ITEM")
    options = parser.parse_args(words)
    if options.help:
        print(__doc__)
        return 0
    items, ages = read_items(), read_ages()
    unknown = set(options.items) - {item.name for item in items}
    if unknown:
        fail(f"'{min(unknown)}' is no item; choose of {', '.join(item.name for item in items)}")
    if options.list:
        show(items, ages)
        return 0
    programs = options.programs.resolve()
    if options.check:
        return check(items, programs)
    failed = []
    for item in items:
        now = age_of(programs)  # of each item: the first one names the results
        if options.items and item.name not in options.items:
            continue
        wanted = item is items[0] or item.due or bool(stale([item], ages, now.version, now.results))  # the short runs
        if not options.items and (item.long or not wanted):
            continue
        print(f"== {item.name}, about {item.minutes:g} min", flush=True)
        start, begun = time.monotonic(), time.time() - 1
        if not make(item, programs, options.work.resolve()):
            failed.append(item.name)
            continue
        left = not_written(item, begun)
        if left:
            print(f"evidence: error: {item.name}: no command has written {', '.join(left)}", file=sys.stderr)
            failed.append(item.name)
            continue
        age = age_of(programs)
        ages = {file: row for file, row in read_ages().items() if row[0] != item.name}
        ages.update({file: (item.name, age) for file in item.files()})
        write_ages(ages)
        ITEMS.write_text(without_due(ITEMS.read_text(encoding="utf-8"), item.name), encoding="utf-8")
        print(f"   {(time.monotonic() - start) / 60:.1f} min", flush=True)
    if failed:
        fail(f"not made: {', '.join(failed)}; what is made stays, the same command goes on")
    return 0


def fail(text: str) -> NoReturn:
    print(f"evidence: error: {text[:1000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
