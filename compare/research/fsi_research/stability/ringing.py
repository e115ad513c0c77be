"""Runs whose pressure alternates from step to step: they converged, and the programs named it themselves."""

from typing import Dict, Iterable, List, Optional, Sequence, Tuple

import numpy as np

from fsi_compare.reporting.column import Column, Facts
from fsi_compare.reporting.layout import Table
from fsi_compare.reporting.report import Report
from ..evidence.cross_check import Cell, point_of, waves_of
from fsi_compare.study.study_file import show
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


Point = Tuple[Tuple[str, str], Sequence[Cell]]  # quantity and value, and the methods that named one there

CELLS: Sequence[Column[Cell]] = (
    Column(csv="quantity", value=lambda cell: point_of(cell.run)[1]),
    Column(csv="value", value=lambda cell: point_of(cell.run)[2]),
    Column(csv="method", value=lambda cell: cell.method),
    Column(csv="amplitude", unit="Pa", value=lambda cell: _amplitude(cell)),
    Column(csv="largest_pressure", unit="Pa", value=lambda cell: _largest(cell)),
)


def _points(settings: Settings) -> List[Column[Point]]:
    return [
        Column("quantity", value=lambda point: settings.label(point[0][0]), left=True),
        Column("value", value=lambda point: point[0][1], left=True),
        Column("methods", value=lambda point: ", ".join(c.run.method_label for c in point[1]), left=True),
        Column("amplitude in {unit}", unit="Pa", value=lambda point: _range(_known(map(_amplitude, point[1])))),
        Column(
            "largest pressure in {unit}",
            unit="Pa",
            value=lambda point: max(_known(map(_largest, point[1])), default=None),
            format=".0f",
        ),
    ]


def _known(values: Iterable[Optional[float]]) -> List[float]:
    return [value for value in values if value is not None]


def ringing_table(named: Sequence[Cell], settings: Settings) -> Table:
    """One row for each point; methods that name the same share it."""
    points: Dict[Tuple[str, str], List[Cell]] = {}
    for cell in named:
        _, name, value = point_of(cell.run)
        points.setdefault((name, show(value)), []).append(cell)
    return Table(
        "ringing",
        "Largest amplitude of the alternation that the programs named",
        _points(settings),
        list(points.items()),
        Facts(CELLS, named),
    )


def _range(values: Sequence[float]) -> str:
    if not values:
        return "-"
    low, high = f"{min(values):.2g}", f"{max(values):.2g}"
    return low if low == high else f"{low} to {high}"
