"""Files that are read whole or refused, and output files that are either complete or absent."""

import json
import os
import shutil
import socket
import stat
import tempfile
import tomllib
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Callable, Iterator

from .errors import InputError

DEEPEST = 50  # levels of lists and sections; ours have five
LARGEST = 64 << 20  # bytes of a JSON or TOML file; ours have a few thousand
TEMPORARY = ".part"  # ends the names of files that are being written
ELSEWHERE = "name another folder with -o"
# Not those of Path: a name that is too long or a folder that may not be looked into is no exception.
exists, is_file, is_folder = os.path.exists, os.path.isfile, os.path.isdir


def folder(text: str) -> Path:
    """Type of options that name an output folder. Refuses an empty name, of a variable that is not set, which would be
    the folder where the program was started."""
    if not text.strip():
        raise ValueError(text)
    return Path(text)


def absolute(path: Path) -> Path:
    """The absolute path without links, where that is possible: a circle of links is left as it stands."""
    return Path(os.path.realpath(path))


def find_beside(program: Path, name: str) -> Path | None:
    """The program of this name beside another one, else the one on the path."""
    for folder in (program.parent, absolute(program).parent):
        if is_file(folder / name):
            return folder / name
    found = shutil.which(name)
    return Path(found) if found else None


def read_bytes(path: Path, missing: str, broken: str, largest: float = float("inf")) -> bytes:
    """Reads a whole regular file; others may never end. Raises InputError, with `missing` or `broken` as its remedy."""
    try:
        # Opening a pipe would wait for its other end.
        with open(path, "rb", opener=lambda name, flags: os.open(name, flags | os.O_NONBLOCK)) as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode):
                raise InputError(path, "", "is not a regular file", broken)
            if status.st_size > largest:
                raise InputError(path, "", f"has more than {largest / 2**20:g} MiB", broken)
            return file.read()
    except FileNotFoundError:
        raise InputError(path, "", "is missing", missing) from None
    except OSError as error:
        raise InputError(path, "", f"cannot be read: {error.strerror}", broken) from None
    except ValueError:
        raise InputError(path, "", "is no name of a file", missing) from None
    except MemoryError:
        raise InputError(path, "", "does not fit into memory", broken) from None


def read_text(path: Path, missing: str, broken: str, largest: float = float("inf")) -> str:
    """Like read_bytes(), as text in UTF-8."""
    try:
        return read_bytes(path, missing, broken, largest).decode("utf-8").replace("\r\n", "\n")
    except UnicodeDecodeError:
        raise InputError(path, "", "is not a text file", broken) from None


def read_json(path: Path, missing: str, broken: str) -> Any:
    text = read_text(path, missing, broken, LARGEST)
    try:
        return _plain(path, lambda: json.loads(text), broken)
    except json.JSONDecodeError as error:
        raise InputError(path, f"line {error.lineno}", f"is not JSON: {error.msg}", broken) from None
    except ValueError as error:  # a number of more digits than Python converts
        raise InputError(path, "", f"is not JSON: {error}", broken) from None


def read_object(path: Path, missing: str, broken: str) -> dict[str, Any]:
    """Reads a JSON file that holds an object. Raises InputError."""
    value = read_json(path, missing, broken)
    if not isinstance(value, dict):
        raise InputError(path, "", "is not a JSON object", broken)
    return value


def read_toml(path: Path, missing: str, broken: str) -> dict[str, Any]:
    """Reads a TOML file. Raises InputError."""
    text = read_text(path, missing, broken, LARGEST)
    try:
        found: dict[str, Any] = _plain(path, lambda: tomllib.loads(text), broken)
    except ValueError as error:
        raise InputError(path, "", f"is not TOML: {error}", "mend that line") from None
    return found


def _plain(path: Path, read: Callable[[], Any], broken: str) -> Any:
    """Refuses values so deep that a walk through them would fail, and texts that cannot be written again."""
    try:
        value = read()
    except RecursionError:
        raise InputError(path, "", f"has more than {DEEPEST} levels", broken) from None
    waiting = [(value, 0)]
    while waiting:
        entry, depth = waiting.pop()
        if depth > DEEPEST:
            raise InputError(path, "", f"has more than {DEEPEST} levels", broken)
        if isinstance(entry, dict):
            waiting += [(part, depth + 1) for pair in entry.items() for part in pair]
        elif isinstance(entry, list):
            waiting += [(part, depth + 1) for part in entry]
        elif isinstance(entry, str) and any(0xD800 <= ord(c) < 0xE000 for c in entry):
            raise InputError(path, "", f"holds a text with half a character: {entry}", broken)
    return value


def make_folder(folder: Path) -> list[Path]:
    """Creates the output folder and its parents; returns new ones, the outermost first. Raises InputError on
    failure."""
    made: list[Path] = []
    try:
        place = folder
        while not exists(place) and place != place.parent:
            made.insert(0, place)
            place = place.parent
        folder.mkdir(parents=True, exist_ok=True)
        return made
    except (FileExistsError, NotADirectoryError):
        raise InputError(folder, "--output", "is a file, not a folder", "name another folder") from None
    except OSError as error:
        remove_empty(made)
        raise InputError(folder, "--output", f"cannot be made: {error.strerror}", "name another folder") from None


def remove_empty(folders: list[Path]) -> None:
    """Removes those of `folders`, the innermost last, that hold nothing."""
    with suppress(OSError):
        for folder in reversed(folders):
            folder.rmdir()


@contextmanager
def output_folder(folder: Path) -> Iterator[Path]:
    """Makes the folder; folders that were made for nothing, since the block ended without a file, are removed."""
    made = make_folder(folder)
    try:
        yield folder
    finally:
        remove_empty(made)


@contextmanager
def together(folder: Path) -> Iterator[Path]:
    """Makes `folder` and yields a place within it for output files, which are moved into `folder` when the block has
    ended without error: all files of a report are of the same call, or none is new. Raises InputError."""
    with output_folder(folder):
        sweep(folder)
        try:
            place = Path(tempfile.mkdtemp(dir=folder, prefix=_prefix(), suffix=TEMPORARY))
        except OSError as error:
            raise InputError(folder, "--output", f"cannot be written to: {error.strerror}", ELSEWHERE) from None
        try:
            yield place
            for file in sorted(place.iterdir()):
                try:
                    os.replace(file, folder / file.name)
                except OSError as error:
                    raise _not_written(folder / file.name, error) from None
        finally:
            remove_tree(place)


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yields the path of a temporary file beside `path`, which takes its place once the block has ended without error,
    so that a reader never meets half a file."""
    temporary = None
    try:
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=_prefix(), suffix=TEMPORARY)
        os.close(handle)
        yield Path(temporary)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)  # mkstemp's files are private; these are ordinary results
        _synchronise(temporary)
        os.replace(temporary, path)
    except OSError as error:
        raise _not_written(path, error) from None
    finally:
        if temporary and os.path.lexists(temporary):
            os.unlink(temporary)


def write_text(path: Path, text: str) -> None:
    """Writes a file in UTF-8, whole or not at all. Raises InputError."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _not_written(path: Path, error: OSError) -> InputError:
    return InputError(path, "", f"cannot be written: {error.strerror or error}", ELSEWHERE)


def _synchronise(path: str) -> None:
    """Onto the disk: some systems tell only then that it is full."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def listed(folder: Path) -> list[str]:
    """Names in a folder; none where it cannot be read."""
    try:
        return sorted(os.listdir(folder))
    except OSError:
        return []


def _prefix() -> str:
    """Tells whose temporary file it is."""
    return f".{socket.gethostname()}-{os.getpid()}-"


def sweep(folder: Path) -> None:
    """Removes files in `folder` that killed calls on this machine left unfinished."""
    mine = f".{socket.gethostname()}-"
    for name in listed(folder):
        if name.startswith(mine) and name.endswith(TEMPORARY):
            process = name[len(mine) :].partition("-")[0]
            if not os.path.exists(f"/proc/{process}"):
                remove_tree(folder / name)


def remove_tree(path: Path) -> None:
    """Removes a file, a link or a folder with its contents, as far as possible. The next write there reports the
    rest."""
    with suppress(OSError):
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)
