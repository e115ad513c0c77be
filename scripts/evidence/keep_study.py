"""Keeps the report of a finished study under docs/: its text and tables as docs/evidence/NAME.md, its pictures as
docs/pictures/NAME-*.png. The sections "All runs" and "All quantities" stay behind, as do pictures that the report does not show.

usage: python3 scripts/evidence/keep_study.py FOLDER...    (results/studies/NAME, as fsi-compare study NAME leaves it)
"""

import os
import re
import shutil
import sys
from pathlib import Path
from typing import NoReturn

TOP = Path(__file__).resolve().parents[2]
LEFT_OUT = ("All runs", "All quantities")


def keep(folder: Path, docs: Path) -> Path:
    name = folder.resolve().name
    try:
        text = (folder / "report.md").read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        fail(f"{folder}/report.md cannot be read: {error}; run fsi-compare study first")
    sections = re.split(r"(?m)^(?=## )", text)
    text = "".join(
        section for section in sections if not section.startswith(tuple(f"## {name}\n" for name in LEFT_OUT))
    )
    text = with_pictures(text, folder, docs / "pictures", name, "../pictures")
    path = docs / "evidence" / f"{name}.md"
    path.write_text(text, encoding="utf-8")
    return path


def with_pictures(text: str, folder: Path, pictures: Path, name: str, link: str) -> str:
    """Copies the pictures that a page shows, as NAME-*.png, and turns its links to them."""
    for old in pictures.glob(f"{name}-*.png"):
        old.unlink()
    for picture in re.findall(r"\]\(([^()/]+\.png)\)", text):
        shutil.copyfile(folder / picture, pictures / f"{name}-{picture}")
    return re.sub(r"\]\(([^()/]+\.png)\)", rf"]({link}/{name}-\1)", text)


def main(words) -> int:
    if not words or words[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 1
    for word in words:
        if not os.path.isfile(Path(word) / "report.md"):
            fail(f"{word} holds no report.md; run fsi-compare study first")
        try:
            print(keep(Path(word), TOP / "docs"))
        except OSError as error:
            fail(f"{error.filename}: {error.strerror}; run fsi-compare study anew, or mend the permissions of docs/")
    return 0


def fail(text: str) -> NoReturn:
    line = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)
    print(f"{Path(sys.argv[0]).stem}: error: {line[:1000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
