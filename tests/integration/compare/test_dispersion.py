"""Exact wave numbers of tubes: against a published one, by a second route, and found again in waves that are made of them."""

import unittest
from pathlib import Path

import numpy as np
import synthetic  # noqa: F401: the package's folder onto the path

from known_solutions.dispersion import (
    Swing,
    compressible_waves,
    incompressible_waves,
    lack,
    modified_bessel,
    root,
    wave_number,
)
from fsi_compare.gallery.scene import READY, read_scene


class Exact(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.free = read_scene(Path(READY) / "womersley-elastic").module

    def test_published_number(self):
        k = 1000 * self.free.EXACT  # 1/m
        self.assertAlmostEqual(k.real, 0.143978, delta=5e-7)
        self.assertAlmostEqual(k.imag, -0.020727, delta=5e-7)
        self.assertAlmostEqual(self.free.OMEGA / self.free.EXACT.real, 0.872796, delta=5e-7)

    def test_both_are_waves_of_their_own(self):
        for k in (self.free.EXACT, self.free.OTHER):
            self.assertLess(abs(self.free.lacking(k)), 1e-10 * abs(self.free.lacking(1.01 * k)))
        self.assertGreater(abs(self.free.EXACT - self.free.OTHER), 0.5 * abs(self.free.EXACT))

    def test_a_wall_that_can_hardly_be_compressed_is_an_incompressible_one(self):
        """The waves of either are sums of other functions."""
        omega, density, shear, inner, outer = 0.8, 1.1, 40.0, 2.0, 2.5
        liquid = (1j * omega * 1.0, 0.02)

        def hard(k, lame):
            walls = [compressible_waves(density, shear, lame, omega, k, r) for r in (inner, outer)]
            return lack(omega, incompressible_waves(*liquid, k, inner), walls[0], walls[1][2:])

        def incompressible(k):
            walls = [incompressible_waves(-density * omega**2, shear, k, r) for r in (inner, outer)]
            return lack(omega, incompressible_waves(*liquid, k, inner), walls[0], walls[1][2:])

        thin = omega / np.sqrt(3 * shear * (outer - inner) / (2 * inner))
        exact = root(incompressible, thin, 1.05 * thin)
        apart = [abs(root(lambda k: hard(k, lame), exact, 1.001 * exact) / exact - 1) for lame in (4e3, 4e4)]
        self.assertLess(apart[0], 0.02)
        self.assertAlmostEqual(apart[0] / apart[1], 10, delta=0.5)  # falls with the compressibility

    def test_bessel_functions(self):
        """Wronski's determinant, and I_0 where numpy has it."""
        for z in (0.3 + 0.2j, 4 - 3j, 6.0 + 0j):
            i0, i1, k0, k1 = modified_bessel(z)
            self.assertLess(abs((i0 * k1 + i1 * k0) * z - 1), 1e-9)
        self.assertAlmostEqual(modified_bessel(2.0 + 0j)[0].real, float(np.i0(2.0)), delta=1e-12)


class Found(unittest.TestCase):
    z = np.linspace(0.0, 60.0, 181)
    k, other = 0.144 - 0.021j, 0.044 - 0.011j

    def waves(self, *shares):
        p = sum(
            share * np.exp(sign * 1j * k * self.z)
            for share, (k, sign) in zip(shares, ((self.k, -1), (self.k, 1), (self.other, -1), (self.other, 1)))
        )
        return Swing(self.z, p)

    def test_whatever_comes_back(self):
        for back in (0.0, 0.3 - 0.2j):
            self.assertLess(abs(wave_number(self.waves(1.0, back), 5.0) / self.k - 1), 1e-12)

    def test_beside_another_wave(self):
        swing = self.waves(1.0, 0.3 - 0.2j, 0.05j, -0.08)
        self.assertGreater(abs(wave_number(swing, 5.0) / self.k - 1), 1e-3)
        self.assertLess(abs(wave_number(swing, 5.0, [self.other]) / self.k - 1), 1e-11)


if __name__ == "__main__":
    unittest.main()
