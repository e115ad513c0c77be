"""Norms of differences that are known beforehand."""

import math
import unittest

import numpy as np
from synthetic import TIMES, Z, gaussian, parabola

from fsi_compare.runs.differences import difference, differences_at, largest_difference
from fsi_compare.runs.pressure_waves import PressureWaves
from fsi_compare.runs.waves import norm


def waves_of(wave, times=TIMES, z=Z):
    return PressureWaves(np.asarray(times), z, np.array([wave(t, z) for t in times]))


class Norms(unittest.TestCase):
    def test_constant(self):
        self.assertAlmostEqual(norm(Z, np.full(181, 2.0)), 2 * math.sqrt(18), places=12)

    def test_linear_by_trapezoids(self):
        # trapezoids of x^2 exceed the integral by h^2/12 (f'(b) - f'(a)) = h^2/6 b
        self.assertAlmostEqual(norm(Z, Z) ** 2, 18**3 / 3 + 0.01 * 18 / 6, places=9)

    def test_uneven_points(self):
        z = np.array([0.0, 1.0, 4.0])
        self.assertAlmostEqual(norm(z, np.array([1.0, 2.0, 0.0])) ** 2, 2.5 + 6.0, places=12)


class Differences(unittest.TestCase):
    def test_offset(self):
        d = difference(Z, gaussian(0.6)(5, Z), gaussian(0.6)(5, Z) - 0.5)
        self.assertAlmostEqual(d.max_norm, 0.5, places=12)
        self.assertAlmostEqual(d.l2_norm, 0.5 * math.sqrt(18), places=12)
        self.assertAlmostEqual(d.max_relative, 0.5 / gaussian(0.6)(5, Z).max(), places=12)

    def test_factor(self):
        d = difference(Z, gaussian(0.6)(5, Z), 1.02 * gaussian(0.6)(5, Z))
        self.assertAlmostEqual(d.max_relative, 0.02, places=12)
        self.assertAlmostEqual(d.l2_relative, 0.02, places=12)

    def test_relative_to_the_largest_magnitude(self):
        d = difference(Z, -gaussian(0.6)(5, Z), -1.02 * gaussian(0.6)(5, Z))
        self.assertAlmostEqual(d.max_relative, 0.02, places=12)

    def test_same(self):
        d = difference(Z, gaussian(0.6)(5, Z), gaussian(0.6)(5, Z))
        self.assertEqual((d.max_norm, d.max_relative, d.l2_norm, d.l2_relative), (0, 0, 0, 0))

    def test_reference_zero(self):
        d = difference(Z, 0 * Z, 0 * Z + 1)
        self.assertEqual((d.max_norm, d.max_relative, d.l2_relative), (1, None, None))

    def test_between_levels(self):
        reference = waves_of(lambda t, z: t * (1 + z))
        other = waves_of(lambda t, z: 1.1 * t * (1 + z), np.arange(13) * 1.0)
        [d] = differences_at(reference, other, [4.55])
        self.assertAlmostEqual(d.max_norm, 0.1 * 4.55 * 19, places=10)
        self.assertAlmostEqual(d.l2_relative, 0.1, places=12)

    def test_other_points(self):
        reference = waves_of(lambda t, z: t + z)
        other = waves_of(lambda t, z: t + z + 0.25, z=np.linspace(0, 18, 55))
        [d] = differences_at(reference, other, [6.0])
        self.assertAlmostEqual(d.max_norm, 0.25, places=12)


class OverTime(unittest.TestCase):
    def test_largest_of_all_levels(self):
        wave = parabola(0.6)
        # the error peaks at the single level t = 7.125 ms, which is none of the printed times
        other = waves_of(lambda t, z: wave(t, z) * (1.3 if t == 7.125 else 1.01))
        over = largest_difference(waves_of(wave), other)
        self.assertEqual(over.levels, 96)
        self.assertAlmostEqual(over.largest.max_relative, 0.3, places=12)
        self.assertAlmostEqual(over.largest.l2_relative, 0.3, places=12)

    def test_common_levels_only(self):
        wave = parabola(0.6)
        other = waves_of(wave, 0.3 * np.arange(1, 41))  # 0.125 i = 0.3 j at multiples of 1.5 ms
        over = largest_difference(waves_of(wave), other)
        self.assertEqual(over.levels, 8)
        self.assertLess(over.largest.max_norm, 1e-9)

    def test_no_common_level(self):
        wave = parabola(0.6)
        over = largest_difference(waves_of(wave), waves_of(wave, TIMES + 0.05))
        self.assertEqual((over.levels, over.largest), (0, None))

    def test_rest_at_the_start_does_not_spoil_the_relative_column(self):
        wave = parabola(0.6)
        times = np.concatenate(([0.0], TIMES))
        reference = waves_of(lambda t, z: wave(t, z) * (t > 0), times)
        other = waves_of(lambda t, z: wave(t, z) * (t > 0) * 1.01, times)
        over = largest_difference(reference, other)
        self.assertEqual(over.levels, 97)
        self.assertAlmostEqual(over.largest.max_relative, 0.01, places=12)


if __name__ == "__main__":
    unittest.main()
