"""Output files that are either complete or absent."""

import os
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import Iterator

from .errors import InputError


def make_folder(folder: Path) -> None:
    """Creates the output folder and its parents. Raises InputError when that is not possible."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError):
        raise InputError(folder, "--output", "is a file, not a folder", "name another folder") from None
    except OSError as error:
        raise InputError(folder, "--output", f"cannot be made: {error.strerror}", "name another folder") from None


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yields the path of a temporary file beside `path`, which takes its place once the block has ended without error,
    so that a reader never meets half a file."""
    temporary = None
    try:
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.stem}-", suffix=path.suffix)
        os.close(handle)
        yield Path(temporary)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)  # mkstemp's files are private; these are ordinary results
        os.replace(temporary, path)
    except OSError as error:
        raise InputError(path, "", f"cannot be written: {error.strerror}", "name another folder with -o") from None
    finally:
        if temporary and os.path.exists(temporary):
            os.unlink(temporary)
