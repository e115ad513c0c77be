"""Mistakes in the user's input, and messages that any terminal can show."""

import sys
from pathlib import Path
from typing import Callable, TypeVar

PROGRAM = "fsi-compare"
T = TypeVar("T")
# Characters that each part may take, as in the C++ programs (common/base/error.cpp). The user's input is in the
# first three; a remedy is our own words, in which a command is meant to be pasted.
FILE_LIMIT, KEY_LIMIT, PROBLEM_LIMIT, REMEDY_LIMIT = 200, 200, 600, 2000
GAP = "..."


class InputError(Exception):
    """A mistake in a result folder or on the command line; the program prints it in one line and exits with 1.

    The message reads `FILE: KEY: PROBLEM; REMEDY`; empty parts are left out, long ones shortened.
    """

    def __init__(self, file: str | Path, key: str, problem: str, remedy: str = "") -> None:
        text = _joined(file, key, shortened(" ".join(problem.split()), PROBLEM_LIMIT))
        super().__init__(f"{text}; {shortened(' '.join(remedy.split()), REMEDY_LIMIT)}" if remedy else text)


class ProgramError(InputError):
    """Carries the message of a program, which has parts of its own, in the place of the problem."""

    def __init__(self, file: str | Path, key: str, message: str, remedy: str = "") -> None:
        text = _joined(file, key, shortened(message, FILE_LIMIT + KEY_LIMIT + PROBLEM_LIMIT + REMEDY_LIMIT))
        Exception.__init__(self, f"{text}; {remedy}" if remedy else text)


def _joined(file: str | Path, key: str, problem: str) -> str:
    parts = shortened_path(str(file), FILE_LIMIT), shortened(key, KEY_LIMIT), problem
    return ": ".join(part for part in parts if part)


def printable(text: str) -> str:
    """In one line that any terminal can show: control characters and others that show nothing become their escapes
    (\\n, \\x1b), and so do bytes of a file's name that are no UTF-8."""
    return text if text.isprintable() else "".join(c if c.isprintable() else _escape(c) for c in text)


def _escape(character: str) -> str:
    code = ord(character)
    if 0xDC80 <= code < 0xDD00:  # a byte, as Python keeps it (PEP 383)
        return f"\\x{code - 0xDC00:02x}"
    return character.encode("unicode_escape").decode("ascii")


def shortened(text: str, limit: int) -> str:
    """Printable text of at most `limit` characters: the middle of a longer one is replaced by "..."."""
    line = printable(text)
    left = limit - len(GAP)
    return line if len(line) <= limit else line[: left - left // 2] + GAP + line[-(left // 2) :]


def shortened_path(path: str, limit: int) -> str:
    """Like shortened(), for a path, whose end tells more than its beginning: the beginning is replaced."""
    line = printable(path)
    return line if len(line) <= limit else GAP + line[len(GAP) - limit :]


def say_error(text: str) -> None:
    """The one line of a program that could not do its work. When that fails, too, nothing is left to report to."""
    _tell(f"{PROGRAM}: error: {text}")


def say_note(text: str) -> None:
    """Prints a note, which is no reason to stop, on the error output."""
    _tell(f"{PROGRAM}: note: {printable(text)}")


def say_warning(text: str) -> None:
    _tell(f"{PROGRAM}: warning: {printable(text)}")


def _tell(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def loaded(load: Callable[[], T]) -> T:
    """What an import gives. Raises InputError for damaged byte code."""
    try:
        return load()
    except EOFError:  # what Python says of byte code that was cut by a full disk; none is written today
        folder = Path(__file__).parents[1]
        remedy = f"remove the folders __pycache__ in {folder}"
        raise InputError(folder, "", "byte code beside the sources is damaged", remedy) from None
