"""scripts/evidence/reference_waves.py: what the references of the accuracy study are extrapolated from, and how well."""

import importlib.util
import unittest
from pathlib import Path

import numpy as np

import synthetic  # noqa: F401  (finds the package)
from fsi_compare.runs.waves import PRESSURE, Waves, relative_difference

SCRIPT = Path(__file__).resolve().parents[3] / "scripts/evidence/reference_waves.py"
specification = importlib.util.spec_from_file_location("reference_waves", SCRIPT)
reference_waves = importlib.util.module_from_spec(specification)
specification.loader.exec_module(reference_waves)

TIMES = np.arange(0.0, 12.01, 0.25)
Z = np.linspace(0, 18, 19)
EXACT = 3 + np.sin(TIMES)[:, None] * np.cos(Z)[None, :]
CELL = {"coarse": 1, "middle": 1 / 2, "fine": 1 / 4}


def solutions(time_error, space_order=2.0):
    """Waves of each run: the exact ones with an error of `time_error(step)` and one of an order in the cell's size."""
    return {
        run: {PRESSURE.column: Waves(TIMES, Z, EXACT + time_error(run.step) + 0.1 * CELL[run.grid] ** space_order)}
        for run in reference_waves.needed(reference_waves.CHECKED)
    }


def off(waves):
    exact = Waves(TIMES, Z, EXACT).at(reference_waves.TIMES, Z)
    return np.linalg.norm(waves.values - exact) / np.linalg.norm(exact)


class Extrapolation(unittest.TestCase):
    def test_extrapolation_removes_the_leading_error(self):
        exact, fine, coarse = (Waves(TIMES, Z, factor * EXACT) for factor in (1, 1.2, 1.4))
        found = reference_waves.extrapolated(fine, coarse, 1)
        self.assertLess(relative_difference(found, exact, TIMES), 1e-12)

    def test_what_is_of_one_order_vanishes_whatever_the_order(self):
        for time_order, space_order in ((2.0, 2.0), (1.4, 3.0)):
            runs = solutions(lambda step: 2 * step**time_order, space_order)
            found, own_error, facts = reference_waves.reference(reference_waves.CHECKED, runs, PRESSURE.column)
            self.assertLess(off(found), 1e-9)
            self.assertGreater(own_error, 1e-4)
            self.assertAlmostEqual(facts["time"]["order"], time_order, delta=1e-3)
            self.assertAlmostEqual(facts["space"]["order"], space_order, delta=1e-3)
            self.assertLess(facts["left_of_both"], 1e-12)

    def test_what_is_left_is_not_underrated(self):
        for error in (lambda step: 0.1 * step**1.5 + 2 * step**2, lambda step: step**1.7 + 9 * step**3):
            found, own_error, _ = reference_waves.reference(reference_waves.CHECKED, solutions(error), PRESSURE.column)
            self.assertLess(off(found), own_error)

    def test_a_correction_for_the_grid_that_depends_on_the_step_counts(self):
        runs = solutions(lambda step: 2 * step**2)
        for run, waves in runs.items():
            w = waves[PRESSURE.column]
            error = 50 * run.step**2 * CELL[run.grid] ** 2
            waves[PRESSURE.column] = Waves(w.times, w.z, w.values + error)
        found, own_error, facts = reference_waves.reference(reference_waves.CHECKED, runs, PRESSURE.column)
        self.assertGreater(facts["left_of_both"], 1e-5)
        self.assertLess(off(found), own_error)

    def test_where_no_order_shows_nothing_is_extrapolated(self):
        for values in ((0.1, 0.2, 0.25), (0.1, 0.2, 0.3 + 0.06)):  # distances that grow; an order of 0.7
            waves = [Waves(TIMES, Z, EXACT + value) for value in values]
            found, facts = reference_waves.converged(waves, (1, 2, 4))
            np.testing.assert_array_equal(found.values, waves[0].at(reference_waves.TIMES, Z))
            self.assertFalse(facts["extrapolated"])
            self.assertGreater(facts["left"], 0.1 / 4)

    def test_the_reference_for_space_is_the_finest_grid_at_the_step_of_the_cases(self):
        runs = solutions(lambda step: 2 * step)
        found, own_error, _ = reference_waves.space_reference("", runs, PRESSURE.column)
        fine = runs[reference_waves.in_space(*reference_waves.CASE)[0]][PRESSURE.column]
        np.testing.assert_array_equal(found.values, fine.at(reference_waves.TIMES, Z))
        exact = Waves(TIMES, Z, fine.values - 0.1 / 16).at(reference_waves.TIMES, Z)
        apart = np.linalg.norm(found.values - exact) / np.linalg.norm(exact)
        self.assertAlmostEqual(own_error, apart, delta=0.02 * apart)


if __name__ == "__main__":
    unittest.main()
