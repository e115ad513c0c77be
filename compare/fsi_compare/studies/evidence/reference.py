"""A reference solution kept as files: waves computed once, finer in mesh and step than any run of a study."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict

from ...base.errors import InputError
from .waves import QUANTITIES, Quantity, Waves, read_waves

REMEDY = "make it with scripts/reference_waves.py"


@dataclass(frozen=True)
class WaveReference:
    """Folder with `reference.json`, `centerline_pressure.csv`, `averaged_pressure.csv` and `wall_displacement.csv`."""

    folder: Path
    description: str  # how it was computed
    own_error: Dict[str, float]  # by quantity's column, relative L2
    waves: Dict[str, Waves]  # by quantity's column
    case: Dict[str, Any]  # the physical entries of the case that it solves, by dotted key; empty: not recorded

    def of(self, quantity: Quantity) -> Waves:
        return self.waves[quantity.column]


def read_reference(folder: Path) -> WaveReference:
    """Raises InputError."""
    path = folder / "reference.json"
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        own = {q.column: float(data["own_error"][q.column]) for q in QUANTITIES}
        description = str(data["description"])
        case = dict(data.get("case", {}))
    except OSError as error:
        raise InputError(path, "", f"cannot be read: {error.strerror}", REMEDY) from None
    except (ValueError, KeyError, TypeError):
        raise InputError(path, "own_error", "is not a reference's description", REMEDY) from None
    waves = {q.column: read_waves(folder / q.file, q.column) for q in QUANTITIES}
    return WaveReference(folder, description, own, waves, case)
