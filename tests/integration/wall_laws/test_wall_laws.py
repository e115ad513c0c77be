"""Walls of laws with a finite bulk modulus in both drivers, and fibre frames of the wall's own potentials."""

import csv
import re
import unittest
from pathlib import Path

import numpy as np
from programs import CASES, MONOLITHIC, PARTITIONED, FolderTest, attempt, energy, make_mesh, run, summary, wall

CASE = Path(__file__).with_name("compressible_walls.toml")
TUBE = Path(__file__).with_name("tube_at_rest.toml")
ARTERY = CASES / "artery.toml"
LAPLACE = "structure.fibre_frame=laplace"


class CompressibleWalls(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = run(MONOLITHIC, CASE, cls.base / "monolithic")

    def test_drivers_agree(self):
        other = run(PARTITIONED, CASE, self.base / "partitioned", "partitioned.tolerance=1e-9")
        newton = "newton.tolerance=1e-9"
        exact = run(MONOLITHIC, CASE, self.base / "exact", newton, "newton.mode=full")
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

    def tube_along(self, name, order):
        """The case of a tube whose mesh is that along z with its coordinates in another order."""
        mesh = make_mesh(self.base / f"{name}.msh", "--level", "coarse", "--length", 1, "--order", 2, "--format", "2.2")
        lines = mesh.read_text().split("\n")
        first = lines.index("$Nodes") + 2
        for k in range(first, first + int(lines[first - 1])):
            number, *x = lines[k].split()
            lines[k] = " ".join([number, *(x[i] for i in order)])
        mesh.write_text("\n".join(lines))
        case = self.base / f"{name}.toml"
        at = [[1.43, 0, 0.5], [0, 1.43, 0.5], [-1.43, 0, 0.5], [0, -1.43, 0.5]]
        points = "".join(f"p{k} = {[x[i] for i in order]}\n" for k, x in enumerate(at))
        case.write_text(TUBE.read_text().replace("MESH", mesh.name) + "[output.points]\n" + points)
        return case

    def test_of_a_tube_along_another_axis_are_its_own(self):
        """Where the case names no frame. About the z axis the radius of one along x grew by 1.36 to 1.72."""
        for name, order, frame in (("z", (0, 1, 2), "cylinder"), ("x", (2, 0, 1), "laplace")):
            folder = run(MONOLITHIC, self.tube_along(name, order), self.base / name)
            self.assertEqual(summary(folder)["fibre_frame"], frame)
            self.assertIn(f"structure.fibre_frame = {frame}: the case names none", (folder / "run.log").read_text())
            with (folder / "points.csv").open() as file:
                rows = list(csv.DictReader(file))[-4:]
            place = [[float(row[f"{c}_mm"]) + float(row[f"displacement_{c}_mm"]) for c in "xyz"] for row in rows]
            place = np.array(place)  # distances do not know of a rigid motion, which the springs hardly hold
            stretch = np.linalg.norm(place[:2] - place[2:], axis=1) / (2 * 1.43)
            print(f"along {name}: the inner radius grows by", stretch)
            np.testing.assert_allclose(stretch, 1.2, atol=1.5e-3)

    def test_of_a_sector_along_another_axis_are_its_own(self):
        """A quarter of it: planes of symmetry meet at the axis, and its openings are quarters of discs."""
        mesh = make_mesh(
            self.base / "q.msh", "--level", "coarse", "--length", 1, "--order", 2, "--format", "2.2", "--sector", 90
        )
        lines = mesh.read_text().split("\n")
        first = lines.index("$Nodes") + 2
        for k in range(first, first + int(lines[first - 1])):
            number, x, y, z = lines[k].split()
            lines[k] = " ".join([number, z, x, y])
        names = {"symmetry_x": "symmetry_y", "symmetry_y": "symmetry_z"}
        text = re.sub("symmetry_[xy]", lambda found: names[found.group()], "\n".join(lines))
        mesh.write_text(text)
        case = self.base / "quarter_along_x.toml"
        points = "p0 = [0.5, 1.43, 0]\np1 = [0.5, 0, 1.43]\n"
        case.write_text(TUBE.read_text().replace("MESH", mesh.name) + "[output.points]\n" + points)
        folder = run(MONOLITHIC, case, self.base / "quarter_along_x")
        self.assertEqual(summary(folder)["fibre_frame"], "laplace")
        with (folder / "points.csv").open() as file:
            one, other = list(csv.DictReader(file))[-2:]
        stretch = [1 + float(one["displacement_y_mm"]) / 1.43, 1 + float(other["displacement_z_mm"]) / 1.43]
        np.testing.assert_allclose(stretch, 1.2, atol=1.5e-3)

    def test_a_run_is_not_continued_with_another_frame(self):
        """What earlier programs took where a case names no frame, and what a wall along x has now."""
        case = self.tube_along("once", (2, 0, 1))
        about_z = run(MONOLITHIC, case, self.base / "about_z", "structure.fibre_frame=cylinder", "load.pressure=0.01")
        own = run(MONOLITHIC, case, self.base / "own", "load.pressure=0.01")
        for folder, settings, code in ((about_z, (), 1), (own, (), 0), (own, (LAPLACE,), 0)):
            attempted = attempt(
                MONOLITHIC,
                case,
                "-q",
                "--restart",
                folder,
                folder=self.base / f"later{len(settings)}{code}",
                settings=("load.pressure=0.01", *settings),
            )
            self.assertEqual(attempted.returncode, code, attempted.stderr)
            if code == 1:
                said = "structure.fibre_frame was cylinder and is laplace, which the shape of the wall decides"
                self.assertIn(said, attempted.stderr)

    def test_without_fibres_nothing_is_asked_of_the_wall(self):
        plain = CASES / "neo-hookean.toml"
        ways = [
            run(MONOLITHIC, plain, self.base / f"plain{k}", "time.end=0.125", *s)
            for k, s in enumerate(((), (LAPLACE,)))
        ]
        self.assertEqual(*((folder / "wall_displacement.csv").read_bytes() for folder in ways))


if __name__ == "__main__":
    unittest.main()
