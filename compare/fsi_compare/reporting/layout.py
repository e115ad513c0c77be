"""A table in the forms that people and scripts read."""

import csv
import math
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Sequence

from ..base.errors import printable
from ..base.files import replacing, together, write_text
from .column import Column, Facts


@dataclass
class Table:
    """A row for each record. Text shows groups above their columns, Markdown before their names. CSV has a line for
    each record, or for each of the facts where rows gather several, in full precision; None is an empty field there."""

    stem: str
    title: str
    columns: Sequence[Column[Any]]
    records: Sequence[Any]
    facts: Facts | None = None
    notes: list[str] = field(default_factory=list)

    @cached_property
    def shown(self) -> list[Column[Any]]:
        """The columns that people read."""
        return [column for column in self.columns if column.head]

    @cached_property
    def heads(self) -> list[tuple[str, str]]:
        """(group, name) of each of them."""
        return [tuple(t.replace("{unit}", c.unit) for t in (c.group, c.head)) for c in self.shown]  # type: ignore[misc]

    @cached_property
    def spans(self) -> list[tuple[str, int, int]]:
        """(group, first column, end): neighbours of the same group are one span, those without are one each."""
        found: list[tuple[str, int, int]] = []
        for i, (group, _) in enumerate(self.heads):
            same = bool(found) and bool(group) and found[-1][0] == group
            found.append((group, found.pop()[1] if same else i, i + 1))
        return found

    @property
    def has_groups(self) -> bool:
        return any(group for group, _ in self.heads)

    @cached_property
    def rows(self) -> list[list[str]]:
        return [[column.shown(record) for column in self.shown] for record in self.records]

    @cached_property
    def _csv(self) -> list[Column[Any]]:
        columns = self.columns if self.facts is None else self.facts.columns
        return sorted((column for column in columns if column.csv), key=lambda column: column.behind)

    @cached_property
    def csv_rows(self) -> list[list[Any]]:
        records = self.records if self.facts is None else self.facts.records
        return [[column.value(record) for column in self._csv] for record in records]

    def text(self) -> str:
        names = [name for _, name in self.heads]
        widths = [max([len(name), *(len(row[i]) for row in self.rows)]) for i, name in enumerate(names)]
        for group, first, end in self.spans:
            widths[first] += max(0, len(group) - sum(widths[first:end]) - 2 * (end - first - 1))
        lines = [self.title]
        if self.has_groups:
            cells = [group.center(sum(widths[first:end]) + 2 * (end - first - 1)) for group, first, end in self.spans]
            lines.append("  " + "  ".join(cells))
        lines.append(self._line(names, widths))
        lines += [self._line(row, widths) for row in self.rows]
        lines += ["  " + note for note in self.notes]
        return "\n".join(line.rstrip() for line in lines) + "\n"

    def _line(self, cells: Sequence[str], widths: Sequence[int]) -> str:
        columns = zip(self.shown, cells, widths)
        return "  " + "  ".join((cell.ljust if column.left else cell.rjust)(width) for column, cell, width in columns)

    def markdown(self, heading: str = "## {}") -> str:
        heads = [f"{group}: {name}" if group and name else group or name for group, name in self.heads]
        rules = ["---" if column.left else "---:" for column in self.shown]
        lines = [heading.format(self.title), "", *map(_markdown_row, (heads, rules, *self.rows))]
        for note in self.notes:
            lines += ["", note.replace("*", r"\*").replace("_", r"\_").strip()]
        return "\n".join(lines) + "\n"

    def write_csv(self, folder: Path) -> Path:
        path = folder / f"{self.stem}.csv"
        with replacing(path) as temporary, open(temporary, "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow([column.name for column in self._csv])
            for row in self.csv_rows:
                writer.writerow([_field(cell) for cell in row])
        return path


def _field(cell: Any) -> Any:
    """A field of a CSV, empty for what is no number."""
    return cell if not isinstance(cell, float) else repr(float(cell)) if math.isfinite(cell) else None


def write_tables(folder: Path, tables: Sequence[Table], markdown: str, heading: str) -> list[Path]:
    """Writes each table as CSV, and all into one Markdown file of that name."""
    write_text(folder / markdown, "\n".join([f"# {heading}\n", *(table.markdown() for table in tables)]))
    return [*(table.write_csv(folder) for table in tables), folder / markdown]


def hand_out(table: Table, folder: Path, quiet: bool) -> int:
    """Writes the one table of a command, as CSV and Markdown, and prints it; the exit code."""
    with together(folder) as place:
        written = write_tables(place, [table], f"{table.stem}.md", table.title)
    if not quiet:
        show_tables([table], folder, written)
    return 0


def show_tables(tables: Sequence[Table], folder: Path, written: Sequence[Path]) -> None:
    """Prints the tables, and names the files written, which by now are in `folder`."""
    for table in tables:
        print(table.text())
    say_written(folder, written)


def say_written(folder: Path, files: Sequence[Path]) -> None:
    """Names the files, which by now are in `folder`."""
    print("Written: " + ", ".join(printable(str(folder / file.name)) for file in files))


def _markdown_row(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cell.replace("|", r"\|").replace("*", r"\*").replace("_", r"\_") for cell in cells) + " |"
