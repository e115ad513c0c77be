"""The check of a release must be able to fail: each mistake that it is there for, planted in a small tree."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from release import main

CLEAN = {
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.22)\nproject(fsi-duo VERSION 1.2.3 LANGUAGES CXX)\n",
    "CHANGELOG.md": "# Changelog\n\n## Unreleased\n\n## 1.2.3 (2026-03-02)\n### New\n\n## 1.2.0 (2026-03-01)\n",
    "scripts/evidence/items.toml": '[[item]]\nname = "one"\n\n[[item]]\nname = "two"\n',
    "LICENSE": "MIT License\n\nCopyright\n",
    "docs/guide/install.md": "find_package(fsi-duo 1.2 REQUIRED)\n",
    "CITATION.cff": """cff-version: 1.2.0
message: Please cite it.
title: fsi-duo
version: 1.2.3
date-released: 2026-03-02
license: MIT
authors:
  - name: the authors
references:
  - type: article
    title: A paper
    year: 2018
    authors:
      - family-names: Doe
""",
}


class Release(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        for name, text in CLEAN.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)

    def said(self):
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            code = main([str(self.root)])
        return code, output.getvalue()

    def test_clean(self):
        self.assertEqual(self.said(), (0, ""))

    def write(self, name, old, new):
        text = (self.root / name).read_text()
        self.assertIn(old, text)
        (self.root / name).write_text(text.replace(old, new))

    def test_a_version_in_work(self):
        self.write("CMakeLists.txt", "1.2.3", "1.3.0")
        self.assertIn("install.md: find_package(fsi-duo 1.2)", self.said()[1])
        self.write("docs/guide/install.md", "1.2", "1.3")
        self.assertEqual(self.said(), (0, ""))
        self.write("scripts/evidence/items.toml", '"two"', '"two"\ndue = true')
        self.assertEqual(self.said(), (0, ""))
        self.write("CHANGELOG.md", "## Unreleased\n", "")
        code, said = self.said()
        self.assertEqual(code, 1)
        self.assertIn("the newest version is 1.2.3, that of CMakeLists.txt 1.3.0", said)
        self.assertIn("due: two, but 1.3.0 is released", said)

    def test_mistakes(self):
        for name, old, new, expected in (
            ("CMakeLists.txt", "1.2.3", "1.2.2", "CHANGELOG.md: the newest version is 1.2.3"),
            ("CHANGELOG.md", "1.2.3", "1.2.4", "CITATION.cff: version: is 1.2.3"),
            ("CMakeLists.txt", "1.2.3", "1.3.0", "install.md: find_package(fsi-duo 1.2)"),
            ("docs/guide/install.md", "find_package", "find", "install.md: does not say find_package(fsi-duo 1.2"),
            ("CMakeLists.txt", " VERSION 1.2.3", "", "has no VERSION"),
            ("CHANGELOG.md", " (2026-03-02)", "", "'## 1.2.3' is no '## VERSION"),
            ("CHANGELOG.md", "2026-03-02", "2026-02-02", "dates do not descend"),
            ("CHANGELOG.md", "1.2.0", "1.2.4", "versions do not descend"),
            ("CHANGELOG.md", "## 1.2.0 (2026-03-01)", "## Unreleased", "'## Unreleased' is no"),
            ("CITATION.cff", "2026-03-02", "2026-03-03", "date-released: is 2026-03-03"),
            ("CITATION.cff", "2026-03-02", "soon", "date-released: is missing or no date"),
            ("CITATION.cff", "license: MIT", "license: BSD-3-Clause", "LICENSE is the MIT License"),
            ("CITATION.cff", "cff-version: 1.2.0", "cff-version: 1.1.0", "is not 1.2.0"),
            ("CITATION.cff", "message: Please cite it.\n", "", "message: is missing"),
            ("CITATION.cff", "version: 1.2.3", "version: 1.2", "version: is missing or no text"),
            ("CITATION.cff", "  - name: the authors\n", "", "authors: are missing"),
            ("CITATION.cff", "family-names: Doe", "surname: Doe", "references[1]: authors: "),
            ("CITATION.cff", "type: article", "type: novel", "references[1]: type"),
            ("CITATION.cff", "year: 2018", "year: soon", "references[1]: year"),
            ("CITATION.cff", "title: fsi-duo", "title: [fsi-duo", "CITATION.cff: while parsing"),
        ):
            with self.subTest(file=name, new=new):
                (self.root / name).write_text(CLEAN[name].replace(old, new))
                code, said = self.said()
                self.assertEqual(code, 1)
                self.assertIn(expected, said)
                (self.root / name).write_text(CLEAN[name])


if __name__ == "__main__":
    unittest.main()
