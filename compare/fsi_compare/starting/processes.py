"""Programs as processes, one or several at once, none of which outlives fsi-compare."""

import ctypes
import os
import signal
import subprocess
import threading
import time
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Callable, IO, Iterable, Iterator, Sequence

from ..base import interruption
from .launch import without_chatter

POLL = 0.1  # s
GRACE = 10.0  # s that a program has to end the step in progress when it is asked to end
PR_SET_PDEATHSIG = 1  # prctl(2)

_libc = ctypes.CDLL(None, use_errno=True)


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


@dataclass
class _Running:
    job: Job
    process: subprocess.Popen
    said: IO[bytes]  # its error output
    start: float  # s, later by the time in which it was stopped


def execute(command: Sequence) -> End:
    """Runs one program to its end."""
    ends: list[End] = []
    run_jobs([Job(0, command)], 1, lambda key, end: ends.append(end))
    return ends[0]


def run_jobs(
    jobs: Iterable[Job],
    at_once: int,
    ended: Callable[[int, End], None],
    tick: Callable[[Sequence[int]], None] = lambda running: None,
) -> None:
    """Runs all, calling `ended` after each and `tick` with the keys of those that run, about once a second. When
    fsi-compare is interrupted, it ends them and raises Interrupted. A program that cannot be started ends with code
    1."""
    running: dict[int, _Running] = {}
    waiting = iter(jobs)
    with interruption.at_sudden_end(lambda: _kill(running)), _stopped_together(running):
        try:
            interruption.check()
            job: Job | None = next(waiting, None)
            ticked = time.monotonic()
            while running or job is not None:
                while job is not None and len(running) < at_once:
                    try:
                        running[job.key] = _start(job)
                    except (OSError, ValueError, subprocess.SubprocessError) as error:
                        why = getattr(error, "strerror", None) or str(error)
                        ended(job.key, End(1, f"{job.command[0]} cannot be started: {why}", 0.0))
                    job = next(waiting, None)
                    interruption.check()
                for key in list(running):
                    entry = running[key]
                    seconds = time.monotonic() - entry.start
                    late = seconds > entry.job.time_limit
                    if entry.process.poll() is None and not late:
                        continue
                    _finish([entry.process])
                    if interruption.noted():  # a signal to all processes of a group may have ended it
                        break
                    del running[key]
                    text = _all_said(entry.said)
                    message = f"stopped after {entry.job.time_limit:g} s" if late else ""
                    message = message or message_of(entry.process.returncode, text)
                    ended(key, End(entry.process.returncode, message, seconds, late))
                interruption.check()
                if time.monotonic() - ticked > 1:
                    ticked = time.monotonic()
                    tick(list(running))
                if running:
                    time.sleep(POLL if min(time.monotonic() - r.start for r in running.values()) > 2 else 0.01)
        finally:
            _finish([entry.process for entry in running.values()])
            for entry in running.values():
                entry.said.close()


def _start(job: Job) -> _Running:
    said = os.fdopen(os.memfd_create("error output"), "w+b")
    try:
        return _Running(job, _process(job.command, stdout=subprocess.DEVNULL, stderr=said), said, time.monotonic())
    except BaseException:
        said.close()
        raise


def _process(command: Sequence, **streams: Any) -> subprocess.Popen:
    """Starts a process in a group of its own (Python 3.11): Ctrl-C comes to fsi-compare alone, which passes it on."""
    words = [str(word) for word in command]
    ended_with_us = _die_with(os.getpid())
    return subprocess.Popen(words, stdin=subprocess.DEVNULL, process_group=0, preexec_fn=ended_with_us, **streams)


def _die_with(parent: int) -> Callable[[], None]:
    """A function for the new process, which lets it be killed when fsi-compare is, however that happens."""

    def prepare() -> None:
        _libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
        if os.getppid() != parent:  # too late
            os._exit(1)

    return prepare


def _all_said(said: IO[bytes]) -> str:
    said.seek(0)
    text = said.read().decode("utf-8", "replace")
    said.close()
    return text


def _finish(processes: Sequence[subprocess.Popen]) -> None:
    """Asks those that run to end, and kills those that do not in time."""
    for process in processes:
        if process.poll() is None:
            process.terminate()
            process.send_signal(signal.SIGCONT)
    latest = time.monotonic() + GRACE
    for process in processes:
        try:
            process.wait(timeout=max(0.0, latest - time.monotonic()))
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _kill(running: dict[int, _Running]) -> None:
    for entry in list(running.values()):
        entry.process.kill()


@contextmanager
def _stopped_together(running: dict[int, _Running]) -> Iterator[None]:
    """Stops the programs with Ctrl-Z, since they are in groups of their own; the pause does not count as their time."""
    if threading.current_thread() is not threading.main_thread() or signal.getsignal(signal.SIGTSTP) != signal.SIG_DFL:
        yield
        return

    def stop(number: int, frame: Any) -> None:
        entries = list(running.values())
        for entry in entries:
            entry.process.send_signal(signal.SIGSTOP)
        begin = time.monotonic()
        os.kill(os.getpid(), signal.SIGSTOP)
        for entry in entries:
            entry.start += time.monotonic() - begin
            entry.process.send_signal(signal.SIGCONT)

    signal.signal(signal.SIGTSTP, stop)
    try:
        yield
    finally:
        signal.signal(signal.SIGTSTP, signal.SIG_DFL)


def answer(command: Sequence, time_limit: float) -> str:
    """A program's standard output. Raises OSError where it cannot be started or does not end in time."""
    with os.fdopen(os.memfd_create("output"), "w+b") as said:
        process = _process(command, stdout=said, stderr=subprocess.DEVNULL)
        latest = time.monotonic() + time_limit
        try:
            while process.poll() is None:
                interruption.check()
                if time.monotonic() > latest:
                    raise OSError(None, f"no answer in {time_limit:g} s")
                time.sleep(0.005)
        finally:
            if process.poll() is None:
                process.kill()
            process.wait()
        said.seek(0)
        return said.read(1 << 20).decode("utf-8", "replace")


def message_of(code: int, said: str) -> str:
    """Why a program ended, from what it said on its error stream; empty when it ended well. Warnings are no reason."""
    lines = [line.strip() for line in without_chatter(said).splitlines() if line.strip()]
    lines = [line for line in lines if ": warning: " not in line and ": note: " not in line]
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
