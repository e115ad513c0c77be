"""Dead links: of the pages as they lie in the repository, and of the site that make_site.py makes of them. Links to other
sites are not followed.
"""

import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Dict, Iterator, List, Optional, Set, Tuple
from urllib.parse import unquote, urlsplit

FENCED = re.compile(r"^ *```.*?^ *```", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`([^`\n]+)`")
LINK = re.compile(r"\]\(([^()\s]+)\)")
# A file of the repository that a page names in code, without placeholders or patterns.
NAMED = re.compile(r"(?:cmake|common|compare|docs|gallery|meshes|monolithic|partitioned|scripts|tests)/[\w./-]*\w")


# ---- pages of the repository, as their hosts show them ----


def dead_in_repository(top: Path) -> Iterator[str]:
    """Links to files and headings, and files named in code, that are not there."""
    anchors: Dict[Path, Set[str]] = {}
    for page in [*sorted(top.glob("*.md")), *sorted(top.glob("docs/**/*.md"))]:
        text = page.read_text(encoding="utf-8")
        prose = FENCED.sub("", text)
        for link in LINK.findall(CODE.sub("", prose)):
            if not _leads_somewhere(page, link, anchors):
                yield f"{page.relative_to(top)}: {link}"
        for code in CODE.findall(prose):
            for word in code.split():
                if NAMED.fullmatch(word) and not (top / word).exists() and not _stands_for_others(top, word):
                    yield f"{page.relative_to(top)}: `{word}`"


def _leads_somewhere(page: Path, link: str, anchors: Dict[Path, Set[str]]) -> bool:
    parts = urlsplit(link)
    if parts.scheme:
        return True
    target = (page.parent / unquote(parts.path)).resolve() if parts.path else page.resolve()
    if not target.exists():
        return False
    if not parts.fragment or target.suffix != ".md":
        return not parts.fragment
    if target not in anchors:
        anchors[target] = _headings(target.read_text(encoding="utf-8"))
    return unquote(parts.fragment) in anchors[target]


def _headings(text: str) -> Set[str]:
    """Anchors of a page: of its headings, as GitHub names them, and its own."""
    prose = FENCED.sub("", text)
    found = set(re.findall(r'<a id="([^"]+)">', prose))
    for title in re.findall(r"^#+ (.*)$", prose, re.MULTILINE):
        words = LINK.sub("]", title).replace("[", "").replace("]", "").replace("`", "").lower()
        found.add(re.sub(r"[^\w\- ]", "", words).strip().replace(" ", "-"))
    return found


def _stands_for_others(top: Path, word: str) -> bool:
    """Whether a name in capitals is to be replaced, or a command makes the file: a mesh, which git leaves out."""
    return bool(re.search(r"\b[A-Z]{4,}\b", word)) or (word.endswith(".msh") and (top / word).parent.is_dir())


# ---- the site ----


class Page(HTMLParser):
    """Links to and anchors on a page."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: List[str] = []
        self.anchors = {""}
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: List[Tuple[str, Optional[str]]]) -> None:
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name in ("id", "name") and value:
                self.anchors.add(value)


def dead_in_site(site: Path) -> Iterator[str]:
    """Links of the site's pages to pages, headings, pictures and other files of it that are not there. The API's pages
    are Doxygen's own: they are looked at as targets alone."""
    pages: Dict[Path, Page] = {}
    for path in sorted(site.rglob("*.html")):
        if path.name == "404.html" or path.is_relative_to(site / "api"):  # links of the first are a server's
            continue
        pages.setdefault(path.resolve(), Page(path))
        for link in pages[path.resolve()].links:
            parts = urlsplit(link)
            if parts.scheme in ("http", "https", "mailto", "data"):
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path.resolve()
            if target.is_dir():
                target = target / "index.html"
            good = not parts.scheme and not parts.netloc and not link.startswith("/") and target.is_file()
            if good and target.suffix == ".html" and target not in pages:
                pages[target] = Page(target)
            if not good or (target in pages and unquote(parts.fragment) not in pages[target].anchors):
                yield f"{path.relative_to(site)}: {link}"
