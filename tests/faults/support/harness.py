"""What the fault harnesses share: options, counting, and the closing line.

A harness is a program NAME/NAME.py beside this folder. It makes many runs that something disturbs, judges each by one of
a few verdicts, and ends with one line of counts. Its short form runs among the tests, its full form by hand:

    python3 tests/faults/run.py NAME --programs build/release/bin --full
"""

import argparse
import collections
import json
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parents[3]
CASES = TOP / "meshes" / "artery"
NEO_HOOKEAN = CASES / "neo-hookean.toml"
DRIVERS = ("fsi-monolithic", "fsi-partitioned")
# By time, runs as short as those of the harnesses have one checkpoint, at their end.
EVERY = "output.checkpoint_every=1"


class Harness:
    """Counts verdicts. A verdict that is not among the good ones fails the harness."""

    def __init__(self, name, description, good, prepare=None):
        """`good`: verdicts that are as promised; `prepare(parser)` may add options."""
        parser = argparse.ArgumentParser(prog=name, description=description)
        parser.add_argument("--programs", type=Path, default=TOP / "build/release/bin", help="folder of the programs")
        parser.add_argument("--full", action="store_true", help="all of it; else the short form that the tests run")
        parser.add_argument("--keep", type=Path, help="keep the folders of the runs here")
        parser.add_argument("--seed", type=int, default=1, help="of random choices")
        if prepare:
            prepare(parser)
        self.name, self.good = name, tuple(good)
        self.options = parser.parse_args()
        self.counts = collections.Counter()
        self.failures = []
        self._temporary = None
        if self.options.keep:
            self.base = self.options.keep.resolve()
            self.base.mkdir(parents=True, exist_ok=True)
        else:
            self._temporary = tempfile.TemporaryDirectory(prefix=f"{name}-")
            self.base = Path(self._temporary.name)

    @property
    def full(self):
        return self.options.full

    def program(self, name):
        """Path of one of the four programs."""
        return str((self.options.programs / name).resolve())

    def count(self, verdict, what):
        """Notes the verdict on one run; `what` says which, for the list of failures."""
        self.counts[verdict] += 1
        if verdict not in self.good:
            self.failures.append(f"{verdict}: {what}")
            print(self.failures[-1], flush=True)

    def finish(self):
        """Prints the line of counts and ends the program: 0 when all verdicts are good and there are any."""
        total = sum(self.counts.values())
        parts = [f"{self.counts[verdict]} {verdict}" for verdict in self.good]
        parts += [f"{count} {verdict} (WRONG)" for verdict, count in self.counts.items() if verdict not in self.good]
        print(f"{self.name}: {total} runs: {', '.join(parts)}")
        if self._temporary:
            self._temporary.cleanup()
        sys.exit(0 if total > 0 and not self.failures else 1)


def execute(*command, timeout=120, **options):
    """Runs a command to its end with its output as text; a hang is a TimeoutExpired."""
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=timeout, **options)


def is_one_message(text, program):
    """Whether standard error holds one line `PROGRAM: error: ...` of printable characters."""
    return text.startswith(f"{program}: error: ") and text.count("\n") == 1 and text[:-1].isprintable()


def is_message(text, program):
    """Whether standard error holds such a line, behind lines of warnings or none."""
    lines = text.splitlines(keepends=True)
    errors = [line for line in lines if not (line.startswith(f"{program}: warning: ") and line[:-1].isprintable())]
    return is_one_message("".join(errors), program)


def summary(folder):
    """summary.json of a result folder, {} where there is none that can be read."""
    try:
        return json.loads((Path(folder) / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def tiny_mesh(harness, length=2):
    """A tube of a few hundred elements, made once per harness; a driver's step on it takes milliseconds."""
    file = harness.base / f"tiny-{length}.msh"
    if not file.exists():
        command = (harness.program("fsi-mesh"), "artery", "-q", "--size", 2, "--axial-size", 1, "--length", length)
        made = execute(*command, "-o", file)
        if made.returncode != 0:
            raise SystemExit(f"{harness.name}: cannot make the mesh: {made.stderr}")
    return file
