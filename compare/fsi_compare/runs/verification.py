"""`verification.json`, the bars that `fsi-compare verify` left: read, and found beside an ordinary run."""

import hashlib
from pathlib import Path
from typing import Any, Iterator, Mapping

from ..base.files import is_file, listed, read_object
from .columns import ITERATIONS, read_fields

FILE = "verification.json"
AGAIN = "verify the case again"
STEP_COLUMNS = ("time_ms", "outer_iterations", "newton_iterations", "linear_iterations")
Bar = dict[str, Any]  # a quantity, as fsi-compare verify has written it


def find_verification(folder: Path, summary: Mapping[str, Any]) -> list[Bar] | None:
    """The bars for a run of the same `identity`, looked for in the run's own folder and in those around it. None where
    there are none. Raises InputError for a broken file."""
    mine: dict[str, str | None] | None = None
    for path in _candidates(folder):
        data = read_object(path, AGAIN, AGAIN)
        mine = mine or identity(folder, summary)
        found = _fitting(data, mine)
        if found is not None:
            return found
    return None


def _candidates(folder: Path) -> Iterator[Path]:
    """The folder itself, its parents up to two above, and the folders beside it and in `verify` beside it."""
    place = folder.resolve()
    around = [place, place.parent, place.parent.parent]
    beside = [place.parent / name for name in listed(place.parent)]
    beside += [place.parent / "verify" / name for name in listed(place.parent / "verify")]
    beside += [place.parent.parent / "verify" / name for name in listed(place.parent.parent / "verify")]
    for candidate in dict.fromkeys([*around, *beside]):
        if is_file(candidate / FILE):
            yield candidate / FILE


def _fitting(data: dict[str, Any], mine: Mapping[str, Any]) -> list[Bar] | None:
    sets = data.get("sets")
    for one in sets if isinstance(sets, list) else []:
        if isinstance(one, dict) and isinstance(one.get("run"), dict) and _same(mine, one["run"]):
            found = one.get("quantities")
            return [entry for entry in found if isinstance(entry, dict)] if isinstance(found, list) else []
    return None


def identity(folder: Path, summary: Mapping[str, Any]) -> dict[str, str | None]:
    """What a run is recognised by: program, case, mesh, its steps and the iterations of each. The hash of a case holds
    what is solved, not how: step, end and tolerances are not in it. Newton's and the coupling's iterates are the same
    from run to run; runs with as many of them in each step were stopped at the same ones, whatever their tolerances are
    called. Raises InputError for a broken table."""
    found = {name: summary.get(name) for name in ("program", "version", "case_hash")}
    return found | {"mesh_hash": summary.get("mesh", {}).get("hash"), "steps_hash": _steps_hash(folder / ITERATIONS)}


def _steps_hash(table: Path) -> str | None:
    """SHA-256 of the steps; None: the run has not kept them."""
    if not is_file(table):
        return None
    fields = read_fields(table)
    text = "\n".join(",".join([name, *fields.get(name, [])]) for name in STEP_COLUMNS)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _same(mine: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    """Whether both agree; what is not known of either does not."""
    return all(value is not None and value == other.get(name) for name, value in mine.items())
