"""The column of work units: printed where the table wants it, before seconds; behind all others in CSV files."""

from typing import Callable, TypeVar

from ..runs.work_units import shown
from .column import Column

Record = TypeVar("Record")


def work_column(head: str, csv: str, value: Callable[[Record], float | None], group: str = "") -> Column[Record]:
    """Column of work units; its cells are empty for runs that did not measure the unit."""
    return Column(head, csv, value, shown, group=group, missing="", behind=True)
