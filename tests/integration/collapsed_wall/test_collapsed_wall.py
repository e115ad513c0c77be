"""A state that is no solution of a wall does not end as one: collapsed, folded, or reached by a jump from another branch."""

import math
import unittest
from pathlib import Path

from programs import MESH, MONOLITHIC, PARTITIONED, FolderTest, attempt, csv_columns, execute, run, summary

HERE = Path(__file__).parent
BLOCK = HERE / "block.toml"
C10, K1, K2, ALPHA, KAPPA, BULK = 7.64, 996.6, 524.6, math.radians(49.98), 0.226, 1e5


def energy(x, y, z):
    """Of the block per volume, kPa, at these stretches: [Gasser2006] with the isochoric invariants, and kappa/2 (J - 1)^2."""
    j = x * y * z
    part = j ** (-2 / 3)
    first = part * (x * x + y * y + z * z)
    fibre = part * (z * z * math.cos(ALPHA) ** 2 + x * x * math.sin(ALPHA) ** 2)
    strain = KAPPA * (first - 3) + (1 - 3 * KAPPA) * (fibre - 1)
    psi = C10 / 2 * (first - 3) + BULK / 2 * (j - 1) ** 2
    return psi + (K1 / K2 * math.expm1(K2 * strain * strain) if strain > 0 else 0.0)


def slope(f, x, h=1e-5):
    return (f(x + h) - f(x - h)) / (2 * h)


def root(f, low, high):
    """Of a rising function."""
    for _ in range(28):
        middle = (low + high) / 2
        low, high = (low, middle) if f(middle) > 0 else (middle, high)
    return low


def elongation(traction):
    """The stretch less 1 along z at which uniform states bear a traction, both sides free."""

    def side(x, z):
        return root(lambda y: slope(lambda s: energy(x, s, z), y), 0.7 / x / z, 1.3 / x / z)

    def other(z):
        return root(lambda x: slope(lambda s: energy(s, side(x, z), z), x), 0.5, 1.2)

    def bears(z):
        x = other(z)
        return slope(lambda s: energy(x, side(x, z), s), z) - traction

    return root(bears, 1.0, 1.4) - 1


class CollapsedWall(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = cls.base / "block.msh"
        made = execute(MESH, "geo", HERE / "block.geo", "--order", "2", "-q", "-o", cls.mesh)
        assert made.returncode == 0, made.stderr

    def settings(self, traction, steps, *more):
        pull = f"support.pull.traction=[0,0,{traction}]"
        return (f"mesh.file={self.mesh}", pull, f"static.load_steps={steps}", *more)

    def end(self, folder):
        return csv_columns(folder / "points.csv")["displacement_z_mm"][-1]

    def test_the_same_state_whatever_the_load_steps(self):
        for traction, steps in ((133.3333333, 2), (200, 1), (200, 2), (200, 5)):
            with self.subTest(traction=traction, steps=steps):
                folder = run(MONOLITHIC, BLOCK, self.base / "block", *self.settings(traction, steps))
                self.assertAlmostEqual(self.end(folder) / elongation(traction), 1, delta=2e-3)


if __name__ == "__main__":
    unittest.main()
