"""The report: one file that needs nothing else, tables and pictures beside it; shown by a browser."""

import importlib.util
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from folder_case import FolderCase
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from study_case import StudyCase

from fsi_compare.reporting.column import Column
from fsi_compare.reporting.layout import Table
from fsi_compare.reporting.report import Report

SCRIPT = Path(__file__).resolve().parents[3] / "scripts/evidence/keep_study.py"
specification = importlib.util.spec_from_file_location("keep_study", SCRIPT)
keep_study = importlib.util.module_from_spec(specification)
specification.loader.exec_module(keep_study)

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


def line_figure():
    figure = Figure(figsize=(3, 2))
    FigureCanvasAgg(figure)
    figure.subplots().plot([0, 1], [0, 1])
    return figure


def outside_references(page):
    """Everything that a browser would load from elsewhere."""
    loaded = re.findall(r"""(?:src|srcset|poster|data|action)\s*=\s*["'](?!data:)([^"']*)""", page)
    loaded += re.findall(r"""<(?:link|script|iframe|object|embed)[^>]*(?:href|src)\s*=\s*["'](?!data:)([^"']*)""", page)
    loaded += re.findall(r"""href\s*=\s*["'](?!#|data:)([^"']*)""", page)
    return loaded + re.findall(r"https?://\S*|@import[^;]*|url\((?!['\"]?data:)[^)]*", page)


class OneFile(FolderCase):
    def report(self):
        report = Report(self.base, "A <title> & more")
        report.section("Numbers with `code`")
        report.text("Some **bold** text, 1 < 2 & so on.")
        columns = [
            Column("name", "name", lambda record: record[0], left=True),
            Column("{unit}", "pressure", lambda record: record[1], ".1f", "Pa", "pressure"),
            Column("kPa", value=lambda record: "1e-3", group="pressure"),
        ]
        report.table(Table("numbers", "Numbers", columns, [("one <b>", 0.1 + 0.2)], notes=["a note"]))
        report.figure("line", line_figure, "A line, in `mm`")
        return report

    def test_zero_has_no_power_of_ten(self):
        shown = Table("t", "T", [Column("error", "error", lambda record: record, ".1e")], [0.0, 1e-9, None])
        self.assertEqual(shown.rows, [["0"], ["1.0e-09"], ["-"]])

    def test_name_stays_in_one_line(self):
        """A hyphen is no place to break it; words are broken."""
        shown = Table(
            "t", "T", [Column("program", value=lambda record: record, left=True)], ["fsi-monolithic", "two words"]
        )
        report = Report(self.base, "Programs")
        report.table(shown)
        page = report.write().read_text()
        self.assertIn('<td class="l one">fsi-monolithic</td>', page)
        self.assertIn('<td class="l">two words</td>', page)
        self.assertIn("td.one { white-space: nowrap; }", page)

    def test_page(self):
        report = self.report()
        page = report.write().read_text()
        self.assertEqual(outside_references(page), [])
        self.assertIn("<title>A &lt;title&gt; &amp; more</title>", page)
        self.assertIn("one &lt;b&gt;", page)
        self.assertIn("<strong>bold</strong>", page)
        self.assertIn('<th colspan="2">pressure</th>', page)
        self.assertIn('src="data:image/png;base64,', page)
        self.assertIn('alt="A line, in mm"', page)
        self.assertIn('href="#s1"', page)
        for tag in ("table", "figure", "h2", "ul", "p"):
            self.assertEqual(page.count(f"<{tag}>") + page.count(f"<{tag} "), page.count(f"</{tag}>"), tag)

    def test_markdown(self):
        self.report().write()
        text = (self.base / "report.md").read_text()
        self.assertIn("# A <title> & more\n\n## Numbers with `code`\n\nSome **bold** text, 1 < 2 & so on.\n\n**N", text)
        self.assertIn(
            "| name | pressure: Pa | pressure: kPa |\n| --- | ---: | ---: |\n| one <b> | 0.3 | 1e-3 |\n\na note\n", text
        )
        self.assertIn("![line](line.png)\n\nA line, in `mm`\n", text)

    def test_kept_in_docs(self):
        """By scripts/evidence/keep_study.py: without the table of all runs, pictures found from where the text then lies."""
        report = self.report()
        report.section("All runs")
        report.text("Hundreds of them.")
        report.section("About this report")
        report.write()
        docs = self.base / "docs"
        for name in ("evidence", "pictures"):
            (docs / name).mkdir(parents=True)
        (docs / f"pictures/{self.base.name}-gone.png").write_text("of the last edition")
        path = keep_study.keep(self.base, docs)
        text = path.read_text()
        self.assertNotIn("Hundreds", text)
        self.assertIn("## About this report", text)
        (picture,) = re.findall(r"\]\(([^)]*png)\)", text)
        self.assertTrue((path.parent / picture).is_file())
        self.assertEqual(len(list((docs / "pictures").iterdir())), 1)

    def test_files_beside_it(self):
        report = self.report()
        report.write()
        self.assertEqual({path.name for path in report.written}, {"numbers.csv", "line.png", "line.svg", "report.html"})
        self.assertEqual((self.base / "numbers.csv").read_text(), "name,pressure_Pa\none <b>,0.30000000000000004\n")
        self.assertTrue((self.base / "line.png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn("<svg", (self.base / "line.svg").read_text())

    def test_references_are_found(self):
        for page in (
            '<img src="a.png">',
            '<script src="https://cdn/x.js"></script>',
            '<link rel="stylesheet" href="x.css">',
            '<a href="http://somewhere/">',
            "<style>body { background: url(x.png) }</style>",
        ):
            self.assertNotEqual(outside_references(page), [], page)


@unittest.skipUnless(BROWSER, "needs the Debian package chromium (scripts/packages-test.txt)")
class InABrowser(StudyCase):
    def show(self, page):
        """(console lines, size of the picture of the page in bytes)."""
        picture = self.base / "page.png"
        picture.unlink(missing_ok=True)
        home = self.base / "home"
        home.mkdir(exist_ok=True)
        ended = subprocess.run(
            [
                BROWSER,
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-dev-shm-usage",
                "--enable-logging=stderr",
                "--v=0",
                f"--user-data-dir={home}",
                "--virtual-time-budget=5000",
                "--window-size=1200,1600",
                f"--screenshot={picture}",
                page.as_uri(),
            ],
            capture_output=True,
            text=True,
            errors="replace",
            timeout=100,
            env={**os.environ, "HOME": str(home)},
        )
        self.assertTrue(picture.is_file(), ended.stderr[-2000:])
        return [line for line in ended.stderr.splitlines() if "CONSOLE" in line], picture

    def test_opens_without_a_word_on_the_console(self):
        code, _, err = self.call("-q")
        self.assertEqual(code, 0, err)
        lines, picture = self.show(self.out / "report.html")
        self.assertEqual(lines, [])
        import matplotlib.image

        pixels = matplotlib.image.imread(picture)
        self.assertEqual(pixels.shape[:2], (1600, 1200))
        ink = (pixels[:, :, :3].min(axis=2) < 0.5).mean()
        self.assertGreater(ink, 0.001, "the page is blank")

    def test_a_console_error_would_be_seen(self):
        for text in ("<script>throw new Error('broken')</script>", "<script>console.error('broken')</script>"):
            page = self.base / "bad.html"
            head = "<head><link rel='icon' href='data:,'></head>"
            page.write_text(f"<!DOCTYPE html><html>{head}<body>{text}</body></html>")
            lines, _ = self.show(page)
            self.assertNotEqual(lines, [], text)


if __name__ == "__main__":
    unittest.main()
