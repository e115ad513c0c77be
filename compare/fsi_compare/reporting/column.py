"""A column of a table, said once: its head for people, its name for scripts, and where its cells come from."""

from dataclasses import dataclass
from typing import Any, Callable, Generic, Sequence, TypeVar

from ..runs.work_units import shown

R = TypeVar("R")


@dataclass(frozen=True)
class Column(Generic[R]):
    """A column of a table whose rows are records R. Without `head` it is in the CSV only, without `csv` for people
    only."""

    head: str = ""
    csv: str = ""
    value: Callable[[R], Any] = lambda record: None  # what the CSV holds; None: there is none
    format: str | Callable[[Any], str] = ""  # of the value, for people
    unit: str = ""  # ends the name in the CSV, and stands where head or group have "{unit}"
    group: str = ""  # head over the heads of neighbours that have the same
    left: bool = False  # aligned to the left: words
    text: Callable[[R], str] | None = None  # what people read, where the value does not tell it
    missing: str = "-"  # for people, where the value is None
    behind: bool = False  # in the CSV behind all others: people script against the order

    @property
    def name(self) -> str:
        """The name in the CSV: a unit of mm/ms makes it NAME_mm_per_ms."""
        return "_".join(part for part in (self.csv, self.unit.replace("^", "").replace("/", "_per_")) if part)

    def shown(self, record: R) -> str:
        """The cell as people read it."""
        if self.text is not None:
            return self.text(record)
        return fixed(self.value(record), self.format, self.missing)


@dataclass(frozen=True)
class Facts:
    """Lines and columns of the CSV where one row of the table gathers several facts."""

    columns: Sequence[Column[Any]]
    records: Sequence[Any]


def fixed(value: Any, form: str | Callable[[Any], str], missing: str = "-") -> str:
    """A value in the given format, zero without a power of ten; a dash for what there is not."""
    if value is None:
        return missing
    if isinstance(form, str) and form.endswith("e") and value == 0:
        return "0"
    return format(value, form) if isinstance(form, str) else form(value)


def work_column(head: str, csv: str, value: Callable[[R], float | None], group: str = "") -> Column[R]:
    """Column of work units, printed where the table wants it, before seconds, and behind all others in CSV files. Its
    cells are empty for runs that did not measure the unit."""
    return Column(head, csv, value, shown, group=group, missing="", behind=True)
