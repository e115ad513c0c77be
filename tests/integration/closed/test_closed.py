"""Named surfaces of the fluid: each is an opening or closed, and both are said. Fluids without any opening."""

import csv
import re
import unittest

import h5py
import numpy as np
from programs import DRIVERS, MESH, MONOLITHIC, PARTITIONED, FolderTest, attempt, energy, execute, make_mesh, run
from scenes import WALL

FLUID = """element = "p2p1"
geometry = "axisymmetric"
[mesh]
file = "tube.msh"
[fluid]
density = 1.0
viscosity = 3.5e-3
"""
INLET = '[[opening]]\nsurface = "inlet"\npressure = 0.5\n'
TISSUE = '[[support]]\nsurface = "outer"\npressure = [[0, 0], [0.25, 0.05], [1, 0.05]]\n'
TIME = """[time]
step = 0.125
end = 0.5
[newton]
tolerance = 1e-9
[partitioned]
tolerance = 1e-8
[output]
every = 0
"""


class Closed(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_mesh(cls.base / "tube.msh", "--axisymmetric", "--level", "coarse", "--length", 6, "--format", "2.2")
        mesh.write_text(mesh.read_text().replace('"outlet"', '"eca"'))

    def case(self, text):
        file = self.base / "case.toml"
        file.write_text(text + TIME)
        return file

    def log(self, program, text):
        return (run(program, self.case(text), self.base / "out") / "run.log").read_text()

    def refusal(self, program, text):
        folder = self.base / "refused"
        process = attempt(program, self.case(text), folder=folder)
        self.assertEqual(process.returncode, 1, process.stderr)
        self.assertEqual(len(process.stderr.splitlines()), 1, process.stderr)
        self.assertFalse(folder.exists())
        return process.stderr

    def test_a_surface_that_the_case_forgets_is_no_lid(self):
        for program in DRIVERS:
            for wall in ("", WALL):
                said = self.refusal(program, FLUID + wall + INLET)
                # The end of the coarse section: 1.43 mm of radius at z = 6.
                for part in ("case.toml: opening: ", "eca (1.43 mm, about (0.715, 0, 6) mm)", 'closed = ["eca"]'):
                    self.assertIn(part, said)
            said = self.refusal(program, FLUID + WALL + "[inlet]\npressure = 0.5\n")
            self.assertIn("outlet: the physical curve is missing or empty; if eca is meant", said)

    def test_what_is_closed_and_what_is_free_of_traction_is_said(self):
        for program in DRIVERS:
            closed = self.log(program, FLUID + 'closed = ["eca"]\n' + WALL + INLET)
            self.assertIn("closed, the fluid sticks there: eca\n", closed)
            self.assertNotIn("free of traction", closed)
            free = self.log(program, FLUID + WALL + INLET + '[[opening]]\nsurface = "eca"\n')
            self.assertIn("free of traction: eca\n", free)
            self.assertNotIn("closed", free)

    def test_an_outlet_that_the_case_does_not_list_is_said(self):
        mesh = make_mesh(self.base / "free.msh", "--axisymmetric", "--level", "coarse", "--length", 6)
        text = FLUID.replace("tube.msh", mesh.name)
        self.assertIn("free of traction: outlet\n", self.log(MONOLITHIC, text + INLET))
        self.assertIn(
            "closed, the fluid sticks there: outlet\n", self.log(MONOLITHIC, text + "outlet = false\n" + INLET)
        )
        said = self.refusal(MONOLITHIC, text + "outlet = false\n" + INLET + '[[opening]]\nsurface = "outlet"\n')
        self.assertIn("opening.outlet: stands beside fluid.outlet = false; keep one of the two", said)

    def test_names_that_close_nothing(self):
        for names, said in (
            ('["ecb"]', "fluid.closed: the mesh"),
            ('["ecb"]', "did you mean eca? There are inlet, eca, wall_ends or outer"),
            ('["eca", "wall_ends"]', 'fluid.closed: "wall_ends" is no surface of the fluid alone'),
        ):
            self.assertIn(said, self.refusal(MONOLITHIC, FLUID + f"closed = {names}\n" + WALL + INLET))

    def test_a_fluid_without_openings(self):
        """Pressed by tissue from all sides it cannot yield: its pressure is that of the tissue, 50 Pa from 0.25 ms on."""
        points = "[output.points]\nmiddle = [0.5, 0, 3]\n"
        found = []
        for program in DRIVERS:
            text = self.log(program, FLUID + 'closed = ["inlet", "eca"]\n' + WALL + TISSUE + points)
            self.assertIn("closed, the fluid sticks there: inlet, eca\n", text)
            self.assertIn("the fluid is enclosed, and nothing but the velocities of each step keeps its volume", text)
            for part in ("+1.3 % with midpoint", "+0.14 % with tr-bdf2", "docs/theory.md, section 8.12"):
                self.assertIn(part, text)
            found.append(energy(self.base / "out")["wall_volumetric_energy"])
            with (self.base / "out" / "points.csv").open() as file:
                (row,) = (row for row in csv.DictReader(file) if float(row["time_ms"]) == 0.375)
            self.assertAlmostEqual(float(row["pressure_Pa"]), 50, delta=0.1)
        np.testing.assert_allclose(*found, atol=1e-5 * np.abs(found[0]).max())

    def test_a_fluid_without_openings_that_no_wall_moves(self):
        said = self.refusal(MONOLITHIC, FLUID + 'closed = ["inlet", "eca"]\n')
        self.assertIn("fluid.closed: a closed fluid between rigid walls: nothing can move it", said)
        said = self.refusal(MONOLITHIC, FLUID + WALL)
        self.assertIn("no [inlet]; add [inlet] with pressure", said)
        self.assertIn("closed = [...] in [fluid]", said)
        scheme = FLUID + 'closed = ["inlet", "eca"]\n' + WALL + TISSUE
        process = attempt(
            PARTITIONED, self.case(scheme), folder=self.base / "no", settings=('partitioned.scheme="iqn-ils"',)
        )
        self.assertEqual(process.returncode, 1)
        self.assertIn("its pressure is not determined", process.stderr)

    def test_a_volume_that_the_case_leaves_out(self):
        """The outer layer: a warning. The inner one, on which the wall's ends are: the remedy names it."""
        text = FLUID + 'closed = ["eca"]\n' + WALL.split("[structure.layers.adventitia]")[0] + INLET
        process = attempt(MONOLITHIC, self.case(text), "-q", folder=self.base / "left")
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertIn("adventitia: left out, since no section of [structure.layers] has the name", process.stderr)

    def test_ends_of_another_name(self):
        mesh = self.base / "ends.msh"
        mesh.write_text((self.base / "tube.msh").read_text().replace('"wall_ends"', '"ends"'))
        for geometry in ("", "[mesh_motion]\n"):
            said = self.refusal(
                MONOLITHIC, FLUID.replace("tube.msh", mesh.name) + 'closed = ["eca"]\n' + WALL + INLET + geometry
            )
            self.assertIn('rename it, or add [[support]] with surface = "ends" and fixed = ["r", "z"]', said)


RING_GEO = """Point(1) = {0, 0, 0};
Point(2) = {1.43, 0, 0};
Point(3) = {0, 1.43, 0};
Point(4) = {1.82, 0, 0};
Point(5) = {0, 1.82, 0};
Line(1) = {1, 2};
Line(2) = {2, 4};
Circle(3) = {2, 1, 3};
Circle(4) = {4, 1, 5};
Line(5) = {3, 1};
Line(6) = {5, 3};
Curve Loop(1) = {1, 3, 5};
Curve Loop(2) = {2, 4, 6, -3};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Mesh.MeshSizeMin = 0.3;
Mesh.MeshSizeMax = 0.3;
Physical Surface("fluid") = {1};
Physical Surface("wall") = {2};
Physical Curve("outer") = {4};
Physical Curve("symmetry_y") = {1, 2};
Physical Curve("symmetry_x") = {5, 6};
"""
RING = """element = "p2p1"
geometry = "plane"
[mesh]
file = "ring.msh"
[fluid]
density = 1.0
viscosity = 1e-4
closed = []
[structure]
density = 1.2
bulk_modulus = 1e4
[structure.layers.wall]
material = "neo-hookean"
c10 = 30.0
[[support]]
surface = "outer"
traction = [[0, 0, 0], [0.5, 1.2, -1.2], [1, 0, 0]]
[time]
step = 0.05
end = 3.0
[newton]
tolerance = 1e-10
[output]
fields = ["displacement"]
every = 1
"""
EDGES = ((0, 1, 3), (1, 2, 4), (2, 0, 5))  # of a quadratic triangle: both ends and the middle


class EnclosedVolume(FolderTest):
    """A quarter of a ring around its fluid, pushed to an oval by 0.6 mm. Continuity holds at x_n + theta dt v, so that in the plane
    each step changes the volume by -(2 theta - 1) dt^2 A(v) exactly (docs/theory.md, section 8.12)."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.base / "ring.geo").write_text(RING_GEO)
        made = execute(MESH, "geo", cls.base / "ring.geo", "--order", 2, "-o", cls.base / "ring.msh")
        assert made.returncode == 0, made.stderr
        (cls.base / "ring.toml").write_text(RING)

    def boundary(self, folder):
        """Nodes of the fluid's boundary at all levels, (levels, edges, 3, 2): both ends and the middle of each edge."""
        with h5py.File(folder / "fields.h5") as file:
            fluid = file["fluid"]
            cells, points, moved = fluid["cells"][()], fluid["points"][()], fluid["displacement"]
            levels = [points + moved[name][()] for name in sorted(moved)]
        used = {}
        for cell in cells:
            for edge in EDGES:
                nodes = [cell[i] for i in edge]
                used.setdefault(frozenset(nodes[:2]), []).append(nodes)
        outside = np.array([edges[0] for edges in used.values() if len(edges) == 1])
        return np.array([level[outside][:, :, :2] for level in levels])

    def half_cross(self, x, y):
        """1/2 of the integral of x dy around the boundary, of curves with these nodes."""
        found = 0.0
        for s, weight in zip(*np.polynomial.legendre.leggauss(3)):  # exact: of degree three
            shape, slope = (s * (s - 1) / 2, s * (s + 1) / 2, 1 - s * s), (s - 0.5, s + 0.5, -2 * s)
            a, b = (np.einsum("i,eic->ec", of, nodes) for of, nodes in ((shape, x), (slope, y)))
            found += weight * np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
        return found / 2

    def changes(self, name, *settings):
        """By step, relative to the volume at first: of the volume, and A(v) dt^2; theta."""
        folder = run(MONOLITHIC, self.base / "ring.toml", self.base / name, *settings)
        x = self.boundary(folder)
        volumes = np.array([self.half_cross(level, level) for level in x])
        areas = np.array([self.half_cross(v, v) for v in np.diff(x, axis=0)])
        found = re.search(r"theta = [\d.]+: 1/2 \+ ([\d.e-]+)/ms times the step", (folder / "run.log").read_text())
        return (
            np.diff(volumes) / volumes[0],
            areas / volumes[0],
            None if found is None else 0.5 + 0.05 * float(found[1]),
        )

    def test_it_changes_by_what_theory_says(self):
        changed, areas, _ = self.changes("euler", "time.scheme=euler")  # theta = 1
        self.assertGreater(changed.sum(), 0.005)
        np.testing.assert_allclose(changed, -areas, atol=1e-10)
        changed, areas, theta = self.changes("midpoint", "time.scheme=midpoint")
        self.assertGreater(changed.sum(), 5e-4)
        np.testing.assert_allclose(changed.sum(), -(2 * theta - 1) * areas.sum(), rtol=1e-3)  # the log's digits

    def test_it_stays_without_damping(self):
        changed, areas, _ = self.changes("undamped", "time.scheme=midpoint", "time.damping=0")
        self.assertLess(np.abs(changed).max(), 1e-10)
        self.assertGreater(np.abs(areas).sum(), 0.005)  # it has swung


if __name__ == "__main__":
    unittest.main()
