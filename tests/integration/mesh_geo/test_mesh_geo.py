"""fsi-mesh geo: meshes of shapes that gmsh scripts describe."""

import re
import unittest

from programs import MESH, FolderTest, execute

SQUARE = """
DefineConstant[ size = 0.5 ];
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 1};
Disk(2) = {3.5, 0.5, 0, 0.5};
Mesh.MeshSizeMax = size;
Physical Surface("fluid") = {1};
Physical Surface("media") = {2};
Physical Curve("inlet") = {4};
Physical Curve("outlet") = {2};
Physical Curve("outer") = {5};
"""
TUBE = """
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 3, 1};
Mesh.MeshSizeMax = 0.7;
Physical Volume("fluid") = {1};
Physical Surface("inlet") = {3};
Physical Surface("outlet") = {2};
"""


# A square duct of prisms that gmsh cuts: in one corner of the inlet a tetrahedron has three faces on the outside.
DUCT = """
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1:4} = 3; Transfinite Surface{1};
e[] = Extrude{0, 0, 2}{ Surface{1}; Layers{3}; };
Physical Volume("fluid") = {e[1]}; Physical Surface("inlet") = {1}; Physical Surface("outlet") = {e[0]};
"""


class MeshGeo(FolderTest):
    def make(self, script, *options):
        file = self.base / "shape.geo"
        file.write_text(script)
        return execute(MESH, "geo", file, "-o", self.base / "shape.msh", *options)

    def rows(self, process):
        """Cells and volume by region, as the report says."""
        self.assertEqual(process.returncode, 0, process.stderr)
        found = re.findall(r"^(\w+) +(\d+) +([\d.]+) ", process.stdout, re.MULTILINE)
        return {name: (int(cells), float(volume)) for name, cells, volume in found}

    def test_quadratic_cells_lie_on_the_shape(self):
        straight = self.rows(self.make(SQUARE))
        curved = self.rows(self.make(SQUARE, "--order", 2))
        self.assertEqual(curved["fluid"][1], 2)
        disk = 3.14159265 / 4
        self.assertLess(abs(curved["media"][1] - disk), 1e-3)
        self.assertGreater(abs(straight["media"][1] - disk), 2e-2)

    def test_volumes_and_their_surfaces(self):
        process = self.make(TUBE, "--format", "2.2")
        self.assertIn("tetrahedra", process.stdout)
        self.assertLess(abs(self.rows(process)["fluid"][1] / (3 * 3.14159265) - 1), 0.1)
        text = (self.base / "shape.msh").read_text()
        for name in ('2 1 "inlet"', '2 2 "outlet"', '"fluid"'):
            self.assertIn(name, text)

    def test_cells_across_are_reported_whether_the_wall_has_a_name(self):
        said = [
            re.search(r"^The lumen, .* cells across", self.make(script).stdout, re.MULTILINE)
            for script in (TUBE, TUBE + 'Physical Surface("wall") = {1};')
        ]
        self.assertTrue(all(said))
        self.assertEqual(said[0].group(), said[1].group())

    def test_cells_in_corners_are_divided(self):
        """Their pressure would have no equation with Taylor-Hood; each is cut in four, and the volume stays."""
        for order, nodes in ((1, 3 * 3 * 4 + 1), (2, 5 * 5 * 7 + 5)):
            process = self.make(DUCT, "--order", order)
            self.assertEqual(self.rows(process)["fluid"][1], 2)
            self.assertRegex(process.stdout, r"^1 tetrahedron of the fluid in corners, at \(.*\) mm: divided in 4")
            # 24 prisms, each cut in three; then a vertex and three cells more, of second order four more middles of edges.
            self.assertEqual(self.rows(process)["fluid"][0], 3 * 24 + 3)
            self.assertIn(f"{nodes} nodes", process.stdout)

    def test_a_constant_gets_another_value(self):
        few, many = self.rows(self.make(SQUARE)), self.rows(self.make(SQUARE, "--set", "size=0.2"))
        self.assertGreater(many["fluid"][0], 3 * few["fluid"][0])

    def test_the_same_script_gives_the_same_bytes(self):
        self.rows(self.make(TUBE, "--binary"))
        first = (self.base / "shape.msh").read_bytes()
        self.rows(self.make(TUBE, "--binary"))
        self.assertEqual(first, (self.base / "shape.msh").read_bytes())

    def test_what_is_wrong_is_named_and_nothing_is_left(self):
        for script, options, words in (
            (SQUARE, ("--set", "sze=0.2"), ("shape.geo: sze: is no constant", "DefineConstant[ sze")),
            (SQUARE, ("--set", "size"), ("size: is no name=number", "--set size=0.2")),
            (SQUARE, ("--set", "size=big"), ("is no name=number",)),
            (SQUARE, ("--order", "3"), ("--order",)),
            ("Rectangle(1 = {", (), ("shape.geo: gmsh says:",)),
            ('SetFactory("OpenCASCADE"); Disk(1) = {0, 0, 0, 1};', (), ("names no physical volume",)),
        ):
            with self.subTest(options=options, script=script[:20]):
                (self.base / "shape.msh").unlink(missing_ok=True)
                process = self.make(script, *options)
                self.assertEqual(process.returncode, 1, process.stdout)
                self.assertEqual(len(process.stderr.splitlines()), 1, process.stderr)
                for word in words:
                    self.assertIn(word, process.stderr)
                self.assertEqual([f.name for f in self.base.iterdir() if "msh" in f.name], [])


if __name__ == "__main__":
    unittest.main()
