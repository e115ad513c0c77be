"""Keeps the numbers that a study holds against known ones as docs/data/NAME.csv, and puts them on the pages that quote them.

usage: python3 scripts/evidence/keep_known.py peers FOLDER         cases of other programs, without seconds
       python3 scripts/evidence/keep_known.py references FOLDER    scenes whose answers are known
FOLDER: as fsi-compare study NAME leaves it.
"""

import csv
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Dict, List, NoReturn, Tuple

from kept_tables import DATA, write_table

ORIGIN = "made by fsi-compare study {name} and scripts/evidence/keep_known.py; columns as in its references.csv, numbers to six digits"
LEFT_OUT: Dict[str, Tuple[str, ...]] = {
    "peers": ("seconds",),  # of a machine that need not be idle
    "references": ("reason",),  # texts of a paragraph, which the page does not show
}


def main(words: List[str]) -> int:
    if len(words) != 2 or words[0] not in LEFT_OUT:
        print(__doc__, file=sys.stderr)
        return 1
    name, source = words[0], Path(words[1]) / "references.csv"
    try:
        with source.open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        if not rows:
            fail(f"{source}: holds no row; run fsi-compare study {name} first")
        columns = [column for column in rows[0] if column not in LEFT_OUT[name]]
        cells = [[rounded(row[column]) for column in columns] for row in rows]
        write_table(DATA / f"{name}.csv", ORIGIN.format(name=name), columns, cells)
        if name == "references":
            shutil.copyfile(source.with_suffix(".png"), DATA.parent / "pictures/references.png")
    except OSError as error:
        fail(f"{error.filename}: {error.strerror}; run fsi-compare study {name} first")
    return subprocess.run([sys.executable, Path(__file__).with_name("kept_pages.py")], check=False).returncode


def rounded(cell: str) -> str:
    """Numbers to six digits."""
    try:
        return f"{float(cell):.6g}"
    except ValueError:
        return cell


def fail(text: str) -> NoReturn:
    print(f"keep_known: error: {text[:1000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
