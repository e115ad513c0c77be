"""A short run that is made again and again, each time disturbed in another way, and judged."""

import os
import shlex
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from harness import NEO_HOOKEAN, execute, is_one_message
from finished_results import difference

CONTINUE = "then continue by: "
TEMPORARY = ".tmp"


@dataclass(frozen=True)
class Call:
    """A call on a file of the result folder, as the preloaded library noted it."""

    number: int
    kind: str
    size: int
    name: str

    def __str__(self):
        return f"call {self.number} ({self.kind} {self.name})"


class Scenario:
    """`settings` go to the case; `prepare(folder)` may put something into the result folder before each run."""

    def __init__(self, harness, program, name, settings, prepare=None, only_message=False):
        """`only_message`: a refused run has lost a file that it needs, so that it cannot be continued."""
        self.harness, self.program, self.name = harness, program, f"{program} {name}"
        self.prepare, self.only_message = prepare, only_message
        self.command = [harness.program(program), NEO_HOOKEAN, "-q", "--threads", "1"]
        for setting in settings:
            self.command += ["--set", setting]
        self.base = harness.base / self.name.replace(" ", "-")
        self.base.mkdir()
        self.library = (harness.options.programs.parent / "tests/faults/preload/libfsi_failing_calls.so").resolve()
        if not self.library.exists():
            raise SystemExit(f"{harness.name}: {self.library} is missing; build the target fsi_failing_calls")
        self.reference = self.folder("reference")
        self.undisturbed = self.start(self.reference)

    def folder(self, name):
        """A result folder for a run, prepared."""
        folder = self.base / name
        if self.prepare:
            self.prepare(folder)
        return folder

    def options(self, folder):
        """Further words of the command for a run into this folder."""
        return ("-o", folder)

    def start(self, folder, disturbance=None, **options):
        """Runs the program into a folder. `disturbance`: settings of the preloaded library, without their prefix."""
        environment = dict(os.environ)
        if disturbance is not None:
            environment["LD_PRELOAD"] = str(self.library)
            environment["FSI_FAULT_FOLDER"] = str(folder)
            for key, value in disturbance.items():
                environment[f"FSI_FAULT_{key}"] = str(value)
        return execute(*self.command, *self.options(folder), env=environment, **options)

    def calls(self):
        """The calls of a run that nothing disturbs."""
        folder, log = self.folder("counted"), self.base / "calls.txt"
        self.start(folder, {"LOG": log})
        found = []
        for line in log.read_text(encoding="utf-8").splitlines():
            number, kind, size, name = line.split(" ", 3)
            found.append(Call(int(number), kind, int(size), Path(name).name if name != str(folder) else "folder"))
        if not self.prepare:
            self.require_all_seen(folder, found)
        shutil.rmtree(folder)
        return found

    def require_all_seen(self, folder, calls):
        """Nothing is written past the library: the bytes of every file have come by, of fields.h5 most, as it has gaps."""
        for file in folder.iterdir():
            seen = sum(c.size for c in calls if c.name in (file.name, file.name + TEMPORARY) and "write" in c.kind)
            if seen < file.stat().st_size * (0.5 if file.suffix == ".h5" else 1):
                raise SystemExit(f"{self.name}: the library has seen {seen} bytes of {file}")

    def judge(self, what, disturbance=None, before=None, after=None, **options):
        """Runs disturbed and counts the verdict. `before(folder)` makes the disk small, say; `after(folder)` makes room."""
        name = "".join(c if c.isalnum() else "-" for c in what)
        folder = self.folder(name)
        if before:
            before(folder)
        try:
            run = self.start(folder, disturbance, **options)
            verdict = self.verdict(run, folder, after)
        except subprocess.TimeoutExpired:
            verdict = "hangs"
        if after:
            after(folder, gone=True)
        word, _, detail = verdict.partition(": ")
        self.harness.count(word, f"{self.name}: {what}{': ' if detail else ''}{detail}")
        if not self.harness.options.keep:
            shutil.rmtree(folder, ignore_errors=True)

    def beyond_warnings(self, said):
        """What a run says but for the warnings of the undisturbed one: those are of the case, not of the disk."""
        known = {line for line in self.undisturbed.stderr.splitlines() if ": warning: " in line}
        return "".join(line for line in said.splitlines(keepends=True) if line.rstrip("\n") not in known)

    def verdict(self, run, folder, after):
        """The verdict on a disturbed run, with details behind ": "."""
        if run.returncode < 0:
            return f"ended by signal {-run.returncode}"
        if run.returncode == 0:
            wrong = difference(folder, self.reference)
            return f"wrong with exit 0: {wrong}" if wrong else "unharmed"
        if not is_one_message(self.beyond_warnings(run.stderr), self.program):
            return f"no single message: {run.stderr[:300]!r}"
        if run.returncode == self.undisturbed.returncode == 2:
            told = self.undisturbed.stderr.split(" [")[0]
            return "unharmed" if run.stderr.startswith(told) else f"hides the failure: {run.stderr}"
        if run.returncode != 1:
            return f"exit {run.returncode}: {run.stderr}"
        left = [file.name for file in folder.glob("*" + TEMPORARY)]
        if left:
            return f"leaves a temporary file: {left[0]}"
        if self.undisturbed.returncode != 0 or self.only_message:
            return "refused"
        if after:
            after(folder)
        return self.verdict_on_going_on(run.stderr, folder)

    def verdict_on_going_on(self, message, folder):
        """Does what the message says, undisturbed now, and compares."""
        if CONTINUE in message:
            words = shlex.split(message[message.index(CONTINUE) + len(CONTINUE) :])
            again = execute(self.harness.program(words[0]), *words[1:])
        else:
            again = execute(*self.command, *self.options(folder), "--force")
        if again.returncode != 0:
            return f"not restartable: {again.stderr.strip()!r} after {message.strip()!r}"
        wrong = difference(folder, self.reference)
        return f"goes on to other results: {wrong}" if wrong else "refused"
