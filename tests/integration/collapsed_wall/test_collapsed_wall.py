"""A state that is no solution of a wall does not end as one: collapsed, folded, or reached by a jump from another branch."""

import math
import unittest
from pathlib import Path

from programs import DRIVERS, MESH, MONOLITHIC, FolderTest, attempt, execute, run, summary

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
        """u_z of the pulled face, mm."""
        return float((folder / "points.csv").read_text().splitlines()[-1].split(",")[-1])

    def test_the_same_state_whatever_the_load_steps(self):
        for traction, steps in ((133.3333333, 2), (200, 1), (200, 2), (200, 5)):
            with self.subTest(traction=traction, steps=steps):
                folder = run(MONOLITHIC, BLOCK, self.base / "block", *self.settings(traction, steps))
                self.assertAlmostEqual(self.end(folder) / elongation(traction), 1, delta=2e-3)

    def of_linear_elastic(self):
        """The block of a law of small strains: E = 100 kPa, nu = 0."""
        text = BLOCK.read_text().replace("bulk_modulus = 1e5\n", "")
        begin, end = text.index("material ="), text.index("[[support]]")
        case = self.base / "linear.toml"
        case.write_text(text[:begin] + 'material = "linear-elastic"\nyoung = 100\npoisson = 0\n' + text[end:])
        return case

    def test_small_strains_left_behind_are_said(self):
        case = self.of_linear_elastic()
        for program in DRIVERS:
            for traction, warned in ((4, False), (20, True)):
                process = attempt(
                    program, case, "--force", folder=self.base / "linear", settings=self.settings(traction, 2)
                )
                self.assertEqual(process.returncode, 0, process.stderr)
                self.assertEqual("linear-elastic holds for small strains" in process.stdout, warned, process.stdout)
                strain = summary(self.base / "linear")["wall_deformation"]["wall"]["largest_strain"]["value"]
                self.assertAlmostEqual(strain, traction / 100, delta=1e-9)
                self.assertAlmostEqual(self.end(self.base / "linear"), traction / 100, delta=1e-9)
        log = (self.base / "linear" / "run.log").read_text()
        self.assertRegex(log, r"layer wall: .* a strain of 10 % near \(0\.\d+, 0\.\d+, 0\.\d+\) mm at 0.5 of the load")
        self.assertRegex(log, r"in this run the largest strain is 20 % near")
        self.assertIn("step 1  0.5 of the load  coupling", log)
        self.assertIn("step 2/2, 1 of the load: ", process.stdout)

    def test_a_folded_block_is_no_solution(self):
        process = attempt(
            MONOLITHIC, self.of_linear_elastic(), "-q", folder=self.base / "folded", settings=self.settings(-150, 1)
        )
        self.assertEqual(process.returncode, 2, process.stderr)
        self.assertRegex(process.stderr, r"the wall is folded near \(.*\) mm in layer wall, where det F is -")
        load = summary(self.base / "folded")["wall_deformation"]["wall"]["least_det_F"]
        self.assertGreater(load["value"], 0)
        self.assertAlmostEqual(load["value"], 1 - 1.5 * load["time_ms"], delta=1e-9)
        self.assertGreater(load["time_ms"], 0.65)  # it folds at two thirds


if __name__ == "__main__":
    unittest.main()
