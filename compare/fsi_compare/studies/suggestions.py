"""The nearest valid name for a misspelt one."""

import difflib
from typing import Sequence


def nearest(name: str, names: Sequence[str]) -> str:
    if not names:
        return ""
    close = difflib.get_close_matches(name, list(names), n=1, cutoff=0.0)
    return close[0]
