"""Flow and pressure of each opening of the fluid over time."""

from dataclasses import dataclass

import numpy as np

from .table import Table


@dataclass(frozen=True)
class Opening:
    """Flow and pressure of one opening, at all time levels."""

    name: str
    time: np.ndarray  #: ms, (levels,)
    flow: np.ndarray  #: mm^3/ms, positive outwards, (levels,)
    mean_pressure: np.ndarray  #: Pa, (levels,)
    windkessel_pressure: np.ndarray | None  #: Pa, stored, or behind a resistance, (levels,); None: neither


def openings_of(table: Table) -> dict[str, Opening]:
    """Reads `openings.csv`, a row for each time and opening; what stores no pressure has a column of zeros."""
    found = {}
    for name, rows in table.groups("opening").items():
        pressure = rows["windkessel_pressure"] if "windkessel_pressure" in rows else np.array([])
        none = not np.any(np.isfinite(pressure) & (pressure != 0))
        found[name] = Opening(name, rows["time"], rows["flow"], rows["mean_pressure"], None if none else pressure)
    return found


def inlet_and_outlet(table: Table) -> dict[str, Opening]:
    """Reads `flow.csv`, where the flow of the inlet is positive inwards, and zeros stand for an end that is no
    opening."""
    found = {}
    for name, outwards in (("inlet", -1.0), ("outlet", 1.0)):
        if f"{name}_flow" in table:
            flow, pressure = outwards * table[f"{name}_flow"], table[f"{name}_pressure"]
            if np.any(flow) or np.any(pressure):
                found[name] = Opening(name, table["time"], flow, pressure, None)
    return found
