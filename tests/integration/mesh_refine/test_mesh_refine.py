"""fsi-mesh refine: halves the cells of a mesh file, of any kind that the programs read."""

import re
import resource
import unittest

from programs import CASES, MESH, MONOLITHIC, NEO_HOOKEAN, FolderTest, attempt, execute, make_mesh, run, summary

# With a curve that no program knows.
SQUARE = """
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 1};
Disk(2) = {3.5, 0.5, 0, 0.5};
Mesh.MeshSizeMax = 0.5;
Physical Surface("fluid") = {1};
Physical Surface("media") = {2};
Physical Curve("inlet") = {4};
Physical Curve("a mark") = {2};
Physical Curve("outer") = {5};
"""
CUBE = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 1 "fluid"
$EndPhysicalNames
$Nodes
8
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
$EndNodes
$Elements
1
1 5 2 1 1 1 2 3 4 5 6 7 8
$EndElements
"""
# Of the mark one line is a side of a triangle; the other one crosses both triangles.
CROSSED = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "mark"
2 2 "fluid"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
4
1 1 2 1 1 1 2
2 1 2 1 1 2 4
3 2 2 2 1 1 2 3
4 2 2 2 1 1 3 4
$EndElements
"""


class MeshRefine(FolderTest):
    def refine(self, mesh, *options, to="fine.msh"):
        return execute(MESH, "refine", mesh, "-o", self.base / to, *options)

    def report(self, process):
        """Cells and measure by region, as the report says."""
        self.assertEqual(process.returncode, 0, process.stderr)
        found = re.findall(r"^(\w+) +(\d+) +([\d.]+) ", process.stdout, re.MULTILINE)
        return {name: (int(cells), float(measure)) for name, cells, measure in found}

    def test_elements_of_surfaces_that_are_left_out_are_named(self):
        (self.base / "crossed.msh").write_text(CROSSED)
        process = self.refine(self.base / "crossed.msh")
        self.assertEqual(self.report(process)["fluid"][0], 8)
        self.assertRegex(
            process.stderr,
            r"\Afsi-mesh: warning: .*: mark: element 2 \(lines\) is no facet of a triangle and left out\n\Z",
        )

    def square(self, *options):
        script, mesh = self.base / "square.geo", self.base / "square.msh"
        script.write_text(SQUARE)
        self.report(execute(MESH, "geo", script, "-o", mesh, "--format", "2.2", *options))
        return mesh

    @staticmethod
    def number_otherwise(mesh):
        """Gives the physical groups of a file of version 2.2 tags that nobody would choose by himself."""
        head, names, nodes, elements, end = re.split(
            r"(?<=\$EndMeshFormat\n)|(?=\$Nodes)|(?=\$Elements)|(?=\$EndElements)", mesh.read_text()
        )
        names = re.sub(r"^(\d) (\d+) ", lambda m: f"{m[1]} {100 - 7 * int(m[2])} ", names, flags=re.MULTILINE)
        elements = re.sub(
            r"^(\d+ \d+ 2) (\d+) ", lambda m: f"{m[1]} {100 - 7 * int(m[2])} ", elements, flags=re.MULTILINE
        )
        mesh.write_text(head + names + nodes + elements + end)

    @staticmethod
    def names(file):
        return re.findall(r'^(\d) (\d+) "(.*)"$', file.read_text(), re.MULTILINE)

    def test_groups_keep_names_and_tags_in_both_formats_and_orders(self):
        for order in (1, 2):
            with self.subTest(order=order):
                mesh = self.square("--order", order)
                self.number_otherwise(mesh)
                names = sorted(self.names(mesh))
                self.assertIn(("2", "65", "media"), names)
                process = self.refine(mesh)
                report = self.report(process)
                self.assertIn("Each cell cut in 4: the smallest eta is", process.stdout)
                self.assertEqual("quadratic" in process.stdout, order == 2)
                self.assertEqual(report["fluid"][1], 2)
                self.assertIn("square.geo lies beside it: fsi-mesh geo", process.stdout)
                self.assertEqual(sorted(self.names(self.base / "fine.msh")), names)
                again = self.report(self.refine(self.base / "fine.msh", "--format", "2.2", to="finer.msh"))
                self.assertEqual(again["fluid"], (4 * report["fluid"][0], 2))
                self.assertEqual(sorted(self.names(self.base / "finer.msh")), names)

    def test_curved_edges_stay_where_the_file_has_them(self):
        mesh = self.square("--order", 2)
        once, thrice = (self.report(self.refine(mesh, "--times", times)) for times in (1, 3))
        self.assertEqual(once["media"][1], thrice["media"][1])
        self.assertLess(abs(thrice["media"][1] - 3.14159265 / 4), 1e-3)  # within the file's own error

    def test_the_same_mesh_gives_the_same_bytes_and_may_replace_itself(self):
        mesh = self.square()
        self.report(self.refine(mesh))
        first = (self.base / "fine.msh").read_bytes()
        self.report(self.refine(mesh, to="square.msh"))
        self.assertEqual(first, mesh.read_bytes())

    def test_a_driver_takes_what_was_refined(self):
        coarse = make_mesh(self.base / "coarse.msh", "--level", "coarse", "--length", 6)
        nodes = int(re.search(r"fine.msh: (\d+) nodes", self.refine(coarse).stdout)[1])
        check = attempt(MONOLITHIC, NEO_HOOKEAN, "--check", settings=(f"mesh.file={self.base / 'fine.msh'}",))
        self.assertEqual(check.returncode, 0, check.stderr)
        self.assertIn(f"{nodes} nodes", check.stdout.replace(",", ""))

    def test_a_section_keeps_its_plane_and_runs(self):
        coarse = make_mesh(self.base / "section.msh", "--axisymmetric", "--order", 2, "--length", 3)
        report = self.report(self.refine(coarse))
        folder = run(
            MONOLITHIC,
            CASES / "axisymmetric" / "neo-hookean.toml",
            self.base / "run",
            f"mesh.file={self.base / 'fine.msh'}",
            "time.end=0.125",
        )
        self.assertEqual(summary(folder)["mesh"]["triangles"], report["all"][0])

    def test_what_is_wrong_is_named_and_nothing_is_left(self):
        mesh = make_mesh(self.base / "tube.msh", "--axisymmetric", "--length", 3)
        (self.base / "cube.msh").write_text(CUBE)
        (self.base / "nameless.msh").write_text(re.sub(r"\$Phys.*Names\n(?=\$Nodes)", "", CUBE, flags=re.DOTALL))
        (self.base / "text.msh").write_text("no mesh\n")
        (self.base / "shape.geo").write_text(SQUARE)
        present = {file.name for file in self.base.iterdir()}
        for file, options, words in (
            ("none.msh", (), ("none.msh: there is no such mesh file",)),
            ("text.msh", (), ("text.msh: $MeshFormat: is not a gmsh .msh file",)),
            ("cube.msh", (), ("cube.msh: fluid: element 1", "hexahedra", "mesh with tetrahedra only")),
            ("nameless.msh", (), ("nameless.msh: $PhysicalNames: the file names no physical",)),
            ("shape.geo", (), ("shape.geo: is a script, no mesh", "fsi-mesh geo", "--set NAME=SIZE")),
            ("tube.msh", ("--times", -1), ("--times",)),
            ("tube.msh", ("--times", 10, "--order", 2), ("--order",)),
        ):
            with self.subTest(file=file, options=options):
                process = self.refine(self.base / file, *options, to="new.msh")
                self.assertEqual(process.returncode, 1, process.stdout)
                self.assertEqual(len(process.stderr.splitlines()), 1, process.stderr)
                for word in words:
                    self.assertIn(word, process.stderr)
        for to, words in (("none/new.msh", "there is no folder"), ("new.vtu", "the extension .vtu is unknown")):
            process = self.refine(mesh, to=to)
            self.assertEqual((process.returncode, len(process.stderr.splitlines())), (1, 1), process.stderr)
            self.assertIn(words, process.stderr)
        self.assertEqual({file.name for file in self.base.iterdir()}, present)

    def test_a_mesh_that_is_too_large_is_refused_before_it_is_begun(self):
        mesh = make_mesh(self.base / "tube.msh", "--level", "coarse", "--length", 6)
        room = 4 << 30
        for times, words in ((5, "out of memory (making the mesh): a mesh of"), (9, "more than can be numbered")):
            process = execute(
                *(MESH, "refine", mesh, "-o", self.base / "fine.msh", "--times", times),
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (room, room)),
            )
            self.assertEqual((process.returncode, len(process.stderr.splitlines())), (1, 1), process.stderr)
            self.assertIn(words, process.stderr)
            self.assertIn("; refine less often", process.stderr)


if __name__ == "__main__":
    unittest.main()
