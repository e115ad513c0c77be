"""Signals at any moment: a run ends after the step in progress, or before it has written anything, and can be continued
to the bits of one that nobody interrupted."""

import os
import random
import shutil
import signal
import subprocess
import time

from harness import DRIVERS, EVERY, NEO_HOOKEAN, Harness, summary, tiny_mesh
from results import broken_tables, differences

SIGNALS = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129}
STEPS = 30
LONG = 3000  # more than are made before the signal
MONOLITHIC = DRIVERS[0]
LINEAR_STUDY = "fsi-linear-study"


class Signals:
    def __init__(self, harness):
        self.harness, self.base = harness, harness.base
        self.random = random.Random(harness.options.seed)
        self.mesh = tiny_mesh(harness)
        self.number = 0
        self.reference, self.seconds = {}, {}

    def fresh(self):
        self.number += 1
        return self.base / f"folder {self.number}"

    def command(self, program, folder, *options, steps=STEPS):
        words = [self.harness.program(program), NEO_HOOKEAN, "-q", "--threads", 1, "-o", folder, *options]
        for setting in (f"mesh.file={self.mesh}", f"time.end={0.125 * steps}", "partitioned.tolerance=1e-2", EVERY):
            words += ["--set", setting]
        return [str(word) for word in words]

    def start(self, *command, ignored=()):
        def prepare():
            for number in SIGNALS:
                signal.signal(number, signal.SIG_IGN if number in ignored else signal.SIG_DFL)

        words = [str(word) for word in command]
        return subprocess.Popen(
            words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.base, preexec_fn=prepare
        )

    def end(self, process):
        _, errors = process.communicate(timeout=200)
        return process.returncode, errors

    def wait_until_it_watches(self, process):
        """Until the program has got through its loader and handles signals (proc(5), SigCgt)."""
        last = list(SIGNALS)[-1]
        while process.poll() is None:
            try:
                status = open(f"/proc/{process.pid}/status", encoding="ascii").read()
            except OSError:
                return
            caught = next((line for line in status.splitlines() if line.startswith("SigCgt:")), "SigCgt: 0")
            if int(caught.split()[1], 16) >> (last - 1) & 1:
                return
            time.sleep(0.001)

    def reference_of(self, program):
        """An uninterrupted run, and how long it takes."""
        if program not in self.reference:
            folder = self.base / f"reference-{program}"
            begin = time.monotonic()
            code, errors = self.end(self.start(*self.command(program, folder)))
            if code != 0:
                raise SystemExit(f"the reference ends with {code}: {errors}")
            self.reference[program], self.seconds[program] = folder, time.monotonic() - begin
        return self.reference[program]

    def verdict_of_run(self, program, folder, number, code, errors):
        """How a run ended that was sent a signal: a good verdict, or what is wrong."""
        if code == 0:
            return "done" if errors == "" and summary(folder).get("status") == "done" else "says nothing true"
        if code == -number:  # before the program could begin, in the loader
            return "before its start" if not folder.exists() and errors == "" else "died"
        if code != SIGNALS[number]:
            return f"exit {code}"
        if errors.count("\n") != 1 or not errors.startswith(f"{program}: interrupted "):
            return "no single message"
        if not folder.exists():
            return "nothing written" if "before the first step" in errors else "wrong message"
        if summary(folder).get("status") != "interrupted" or (folder / "run.lock").exists():
            return "status or lock is wrong"
        steps = summary(folder)["totals"]["steps"]
        rows = (folder / "iterations.csv").read_text().count("\n") - 1
        if broken_tables(folder) or rows != steps or (f"after step {steps} " in errors) != (steps > 0):
            return "tables or message wrong"
        return "interrupted"

    def at_moments(self, program, moments, numbers):
        """A signal after a share of the run's time; what was interrupted is continued to its end."""
        reference = self.reference_of(program)
        for moment in moments:
            for number in numbers:
                folder = self.fresh()
                process = self.start(*self.command(program, folder))
                if moment > 0:
                    self.wait_until_it_watches(process)
                time.sleep(moment * self.seconds[program])
                process.send_signal(number)
                code, errors = self.end(process)
                verdict = self.verdict_of_run(program, folder, number, code, errors)
                if verdict == "interrupted":
                    saved = (folder / "checkpoint.h5").exists()
                    options = ("--restart", folder) if saved else ()
                    after, said = self.end(self.start(*self.command(program, folder, *options)))
                    if after != 0 or said != "" or differences(folder, reference):
                        verdict = f"not continued: {after} {said} {differences(folder, reference)}"
                self.harness.count(verdict, f"{program}, {number.name} at {moment:.2f}: exit {code}, {errors!r}")
                shutil.rmtree(folder, ignore_errors=True)

    def wait_for_step(self, process, folder):
        deadline = time.monotonic() + 100
        while not (folder / "checkpoint.h5").exists():
            if process.poll() is not None or time.monotonic() > deadline:
                raise SystemExit(f"the run does not begin: {process.communicate()}")
            time.sleep(0.002)

    def answered(self, program):
        """A run that shows its progress says at once that it ends, then how it ended."""
        for number, code_of in SIGNALS.items():
            folder = self.fresh()
            process = self.start(*[word for word in self.command(program, folder, steps=LONG) if word != "-q"])
            self.wait_for_step(process, folder)
            process.send_signal(number)
            code, errors = self.end(process)
            lines = errors.splitlines()
            good = code == code_of and len(lines) == 2 and summary(folder)["status"] == "interrupted"
            good &= lines[0].startswith(f"{program}: ends ") and lines[0].endswith("; once more ends now")
            good &= lines[-1].startswith(f"{program}: interrupted after step ")
            what = f"{program}, {number.name} with progress: exit {code}, {errors!r}"
            self.harness.count("interrupted" if good else "no answer", what)

    def second_signal(self, program, pairs):
        """Both come while the process is stopped, so that no step ends between them. The next run says a word."""
        for first, second in pairs:
            folder = self.fresh()
            process = self.start(*self.command(program, folder, steps=LONG))
            self.wait_for_step(process, folder)
            for number in (signal.SIGSTOP, first, second, signal.SIGCONT):
                process.send_signal(number)
            code, errors = self.end(process)
            good = -code in (first, second) and errors == "" and summary(folder)["status"] == "running"
            after, said = self.end(self.start(*self.command(program, folder, "--force")))
            good &= after == 0 and said.count("\n") == 1 and f"{program}: warning: " in said and "took over" in said
            good &= not differences(folder, self.reference_of(program))
            what = f"{program}, {first.name} and {second.name}: exit {code}, {errors!r}, then {after}, {said!r}"
            self.harness.count("ended at once" if good else "second signal", what)

    def ignored(self, program):
        """What was ignored at the start stays ignored: nohup, and SIGINT of jobs in the background of a script."""
        for number in SIGNALS:
            folder = self.fresh()
            process = self.start(*self.command(program, folder), ignored=(number,))
            self.wait_for_step(process, folder)
            process.send_signal(number)
            code, errors = self.end(process)
            good = code == 0 and errors == "" and not differences(folder, self.reference_of(program))
            self.harness.count(
                "ignored" if good else "not ignored", f"{program}, {number.name}: exit {code}, {errors!r}"
            )

    def at_the_end(self, program, count):
        """A run whose last step is done is done, whatever comes then."""
        numbers = list(SIGNALS)
        for k in range(count):
            folder = self.fresh()
            process = self.start(*self.command(program, folder, steps=2))
            while process.poll() is None and summary(folder).get("status") != "done":
                pass
            process.send_signal(numbers[k % len(numbers)])
            code, errors = self.end(process)
            good = code == 0 and errors == "" and not (folder / "run.lock").exists()
            self.harness.count("done" if good else "not done", f"{program} at its end: exit {code}, {errors!r}")

    def without_a_terminal(self, program):
        """The terminal is gone: nothing can be said any more, and the run ends in order nevertheless."""
        folder = self.fresh()
        words = [word for word in self.command(program, folder, steps=LONG) if word != "-q"]
        process = self.start("sh", "-c", 'exec "$@" >/dev/full 2>/dev/full', "sh", *words)
        self.wait_for_step(process, folder)
        process.send_signal(signal.SIGHUP)
        code, _ = self.end(process)
        good = code == 129 and summary(folder)["status"] == "interrupted" and not broken_tables(folder)
        self.harness.count("interrupted" if good else "wrong end", f"{program} without a terminal: exit {code}")

    def meshes(self, moments, numbers):
        """fsi-mesh leaves a whole file or none."""
        command = (self.harness.program("fsi-mesh"), "artery", "-q", "--size", 0.4, "--length", 6)
        begin = time.monotonic()
        whole = self.base / "whole.msh"
        self.end(self.start(*command, "-o", whole))
        seconds = time.monotonic() - begin
        for moment in moments:
            for number in numbers:
                folder = self.fresh()
                folder.mkdir()
                file = folder / "made.msh"
                process = self.start(*command, "-o", file)
                self.wait_until_it_watches(process)
                time.sleep(moment * seconds)
                process.send_signal(number)
                code, errors = self.end(process)
                left = os.listdir(folder)
                good = left == [] or (left == ["made.msh"] and file.read_bytes() == whole.read_bytes())
                good &= left == ["made.msh"] or code != 0
                if code == 0:
                    verdict = "done"
                elif code == -number:
                    verdict = "before its start"
                    good &= left == [] and errors == ""
                else:
                    verdict = "nothing written"
                    good &= code == SIGNALS[number] and errors == "fsi-mesh: interrupted\n"
                what = f"mesh, {number.name} at {moment:.2f}: exit {code}, {errors!r}, {left}"
                self.harness.count(verdict if good else "wrong mesh", what)

    def linear_systems(self, moments):
        """In place of a run: one file at the end, or none."""
        for moment in moments:
            for number, code_of in SIGNALS.items():
                folder = self.fresh()
                options = ("--systems", "30:1", "--solvers", "fast")
                process = self.start(*self.command(LINEAR_STUDY, folder, *options))
                self.wait_until_it_watches(process)
                time.sleep(moment * self.seconds[MONOLITHIC])
                process.send_signal(number)
                code, errors = self.end(process)
                left = sorted(os.listdir(folder)) if folder.exists() else []
                good = (
                    code == code_of
                    and errors.startswith(f"{LINEAR_STUDY}: interrupted before ")
                    and not folder.exists()
                )
                good |= code == 0 and errors == "" and left == ["linear_solvers.json"]
                good |= code == -number and errors == "" and left == []
                verdict = {0: "done", -number: "before its start"}.get(code, "nothing written")
                what = f"linear systems, {number.name} at {moment:.2f}: exit {code}, {errors!r}, {left}"
                self.harness.count(verdict if good else "wrong end", what)


def main():
    good = ("interrupted", "nothing written", "before its start", "done", "ended at once", "ignored")
    harness = Harness("signals", __doc__, good=good)
    signals = Signals(harness)
    numbers = list(SIGNALS)
    if harness.full:
        for program in DRIVERS:
            signals.at_moments(program, [0, 0] + [signals.random.random() for _ in range(15)], numbers)
            signals.at_moments(program, [0.2 * signals.random.random() for _ in range(10)], numbers)
            signals.answered(program)
            signals.second_signal(program, [(a, b) for a in numbers for b in numbers if a != b])
            signals.ignored(program)
            signals.at_the_end(program, 12)
            signals.without_a_terminal(program)
        signals.meshes([signals.random.random() for _ in range(15)], numbers)
        signals.linear_systems([signals.random.random() for _ in range(6)])
    else:
        signals.at_moments(MONOLITHIC, (0.05, 0.5, 0.9), numbers)
        signals.at_moments(DRIVERS[1], (0.6,), numbers[2:])
        signals.answered(MONOLITHIC)
        signals.second_signal(MONOLITHIC, [(signal.SIGTERM, signal.SIGHUP)])
        signals.ignored(MONOLITHIC)
        signals.at_the_end(MONOLITHIC, 3)
        signals.without_a_terminal(MONOLITHIC)
        signals.meshes((0.1, 0.5, 0.9), numbers[:2])
        signals.linear_systems((0.5,))
    harness.finish()


if __name__ == "__main__":
    main()
