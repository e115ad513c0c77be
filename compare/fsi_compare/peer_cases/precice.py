"""preCICE's configuration: it couples programs and holds neither mesh nor material. What it says of time is read; the
case itself is with the programs that it couples."""

from typing import List, Optional

from .model import PeerCase
from .units import Units
from .xml_file import Entry


def is_case(root: Entry) -> bool:
    return root.name == "precice-configuration"


def read_case(root: Entry, units: Units, fibre_angle: Optional[float] = None, tolerance: float = 0.0) -> PeerCase:
    """Raises InputError always: the configuration lacks the fluid."""
    said: List[str] = []
    participants = [entry.attribute("name") for entry in root.every() if entry.name == "participant"]
    schemes = [entry for entry in root.every() if entry.name.startswith("coupling-scheme:")]
    if participants:
        said.append(f"it couples {' and '.join(participants)}")
    for scheme in schemes[:1]:
        for name, key in (("time-window-size", "time.step"), ("max-time", "time.end")):
            found = scheme.find(name)
            if found is not None:
                value = found.attribute("value")
                try:
                    said.append(f"{key} = {float(value) * 1000:g}")
                except ValueError:
                    raise found.refuse(f"'{value}' is no number", "give a number of seconds") from None
    words = "; ".join(said) or "it couples nothing"
    remedy = "import the fluid's mesh from its program and the wall's from its deck: fsi-mesh import fluid=FILE wall=FILE.inp "
    raise root.refuse(
        f"a preCICE configuration holds neither the fluid's mesh nor a material ({words}, in seconds taken as ms * 1000)",
        remedy + "-o FILE.msh, and write the case file by hand",
    )
