"""Walls of laws with a finite bulk modulus in both drivers, and fibre frames of the wall's own potentials."""

import unittest
from pathlib import Path

import numpy as np
from programs import CASES, MONOLITHIC, PARTITIONED, FolderTest, attempt, energy, make_mesh, run, summary, wall

CASE = Path(__file__).with_name("compressible_walls.toml")
ARTERY = CASES / "artery.toml"
LAPLACE = "structure.fibre_frame=laplace"


class CompressibleWalls(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = run(MONOLITHIC, CASE, cls.base / "monolithic")

    def test_drivers_agree(self):
        other = run(PARTITIONED, CASE, self.base / "partitioned", "partitioned.tolerance=1e-9")
        newton = "monolithic.newton_tolerance=1e-9"
        exact = run(MONOLITHIC, CASE, self.base / "exact", newton, "monolithic.mode=full")
        expected, found = wall(exact)[-1], wall(other)[-1]
        largest = np.abs(expected[:, 2]).max()
        self.assertGreater(largest, 0.01)
        self.assertLess(np.abs(found - expected)[:, 2].max(), 1e-6 * largest)

    def test_energy_balance_closes(self):
        rows = energy(self.folder)
        self.assertGreater(rows["wall_volumetric_energy"].max(), 1e-4)
        stored = (rows["wall_isochoric_energy"] + rows["wall_volumetric_energy"]).max()
        self.assertLess(np.abs(rows["remainder"]).max(), 1e-3 * stored)

    def test_a_checkpoint_knows_the_constants(self):
        """Other constants are another case."""
        refused = attempt(
            MONOLITHIC,
            CASE,
            "-q",
            "--restart",
            self.folder,
            folder=self.base / "other",
            settings=("structure.layers.media.poisson=0.31", "time.end=1.25"),
        )
        self.assertEqual(refused.returncode, 1)
        self.assertIn("structure.layers.media.poisson", refused.stderr)


class FibreFrames(FolderTest):
    def displacement(self, name, *settings):
        folder = run(MONOLITHIC, ARTERY, self.base / name, "time.end=0.5", *settings)
        counters = summary(folder)["counters"]
        return wall(folder)[-1][:, 2], counters.get("elements with fibres")

    def test_of_a_tube_are_the_cylinders(self):
        expected, fibres = self.displacement("cylinder")
        found, same = self.displacement("laplace", LAPLACE)
        self.assertEqual(fibres, same)
        error = np.abs(found - expected).max() / np.abs(expected).max()
        print(f"displacement by the wall's potentials, relative to that by the axis: {error:.1e}")
        self.assertLess(error, 3e-3)
        self.assertGreater(error, 0, "two ways of finding directions")

    def test_lie_right_in_a_sector(self):
        """Planes of symmetry carry no condition of the potentials."""
        mesh = make_mesh(self.base / "quarter.msh", "--sector", 90)
        quarter = self.base / "quarter.toml"
        quarter.write_text(ARTERY.read_text().replace('level = "coarse"', f'file = "{mesh}"'))
        folders = [
            run(MONOLITHIC, quarter, self.base / name, "time.end=0.5", f"structure.fibre_frame={name}")
            for name in ("cylinder", "laplace")
        ]
        expected, found = (wall(folder)[-1][:, 2] for folder in folders)
        self.assertLess(np.abs(found - expected).max(), 3e-3 * np.abs(expected).max())

    def test_of_a_tube_along_another_axis_are_its_own(self):
        """Where the case names no frame. Its stretch is that of the tube along z; about the z axis it was up to half as
        much again on one side."""
        text = STATIC.read_text()
        for name, order in (("z", (0, 1, 2)), ("x", (2, 0, 1))):
            mesh = make_mesh(self.base / f"along_{name}.msh", "--level", "coarse", "--length", 3, "--format", "2.2")
            turn(mesh, order)
            case = self.base / f"along_{name}.toml"
            case.write_text(text.replace("artery.msh", mesh.name))
            folder = run(MONOLITHIC, case, self.base / f"static_{name}")
            self.assertEqual(summary(folder)["fibre_frame"], "laplace" if name == "x" else "cylinder")
            self.assertIn(f"structure.fibre_frame = {summary(folder)['fibre_frame']}", (folder / "run.log").read_text())
        points = [table(self.base / f"static_{name}", "points.csv")[-4:] for name in "zx"]
        along_z, along_x = (np.hypot(*rows[:, columns].T) for rows, columns in zip(points, ([3, 4], [4, 5])))
        print("displacement of the ring at four points, mm:", along_z, along_x)
        self.assertLess(np.abs(along_x / along_z.mean() - 1).max(), 0.02)

    def test_a_run_about_the_axis_is_not_continued_with_another_frame(self):
        """What earlier programs took where a case names no frame, and what a wall along x has now."""
        case = self.base / "along_x.toml"
        if not case.exists():
            self.test_of_a_tube_along_another_axis_are_its_own()
        folder = run(MONOLITHIC, case, self.base / "earlier", "structure.fibre_frame=cylinder", "static.load_steps=2")
        refused = attempt(MONOLITHIC, case, "-q", "--restart", folder, folder=self.base / "later")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("structure.fibre_frame was cylinder and is laplace, which the shape of the wall", refused.stderr)

    def test_without_fibres_nothing_is_asked_of_the_wall(self):
        plain = CASES / "neo-hookean.toml"
        ways = [
            run(MONOLITHIC, plain, self.base / f"plain{k}", "time.end=0.125", *s)
            for k, s in enumerate(((), (LAPLACE,)))
        ]
        self.assertEqual(*((folder / "wall_displacement.csv").read_bytes() for folder in ways))


if __name__ == "__main__":
    unittest.main()
