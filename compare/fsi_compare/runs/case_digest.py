"""What of a case file decides the outcome of a driver's run."""

import hashlib
import json
import tomllib
from pathlib import Path
from typing import Sequence

OTHERS = {"fsi-monolithic": "partitioned", "fsi-partitioned": "monolithic"}  # the section that the driver skips


def case_digest(case: Path, program: str, ignored: Sequence[str] = ()) -> str:
    """SHA-256 of the entries, without comments, the other driver's section and what is `ignored` at the top; of the
    bytes where it is not TOML."""
    content = case.read_bytes()
    try:
        entries = tomllib.loads(content.decode("utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError):
        return hashlib.sha256(content).hexdigest()
    for name in (OTHERS.get(program, ""), *ignored):
        entries.pop(name, None)
    return hashlib.sha256(json.dumps(entries, sort_keys=True, default=str).encode()).hexdigest()
