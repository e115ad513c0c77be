"""The vessel in a report, as its reader meets it: a browser turns it, plays it, reads nodes whose values are those of fields.h5;
without JavaScript, without the library and in print there are stills."""

import base64
import contextlib
import io
import json
import re
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from browser import PROGRAM, Browser
from folder_case import FolderCase
from matplotlib.image import imread
from synthetic import write_run
from synthetic_fields import TIMES, channel, channel_fields, write_fields, write_turned
from test_report import outside_references

from fsi_compare import open_run
from fsi_compare.reporting import vessel_library
from fsi_compare.reporting.scene import ReportScene
from fsi_compare.reporting.vessel import vessel_of
from fsi_compare.reporting.vessel_library import PROGRAM as THREE
from fsi_compare.start import main

NAMES = ("one", "two <b>&")
VESSEL = "document.querySelector('.vessel').vessel"
READY = "new Promise(done => (function look() { document.querySelector('.vessel').dataset.ready ? done(true) : setTimeout(look, 20); })())"
AS_OPENED = (
    "(v => { v.play(false); Object.assign(v.state, { quantity: v.data.first, show: 'all', factor: 1, unit: '', cut: false, "
    "time: v.nearest(v.data.start), swept: false, on: {} }); v.fieldList.value = v.data.first; v.runList.value = 'all'; "
    "v.viewList.value = 0; v.ownUnit(); v.look(v.data.views[0]); v.pick(null); return v.rebuild(); })(%s)" % VESSEL
)
DRAWN = (
    "(v => v.ready.then(() => new Promise(done => (function look() { v.view.waiting || v.view.coarse ? "
    "requestAnimationFrame(look) : requestAnimationFrame(() => done(true)); })())))(%s)" % VESSEL
)
SELECTS = ("Field", "Unit", "Run", "View")
TITLE = "A <script>alert(1)</script> channel"


def write_channels(base):
    folders = []
    for name, factor in (("one", 1.0), ("two", 1.25)):
        folder = write_run(base / name, lambda t, z: z + t, geometry="3d", title=TITLE)
        folders.append(write_fields(folder, factor=factor))
    return folders


def without_library(page):
    """The page less the deflated library and the scene's data."""
    return re.sub(r'<script type="(?:text/plain|application/json)".*?</script>', "", page, flags=re.S)


def no_figure(folder, stem, draw):
    paths = [folder / f"{stem}.png", folder / f"{stem}.svg"]
    for path in paths:
        path.write_bytes(b"")
    return paths


@contextlib.contextmanager
def few_pictures(stills=True):
    """Curves are drawn by other tests, and each still takes a second."""
    with contextlib.ExitStack() as stack:
        stack.enter_context(mock.patch("fsi_compare.reporting.report.write_figure", no_figure))
        stack.enter_context(mock.patch("fsi_compare.reporting.vessel.STILLS", 1))
        if not stills:
            stack.enter_context(mock.patch("fsi_compare.reporting.vessel.stills_of", lambda vessel: []))
        yield


class Made(FolderCase):
    """What a report says, before any browser."""

    def report(self, *arguments, stills=False):
        with few_pictures(stills):
            code, out, err = self.call("report", *arguments, "-o", self.out)
        self.assertEqual(code, 0, err)
        return (self.out / "report.html").read_text()

    def test_page_and_what_one_reads_first(self):
        page = self.report(*write_channels(self.base), "--labels", ",".join(NAMES), stills=True)
        self.assertEqual(outside_references(without_library(page)), [])
        self.assertNotIn("<script>alert", page)
        self.assertNotIn("in<b>", page)  # the name of an opening
        self.assertEqual(page.count("Over time."), 0)
        if THREE.exists():
            self.assertIn("Drawn by three.js 0.111.0, MIT licence", page)
            self.assertIn("The above copyright notice and this permission notice shall be included", page)
        rows = {(row["run"], row["opening"]): row for row in self.csv("openings.csv")}
        self.assertEqual(len(rows), 4)
        self.assertEqual(float(rows[NAMES[1], "out"]["share_of_outflow"]), 1.0)
        self.assertAlmostEqual(float(rows["one", "in<b>"]["maximum_pressure_kPa"]), 2.0)
        self.assertAlmostEqual(float(rows["one", "in<b>"]["maximum_pressure_mmHg"]), 15.00124, places=4)
        places = {(row["run"], row["quantity"]): row for row in self.csv("places.csv")}
        shear = places[NAMES[1], "wall shear stress"]
        self.assertAlmostEqual(float(shear["largest"]), 1.25 * 4e-3)
        self.assertEqual(
            (shear["surface"], shear["time_ms"], shear["x_mm"], shear["y_mm"]), ("lumen", "4.0", "1.0", "1.0")
        )
        self.assertAlmostEqual(float(places["one", "von Mises stress"]["largest"]), 20)
        self.assertEqual(float(places["one", "von Mises stress"]["z_mm"]), 4.0)
        apart = {row["quantity"]: row for row in self.csv("field_differences.csv")}
        self.assertAlmostEqual(float(apart["pressure"]["largest_difference"]), 0.25 * 2)
        self.assertEqual(float(apart["displacement"]["largest_difference"]), 0)
        samples = {(row["sample"], row["column"]): row for row in self.csv("sample_differences.csv")}
        self.assertEqual(float(samples["out", "windkessel_pressure_Pa"]["largest_value"]), 0)
        self.assertNotIn("windkessel_pressure_Pa", without_library(page), "zero in both runs")
        self.assertIn("mean_pressure_Pa", without_library(page))

    def test_opens_when_its_field_is_largest(self):
        one, _ = write_channels(self.base)
        fields = {
            medium: {name: (unit, lambda x, t, of=of: of(x, t * (5 - t))) for name, (unit, of) in there.items()}
            for medium, there in channel_fields().items()
        }
        write_fields(one, fields=fields, times=np.arange(6.0))
        scene = ReportScene(["one"], vessel_of([open_run(one)], ["one"]).scenes)
        self.assertIn(scene.values()["content"]["start"], (2.0, 3.0))

    def test_another_mesh(self):
        one, two = write_channels(self.base)
        write_fields(two, channel((2, 2, 7)))
        self.assertIn(
            "two: its fields are on another mesh than those of one; no difference is shown.", self.report(one, two)
        )
        write_fields(two, times=TIMES[:-1])
        self.assertIn("two: its fields are at other times than those of one", self.report(one, two))

    def test_fields_of_another_run(self):
        one, _ = write_channels(self.base)
        summary = json.loads((one / "summary.json").read_text())
        for own, right in ((6 * (2 * 2 * 6 + 2 * 6), True), (100, False)):
            (one / "summary.json").write_text(json.dumps({**summary, "mesh": {"tetrahedra": own}}))
            with few_pictures(stills=False):
                code, _, err = self.call("report", one, "-o", self.base / f"of_{own}")
            self.assertEqual(code, 0 if right else 1, err)
        self.assertIn("fields.h5: has 216 cells, the run's mesh 100 by summary.json: it belongs to another run", err)
        self.assertEqual(len(err.splitlines()), 1)
        self.assertFalse((self.base / "of_100").exists())

    def test_fewer_times_and_triangles(self):
        one, _ = write_channels(self.base)
        write_fields(one, times=np.arange(21.0))
        with mock.patch("fsi_compare.reporting.scene_thinning.MOST_TRIANGLES", 100):
            page = self.report(one, "--frames", "10")
        self.assertIn("one: 10 of 21 times of fields.h5 are shown.", page)
        self.assertRegex(page, r"one: \d+ of \d+ triangles are shown")

    def test_without_the_library(self):
        with mock.patch.object(vessel_library, "PROGRAM", Path("/nowhere/three.js")):
            page = self.report(write_channels(self.base)[0], stills=True)
        self.assertIn("The vessel is shown as still pictures: install the Debian package libjs-three", page)
        self.assertIn('src="data:image/png', page)
        self.assertNotIn('vessel-library">', page)


@unittest.skipUnless(
    PROGRAM and THREE.exists(), "needs the Debian packages chromium and libjs-three (scripts/packages*.txt)"
)
class InABrowser(FolderCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = cls.enterClassContext(Browser(webgl=True))
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        runs = [str(run) for run in write_channels(cls.folder)]
        with few_pictures():
            if main(["report", *runs, "-o", str(cls.folder / "out"), "--labels", ",".join(NAMES), "-q"]) != 0:
                raise AssertionError("the report was not made")
        cls.page = cls.folder / "out" / "report.html"
        cls.fluid = open_run(cls.folder / "two").fields["fluid"]
        cls.shown = None

    def setUp(self):
        super().setUp()
        self.show(self.page)

    def show(self, page):
        """Opened once for all tests; afterwards as it was when it opened."""
        if type(self).shown == page:
            self.browser.events.clear()
            self.browser.await_(AS_OPENED)
        else:
            self.browser.open(page)
            self.browser.await_(READY)
            type(self).shown = page
        self.drawn()

    def choose(self, label, value):
        """In a list, as a reader does."""
        number = SELECTS.index(label)
        self.browser.evaluate(
            f"(s => {{ s.value = {value!r}; s.dispatchEvent(new Event('change')); }})(document.querySelectorAll('.vessel select')[{number}])"
        )
        self.drawn()

    def drawn(self):
        """Waits until the page has built what was chosen, and drawn it."""
        self.browser.await_(DRAWN)

    def readout(self):
        return self.browser.evaluate("document.querySelector('.vessel .readout').textContent")

    def tick(self, text):
        """Clicks a box by its words."""
        self.browser.evaluate(
            "Array.from(document.querySelectorAll('.vessel .groups label')).filter(l => l.textContent.trim() === "
            f"{text!r})[0].querySelector('input').click()"
        )
        self.drawn()

    def colours(self):
        """How many different colours the canvas shows; a busy machine may take a while to show what was drawn."""
        left, top, width, height = self.browser.box(".vessel canvas")
        for _ in range(20):
            self.drawn()
            shot = self.browser.send("Page.captureScreenshot", format="png")
            image = imread(io.BytesIO(base64.b64decode(shot["data"])))
            part = image[round(top) + 30 : round(top + height), round(left) : round(left + width), :3]
            found = len(np.unique((part * 255).reshape(-1, 3), axis=0))
            if found > 3:
                break
        return found

    def click_node(self, pane, part, node):
        left, top, _, _ = self.browser.box(".vessel canvas")
        x, y = self.browser.evaluate(f"{VESSEL}.screen({pane}, {part!r}, {node})")
        self.browser.click(left + x, top + y)

    def test_draws_and_says_nothing(self):
        self.drawn()
        self.assertGreater(self.colours(), 50)
        self.assertEqual(self.browser.complaints, [])
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('.vessel b').length"), 0)

    def test_turns(self):
        left, top, width, height = self.browser.box(".vessel canvas")
        before = self.browser.evaluate(f"{VESSEL}.view.towards.toArray()")
        self.browser.drag((left + 200, top + 200), (left + 300, top + 220))
        after = self.browser.evaluate(f"{VESSEL}.view.towards.toArray()")
        self.assertGreater(np.linalg.norm(np.subtract(before, after)), 0.2)
        self.assertAlmostEqual(np.linalg.norm(after), 1, places=5)
        zoom = f"{VESSEL}.view.zoom"
        self.browser.send(
            "Input.dispatchMouseEvent", type="mouseWheel", x=left + 200, y=top + 200, deltaX=0, deltaY=-200
        )
        self.assertGreater(self.browser.evaluate(zoom), 1.2)
        views = self.browser.evaluate(
            "Array.from(document.querySelectorAll('.vessel select')[3].options, o => o.textContent)"
        )
        self.assertEqual(
            views, ["oblique", *(f"from {s}{a}" for a in "xyz" for s in ("", "-")), "from in<b>", "from out"]
        )
        self.choose("View", str(views.index("from out")))
        np.testing.assert_allclose(self.browser.evaluate(f"{VESSEL}.view.towards.toArray()"), [0, 0, 1], atol=1e-6)
        self.assertEqual(self.browser.evaluate(zoom), 1)

    def test_plays(self):
        self.browser.evaluate("document.querySelector('.vessel button').click()")
        moved = "new Promise(done => { const seen = new Set(); (function look() { seen.add(%s.state.time);" % VESSEL
        moved += " if (seen.size > 3) done(seen.size); else setTimeout(look, 20); })(); })"
        self.assertGreater(self.browser.await_(moved), 3)
        self.browser.evaluate("document.querySelector('.vessel button').click()")
        clock = self.browser.evaluate("document.querySelector('.vessel output').textContent")
        self.assertIn(clock, [f"t = {t:g} ms" for t in TIMES])

    def test_reads_a_node(self):
        """Of the second run, against fields.h5."""
        self.choose("View", "1")  # from x: onto the interface, lumen in front
        self.choose("Field", "pressure")
        self.choose("Unit", "kPa")
        self.browser.evaluate(
            "(s => { s.value = 3; s.dispatchEvent(new Event('input')); })(document.querySelector('.vessel input[type=range]'))"
        )
        self.drawn()
        nodes = self.browser.evaluate(
            f"Array.from({VESSEL}.runs[1].parts.filter(p => p.spec.name === 'lumen')[0].nodes)"
        )
        points = self.fluid.points[nodes]
        inside = np.flatnonzero(
            (points[:, 0] == 1) & (points[:, 1] == 0.5) & (points[:, 2] > 0.5) & (points[:, 2] < 3.5)
        )
        for local in inside[:2].tolist():
            self.click_node(1, "lumen", local)
            text = self.readout()
            self.assertIn(f"lumen, node {nodes[local]} of the fluid", text)
            values = {name: self.values_of(run)[nodes[local]] for name, run in zip(NAMES, ("one", "two"))}
            for name, value in values.items():
                found = float(re.search(re.escape(name) + r" (\S+) kPa", text)[1])
                self.assertAlmostEqual(found, value, delta=6e-5 + 5e-4 * value)
        self.choose("Unit", "mmHg")
        found = float(re.search(r"one (\S+) mmHg", self.readout())[1])
        self.assertAlmostEqual(found, 7.50062 * values["one"], delta=2e-3)
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('.vessel .curve path').length"), 2)
        self.assertEqual(self.browser.complaints, [])

    def values_of(self, run):
        return open_run(self.folder / run).fields["fluid"].at(3.0, "pressure")

    def test_switches_field_and_run(self):
        legend = "document.querySelector('.vessel .legend').textContent"
        self.choose("Field", "von_mises_stress")
        self.assertIn("von Mises stress in kPa", self.browser.evaluate(legend))
        self.assertIn("0 to 20 occur", self.browser.evaluate(legend))
        shown = f"{VESSEL}.view.panes.map(p => p.drawings.map(d => d.part.spec.name).join('+')).join()"
        self.assertIn("inner+outer", self.browser.evaluate(shown))
        self.choose("Run", "1")
        self.assertEqual(self.browser.evaluate(f"{VESSEL}.view.panes.length"), 1)
        self.choose("Field", "pressure")
        self.choose("Run", "apart1")
        self.assertIn("pressure in kPa, difference", self.browser.evaluate(legend))
        self.assertIn("-0.5 to 0.5 occur", self.browser.evaluate(legend))
        # The difference of a node, at the last time: a quarter of the first run's value.
        number, node = self.browser.evaluate(
            f"(p => {{ const i = p.points.findIndex((z, k) => k % 3 === 2 && z > 1.9 && z < 2.1); const n = (i - 2) / 3; return [n, p.nodes[n]]; }})"
            f"({VESSEL}.view.panes[0].drawings.filter(d => d.part.spec.name === 'lumen')[0].part)"
        )
        found = self.browser.evaluate(
            f"(v => v.view.panes[0].drawings.filter(d => d.part.spec.name === 'lumen')[0].part.difference(v.quantity(), {number}, [3, 1]))({VESSEL})"
        )
        first = open_run(self.folder / "one").fields["fluid"].at(4.0, "pressure")[node]
        self.assertAlmostEqual(found, 0.25 * first, delta=1e-5)
        self.assertEqual(self.browser.complaints, [])

    def test_cuts(self):
        self.tick("cut open")
        names = f"{VESSEL}.view.panes[0].drawings.map(d => d.part.spec.name)"
        self.assertIn("fluid cut", self.browser.evaluate(names))
        cutting = f"{VESSEL}.view.panes[0].drawings.map(d => d.mesh.material.uniforms.cutting.value)"
        self.assertEqual(sorted(set(self.browser.evaluate(cutting))), [0, 1])
        self.choose("Field", "velocity")
        self.assertGreater(self.colours(), 3)
        self.assertEqual(self.browser.complaints, [])

    def test_a_place_of_the_table_turns_the_view(self):
        row = self.browser.evaluate(
            "Array.from(document.querySelectorAll('[data-look]')).findIndex(b => JSON.parse(b.dataset.look).quantity === 'von_mises_stress')"
        )
        self.assertGreaterEqual(row, 0)
        left, top, width, height = self.browser.box("[data-look]", row)
        self.browser.click(left + width / 2, top + height / 2)
        self.drawn()
        self.assertRegex(self.readout(), r"node \d+ of the wall at \(.*, 4\) mm: von Mises stress 20 kPa")
        self.assertEqual(self.browser.complaints, [])

    def heights(self, selector, browser=None):
        """Of the elements as they are laid out; zero: not shown."""
        browser = browser or self.browser
        root = browser.send("DOM.getDocument", depth=0)["root"]["nodeId"]
        found = []
        for node in browser.send("DOM.querySelectorAll", nodeId=root, selector=selector)["nodeIds"]:
            try:
                found.append(browser.send("DOM.getBoxModel", nodeId=node)["model"]["height"])
            except AssertionError:  # it has no box
                found.append(0)
        return found

    def test_without_javascript_and_in_print(self):
        self.assertEqual(set(self.heights(".stills img")), {0})
        self.assertGreater(self.heights(".vessel canvas")[0], 300)
        pdf = self.browser.send("Page.printToPDF", printBackground=True)["data"]
        printed = base64.b64decode(pdf)
        self.assertTrue(printed.startswith(b"%PDF"))
        self.assertGreaterEqual(printed.count(b"/Subtype /Image"), 2)
        self.browser.send("Emulation.setEmulatedMedia", media="print")
        try:
            self.assertEqual(self.heights(".vessel"), [0])
            self.assertTrue(all(height > 100 for height in self.heights(".stills img")))
        finally:
            self.browser.send("Emulation.setEmulatedMedia", media="")
        type(self).shown = None
        self.browser.open(self.page, javascript=False)
        self.assertTrue(all(height > 100 for height in self.heights(".stills img")))
        self.assertEqual(self.heights(".vessel canvas"), [])

    def test_without_webgl(self):
        with Browser() as plain:
            plain.open(self.page)
            plain.await_("document.body.innerText.includes('it lacks WebGL')")
            self.assertTrue(all(height > 100 for height in self.heights(".stills img", plain)))
            self.assertEqual(set(self.heights(".vessel canvas", plain)) - {0}, set())
            self.assertEqual(plain.complaints, [])

    def test_turned_scene(self):
        folder = write_run(self.base / "pipe", lambda t, z: z + t, geometry="axisymmetric")
        with few_pictures(stills=False):
            self.assertEqual(main(["report", str(write_turned(folder)), "-o", str(self.out), "-q"]), 0)
        self.show(self.out / "report.html")
        self.assertGreater(self.colours(), 30)
        size = f"{VESSEL}.view.panes[0].drawings.filter(d => d.part.spec.name === 'lumen')[0].made.source.length"
        flat = self.browser.evaluate(size)
        self.tick("swept around the axis")
        self.assertGreater(self.browser.evaluate(size), 10 * flat)
        self.choose("Field", "wall_shear_stress")
        self.assertGreater(self.colours(), 3)
        self.assertEqual(self.browser.complaints, [])


if __name__ == "__main__":
    unittest.main()
