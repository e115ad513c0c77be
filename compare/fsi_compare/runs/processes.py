"""Programs as processes, one or several at once, none of which outlives fsi-compare."""

import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass
from typing import Callable, Dict, IO, Iterable, List, NoReturn, Optional, Sequence, Tuple

POLL = 0.1  # s


@dataclass(frozen=True)
class End:
    code: int
    message: str  # the last line of the error output, or what else is known about a bad end
    seconds: float
    out_of_time: bool = False


@dataclass(frozen=True)
class Job:
    key: int
    command: Sequence
    time_limit: float = float("inf")  # s


def execute(command: Sequence, tick: Callable[[], None] = lambda: None) -> End:
    """Runs one program to its end, calling `tick` about once a second."""
    ends: List[End] = []
    run_jobs([Job(0, command)], 1, lambda key, end: ends.append(end), lambda running: tick() if running else None)
    return ends[0]


def run_jobs(
    jobs: Iterable[Job],
    at_once: int,
    ended: Callable[[int, End], None],
    tick: Callable[[Sequence[int]], None] = lambda running: None,
) -> None:
    """Runs all, calling `ended` after each and `tick` with the keys of those that run, about once a second. When
    fsi-compare is interrupted or asked to end, so are they. A program that cannot be started ends with code 1."""

    def stop(*_: object) -> NoReturn:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, stop)
    running: Dict[int, Tuple[Job, subprocess.Popen, IO[bytes], float]] = {}
    waiting = iter(jobs)
    try:
        job: Optional[Job] = next(waiting, None)
        ticked = time.monotonic()
        while running or job is not None:
            while job is not None and len(running) < at_once:
                try:
                    process, said, start = _start(job)
                    running[job.key] = (job, process, said, start)
                except OSError as error:
                    ended(job.key, End(1, f"{job.command[0]} cannot be started: {error.strerror}", 0.0))
                job = next(waiting, None)
            for key in list(running):
                entry, process, said, start = running[key]
                seconds = time.monotonic() - start
                late = seconds > entry.time_limit
                if process.poll() is None and not late:
                    continue
                _finish(process)
                del running[key]
                said.seek(0)
                text = said.read().decode("utf-8", "replace")
                said.close()
                message = f"stopped after {entry.time_limit:g} s" if late else message_of(process.returncode, text)
                ended(key, End(process.returncode, message, seconds, late))
            if time.monotonic() - ticked > 1:
                ticked = time.monotonic()
                tick(list(running))
            if running:
                time.sleep(POLL if min(time.monotonic() - r[3] for r in running.values()) > 2 else 0.01)
    finally:
        for _, process, said, _ in running.values():
            _finish(process)
            said.close()
        signal.signal(signal.SIGTERM, before)


def _start(job: Job) -> Tuple[subprocess.Popen, IO[bytes], float]:
    """The process, what it says on its error output, and when it began."""
    said = tempfile.TemporaryFile()
    try:
        process = subprocess.Popen(
            [str(word) for word in job.command], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=said
        )
    except OSError:
        said.close()
        raise
    return process, said, time.monotonic()


def _finish(process: subprocess.Popen) -> None:
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            process.kill()
    process.wait()


def message_of(code: int, said: str) -> str:
    """Why a program ended, from what it said on its error stream; empty when it ended well. Warnings are no reason."""
    lines = [line.strip() for line in said.splitlines() if line.strip() and ": warning: " not in line]
    if code < 0:
        try:
            name = signal.Signals(-code).name
        except ValueError:
            name = str(-code)
        return f"ended by signal {name}" + (", perhaps for want of memory" if name == "SIGKILL" else "")
    if not lines:
        return f"ended with code {code} without a message" if code else ""
    head, mark, rest = lines[-1].partition(": error: ")
    return rest if mark and " " not in head else lines[-1]
