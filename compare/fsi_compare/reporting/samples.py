"""`fsi-compare pressure` of vessels without a centre line: what all runs have in common is compared instead."""

from pathlib import Path
from typing import List, Optional, Sequence

from ..base.errors import InputError, printable
from ..base.files import exists, is_file, together
from ..runs.run_folder import read_finished
from ..runs.samples import CENTRE_LINE, LINES, PLANES, POINTS, Difference, differences_of_tables, read_samples
from .layout import Table, say_written

TABLES = ("flow.csv", "openings.csv", POINTS, LINES, PLANES)


def without_centre_line(folder: Path) -> bool:
    """Whether a run has other tables, but no centre line: that of a vessel that branches."""
    if exists(folder / "centerline_pressure.csv") or not any(is_file(folder / table) for table in TABLES):
        return False
    return not is_file(folder / LINES) or CENTRE_LINE not in read_samples(folder / LINES)


def compare_samples(folders: Sequence[Path], given_labels: Optional[Sequence[str]], output: Path, quiet: bool) -> int:
    """Flows, points, lines and planes of the first run against those of the others, at the times that both have. Writes
    sample_differences.csv. Raises InputError where there is nothing in common."""
    for folder in folders:
        read_finished(folder)
    labels = given_labels or [printable(str(folder)) for folder in folders]
    table = Table(
        "sample_differences",
        f"Largest differences from {labels[0]}: not all runs have a centre line",
        [("", "run"), ("", "table"), ("", "sample"), ("", "column"), ("", "difference"), ("", "of"), ("", "times")],
        ["run", "table", "sample", "column", "largest_difference", "largest_value", "times"],
        left=4,
    )
    for folder, label in zip(folders[1:], labels[1:]):
        found: List[Difference] = differences_of_tables(folders[0], folder, TABLES)
        if not found:
            raise InputError(
                folder, "", f"has no samples at times in common with {folders[0]}", "compare runs of one scene"
            )
        for d in found:
            table.rows.append([label, d.table, d.sample, d.column, f"{d.largest:.3e}", f"{d.size:.3e}", str(d.levels)])
            table.csv_rows.append([label, d.table, d.sample, d.column, d.largest, d.size, d.levels])
    with together(output) as place:
        written = [table.write_csv(place)]
    if not quiet:
        print(table.text())
        say_written(output, written)
    return 0
