"""Intervals of a case's tables of flow rates, read as common/case/table_input.cpp and table_units.cpp do."""

import math
import re
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import InputError
from ..base.files import read_text

TIMES = {"ms": 1.0, "s": 1e3, "us": 1e-3, "min": 6e4, "msec": 1.0, "sec": 1e3}
TIMES |= {"second": 1e3, "seconds": 1e3, "millisecond": 1.0, "milliseconds": 1.0, "minute": 6e4, "minutes": 6e4}
UNREADABLE = "give a CSV file with a header and two columns"


def flow_interval(case: Path, openings: Any, network: Any = None) -> float | None:
    """The smallest of all tables of flow rates, of openings and of sources in a network, each by the median of its
    intervals, ms; None: no table, or none that can be read here, which the driver then says."""
    found = []
    elements = network.get("element") if isinstance(network, dict) else None
    for source in (one for of in (openings, elements) if isinstance(of, list) for one in of):
        try:
            times = _times(case.parent, source["flow_rate"])
        except (InputError, ValueError, TypeError, LookupError, OverflowError):
            continue
        interval = float(np.median(np.diff(times))) if len(times) > 2 and np.isfinite(times).all() else 0.0
        found += [interval] if 0 < interval < math.inf else []
    return min(found, default=None)


def _times(folder: Path, table: Any) -> np.ndarray:
    """Of rows, or of a section with `file` or `rows`, ms."""
    unit, rows = "", table
    if isinstance(table, dict):
        unit, rows = str(table.get("time_unit", "")), table.get("rows")
        if "file" in table:
            header, *lines = read_text(folder / table["file"], UNREADABLE, UNREADABLE).split("\n")
            rows = [re.split("[,;]", line) for line in lines if line.strip()]
            unit = unit or re.split("[,;]", header)[0]
    return _factor(unit) * np.array([float(row[0]) for row in rows])


def _factor(column: str) -> float:
    """To ms, from the unit that a column's header or `time_unit` names: behind underscores or blanks, in brackets, or
    alone; without any it is ms."""
    text = re.sub("[µμ]", "u", column.replace('"', "").removeprefix("\ufeff").strip().lower())
    inside = re.search(r"[(\[]([^)\]]*)", text)
    words = re.split("[_ ]", inside[1] if inside else text)
    return next((TIMES[unit] for unit in ("".join(words[k:]) for k in range(len(words))) if unit in TIMES), 1.0)
