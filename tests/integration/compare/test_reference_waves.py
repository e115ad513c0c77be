"""scripts/reference_waves.py: what the references of the accuracy study are extrapolated from, and how well."""

import importlib.util
import unittest
from pathlib import Path

import numpy as np

import synthetic  # noqa: F401  (finds the package)
from fsi_compare.studies.evidence.waves import PRESSURE, Waves

SCRIPT = Path(__file__).resolve().parents[3] / "scripts/reference_waves.py"
specification = importlib.util.spec_from_file_location("reference_waves", SCRIPT)
reference_waves = importlib.util.module_from_spec(specification)
specification.loader.exec_module(reference_waves)

TIMES = np.arange(0.0, 12.01, 0.25)
Z = np.linspace(0, 18, 19)
EXACT = 3 + np.sin(TIMES)[:, None] * np.cos(Z)[None, :]
SIZE = {"coarse": 4, "middle": 2, "fine": 1}


def solutions(time_error, space_order=2.0):
    """Waves of each run: the exact ones with an error of `time_error(step)` and one of an order in the cell's size."""
    return {
        (grid, step): {PRESSURE.column: Waves(TIMES, Z, EXACT + time_error(step) + 0.01 * SIZE[grid] ** space_order)}
        for grid, step in reference_waves.needed()
    }


def off(waves):
    exact = Waves(TIMES, Z, EXACT).at(reference_waves.TIMES, Z)
    return np.linalg.norm(waves.values - exact) / np.linalg.norm(exact)


class Extrapolation(unittest.TestCase):
    def test_what_is_of_one_order_vanishes_whatever_the_order(self):
        for time_order, space_order in ((1.0, 2.0), (0.7, 3.0)):
            runs = solutions(lambda step: 2 * step**time_order, space_order)
            found, own_error, facts = reference_waves.reference(runs, PRESSURE.column)
            self.assertLess(off(found), 1e-3 * own_error + 2e-4)
            self.assertAlmostEqual(facts["time"][0]["order"], time_order, delta=1e-3)
            self.assertAlmostEqual(facts["space"]["order"], space_order, delta=1e-3)

    def test_what_is_left_is_not_underrated(self):
        for error in (lambda step: 0.1 * step**0.5 + 0.2 * step, lambda step: 0.1 * step**0.7 + step**2):
            found, own_error, _ = reference_waves.reference(solutions(error), PRESSURE.column)
            self.assertLess(off(found), own_error)

    def test_where_no_order_shows_nothing_is_extrapolated(self):
        waves = {step: Waves(TIMES, Z, EXACT + value) for step, value in zip((1, 2, 4), (0.1, 0.2, 0.25))}
        found, facts = reference_waves.converged([waves[1], waves[2], waves[4]])
        np.testing.assert_array_equal(found.values, waves[1].values)
        self.assertGreater(facts["left"], 0)

    def test_the_reference_for_space_is_the_finest_grid_at_the_step_of_the_cases(self):
        runs = solutions(lambda step: 2 * step)
        found, own_error, _ = reference_waves.space_reference(runs, PRESSURE.column)
        fine = runs["fine", reference_waves.SPACE_STEP][PRESSURE.column]
        np.testing.assert_array_equal(found.values, fine.at(reference_waves.TIMES, Z))
        exact = Waves(TIMES, Z, fine.values - 0.01).at(reference_waves.TIMES, Z)
        apart = np.linalg.norm(found.values - exact) / np.linalg.norm(exact)
        self.assertAlmostEqual(own_error, apart, delta=0.02 * apart)
