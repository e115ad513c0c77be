"""One study, one folder: while a study works in a folder, no other one can have it.

The file `run.lock` is that of the C++ programs (common/io/folder_lock.cpp): it names program, host and process, and the
process holds the kernel's lock (flock) on it, which vanishes with the process, however it ends.
"""

import errno
import fcntl
import os
import socket
import time
from contextlib import contextmanager
from pathlib import Path
from typing import Dict, Iterator

from ..base.errors import PROGRAM, InputError, say_note

NAME = "run.lock"
TRIES, PAUSE = 300, 0.01  # s; another study may be about to write its name, or to remove the file
WAIT = "wait for its end, or name another folder with -o"


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
            os.unlink(path)  # before the kernel's lock is given up: whoever waits for it looks again
        os.close(handle)


def _taken(folder: Path, path: Path) -> int:
    """Descriptor of the locked file."""
    for _ in range(TRIES):
        try:
            handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o666)
        except OSError as error:
            raise _not_written(folder, error) from None
        try:
            if _take(handle, folder, path):
                return handle
        except BaseException:
            os.close(handle)
            raise
        os.close(handle)
        time.sleep(PAUSE)
    raise _nameless(folder, path)


def _take(handle: int, folder: Path, path: Path) -> bool:
    """One try; False when it is worth another."""
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        blocked = False
    except OSError as error:
        if error.errno not in (errno.EWOULDBLOCK, errno.EACCES):
            raise InputError(
                folder, "", f"cannot be locked ({error.strerror})", "name another folder with -o"
            ) from None
        blocked = True
    said = os.pread(handle, 4096, 0).decode("utf-8", "replace")
    holder = _parsed(said)
    if blocked:
        if not holder:
            return False
        raise InputError(folder, "", f"a run works in it ({_name(holder)})", WAIT)
    if not _is_at(handle, path):
        return False  # removed by its owner after it was opened here
    if said and not holder:
        raise _nameless(folder, path)
    if holder:
        if holder["host"] != socket.gethostname():
            problem = f"is locked by {_name(holder)}; from here it cannot be seen whether that still runs"
            raise InputError(folder, "", problem, f"if it does not, remove {path}")
        if _runs(holder):  # on a file system whose locks are known to one host only
            raise InputError(folder, "", f"a run works in it ({_name(holder)})", WAIT)
        say_note(f"{folder}: took over the lock of {_name(holder)}, which has ended")
    text = f"program {PROGRAM}\nhost {socket.gethostname()}\nprocess {os.getpid()}\nstart {start_of(os.getpid())}\n"
    try:
        os.ftruncate(handle, 0)
        os.pwrite(handle, f"{text}boot {_boot()}\n".encode(), 0)
    except OSError as error:
        os.unlink(path)
        raise _not_written(folder, error) from None
    return True


def _nameless(folder: Path, path: Path) -> InputError:
    return InputError(
        folder, "", f"is locked, and {path} does not say by whom", "if no run works in the folder, remove that file"
    )


def _not_written(folder: Path, error: OSError) -> InputError:
    return InputError(folder, "", f"cannot be written ({error.strerror})", "name another folder with -o")


def _is_at(handle: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(handle), os.lstat(path))
    except OSError:
        return False


def _parsed(text: str) -> Dict[str, str]:
    """Entries of a lock; empty: it says not whose it is."""
    entries = dict(line.split(" ", 1) for line in text.splitlines() if " " in line)
    known = all(key in entries for key in ("program", "host", "process", "start"))
    return entries if known and entries["process"].isdigit() else {}


def _name(holder: Dict[str, str]) -> str:
    return f"{holder['program']}, process {holder['process']} on host {holder['host']}"


def _runs(holder: Dict[str, str]) -> bool:
    """Whether the process is there, and no later one of the same number. This process's own, since a lock of it would
    block, is a leftover."""
    started = start_of(int(holder["process"]))
    return holder.get("boot", _boot()) == _boot() and started > 0 and holder["start"] == str(started)


def _boot() -> str:
    """The kernel's name for the time since the host was started."""
    try:
        return Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
    except OSError:
        return ""


def start_of(process: int) -> int:
    """When a process was started, in ticks since the host was (proc(5), field 22); 0: it has ended."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()
    except OSError:
        return 0
    return 0 if fields[0] in ("Z", "X") else int(fields[19])
