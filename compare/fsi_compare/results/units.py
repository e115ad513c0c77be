"""Units in the headers of tables: a column's name ends with its unit, `flow_mm3_per_ms` is a flow in mm^3/ms."""

import re

SYMBOLS = ("ms", "s", "mm", "mg", "Pa", "kPa", "uN", "mN", "N", "uJ", "mJ", "uW", "mW", "deg", "rad", "MiB")
PER_KPA = {"kPa": 1.0, "Pa": 1000.0, "mmHg": 7.50062}  # units that a pressure can be shown in
_FACTOR = re.compile(rf"({'|'.join(SYMBOLS)})([2-9]?)$")


def time_words(time: str, static: bool, symbol: str = "") -> str:
    """'4 ms', with a symbol 't = 4 ms'; in a static run, whose times are shares of its load, '0.25 of the load'."""
    return f"{time} of the load" if static else f"{symbol}{time} ms"


def split_unit(header: str) -> tuple[str, str]:
    """('inlet_flow', 'mm^3/ms') for 'inlet_flow_mm3_per_ms'; ('step', '') for a column without unit. The longest end
    that is a unit counts, and something of the name is always left."""
    words = header.split("_")
    for first in range(1, len(words)):
        unit = _unit("_".join(words[first:]))
        if unit is not None:
            return "_".join(words[:first]), unit
    return header, ""


def _unit(text: str) -> str | None:
    """'mm^3/ms' for 'mm3_per_ms', '1/ms' for 'per_ms', 'Pa ms' for 'Pa_ms'; None for what is no unit."""
    above, *below = re.split(r"(?:^|_)per_", text)
    if text.endswith("_per") or (not above and not below):
        return None
    tops = [_factor(word) for word in above.split("_")] if above else ["1"]
    bottoms = [_factor(word) for part in below for word in part.split("_")]
    if None in tops or None in bottoms:
        return None
    return " ".join(map(str, tops)) + "".join(f"/{bottom}" for bottom in bottoms)


def _factor(word: str) -> str | None:
    found = _FACTOR.match(word)
    return None if found is None else found[1] + (f"^{found[2]}" if found[2] else "")
