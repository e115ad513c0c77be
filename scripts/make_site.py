"""Makes the documentation site: one tree of static pages with search, the gallery and the API, from the Markdown of the
repository by mkdocs (Debian packages mkdocs and mkdocs-material).

Every link is checked: to pages, headings, pictures and files, in the repository, as its host shows the pages, and in the
site; also the files of the repository that pages name. Dead ones are listed, the exit code is 1, and FOLDER stays as it
was. Links to other sites are not followed.

usage: python3 scripts/make_site.py FOLDER [--api HTML]
  FOLDER       where the site goes; what a former call made there is replaced
  --api HTML   the API documentation (build/release/api/html), copied to FOLDER/api/html; without it a page in its place
               says how it is made

The pages open from the disk; their search needs a server: python3 -m http.server -d FOLDER
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import List, NoReturn, Optional

from site_links import dead_in_repository, dead_in_site

TOP = Path(__file__).resolve().parents[1]
REPOSITORY_PAGES = ("CONTRIBUTING.md", "CHANGELOG.md")
REPOSITORY_FILES = ("CITATION.cff",)  # that pages link to
MARK = ".made-by-make_site"  # a folder that holds it may be replaced
NO_API = """# API of the C++ code

`cmake --build --preset release --target api` makes it, `--target site` the site with it (Debian package doxygen).
"""


def stage(pages: Path) -> None:
    """Puts all pages into one folder, as the site's links see them: README.md is its start."""
    shutil.copytree(TOP / "docs", pages, ignore=shutil.ignore_patterns("*.in", "mkdocs.yml"))
    (pages / "index.md").write_text(_from_top((TOP / "README.md").read_text(encoding="utf-8")), encoding="utf-8")
    for name in REPOSITORY_PAGES:
        (pages / name).write_text(_from_top((TOP / name).read_text(encoding="utf-8")), encoding="utf-8")
    for name in REPOSITORY_FILES:
        shutil.copyfile(TOP / name, pages / name)
    for page in pages.rglob("*.md"):
        text = page.read_text(encoding="utf-8")
        up = os.path.relpath(pages, page.parent)
        above = "../" * (len(page.relative_to(pages).parts))  # from a page of docs/ to the repository's top
        for name in REPOSITORY_PAGES:
            text = text.replace(f"]({above}{name}", f"]({'' if up == '.' else up + '/'}{name}")
        text = text.replace(f"]({above}README.md", f"]({'' if up == '.' else up + '/'}index.md")
        page.write_text(_lists_apart(text), encoding="utf-8")


def _from_top(text: str) -> str:
    """Links of a page that lies at the repository's top, seen from docs/."""
    text = re.sub(r"\]\(docs/", "](", text)
    return text.replace("](README.md", "](index.md")


def _lists_apart(text: str) -> str:
    """Python's Markdown wants an empty line before a list or a table that follows a paragraph; the pages' other readers
    do not. Text between fences stays."""
    lines: List[str] = []
    fenced = False
    for line in text.split("\n"):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        before = lines[-1] if lines else ""
        starts = re.match(r"([-*] |\d+\. |\|)", line)
        if not fenced and starts and before.strip() and not re.match(r"\s*([-*] |\d+\. |\||  )", before):
            lines.append("")
        lines.append(line)
    return "\n".join(lines)


def make(folder: Path, api: Optional[Path]) -> None:
    if folder.exists() and any(folder.iterdir()) and not (folder / MARK).exists():
        fail(f"{folder} holds something else; name another folder")
    with tempfile.TemporaryDirectory() as scratch:
        pages = Path(scratch) / "docs"
        stage(pages)
        if api is None:
            (pages / "api" / "html").mkdir(parents=True)
            (pages / "api" / "html" / "index.md").write_text(NO_API, encoding="utf-8")
        settings = (TOP / "docs" / "mkdocs.yml").read_text(encoding="utf-8")
        if api is None:
            settings = settings.replace("api/html/index.html", "api/html/index.md")
        (Path(scratch) / "mkdocs.yml").write_text(settings, encoding="utf-8")
        site = Path(scratch) / "site"
        try:
            process = subprocess.run(
                ["mkdocs", "build", "-f", f"{scratch}/mkdocs.yml", "-d", str(site)],
                capture_output=True,
                text=True,
                timeout=600,
            )
        except FileNotFoundError:
            fail("there is no mkdocs; install the Debian packages mkdocs and mkdocs-material")
        lines = process.stderr.splitlines()
        told = [line for line in lines if line.startswith(("WARNING", "ERROR")) and "api/html/index.html" not in line]
        if process.returncode or told:
            fail("mkdocs: " + " ".join(told or lines))
        if api is not None:
            shutil.copytree(api, site / "api" / "html")
        refuse([f"in the repository: {link}" for link in dead_in_repository(TOP)])
        refuse([f"in the site: {link}" for link in dead_in_site(site)])
        (site / MARK).touch()
        if folder.exists():
            shutil.rmtree(folder)
        shutil.copytree(site, folder)
    print(f"{folder / 'index.html'}: no dead links")


def refuse(dead: List[str]) -> None:
    """Ends with the list of dead links, if there are any."""
    for link in dead:
        print(f"make_site: dead link {link}", file=sys.stderr)
    if dead:
        fail(f"{len(dead)} dead links; mend the pages, nothing was written")


def main(words: List[str]) -> int:
    if len(words) not in (1, 3) or words[0].startswith("-") or (len(words) == 3 and words[1] != "--api"):
        print(__doc__, file=sys.stderr)
        return 1
    api = Path(words[2]) if len(words) == 3 else None
    if api is not None and not (api / "index.html").is_file():
        fail(f"{api} holds no index.html; make it by cmake --build --preset release --target api")
    make(Path(words[0]), api)
    return 0


def fail(text: str) -> NoReturn:
    line = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)
    print(f"make_site: error: {line[:2000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
