"""SIGINT (Ctrl-C), SIGTERM and SIGHUP: noted when they come, and acted upon where nothing is left half done.

An exception out of a signal's handler can strike anywhere, in the middle of an import or of a callback that swallows
it. So the handler only makes a note. What takes long asks for it by `check`; a second signal ends the program at once.
"""

import os
import signal
import threading
from contextlib import contextmanager
from typing import Callable, Iterator

WATCHED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

_noted: list[int] = []
_last_words: list[Callable[[], None]] = []  # what must still be done when a second signal ends the program


class Interrupted(BaseException):
    """Where the work ends after a signal."""

    def __init__(self, number: int) -> None:
        self.number = number
        super().__init__(signal.Signals(number).name)

    @property
    def code(self) -> int:
        """Exit code as shells have it: 130 after SIGINT, 143 after SIGTERM, 129 after SIGHUP."""
        return 128 + self.number


def check() -> None:
    """Raises Interrupted when a signal has come."""
    if _noted:
        raise Interrupted(_noted[0])


def noted() -> bool:
    return bool(_noted)


def _note(number: int, frame: object) -> None:
    if _noted:
        for last in _last_words:
            last()
        os._exit(128 + number)
    _noted.append(number)


@contextmanager
def watched(to_the_end: bool = False) -> Iterator[None]:
    """Notes signals while the block runs, then restores the handlers. `to_the_end`: they are ignored afterwards, since
    they come too late. A signal that was ignored stays ignored, as `nohup` asks for. Signals that the launcher held
    back until here are let through."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before: dict[int, object] = {}
    for watched_number in WATCHED:
        if signal.getsignal(watched_number) is not signal.SIG_IGN:
            before[watched_number] = signal.signal(watched_number, _note)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, WATCHED)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, signal.SIG_IGN if to_the_end else handler)  # type: ignore[arg-type]
        _noted.clear()


@contextmanager
def at_sudden_end(act: Callable[[], None]) -> Iterator[None]:
    """While the block runs a second signal calls `act` before it ends the program."""
    _last_words.append(act)
    try:
        yield
    finally:
        _last_words.remove(act)
