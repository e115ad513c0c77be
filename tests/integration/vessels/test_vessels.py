"""Vessels that users mesh themselves with gmsh: a bent tube with a wall of two layers, a bifurcation. Both drivers run
them and agree; points, lines and planes are sampled where the case asks for them, and what lies outside is left out."""

import csv
import os
import unittest
from pathlib import Path

import numpy as np
from programs import DRIVERS, MONOLITHIC, FolderTest, attempt, execute, make_mesh, restart, run, table
from scenes import scaled

HERE = Path(__file__).parent
BENT, BIFURCATION = HERE / "bent.toml", HERE / "bifurcation.toml"
RIGID = HERE.parent / "rigid_pipe" / "rigid_pipe.toml"
BEND, RADIUS = 5.0, 1.0  # mm, of the bent tube's axis and of its lumen
SAMPLES = (
    "output.points.lumen=[0, 0, 1]",
    "output.points.wall=[-1.15, 0, 0.5]",
    "output.points.outside=[9, 9, 9]",
    "output.lines.across.from=[-2, 0, 0.5]",
    "output.lines.across.to=[1, 0, 0.5]",
    "output.lines.across.points=13",
    "output.planes.start.origin=[0, 0, 1.5]",
    "output.planes.start.normal=[0, 0, 1]",
    "output.planes.missed.origin=[0, 0, 40]",
    "output.planes.missed.normal=[0, 0, 1]",
)


def vessel(kind, file, *order):
    process = execute(os.environ["FSI_VESSEL_MESH"], kind, file, *order)
    if process.returncode != 0:
        raise AssertionError(process.stderr)
    return file


def rows(folder, name):
    """The rows of a table of samples as dictionaries; empty cells are None."""
    with (Path(folder) / name).open() as file:
        return [
            {
                key: (float(cell) if cell else None) if key not in ("point", "line", "plane", "opening") else cell
                for key, cell in row.items()
            }
            for row in csv.DictReader(file)
        ]


def differences(one, other):
    """Of all numbers of the same tables, relative to the largest of their column."""
    largest = {}
    for a, b in zip(one, other):
        for key, value in a.items():
            if isinstance(value, float):
                apart, size = largest.get(key, (0.0, 0.0))
                largest[key] = (max(apart, abs(value - b[key])), max(size, abs(value)))
    return {key: apart / size for key, (apart, size) in largest.items() if size > 0}


def files_of(folder):
    return sorted(file.name for file in Path(folder).iterdir())


class Bent(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = f"mesh.file={vessel('bent', cls.base / 'bent.msh')}"
        cls.runs, cls.said = [], []
        for program in DRIVERS:
            folder = cls.base / Path(program).name
            process = attempt(program, BENT, "-q", folder=folder, settings=(cls.mesh, *SAMPLES))
            assert process.returncode == 0, process.stderr
            cls.runs.append(folder)
            cls.said.append(process.stderr)

    def test_has_no_tables_of_straight_tubes(self):
        files = files_of(self.runs[0])
        self.assertNotIn("centerline_pressure.csv", files)
        self.assertNotIn("wall_displacement.csv", files)
        for name in ("flow.csv", "lines.csv", "points.csv", "planes.csv"):
            self.assertIn(name, files)

    def test_drivers_agree(self):
        for name in ("lines.csv", "points.csv", "planes.csv"):
            one, other = (rows(folder, name) for folder in self.runs)
            self.assertEqual(len(one), len(other))
            for key, apart in differences(one, other).items():
                self.assertLess(apart, 1e-5, (name, key))

    def test_centre_line_is_the_circle(self):
        line = [row for row in rows(self.runs[0], "lines.csv") if row["line"] == "centerline"]
        self.assertEqual(len(line), 3 * 181)
        for row in line[:181]:
            angle = row["s_mm"] / BEND
            at = np.array([row[f"{axis}_mm"] for axis in "xyz"])
            circle = np.array([BEND * (1 - np.cos(angle)), 0, BEND * np.sin(angle)])
            self.assertLess(np.linalg.norm(at - circle), 0.08)
        self.assertAlmostEqual(line[180]["s_mm"], BEND * np.pi / 2, delta=0.05)
        # The pulse enters at s = 0 and has not come to the other end.
        first = [row["pressure_Pa"] for row in line[:181]]
        self.assertGreater(first[0], 400)
        self.assertLess(abs(first[-1]), 5)

    def test_samples_have_what_exists_there(self):
        points = {row["point"]: row for row in rows(self.runs[0], "points.csv")}
        self.assertEqual(set(points), {"lumen", "wall"})
        self.assertIsNone(points["wall"]["velocity_x_mm_per_ms"])
        self.assertLess(points["wall"]["displacement_x_mm"], 0)  # the wall widens
        self.assertIsNotNone(points["lumen"]["velocity_z_mm_per_ms"])
        across = [row for row in rows(self.runs[0], "lines.csv") if row["line"] == "across"]
        self.assertEqual(len(across), 3 * 11)  # its first two points lie outside the wall
        flowing = [row["s_mm"] for row in across[:10] if row["velocity_z_mm_per_ms"] is not None]
        np.testing.assert_allclose(flowing, np.arange(1.25, 3, 0.25))

    def test_what_lies_outside_is_said_once(self):
        for said, folder in zip(self.said, self.runs):
            log = (folder / "run.log").read_text()
            for text in (
                "output.points.outside: (9, 9, 9) lies outside the mesh and is left out",
                "output.lines.across: 2 of 13 points lie outside the mesh and are left out, the first at (-2, 0, 0.5)",
                "output.planes.missed: the plane through (0, 0, 40) cuts no fluid and is left out",
            ):
                self.assertEqual(said.count(text), 1, said)
                self.assertEqual(log.count(text), 1)

    def test_restart_has_the_same_tables(self):
        folder = run(MONOLITHIC, BENT, self.base / "restarted", self.mesh, *SAMPLES, "time.end=0.125")
        restart(MONOLITHIC, BENT, folder, self.mesh, *SAMPLES)
        for name in ("lines.csv", "points.csv", "planes.csv"):
            self.assertEqual((folder / name).read_bytes(), (self.runs[0] / name).read_bytes(), name)
        # Samples elsewhere do not belong into the same table.
        moved = [setting.replace("lumen=[0, 0, 1]", "lumen=[0, 0, 1.25]") for setting in SAMPLES]
        process = attempt(
            MONOLITHIC, BENT, "-q", "--restart", folder, folder=folder, settings=(self.mesh, *moved, "time.end=0.5")
        )
        self.assertEqual(process.returncode, 1)
        self.assertIn("points.csv: line 2: is of 'lumen,0,0,1', not of 'lumen,0,0,1.25'", process.stderr)

    def test_quadratic_cells(self):
        mesh = f"mesh.file={vessel('bent', self.base / 'bent2.msh', 2)}"
        folder = run(MONOLITHIC, BENT, self.base / "quadratic", mesh, "element=p2p1", "time.end=0.125", *SAMPLES)
        plane = rows(folder, "planes.csv")[0]
        self.assertAlmostEqual(plane["area_mm2"], 3.36, delta=0.1)  # oblique where the tube has begun to bend
        line = [row for row in rows(folder, "lines.csv") if row["line"] == "centerline"]
        self.assertAlmostEqual(line[-1]["s_mm"], BEND * np.pi / 2, delta=0.02)


class Bifurcation(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = f"mesh.file={vessel('bifurcation', cls.base / 'bifurcation.msh')}"
        cls.planes = []
        for name, x in (("left", -1.5), ("right", 1.5)):
            normal = f"[{x}, 0, 1.5]"
            cls.planes += [f"output.planes.{name}.origin=[{x}, 0, 5]", f"output.planes.{name}.normal={normal}"]
        cls.runs = [
            run(program, BIFURCATION, cls.base / Path(program).name, cls.mesh, *cls.planes) for program in DRIVERS
        ]

    def test_runs_without_a_line_and_drivers_agree(self):
        files = files_of(self.runs[0])
        for name in ("centerline_pressure.csv", "wall_displacement.csv", "lines.csv", "points.csv"):
            self.assertNotIn(name, files)
        flows = [table(folder, "flow.csv") for folder in self.runs]
        np.testing.assert_allclose(flows[0], flows[1], rtol=1e-6, atol=1e-6 * np.abs(flows[0]).max())
        for key, apart in differences(*(rows(folder, "planes.csv") for folder in self.runs)).items():
            self.assertLess(apart, 1e-5, key)

    def test_branches_are_alike(self):
        last = {row["plane"]: row for row in rows(self.runs[0], "planes.csv")}
        left, right = last["left"], last["right"]
        self.assertAlmostEqual(left["area_mm2"], right["area_mm2"], delta=0.05 * right["area_mm2"])
        self.assertAlmostEqual(left["area_mm2"], np.pi * 0.7**2, delta=0.2)

    def test_a_centre_line_into_one_branch_when_asked_for(self):
        folder = run(
            MONOLITHIC,
            BIFURCATION,
            self.base / "line",
            self.mesh,
            'output.lines.right.centerline=["inlet", "right"]',
            "output.lines.right.points=21",
            "time.end=0.125",
        )
        line = rows(folder, "lines.csv")
        self.assertEqual(len(line), 21)
        self.assertLess(abs(line[0]["x_mm"]) + abs(line[0]["z_mm"]), 0.05)
        end = np.array([line[-1]["x_mm"], line[-1]["y_mm"], line[-1]["z_mm"]])
        self.assertLess(np.linalg.norm(end - [2.5, 0, 6]), 0.1)

    def test_openings_of_their_own(self):
        settings = (self.mesh, "fluid.outlet=false", "opening.left.resistance=0.5", "opening.right.resistance=0.5")
        runs = [run(program, BIFURCATION, self.base / f"three-{Path(program).name}", *settings) for program in DRIVERS]
        for folder in runs:
            self.assertNotIn("lines.csv", files_of(folder))
        one, other = (rows(folder, "openings.csv") for folder in runs)
        self.assertEqual({row["opening"] for row in one}, {"inlet", "left", "right"})
        for key, apart in differences(one, other).items():
            self.assertLess(apart, 1e-5, key)

    def test_a_surface_that_is_not_there(self):
        process = attempt(
            MONOLITHIC,
            BIFURCATION,
            folder=self.base / "refused",
            settings=(self.mesh, 'output.lines.a.centerline=["inlet", "rihgt"]'),
        )
        self.assertEqual(process.returncode, 1)
        self.assertIn("output.lines.a.centerline: there is no surface rihgt; did you mean right?", process.stderr)

    def test_a_mesh_in_metres_is_noticed(self):
        mesh = self.base / "metres.msh"
        process = attempt(
            MONOLITHIC,
            RIGID,
            "-q",
            folder=self.base / "metres",
            settings=(f"mesh.file={scaled(self.base / 'bifurcation.msh', mesh, 1e-3)}", *BLOOD),
        )
        self.assertIn("0.00195 mm across: the mesh seems to be in m; lengths are in mm", process.stderr)


BLOOD = ("fluid.viscosity=3.5e-3", "time.step=0.1", "time.end=10", "inlet.pressure=1e-6")


class RigidPipe(FolderTest):
    def test_planes_carry_the_flow_of_the_inlet(self):
        """Between rigid walls what passes each plane is what enters, but for what the mesh loses: quadratic cells 0.5 %."""
        shape = ("--inner-radius", 1, "--length", 12, "--size", 0.4, "--axial-size", 1.5, "--order", 2)
        mesh = make_mesh(self.base / "pipe.msh", *shape)
        planes = []
        for name, z, normal in (
            ("a", 0, [0, 0, 1]),
            ("b", 3.3, [0.2, 0, 1]),
            ("c", 6, [0, 0, 1]),
            ("d", 12, [0, 0, 1]),
        ):
            planes += [f"output.planes.{name}.origin=[0, 0, {z}]", f"output.planes.{name}.normal={normal}"]
        settings = (f"mesh.file={mesh}", "element=p2p1", "time.end=2", *planes)
        folder = run(MONOLITHIC, RIGID, self.base / "pipe", *settings)
        flow = table(folder, "flow.csv")
        seen = rows(folder, "planes.csv")
        for step in range(len(flow)):
            through = {row["plane"]: row for row in seen[4 * step : 4 * step + 4]}
            for name, column in (("a", 1), ("d", 2)):
                self.assertAlmostEqual(through[name]["flow_mm3_per_ms"], flow[step, column], delta=1e-9 * flow[step, 1])
                mean = flow[step, column + 2]
                self.assertAlmostEqual(through[name]["pressure_Pa"], mean, delta=1e-9 * flow[step, 3])
            for name in "bc":
                self.assertAlmostEqual(through[name]["flow_mm3_per_ms"], flow[step, 1], delta=0.005 * flow[step, 1])
        # The pressure falls evenly from one end to the other.
        self.assertAlmostEqual(through["c"]["pressure_Pa"], 0.5 * through["a"]["pressure_Pa"], delta=0.5)


if __name__ == "__main__":
    unittest.main()
