"""Known errors of runs: bars that `fsi-compare verify` left beside them, or one line that says how to find them."""

import shlex
from typing import TYPE_CHECKING, Sequence

from ..base.numbers import number_of
from ..results.run import RunResults
from ..runs.verification import Bar
from .column import Column
from .layout import Table

if TYPE_CHECKING:
    from .report import Report

Row = tuple[str, Bar]


def _word(row: Row, name: str) -> str:
    return str(row[1].get(name) or "")


def _said(row: Row) -> str:
    return _word(row, "verdict") + (f": {_word(row, 'advice')}" if _word(row, "advice") else "")


COLUMNS: Sequence[Column[Row]] = (
    Column("run", "run", lambda r: r[0], left=True),
    Column("quantity", "quantity", lambda r: _word(r, "quantity"), left=True),
    Column("unit", "unit", lambda r: _word(r, "unit"), left=True),
    Column("value", "value", lambda r: number_of(r[1], "value") or 0.0, ".6g"),
    Column("±", "error", lambda r: number_of(r[1], "error"), ".2g"),
    Column("± [%]", "error_percent", lambda r: number_of(r[1], "error_percent"), ".2g"),
    Column("verdict", "verdict", lambda r: _word(r, "verdict"), text=_said, left=True),
)
MOST_ROWS = 25  # of a table that is open from the start


def unknown(run: RunResults, label: str) -> str:
    """The line for a run without bars."""
    case = shlex.quote(str(run.summary.get("case") or "CASE.toml"))
    return f"How far {label} is from the exact solution is unknown. `fsi-compare verify {case}` finds out."


def add_error_bars(
    page: "Report", runs: Sequence[RunResults], labels: Sequence[str], found: Sequence[list[Bar] | None]
) -> None:
    """`found`: the bars beside each run; None: no family is beside it."""
    page.section("Error bars")
    rows = [(label, bar) for label, of_run in zip(labels, found) if of_run is not None for bar in of_run]
    if rows:
        table = Table("error_bars", "How far values may be from the exact ones", COLUMNS, rows)
        table.notes.append(
            "By fsi-compare verify. Percent are of the largest value of the curve that the quantity is of; those of curve, line, "
            "at any time and anywhere are errors of the curve itself."
        )
        if len(rows) > MOST_ROWS:
            page.folded(table.title, [table])
        else:
            page.table(table)
    page.text(*(unknown(run, label) for run, label, of_run in zip(runs, labels, found) if of_run is None))
