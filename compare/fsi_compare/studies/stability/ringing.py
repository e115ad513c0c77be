"""Runs whose pressure alternates from step to step: they converged, and the programs named it themselves."""

from typing import Dict, List, Optional, Sequence, Tuple

import numpy as np

from ...reporting.layout import Table, fixed
from ...reporting.report import Report
from ..evidence.cross_check import Cell, point_of, waves_of
from ..running.study_file import show
from .settings import Settings


def ringing(report: Report, found: Sequence[Cell], settings: Settings) -> None:
    """The section, where the schemes in time were varied or a run rings."""
    named = [cell for cell in found if _amplitude(cell) is not None]
    if not named and "scheme" not in {point_of(cell.run)[1] for cell in found}:
        return
    report.section("Pressures that alternate")
    report.text(
        "A scheme in time that hardly damps what its steps cannot resolve lets the pressure alternate from step to step. "
        "The programs watch for that on the centre line, name it once in the log, and keep the largest amplitude in "
        f"`summary.json`. {len(named)} of {len(found)} runs named it."
    )
    if named:
        report.table(ringing_table(named, settings))


def _amplitude(cell: Cell) -> Optional[float]:
    """Pa, as the program found it."""
    said = cell.run.summary.get("ringing")
    amplitude = said.get("amplitude_Pa") if isinstance(said, dict) else None
    return float(amplitude) if isinstance(amplitude, (int, float)) and abs(amplitude) < 1e100 else None


def _largest(cell: Cell) -> Optional[float]:
    """Pa, the largest pressure of the run."""
    waves = waves_of(cell.run)
    return None if waves is None else float(np.abs(waves.pressure).max())


def ringing_table(named: Sequence[Cell], settings: Settings) -> Table:
    """One row for each point; methods that name the same share it."""
    table = Table(
        stem="ringing",
        title="Largest amplitude of the alternation that the programs named",
        left=3,
        columns=[
            ("", "quantity"),
            ("", "value"),
            ("", "methods"),
            ("", "amplitude in Pa"),
            ("", "largest pressure in Pa"),
        ],
        csv_columns=["quantity", "value", "method", "amplitude_Pa", "largest_pressure_Pa"],
    )
    points: Dict[Tuple[str, str], List[Cell]] = {}
    for cell in named:
        _, name, value = point_of(cell.run)
        points.setdefault((name, show(value)), []).append(cell)
        table.csv_rows.append([name, value, cell.method, _amplitude(cell), _largest(cell)])
    for (name, value), there in points.items():
        amplitudes = [amplitude for amplitude in map(_amplitude, there) if amplitude is not None]
        largest = [pressure for pressure in map(_largest, there) if pressure is not None]
        table.rows.append(
            [
                settings.label(name),
                value,
                ", ".join(cell.run.request.method.label for cell in there),
                _range(amplitudes),
                fixed(max(largest, default=None), ".0f"),
            ]
        )
    return table


def _range(values: Sequence[float]) -> str:
    if not values:
        return "-"
    low, high = f"{min(values):.2g}", f"{max(values):.2g}"
    return low if low == high else f"{low} to {high}"
