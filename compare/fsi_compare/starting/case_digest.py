"""What of a case file decides the outcome of a driver's run."""

import hashlib
import json
from pathlib import Path
from typing import Any, Mapping, Sequence

from ..base.case_names import with_file_names, with_present_names
from ..base.errors import InputError
from ..base.files import is_file, read_bytes, read_toml

MISSING = "give a case file that can be read"
UNREADABLE = "give a file that can be read"

OTHERS = {"fsi-monolithic": "partitioned", "fsi-partitioned": "monolithic"}  # the section that the driver skips


def case_digest(case: Path, program: str, ignored: Sequence[str] = ()) -> str:
    """SHA-256 of the entries, without comments, the other driver's section and what is `ignored` at the top, and of the
    files that they name but for the mesh; of the bytes where it is not TOML. Raises InputError."""
    try:
        entries = with_present_names(read_toml(case, MISSING, MISSING))
    except InputError:  # the driver will say what is wrong with it
        return hashlib.sha256(read_bytes(case, MISSING, MISSING)).hexdigest()
    for name in (OTHERS.get(program, ""), *ignored):
        entries.pop(name, None)
    others = {key: value for key, value in entries.items() if key != "mesh"}  # a study may have another mesh
    text = json.dumps(entries, sort_keys=True, default=str) + files_digest(others, [case.parent])
    return hashlib.sha256(text.encode()).hexdigest()


def files_digest(entries: Mapping[str, Any], places: Sequence[Path]) -> str:
    """The entries with the SHA-256 of each file in the place of its name, which is relative to the first of `places`
    that has it; empty where none is there, which the driver will say. Raises InputError."""

    def digest(name: str) -> str:
        path = next((place / name for place in places if is_file(place / name)), None)
        return name if path is None else hashlib.sha256(read_bytes(path, UNREADABLE, UNREADABLE)).hexdigest()

    found = with_file_names(entries, digest)
    return "" if found == entries else json.dumps(found, sort_keys=True, default=str)
