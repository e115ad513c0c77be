"""Fields of a run on its meshes, read from the HDF5 files when they are asked for."""

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from ..base.errors import InputError
from ..base.suggestions import hint
from ..runs.levels import between_levels

FIRST = "fields.h5"
AGAIN = "run it again"
UNREADABLE = (OSError, RuntimeError, KeyError, TypeError, ValueError, AttributeError)  # of h5py, for damaged files


@dataclass(frozen=True)
class _Entry:
    """Where the values of one time are."""

    time: float
    file: Path
    name: str


class MediumFields:
    """Fluid or wall: its mesh, and the fields on it."""

    def __init__(self, name: str, file: Path, entries: dict[str, list[_Entry]], units: dict[str, str]) -> None:
        self.name = name
        #: unit of each field by its name
        self.units: dict[str, str] = units
        self._file = file
        self._entries = entries
        self._mesh: dict[str, np.ndarray] = {}
        self._widths: dict[str, int] = {}

    def __repr__(self) -> str:
        fields = ", ".join(f"{name} in {self.units[name]}" for name in self.names)
        return f"<MediumFields {self.name}: {len(self.times)} times; {fields}>"

    @property
    def names(self) -> list[str]:
        """The fields that are there."""
        return sorted(self._entries)

    @property
    def points(self) -> np.ndarray:
        """Reference positions, mm, (nodes, 3)."""
        return self._of_mesh("points")

    @property
    def cells(self) -> np.ndarray:
        """Nodes of cells, (cells, 3, 4, 6 or 10): triangles or tetrahedra; middles of edges behind vertices in VTK's
        order."""
        return self._of_mesh("cells")

    @property
    def layers(self) -> np.ndarray | None:
        """Number of each cell's layer, (cells,); None where the medium has none."""
        with _opened(self._file) as h5:
            if f"{self.name}/layer" not in h5:
                return None
        return self._of_mesh("layer")

    @property
    def times(self) -> np.ndarray:
        """Times of the entries that were written, ms, (entries,)."""
        return np.array(sorted({entry.time for entries in self._entries.values() for entry in entries}))

    def times_of(self, field: str) -> np.ndarray:
        """Times of the entries that have this field, ms, (entries,). Raises InputError."""
        return np.array([entry.time for entry in self._of(field)])

    def width(self, field: str) -> int:
        """Components of a field: 1, 3 or 6. Raises InputError."""
        if field not in self._widths:
            shape = self._values(field, self._of(field)[0]).shape
            self._widths[field] = int(shape[1]) if len(shape) == 2 else 1
        return self._widths[field]

    def at(self, time: float, field: str) -> np.ndarray:
        """Values at a time in ms, linear between entries: (nodes,) or (cells,) of a scalar, (..., 3) of a vector, (...,
        6) of a symmetric tensor (xx, xy, xz, yy, yz, zz). Raises InputError for another field, or a time outside."""
        entries = self._of(field)
        times = np.array([entry.time for entry in entries])
        tolerance = 1e-6 * (float(np.min(np.diff(times))) if len(times) > 1 else max(abs(float(times[0])), 1.0))
        if not times[0] - tolerance <= time <= times[-1] + tolerance:
            remedy = f"give a time between {times[0]:g} and {times[-1]:g} ms"
            raise InputError(self._file, f"{self.name}/{field}", f"{time:g} ms is outside what was written", remedy)
        return between_levels(times, time, tolerance, lambda level: self._values(field, entries[level]))

    def _of(self, field: str) -> list[_Entry]:
        if field not in self._entries:
            raise InputError(self._file, self.name, f"has no field '{field}'", hint(field, self.names))
        return self._entries[field]

    def _values(self, field: str, entry: _Entry) -> np.ndarray:
        return _dataset(entry.file, f"{self.name}/{field}/{entry.name}")

    def _of_mesh(self, part: str) -> np.ndarray:
        if part not in self._mesh:
            self._mesh[part] = _dataset(self._file, f"{self.name}/{part}")
        return self._mesh[part]


def read_fields(folder: Path) -> dict[str, MediumFields]:
    """Media by name, without their values; empty when the run has written none. Raises InputError."""
    later = sorted(folder.glob("fields-*.h5"), key=lambda path: (len(path.name), path.name))  # by their numbers
    parts = [path for path in [folder / FIRST, *later] if path.is_file()]
    entries: dict[str, dict[str, list[_Entry]]] = {}
    units: dict[str, dict[str, str]] = {}
    for path in parts:
        with _opened(path) as h5:
            try:
                for unit, medium, field, found in _finished(path, h5):
                    known = entries.setdefault(medium, {}).setdefault(field, [])
                    if not known or found.time > known[-1].time:  # a killed restart may have left one in two files
                        known.append(found)
                    units.setdefault(medium, {})[field] = unit
            except UNREADABLE as error:
                raise InputError(path, "", f"cannot be read: {error}", AGAIN) from None
    return {name: MediumFields(name, parts[0], found, units[name]) for name, found in sorted(entries.items())}


def _finished(path: Path, h5: h5py.File) -> list[tuple[str, str, str, _Entry]]:
    """(unit, medium, field, entry) of all entries of a file that are whole."""
    numbers, times = h5["steps/number"][()], h5["steps/time"][()]
    found = []
    for key, flags in h5["steps/written"].items():
        medium, _, field = key.partition(".")
        unit = h5[medium][field].attrs.get("unit", "") if field in h5[medium] else ""
        unit = unit.decode() if isinstance(unit, bytes) else str(unit)
        for number, time, flag in zip(numbers, times, flags[()]):
            if flag:
                found.append((unit, medium, field, _Entry(float(time), path, f"{number:08d}")))
    return found


def _opened(path: Path) -> h5py.File:
    try:
        return h5py.File(path, "r")
    except OSError as error:
        raise InputError(path, "", f"cannot be read: {error}", AGAIN) from None


def _dataset(path: Path, name: str) -> np.ndarray:
    with _opened(path) as h5:
        try:
            return np.asarray(h5[name][()])
        except UNREADABLE as error:
            raise InputError(path, name, f"cannot be read: {error}", AGAIN) from None
