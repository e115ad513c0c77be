"""Any table of a result folder: columns by name, with the units that its header states."""

from pathlib import Path
from typing import Any, Iterator, Mapping, Sequence

import numpy as np

from ..base.errors import InputError
from ..base.suggestions import hint
from ..runs.columns import number, numbers, read_fields
from ..runs.samples import NAMES
from .units import split_unit


class MissingColumn(InputError, KeyError):
    """A table has no column of this name."""

    def __str__(self) -> str:
        return str(self.args[0])


class Table(Mapping[str, np.ndarray]):
    """Columns of one length, (rows,): numbers as float64, an empty field as NaN; words as text.

    A column goes by its name with or without its unit: `flow.csv` has `table["inlet_flow"]`, which is also
    `table["inlet_flow_mm3_per_ms"]`. Where two columns differ in their unit only, both keep it in their names.
    """

    def __init__(self, path: Path, columns: Mapping[str, np.ndarray]) -> None:
        """`columns` by their full headers."""
        self.path = path
        parts = {header: split_unit(header) for header in columns}
        bare = [name for name, _ in parts.values()]
        short = {header: name if bare.count(name) == 1 else header for header, (name, _) in parts.items()}
        self._columns = {short[header]: values for header, values in columns.items()}
        self._headers = {short[header]: header for header in columns}
        self._names = {header: name for name, header in self._headers.items()}
        #: unit of each column by its name, "" for none
        self.units: dict[str, str] = {short[header]: unit for header, (_, unit) in parts.items()}

    def __getitem__(self, name: str) -> np.ndarray:
        return self._columns[self._name(name)]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        return f"<Table {self.path.name}: {self.rows} rows; {', '.join(map(self.label, self))}>"

    @property
    def rows(self) -> int:
        return len(next(iter(self._columns.values()))) if self._columns else 0

    def unit(self, name: str) -> str:
        """'mm^3/ms', or '' for a column without unit. Raises MissingColumn."""
        return self.units[self._name(name)]

    def label(self, name: str) -> str:
        """A label for an axis: 'inlet flow in mm^3/ms'. Raises MissingColumn."""
        name = self._name(name)
        words = split_unit(self._headers[name])[0].replace("_", " ")
        return f"{words} in {self.units[name]}" if self.units[name] else words

    def where(self, **values: Any) -> "Table":
        """The rows in which columns have these values: `table.where(opening="outlet")`. Raises MissingColumn."""
        rows = np.ones(self.rows, dtype=bool)
        for name, value in values.items():
            rows &= self[name] == value
        return self._rows(rows)

    def groups(self, name: str) -> "dict[Any, Table]":
        """One table for each value of a column, in the order in which they come. Raises MissingColumn."""
        column = self[name]
        return {value: self._rows(column == value) for value in dict.fromkeys(column.tolist())}

    def _rows(self, rows: np.ndarray) -> "Table":
        return Table(self.path, {header: self._columns[name][rows] for name, header in self._headers.items()})

    def _name(self, name: str) -> str:
        if name in self._columns:
            return name
        if name in self._names:
            return self._names[name]
        raise MissingColumn(self.path, "", f"has no column '{name}'", hint(name, self._columns))


def read_table(path: Path, finished: bool = True) -> Table:
    """A CSV file with a line of headers. `finished`: of a run that has ended, so that a last line without end is a
    mistake; else it is left out. Raises InputError naming line and column."""
    return Table(path, {name: _column(path, name, of) for name, of in read_fields(path, finished).items()})


def _column(path: Path, name: str, fields: Sequence[str]) -> np.ndarray:
    """Names are words; so is a column whose first field says one."""
    if name in NAMES:
        return np.array(fields)
    try:
        number(next((field for field in fields if field), "0"))
    except ValueError:
        return np.array(fields)
    return numbers(path, name, fields)
