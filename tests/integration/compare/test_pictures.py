"""The picture: complete, readable in grey, and the same each time."""

import struct
import tempfile
import unittest
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.text import Text
from synthetic import TIMES, Z, gaussian

from fsi_compare.drawing.colours import round_ticks
from fsi_compare.reporting.coinciding import coinciding, labels_that_say_so, sentence_of_coinciding
from fsi_research.drawing.coinciding import note_coinciding
from fsi_research.drawing.log_axes import log_axes, plain_number
from fsi_research.drawing.point_names import name_points
from fsi_compare.reporting.pictures import LINES, pressure_figure, time_text, write_figure
from fsi_compare.runs.pressure_waves import PressureWaves

PAPER = [1.5, 3.0, 4.5, 6.0, 7.5, 9.0]


def waves(speed, height=50.0):
    wave = gaussian(speed, height=height)
    return PressureWaves(TIMES, Z, np.array([wave(t, Z) for t in TIMES]))


def lightness(color):
    red, green, blue = to_rgb(color)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


class Files(unittest.TestCase):
    def write(self, folder, labels=("monolithic", "partitioned"), title="Rabbit carotid artery"):
        runs = [waves(0.66), waves(0.7)]
        return write_figure(folder, "pressure_waves", lambda: pressure_figure(runs, labels, PAPER, title))

    def test_png_and_svg(self):
        with tempfile.TemporaryDirectory() as folder:
            png, svg = self.write(Path(folder))
            head = png.read_bytes()[:24]
            self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
            width, height = struct.unpack(">II", head[16:24])
            self.assertEqual(width, 1480)  # 7.4 inches at 200 dpi
            self.assertTrue(1300 < height < 1600, height)
            text = svg.read_text()
            for part in (
                "z in mm",
                "pressure in Pa",
                "t = 1.50 ms",
                "t = 9.00 ms",
                "monolithic",
                "partitioned",
                "Rabbit carotid artery",
            ):
                self.assertIn(part, text)
            self.assertEqual(
                sorted(path.name for path in Path(folder).iterdir()), ["pressure_waves.png", "pressure_waves.svg"]
            )

    def test_same_bytes_each_time(self):
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two:
            for a, b in zip(self.write(Path(one)), self.write(Path(two))):
                self.assertEqual(a.read_bytes(), b.read_bytes())

    def test_odd_labels(self):
        with tempfile.TemporaryDirectory() as folder:
            _, svg = self.write(Path(folder), labels=("_a $x", "b $ c $ <d> & {e}"), title="100 $ \\ 5_3^2")
            self.assertIn("_a $x", svg.read_text())


class Layout(unittest.TestCase):
    def test_panels_in_reading_order(self):
        figure = pressure_figure([waves(0.66)], ["a"], PAPER, "title")
        self.assertEqual(
            [axes.get_title() for axes in figure.axes],
            ["t = 1.50 ms", "t = 3.00 ms", "t = 4.50 ms", "t = 6.00 ms", "t = 7.50 ms", "t = 9.00 ms"],
        )
        grid = figure.axes[0].get_subplotspec().get_gridspec()
        self.assertEqual((grid.nrows, grid.ncols), (3, 2))

    def test_curves_are_the_data(self):
        figure = pressure_figure([waves(0.66), waves(0.7)], ["a", "b"], PAPER, "title")
        curve = figure.axes[2].get_lines()[1]
        np.testing.assert_array_equal(curve.get_xdata(), Z)
        np.testing.assert_array_equal(curve.get_ydata(), waves(0.7).at(4.5))

    def test_legend_and_title_cover_no_panel(self):
        for runs in (1, 2, 3, 6):
            for label in ("run %d", "a rather long name of run number %d on the intermediate mesh, element p2p1"):
                for times in (PAPER, [1.5], PAPER[:3], list(np.arange(1, 10.0))):
                    with self.subTest(runs=runs, label=label, times=len(times)):
                        figure = pressure_figure(
                            [waves(0.6 + 0.02 * i) for i in range(runs)],
                            [label % i for i in range(runs)],
                            times,
                            "A title " * 12,
                        )
                        figure.canvas.draw()
                        renderer = figure.canvas.get_renderer()
                        legend = figure.legends[0].get_window_extent(renderer)
                        title = figure._suptitle.get_window_extent(renderer)
                        self.assertTrue(legend.x0 >= 0 and legend.x1 <= figure.bbox.x1 and legend.y0 >= 0)
                        self.assertTrue(title.x0 >= 0 and title.x1 <= figure.bbox.x1 and title.y1 <= figure.bbox.y1)
                        for axes in figure.axes:
                            if axes.get_visible():
                                box = axes.get_tightbbox(renderer)
                                self.assertGreater(box.y0, legend.y1)
                                self.assertLess(box.y1, title.y0)

    def test_row_shares_its_scale_unless_one_panel_would_be_flat(self):
        def wave(t, z):  # 90 Pa at 1.5 ms, 9 Pa at 3 ms, 8 Pa afterwards
            return (90 if t < 2 else 9 if t < 4 else 8) * np.exp(-((z - t) ** 2))

        run = PressureWaves(TIMES, Z, np.array([wave(t, Z) for t in TIMES]))
        axes = pressure_figure([run], ["a"], PAPER, "title").axes
        self.assertGreater(axes[0].get_ylim()[1], 5 * axes[1].get_ylim()[1])
        self.assertEqual(axes[2].get_ylim(), axes[3].get_ylim())

    def test_times(self):
        self.assertEqual([time_text(t) for t in (1.5, 10.5, 0.125, 3)], ["1.50", "10.50", "0.125", "3.00"])


class ReadableInGrey(unittest.TestCase):
    def test_all_line_styles_differ(self):
        self.assertEqual(len({str(line["linestyle"]) for line in LINES}), len(LINES))

    def test_paper_order(self):
        self.assertEqual([line["linestyle"] for line in LINES[:4]], ["-", "--", "-.", ":"])

    def test_first_curves_differ_in_lightness(self):
        grey = [lightness(line["color"]) for line in LINES[:3]]
        for i in range(3):
            self.assertLess(grey[i], 0.7, "too light for white paper")
            for j in range(i):
                self.assertGreater(abs(grey[i] - grey[j]), 0.15)

    def test_lines_of_the_figure(self):
        figure = pressure_figure([waves(0.6), waves(0.7), waves(0.8)], ["a", "b", "c"], PAPER, "title")
        for axes in figure.axes:
            curves = axes.get_lines()[:3]
            self.assertEqual(len({curve.get_linestyle() for curve in curves}), 3)


class SaysOneThing(unittest.TestCase):
    """What study pictures share: plain numbers, lines that lie on each other, names at points."""

    def test_plain_numbers(self):
        found = [plain_number(*one) for one in ((1e-5, "%"), (0.1, "%"), (30, "s"), (1e4,), (2.5e6,))]
        self.assertEqual(found, ["0.00001 %", "0.1 %", "30 s", "10,000", "2,500,000"])

    def test_logarithmic_axes(self):
        axes = Figure().subplots()
        axes.plot([0.02, 300], [1e-4, 50])
        log_axes(axes, "s", "%")
        axes.figure.canvas.draw()
        for axis, unit in ((axes.xaxis, "s"), (axes.yaxis, "%")):
            low, high = axis.get_view_interval()
            texts = [l.get_text() for l, at in zip(axis.get_ticklabels(), axis.get_ticklocs()) if low <= at <= high]
            self.assertGreater(len(texts), 3)
            for text in texts:
                self.assertRegex(text, rf"^[0-9.,]+ {unit}$")

    def test_lines_that_lie_on_each_other(self):
        axes = Figure().subplots()
        x = np.linspace(0, 10, 50)
        first, near, far = (axes.plot(x, y)[0] for y in (np.sin(x), np.sin(x) + 0.005, np.sin(x) + 0.1))
        (short,) = axes.plot(x[:20], np.sin(x[:20]))
        self.assertEqual(coinciding([[first, near, far, short]]), [[0, 1]])
        self.assertEqual(coinciding([[first, near], [first, far]]), [])  # not in all panels
        self.assertEqual(labels_that_say_so(["a", "b", "c"], [[far, first, near]]), ["a", "b", "c (lies on b)"])
        note_coinciding(axes, [first, near], ["a", "b"])
        self.assertEqual([text.get_text() for text in axes.texts], ["both lines lie on each other"])

    def test_a_caption_says_it_where_no_legend_does(self):
        def figure(apart):
            drawn = Figure()
            x = np.linspace(0, 1, 50)
            for axes, off in zip(drawn.subplots(2, 1), (0, apart)):
                for label, y in (("a", x), ("b", x + off), ("c", 1 - x), ("d", 1 - x)):
                    axes.plot(x, y, label=label)
                axes.axhline(0.5)
            return drawn

        self.assertEqual(sentence_of_coinciding(figure(0)), "Lines that lie on each other: a and b; c and d.")
        self.assertEqual(sentence_of_coinciding(figure(0.2)), "Lines that lie on each other: c and d.")
        said = figure(0)
        note_coinciding(said.axes[0], said.axes[0].get_lines()[:2], ["a", "b"])
        self.assertEqual(sentence_of_coinciding(said), "")

    def test_runs_that_agree_say_so(self):
        figure = pressure_figure([waves(0.6), waves(0.6), waves(0.8)], ["a", "b", "c"], PAPER, "title")
        names = [text.get_text() for text in figure.legends[0].get_texts()]
        self.assertEqual(names, ["a", "b (lies on a)", "c"])

    def test_names_stand_apart_inside_the_axes(self):
        figure = Figure(figsize=(8, 4))
        FigureCanvasAgg(figure)
        axes = figure.subplots()
        points = [(1, 10), (1.02, 9.9), (1.05, 9.7), (30, 1)]
        axes.plot(*zip(*points), "o")
        log_axes(axes)
        name_points(axes, points, ["a rather long name of a point"] * 4, (6.2, 3.08))
        figure.canvas.draw()
        boxes = [Text.get_window_extent(text) for text in axes.texts]
        frame = axes.get_window_extent()
        for i, box in enumerate(boxes):
            self.assertGreaterEqual(box.x0, frame.x0)
            self.assertGreaterEqual(box.y0, frame.y0)
            for other in boxes[:i]:
                self.assertFalse(box.overlaps(other))

    def test_round_ticks(self):
        self.assertEqual(round_ticks(0, 0.137), [0, 0.05, 0.1])
        self.assertEqual(round_ticks(-7, 7), [-5, 0, 5])
        np.testing.assert_allclose(round_ticks(12.1, 12.9), [12.2, 12.4, 12.6, 12.8])


if __name__ == "__main__":
    unittest.main()
