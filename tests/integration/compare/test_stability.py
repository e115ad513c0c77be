"""The kind `stability` of fsi-compare study: outcomes, the check against the other driver, messages, the limit load."""

import tomllib
import unittest
from pathlib import Path

import numpy as np
from folder_case import FolderCase
from synthetic import parabola, write_run

from fsi_compare.base.errors import InputError
from fsi_compare.runs.pressure_waves import PressureWaves
from fsi_research.stability import study as stability
from fsi_compare.study.context import Context
from fsi_research.catalogue.report_section import ReportSection
from fsi_research.evidence.cross_check import AGREES, DEVIATES, FAR, UNCHECKED, WRONG, Cell, difference_of
from fsi_research.stability.beyond_limit_load import Inflated, limit_load_table
from fsi_research.stability.limit_load import TUBE_KEYS, Inflation, apart, read_wall
from fsi_research.stability.settings import Settings
from fsi_compare.reporting.report import Report
from fsi_research.stability.messages import distinct, without_folder
from fsi_compare.study.study_file import Method, Request, read_study
from fsi_compare.study.study_run import CRASHED, DONE, NOT_CONVERGED, OUT_OF_TIME, REFUSED, StudyRun
from fsi_compare.study.study_run import WRONG as NOT_FINITE

STUDY = """
title = "A map"
kind = "stability"
[cases]
tube = "tube.toml"
wall = "tube.toml"
[methods.whole]
program = "fsi-monolithic"
[methods.other]
program = "fsi-monolithic"
[methods.parts]
program = "fsi-partitioned"
[methods.once]
program = "fsi-partitioned"
[runs.density]
cases = ["tube"]
vary = { "structure.density" = [1.2, 12.0] }
[runs.static]
cases = ["wall"]
methods = ["whole"]
vary = { "load.pressure" = [0.6] }
[runs.static-steps]
cases = ["wall"]
methods = ["whole"]
set = { "load.pressure" = 0.6 }
vary = { "static.load_steps" = [4] }
[report]
scope = "Twelve steps."
references = ["whole", "other"]
one_pass = ["once"]
static = "static"
[report.tube]
radii = [1.43, 1.69, 1.82]
shear_moduli = [3.0, 0.3]
[report.quantities]
"structure.density" = { label = "Density ratio", paper = 1.2 }
"""
TIMES = 0.125 * np.arange(1, 5)
ENDS = {
    NOT_CONVERGED: "step 4 (to t = 0.5 ms): no step lowers the residual [the state after step 3 is saved; see a/b]",
    REFUSED: "no such key",
    OUT_OF_TIME: "stopped after 60 s",
    CRASHED: "ended by signal SIGSEGV",
    NOT_FINITE: "flow.csv",
}


def artery_wall():
    return read_wall(ReportSection(Path("x.toml"), "report.tube", tomllib.loads(STUDY)["report"]["tube"], TUBE_KEYS))


class StabilityCase(FolderCase):
    def setUp(self):
        super().setUp()
        (self.base / "tube.toml").write_text("")
        self.file = self.base / "study.toml"

    def study(self, text=STUDY, quick=False):
        self.file.write_text(text)
        study = read_study(self.file, ["stability"], quick)
        stability.check(study)
        return study

    def evaluate(self, outcomes, displaced={}, says=()):
        """`outcomes`: (status, factor on the wave, time levels) by method and density; the rest agrees. `displaced`: by the same
        keys the factor on the wall's displacement; `says`: keys of runs that say that their error is not small. Exit code, rows of
        runs.csv by (value, method)."""
        study = self.study()
        runs = []
        for i, request in enumerate(study.requests):
            value = next(iter(request.values.values()))
            status, factor, levels = outcomes.get((request.method.name, value), (DONE, 1.0, len(TIMES)))
            folder = self.base / "runs" / str(i)
            if request.case == "wall":
                folder.mkdir(parents=True)
                (folder / "wall_displacement.csv").write_text(
                    "time_ms,z_mm,radial_mm,axial_mm\n"
                    + "".join(f"{t},{z},{0.5 * t},0\n" for t in (0.25, 0.5) for z in (0.0, 9.0, 18.0))
                )
                status = NOT_CONVERGED
            elif levels:
                wave, key = parabola(0.66), (request.method.name, value)
                write_run(
                    folder,
                    lambda t, z: factor * wave(t, z),
                    TIMES[:levels],
                    totals={"steps": levels, "outer_iterations": 9 * levels, "newton_iterations": 3 * levels},
                    **({"unchecked": "its error is not small"} if key in says else {}),
                )
                if displaced:
                    (folder / "wall_displacement.csv").write_text(
                        "time_ms,z_mm,radial_mm,axial_mm\n"
                        + "".join(
                            f"{t},{z},{displaced.get(key, 1.0) * t * (1 + z)},0\n"
                            for t in TIMES[:levels]
                            for z in (0.0, 9.0, 18.0)
                        )
                    )
            runs.append(StudyRun(request, folder, status, ENDS.get(status, ""), 1.0, "/opt/bin/fsi-monolithic x.toml"))
        self.out.mkdir(exist_ok=True)
        report = Report(self.out, study.title)
        code = stability.evaluate(Context(study, runs, None, report))
        self.page = report.write().read_text()
        return code, {(float(row["value"]), row["method"]): row for row in self.csv("runs.csv")}


class Outcomes(StabilityCase):
    def test_all_agree(self):
        code, rows = self.evaluate({("parts", 12.0): (DONE, 1 + 5e-4, 4)})
        self.assertEqual(code, 0)
        self.assertEqual({row["outcome"] for row in rows.values() if row["case"] == "tube"}, {AGREES})
        self.assertAlmostEqual(float(rows[12.0, "parts"]["largest_difference"]), 5e-4, 12)
        self.assertEqual(rows[12.0, "parts"]["compared_with"], "whole")
        self.assertNotEqual(rows[12.0, "whole"]["compared_with"], "other")  # by the other driver
        self.assertEqual(
            (float(rows[1.2, "whole"]["iterations_per_step"]), float(rows[1.2, "parts"]["iterations_per_step"])), (3, 9)
        )
        self.assertIn("No crash", self.page)

    def test_silent_wrong_answer(self):
        code, rows = self.evaluate({("parts", 12.0): (DONE, 1.01, 4)})
        self.assertEqual((code, rows[12.0, "parts"]["outcome"], rows[1.2, "parts"]["outcome"]), (2, WRONG, AGREES))
        self.assertIn("runs are at fault", self.page)

    def test_levels_before_a_failure_count_too(self):
        code, rows = self.evaluate({("parts", 12.0): (NOT_CONVERGED, 1.01, 3), ("parts", 1.2): (NOT_CONVERGED, 1.0, 3)})
        self.assertEqual(
            (code, rows[12.0, "parts"]["outcome"], rows[1.2, "parts"]["outcome"]), (2, WRONG, NOT_CONVERGED)
        )

    def test_drivers_disagree_throughout(self):
        _, rows = self.evaluate({(name, 12.0): (DONE, 2.0, 4) for name in ("parts", "once")})
        self.assertEqual((rows[12.0, "whole"]["outcome"], rows[12.0, "other"]["outcome"]), (WRONG, AGREES))

    def test_one_pass_claims_no_agreement(self):
        code, rows = self.evaluate({("once", 12.0): (DONE, 1.05, 4), ("once", 1.2): (DONE, 1.3, 4)})
        self.assertEqual((code, rows[12.0, "once"]["outcome"], rows[1.2, "once"]["outcome"]), (0, DEVIATES, FAR))

    def test_one_pass_is_measured_by_the_largest_of_all_levels(self):
        z = np.array([0.0, 1.0])
        reference = PressureWaves(np.array([1.0, 2.0]), z, np.array([[10.0, 0.0], [1.0, 0.0]]))
        other = PressureWaves(np.array([1.0, 2.0]), z, np.array([[10.0, 0.0], [2.0, 0.0]]))
        self.assertEqual(difference_of(reference, other), (1.0, 2))
        self.assertEqual(difference_of(reference, other, of_all=True), (0.1, 2))

    def test_one_pass_must_not_say_done_when_nothing_is_right(self):
        code, rows = self.evaluate({("once", 12.0): (DONE, 50.0, 4), ("once", 1.2): (NOT_CONVERGED, 50.0, 3)})
        self.assertEqual((code, rows[12.0, "once"]["outcome"], rows[1.2, "once"]["outcome"]), (2, WRONG, NOT_CONVERGED))

    def test_a_displacement_off_counts_where_methods_do_not_iterate(self):
        code, rows = self.evaluate({}, displaced={("once", 12.0): 1.04, ("parts", 12.0): 1.04})
        once, parts = rows[12.0, "once"], rows[12.0, "parts"]
        self.assertEqual((code, once["outcome"], rows[1.2, "once"]["outcome"]), (0, DEVIATES, AGREES))
        self.assertAlmostEqual(float(once["displacement_difference"]), 0.04, 12)
        self.assertLess(float(once["largest_difference"]), 1e-12)
        self.assertEqual(
            (parts["outcome"], parts["displacement_difference"]), (AGREES, "")
        )  # it iterates to the pressure
        (found,) = [row for row in self.csv("splitting.csv") if row["value"] == "12.0"]
        self.assertEqual((found["method"], found["outcome"], found["says_so"]), ("once", DEVIATES, "0"))
        self.assertIn("0 of 2 runs are off by more than 10 %", self.page)

    def test_far_off_is_a_fault_only_where_nothing_is_said(self):
        off = {("once", 12.0): 1.2, ("once", 1.2): 1.7}
        code, rows = self.evaluate({}, displaced=off, says=[("once", 1.2)])
        self.assertEqual((code, rows[12.0, "once"]["outcome"], rows[1.2, "once"]["outcome"]), (0, FAR, FAR))
        self.assertIn("2 of 2 runs are off by more than 10 %, of which 1 do not say so", self.page)
        self.assertIn("2 of them by more than 10 %", self.page)

    def test_far_off_and_silent(self):
        code, rows = self.evaluate({}, displaced={("once", 1.2): 1.7})
        self.assertEqual((code, rows[1.2, "once"]["outcome"]), (2, WRONG))
        self.assertIn("off by 7.0e-01", self.page)

    def test_without_such_methods_there_is_no_such_section(self):
        self.evaluate({("once", 12.0): (REFUSED, 1.0, 0), ("once", 1.2): (REFUSED, 1.0, 0)})
        self.assertNotIn("What methods leave that do not iterate", self.page)

    def test_nothing_to_check_with(self):
        ended = {(name, 12.0): (NOT_CONVERGED, 1.0, 0) for name in ("whole", "other")}
        code, rows = self.evaluate({**ended, ("parts", 1.2): (OUT_OF_TIME, 1.0, 2)})
        self.assertEqual(
            (code, rows[12.0, "parts"]["outcome"], rows[1.2, "parts"]["outcome"]), (0, UNCHECKED, OUT_OF_TIME)
        )

    def test_reference_falls_back(self):
        _, rows = self.evaluate({("whole", 12.0): (REFUSED, 1.0, 0)})
        self.assertEqual((rows[12.0, "whole"]["outcome"], rows[12.0, "parts"]["compared_with"]), (REFUSED, "other"))

    def test_crash_and_not_finite_are_faults(self):
        code, rows = self.evaluate({("parts", 12.0): (CRASHED, 1.0, 0), ("other", 1.2): (NOT_FINITE, 1.0, 0)})
        self.assertEqual(
            (code, rows[12.0, "parts"]["outcome"], rows[1.2, "other"]["outcome"]), (2, CRASHED, NOT_FINITE)
        )

    def test_scope_and_commands(self):
        self.evaluate({})
        self.assertIn("Twelve steps.", self.page)
        self.assertEqual({row["command"] for row in self.csv("runs.csv")}, {"fsi-monolithic x.toml"})

    def test_pictures_and_limit_load(self):
        self.evaluate({})
        for name in ("map_structure_density", "map_load_pressure", "limit_load"):
            for suffix in ("png", "svg"):
                self.assertGreater((self.out / f"{name}.{suffix}").stat().st_size, 1000)
        row, finer = self.csv("limit_load.csv")
        self.assertEqual((row["group"], finer["group"]), ("static", "static-steps"))
        self.assertEqual(finer["load_kPa_or_pulse_ms"], "0.6")
        self.assertAlmostEqual(float(row["largest_widening"]), 1 + 0.25 / 1.43, 12)
        self.assertAlmostEqual(float(row["closed_form_widening"]), artery_wall().widening(0.3), 9)


class Messages(StabilityCase):
    def test_numbers_and_folders_do_not_tell_messages_apart(self):
        self.assertNotIn("a/b", without_folder(ENDS[NOT_CONVERGED]))
        self.assertEqual(without_folder("/home/me/x.toml: time.scheme: kPa/mm"), "x.toml: time.scheme: kPa/mm")

        class Cell:
            def __init__(self, message, method):
                self.method = method
                self.run = type("Run", (), {"done": False, "message": message})

        said = "step {} (to t = {} ms): the wall ended [the state after step {} is saved; x]"
        first, second = distinct(
            [Cell(said.format(n, t, n), m) for n, t, m in ((2, 0.25, "a"), (3, 0.375, "b"))]
            + [Cell("other, iqn-2", "a")]
        )
        self.assertEqual((len(first.cells), first.methods, len(second.cells)), (2, ["a", "b"], 1))
        self.assertEqual(first.text, "step N (to t = N ms): the wall ended")
        self.assertEqual(first.example, "step 2 (to t = 0.25 ms): the wall ended")


class LimitLoad(unittest.TestCase):
    def test_methods_that_come_equally_far_share_a_row(self):
        wall = artery_wall()
        settings = Settings("", 1e-3, ["whole"], ["once"], {}, wall, "static", "inlet.until")

        def inflated(method, until, reached):
            levels = Inflation(np.array([0.5, reached]), np.array([0.1, 0.143]), np.array([0.0, 0.0]))
            request = Request(
                "pulse", "tube", Method(method, method, "p", {}), {"inlet.until": until}, None, None, {}, 1.0
            )
            run = StudyRun(request, Path("nowhere"), DONE, "", 1.0, "")
            return Inflated(Cell(run, AGREES, 2, None, None), False, until, levels, wall)

        names = ["whole", "other", "iqn", "robin"]
        table = limit_load_table(
            [
                *(inflated(name, 1.0, 3.0) for name in [*names, "once"]),
                *(inflated(name, 5.0, 2.0 if name == "iqn" else 2.5) for name in names),
            ],
            settings,
        )
        self.assertEqual(
            [row[:5] for row in table.rows],
            [
                ["pulse of 1 ms", "-", "all 4 methods", AGREES, "3 ms"],
                ["pulse of 5 ms", "-", "whole; other; robin", AGREES, "2.5 ms"],
                ["pulse of 5 ms", "-", "iqn", AGREES, "2 ms"],
            ],
        )
        self.assertEqual(len(table.csv_rows), 9)

    def test_a_long_tube_bulges_before_its_limit(self):
        wall = artery_wall()
        self.assertAlmostEqual(wall.bulge, 1.775, 3)
        self.assertAlmostEqual(wall.pressure(wall.bulge), 0.4563, 4)
        self.assertAlmostEqual(wall.pressure_and_force(1.3, 1)[0], wall.pressure(1.3), 9)

    def test_labels_that_would_cover_each_other_move_apart(self):
        placed = apart([(0.2, 0.5), (0.2, 0.1), (0.25, 0.5), (0.8, 0.5)])
        self.assertEqual((placed[0], placed[1], placed[3]), ((0.2, 0.5), (0.2, 0.1), (0.8, 0.5)))
        self.assertGreater(placed[2][1] - placed[0][1], 0.05)

    def test_table_of_closed_form_pressures(self):
        wall = artery_wall()
        self.assertAlmostEqual(wall.limit, 0.5234, 4)
        for widening, pressure in ((1.01, 0.0173), (1.1, 0.1452), (1.4, 0.3623)):
            self.assertAlmostEqual(wall.pressure(widening), pressure, delta=6e-5)
            self.assertAlmostEqual(wall.widening(wall.pressure(widening)), widening, 9)
        self.assertIsNone(wall.widening(0.53))


class Refusals(StabilityCase):
    def assert_refused(self, expected, old, new):
        with self.assertRaises(InputError) as caught:
            self.study(STUDY.replace(old, new))
        self.assertIn(expected, str(caught.exception))

    def test_settings(self):
        self.assert_refused(
            "report.references: 'hole' is no method", 'references = ["whole", "other"]', 'references = ["hole"]'
        )
        self.assert_refused(
            "not methods of one driver", 'references = ["whole", "other"]', 'references = ["whole", "parts"]'
        )
        self.assert_refused("report.bounds: is unknown; did you mean 'bound'", "[report]", "[report]\nbounds = 1")
        self.assert_refused("report.bound: 0 is not a positive", "[report]", "[report]\nbound = 0")
        self.assert_refused("varies 2 quantities", "[1.2, 12.0] }", '[1.2], "time.step" = [1.0] }')
        self.assert_refused("is varied nowhere", '"structure.density" = { label', '"structure.dense" = { label')
        self.assert_refused("report.tube.radii: are not one more", "[1.43, 1.69, 1.82]", "[1.43, 1.69]")


if __name__ == "__main__":
    unittest.main()
