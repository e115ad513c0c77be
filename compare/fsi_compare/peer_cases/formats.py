"""Which reader takes which case."""

from pathlib import Path

from ..base.errors import InputError
from . import precice, svmultiphysics
from .model import PeerCase
from .units import Units
from .xml_file import read_xml

# By what the root of an XML says.
READERS = (svmultiphysics, precice)


def read_peer_case(path: Path, units: Units, fibre_angle: float | None, tolerance: float) -> PeerCase:
    """Reads the case of another program. Raises InputError."""
    root = read_xml(path)
    for reader in READERS:
        if reader.is_case(root):
            root.taken = True
            return reader.read_case(root, units, fibre_angle, tolerance)
    if root.name == "dolfin":
        problem = "is a mesh of dolfin, which holds no case: materials and conditions are Python of turtleFSI or VaSP"
        raise InputError(path, "", problem, "import the mesh with -o FILE.msh, and write the case file by hand")
    raise InputError(path, root.name, "is no case that ours reads", "give solver.xml of svMultiPhysics")
