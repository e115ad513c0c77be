"""Keeps the numbers of the cases of other programs as docs/data/peers.csv, and puts them into docs/peers.md.

usage: python3 scripts/keep_peers.py FOLDER    (results/studies/peers, as fsi-compare study peers leaves it)
"""

import csv
import subprocess
import sys
from pathlib import Path
from typing import List, NoReturn

from kept_tables import DATA, write_table

ORIGIN = "made by fsi-compare study peers and scripts/keep_peers.py; columns as in its references.csv, without seconds"
LEFT_OUT = ("seconds",)  # of a machine that need not be idle


def main(words: List[str]) -> int:
    if len(words) != 1 or words[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 1
    source = Path(words[0]) / "references.csv"
    try:
        with source.open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        if not rows:
            fail(f"{source}: holds no row; run fsi-compare study peers first")
        columns = [name for name in rows[0] if name not in LEFT_OUT]
        write_table(DATA / "peers.csv", ORIGIN, columns, [[rounded(row[name]) for name in columns] for row in rows])
    except OSError as error:
        fail(f"{error.filename}: {error.strerror}; run fsi-compare study peers first")
    return subprocess.run([sys.executable, Path(__file__).with_name("kept_pages.py")], check=False).returncode


def rounded(cell: str) -> str:
    """Numbers to six digits."""
    try:
        return f"{float(cell):.6g}"
    except ValueError:
        return cell


def fail(text: str) -> NoReturn:
    print(f"keep_peers: error: {text[:1000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
