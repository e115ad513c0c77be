"""Error bars of `fsi-compare verify` on sequences whose exact value is known."""

import math
import random
import unittest

import numpy as np
import synthetic  # noqa: F401: the package onto the path
from fsi_compare.studies.verify.direction import AS_EXPECTED, OUTSIDE, SILENT, WIDENED, observed, part_of
from fsi_compare.studies.verify.verdict import BAR_WIDENED, CONVERGES, NOT_IN_RANGE, Value, bar_of

EXACT = 3.0


def line(sizes, order, factor=0.1):
    return [EXACT + factor * h**order for h in sizes]


class OneDirection(unittest.TestCase):
    """y = y0 + a h^p has the error a at size 1."""

    def test_finds_the_order_of_a_power(self):
        for sizes in ((2, 1, 0.5), (1.5, 1, 2 / 3), (2, 1.4, 1, 0.7)):
            for order in (0.5, 1, 1.7, 2, 3, 4):
                x, y = zip(*sorted(zip(sizes, line(sizes, order)), reverse=True))
                found, left = observed(np.array(x, float), np.array(y))
                self.assertAlmostEqual(found, order, delta=1e-3)
                self.assertLess(left, 1e-6)

    def test_bar_holds_the_error_and_is_not_wide(self):
        for order in (1, 2, 3):
            for sizes in ((2, 1, 0.5), (1.5, 1, 2 / 3), (4, 2, 1)):
                part = part_of(sizes, line(sizes, order), order, 1e-12)
                self.assertEqual(part.state, AS_EXPECTED)
                self.assertGreaterEqual(part.bar, 0.1)
                self.assertLessEqual(part.bar, 0.1 * 2.01)
                self.assertAlmostEqual(part.error, 0.1, places=4)

    def test_order_above_what_elements_have_is_not_used(self):
        sizes = (2, 1, 0.5)
        part = part_of(sizes, line(sizes, 4), 2, 1e-12)
        self.assertEqual(part.state, WIDENED)
        self.assertEqual(part.used, 2)
        self.assertGreater(part.bar, 0.1)

    def test_difference_that_vanishes_by_chance_is_not_believed(self):
        """An error a h^2 - b h^4 may be the same on two meshes: the last difference says nothing of what is left."""
        values = [EXACT + 0.1 * h**2 - 0.08 * h**4 for h in (2, 1, 0.5)]
        self.assertAlmostEqual(values[1], values[2])
        part = part_of((2, 1, 0.5), values, 2, 1e-12)
        self.assertEqual(part.state, WIDENED)
        self.assertGreaterEqual(part.bar, 0.02)

    def test_differences_down_to_noise_have_converged(self):
        self.assertLess(part_of((2, 1, 0.5), (1 + 4e-6, 1.0, 1.0), 2, 1e-6).bar, 5e-6)

    def test_low_order_widens(self):
        sizes = (2, 1, 0.5)
        part = part_of(sizes, line(sizes, 0.9), 3, 1e-12)
        self.assertEqual(part.state, WIDENED)
        self.assertGreaterEqual(part.bar, 0.1)

    def test_swings_are_not_extrapolated(self):
        part = part_of((2, 1, 0.5), (1.0, 1.4, 1.1), 2, 1e-12)
        self.assertEqual(part.state, OUTSIDE)
        self.assertEqual(part.remaining, 0)
        part = part_of((2, 1, 0.5), (1.0, 1.4, 1.35), 2, 1e-12)
        self.assertEqual((part.state, part.remaining), (WIDENED, 0))

    def test_differences_that_grow_are_outside(self):
        part = part_of((2, 1, 0.5), (1.0, 1.1, 1.3), 2, 1e-12)
        self.assertEqual(part.state, OUTSIDE)

    def test_two_members_give_no_bar(self):
        self.assertEqual(part_of((2, 1), (1.0, 1.1), 2, 1e-12).state, OUTSIDE)

    def test_differences_within_noise_say_nothing(self):
        part = part_of((2, 1, 0.5), (1.0, 1.0001, 0.9999), 2, 2e-4)
        self.assertEqual(part.state, SILENT)
        self.assertGreaterEqual(part.bar, 2e-4)


class ByElements(unittest.TestCase):
    """One mesh and one finer one: the other element on the first stands in for a third."""

    def bar(self, linear, quadratic, finer, element):
        own, other = (linear, quadratic) if element == "p1" else (quadratic, linear)
        values = [Value(1, 1, own), Value(0.5, 1, finer), Value(1, 1, other, other=True)]
        return bar_of(values, EXACT, 2, 2, element)

    def test_linear_result_is_off_by_less_than_twice_the_difference(self):
        bar = self.bar(EXACT + 0.1, EXACT + 0.02, EXACT + 0.025, "p1")
        self.assertEqual(bar.verdict, BAR_WIDENED)
        self.assertTrue(0.1 <= bar.total <= 0.17)

    def test_quadratic_result_is_off_by_less_than_the_difference(self):
        self.assertAlmostEqual(self.bar(EXACT + 0.1, EXACT + 0.02, EXACT, "p2p1").total, 0.08, places=5)

    def test_finer_mesh_that_goes_away_forbids_it(self):
        self.assertEqual(self.bar(EXACT + 0.1, EXACT + 0.02, EXACT + 0.3, "p1").verdict, NOT_IN_RANGE)

    def test_without_it_the_third_mesh_is_missing(self):
        bar = bar_of([Value(1, 1, 1.0), Value(0.5, 1, 1.1)], 1.0, 2, 2)
        self.assertEqual((bar.verdict, bar.advice), (NOT_IN_RANGE, "a third mesh is missing"))


class WithNoise(unittest.TestCase):
    """Meshes of a generator: each value is off by chance, too."""

    def test_bars_hold_95_percent(self):
        chance = random.Random(28)
        held = given = 0
        ratios = []
        for _ in range(400):
            order, factor = chance.choice((1, 2, 3)), chance.uniform(0.02, 0.2)
            sizes = (2, 1.4, 1, 0.7)
            noisy = [y + chance.gauss(0, 0.03 * factor) for y in line(sizes, order, factor)]
            part = part_of(sizes, noisy, order, 0.0)
            if part.state == OUTSIDE:
                continue
            given += 1
            error = abs(noisy[2] - EXACT)
            held += error <= part.bar
            ratios.append(part.bar / error)
        self.assertGreater(given, 350)
        self.assertGreaterEqual(held, 0.95 * given)
        self.assertLess(sorted(ratios)[len(ratios) // 2], 4)


class MeshAndStep(unittest.TestCase):
    """y = y0 + a h^p + b s^q + c h^p s^q."""

    FAMILY = ((2, 1), (1, 1), (0.5, 1), (1, 2), (1, 0.5), (0.5, 0.5))

    def bar(self, a, b, c=0.0, p=2, q=2, loose=None, family=FAMILY):
        values = [Value(h, s, EXACT + a * h**p + b * s**q + c * h**p * s**q) for h, s in family]
        if loose is not None:
            values.append(Value(1, 1, values[1].value + loose, True))
        return bar_of(values, EXACT, p, q)

    def test_splits_into_mesh_and_step(self):
        bar = self.bar(0.1, 0.02)
        self.assertEqual(bar.verdict, CONVERGES)
        self.assertTrue(0.1 <= bar.mesh.bar <= 0.201)
        self.assertTrue(0.02 <= bar.step.bar <= 0.0401)
        self.assertAlmostEqual(bar.best, EXACT, places=4)

    def test_parts_that_cancel_do_not_shrink_the_bar(self):
        bar = self.bar(0.1, -0.1)
        self.assertGreaterEqual(bar.total, 0.2)

    def test_step_alone_would_make_it_worse(self):
        """The mesh's error grows as the step falls: refined alone, neither shows it all."""
        bar = self.bar(0.1, 0.02, -0.06)
        self.assertGreater(bar.together, 0.03)
        self.assertGreaterEqual(bar.total, abs(0.1 + 0.02 - 0.06))
        self.assertNotEqual(bar.verdict, CONVERGES)

    def test_product_that_outweighs_both_is_not_in_range(self):
        bar = self.bar(0.001, 0.001, 0.5)
        self.assertFalse(bar.given and bar.total < 0.5)

    def test_looser_tolerances_give_the_solver_part(self):
        bar = self.bar(0.1, 0.02, loose=0.009)
        self.assertAlmostEqual(bar.solver, 3 * 0.009 / 9)

    def test_bar_elsewhere_falls_with_the_orders(self):
        bar = self.bar(0.1, 0.02)
        self.assertAlmostEqual(bar.at(0.5, 0.5), bar.total / 4, delta=0.02 * bar.total)

    def test_advice_names_what_is_outside(self):
        values = [Value(h, 1, y) for h, y in ((2, 1.0), (1, 1.2), (0.5, 1.6))]
        bar = bar_of(values, 1.0, 2, 2)
        self.assertEqual((bar.verdict, bar.advice), (NOT_IN_RANGE, "refine the mesh"))

    def test_small_part_without_order_does_not_forbid_a_bar(self):
        values = [Value(h, 1, EXACT + 0.1 * h**2) for h in (2, 1, 0.5)]
        values += [Value(1, 2, EXACT + 0.1 + 1e-5), Value(1, 0.5, EXACT + 0.1 + 3e-5)]
        self.assertIn(bar_of(values, EXACT, 2, 2).verdict, (CONVERGES, BAR_WIDENED))

    def test_without_the_own_member_there_is_none(self):
        self.assertIsNone(bar_of([Value(2, 1, 1.0), Value(0.5, 1, 1.0)], 1.0, 2, 2))

    def test_value_at_a_wall_of_a_singularity(self):
        """Logarithms have no order: whatever the ratio, differences stay as large."""
        values = [Value(h, 1, math.log(h)) for h in (2, 1, 0.5, 0.25)]
        self.assertEqual(bar_of(values, 1.0, 2, 2).verdict, NOT_IN_RANGE)


if __name__ == "__main__":
    unittest.main()
