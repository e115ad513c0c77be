"""The study kind accuracy-cost: orders, frontier, extrapolation and errors on made-up data with known answers, and a
whole study with programs that write waves of known error."""

import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from fake_drivers import DRIVERS
from fake_linear_study import make_executable
from folder_case import FolderCase
from synthetic import Z

from fsi_compare.base.errors import InputError
from fsi_research.accuracy.frontier import cheapest, frontier
from fsi_research.accuracy.observed_order import self_convergence, slope
from fsi_research.accuracy.trend import trend
from fsi_compare.runs.waves import QUANTITIES, WINDOW, Waves, averaged, read_waves, relative_difference

TIMES = np.array([1.5, 2.0, 2.5, 3.0])


class ObservedOrder(unittest.TestCase):
    def test_recovers_order_and_error_for_any_ratio_of_sizes(self):
        for order in (0.6, 1.0, 1.8, 3.0):
            for sizes in ((4, 2, 1), (1.0, 0.52, 0.27), (0.3, 0.2, 0.15)):
                errors = [0.07 * h**order for h in sizes]
                found = self_convergence(sizes, (errors[0] - errors[1], errors[1] - errors[2]))
                self.assertAlmostEqual(found.order, order, places=9)
                self.assertAlmostEqual(found.remaining, errors[2], places=9)

    def test_says_nothing_where_nothing_converges(self):
        for distances in ((1.0, 1.5), (1.0, 1.0), (0.0, 0.0), (1.0, 1e-6)):
            found = self_convergence((4, 2, 1), distances)
            self.assertEqual((found.order, found.remaining), (None, None))
        self.assertIsNone(self_convergence((1, 2, 4), (2.0, 1.0)).order)

    def test_slope(self):
        self.assertAlmostEqual(slope([1, 2, 4], [3, 12, 48]), 2)
        self.assertIsNone(slope([1, 1], [2, 3]))


class Frontier(unittest.TestCase):
    POINTS = [(10, 5.0), (1, 50.0), (2, 60.0), (3, 20.0), (3, 21.0), (12, 5.0), (20, 4.95)]

    def test_keeps_what_no_other_beats(self):
        self.assertEqual(frontier(self.POINTS), [1, 3, 0, 6])

    def test_a_gain_that_is_too_small_does_not_count(self):
        self.assertEqual(frontier(self.POINTS, 0.02), [1, 3, 0])

    def test_points_that_are_not_numbers_are_left_out(self):
        self.assertEqual(frontier([(math.nan, 1), (1, math.nan), (2, 3)]), [2])

    def test_cheapest(self):
        self.assertEqual(cheapest(self.POINTS, 25), 3)
        self.assertEqual(cheapest(self.POINTS, 5), 0)
        self.assertIsNone(cheapest(self.POINTS, 1))


class Trends(unittest.TestCase):
    def points(self, exponent, errors=(0.4, 0.3, 0.2, 0.16)):
        return [(10 * (errors[-1] / e) ** (1 / exponent), e) for e in errors]

    def test_goes_on_as_the_frontier_falls(self):
        found = trend(self.points(0.5) + [(20.0, 0.9)])
        self.assertAlmostEqual(found.exponent, 0.5)
        self.assertAlmostEqual(found.seconds(0.04), 160)  # a quarter of the error in 4^2 times the seconds

    def test_coarser_settings_do_not_count(self):
        self.assertAlmostEqual(trend([(1e-6, 0.9), *self.points(0.5)]).exponent, 0.5)

    def test_says_nothing_far_away(self):
        self.assertIsNone(trend(self.points(0.5)).seconds(0.03))

    def test_says_nothing_without_a_fall(self):
        self.assertIsNone(trend(self.points(0.01)))
        self.assertIsNone(trend(self.points(0.5)[:1] + [(10.0, 0.16)]), "two points")
        self.assertIsNone(trend([]))


class Errors(unittest.TestCase):
    def waves(self, factor, shift=0.0, times=TIMES):
        return Waves(times, Z, factor * np.array([np.sin(Z / 3 + t) + shift for t in times]))

    def test_relative_difference(self):
        self.assertAlmostEqual(relative_difference(self.waves(1.1), self.waves(1), TIMES), 0.1)
        self.assertAlmostEqual(relative_difference(self.waves(0), self.waves(1), TIMES[1:]), 1)
        self.assertTrue(math.isnan(relative_difference(self.waves(1), self.waves(0), TIMES)))

    def test_levels_and_points_between(self):
        waves = Waves(np.array([1.0, 2.0]), np.array([0.0, 1.0]), np.array([[0.0, 2.0], [4.0, 6.0]]))
        self.assertEqual(waves.at([1.5], np.array([0.5])).tolist(), [[3.0]])
        with self.assertRaises(ValueError):
            waves.at([2.5], waves.z)

    def test_averages_take_whole_oscillations_away(self):
        times = np.linspace(0, 3, 1201)
        slow, fast = 1 + times, np.sin(2 * np.pi * times / (WINDOW / 2))
        found = averaged(Waves(times, Z, np.outer(slow + 5 * fast, np.ones(len(Z)))), [2.0, 1.0])
        self.assertEqual(found.times.tolist(), [1.0, 2.0])
        np.testing.assert_allclose(found.values, [[2.0] * len(Z), [3.0] * len(Z)], atol=1e-3)

    def test_averages_of_uneven_steps_and_where_the_window_leaves_them(self):
        times = np.array([0.0, 0.1, 0.35, 1.0])
        found = averaged(Waves(times, Z, np.outer(3 * times, Z)), [0.3, 0.5, 0.7])
        np.testing.assert_allclose(found.values[1], 1.5 * Z)
        self.assertTrue(np.isnan(found.values[[0, 2]]).all())

    def test_a_file_with_a_missing_point_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "wall_displacement.csv"
            path.write_text("time_ms,z_mm,radial_mm\n1,0,1\n1,1,2\n2,0,3\n")
            with self.assertRaisesRegex(InputError, "time_ms 2: has 1 of 2 points"):
                read_waves(path, "radial_mm")


# A driver of known error: 0.16 size^2 + 0.8 step + 10 tolerance, size 1, 1/2, 1/4; 1e-6 s a node and step.
DRIVER = """#!{python} -EB
import json, math, sys
from pathlib import Path
words = sys.argv
if words[1] == "--version":
    print(Path(words[0]).name, "0.1.0")
    sys.exit(0)
settings = dict(words[i + 1].split("=", 1) for i, word in enumerate(words) if word == "--set")
folder = Path(words[words.index("-o") + 1])
folder.mkdir(parents=True, exist_ok=True)
program = Path(words[0]).name
step, end = float(settings["time.step"]), float(settings["time.end"])
level = ["coarse", "intermediate", "fine"].index(settings["mesh.level"])
tolerance = float(settings.get("newton.tolerance", settings.get("partitioned.tolerance", 1e-8)))
if tolerance > 0.4:
    print(program + ": error: diverged", file=sys.stderr)
    sys.exit(2)
error = 0.16 / 4 ** level + 0.8 * step + 10 * tolerance
nodes, steps = 1000 * 8 ** level, round(end / step)
for file, column in (("centerline_pressure.csv", "pressure_Pa"), ("wall_displacement.csv", "radial_mm,axial_mm")):
    with open(folder / file, "w") as out:
        out.write("time_ms,z_mm," + column + "\\n")
        for k in range(1, steps + 1):
            for i in range(19):
                value = (1 + error) * math.sin(1 + i / 3 + k * step)
                out.write("%r,%d,%r%s\\n" % (k * step, i, value, ",0" if "," in column else ""))
seconds = 1e-6 * nodes * steps * (1 - 0.1 * math.log10(tolerance)) * (3 if "partitioned" in program else 1)
(folder / "summary.json").write_text(json.dumps({{
    "program": program, "version": "0.1.0", "title": "A tube", "status": "done", "mesh": {{"nodes": nodes}},
    "totals": {{"steps": steps, "wall_s": seconds, "newton_iterations": 4 * steps, "outer_iterations": 5 * steps}}}}))
"""

STUDY = """
title = "Made up"
kind = "accuracy-cost"
[cases]
tube = "tube.toml"
[set]
"time.end" = 3.5
"time.step" = 0.125
[report]
times = [1.5, 3.0]
targets = [10, 1]
method = "monolithic"
tight = "tight"
[report.references]
tube = "reference"
[methods.monolithic]
program = "fsi-monolithic"
[methods.tight]
program = "fsi-monolithic"
set = { "newton.tolerance" = 1e-12 }
[methods.iqn]
program = "fsi-partitioned"
[runs.grid]
methods = ["monolithic"]
vary = { mesh = ["coarse", "intermediate", "fine"], "time.step" = [0.25, 0.125, 0.0625] }
[runs.tight]
methods = ["tight"]
vary = { mesh = ["coarse"] }
[runs.tolerance]
methods = ["monolithic"]
vary = { mesh = ["coarse"], "newton.tolerance" = [1e-2, 1e-3, 0.5] }
[runs.coupling]
methods = ["iqn"]
vary = { mesh = ["coarse"], "partitioned.tolerance" = [1e-2, 1e-4] }
"""


class WholeStudy(FolderCase):
    def setUp(self):
        super().setUp()
        for name in DRIVERS:
            make_executable(self.base / name, DRIVER.format(python=sys.executable))
        (self.base / "tube.toml").write_text('title = "A tube"\n')
        folder = self.base / "reference"
        folder.mkdir()
        (folder / "reference.json").write_text(
            json.dumps({"description": "a sine", "own_error": {q.column: 0.001 for q in QUANTITIES}})
        )
        mean = math.sin(WINDOW / 2) / (WINDOW / 2)  # of a sine over the window, in units of its middle
        for q, factor in zip(QUANTITIES, (1, mean, 1)):
            file, column = q.file, q.column
            rows = [f"{t},{i},{factor * math.sin(1 + i / 3 + t)!r}" for t in TIMES for i in range(19)]
            (folder / file).write_text("\n".join([f"time_ms,z_mm,{column}", *rows, ""]))

    def study(self, text=STUDY):
        (self.base / "made-up.toml").write_text(text)
        code, _, err = self.call(
            "study",
            self.base / "made-up.toml",
            "-o",
            self.out,
            "-q",
            "--monolithic",
            self.base / "fsi-monolithic",
            "--partitioned",
            self.base / "fsi-partitioned",
        )
        return code, err

    def test_numbers(self):
        code, err = self.study()
        self.assertEqual((code, err), (0, ""))
        settings = self.csv("settings.csv")
        self.assertEqual(len(settings), 9 + 1 + 2 + 2)  # the run that diverged has a table of its own
        fine = [row for row in settings if row["mesh"] == "fine" and row["step_ms"] == "0.0625"][0]
        self.assertAlmostEqual(float(fine["pressure_error"]), 0.01 + 0.05, places=6)
        self.assertAlmostEqual(float(fine["averaged_pressure_error"]), 0.01 + 0.05, delta=1e-3)  # linear between steps
        self.assertAlmostEqual(float(fine["seconds"]), 64000e-6 * 56 * 1.8)
        loose = [row for row in settings if row["solved_by"] == "monolithic, newton tolerance 0.01"][0]
        self.assertAlmostEqual(float(loose["pressure_solver_error"]), 0.1 / (1 + 0.26), places=6)
        self.assertEqual([row["message"] for row in self.csv("failed.csv")], ["diverged"])

        orders = self.csv("orders.csv")
        self.assertEqual(len(orders), 3 * (3 + 3))
        for row in orders:
            # Distances are relative to the finer solution, itself off by some percent: hence the tolerance.
            self.assertAlmostEqual(float(row["order"]), 2 if row["refined"] == "element size" else 1, delta=0.15)

        frontier_rows = self.csv("frontier_centerline_pressure.csv")
        errors = [float(row["relative_error"]) for row in frontier_rows]
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertIn("fine mesh, step 0.0625 ms", frontier_rows[-1]["equations"])

        report = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertIn("<strong>10 %</strong>: intermediate mesh, step 0.0625 ms, monolithic", report)
        self.assertIn("The partitioned driver was not tried on these equations.", report)
        self.assertIn("<strong>1.0 %</strong>: no setting of this study reaches it in both; the best is 6.0 %", report)
        self.assertIn("The runs are too far from it to say what it would take.", report)
        for picture in ("work_precision", "orders_space", "orders_time", "algebraic_centerline_pressure"):
            for ending in (".png", ".svg"):
                self.assertTrue((self.out / (picture + ending)).is_file(), picture)

    def test_mistakes_are_named(self):
        for old, new, expected in (
            ("targets = [10, 1]", "target = [10]", "report.target: is unknown; did you mean 'targets'?"),
            ("times = [1.5, 3.0]", "times = [3.0, 1.5]", "report.times: is not an interval"),
            ("times = [1.5, 3.0]", "times = [1.5, 9.0]", "is not covered by the reference of 'tube'"),
            ('tight = "tight"', 'tight = "tidy"', "report.tight: 'tidy' is no method of the study"),
            ('tube = "reference"', 'tube = "nowhere"', "reference.json: is missing"),
            ('tube = "reference"', 'pipe = "reference"', "report.references.pipe: is no case of this study"),
            ('"time.end" = 3.5', '"time.end" = 3.0', "runs.grid: ends at 3 ms, before report.times"),
        ):
            code, err = self.study(STUDY.replace(old, new))
            self.assertEqual((code, err.count("\n")), (1, 1), err)
            self.assertIn(expected, err)
            self.assertFalse((self.out).exists())


class ReadyStudy(unittest.TestCase):
    def test_can_be_run(self):
        from fsi_research.studies import CATALOGUE
        from fsi_compare.study.study_file import read_study

        for quick in (False, True):
            study = read_study(CATALOGUE.path("accuracy-cost"), CATALOGUE.kinds, quick)
            CATALOGUE.kind(study.kind).check(study)
            self.assertTrue(study.requests)
            if quick:
                small = {"coarse", "section-4-1-1-36", "section-4-1-1-96"}
                self.assertEqual({request.mesh.name for request in study.requests}, small)
            else:
                schemes = {"euler", "midpoint", "bdf2", "generalised-alpha", "tr-bdf2"}
                self.assertEqual({request.settings["time.scheme"] for request in study.requests}, schemes)
                self.assertEqual({request.case for request in study.requests}, set(study.cases))

    def test_elements_and_dimensions_can_be_run_side_by_side(self):
        from fsi_research.studies import CATALOGUE
        from fsi_compare.study.study_file import read_study

        for quick in (False, True):
            study = read_study(CATALOGUE.path("space"), CATALOGUE.kinds, quick)
            CATALOGUE.kind(study.kind).check(study)
            kinds_of_runs = {
                (request.settings.get("element", "p1"), request.settings.get("geometry", "3d"))
                for request in study.requests
            }
            self.assertLessEqual({("p1", "3d"), ("p2p1", "3d"), ("p2p1", "axisymmetric")}, kinds_of_runs)


if __name__ == "__main__":
    unittest.main()
