"""What of a case file decides the outcome of a driver's run."""

import hashlib
import json
from pathlib import Path
from typing import Sequence

from ..base.case_names import with_present_names
from ..base.errors import InputError
from ..base.files import read_bytes, read_toml

MISSING = "give a case file that can be read"

OTHERS = {"fsi-monolithic": "partitioned", "fsi-partitioned": "monolithic"}  # the section that the driver skips


def case_digest(case: Path, program: str, ignored: Sequence[str] = ()) -> str:
    """SHA-256 of the entries, without comments, the other driver's section and what is `ignored` at the top; of the
    bytes where it is not TOML."""
    try:
        entries = with_present_names(read_toml(case, MISSING, MISSING))
    except InputError:  # the driver will say what is wrong with it
        return hashlib.sha256(read_bytes(case, MISSING, MISSING)).hexdigest()
    for name in (OTHERS.get(program, ""), *ignored):
        entries.pop(name, None)
    return hashlib.sha256(json.dumps(entries, sort_keys=True, default=str).encode()).hexdigest()
