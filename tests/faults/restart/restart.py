"""Asks restarts to go on with checkpoints, tables, fields, meshes and cases that are not those of the run.

A restart is right in one of two ways. It is refused: exit code 1, one message, no new folder, nothing changed in the
old one. Or it is accepted, and its results are those of a run that went through, byte for byte but for wall-clock
seconds. A restart with other settings that are allowed to differ, such as the time step, is accepted and no more is
asked.
"""

import random
import shutil

from harness import DRIVERS, NEO_HOOKEAN, Harness, execute, is_one_message, tiny_mesh
from mutations import (
    ACCEPTED,
    OTHER_CASES,
    REFUSED,
    SAME,
    Mutation,
    edited,
    field_files,
    harmless_tables,
    meshes,
    raw_checkpoints,
    sealed_checkpoints,
    tables,
)
from same_results import difference

STEP, LAST, END = 4, 6, 0.75  # the checkpoint's step, the last one, ms

# Runs that are continued: a scheme whose tables lag a step behind, one without history, adaptive steps, both drivers.
BASES = {
    "monolithic": ("fsi-monolithic", ("time.scheme=midpoint",)),
    "partitioned": ("fsi-partitioned", ("partitioned.tolerance=1e-2",)),
    "adaptive": ("fsi-monolithic", ("time.scheme=midpoint", 'time.step="adaptive"', "output.interval=0.125")),
}


class Base:
    """A run that was killed after the checkpoint of step 4: its folder holds rows and fields of later steps."""

    def __init__(self, harness, name):
        self.harness, self.name = harness, name
        self.program, settings = BASES[name]
        self.settings = (
            f"mesh.file={tiny_mesh(harness)}",
            "output.every=1",
            "output.checkpoint_every=1",
            f"time.end={END}",
            *settings,
        )
        self.whole, self.folder = harness.base / f"{name}-whole", harness.base / f"{name}-killed"
        self.run("-o", self.whole)
        shutil.copytree(self.whole, self.folder)
        self.step = STEP
        shorter = harness.base / f"{name}-short"
        # Steps of the shorter run, whose checkpoint the killed run's folder gets.
        self.run("-o", shorter, settings=(f"time.end={STEP * END / LAST}",))
        shutil.copy(shorter / "checkpoint.h5", self.folder)
        rows = (shorter / "iterations.csv").read_text().splitlines()
        self.step = int(rows[-1].split(",")[0])
        lags = "time.scheme=midpoint" in settings
        self.level = self.step - 1 if lags else self.step
        self.other = harness.base / f"{name}-other"
        self.run("-o", self.other, settings=("inlet.pressure=1.4",))
        self.before = {file.name: file.read_bytes() for file in self.folder.iterdir()}

    def command(self, *options, settings=(), program=None):
        words = [self.harness.program(program or self.program), NEO_HOOKEAN, "-q", "--threads", 1, *options]
        for setting in (*self.settings, *settings):
            words += ["--set", setting]
        return words

    def run(self, *options, settings=()):
        done = execute(*self.command(*options, settings=settings))
        if done.returncode != 0:
            raise SystemExit(f"restart: an undisturbed run fails: {done.stderr}")

    def mutations(self, choose, full):
        """All of this run, by kind."""
        refused = lambda found: [Mutation(kind, what, (REFUSED,), change) for kind, what, change in found]
        data = self.before["checkpoint.h5"]
        yield from refused(raw_checkpoints(data, choose, 30 if full else 3))
        for kind, what, change in sealed_checkpoints(self.folder / "checkpoint.h5", choose):
            yield Mutation(kind, what, (REFUSED,), edited(change))
        yield from refused(tables(self.folder, self.other, self.step, self.level, choose, 4 if full else 1))
        yield from refused(field_files(choose))
        for kind, what, change in harmless_tables(self.folder, self.step, self.level, choose):
            yield Mutation(kind, what, (SAME,), change)
        # What another coupling scheme would have kept is left aside.
        more = edited(lambda h5: h5.create_dataset("arrays/stepper.more", data=[1.0]))
        yield Mutation("left aside", "an array more of the stepper", (SAME,), more)
        # As runs of earlier versions leave it.
        less = edited(lambda h5: h5.pop("arrays/extremes"))
        said = "are those since the restart"
        yield Mutation("older run", "no extremes of the wall", (ACCEPTED,), less, warning=said)
        if self.name == "adaptive":
            return
        for what, file, expected in meshes(tiny_mesh(self.harness), self.harness.base):
            yield Mutation("mesh", what, expected, settings=(f"mesh.file={file}",))
        for expected, settings in OTHER_CASES.items():
            for setting in settings:
                yield Mutation("case " + expected, setting, (expected,), settings=(setting,))
        yield Mutation("case " + REFUSED, "the other program", (REFUSED,), other_program=True)
        yield Mutation("nothing changed", "", (SAME,))

    def judge(self, mutation, number):
        """The verdict on a restart, and what it said or did."""
        folder, target = self.harness.base / f"from-{number}", self.harness.base / f"to-{number}"
        shutil.copytree(self.folder, folder)
        if mutation.change:
            mutation.change(folder)
        read = lambda: {
            f.name: f.read_bytes() if f.is_file() else b"" for f in folder.iterdir() if f.name != "run.lock"
        }
        before = read()
        program = next(p for p in DRIVERS if p != self.program) if mutation.other_program else self.program
        in_place = mutation.expected == (REFUSED,) and number % 3 == 0
        output = () if in_place else ("-o", target)
        done = execute(*self.command("--restart", folder, *output, settings=mutation.settings, program=program))
        verdict, said = self.verdict(done, program, target, mutation), done.stderr.strip()
        if read() != before:
            verdict = "changes the old folder"
        if verdict == SAME:
            wrong = difference(target, self.whole)
            if wrong:
                verdict, said = "other bytes", ", ".join(wrong[:5])
        if verdict in mutation.expected:
            shutil.rmtree(folder)
            shutil.rmtree(target, ignore_errors=True)
        return verdict, said

    @staticmethod
    def verdict(done, program, target, mutation):
        if done.returncode == 1:
            if target.exists():
                return "refused, but leaves a folder"
            return REFUSED if is_one_message(done.stderr, program) else "refused without one message"
        if done.returncode != 0:
            return f"exit {done.returncode}"
        if mutation.warning and mutation.warning not in (target / "run.log").read_text(encoding="utf-8"):
            return "says nothing of it"
        return ACCEPTED if ACCEPTED in mutation.expected else SAME


def main():
    harness = Harness("restart", __doc__.splitlines()[0], good=(REFUSED, SAME, ACCEPTED))
    choose = random.Random(harness.options.seed)
    number = 0
    for name in BASES if harness.full else ("monolithic", "partitioned"):
        base = Base(harness, name)
        mutations = list(base.mutations(choose, harness.full))
        if not harness.full:  # one of each kind, every other kind for each driver
            choose.shuffle(mutations)
            first: dict[str, Mutation] = {}
            for mutation in mutations:
                first.setdefault(mutation.kind, mutation)
            mutations = [m for k, m in enumerate(first.values()) if name == "monolithic" or k % 3 == 0]
        for mutation in mutations:
            number += 1
            verdict, said = base.judge(mutation, number)
            wrong = verdict not in mutation.expected
            shown = f"{verdict} (expected {mutation.expected[0]})" if wrong else verdict
            harness.count(shown, f"{name}, {mutation.kind}, {mutation.what}: {said}")
    harness.finish()


if __name__ == "__main__":
    main()
