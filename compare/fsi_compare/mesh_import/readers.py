"""Which reader takes which file."""

import contextlib
import io
from pathlib import Path
from typing import Callable, Dict

from ..base.errors import InputError
from ..base.files import exists
from .raw_mesh import RawMesh, of_meshio
from .vtu import read_vtu

# By the end of a file's name, in lower case. What meshio reads well, or reads at all, is left to it.
READERS: Dict[str, Callable[[Path], RawMesh]] = {".vtu": read_vtu}


def read_mesh(path: Path) -> RawMesh:
    """Raises InputError."""
    if not exists(path):
        raise InputError(path, "", "no such file", "give a mesh that meshio reads: VTU, MED, Exodus, ...")
    return READERS.get(path.suffix.lower(), _read_by_meshio)(path)


def _read_by_meshio(path: Path) -> RawMesh:
    try:
        import meshio  # takes a while to load
    except ImportError:
        raise InputError("meshio", "", "is not there", "install the Debian package python3-meshio") from None
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            return of_meshio(meshio.read(path))
    except (Exception, SystemExit) as error:  # meshio ends the program for a file that it does not know
        said = " ".join(str(error).split()) or type(error).__name__
        if isinstance(error, SystemExit):
            said = "unknown or damaged"
        raise InputError(path, "", f"meshio cannot read it: {said[:300]}", "save it as VTU, for one") from None
