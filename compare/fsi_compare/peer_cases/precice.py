"""preCICE's configuration, which couples programs and holds neither mesh nor material. What it and a deck of CalculiX
beside it say is read and told; the rest of the case is with the program of the fluid, whose mesh nothing names."""

from ..base.errors import InputError
from .calculix import deck_beside, read_deck
from .units import SYSTEMS
from .xml_file import Entry


def refusal(root: Entry) -> InputError:
    """What it says, and why that is no case: the configuration has no fluid. Raises InputError for numbers that are
    none."""
    said: list[str] = []
    participants = [entry.attribute("name") for entry in root.every() if entry.name == "participant"]
    if participants:
        said.append(f"it couples {' and '.join(participants)}")
    for scheme in [entry for entry in root.every() if entry.name.startswith("coupling-scheme:")][:1]:
        for name, key in (("time-window-size", "time.step"), ("max-time", "time.end")):
            found = scheme.find(name)
            if found is not None:
                value = found.attribute("value")
                try:
                    said.append(f"{key} = {float(value) * SYSTEMS['si'].time:g}")
                except ValueError:
                    raise found.refuse(f"'{value}' is no number", "give a number of seconds") from None
    wall = "FILE.inp"
    deck = deck_beside(root.file.parent)
    if deck is not None:
        wall = str(deck)
        said.append(f"of the wall {deck} says {', '.join(read_deck(deck))}")
    words = f" (in SI {'; '.join(said)})" if said else ""
    command = f"fsi-mesh import fluid=FILE wall={wall} -o FILE.msh"
    remedy = f"import the meshes of both, the fluid's from its program: {command}; then write the case file by hand"
    return root.refuse(f"a preCICE configuration does not hold the fluid's mesh{words}", remedy)
