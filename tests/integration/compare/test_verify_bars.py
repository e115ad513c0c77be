"""Error bars of `fsi-compare verify` on sequences whose exact value is known."""

import math
import random
import types
import unittest

import numpy as np
import synthetic  # noqa: F401: the package onto the path
from fsi_compare.verify.direction import AS_EXPECTED, OUTSIDE, SILENT, WIDENED, Part, observed, part_of
from fsi_compare.verify.family import Member
from fsi_compare.verify.quantities import Asked, Curve, peak
from fsi_compare.verify.results import FamilyRuns, bands, judge, missed_sizes
from fsi_compare.verify.verdict import BAR_WIDENED, CONVERGES, NOT_IN_RANGE, Value, bar_of

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

    def test_error_of_the_solver_that_hides_all_orders_widens(self):
        bar = self.bar(0.001, 0.0005, loose=0.9)
        self.assertEqual((bar.mesh.state, bar.step.state, bar.verdict), (SILENT, SILENT, BAR_WIDENED))
        self.assertGreaterEqual(bar.total, 0.1)

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


class Waves(unittest.TestCase):
    """A pulse that a coarse mesh carries too slowly: y(s, t) = exp(-(s - (1 - e) t)^2), e = a h^p + b dt^q. Its norm does not
    know: the curve itself is off."""

    FAMILY = ((1.5, 1), (1, 1), (1 / 1.5, 1), (1, 2), (1, 0.5), (1 / 1.5, 0.5))

    def curve(self, h, dt, a, b, p):
        times, s = np.arange(1, round(8 / (0.125 * dt)) + 1) * 0.125 * dt, np.linspace(0, 18, 91)
        slow = 1 - a * h**p - b * dt**2
        y = np.exp(-((s[None, :] - 3 - slow * times[:, None]) ** 2))
        return Curve("line: pressure", "Pa", times, y, s)

    def judged(self, a, b=0.0, p=2.0):
        return self.judged_of({Member(h, dt): {"line: pressure": self.curve(h, dt, a, b, p)} for h, dt in self.FAMILY})

    def judged_of(self, curves):
        runs = {
            m: types.SimpleNamespace(done=True, summary={"mesh": {"nodes": round(1e6 / m.mesh**2)}}) for m in curves
        }
        asked = Asked((4.0,))
        facts = types.SimpleNamespace(
            space_order=lambda pressure: 2.0,
            time_order=2.0,
            element="p1",
            flow_interval=None,
            asked=lambda times: asked,
        )
        found = judge(FamilyRuns("monolithic", runs), curves, facts, (4.0,), ())
        return {one.quantity.name.partition(", ")[2]: one for one in found}

    def test_error_of_the_line_is_held_where_that_of_its_norm_is_tiny(self):
        truth = self.curve(1e-3, 1.0, 0.0, 0.0, 2.0)
        for a in (0.002, 0.01, 0.03):
            found = self.judged(a)
            for name in ("line over time", "line at 4 ms", "line at the end", "anywhere", "anywhere at the end"):
                one = found[name]
                error = one.apart(truth)
                self.assertTrue(one.bar.given, name)
                self.assertTrue(error <= one.bar.total <= 8 * error, (a, name, error, one.bar.total))
                self.assertTrue(0.6 * error <= one.bar.off <= 1.6 * error, (name, one.bar.off, error))
            norm = found["L2 norm"]
            self.assertLess(abs(norm.bar.value - norm.quantity.of(truth)), 0.01 * found["line over time"].apart(truth))

    def test_order_is_that_of_the_curve(self):
        one = self.judged(0.002, 0.001)["line over time"]
        self.assertAlmostEqual(one.bar.mesh.order, 2, delta=0.1)
        self.assertAlmostEqual(one.bar.step.order, 2, delta=0.1)
        self.assertEqual(one.bar.verdict, CONVERGES)

    def test_value_without_order_has_the_bar_of_its_curve(self):
        """By the end the pulse has passed some points and not others: whatever a number of the curve does, it is off by no
        more than the curve is."""
        for name, one in self.judged(0.01).items():
            if one.quantity.whole is None:
                error = abs(one.bar.value - one.quantity.of(self.curve(1e-3, 1.0, 0.0, 0.0, 2.0)))
                self.assertTrue(one.bar.given and error <= one.bar.total + 1e-12, name)

    def test_norm_over_a_kink_has_no_bar_of_its_curve(self):
        """A flow that rises within two steps is exact at the levels of each member; its norm is that of the levels."""

        def flow(dt):
            times = np.arange(1, round(20 / dt) + 1) * dt
            return Curve("inlet: flow", "mm^3/ms", times, np.minimum(times / 2, 1.0)[:, None], np.zeros(1))

        curves = {Member(h, dt): {"inlet: flow": flow(dt)} for h, dt in self.FAMILY}
        found = self.judged_of(curves)
        self.assertTrue(found["curve"].bar.given)
        self.assertFalse(found["L2 norm"].bar.given)
        self.assertTrue(found["at the end"].bar.given)

    def test_norm_is_not_better_known_than_its_curve(self):
        """Values that fall by order 2 are extrapolated by the order of a curve that falls by less, and refused with it."""

        values = line((1.5, 1, 1 / 1.5), 2)
        free = part_of((1.5, 1, 1 / 1.5), values, 2, 1e-12)
        slow = part_of((1.5, 1, 1 / 1.5), values, 2, 1e-12, Part(WIDENED, 1.0, 0.8))
        self.assertEqual((free.state, slow.state), (AS_EXPECTED, WIDENED))
        self.assertGreater(slow.bar, 2 * free.bar)
        lost = part_of((1.5, 1, 1 / 1.5), values, 2, 1e-12, Part(OUTSIDE, 1.0, 0.1))
        self.assertEqual(lost.state, OUTSIDE)

    def test_bands_hold_the_curve(self):
        def at(h, dt):
            of = self.curve(h, dt, 0.01, 0.005, 2.0)
            return Curve("tip: pressure", "Pa", of.times, of.values[:, 40:41], of.s[40:41])

        curves = {Member(h, dt): {"tip: pressure": at(h, dt)} for h, dt in self.FAMILY}
        along = {m: {"line: pressure": self.curve(m.mesh, m.step, 0.01, 0.005, 2.0)} for m in curves}
        runs = {m: types.SimpleNamespace(done=True, summary={}) for m in curves}
        facts = types.SimpleNamespace(
            space_order=lambda pressure: 2.0, time_order=2.0, element="p1", flow_interval=None, asked=lambda times: None
        )

        facts.asked = lambda times: Asked((4.0,))
        for of, number in ((curves, 1), (along, 2)):
            family = FamilyRuns("monolithic", runs)
            found = bands(family, of, judge(family, of, facts, (4.0,), ()))
            self.assertEqual(len(found), number)
            for band in found:
                exact = self.curve(1e-3, 1.0, 0.0, 0.0, 2.0).values
                truth = exact[:, 40] if not band.along else exact[-1 if "end" in band.name else 31]
                self.assertEqual(len(band.x), len(truth))
                self.assertTrue(np.all(np.abs(band.values - truth) <= band.half_width), band.name)


class Sizes(unittest.TestCase):
    def test_meshes_that_stop_growing_are_named(self):
        def family(*cells):
            members = (Member(1.5, 1.0), Member(1.0, 1.0), Member(1 / 1.5, 1.0))
            return {m: types.SimpleNamespace(summary={"mesh": {"triangles": n}}) for m, n in zip(members, cells)}

        self.assertEqual(missed_sizes(family(440, 1000, 2200)), "")
        self.assertEqual(missed_sizes(family(500, 1000, 2100)), "")  # a generator's own roundings
        self.assertIn("sizes 1 and 0.667 differ", missed_sizes(family(440, 1000, 1010)))  # a script's least size
        self.assertIn("not 1.5", missed_sizes(family(990, 1000, 1010)))


class Peaks(unittest.TestCase):
    def test_no_parabola_passes_over_a_jump(self):
        t = np.arange(1, 9) / 32
        self.assertEqual(peak(t, np.array([1290.0, 1326.0, 1328.0, 1328.4, 0.0, 10.0, 0.0, 5.0])), 1328.4)
        cusp = np.array([0.9, 1.2, 1.4, 1.451, 0.8, 0.5, 0.3, 0.2])  # a flow that the pressure has left
        self.assertLess(peak(t, cusp), 1.451 * 1.001)
        for shift in np.linspace(-0.5, 0.5, 11):  # a smooth crest of 8 levels a period
            y = np.cos((np.arange(8) - 3 + shift) * 2 * math.pi / 8)
            self.assertAlmostEqual(peak(np.arange(8.0), y), 1, delta=0.012)


if __name__ == "__main__":
    unittest.main()
