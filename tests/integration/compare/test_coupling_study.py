"""The kind `coupling` of fsi-compare study: theory of the added mass, bisection, tables from runs."""

import importlib.util
import math
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np
from folder_case import FolderCase
from synthetic import parabola, write_run

from fsi_compare.base.errors import InputError
from fsi_compare.reporting.pictures import write_figure
from fsi_research.evidence.commands import with_name
from fsi_research.coupling import study as coupling
from fsi_research.coupling import added_mass_runs, pictures, sweeps
from fsi_research.evidence.cross_check import AGREES, FAR, UNCHECKED, WRONG
from fsi_research.coupling.added_mass import ARTERY, AddedMass
from fsi_research.evidence.bessel import bessel_i
from fsi_research.coupling.bisection import bisect
from fsi_compare.study.study_file import Method, Request, StudyMesh, read_study
from fsi_compare.study.study_run import DONE, NOT_CONVERGED, StudyRun


class AddedMassTheory(unittest.TestCase):
    def test_bessel_functions(self):
        # [Abramowitz1964], table 9.8
        self.assertAlmostEqual(bessel_i(0, 1.0), 1.2660658777520084, 14)
        self.assertAlmostEqual(bessel_i(1, 1.0), 0.5651591039924850, 14)
        self.assertAlmostEqual(bessel_i(1, 5.0), 24.335642142450524, 11)

    def test_the_artery(self):
        theory = AddedMass()
        self.assertAlmostEqual(theory.mass_ratio(), 0.0101, 4)
        self.assertAlmostEqual(theory.gain(0.125), 94, delta=0.5)
        self.assertAlmostEqual(theory.largest_factor(0.125), 0.0211, 4)
        misprint = AddedMass(replace(ARTERY, wall_density=1.2e-3))
        self.assertAlmostEqual(misprint.largest_factor(0.125), 0.0011, 4)

    def test_this_scheme(self):
        self.assertAlmostEqual(AddedMass().whole_wall, 0.884, 3)
        self.assertAlmostEqual(AddedMass().explicit_limit(1), 268, delta=1)
        self.assertAlmostEqual(AddedMass().explicit_limit(2), 3 * AddedMass().explicit_limit(1), 9)

    def test_at_the_critical_density_the_mass_ratio_is_one(self):
        critical = AddedMass().critical_density_ratio()
        self.assertAlmostEqual(AddedMass(replace(ARTERY, wall_density=critical)).mass_ratio(), 1, 12)


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


class Tables(FolderCase):
    def run_of(self, name, program, passes, status=DONE, group="agreement", factor=1.0):
        wave = parabola(0.66)
        folder = write_run(
            self.base / name,
            lambda t, z: factor * wave(t, z),
            program=program,
            totals={"steps": 2, "outer_iterations": sum(passes), "newton_iterations": 9, "wall_s": 1.0},
        )
        (folder / "iterations.csv").write_text(
            "step,outer_iterations\n" + "".join(f"{i},{n}\n" for i, n in enumerate(passes, 1))
        )
        request = Request(
            group,
            "neo-hookean",
            Method(name, name, program, {}),
            {"mesh": "coarse"},
            Path("case.toml"),
            StudyMesh("coarse", "coarse", ()),
            {"partitioned.tolerance": 1e-9},
            1.0,
        )
        return StudyRun(request, folder, status, "" if status == DONE else "diverged", 1.0, "")

    def test_agreement_is_the_relative_difference(self):
        runs = [
            self.run_of("whole", "fsi-monolithic", [1, 1]),
            self.run_of("iqn-ils", "fsi-partitioned", [9, 6], factor=1.0 + 1e-7),
            self.run_of("aitken", "fsi-partitioned", [9, 6], status=NOT_CONVERGED),
        ]
        table = coupling.agreement_table(runs)
        self.assertEqual([row[0] for row in table.rows], ["iqn-ils", "aitken"])
        self.assertEqual(table.rows[0][1], "1.0e-07 (7.5)")
        self.assertEqual(table.rows[1][1], "not converged")
        self.assertAlmostEqual(table.csv_rows[0][6], 1e-7, 10)

    def test_in_short(self):
        whole = self.run_of("whole", "fsi-monolithic", [1, 1])
        quick = self.run_of("iqn-ils", "fsi-partitioned", [9, 6], factor=1.0 + 1e-7)
        slow = self.run_of("aitken", "fsi-partitioned", [30, 20])
        failed = self.run_of("constant", "fsi-partitioned", [9, 6], status=NOT_CONVERGED)
        everything = [whole, quick, slow, failed]
        lines = coupling.in_short([quick, slow, failed], coupling.agreements([whole, quick, failed]), everything)
        self.assertIn(
            "Fewest coupling iterations a step: iqn-ils, 7.5 over walls and meshes; most: aitken, 25.0.", lines
        )
        self.assertIn("agree: the pressure differs by at most 1.0e-07", lines[1])
        self.assertEqual(lines[2], "1 of 4 runs did not come to their end: 1 not converged.")
        other = self.run_of("other", "fsi-partitioned", [9, 6], factor=1.01)
        lines = coupling.in_short([], coupling.agreements([whole, other]), [whole, other, other])
        self.assertIn("do not agree: the pressure differs by up to 1.0e-02", lines[0])
        self.assertEqual(lines[1], "All 2 runs came to their end.")

    def test_passes_are_mean_and_range(self):
        table = coupling.passes_table([self.run_of("iqn-ils", "fsi-partitioned", [9, 6], group="passes")])
        self.assertEqual(table.rows[0][1], "7.5 (6-9)")

    def test_meshes_compare_over_the_same_steps(self):
        coarse = self.run_of("iqn-ils", "fsi-partitioned", [9, 6, 3, 3], group="passes")
        fine = self.run_of("finer", "fsi-partitioned", [10, 8], group="passes")
        method = coarse.request.method
        fine = replace(fine, request=replace(fine.request, method=method, mesh=StudyMesh("fine", "fine", ())))
        table = coupling.growth_table([coarse, fine])
        self.assertEqual(table.rows, [["iqn-ils", "neo-Hookean", "fine", "2", "7.5", "9.0", "1.20"]])


class Sweeps(FolderCase):
    """A monolithic run, an iterating scheme and one with one pass a step, at two density ratios."""

    SETTINGS = sweeps.Settings(1e-3, ["explicit"])

    def cells(self, factors, monolithic=(1.0, 10.0)):
        """`factors` on the wave by scheme and density; None: not converged."""
        runs = []
        for (name, density), factor in {**{("whole", d): 1.0 for d in monolithic}, **factors}.items():
            wave = parabola(0.66)
            program = "fsi-monolithic" if name == "whole" else "fsi-partitioned"
            folder = write_run(
                self.base / f"{name}-{density}",
                lambda t, z: (factor or 1.0) * wave(t, z),
                program=program,
                totals={"steps": 2, "outer_iterations": 4, "newton_iterations": 8},
            )
            request = Request(
                "density",
                "a",
                Method(name, name, program, {}),
                {"structure.density": density},
                Path("case.toml"),
                None,
                {},
                1.0,
            )
            runs.append(
                StudyRun(
                    request,
                    folder,
                    DONE if factor else NOT_CONVERGED,
                    "" if factor else "diverged",
                    1.0,
                    f"/opt/bin/{program} case.toml",
                )
            )
        return sweeps.checked(runs, self.SETTINGS)

    def test_every_answer_is_checked(self):
        found = self.cells(
            {("iqn-ils", 1.0): 1 + 1e-5, ("iqn-ils", 10.0): 1.01, ("explicit", 1.0): None, ("explicit", 10.0): 1.12}
        )
        self.assertEqual([cell.outcome for cell in found], [AGREES, WRONG, NOT_CONVERGED, FAR])
        self.assertEqual([cell.method for cell in sweeps.faults(found)], ["iqn-ils"])
        table = sweeps.sweep_table("density", "density ratio", found, self.SETTINGS)
        self.assertEqual(
            table.rows,
            [
                ["iqn-ils", "2.0", "2.0 (off 1 %)", "1.0e-02"],
                ["explicit", "not converged", "2.0 (off 12 %)", "1.2e-01"],
            ],
        )
        self.assertTrue(all(row[-2] == "fsi-partitioned case.toml" for row in table.csv_rows))
        self.assertIn("2 are off by more than that", sweeps.in_words(found, self.SETTINGS))
        lines = sweeps.series(found)
        self.assertEqual(([line.off for line in lines], lines[1].passes), ([[False, True], [False, True]], [None, 2.0]))
        write_figure(self.base, "sweep", lambda: pictures.passes_figure(lines, "density ratio", {}, 1e-3))
        text = (self.base / "sweep.svg").read_text()
        self.assertIn("off by more than 0.1 %", text)

    def test_without_monolithic_run_nothing_is_checked(self):
        found = self.cells({("iqn-ils", 1.0): 1.0, ("iqn-ils", 10.0): 1.0}, monolithic=(1.0,))
        self.assertEqual([cell.outcome for cell in found], [AGREES, UNCHECKED])
        self.assertIn("1 has no monolithic run", sweeps.in_words(found, self.SETTINGS))


class WindowModel(unittest.TestCase):
    """scripts/window_model.py: different steps for fluid and wall."""

    @classmethod
    def setUpClass(cls):
        script = Path(__file__).resolve().parents[3] / "scripts" / "window_model.py"
        specification = importlib.util.spec_from_file_location("window_model", script)
        cls.model = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(cls.model)

    def test_the_midpoint_rule_is_exact_for_its_own_frequency(self):
        # A midpoint step turns the phase by 2 atan(omega dt/2) (docs/theory.md, section 8).
        modes = self.model.Modes(0.5, np.array([0.7]))
        omega, dt = float(modes.frequencies[0]), 0.2
        turn = 2 * math.atan(omega * dt / 2)
        march = self.model.march(modes, np.ones(1), lambda t: np.zeros(1), dt, lambda t: 1)
        for i, (t, d) in zip(range(1, 40), march):
            self.assertAlmostEqual(t, i * dt, 12)
            self.assertAlmostEqual(float(d[0]), math.cos(i * turn), 10)

    def test_orders(self):
        one_mode = self.model.one_mode
        self.assertAlmostEqual(one_mode(0.5, 0.7, 160, 1, 2) / one_mode(0.5, 0.7, 160, 1), 4, delta=0.02)
        # a fluid without mass bears nothing, however long its step (errors are summed at the ends of its steps alone); a wall without
        # mass moves as the fluid lets it
        self.assertAlmostEqual(one_mode(1.0, 1e-9, 80, 4) / one_mode(1.0, 1e-9, 80, 1), 1, delta=1e-3)
        self.assertGreater(one_mode(0.02, 1.0, 80, 4), 2 * one_mode(0.02, 1.0, 80, 1))

    def test_a_pulse_starts_from_rest_and_windows_end_at_its_end(self):
        self.assertLess(self.model.pulse(1 / 16, 4), 0.004)
        self.assertAlmostEqual(self.model.pulse(1 / 16, 1) / self.model.pulse(1 / 32, 1), 4, delta=0.05)


class Commands(unittest.TestCase):
    def test_program_by_name(self):
        self.assertEqual(
            with_name("'/a b/fsi-monolithic' case.toml --set 'x=\"y\"'"), "fsi-monolithic case.toml --set 'x=\"y\"'"
        )
        self.assertEqual(with_name(""), "")


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


GOOD = """
title = "t"
kind = "coupling"
[cases]
a = "case.toml"
[methods.explicit]
program = "fsi-partitioned"
[runs.passes]
[report.explicit]
method = "explicit"
case = "a"
low = 1.0
high = 2.0
steps = [0.1]
stabilisations = [0.5]
"""


class StudyFile(unittest.TestCase):
    def test_mistakes_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "study.toml"
            (Path(folder) / "case.toml").write_text("")
            path.write_text(GOOD)
            coupling.check(read_study(path, ["coupling"]))
            for old, new, expected in (
                ("[runs.passes]", "[runs.pass]", "runs.pass"),
                ("[report.explicit]", "[report.explicitt]", "did you mean 'explicit'"),
                ("[report.explicit]", "[report.sweeps]\nbound = 0\n[report.explicit]", "report.sweeps.bound"),
                (
                    "[report.explicit]",
                    "[report.sweeps]\none_pass = ['a']\n[report.explicit]",
                    "did you mean 'explicit'",
                ),
                ("low = 1.0", "low = 3.0", "report.explicit.low"),
                ('case = "a"', 'case = "b"', "report.explicit.case"),
                ("steps = [0.1]\n", "", "report.explicit.steps"),
            ):
                path.write_text(GOOD.replace(old, new))
                with self.assertRaises(InputError) as caught:
                    coupling.check(read_study(path, ["coupling"]))
                self.assertIn(expected, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
