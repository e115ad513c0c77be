"""Kills runs at random moments (SIGKILL) and goes on with what they leave.

A run is killed at its start, within a step, while a table, the fields or the checkpoint is written, or while it takes
over an earlier run's results. If it has left a checkpoint it is continued, in place or into another folder, and maybe
killed again; else it is begun anew. In the end its results must be those of a run that nothing disturbed, byte for
byte but for wall-clock seconds.
"""

import random
import shutil
import subprocess
import time
from pathlib import Path
from typing import Optional

from harness import EVERY, NEO_HOOKEAN, Harness, execute, tiny_mesh
from same_results import difference

STEPS = 8
MOST_KILLS = 3  # of one run and those that continue it
LOCK = "run.lock"  # of a running program; a kill leaves it, and the next run removes it

# Runs that differ in what they write and when.
KINDS = {
    "monolithic": ("fsi-monolithic", ["time.scheme=midpoint", "output.every=1", EVERY]),
    "monolithic, checkpoints by time": ("fsi-monolithic", ["time.scheme=midpoint", "output.every=1"]),
    "monolithic, no scheme with balances": ("fsi-monolithic", ["output.every=2", EVERY]),
    "monolithic, adaptive steps": (
        "fsi-monolithic",
        ["time.scheme=midpoint", 'time.step="adaptive"', "output.interval=0.25", EVERY],
    ),
    "monolithic, a checkpoint every third step": (
        "fsi-monolithic",
        ["time.scheme=midpoint", "output.every=1", "output.checkpoint_every=3"],
    ),
    "partitioned": ("fsi-partitioned", ["time.scheme=midpoint", "output.every=1", "partitioned.tolerance=1e-2", EVERY]),
    "partitioned, quasi-Newton over steps": (
        "fsi-partitioned",
        [
            "output.every=2",
            "partitioned.scheme=iqn-ils",
            "partitioned.reused_steps=2",
            "partitioned.tolerance=1e-2",
            EVERY,
        ],
    ),
}


class Killed:
    """A kind of run, its undisturbed results, and ways to disturb it."""

    def __init__(self, harness, kind):
        self.harness, self.kind = harness, kind
        self.program, settings = KINDS[kind]
        self.settings = [f"mesh.file={tiny_mesh(harness)}", f"time.end={0.125 * STEPS}", *settings]
        self.whole = harness.base / f"whole-{list(KINDS).index(kind)}"
        began = time.monotonic()
        done = execute(*self.command(self.whole))
        if done.returncode != 0:
            raise SystemExit(f"kills: the undisturbed run fails: {done.stderr}")
        self.seconds = time.monotonic() - began

    def command(self, folder, *options):
        words = [self.harness.program(self.program), NEO_HOOKEAN, "-q", "--threads", 1, "-o", folder, *options]
        for setting in self.settings:
            words += ["--set", setting]
        return [str(word) for word in words]

    def start_and_kill(self, choose, command, folder):
        """Returns whether the kill came before the run's end."""
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        began = time.monotonic()
        if choose.random() < 0.5:  # at any time
            delay = choose.uniform(0, 1.1 * self.seconds)
            while process.poll() is None and time.monotonic() - began < delay:
                time.sleep(0.0005)
        else:  # while a certain file is new, or is about to be replaced
            name = choose.choice(
                [
                    "checkpoint.h5.tmp",
                    "checkpoint.h5",
                    "fields.h5",
                    "fields.h5.tmp",
                    "fields.xdmf.tmp",
                    "wall.xdmf.tmp",
                    "summary.json.tmp",
                ]
                + ["iterations.csv", "flow.csv", "flow.csv.tmp", "centerline_pressure.csv", "energy.csv"]
            )
            left = choose.randrange(2 * STEPS)
            before = None
            while process.poll() is None and left >= 0 and time.monotonic() - began < 2 * self.seconds:
                try:
                    status = (folder / name).stat()
                    now = (status.st_ino, status.st_size, status.st_mtime_ns)
                except OSError:
                    now = None
                if now != before and now is not None:
                    left -= 1
                before = now
        process.kill()
        return process.wait() < 0


def contents(folder):
    """Bytes of the files of a folder by name, without a lock."""
    return {file.name: file.read_bytes() for file in folder.iterdir() if file.name != LOCK}


def judge(kind, choose, folder):
    """Kills a run, and those that continue it, until one comes to its end. Returns verdict, kills and what it was."""
    story: list[str] = []
    kills = 0
    source: Optional[Path] = None  # what is continued
    target = folder
    for attempt in range(MOST_KILLS + 1):
        options = []
        if source is not None:
            target = source if choose.random() < 0.5 else folder.with_name(f"{folder.name}-{attempt}")
            options = ["--restart", source]
            story.append("continued in place" if target == source else "continued elsewhere")
        else:
            story.append("begun")
            if folder.exists():
                options = ["--force"]  # rows without a checkpoint are worth nothing
        command = kind.command(target, *options)
        before = contents(source) if source is not None and source != target else {}
        if attempt < MOST_KILLS and (attempt == 0 or choose.random() < 0.4):
            if kind.start_and_kill(choose, command, target):
                kills += 1
                story.append("killed")
        else:
            done = execute(*command)
            if done.returncode != 0:
                return f"exit {done.returncode}", kills, f"{', '.join(story)}: {done.stderr.strip()}"
        if source is not None and before and contents(source) != before:
            return "changes what it continues", kills, ", ".join(story)
        finished = story[-1] != "killed"
        if finished:
            wrong = difference(target, kind.whole)
            return ("other bytes" if wrong else "same bytes"), kills, f"{', '.join(story)}: {', '.join(wrong[:5])}"
        if (target / "checkpoint.h5").exists():
            source = target
        elif source is not None and target != source:
            shutil.rmtree(target, ignore_errors=True)
    raise AssertionError("the last run is not killed")


def main():
    harness = Harness("kills", __doc__.splitlines()[0], good=("same bytes",))
    choose = random.Random(harness.options.seed)
    names = list(KINDS) if harness.full else ["monolithic", "partitioned", "monolithic, adaptive steps"]
    kinds = [Killed(harness, name) for name in names]
    wanted, kills, runs = (300 if harness.full else 12), 0, 0
    while kills < wanted and runs < 2 * wanted:
        kind = kinds[runs % len(kinds)]
        folder = harness.base / f"run-{runs}"
        verdict, killed, story = judge(kind, choose, folder)
        harness.count(verdict, f"run {runs}, {kind.kind}: {story}")
        kills, runs = kills + killed, runs + 1
        if verdict == "same bytes":
            for left in harness.base.glob(f"run-{runs - 1}*"):
                shutil.rmtree(left)
    print(f"kills: {kills} kills")
    if kills < wanted:
        harness.count("too few kills", f"{kills} of {wanted}")
    harness.finish()


if __name__ == "__main__":
    main()
