"""Kept tables: docs/data/*.csv, which begin with lines of # that say by which commands they were made."""

import csv
from pathlib import Path
from typing import Dict, List, Sequence

TOP = Path(__file__).resolve().parents[2]
DATA = TOP / "docs" / "data"

Row = Dict[str, str]


def read_table(path: Path) -> List[Row]:
    """Raises OSError, and ValueError for a table that does not say how it was made or whose rows have gaps."""
    text = path.read_text(encoding="utf-8")
    if not text.startswith("# made by "):
        raise ValueError(f"{path}: the first line does not say how it was made; begin it with '# made by '")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines, restkey="", restval=None))
    for number, row in enumerate(rows, 1):
        if "" in row or None in row.values():
            raise ValueError(f"{path}: row {number} has not as many cells as there are columns; mend it")
    if not rows:
        raise ValueError(f"{path}: holds no row; make it anew")
    return rows


def write_table(path: Path, origin: str, columns: Sequence[str], rows: Sequence[Sequence[object]]) -> None:
    """`origin`: by which commands it was made."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {line}\n" for line in origin.split("\n"))
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)
