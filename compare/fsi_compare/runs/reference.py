"""A reference solution kept as files: waves computed once, finer in mesh and step than any run of a study."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..base.errors import InputError, printable
from ..base.files import read_object
from .waves import QUANTITIES, Quantity, Waves, read_waves

FILE = "reference.json"
REMEDY = "make it with scripts/evidence/reference_waves.py"


@dataclass(frozen=True)
class WaveReference:
    """Folder with `reference.json`, `centerline_pressure.csv`, `averaged_pressure.csv` and `wall_displacement.csv`."""

    folder: Path
    description: str  # how it was computed
    own_error: dict[str, float]  # by quantity's column, relative L2
    waves: dict[str, Waves]  # by quantity's column
    case: dict[str, Any]  # the physical entries of the case that it solves, by dotted key; empty: not recorded
    step: float | None = None  # ms; None: extrapolated to zero

    def of(self, quantity: Quantity) -> Waves:
        return self.waves[quantity.column]


def read_reference(folder: Path) -> WaveReference:
    """Reads a kept reference. Raises InputError."""
    path = folder / FILE
    data = read_object(path, REMEDY, REMEDY)
    own, case, step = data.get("own_error"), data.get("case", {}), data.get("step_ms")
    if not isinstance(own, dict):
        raise InputError(path, "own_error", "is not a JSON object", REMEDY)
    for q in QUANTITIES:
        if not _is_positive(own.get(q.column)):
            raise InputError(path, f"own_error.{q.column}", "is not a positive number", REMEDY)
    if not isinstance(data.get("description"), str):
        raise InputError(path, "description", "is not a text", REMEDY)
    if not isinstance(case, dict):
        raise InputError(path, "case", "is not a JSON object", REMEDY)
    if step is not None and not _is_positive(step):
        raise InputError(path, "step_ms", "is not a positive number", REMEDY)
    waves = {q.column: read_waves(folder / q.file, q.column) for q in QUANTITIES}
    errors = {q.column: float(own[q.column]) for q in QUANTITIES}
    return WaveReference(folder, printable(data["description"]), errors, waves, case, step)


def _is_positive(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and 0 < value < 1e300
