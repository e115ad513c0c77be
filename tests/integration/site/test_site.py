"""The documentation site: every page is there, its search knows the pages, and dead links are refused, each kind of them."""

import json
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from programs import FolderTest

TOP = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(TOP / "scripts"))

from site_links import dead_in_repository, dead_in_site  # noqa: E402


def make(*words, top=TOP):
    command = [sys.executable, "-B", top / "scripts" / "make_site.py", *words]
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=300)


class Site(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.site = cls.base / "site"
        cls.process = make(cls.site)

    def test_pages(self):
        self.assertEqual((self.process.returncode, self.process.stderr), (0, ""))
        for page in TOP.glob("docs/**/*.md"):
            made = self.site / page.relative_to(TOP / "docs").with_suffix(".html")
            self.assertTrue(made.is_file(), made)
        self.assertIn("fsi-duo", (self.site / "index.html").read_text(encoding="utf-8"))

    def test_readmes_picture_is_on_the_first_page(self):
        self.assertTrue(
            'src="pictures/artery-both-drivers.png"' in (self.site / "index.html").read_text(encoding="utf-8")
        )
        self.assertTrue((self.site / "pictures" / "artery-both-drivers.png").is_file())

    def test_nothing_is_loaded_from_elsewhere(self):
        for path in self.site.rglob("*.html"):
            text = path.read_text(encoding="utf-8")
            for mark in ('src="http', 'rel="stylesheet" href="http', "@import url(http"):
                self.assertNotIn(mark, text, path)

    def test_search_knows_the_pages(self):
        index = json.loads((self.site / "search" / "search_index.json").read_text(encoding="utf-8"))
        places = {entry["location"].partition("#")[0] for entry in index["docs"]}
        self.assertLessEqual({"theory.html", "guide/tutorial.html", "evidence/gallery.html", "index.html"}, places)
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

    def test_dead_links_are_listed_and_leave_the_old_site(self):
        top = self.base / "repository"
        for name in ("docs", "scripts"):
            shutil.copytree(TOP / name, top / name)
        for path in TOP.iterdir():
            if path.name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "CITATION.cff"):
                shutil.copyfile(path, top / path.name)
            elif path.is_dir() and not (top / path.name).exists():
                (top / path.name).symlink_to(path)
        site = self.base / "from a copy"
        self.assertEqual(make(site, top=top).returncode, 0)
        before = (site / "energy.html").read_bytes()
        with open(top / "docs" / "energy.md", "a", encoding="utf-8") as page:
            page.write("\nSee [there](theory.md#section-nowhere) and `scripts/gone.py`.\n")
        process = make(site, top=top)
        self.assertEqual(process.returncode, 1)
        first, second, last = process.stderr.splitlines()
        self.assertEqual(first, "make_site: dead link in the repository: docs/energy.md: theory.md#section-nowhere")
        self.assertEqual(second, "make_site: dead link in the repository: docs/energy.md: `scripts/gone.py`")
        self.assertIn("2 dead links", last)
        self.assertEqual((site / "energy.html").read_bytes(), before)


class DeadLinks(FolderTest):
    """Small trees whose links are good, and one mistake after the other."""

    PAGES = {
        "README.md": "# Start\n[page](docs/page.md#the-first-part), [mark](docs/page.md#mark), [script](scripts/do.py)\n",
        "docs/page.md": '# Page\n<a id="mark"></a>\n## The first part\n![p](pictures/p.png) `scripts/do.py FOLDER`, '
        "`compare/NAME.toml`, `scripts/x.msh`, [up](../README.md), [out](https://example.org/x)\n"
        "```\n[no link](of/code.md)\n```\n",
        "docs/pictures/p.png": "",
        "scripts/do.py": "",
    }
    SITE = {
        "index.html": '<a href="page.html#part">x</a><img src="p.png"><a href="https://example.org">x</a><a href="#">x</a>',
        "page.html": '<h1 id="part">x</h1><a href="index.html">x</a><a href="folder/">x</a><a href="api/html/a.html#m">x</a>',
        "folder/index.html": '<a href="../page.html">x</a>',
        "api/html/a.html": '<a id="m"></a><a href="of_doxygen.html">x</a>',
        "404.html": '<a href="/gone.html">x</a>',
        "p.png": "",
    }

    def dead(self, search, files, name="", old="", new=""):
        """What the search finds in a tree, one of whose files has a mistake."""
        top = self.base / f"tree {len(list(self.base.iterdir()))}"
        for file, text in files.items():
            (top / file).parent.mkdir(parents=True, exist_ok=True)
            self.assertTrue(file != name or old in text)
            (top / file).write_text(text.replace(old, new) if file == name else text)
        return list(search(top))

    def test_in_the_repository(self):
        self.assertEqual(self.dead(dead_in_repository, self.PAGES), [])
        for name, old, new, said in (
            ("README.md", "#the-first-part", "#the-second", "README.md: docs/page.md#the-second"),
            ("README.md", "#mark", "#other", "README.md: docs/page.md#other"),
            ("README.md", "(scripts/do.py", "(scripts/do.sh", "README.md: scripts/do.sh"),
            ("README.md", "docs/page.md#mark", "page.md", "README.md: page.md"),
            ("docs/page.md", "p.png", "q.png", "docs/page.md: pictures/q.png"),
            ("docs/page.md", "../README.md", "README.md", "docs/page.md: README.md"),
            ("docs/page.md", "`scripts/do.py F", "`scripts/dont.py F", "docs/page.md: `scripts/dont.py`"),
        ):
            with self.subTest(new=new):
                self.assertEqual(self.dead(dead_in_repository, self.PAGES, name, old, new), [said])

    def test_in_the_site(self):
        self.assertEqual(self.dead(dead_in_site, self.SITE), [])
        for name, old, new, said in (
            ("index.html", "page.html", "pages.html", "index.html: pages.html#part"),
            ("index.html", "#part", "#parts", "index.html: page.html#parts"),
            ("index.html", "p.png", "q.png", "index.html: q.png"),
            ("index.html", '"#"', '"#top"', "index.html: #top"),
            ("page.html", "#m", "#n", "page.html: api/html/a.html#n"),
            ("page.html", "folder/", "/folder/", "page.html: /folder/"),
            ("folder/index.html", "../page", "page", "folder/index.html: page.html"),
        ):
            with self.subTest(new=new):
                self.assertEqual(self.dead(dead_in_site, self.SITE, name, old, new), [said])


if __name__ == "__main__":
    unittest.main()
