"""The documentation site: every page is there, every link within it leads somewhere, its search knows the pages."""

import json
import subprocess
import sys
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from programs import FolderTest

TOP = Path(__file__).resolve().parents[3]
SCRIPT = TOP / "scripts" / "make_site.py"


class Page(HTMLParser):
    """Links to and anchors on a page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], {""}
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name in ("id", "name") and value:
                self.anchors.add(value)


def make(*words):
    return subprocess.run([sys.executable, "-B", SCRIPT, *map(str, words)], capture_output=True, text=True, timeout=300)


class Site(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.site = cls.base / "site"
        cls.process = make(cls.site)

    def test_pages(self):
        self.assertEqual(self.process.returncode, 0, self.process.stderr)
        for page in TOP.glob("docs/**/*.md"):
            made = self.site / page.relative_to(TOP / "docs").with_suffix(".html")
            self.assertTrue(made.is_file(), made)
        self.assertIn("fsi-duo", (self.site / "index.html").read_text(encoding="utf-8"))

    def test_every_link_leads_somewhere(self):
        pages = {path: Page(path) for path in self.site.rglob("*.html")}
        self.assertGreater(len(pages), 20)
        lost = []
        for path, page in pages.items():
            if path.name == "404.html":  # whose links are a server's
                continue
            for link in page.links:
                parts = urlsplit(link)
                if parts.scheme or parts.netloc or link.startswith("/"):
                    self.assertIn(parts.scheme, ("http", "https", "mailto", "data"), f"{path}: {link}")
                    continue
                target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
                if target.is_dir():
                    target = target / "index.html"
                known = pages.get(target)
                if not target.is_file() or (known and unquote(parts.fragment) not in known.anchors):
                    lost.append(f"{path.relative_to(self.site)}: {link}")
        self.assertEqual(lost, [])

    def test_nothing_is_loaded_from_elsewhere(self):
        for path in self.site.rglob("*.html"):
            text = path.read_text(encoding="utf-8")
            for mark in ('src="http', 'rel="stylesheet" href="http', "@import url(http"):
                self.assertNotIn(mark, text, path)

    def test_search_knows_the_pages(self):
        index = json.loads((self.site / "search" / "search_index.json").read_text(encoding="utf-8"))
        places = {entry["location"].partition("#")[0] for entry in index["docs"]}
        self.assertLessEqual({"theory.html", "tutorial.html", "gallery.html", "index.html"}, places)
        self.assertTrue(any("Mooney-Rivlin" in entry["text"] for entry in index["docs"]))

    def test_only_a_site_is_replaced(self):
        other = self.base / "other"
        other.mkdir()
        (other / "mine.txt").write_text("mine")
        process = make(other)
        self.assertEqual(process.returncode, 1)
        self.assertIn("holds something else", process.stderr)
        self.assertEqual([path.name for path in other.iterdir()], ["mine.txt"])
        self.assertEqual(make(self.site).returncode, 0)


if __name__ == "__main__":
    unittest.main()
