"""Keeps the gallery's page under docs/: text and tables as docs/gallery.md, pictures as docs/pictures/gallery-*.png.

usage: python3 scripts/keep_gallery.py FOLDER    (results/gallery, as fsi-compare gallery leaves it)
"""

import sys
from pathlib import Path
from typing import List

from keep_study import TOP, fail, with_pictures


def main(words: List[str]) -> int:
    if len(words) != 1 or words[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 1
    folder = Path(words[0])
    try:
        text = (folder / "report.md").read_text(encoding="utf-8")
        text = with_pictures(text, folder, TOP / "docs" / "pictures", "gallery", "pictures")
        page = TOP / "docs" / "gallery.md"
        page.write_text(text, encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        fail(f"{folder}: {error}; run fsi-compare gallery first")
    print(page)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
