"""Programs as processes, several at once, none of which outlives fsi-compare."""

import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass
from typing import Callable, Dict, Iterable, Optional, Sequence, Tuple

from ..programs import message_of

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
    command: Sequence[str]
    time_limit: float  # s


def run_jobs(jobs: Iterable[Job], at_once: int, ended: Callable[[int, End], None],
             tick: Callable[[Sequence[int]], None] = lambda running: None) -> None:
    """Runs all, calling `ended` after each and `tick` with the keys of those that run, about once a second."""
    def stop(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, stop)
    running: Dict[int, Tuple[Job, subprocess.Popen, object, float]] = {}
    waiting = iter(jobs)
    try:
        job: Optional[Job] = next(waiting, None)
        ticked = 0.0
        while running or job is not None:
            while job is not None and len(running) < at_once:
                running[job.key] = (job, *_start(job))
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


def _start(job: Job):
    said = tempfile.TemporaryFile()
    try:
        process = subprocess.Popen([str(word) for word in job.command], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=said)
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
