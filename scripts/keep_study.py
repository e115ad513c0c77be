"""Keeps the report of a finished study under docs/: its text and tables as docs/studies/NAME.md, its pictures as
docs/pictures/NAME-*.png. The section "All runs" stays behind, as do pictures that the report does not show.

usage: python3 scripts/keep_study.py FOLDER...    (results/studies/NAME, as fsi-compare study NAME leaves it)
"""

import re
import shutil
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]
LEFT_OUT = "All runs"


def keep(folder: Path, docs: Path) -> Path:
    name = folder.resolve().name
    text = (folder / "report.md").read_text(encoding="utf-8")
    sections = re.split(r"(?m)^(?=## )", text)
    text = "".join(section for section in sections if not section.startswith(f"## {LEFT_OUT}\n"))
    for old in (docs / "pictures").glob(f"{name}-*.png"):
        old.unlink()
    for picture in re.findall(r"\]\(([^()/]+\.png)\)", text):
        shutil.copyfile(folder / picture, docs / "pictures" / f"{name}-{picture}")
    text = re.sub(r"\]\(([^()/]+\.png)\)", rf"](../pictures/{name}-\1)", text)
    path = docs / "studies" / f"{name}.md"
    path.write_text(text, encoding="utf-8")
    return path


def main(words) -> int:
    if not words or words[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 1
    for word in words:
        if not (Path(word) / "report.md").is_file():
            print(f"keep_study: error: {word} holds no report.md; run fsi-compare study first", file=sys.stderr)
            return 1
        print(keep(Path(word), TOP / "docs"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
