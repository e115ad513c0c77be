"""One study, one folder: while a study works in a folder, no other one can have it.

The lock is that of the C++ programs, which own its rules (common/io/folder_lock.hpp): the process holds the kernel's
lock (flock) on `run.lock`, and the one line of that file names it. The test compare.folder_lock holds both against each
other."""

import errno
import fcntl
import os
import socket
import time
from contextlib import contextmanager
from pathlib import Path
from typing import Iterator

from .errors import PROGRAM, InputError, say_note

NAME = "run.lock"
# A file without text is about to get it, or to be removed. One that is locked may be so for a moment, by a look at it.
TRIES_WITHOUT_TEXT, TRIES_WITH_TEXT, PAUSE = 300, 20, 0.01  # s
ELSEWHERE = "name another folder with -o"


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Holds the lock of `folder`, which must exist, while the block runs. The lock of a process that has ended is taken
    over with a note. Raises InputError when a study works in the folder, or when the folder cannot be written."""
    path = folder / NAME
    handle = _taken(folder, path)
    try:
        yield
    finally:
        if _is_at(handle, path):
            os.unlink(path)  # before the kernel's lock is given up: waiting processes look again
        os.close(handle)


def is_left(folder: Path) -> bool:
    """Whether a process of this host has left its lock behind, which ended without a word. Changes nothing."""
    try:
        handle = os.open(folder / NAME, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    except OSError:
        return False
    try:
        holder = os.pread(handle, 4096, 0).decode("utf-8", "replace").partition("\n")[0]
        fcntl.flock(handle, fcntl.LOCK_SH | fcntl.LOCK_NB)
        return _is_of_this_host(holder) and _is_at(handle, folder / NAME)
    except OSError:
        return False
    finally:
        os.close(handle)


def _is_of_this_host(holder: str) -> bool:
    return holder.endswith(f" on host {socket.gethostname()}")


def _taken(folder: Path, path: Path) -> int:
    """Descriptor of the locked file, which names this process."""
    for tries in range(TRIES_WITHOUT_TEXT + 1):
        try:
            handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o666)
        except OSError as error:
            raise _not_written(folder, error) from None
        taken = False
        try:
            taken = _take(handle, folder, path, tries)
            if taken:
                _write_holder(handle, folder, path)
                return handle
        finally:
            if not taken:
                os.close(handle)
        time.sleep(PAUSE)
    raise _nameless(folder, path)


def _take(handle: int, folder: Path, path: Path, tries: int) -> bool:
    """One try; False when another one may succeed."""
    blocked = _is_blocked(handle, folder)
    text = os.pread(handle, 4096, 0).decode("utf-8", "replace")
    holder = text.partition("\n")[0]
    if blocked and tries < (TRIES_WITH_TEXT if text else TRIES_WITHOUT_TEXT):
        return False
    if not blocked and not _is_at(handle, path):
        return False  # removed by its owner after it was opened here
    if not blocked and not text:
        return True
    if not (", process " in holder and " on host " in holder):
        raise _nameless(folder, path)
    if blocked:
        raise InputError(folder, "", f"a run works in it ({holder})", f"wait for its end, or {ELSEWHERE}")
    if not _is_of_this_host(holder):
        problem = f"is locked by {holder}; from here it cannot be seen whether that still runs"
        raise InputError(folder, "", problem, f"if it does not, remove {path}")
    say_note(f"{folder}: took over the lock of {holder}, which has ended")
    return True


def _is_blocked(handle: int, folder: Path) -> bool:
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return False
    except OSError as error:
        if error.errno in (errno.EWOULDBLOCK, errno.EACCES):
            return True
        raise InputError(folder, "", f"cannot be locked ({error.strerror})", ELSEWHERE) from None


def _write_holder(handle: int, folder: Path, path: Path) -> None:
    try:
        os.ftruncate(handle, 0)
        os.pwrite(handle, f"{PROGRAM}, process {os.getpid()} on host {socket.gethostname()}\n".encode(), 0)
    except OSError as error:
        os.unlink(path)
        os.close(handle)
        raise _not_written(folder, error) from None


def _not_written(folder: Path, error: OSError) -> InputError:
    return InputError(folder, "", f"cannot be written ({error.strerror})", ELSEWHERE)


def _nameless(folder: Path, path: Path) -> InputError:
    problem = f"is locked, and {path} does not say by whom"
    return InputError(folder, "", problem, "if no run works in the folder, remove that file")


def _is_at(handle: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(handle), os.lstat(path))
    except OSError:
        return False
