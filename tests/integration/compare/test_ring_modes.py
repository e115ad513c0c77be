"""Oscillations of a ring in an annulus of liquid: its waves obey the equations of motion, published frequencies, the limits of a thin ring
and of little viscosity; and a swing is found again in a sum of exponentials."""

import unittest
from dataclasses import replace

import numpy as np
import synthetic  # noqa: F401: the package's folder onto the path

from known_solutions.ring_modes import Ring, bessel, bessel_integrals, bessel_series
from known_solutions.swings import free_swing

# kPa, m, s: the ring of solids4foam's study ringAddedMass.
DRY = Ring(0.95, 1.05, 1.5, young=1e6, poisson=0.3, density=1000.0, liquid=0.0, viscosity=0.0)
PUBLISHED = {14.0: 2.435615, 140.0: 1.804513, 1400.0: 0.768654}  # rad/s, without viscosity


class Equations(unittest.TestCase):
    n, s, r = 2, -0.3 + 1.7j, 1.2

    def balance(self, waves, shear, inertia):
        """What the momentum of each wave lacks, relative to its parts; derivatives by differences."""
        step = 1e-4
        here, ahead, behind = waves(self.r), waves(self.r + step), waves(self.r - step)
        slope = (ahead - behind) / (2 * step)
        n, r = self.n, self.r
        u, v, radial, across = here
        around = radial - 2 * shear * (slope[0] - (n * v + u) / r)
        lacks = (
            slope[2] + (radial - around) / r + n * across / r - inertia * u,
            slope[3] + 2 * across / r - n * around / r - inertia * v,
            across - shear * (slope[1] - v / r - n * u / r),
        )
        parts = np.abs(slope).max(axis=0) + np.abs(here).max(axis=0)
        return max(float((np.abs(lack) / parts).max()) for lack in lacks), np.abs(slope[0] + u / r + n * v / r) / parts

    def test_waves_of_the_liquid(self):
        ring = replace(DRY, liquid=140.0, viscosity=9.0)
        lack, swelling = self.balance(lambda r: ring.liquid_waves(self.n, self.s, r), 9.0, 140.0 * self.s)
        self.assertLess(lack, 1e-6)
        self.assertLess(swelling.max(), 1e-6)

    def test_waves_of_the_wall(self):
        lack, _ = self.balance(lambda r: DRY.wall_waves(self.n, self.s, r), DRY.shear, DRY.density * self.s**2)
        self.assertLess(lack, 1e-6)


class Modes(unittest.TestCase):
    def test_published_frequencies(self):
        self.assertAlmostEqual(DRY.mode(2, 2.5j).imag, 2.555042, delta=5e-7)
        for liquid, omega in PUBLISHED.items():
            s = replace(DRY, liquid=liquid).mode(2, 1j * omega)
            self.assertAlmostEqual(s.imag, omega, delta=1e-6)
            self.assertAlmostEqual(s.real, 0, delta=1e-9)

    def test_thin_ring(self):
        """w^2 = E h^2 n^2 (n^2 - 1)^2/(12 (1 - nu^2) rho a^4 (n^2 + 1)) but for (h/a)^2; and liquid that adds its mass."""
        off = []
        for h in (0.1, 0.05):
            ring = replace(DRY, inner=1 - h / 2, outer=1 + h / 2)
            stiffness = ring.young * h**2 / (12 * (1 - ring.poisson**2) * ring.density)
            thin = np.sqrt(stiffness * 36 / 5)
            dry = ring.mode(2, 1j * thin).imag
            off.append(dry / thin - 1)
            across, rigid = ring.outer**4, ring.rigid**4
            added = 140.0 * ring.outer / 2 * (rigid + across) / (rigid - across)  # of each area, kg/m^2
            ratio = 1 / np.sqrt(1 + added * ring.outer / (ring.density * h) * 4 / 5)
            wet = replace(ring, liquid=140.0).mode(2, 1j * thin * ratio).imag
            self.assertAlmostEqual(wet / dry, ratio, delta=0.2 * h**2 * ratio)
        self.assertAlmostEqual(off[0] / off[1], 4, delta=0.1)

    def test_little_viscosity(self):
        """Shift and decay of thin layers, as the root of the viscosity."""
        slips = replace(DRY, liquid=140.0).mode(2, 1.8j)
        off = [replace(DRY, liquid=140.0, viscosity=mu).mode(2, slips) - slips for mu in (4e-5, 1e-5)]
        self.assertAlmostEqual(off[0].real / off[1].real, 2, delta=0.01)
        self.assertAlmostEqual(off[1].imag / off[1].real, 1, delta=0.01)

    def test_bessel_functions(self):
        """Series and integrals, and Wronski's determinant."""
        for n in (0, 1, 2, 3):
            for z in (3.9 + 0.2j, 2.9 - 2.7j):
                (i, k), (scaled_i, scaled_k) = bessel_series(n, z), bessel_integrals(n, z)
                self.assertLess(abs(i * np.exp(-z) / scaled_i - 1) + abs(k * np.exp(z) / scaled_k - 1), 1e-11)
            for z in (0.07j, 1 + 2j, 30 + 31j, 300 + 300j):
                i, slope_i, k, slope_k = bessel(n, z, z, z)
                self.assertLess(abs((i * slope_k - slope_i * k) * z + 1), 1e-9)


class Found(unittest.TestCase):
    def test_a_swing_beside_slow_flow(self):
        t = np.arange(0.0, 30000.0, 20.0)
        s = (-0.0504 + 0.7216j) * 1e-3
        values = np.real((0.3 - 0.1j) * np.exp(s * t)) + 0.02 * np.exp(-3e-4 * t) + 0.01 * np.exp(-1.2e-3 * t)
        self.assertLess(abs(free_swing(t, values, 5400.0, 800.0) / s - 1), 1e-6)
        # The last bit of a swing alone makes roots that are no swings' be anywhere.
        self.assertLess(abs(free_swing(t, np.real(np.exp(s * t)), 5400.0, 800.0, 2) / s - 1), 1e-9)


if __name__ == "__main__":
    unittest.main()
