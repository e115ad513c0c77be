"""What of a case file decides the outcome of a driver's run."""

import hashlib
import json
import tomllib
from pathlib import Path

OTHERS = {"fsi-monolithic": "partitioned", "fsi-partitioned": "monolithic"}  # the section that the driver skips


def case_digest(case: Path, program: str) -> str:
    """SHA-256 of the entries, without comments and the other driver's section; of the bytes where it is not TOML."""
    content = case.read_bytes()
    try:
        entries = tomllib.loads(content.decode("utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError):
        return hashlib.sha256(content).hexdigest()
    entries.pop(OTHERS.get(program, ""), None)
    return hashlib.sha256(json.dumps(entries, sort_keys=True, default=str).encode()).hexdigest()
