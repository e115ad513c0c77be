"""`verification.json`, the bars that `fsi-compare verify` left: read, and found beside an ordinary run."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Optional

from ..base.files import is_file, listed, read_object

FILE = "verification.json"
AGAIN = "verify the case again"


@dataclass(frozen=True)
class KeptBar:
    """Of a quantity, as it was found."""

    quantity: str
    unit: str
    value: float
    error: Optional[float]  # None: not in the range where one can be given
    error_percent: Optional[float]
    verdict: str
    advice: str


@dataclass(frozen=True)
class Verification:
    path: Path
    driver: str
    bars: List[KeptBar]


def find_verification(folder: Path, summary: Mapping[str, Any]) -> Optional[Verification]:
    """Of the run in `folder`: in its own folder or in those around it, of a family whose own member has the same case, mesh
    and number of steps. None where there is none. Raises InputError for a broken file."""
    for path in _candidates(folder):
        data = read_object(path, AGAIN, AGAIN)
        found = _fitting(path, data, summary)
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


def _fitting(path: Path, data: Dict[str, Any], summary: Mapping[str, Any]) -> Optional[Verification]:
    driver = str(summary.get("program", "")).removeprefix("fsi-")
    own = data.get("own", {})
    mine = own.get(driver) if isinstance(own, dict) else None
    mesh, totals = summary.get("mesh", {}), summary.get("totals", {})
    if not isinstance(mine, dict) or mine.get("case_hash") != summary.get("case_hash"):
        return None
    if mine.get("mesh_hash") != mesh.get("hash") or mine.get("steps") != totals.get("steps"):
        return None
    entries = [
        entry for entry in data.get("quantities", []) if isinstance(entry, dict) and entry.get("driver") == driver
    ]
    return Verification(path, driver, [_bar(entry) for entry in entries])


def identity(summary: Mapping[str, Any]) -> Dict[str, Any]:
    """What a run is recognised by."""
    return {
        "case_hash": summary.get("case_hash"),
        "mesh_hash": summary.get("mesh", {}).get("hash"),
        "steps": summary.get("totals", {}).get("steps"),
    }


def _bar(entry: Mapping[str, Any]) -> KeptBar:
    def number(name: str) -> Optional[float]:
        value = entry.get(name)
        return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else None

    def text(name: str) -> str:
        return str(entry.get(name) or "")

    return KeptBar(
        text("quantity"),
        text("unit"),
        number("value") or 0.0,
        number("error"),
        number("error_percent"),
        text("verdict"),
        text("advice"),
    )
