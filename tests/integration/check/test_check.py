"""--check says what a run would be, of each kind of scene and by both drivers, and writes nothing."""

import os
import re
import unittest

from programs import DRIVERS, MONOLITHIC, PARTITIONED, FolderTest, attempt, execute, make_mesh, run
from scenes import FLUID, WALL, scene

OPENINGS = """[[opening]]
surface = "inlet"
flow_rate = [[0, 0], [1, 0.5]]
[[opening]]
surface = "outlet"
windkessel = { proximal = 0.1, compliance = 5.0, distal = 2.0 }
"""
TISSUE = """[[support]]
surface = "outer"
normal_spring = 2.0
"""
TIME = "[time]\nstep = 0.125\nend = 2.5\n"
AT_REST = OPENINGS.replace("distal = 2.0", "distal = 2.0, initial_pressure = 0.1, distal_pressure = 0.1")
SAMPLES = "[output.points]\nmiddle = [0, 0, 1.5]\n[output.planes.cut]\norigin = [0, 0, 1.5]\nnormal = [0, 0, 1]\n"


class Check(FolderTest):
    def check(self, program, text, *options, element="p2p1", geometry="axisymmetric", code=0, mesh=None):
        """What it prints, by heads. Nothing but the case and its mesh is there before and afterwards."""
        settings = [*scene(self.base, element, geometry), *([f"mesh.file={mesh}"] if mesh else [])]
        case = self.base / "case.toml"
        case.write_text(f'title = "a vessel"\n[mesh]\nfile = "x.msh"\n{text}')
        before = {file: os.stat(file).st_mtime_ns for file in self.base.rglob("*")}
        process = attempt(program, case, "--check", *options, settings=settings)
        self.assertEqual(process.returncode, code, process.stderr)
        self.assertEqual({file: os.stat(file).st_mtime_ns for file in self.base.rglob("*")}, before)
        if code != 0:
            self.assertEqual(process.stdout, "")
            return process.stderr
        self.assertEqual(process.stderr, "")
        return dict(re.split(r"  +", line, maxsplit=1) for line in process.stdout.splitlines())

    def test_fluid_and_wall(self):
        for program in DRIVERS:
            for element, geometry in (("p2p1", "axisymmetric"), ("p1", "3d")):
                with self.subTest(program=program, element=element):
                    said = self.check(
                        program, FLUID + WALL + OPENINGS + TISSUE + TIME + SAMPLES, element=element, geometry=geometry
                    )
                    expected = {
                        "fluid": "density 1 mg/mm^3, viscosity 0.0035 kPa ms",
                        "wall": "density 1.2 mg/mm^3, bulk modulus 100000 kPa",
                        "opening inlet": "flow into the fluid of 0 to 0.5 mm^3/ms by a table of 2 rows from 0 to 1 ms, "
                        "parabolic profile",
                        "opening outlet": "Windkessel: proximal 0.1, distal 2 kPa ms/mm^3, compliance 5 mm^3/kPa, "
                        "from 0 kPa",
                        "support wall_ends": "clamped",
                        "support outer": "normal spring 2 kPa/mm",
                        "point middle": "[0, 0, 1.5] mm in the fluid",
                        "plane cut": "through [0, 0, 1.5] mm",
                        "steps": "20 steps of 0.125 ms to 2.5 ms, midpoint",
                    }
                    self.assertEqual({head: said.get(head) for head in expected}, expected)
                    self.assertIn("neo-hookean, c10 = 3 kPa; ", said["layer media"])
                    unknowns = [int(number) for number in re.findall(r"\d+", said["unknowns"])]
                    self.assertEqual(unknowns[0], sum(unknowns[1:4]))
                    self.assertGreater(min(unknowns), 0)
                    self.assertRegex(said["memory"], r"^about \d.* MiB")
                    self.assertRegex(said["first step"], r"\d+ Newton, \d+ linear iterations, .* s$")
                    self.assertRegex(said["run"], r"^about \d+ .* all 20 steps")
                    if program == PARTITIONED:
                        self.assertTrue(
                            said["partitioned.scheme"].startswith("robin-neumann-inexact: the case names none")
                        )
                        self.assertRegex(said["first step"], r"^\d+ coupling, ")
                    else:
                        self.assertNotIn("partitioned.scheme", said)

    def test_media_alone(self):
        alone = "[load]\npressure = 0.1\n[static]\nload_steps = 4\n"
        for program in DRIVERS:
            with self.subTest(program=program):
                fluid = self.check(program, FLUID + OPENINGS + TIME)
                self.assertNotIn("wall", fluid)
                self.assertIn(" fluid, 0 wall, 0 mesh motion; 0 nodes", fluid["unknowns"])
                self.assertNotIn("partitioned.scheme", fluid)
                wall = self.check(program, WALL + alone)
                self.assertNotIn("fluid", wall)
                self.assertIn(", alone", wall["wall"])
                self.assertEqual(wall["load"], "pressure 0.1 kPa on the inner face")
                self.assertEqual(wall["steps"], "4 steps of the load, at rest")
                self.assertIn("all 4 steps", wall["run"])

    def test_prestress(self):
        """Of a small wall it is found, as a run does before its first step; a kept one is read."""
        text = FLUID + WALL + AT_REST + TIME
        prestress = "[prestress]\npressure = 0.1\n"
        for program in DRIVERS:
            with self.subTest(program=program):
                self.assertEqual(self.check(program, text + prestress, "-q")["prestress"], "0.1 kPa, found")
                case = self.base / "case.toml"
                folder = run(
                    program, case, self.base / "run", *scene(self.base, "p2p1", "axisymmetric"), "time.end=0.125"
                )
                kept = self.check(program, text + f'{prestress}file = "run/prestress.h5"\n')
                self.assertEqual(kept["prestress"], f"0.1 kPa, from {folder}/prestress.h5")
                self.assertIn("first step", kept)

    def test_a_prestress_that_takes_long_is_not_sought(self):
        """Nor is a step tried then: it would be that of another wall. 47,000 unknowns of the wall."""
        size = ("--lumen-cells", 4, "--media-cells", 2, "--adventitia-cells", 2, "--axial-cells", 18, "--around", 24)
        mesh = make_mesh(self.base / "fine.msh", "--length", 6, *size, "--order", 2)
        text = FLUID + WALL + AT_REST + TIME + "[prestress]\npressure = 0.1\n"
        for program in DRIVERS:
            with self.subTest(program=program):
                said = self.check(program, text, geometry="3d", mesh=mesh)
                self.assertTrue(said["prestress"].startswith("0.1 kPa, will be found"), said["prestress"])
                for head in ("memory", "first step", "run"):
                    self.assertNotIn(head, said)

    def test_a_step_without_solution(self):
        blown = WALL + "[load]\npressure = 50\n[static]\nload_steps = 1\n"
        said = self.check(MONOLITHIC, blown)
        self.assertRegex(said["step tried"], r"finds no solution: load step \d \(to 0\.0\d* of the load\)", "halved")
        self.assertNotIn("run", said)

    def test_what_a_run_refuses(self):
        coupled = FLUID + WALL + OPENINGS + TIME
        for program in DRIVERS:
            for text, part in (
                (coupled.replace('"inlet"', '"inlte"'), "inlte"),
                (coupled.replace("step = 0.125", "step = 1e-30"), "time.step"),
                (coupled.replace("layers.media", "layers.intima"), "no such volume"),
            ):
                with self.subTest(program=program, part=part):
                    self.assertIn(part, self.check(program, text, code=1))
            said = self.check(program, coupled, "--restart", self.base / "none", code=1)
            self.assertIn("--check", said)

    def test_help_has_it(self):
        for program in DRIVERS:
            self.assertIn("--check", execute(program, "--help").stdout)


if __name__ == "__main__":
    unittest.main()
