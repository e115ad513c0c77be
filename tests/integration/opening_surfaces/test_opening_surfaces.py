"""Openings whose surface is none: two disks under one name, a triangle of the side; and cells in the corners of an inlet."""

import csv
import itertools
import unittest

from programs import MESH, MONOLITHIC, FolderTest, attempt, execute

# A T: one end of the stem, and both ends of the bar, 10 mm apart, under one name.
TEE = """
SetFactory("OpenCASCADE");
Box(1) = {0, -1, -1, 6, 2, 2};
Box(2) = {5, -5, -1, 2, 10, 2};
BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Mesh.MeshSizeMin = 2; Mesh.MeshSizeMax = 2;
i() = Surface In BoundingBox{-0.01, -2, -2, 0.01, 2, 2};
a() = Surface In BoundingBox{4, -5.01, -2, 8, -4.99, 2};
b() = Surface In BoundingBox{4, 4.99, -2, 8, 5.01, 2};
Physical Volume("fluid") = Volume{:};
Physical Surface("inlet") = {i()};
Physical Surface("outlet") = {a(), b()};
"""
CASE = """
title = "surfaces of openings"
element = "p2p1"
[mesh]
file = "{mesh}"
[fluid]
density = 1.0
viscosity = 1.0
[[opening]]
surface = "inlet"
{inlet}
[[opening]]
surface = "outlet"
{outlet}
[time]
step = 1.0
end = 1.0
scheme = "euler"
[newton]
tolerance = 1e-11
[output]
every = 0
"""
WINDKESSEL = "windkessel = { proximal = 0.1, compliance = 10.0, distal = 1.0 }"


def duct(side=None):
    """A duct of 2 x 2 x 2 unit cubes, each a tetrahedron about the middle and four that cut off every other corner, as a file of
    gmsh. Where the inlet meets two sides of the duct a tetrahedron has three faces on the outside.
    side: the surface that a triangle of the side x = 0 belongs to, beside the outlet"""
    grid = range(3)
    number = {x: i + 1 for i, x in enumerate(itertools.product(grid, grid, grid))}
    cells = []
    for low in itertools.product((0, 1), repeat=3):
        corners = [tuple(l + s for l, s in zip(low, step)) for step in itertools.product((0, 1), repeat=3)]
        for x in corners:
            if sum(x) % 2 == 0:
                near = [y for y in corners if sum(abs(a - b) for a, b in zip(x, y)) == 1]
                cells.append([x, *near])
        cells.append([x for x in corners if sum(x) % 2 == 1])
    uses = {}
    for cell in cells:
        for face in itertools.combinations(sorted(cell), 3):
            uses[face] = uses.get(face, 0) + 1
    faces = [face for face, count in uses.items() if count == 1]
    groups = {1: [f for f in faces if all(x[2] == 0 for x in f)], 2: [f for f in faces if all(x[2] == 2 for x in f)]}
    if side is not None:
        groups[side].append(
            next(f for f in sorted(faces) if all(x[0] == 0 for x in f) and sum(x[2] == 2 for x in f) == 2)
        )

    def upright(cell):
        a, b, c, d = cell
        u, v, w = ([q - p for p, q in zip(a, x)] for x in (b, c, d))
        volume = sum(w[i] * (u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2]) for i in range(3))
        return cell if volume > 0 else [a, c, b, d]

    elements = [(4, 3, upright(cell)) for cell in cells]
    elements += [(2, tag, face) for tag, of_group in groups.items() for face in of_group]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3", '2 1 "inlet"', '2 2 "outlet"']
    lines += ['3 3 "fluid"', "$EndPhysicalNames", "$Nodes", str(len(number))]
    lines += [f"{n} {x[0]} {x[1]} {x[2]}" for x, n in number.items()]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    for i, (kind, tag, nodes) in enumerate(elements, 1):
        lines.append(f"{i} {kind} 2 {tag} {tag} {' '.join(str(number[x]) for x in nodes)}")
    return "\n".join([*lines, "$EndElements", ""])


class OpeningSurfaces(FolderTest):
    def case(self, mesh, inlet="flow_rate = 1.0", outlet=""):
        file = self.base / "case.toml"
        file.write_text(CASE.format(mesh=mesh, inlet=inlet, outlet=outlet))
        return file

    def checked(self, *what):
        process = attempt(MONOLITHIC, self.case(*what), "--check")
        self.assertEqual(process.returncode, 0, process.stderr)
        return process

    def test_an_opening_in_two_pieces(self):
        (self.base / "tee.geo").write_text(TEE)
        made = execute(MESH, "geo", self.base / "tee.geo", "-o", self.base / "tee.msh", "-q")
        self.assertEqual(made.returncode, 0, made.stderr)
        places = ("is in 2 pieces: 4 mm^2 about (6, ", ", 5, 0) mm", ", -5, 0) mm")
        said = self.checked("tee.msh", "", WINDKESSEL).stderr
        what = "its windkessel takes the flow of all of them, and gives all one pressure"
        for words in (*places, what, "give each opening a surface and an [[opening]] of its own"):
            self.assertIn(words, said)
        # A flow follows the mean normal, which two ends that face each other do not have.
        refused = attempt(MONOLITHIC, self.case("tee.msh", "", "flow_rate = -1.0"), "--check")
        self.assertEqual(refused.returncode, 1, refused.stdout)
        for words in (*places, "has no mean normal", "give each opening a surface and an [[opening]] of its own"):
            self.assertIn(words, refused.stderr.splitlines()[-1])
        # Under a pressure each piece is what it would be alone: a note, no warning.
        process = self.checked("tee.msh", "flow_rate = 1.0", "pressure = 1.0")
        self.assertNotIn("pieces", process.stderr)
        for words in (*places, "tables show the flow and mean pressure of all of them"):
            self.assertIn(words, process.stdout)

    def test_a_triangle_of_the_side(self):
        (self.base / "side.msh").write_text(duct(side=2))
        said = self.checked("side.msh", "pressure = 1.0", "").stderr
        self.assertIn("has 1 of its 9 triangles leaning away from its plane by more than 60 degrees: ", said)
        self.assertIn("mm^2 about (0, ", said)
        self.assertIn("leave out of the group what is no part of the opening", said)
        (self.base / "whole.msh").write_text(duct())
        self.assertNotIn("leaning", self.checked("whole.msh", "pressure = 1.0", "").stderr)

    def test_cells_in_corners_of_an_inlet(self):
        """Refused with their place where the flow is given, divided by fsi-mesh; then what flows in flows out."""
        (self.base / "duct.msh").write_text(duct())
        self.checked("duct.msh", "pressure = 1.0")
        refused = attempt(MONOLITHIC, self.case("duct.msh"), folder=self.base / "refused")
        self.assertEqual(refused.returncode, 1, refused.stdout)
        self.assertEqual(len(refused.stderr.splitlines()), 1, refused.stderr)
        self.assertRegex(refused.stderr, r"duct.msh: pressure at \([02], [02], 0\) mm: has no equation")
        for words in ("--times 0 -o NEW.msh divides", '"p1"'):
            self.assertIn(words, refused.stderr)
        mended = execute(MESH, "refine", self.base / "duct.msh", "--times", 0, "-o", self.base / "mended.msh")
        self.assertEqual(mended.returncode, 0, mended.stderr)
        self.assertIn("8 tetrahedra of the fluid in corners", mended.stdout)
        process = attempt(MONOLITHIC, self.case("mended.msh"), folder=self.base / "run")
        self.assertEqual(process.returncode, 0, process.stderr)
        with (self.base / "run" / "openings.csv").open() as file:
            flows = {row["opening"]: float(row["flow_mm3_per_ms"]) for row in csv.DictReader(file)}
        self.assertAlmostEqual(abs(flows["inlet"]), 1, delta=1e-8)
        self.assertAlmostEqual(flows["inlet"] + flows["outlet"], 0, delta=1e-8)


if __name__ == "__main__":
    unittest.main()
