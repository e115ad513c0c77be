"""Runs the commands of a section of the tutorial and keeps the picture that the page shows of them.

usage: python3 scripts/evidence/tutorial_picture.py BIN WORK    (build/release/bin; WORK holds meshes and runs)
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import List

from keep_study import TOP, fail

PAGE = TOP / "docs/guide/tutorial.md"
SECTION, PICTURE = '<a id="your-mesh"></a>', "bend.png"
KEPT = TOP / "docs/pictures/tutorial-bend.png"


def commands() -> str:
    """The section's commands, to its end."""
    before, found, after = PAGE.read_text(encoding="utf-8").partition(SECTION)
    section = re.split(r"(?m)^<a id=", after)[0]
    blocks = re.findall(r"(?ms)^```sh\n(.*?)^```", section)
    if not found or not any(PICTURE in block for block in blocks):
        fail(f"{PAGE}: no commands behind {SECTION} that make {PICTURE}")
    return "\n".join(blocks)


def main(words: List[str]) -> int:
    if len(words) != 2 or words[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 1
    work = Path(words[1]) / "bend"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    path = {**os.environ, "PATH": f"{Path(words[0]).resolve()}:{os.environ['PATH']}"}
    if subprocess.run(["bash", "-euc", commands()], cwd=work, env=path, check=False).returncode:
        fail(f"{PAGE}: a command of the section {SECTION} failed, in {work}")
    shutil.copyfile(work / PICTURE, KEPT)
    print(KEPT)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
