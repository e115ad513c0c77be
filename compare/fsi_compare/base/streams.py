"""Standard input, output and error output: there, whatever the caller has closed, and honest about what was lost."""

import io
import os
import sys
from contextlib import contextmanager
from typing import Any, Iterator

from .errors import InputError


class ReaderLeft(Exception):
    """Nobody reads the output any more, e.g. `head`, which has seen enough."""


def take_descriptors() -> None:
    """Descriptors 0 to 2 that the caller closed are opened on /dev/null, so that no result file gets their number and
    with it what libraries and programs print."""
    for number in (0, 1, 2):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # the lowest free number, which is this one
    for name in ("stdin", "stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "r" if name == "stdin" else "w"))


class _Output(io.TextIOBase):
    """Passes text on. Characters that the encoding cannot write become escapes. A failed write is an InputError on the
    output; on the error output the text is dropped, since nothing is left to report to."""

    def __init__(self, inner: Any, errors: bool) -> None:
        self._inner, self._errors, self._lost = inner, errors, False

    def write(self, text: str) -> int:
        if not self._lost:
            try:
                try:
                    self._inner.write(text)
                except UnicodeEncodeError as error:
                    self._inner.write(text.encode(error.encoding, "backslashreplace").decode(error.encoding))
            except OSError as error:
                self._fail(error)
        return len(text)

    def flush(self) -> None:
        if not self._lost:
            try:
                self._inner.flush()
            except OSError as error:
                self._fail(error)

    def isatty(self) -> bool:
        return bool(self._inner.isatty())

    def fileno(self) -> int:
        return int(self._inner.fileno())

    def _fail(self, error: OSError) -> None:
        self._lost = True
        try:
            # What the stream still holds would fail again at the program's end.
            os.dup2(os.open(os.devnull, os.O_WRONLY), self._inner.fileno())
        except (OSError, ValueError):
            pass
        if self._errors:
            return
        if isinstance(error, BrokenPipeError):
            raise ReaderLeft from None
        problem = f"cannot be written: {error.strerror}"
        raise InputError("standard output", "", problem, "the files named by -o are complete") from None


@contextmanager
def guarded() -> Iterator[None]:
    """While the block runs sys.stdout and sys.stderr are guarded."""
    take_descriptors()
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = _Output(sys.stdout, False), _Output(sys.stderr, True)  # type: ignore[assignment]
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before
