"""A reference solution kept as files: waves computed once, finer in mesh and step than any run of a study."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..base.errors import InputError, printable
from ..base.files import read_object
from ..base.numbers import is_number
from .waves import QUANTITIES, Waves, read_waves

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


def read_reference(folder: Path) -> WaveReference:
    """Reads a kept reference. Raises InputError."""
    path = folder / FILE
    data = read_object(path, REMEDY, REMEDY)
    own: Any = data.get("own_error")
    case, step = data.get("case", {}), data.get("step_ms")
    for key, section in (("own_error", own), ("case", case)):
        if not isinstance(section, dict):
            raise InputError(path, key, "is not a JSON object", REMEDY)
    numbers = {f"own_error.{q.column}": own.get(q.column) for q in QUANTITIES}
    for key, value in {**numbers, **({} if step is None else {"step_ms": step})}.items():
        if not (is_number(value) and 0 < value < 1e300):
            raise InputError(path, key, "is not a positive number", REMEDY)
    if not isinstance(data.get("description"), str):
        raise InputError(path, "description", "is not a text", REMEDY)
    waves = {q.column: read_waves(folder / q.file, q.column) for q in QUANTITIES}
    errors = {q.column: float(own[q.column]) for q in QUANTITIES}
    return WaveReference(folder, printable(data["description"]), errors, waves, case, step)
