"""One run with a mutated input: what it is given, and the judgement of how it ended."""

import math
import os
import re
import resource
import signal
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

GOOD = ("refused", "ran", "not converged", "stopped")
SANITIZER = re.compile(r"(Address|Leak|Thread|UndefinedBehavior)Sanitizer|runtime error:")
STOP_AFTER, KILL_AFTER = 20, 90  # s; of a run that has much to do, and of one that does not listen
MEMORY = 3 << 30  # bytes of addresses; sanitizers need more and have no limit


@dataclass
class Trial:
    """A command in a folder of its own. Its arguments name its files by their names."""

    name: str
    program: str
    arguments: list
    files: dict = field(default_factory=dict)  # name -> bytes
    culprits: tuple = ()  # a refusal has to name one of these: the file, or the option
    keyed: bool = False  # a refusal has to name a key, too: FILE: KEY: PROBLEM
    pipe: str = ""  # the name of a pipe that nobody writes to


def run(trial, program, folder, sanitized=False):
    """Makes the run in `folder` and returns (verdict, how it can be seen)."""
    folder.mkdir(parents=True)
    for name, content in trial.files.items():
        (folder / name).write_bytes(content)
    if trial.pipe:
        os.mkfifo(folder / trial.pipe)
    environment = {**os.environ, "UBSAN_OPTIONS": "print_stacktrace=1", "ASAN_OPTIONS": "detect_leaks=0"}
    environment.pop("OMP_NUM_THREADS", None)

    def limit():
        if not sanitized:
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    process = subprocess.Popen(
        [program, *trial.arguments],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        preexec_fn=limit,
    )
    stopped = False
    try:
        _, error = process.communicate(timeout=STOP_AFTER)
    except subprocess.TimeoutExpired:
        stopped = True
        process.send_signal(signal.SIGTERM)
        try:
            _, error = process.communicate(timeout=KILL_AFTER)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return "hang", "no answer to SIGTERM"
    return judged(trial, process.returncode, error.decode(errors="replace"), folder, stopped)


def judged(trial, code, error, folder, stopped):
    tail = error.strip()[-400:]
    if SANITIZER.search(error):
        return "sanitizer report", error.strip()[:1500]
    if stopped and not (folder / "out" / "summary.json").exists():
        return "hang", "before the first step"
    if stopped and code in (143, -signal.SIGTERM, 0, 2):
        return "stopped", ""
    if code not in (0, 1, 2):
        return f"exit {code}", tail
    lines = [line for line in error.splitlines() if not line.startswith(f"{trial.program}: warning: ")]
    if code == 0:
        if lines:
            return "ran with words on the error stream", tail
        strange = not_finite(folder)
        return ("ran", "") if not strange else ("result is no number", strange)
    if len(lines) != 1 or not lines[0].startswith(f"{trial.program}: ") or not lines[0].isprintable():
        return "not one message", tail
    if len(lines[0]) > 2000:
        return "message too long", lines[0][:200]
    if code == 2:
        return "not converged", ""
    if trial.culprits and not any(culprit in lines[0] for culprit in trial.culprits):
        return "names no file", tail
    if trial.keyed and not names_key(lines[0]):
        return "names no key", tail
    out = folder / "out"
    if out.exists() and any(out.iterdir()):
        return "refused, but files are left", tail
    return "refused", ""


def names_key(line):
    """PROGRAM: error: FILE[:LINE]: KEY: PROBLEM, or a problem that names a section: no [time]."""
    return (
        re.search(r"(\.toml|\.msh|/etc/passwd)(:\d+)?: [$\w][^:]*: ", line)
        or re.search(r"\[[a-z]+\]", line)
        or "--set: " in line
    )


def not_finite(folder):
    """The first number of a result that is none."""
    for file in sorted((Path(folder) / "out").glob("*.csv")):
        with open(file, encoding="utf-8") as stream:
            next(stream, None)
            for row, line in enumerate(stream, 2):
                for cell in line.rstrip("\n").split(","):
                    if cell and not math.isfinite(float(cell)):
                        return f"{file.name}, line {row}: {cell}"
    return ""
