"""The report that plays, as its reader meets it: slider, keys, mouse, print, and a browser without JavaScript. The waves are
linear in time and place, so that whatever is read has one right value."""

import re
import tempfile
import unittest
from pathlib import Path

import numpy as np
from browser import PROGRAM, Browser
from folder_case import FolderCase
from synthetic import write_run
from test_report import outside_references

from fsi_compare.start import main
from fsi_compare.reporting.player import MovingLine, Panel, Player, Series, axis, packed
from fsi_compare.reporting.scene_packing import NONE
from fsi_compare.runs.levels import thinned
from fsi_compare.reporting.templating import render

TIMES = 0.25 * np.arange(1, 21)  # ms
Z = np.linspace(0, 6, 31)
NAMES = ("first", "second <b>&")
SLIDER = "document.querySelector('.player input[type=range]')"
READOUTS = "Array.from(document.querySelectorAll('.readout'), p => p.textContent)"
TITLES = "Array.from(document.querySelectorAll('.panel figcaption'), p => p.textContent)"


def pressure(run, t, z):
    return (1 + run) * (10 * t + z)


def radial(run, t, z):
    return 0.01 * (1 + run) * (t - 0.1 * z)


def flow(run, opening, t):
    return (1 + run) * (2 * t - 3 if opening == "a" else -t)


def write_runs(base):
    folders = []
    for run in (0, 1):
        folder = write_run(base / f"run{run}", lambda t, z, run=run: pressure(run, t, z), TIMES, Z)
        lines = ["time_ms,z_mm,radial_mm,axial_mm"]
        lines += [f"{t},{z},{radial(run, t, z)},0" for t in TIMES for z in Z]
        (folder / "wall_displacement.csv").write_text("\n".join(lines) + "\n")
        lines = ["time_ms,opening,flow_mm3_per_ms,mean_pressure_Pa,windkessel_pressure_Pa"]
        lines += [f"{t},{name},{flow(run, name, t)},{100 * t},{50 * t}" for t in TIMES for name in "ab"]
        (folder / "openings.csv").write_text("\n".join(lines) + "\n")
        folders.append(folder)
    return folders


class Packing(unittest.TestCase):
    def test_numbers_come_back(self):
        import base64

        values = np.array([[-3.0, np.nan, 4.5], [1.25, 0.0, 6.0]])
        found = packed(values)
        numbers = np.frombuffer(base64.b64decode(found["data"]), "<u2")
        self.assertEqual(numbers[1], NONE)
        back = np.where(numbers == NONE, np.nan, found["low"] + found["step"] * numbers)
        np.testing.assert_allclose(back, values.ravel(), atol=9.0 / 65534)
        for same in ([2.5, 2.5], [np.nan], []):
            self.assertEqual(packed(np.array(same))["step"], 0)

    def test_axes(self):
        self.assertEqual(axis(np.array([0.5, 1.0, 1.5])), {"low": 0.5, "step": 0.5, "count": 3})
        self.assertEqual(axis(np.array([0.5, 1.0, 1.6])), {"numbers": [0.5, 1.0, 1.6]})

    def test_long_runs_stay_small(self):
        self.assertEqual(thinned(5, 9).tolist(), [0, 1, 2, 3, 4])
        self.assertEqual(thinned(1001, 3).tolist(), [0, 500, 1000])
        times, z = np.arange(1.0, 5001), np.linspace(0, 18, 181)
        lines = [MovingLine(run, times, z, np.ones((len(times), len(z)))) for run in range(12)]
        series = [Series(run, times, np.sin(times)) for run in range(12)]
        player = Player(
            [f"run {i}" for i in range(12)], [Panel("p", ("z", "mm"), ("p", "Pa"), lines) for _ in range(3)]
        )
        player.panels.append(Panel("q", ("time", "ms"), ("q", "mm^3/ms"), series=series))
        page = render(
            "report.html.j2", title="", sections=[], blocks=[("player", player.values())], plays=True, shows=False
        )
        self.assertLess(len(page), 4e6)
        self.assertIn("of 5000 move here", page)


@unittest.skipUnless(PROGRAM, "needs the Debian package chromium (scripts/packages-test.txt)")
class InABrowser(FolderCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = cls.enterClassContext(Browser())
        folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        runs = [str(run) for run in write_runs(folder)]
        labels = ["--labels", ",".join(NAMES), "--times", "1,5", "-q"]
        if main(["report", *runs, "-o", str(folder / "out"), *labels]) != 0:
            raise AssertionError("the report was not made")
        cls.page = folder / "out" / "report.html"

    def readouts(self):
        """By the heading of its diagram: the line of values under it."""
        return dict(zip(self.browser.evaluate(TITLES), self.browser.evaluate(READOUTS)))

    def time(self):
        return self.browser.evaluate("document.querySelector('.player output').textContent")

    def move_to(self, stop):
        """The slider itself, and the event that a browser sends when it is moved."""
        self.browser.evaluate(f"{SLIDER}.value = {stop}, {SLIDER}.dispatchEvent(new Event('input', {{bubbles: true}}))")

    def curve(self, panel, run):
        """Values of a curve, from its path and the numbers beside the axis."""
        text = self.browser.evaluate(
            f"document.querySelectorAll('.panel')[{panel}].querySelector('path.curve[data-run=\"{run}\"]').getAttribute('d')"
        )
        ticks = self.browser.evaluate(
            f"Array.from(document.querySelectorAll('.panel')[{panel}].querySelectorAll('text[text-anchor=end]'),"
            " t => [Number(t.textContent), Number(t.getAttribute('y')) - 4])"
        )
        (low, y_low), (high, y_high) = ticks[0], ticks[-1]
        heights = np.array([float(y) for _, y in re.findall(r"[ML]([-\d.]+) ([-\d.]+)", text)])
        return low + (high - low) * (heights - y_low) / (y_high - y_low)

    def check(self, t):
        """All diagrams at a time."""
        self.assertEqual(self.time(), f"t = {t:.4g} ms")
        found = self.readouts()
        for run, name in enumerate(NAMES):
            largest = pressure(run, t, Z[-1])
            self.assertIn(f"{name} {largest:.4g} Pa at 6 mm", found["Pressure along the centre line"])
            self.assertIn(f"{name} {radial(run, t, 0):.4g} mm at 0 mm", found["Radial displacement of the inner wall"])
            for opening in "ab":
                text = found[f"Flow outwards: {opening}"]
                self.assertTrue(text.startswith(f"time {t:.4g} ms: "), text)
                value = float(re.search(re.escape(name) + r" (\S+) mm\^3/ms", text)[1])
                self.assertAlmostEqual(value, flow(run, opening, t), delta=2e-3)
            np.testing.assert_allclose(self.curve(0, run), pressure(run, t, Z), atol=0.35)  # a tenth of a pixel

    def test_slider(self):
        self.browser.open(self.page)
        self.check(0.25)
        self.assertEqual(self.browser.evaluate(f"[{SLIDER}.min, {SLIDER}.max].join()"), "0,19")
        for stop in (11, 19, 4):
            self.move_to(stop)
            self.check(TIMES[stop])
        self.browser.evaluate(f"{SLIDER}.focus()")
        self.browser.press("ArrowRight", 39)
        self.check(TIMES[5])
        self.browser.press("ArrowLeft", 37)
        self.browser.press("ArrowLeft", 37)
        self.check(TIMES[3])
        self.browser.press("End", 35)
        self.check(TIMES[-1])
        self.assertEqual(self.browser.evaluate(f"{SLIDER}.getAttribute('aria-valuetext')"), "5 ms")
        # A click in the middle of the slider, as with a mouse.
        left, top, width, height = self.browser.box(".player input[type=range]")
        self.browser.click(left + width / 2, top + height / 2)
        self.assertIn(self.time(), ("t = 2.5 ms", "t = 2.75 ms"))
        self.assertEqual(self.browser.complaints, [])

    def test_runs_on_and_off(self):
        self.browser.open(self.page)
        self.move_to(7)
        left, top, width, height = self.browser.box(".player .runs input", 1)
        self.browser.click(left + width / 2, top + height / 2)
        for text in self.readouts().values():
            self.assertIn("first", text)
            self.assertNotIn("second", text)
        shown = "Array.from(document.querySelectorAll('path.curve'), p => p.getAttribute('visibility') + p.dataset.run)"
        self.assertEqual(set(self.browser.evaluate(shown)), {"visible0", "hidden1"})
        self.browser.press(" ", 32, " ")  # the box has the focus
        self.check(TIMES[7])
        self.assertEqual(set(self.browser.evaluate(shown)), {"visible0", "visible1"})

    def test_values_under_the_pointer(self):
        self.browser.open(self.page)
        self.move_to(9)
        left, top, width, height = self.browser.box(".panel svg")
        for part in (0.3, 0.55, 0.9):
            self.browser.mouse("Moved", left + part * width, top + 0.5 * height)
            text = self.readouts()["Pressure along the centre line"]
            z = float(re.match(r"z (\S+) mm: ", text)[1])
            self.assertAlmostEqual(z, 6 * (part * 560 - 66) / (560 - 66 - 14), delta=0.03)
            for run, name in enumerate(NAMES):
                value = float(re.search(re.escape(name) + r" (\S+) Pa", text)[1])
                self.assertAlmostEqual(value, pressure(run, TIMES[9], z), delta=0.02)
        self.browser.mouse("Moved", 1, 1)
        self.assertTrue(self.readouts()["Pressure along the centre line"].startswith("largest: "))
        # The same by keys.
        self.browser.evaluate("document.querySelector('.panel svg').focus()")
        for _ in range(3):
            self.browser.press("ArrowRight", 39)
        text = self.readouts()["Pressure along the centre line"]
        self.assertTrue(text.startswith("z 3.18 mm: first "), text)
        self.assertAlmostEqual(float(re.search(r"first (\S+) Pa", text)[1]), pressure(0, TIMES[9], 3.18), delta=0.02)

    def ticks(self):
        return self.browser.evaluate(
            "Array.from(document.querySelector('.panel').querySelectorAll('.axes text:not(.label)[text-anchor=middle]'),"
            " t => Number(t.textContent))"
        )

    def test_zoom(self):
        self.browser.open(self.page)
        whole = self.ticks()
        self.assertEqual((whole[0], whole[-1]), (0, 6))
        left, top, width, height = self.browser.box(".panel svg")
        at = [left + width * (66 + 480 * z / 6) / 560 for z in (2, 3)]
        self.browser.drag((at[0], top + 0.3 * height), (at[1], top + 0.7 * height))
        close = self.ticks()
        self.assertTrue(1.9 < close[0] and close[-1] < 3.1 and len(close) > 3, close)
        self.assertFalse(self.browser.evaluate("document.querySelector('.reset').hidden"))
        # Curves are still in their place.
        self.browser.mouse("Moved", (at[0] + at[1]) / 2, top + 0.5 * height)
        z = float(re.match(r"z (\S+) mm: ", self.readouts()["Pressure along the centre line"])[1])
        self.assertAlmostEqual(z, 2.46, delta=0.1)
        box = self.browser.box(".reset")
        self.browser.click(box[0] + box[2] / 2, box[1] + box[3] / 2)
        self.assertEqual(self.ticks(), whole)
        self.browser.evaluate("document.querySelector('.panel svg').focus()")
        self.browser.press("+", 187, "+")
        self.assertLess(self.ticks()[-1], 6)
        self.browser.press("0", 48, "0")
        self.assertEqual(self.ticks(), whole)
        self.assertEqual(self.browser.complaints, [])

    def test_scale_to_the_time_shown(self):
        self.browser.open(self.page)
        self.move_to(0)
        before = self.curve(0, 1)
        box = self.browser.box(".fit")
        self.browser.click(box[0] + box[2] / 2, box[1] + box[3] / 2)
        np.testing.assert_allclose(self.curve(0, 1), before, atol=0.35)
        highest = "Math.max(...Array.from(document.querySelector('.panel').querySelectorAll('text[text-anchor=end]'), t => t.textContent))"
        self.assertLess(self.browser.evaluate(highest), 25)  # of 112 at all times
        self.move_to(19)
        self.assertGreater(self.browser.evaluate(highest), 90)

    def test_playing(self):
        self.browser.open(self.page)
        self.browser.evaluate("document.querySelector('.player button').click()")
        moved = (
            "new Promise(done => { const begin = Date.now(); (function look() { const n = Number(%s.value);" % SLIDER
        )
        moved += " if (n > 1 || Date.now() - begin > 20000) done(n); else setTimeout(look, 20); })(); })"
        answer = self.browser.send("Runtime.evaluate", expression=moved, awaitPromise=True, returnByValue=True)
        self.assertGreater(answer["result"]["value"], 1)
        self.browser.evaluate("document.querySelector('.player button').click()")
        stop = int(self.browser.evaluate(f"{SLIDER}.value"))
        self.check(TIMES[stop])

    def visible(self, selector):
        """Heights of the elements in the page as it is laid out; zero: not shown."""
        root = self.browser.send("DOM.getDocument", depth=0)["root"]["nodeId"]
        found = []
        for node in self.browser.send("DOM.querySelectorAll", nodeId=root, selector=selector)["nodeIds"]:
            try:
                found.append(self.browser.send("DOM.getBoxModel", nodeId=node)["model"]["height"])
            except AssertionError:  # it has no box
                found.append(0)
        return found

    def test_without_javascript(self):
        self.browser.open(self.page, javascript=False)
        self.assertEqual(self.visible(".player"), [0])
        self.assertEqual(self.visible(".panel"), [])
        self.assertEqual(len(self.visible("figure img")), 4)
        self.assertTrue(all(height > 100 for height in self.visible("figure img")))
        self.browser.open(self.page)
        self.assertGreater(self.visible(".player")[0], 500)
        self.assertEqual(len(self.visible(".panel")), 9)

    def test_print(self):
        self.browser.open(self.page)
        self.browser.send("Emulation.setEmulatedMedia", media="print")
        try:
            self.assertEqual(self.visible(".player"), [0])
            self.assertTrue(all(height > 100 for height in self.visible("figure img")))
        finally:
            self.browser.send("Emulation.setEmulatedMedia", media="")

    def test_lines_differ_without_colour(self):
        self.browser.open(self.page)
        dashes = "Array.from(document.querySelectorAll('.panel:first-child path.curve'), p => p.getAttribute('stroke-dasharray'))"
        self.assertEqual(len(set(self.browser.evaluate(dashes))), 2)
        self.assertEqual(
            self.browser.evaluate("document.querySelectorAll('.player .runs b').length"), 0, "a label became an element"
        )

    def test_one_file(self):
        self.assertEqual(outside_references(self.page.read_text()), [])

    def test_complaints_would_be_seen(self):
        page = self.base / "bad.html"
        for text in ("throw new Error('broken')", "console.error('broken')"):
            page.write_text(f"<!DOCTYPE html><html><body><script>{text}</script></body></html>")
            self.browser.open(page)
            self.assertNotEqual(self.browser.complaints, [], text)


class Command(FolderCase):
    def test_wrong_use(self):
        folder = write_run(self.base / "run", lambda t, z: pressure(0, t, z), TIMES, Z)
        for arguments, problem in (
            ([self.base / "none"], "no such folder"),
            ([folder, "--times", "1,9"], "9 ms is outside the run; give times between 0.25 and 5 ms"),
            ([folder] * 25, "25 runs do not fit a report; give at most 24"),
            ([folder, "--threads", "0"], "--threads: 0 is not positive"),
            ([folder, "--labels", "a,b"], "--labels: 2 labels for 1 runs"),
        ):
            code, out, err = self.call("report", *arguments, "-o", self.out)
            self.assertEqual((code, out), (1, ""))
            self.assertIn(problem, err)
            self.assertFalse(self.out.exists())

    def test_files(self):
        folder = write_run(self.base / "run", lambda t, z: pressure(0, t, z), TIMES, Z)
        code, out, err = self.call("report", folder, "-o", self.out)
        self.assertEqual((code, err), (0, ""))
        names = {Path(name).name for name in out.removeprefix("Written: ").strip().split(", ")}
        self.assertEqual(names | {"report.md"}, {path.name for path in self.out.iterdir()})
        self.assertIn("pressure_along_the_centre_line.svg", names)

    def test_says_where_runs_are_of_two_machines(self):
        shape, words = lambda t, z: pressure(0, t, z), "These runs are of 2 processors: A, B; compare work units"
        folders = {
            name: write_run(
                self.base / name,
                shape,
                TIMES,
                Z,
                machine={"processor": processor},
                totals={"work_units_per_step": work},
            )
            for name, processor, work in (("one", "A", 310.0), ("two", "A", None), ("third", "B", 2500.0))
        }
        code, _, err = self.call("report", folders["one"], folders["two"], "-o", self.out)
        self.assertEqual((code, err), (0, ""))
        self.assertNotIn("These runs are of", (self.out / "report.html").read_text())
        self.assertEqual([run["work_units_per_step"] for run in self.csv("runs.csv")], ["310.0", ""])
        code, _, err = self.call("report", *folders.values(), "-o", self.out)
        self.assertEqual((code, err), (0, f"fsi-compare: note: {words}, not seconds\n"))
        page = (self.out / "report.html").read_text()
        self.assertEqual(page.count(words), 1)
        self.assertIn("<td>2,500</td>", page)


if __name__ == "__main__":
    unittest.main()
