"""How far runs are apart in their flows, openings, points, lines and planes: what `fsi-compare pressure` compares of
vessels without a centre line, and `fsi-compare report` of all runs."""

from pathlib import Path
from typing import Sequence

from ..base.errors import InputError, printable
from ..base.files import exists, is_file, together
from ..runs.run_folder import read_finished
from ..runs.samples import CENTRE_LINE, LINES, PLANES, POINTS, Difference, differences_of_tables, read_samples
from .column import Column
from .layout import Table, show_tables

TABLES = ("flow.csv", "openings.csv", POINTS, LINES, PLANES)


def without_centre_line(folder: Path) -> bool:
    """Whether a run has other tables, but no centre line, as those of vessels that branch."""
    if exists(folder / "centerline_pressure.csv") or not any(is_file(folder / table) for table in TABLES):
        return False
    return not is_file(folder / LINES) or CENTRE_LINE not in read_samples(folder / LINES)


def compare_samples(folders: Sequence[Path], given_labels: Sequence[str] | None, output: Path, quiet: bool) -> int:
    """Flows, points, lines and planes of the first run against those of the others, at the times that both have. Writes
    sample_differences.csv. Raises InputError where there is nothing in common."""
    for folder in folders:
        read_finished(folder)
    labels = given_labels or [printable(str(folder)) for folder in folders]
    found = sample_differences(folders)
    for folder, of_run in zip(folders[1:], found):
        if not of_run:
            problem = f"has no samples at times in common with {folders[0]}"
            raise InputError(folder, "", problem, "compare runs of one scene")
    table = sample_table(found, labels)
    table.title += ": not all runs have a centre line"
    with together(output) as place:
        written = [table.write_csv(place)]
    if not quiet:
        show_tables([table], output, written)
    return 0


def sample_differences(folders: Sequence[Path]) -> list[list[Difference]]:
    """Differences of each run from the first, in each column of each table of samples, at the times that both have.
    Raises InputError for tables that cannot be read."""
    return [differences_of_tables(folders[0], folder, TABLES) for folder in folders[1:]]


COLUMNS: Sequence[Column[tuple[str, Difference]]] = (
    Column("run", "run", lambda r: r[0], left=True),
    Column("table", "table", lambda r: r[1].table, left=True),
    Column("sample", "sample", lambda r: r[1].sample, left=True),
    Column("column", "column", lambda r: r[1].column, left=True),
    Column("difference", "largest_difference", lambda r: r[1].largest, ".3e"),
    Column("of", "largest_value", lambda r: r[1].size, ".3e"),
    Column("times", "times", lambda r: r[1].levels),
)


def sample_table(found: Sequence[Sequence[Difference]], labels: Sequence[str]) -> Table:
    """The result of sample_differences() as a table."""
    records = [(label, d) for of_run, label in zip(found, labels[1:]) for d in of_run]
    return Table("sample_differences", f"Largest differences from {labels[0]}", COLUMNS, records)
