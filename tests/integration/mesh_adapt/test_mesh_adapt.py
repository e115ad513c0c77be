"""fsi-mesh adapt: a mesh that is finer where the error indicator of a run is large, and what runs on it are worth."""

import re
import unittest

import numpy as np
from programs import CASES, MESH, MONOLITHIC, FolderTest, arrays, attempt, execute, make_mesh, run, summary

GALLERY = CASES.parents[1] / "gallery"
CASE = CASES / "axisymmetric" / "neo-hookean.toml"


class MeshAdapt(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = make_mesh(cls.base / "section.msh", "--axisymmetric", "--order", 2, "--length", 6)
        cls.settings = ("time.end=1.5", "output.every=4", "output.error_indicator=true")
        cls.folder = run(MONOLITHIC, CASE, cls.base / "run", f"mesh.file={cls.mesh}", *cls.settings)

    def adapt(self, *options, mesh=None, folder=None, to="adapted.msh"):
        return execute(MESH, "adapt", mesh or self.mesh, folder or self.folder, "-o", self.base / to, *options)

    def report(self, process):
        """Nodes, and (cells, area) by region, as the report says."""
        self.assertEqual(process.returncode, 0, process.stderr)
        found = re.findall(r"^(\w+) +(\d+) +([\d.]+) ", process.stdout, re.MULTILINE)
        nodes = int(re.search(r"adapted.msh: (\d+) nodes", process.stdout)[1])
        return nodes, {name: (int(cells), float(area)) for name, cells, area in found}

    def test_nodes_go_where_the_indicator_is_large(self):
        process = self.adapt("--nodes", 1000)
        nodes, regions = self.report(process)
        self.assertTrue(1000 <= nodes < 1030, nodes)
        self.assertIn(
            "by fluid.velocity_error_mean, fluid.pressure_error_mean, wall.displacement_error_mean", process.stdout
        )
        self.assertEqual([area for _, area in regions.values()], [1.43 * 6, 0.26 * 6, 0.13 * 6, round(1.82 * 6, 4)])
        text = (self.base / "adapted.msh").read_text()
        for name in ("inlet", "outlet", "wall_ends", "outer", "fluid", "media", "adventitia"):
            self.assertIn(f'"{name}"', text)
        # Half the nodes of a mesh that was refined everywhere leave no more error, as the indicator has it.
        uniform = self.base / "uniform.msh"
        self.assertEqual(execute(MESH, "refine", "-q", "--times", 2, self.mesh, "-o", uniform).returncode, 0)
        one, other = (
            run(MONOLITHIC, CASE, self.base / mesh.stem, f"mesh.file={mesh}", *self.settings)
            for mesh in (self.base / "adapted.msh", uniform)
        )
        self.assertGreater(summary(other)["mesh"]["nodes"], 2 * nodes)
        for grid, quantity in ((g, q) for g in ("fluid", "wall") for q in ("velocity", "displacement", "pressure")):
            if (grid, quantity) not in (("fluid", "displacement"), ("wall", "velocity")):
                before, adapted, refined = (self.error(folder, grid, quantity) for folder in (self.folder, one, other))
                print(f"{grid}, {quantity}: {before:.3g}, adapted {adapted:.3g}, refined everywhere {refined:.3g}")
                self.assertLess(adapted, 0.4 * before)
                self.assertLess(adapted, 1.25 * refined)

    @staticmethod
    def error(folder, grid, quantity):
        """Root mean square of the indicator over the medium and the run."""
        values = arrays(folder / "fields.h5")
        points, cells = values[f"{grid}/points"], values[f"{grid}/cells"]
        a, b, c = (points[cells[:, i]][:, [0, 2]] for i in range(3))
        area = np.abs(np.cross(b - a, c - a))
        last = sorted(name for name in values if name.startswith(f"{grid}/{quantity}_error_mean/"))[-1]
        return float(np.sqrt((area * values[last] ** 2).sum() / area.sum()))

    def test_what_counts_can_be_chosen(self):
        _, of_wall = self.report(self.adapt("--of", "displacement"))
        _, of_fluid = self.report(self.adapt("--of", "velocity"))
        self.assertGreater(of_wall["media"][0], of_fluid["media"][0])
        self.assertGreater(of_fluid["fluid"][0], of_wall["fluid"][0])

    def test_the_shape_of_a_script_is_meshed_anew(self):
        script, mesh = GALLERY / "stenosis" / "stenosis.geo", self.base / "stenosis.msh"
        made = execute(MESH, "geo", script, "-q", "--order", 2, "--set", "size=0.7", "-o", mesh)
        self.assertEqual(made.returncode, 0, made.stderr)
        case = GALLERY / "stenosis" / "stenosis.toml"
        settings = ("time.end=500", "output.every=10", "output.error_indicator=true")
        folder = run(MONOLITHIC, case, self.base / "stenosis", f"mesh.file={mesh}", *settings)
        nodes, regions = self.report(self.adapt("--geo", script, "--nodes", 3000, mesh=mesh, folder=folder))
        self.assertTrue(2850 <= nodes <= 3150, nodes)
        bounded = self.base / "bounded.geo"  # a least size that suits the first mesh would stop the growth
        bounded.write_text(script.read_text() + "\nMesh.MeshSizeMin = 0.6;\n")
        of_bounded, _ = self.report(self.adapt("--geo", bounded, "--nodes", 3000, mesh=mesh, folder=folder))
        self.assertEqual(of_bounded, nodes)
        self.report(self.adapt("--geo", script, "--nodes", 3000, mesh=mesh, folder=folder))
        again = run(MONOLITHIC, case, self.base / "anew", f"mesh.file={self.base / 'adapted.msh'}", *settings)
        even = self.base / "even.msh"  # of as many nodes, by the script's own size
        self.assertEqual(
            execute(MESH, "geo", script, "-q", "--order", 2, "--set", "size=0.505", "-o", even).returncode, 0
        )
        other = run(MONOLITHIC, case, self.base / "even", f"mesh.file={even}", *settings)
        self.assertGreater(summary(other)["mesh"]["nodes"], 0.95 * nodes)
        for quantity in ("velocity", "pressure"):
            adapted, by_size = (self.error(folder, "fluid", quantity) for folder in (again, other))
            print(f"stenosis, {quantity}: adapted {adapted:.3g}, by the script's size {by_size:.3g}")
            self.assertLess(adapted, 0.8 * by_size)

    def test_what_is_wrong_is_named_and_nothing_is_left(self):
        other = make_mesh(self.base / "other.msh", "--axisymmetric", "--length", 5)
        without = run(MONOLITHIC, CASE, self.base / "without", f"mesh.file={self.mesh}", "time.end=0.125")
        present = {file.name for file in self.base.iterdir()} - {"adapted.msh"}
        for how, options, words in (
            ({"folder": self.base / "none"}, (), "none: is no result folder; give the folder that a run has made"),
            ({"folder": without}, (), "are not among its fields, or zero; run the case with --set output.error"),
            ({"mesh": other}, (), "that the mesh does not have; give the mesh that the run's case names"),
            ({"mesh": self.base / "none.msh"}, (), "none.msh: there is no such mesh file"),
            ({}, ("--nodes", 100), "--nodes: 100 are no more than the mesh has"),
            ({}, ("--of", "vorticity"), "--of"),
            ({}, ("--set", "size=1"), "--set: is of a script's constants; give the script as well: --geo SHAPE.geo"),
            ({}, ("--geo", self.base / "none.geo"), "the mesh lies in the plane y = 0, and no script"),
        ):
            with self.subTest(words=words):
                process = self.adapt(*options, **how, to="new.msh")
                self.assertEqual((process.returncode, len(process.stderr.splitlines())), (1, 1), process.stderr)
                self.assertIn(words, process.stderr)
        self.assertEqual({file.name for file in self.base.iterdir()} - {"adapted.msh"}, present)
        process = attempt(MONOLITHIC, CASE, "--check", settings=("output.error_indicator=true", "output.every=0"))
        self.assertEqual(process.returncode, 1)
        self.assertIn("output.error_indicator: asks for fields, and output.every = 0 writes none", process.stderr)


if __name__ == "__main__":
    unittest.main()
