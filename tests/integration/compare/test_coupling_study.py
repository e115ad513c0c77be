"""The kind `coupling` of fsi-compare study: theory of the added mass, bisection, tables from runs."""

import math
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np
from synthetic import parabola, write_run

from fsi_compare.errors import InputError
from fsi_compare.studies.coupling import study as coupling
from fsi_compare.studies.coupling import added_mass_runs
from fsi_compare.studies.coupling.added_mass import Tube
from fsi_compare.studies.evidence.bessel import bessel_i
from fsi_compare.studies.coupling.bisection import bisect
from fsi_compare.studies.study_file import Method, Request, StudyMesh, read_study
from fsi_compare.studies.study_run import DONE, NOT_CONVERGED, StudyRun


class AddedMass(unittest.TestCase):
    def test_bessel_functions(self):
        # Abramowitz and Stegun, table 9.8
        self.assertAlmostEqual(bessel_i(0, 1.0), 1.2660658777520084, 14)
        self.assertAlmostEqual(bessel_i(1, 1.0), 0.5651591039924850, 14)
        self.assertAlmostEqual(bessel_i(1, 5.0), 24.335642142450524, 11)

    def test_the_artery(self):
        tube = Tube()
        self.assertAlmostEqual(tube.mass_ratio(), 0.0101, 4)
        self.assertAlmostEqual(tube.gain(0.125), 94, delta=0.5)
        self.assertAlmostEqual(tube.largest_factor(0.125), 0.0211, 4)
        self.assertAlmostEqual(Tube(wall_density=1.2e-3).largest_factor(0.125), 0.0011, 4)  # the paper's misprint

    def test_this_scheme(self):
        self.assertAlmostEqual(Tube().whole_wall, 0.884, 3)
        self.assertAlmostEqual(Tube().explicit_limit(1), 268, delta=1)
        self.assertAlmostEqual(Tube().explicit_limit(2), 3 * Tube().explicit_limit(1), 9)

    def test_at_the_critical_density_the_mass_ratio_is_one(self):
        critical = Tube().critical_density_ratio()
        self.assertAlmostEqual(Tube(wall_density=critical).mass_ratio(), 1, 12)


class Bisection(unittest.TestCase):
    def test_finds_the_turn_from_either_side(self):
        for holds in (lambda x: x > 37.0, lambda x: x < 37.0):
            bracket = bisect(holds, 1.0, 1000.0, 0.01)
            self.assertLessEqual(bracket.width, 0.01)
            self.assertTrue(min(bracket.fails, bracket.holds) <= 37.0 <= max(bracket.fails, bracket.holds))
            self.assertTrue(holds(bracket.holds) and not holds(bracket.fails))

    def test_says_when_there_is_no_turn(self):
        self.assertIsNone(bisect(lambda x: True, 1.0, 10.0, 0.1).value)
        self.assertEqual(bisect(lambda x: False, 1.0, 10.0, 0.1).fails, 10.0)

    def test_width_is_that_of_the_ratio(self):
        bracket = bisect(lambda x: x > math.pi, 1.0, 10.0, 0.5)
        self.assertAlmostEqual(bracket.width, max(bracket.fails, bracket.holds) / min(bracket.fails, bracket.holds) - 1)


class Tables(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.base = Path(temporary.name)

    def run_of(self, name, program, passes, status=DONE, group="agreement", factor=1.0):
        waves = parabola(0.66)
        folder = write_run(self.base / name, waves, program=program,
                           totals={"steps": 2, "outer_iterations": sum(passes), "newton_iterations": 9, "wall_s": 1.0})
        pressure = folder / "centerline_pressure.csv"
        lines = pressure.read_text().splitlines()
        scaled = [lines[0]] + [",".join([*line.split(",")[:2], repr(float(line.split(",")[2]) * factor)]) for line in lines[1:]]
        pressure.write_text("\n".join(scaled) + "\n")
        (folder / "iterations.csv").write_text("step,outer_iterations\n" + "".join(f"{i},{n}\n" for i, n in enumerate(passes, 1)))
        request = Request(group, "neo-hookean", Method(name, name, program, {}), {"mesh": "coarse"}, Path("case.toml"),
                          StudyMesh("coarse", "coarse", ()), {"partitioned.tolerance": 1e-9}, 1.0)
        return StudyRun(request, folder, status, "" if status == DONE else "diverged", 1.0, "")

    def test_agreement_is_the_relative_difference(self):
        runs = [self.run_of("whole", "fsi-monolithic", [1, 1]),
                self.run_of("iqn-ils", "fsi-partitioned", [9, 6], factor=1.0 + 1e-7),
                self.run_of("aitken", "fsi-partitioned", [9, 6], status=NOT_CONVERGED)]
        table = coupling.agreement_table(runs)
        self.assertEqual([row[0] for row in table.rows], ["iqn-ils", "aitken"])
        self.assertEqual(table.rows[0][1], "1.0e-07 (7.5)")
        self.assertEqual(table.rows[1][1], "not converged")
        self.assertAlmostEqual(table.csv_rows[0][6], 1e-7, 10)

    def test_passes_are_mean_and_range(self):
        table = coupling.passes_table(None, [self.run_of("iqn-ils", "fsi-partitioned", [9, 6], group="passes")])
        self.assertEqual(table.rows[0][1], "7.5 (6-9)")


    def test_meshes_compare_over_the_same_steps(self):
        coarse = self.run_of("iqn-ils", "fsi-partitioned", [9, 6, 3, 3], group="passes")
        fine = self.run_of("finer", "fsi-partitioned", [10, 8], group="passes")
        method = coarse.request.method
        fine = replace(fine, request=replace(fine.request, method=method, mesh=StudyMesh("fine", "fine", ())))
        table = coupling.growth_table([coarse, fine])
        self.assertEqual(table.rows, [["iqn-ils", "neo-Hookean", "fine", "2", "7.5", "9.0", "1.20"]])


class Growth(unittest.TestCase):
    """A march of 80 steps at three points, alternating with a factor per step on top of a smooth wave."""

    def march(self, factor, size):
        times = 0.125 * np.arange(1, 81)
        radial = np.sin(0.3 * times)[:, None] * np.ones(3) + size * (-factor) ** np.arange(80)[:, None]

        class Fake:
            def columns(self, file):
                return {"time_ms": np.repeat(times, 3), "radial_mm": radial.ravel()}
        return added_mass_runs.alternates_ever_more(Fake())

    def test_only_what_grows_and_is_not_small_is_unstable(self):
        self.assertTrue(self.march(1.02, 0.1))
        self.assertFalse(self.march(0.98, 0.5))
        self.assertFalse(self.march(1.02, 1e-4))
        self.assertFalse(self.march(1.0, 0.0))


class StudyFile(unittest.TestCase):
    def test_mistakes_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "study.toml"
            (Path(folder) / "case.toml").write_text("")
            good = ('title = "t"\nkind = "coupling"\n[cases]\na = "case.toml"\n[methods.explicit]\nprogram = "fsi-partitioned"\n'
                    '[runs.passes]\n[report.explicit]\nmethod = "explicit"\ncase = "a"\nlow = 1.0\nhigh = 2.0\nsteps = [0.1]\nstabilisations = [0.5]\n')
            path.write_text(good)
            coupling.check(read_study(path, ["coupling"]))
            for old, new, expected in (("[runs.passes]", "[runs.pass]", "runs.pass"),
                                       ("[report.explicit]", "[report.explicitt]", "did you mean 'explicit'"),
                                       ("low = 1.0", "low = 3.0", "report.explicit.low"),
                                       ('case = "a"', 'case = "b"', "report.explicit.case"),
                                       ("steps = [0.1]\n", "", "report.explicit.steps")):
                path.write_text(good.replace(old, new))
                with self.assertRaises(InputError) as caught:
                    coupling.check(read_study(path, ["coupling"]))
                self.assertIn(expected, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
