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


def solutions(time_error):
    """Waves of each run: the exact ones, an error of `time_error(step)` and one of second order in the cell's size."""
    needed = [(reference_waves.REFINEMENT, step) for step in reference_waves.STEPS]
    needed += [(refinement, reference_waves.SPACE_STEP) for refinement in reference_waves.SPACE]
    return {
        (refinement, step): {PRESSURE.column: Waves(TIMES, Z, EXACT + time_error(step) + 0.5 / refinement**2)}
        for refinement, step in needed
    }


class Extrapolation(unittest.TestCase):
    def test_first_and_second_order_in_time_and_second_in_space_vanish(self):
        runs = solutions(lambda step: 2 * step - 3 * step**2)
        found, own_error, facts = reference_waves.reference(runs, PRESSURE.column)
        np.testing.assert_allclose(found.values, Waves(TIMES, Z, EXACT).at(reference_waves.TIMES, Z), atol=1e-12)
        self.assertAlmostEqual(facts["space_order"], 2, delta=0.02)  # relative to the finer of two
        self.assertLess(facts["left_in_time"], 1e-12)
        self.assertGreater(own_error, 0)

    def test_what_is_left_is_not_underrated(self):
        found, own_error, _ = reference_waves.reference(solutions(lambda step: 0.1 * step**0.7), PRESSURE.column)
        exact = Waves(TIMES, Z, EXACT).at(reference_waves.TIMES, Z)
        self.assertLess(np.linalg.norm(found.values - exact) / np.linalg.norm(exact), own_error)
