"""release.py ROOT: the version in CMakeLists.txt, the newest version of CHANGELOG.md, CITATION.cff and the page on installing agree, and
CITATION.cff holds what its format, version 1.2.0, demands. While CHANGELOG.md has an "Unreleased", the version in CMakeLists.txt and
on that page may be a later one: that which the programs become, and by which evidence is made for it. What is due of that must be
made when the version is released.
"""

import datetime
import re
import sys
import tomllib
from pathlib import Path
from typing import Any, Iterator, List, Optional, Tuple

import yaml

INSTALL = "docs/guide/install.md"
EVIDENCE = "scripts/evidence/items.toml"
SECTION = re.compile(r"^## (.*)$", re.MULTILINE)
RELEASE = re.compile(r"(\d+\.\d+\.\d+) \((\d{4}-\d{2}-\d{2})\)")
REFERENCE_TYPES = (
    "article",
    "book",
    "conference-paper",
    "report",
    "software",
    "thesis",
    "generic",
)  # those we may need


def project_version(root: Path) -> Optional[str]:
    found = re.search(
        r"^project\([^)]*VERSION (\S+)", (root / "CMakeLists.txt").read_text(encoding="utf-8"), re.MULTILINE
    )
    return found.group(1) if found else None


def releases(text: str) -> Tuple[List[Tuple[str, str]], List[str]]:
    """(version, date) of the sections of a change log, as they stand there, and what is wrong with them."""
    found: List[Tuple[str, str]] = []
    problems: List[str] = []
    for number, title in enumerate(SECTION.findall(text)):
        match = RELEASE.fullmatch(title)
        if match:
            found.append((match.group(1), match.group(2)))
        elif title != "Unreleased" or number > 0:
            problems.append(f"CHANGELOG.md: '## {title}' is no '## VERSION (YYYY-MM-DD)', nor 'Unreleased' at the top")
    order = [numbers(version) for version, _ in found]
    if order != sorted(set(order), reverse=True):
        problems.append("CHANGELOG.md: versions do not descend")
    dates = [date for _, date in found]
    if dates != sorted(dates, reverse=True):
        problems.append("CHANGELOG.md: dates do not descend")
    return found, problems


def wrong_citation(citation: Any) -> Iterator[str]:
    """What the format demands of a file and of each reference, and what of it we use."""
    if not isinstance(citation, dict):
        yield "CITATION.cff: is no mapping"
        return
    for key in ("cff-version", "message", "title", "version", "license"):
        if not isinstance(citation.get(key), str) or not citation[key]:
            yield f"CITATION.cff: {key}: is missing or no text"
    if citation.get("cff-version") != "1.2.0":
        yield "CITATION.cff: cff-version: is not 1.2.0"
    if citation.get("type") not in (None, "software", "dataset"):
        yield "CITATION.cff: type: is neither software nor dataset"
    if not isinstance(citation.get("date-released"), datetime.date):
        yield "CITATION.cff: date-released: is missing or no date"
    yield from _wrong_authors(citation, "")
    for number, reference in enumerate(citation.get("references", []), 1):
        where = f"references[{number}]: "
        if reference.get("type") not in REFERENCE_TYPES or not isinstance(reference.get("title"), str):
            yield f"CITATION.cff: {where}type or title: is missing or unknown"
        if "year" in reference and not isinstance(reference["year"], int):
            yield f"CITATION.cff: {where}year: is no number"
        yield from _wrong_authors(reference, where)


def _wrong_authors(entry: Any, where: str) -> Iterator[str]:
    authors = entry.get("authors")
    if not isinstance(authors, list) or not authors:
        yield f"CITATION.cff: {where}authors: are missing"
        return
    for author in authors:
        keys = set(author) if isinstance(author, dict) else set()
        if not ({"name"} <= keys or {"family-names"} <= keys) or {"name", "family-names"} <= keys:
            yield f"CITATION.cff: {where}authors: {author} is neither a person (family-names) nor an entity (name)"


def problems(root: Path) -> Iterator[str]:
    version = project_version(root)
    if version is None:
        yield "CMakeLists.txt: project(): has no VERSION"
        return
    changes = (root / "CHANGELOG.md").read_text(encoding="utf-8")
    found, wrong = releases(changes)
    yield from wrong
    newest = found[0][0] if found else "none"
    in_work = SECTION.findall(changes)[:1] == ["Unreleased"]
    if newest != version and not (in_work and found and numbers(version) > numbers(newest)):
        yield f"CHANGELOG.md: the newest version is {newest}, that of CMakeLists.txt {version}"
    yield from wrong_of_citation(root, found)
    minor = ".".join(version.split(".")[:2])
    asked = re.findall(r"find_package\(fsi-duo (\S+)", (root / INSTALL).read_text(encoding="utf-8"))
    if not asked:
        yield f"{INSTALL}: does not say find_package(fsi-duo {minor} ...)"
    for one in asked:
        if one != minor:
            yield f"{INSTALL}: find_package(fsi-duo {one}): the version is {version}"
    items = tomllib.loads((root / EVIDENCE).read_text(encoding="utf-8"))["item"]
    due = [item["name"] for item in items if item.get("due")]
    if due and not in_work:
        yield f"{EVIDENCE}: due: {', '.join(due)}, but {version} is released; run scripts/evidence.sh"


def numbers(version: str) -> Tuple[int, ...]:
    return tuple(map(int, version.split(".")))


def wrong_of_citation(root: Path, found: List[Tuple[str, str]]) -> Iterator[str]:
    """Of CITATION.cff, which names the newest of the releases (version, date) found."""
    try:
        citation = yaml.safe_load((root / "CITATION.cff").read_text(encoding="utf-8"))
    except (OSError, yaml.YAMLError) as error:
        yield f"CITATION.cff: {' '.join(str(error).split())}"
        return
    wrong = list(wrong_citation(citation))
    yield from wrong
    if wrong:
        return
    for key, newest in zip(("version", "date-released"), found[0] if found else ()):
        if str(citation[key]) != newest:
            yield f"CITATION.cff: {key}: is {citation[key]}, that of CHANGELOG.md {newest}"
    license_title = (root / "LICENSE").read_text(encoding="utf-8").split("\n", 1)[0]
    if license_title != f"{citation['license']} License":
        yield f"CITATION.cff: license: is {citation['license']}, LICENSE is the {license_title}"


def main(words: List[str]) -> int:
    found = list(problems(Path(words[0])))
    for problem in found:
        print(problem)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
