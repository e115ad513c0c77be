"""Keeps the gallery's page under docs/: text and tables as docs/evidence/gallery.md, pictures as docs/pictures/gallery-*.png. What
all kinds of coupling take is measured apart, by scripts/evidence/coupling_kinds.py, and stands on docs/evidence/coupling-kinds.md alone.

usage: python3 scripts/evidence/keep_gallery.py FOLDER    (results/gallery, as fsi-compare gallery leaves it)
"""

import re
import sys
from pathlib import Path
from typing import List

from keep_study import TOP, fail, with_pictures


COST = re.compile(
    r"(\| driver \| unknowns \| steps \|(?: work units per step \|)? seconds \|.*\n(?:\|.*\n){2,}?)"
    r"\n[^|\n]*seconds of the whole program[^\n]*\n(?:\nWork units: [^\n]*\n)?",
    re.I,
)
MEASURED = ("work units per step", "seconds")  # columns
ELSEWHERE = "Seconds of coupled scenes by each kind of coupling: [coupling-kinds](coupling-kinds.md).\n"


def without_seconds(text: str) -> str:
    """The page without seconds and work units where both drivers run a scene."""

    def table(match: "re.Match[str]") -> str:
        rows = [line.strip("| ").split(" | ") for line in match.group(1).splitlines()]
        if len(rows) < 4:  # names, rule, one driver
            return match.group(0)
        kept = [i for i, name in enumerate(rows[0]) if name not in MEASURED]
        lines = [" | ".join(row[i] for i in kept) for row in rows]
        return "".join(f"| {line} |\n" for line in lines) + "\n" + ELSEWHERE

    return COST.sub(table, text)


def main(words: List[str]) -> int:
    if len(words) != 1 or words[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 1
    folder = Path(words[0])
    try:
        text = (folder / "report.md").read_text(encoding="utf-8")
        text = with_pictures(text, folder, TOP / "docs" / "pictures", "gallery", "../pictures")
        page = TOP / "docs" / "evidence" / "gallery.md"
        page.write_text(without_seconds(text), encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        fail(f"{folder}: {error}; run fsi-compare gallery first")
    print(page)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
