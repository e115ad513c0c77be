"""Which reader takes which file."""

import contextlib
import io
import shlex
from pathlib import Path
from typing import Callable

from ..base.errors import InputError
from ..base.files import exists, is_file, is_folder
from .abaqus import read_abaqus
from .dolfin_hdf5 import read_dolfin_hdf5
from .dolfin_xml import read_dolfin_xml
from .exodus import read_exodus
from .med import read_med
from .raw_mesh import RawMesh, of_meshio
from .vtu import read_vtu
from .xdmf import read_xdmf

# By the end of a file's name, in lower case: what meshio reads wrongly; see the head of each module.
# What meshio reads well, or reads at all, is left to it.
READERS: dict[str, Callable[[Path], RawMesh]] = {".vtu": read_vtu, ".xdmf": read_xdmf, ".xmf": read_xdmf}
READERS |= {".med": read_med, ".inp": read_abaqus, ".h5": read_dolfin_hdf5, ".xml": read_dolfin_xml}
READERS |= dict.fromkeys((".e", ".exo", ".ex2", ".exii", ".g", ".gen"), read_exodus)
# What no reader takes, by the end of its name: what it is, and the way in.
REFUSED = {
    ".unv": ("a universal file of I-DEAS", "turn it by gmsh FILE.unv -save -o FILE.msh, or write it as MED"),
    ".neu": ("a neutral file of Gambit", "write the mesh as Exodus, Abaqus (.inp) or .vtu"),
    ".pvtu": ("a list of .vtu files", "give these, one after the other, with --join"),
    ".pvd": ("a list of .vtu files", "give the one of a time"),
    ".vtm": ("a list of files of VTK", "give the .vtu files in it"),
    ".cas": ("a case of Fluent", "write the mesh as .vtu, Exodus or MED"),
    ".frd": ("results of CalculiX", "give the deck, .inp"),
    ".feb": ("a model of FEBio", "export the mesh from FEBio Studio as .vtk or Abaqus, .inp"),
    ".vtp": ("a surface", "give the mesh of the volume first, and this as NAME=FILE.vtp"),
}
CASE = b"<svMultiPhysicsFile"  # begins an XML that is no mesh


def read_mesh(path: Path) -> RawMesh:
    """Reads a mesh in any known format. Raises InputError."""
    if not exists(path):
        raise InputError(path, "", "no such file", "give a mesh that meshio reads: VTU, MED, Exodus, ...")
    if is_folder(path):
        raise InputError(path, "", "is a folder", _way_into(path))
    if path.suffix.lower() in REFUSED:
        what, remedy = REFUSED[path.suffix.lower()]
        raise InputError(path, "", f"is {what}, which no reader takes", remedy)
    if path.suffix.lower() == ".xml" and is_file(path):
        with open(path, "rb") as file:
            if CASE in file.read(65536):
                raise InputError(path, "", "is a case of svMultiPhysics, no mesh", "give -o FOLDER, without --list")
    return READERS.get(path.suffix.lower(), _read_by_meshio)(path)


def _way_into(folder: Path) -> str:
    """What to give in place of a folder: for those of SimVascular and svMultiPhysics, which have a file for the cells
    and one for each face, the whole command."""
    cells = sorted(folder.glob("*.mesh.vtu")) or sorted(folder.glob("*.vtu"))
    if len(cells) != 1:
        return "give the files in it: fluid=LUMEN.vtu, wall=WALL.vtu and NAME=FACE.vtp for each face"
    ends = [face for face in sorted(folder.glob("mesh-surfaces/*.vtp")) if not face.stem.lower().startswith("wall")]
    words = [f"fluid={cells[0]}"] + [f"{face.stem}={face}" for face in ends]
    return f"give the files in it: fsi-mesh import {' '.join(map(shlex.quote, words))} -o {folder.name}.msh"


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
