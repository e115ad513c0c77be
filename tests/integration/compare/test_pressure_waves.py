"""Interpolation, peaks and speeds against waves that are known in closed form."""

import unittest

import numpy as np
from synthetic import TIMES, Z, artery_like, gaussian, parabola

from fsi_compare.runs.pressure_waves import PressureWaves, crest_speed, peak


def waves_of(wave, times=TIMES, z=Z):
    return PressureWaves(np.asarray(times), z, np.array([wave(t, z) for t in times]))


class Interpolates(unittest.TestCase):
    def test_on_a_level_nothing_is_changed(self):
        waves = waves_of(parabola(0.6))
        self.assertTrue((waves.at(4.5) == waves.pressure[35]).all())
        self.assertTrue((waves.at(4.5 + 1e-9) == waves.pressure[35]).all())

    def test_between_levels_linear(self):
        waves = waves_of(lambda t, z: (3 * t + 1) * z)
        np.testing.assert_allclose(waves.at(4.55), (3 * 4.55 + 1) * Z, rtol=1e-13)

    def test_range(self):
        waves = waves_of(parabola(0.6))
        self.assertTrue(waves.covers(0.125) and waves.covers(12.0) and waves.covers(12.0 + 1e-9))
        self.assertFalse(waves.covers(0.1) or waves.covers(12.01))

    def test_other_points_linear(self):
        waves = waves_of(lambda t, z: t * z)
        coarse = np.linspace(0, 18, 7)
        np.testing.assert_allclose(waves.on(coarse).at(2.0), 2 * coarse, rtol=1e-13)


class FindsPeak(unittest.TestCase):
    def test_parabola_between_points(self):
        top = peak(Z, parabola(0.0, start=7.237, height=42.5)(0, Z))
        self.assertAlmostEqual(top.z, 7.237, places=10)
        self.assertAlmostEqual(top.pressure, 42.5, places=9)

    def test_parabola_between_uneven_points(self):
        z = np.sort(np.concatenate((Z, Z[:-1] + 0.03)))
        top = peak(z, parabola(0.0, start=7.247, height=42.5)(0, z))
        self.assertAlmostEqual(top.z, 7.247, places=9)
        self.assertAlmostEqual(top.pressure, 42.5, places=9)

    def test_gaussian_to_a_thousandth_of_its_width(self):
        top = peak(Z, gaussian(0.0, start=7.237)(0, Z))
        self.assertAlmostEqual(top.z, 7.237, delta=1e-3)
        self.assertAlmostEqual(top.pressure, 50, delta=1e-2)

    def test_at_the_inlet(self):
        top = peak(Z, 10 - Z)
        self.assertEqual((top.pressure, top.z), (10, 0))


class FollowsCrest(unittest.TestCase):
    def test_exact_speed(self):
        for speed in (0.66, 0.7, 1.01):
            self.assertAlmostEqual(crest_speed(waves_of(parabola(speed))), speed, places=10)

    def test_gaussian_speed(self):
        self.assertAlmostEqual(crest_speed(waves_of(gaussian(0.66))), 0.66, delta=1e-4)

    def test_only_the_window_counts(self):
        wave = parabola(0.6)
        bent = waves_of(lambda t, z: wave(t if 4.5 <= t <= 9 else 2 * t, z))
        self.assertAlmostEqual(crest_speed(bent), 0.6, places=10)

    def test_standing_crest(self):
        self.assertAlmostEqual(crest_speed(waves_of(parabola(0.0, start=5))), 0, places=12)

    def test_least_squares_of_scattered_positions(self):
        def wave(t, z):  # every other level is off by +-0.2 mm, symmetric about the middle of the window
            return parabola(0.0, start=1 + 0.6 * t + (0.2 if round(8 * t) % 2 else -0.2))(t, z)

        self.assertAlmostEqual(crest_speed(waves_of(wave)), 0.6, places=10)

    def test_taller_crest_elsewhere_does_not_catch_it(self):
        main, late = parabola(0.6), parabola(0.9, start=8.0, height=80.0, half_width=1.0)
        waves = waves_of(lambda t, z: main(t, z) + (late(t, z) if t > 6 else 0))
        self.assertAlmostEqual(crest_speed(waves), 0.6, places=10)

    def test_artery_like_wave(self):
        self.assertAlmostEqual(crest_speed(waves_of(artery_like(0.66))), 0.66, delta=0.03)

    def test_not_trackable(self):
        fades = parabola(0.6)
        cases = {
            "run too short": waves_of(parabola(0.6), TIMES[:60]),
            "run begins late": waves_of(parabola(0.6), TIMES[48:]),
            "two levels in the window": waves_of(parabola(0.6), [4.5, 9.0]),
            "at rest": waves_of(lambda t, z: 0 * z),
            "suction only": waves_of(lambda t, z: -1 - (z - 9) ** 2),
            "largest at the inlet": waves_of(lambda t, z: 20 - z),
            "leaves through the outlet": waves_of(parabola(2.5)),
            "disappears": waves_of(lambda t, z: fades(t, z) if t < 7 else 0 * z),
            "levels too far apart": waves_of(
                parabola(3.0, start=-10.0, half_width=1.0), [4.0, 5.0, 6.0, 7.0, 8.0, 9.0]
            ),
        }
        for name, waves in cases.items():
            with self.subTest(name):
                self.assertIsNone(crest_speed(waves))


if __name__ == "__main__":
    unittest.main()
