"""Supports and prestress of the wall as users ask for them: both drivers, at rest and moving, restarted and refused."""

import re
import signal
import subprocess
import unittest
from pathlib import Path

import numpy as np
from programs import (
    DRIVERS,
    MESH,
    MONOLITHIC,
    PARTITIONED,
    FolderTest,
    arrays,
    attempt,
    by_turns,
    difference,
    differing_arrays,
    driver_command,
    execute,
    make_mesh,
    pressure,
    restart,
    run,
    table,
    wall,
)
from scenes import scaled, scene

CASE = """title = "a vessel in tissue"
stabilisation = "projected"
[mesh]
file = "tube.msh"
[fluid]
density = 1.0
viscosity = 3.5e-3
outlet = false                     # closed: it holds the pressure
[structure]
density = 1.2
bulk_modulus = 1e5
[structure.layers.media]
material = "artery"
c10 = 3.0
k1 = 2.3632
k2 = 0.8393
alpha = 29
[structure.layers.adventitia]
material = "neo-hookean"
c10 = 0.3
[inlet]
pressure = {inlet}
{more}
[time]
step = 0.125
end = {end}
scheme = "{scheme}"
[newton]
tolerance = 1e-9
[partitioned]
tolerance = 1e-8
[output]
every = 0
"""
PRESTRESS = "[prestress]\npressure = 0.2"
WINDKESSEL = (
    "windkessel = { proximal = 0.01, compliance = 10.0, distal = 0.1, initial_pressure = 0.2, distal_pressure = 0.2 }"
)
TISSUE = """[[support]]
surface = "outer"
normal_spring = 2.0
damper = 0.5
pressure = [[0, 0.05], [0.25, 0.05], [0.25, 0.1]]
"""


class Supports(FolderTest):
    @staticmethod
    def between_openings(case, outlet):
        """The case between a pressure of 0.2 kPa and something else in place of a closed end."""
        text = case.read_text().replace("outlet = false                     # closed: it holds the pressure\n", "")
        ends = "".join(
            f'[[opening]]\nsurface = "{name}"\n{what}\n'
            for name, what in (("inlet", "pressure = 0.2"), ("outlet", outlet))
        )
        case.write_text(text.replace("[inlet]\npressure = 0.2\n", ends))

    def case(self, name, inlet=0.2, more="", end=0.375, scheme="midpoint"):
        file = self.base / f"{name}.toml"
        file.write_text(CASE.format(inlet=inlet, more=more, end=end, scheme=scheme))
        return file

    def test_vessel_under_prestress_is_at_rest(self):
        scenes = (
            ("p2p1", "axisymmetric", "midpoint", None),
            ("p2p1", "axisymmetric", "generalised-alpha", "pressure = 0.2"),
            ("p2p1", "axisymmetric", "tr-bdf2", WINDKESSEL),
            ("p1", "axisymmetric", "euler", "pressure = 0.2"),
            ("p1", "3d", "bdf2", "pressure = 0.2"),
        )
        for (element, geometry, scheme, outlet), program in by_turns(scenes, DRIVERS):
            settings = scene(self.base, element, geometry)
            case = self.case(
                "rest", more=PRESTRESS + "\n" + TISSUE.replace("[0.25, 0.1]", "[0.25, 0.05]"), scheme=scheme
            )
            if outlet:
                self.between_openings(case, outlet)
            with self.subTest(program=program, element=element, geometry=geometry, scheme=scheme):
                folder = run(program, case, self.base / "rest", *settings)
                moved = np.abs(wall(folder)[..., 2:]).max()
                off = np.abs(pressure(folder) - 200).max()
                print(f"{element} {geometry} {scheme}: moves {moved:.1e} mm, pressure off by {off:.1e} Pa")
                self.assertLess(moved, 1e-9)
                self.assertLess(off, 1e-5)
                self.assertTrue((folder / "prestress.h5").exists())

    def test_prestress_tells_how_far_it_is(self):
        settings = (*scene(self.base, "p2p1", "axisymmetric"), "time.end=0.125")
        case = self.case("progress", more=PRESTRESS)
        line = r"prestress: (100|50) % of 0.2 kPa, iteration (\d+), residual (\S+) of the first, \S+ s"
        for program in DRIVERS:
            with self.subTest(program=program):
                folder = self.base / "progress"
                process = attempt(program, case, "--force", folder=folder, settings=settings)
                self.assertEqual((process.returncode, process.stderr), (0, ""))
                said = [text for text in process.stdout.splitlines() if text.startswith("prestress")]
                found = [re.fullmatch(line, text).groups() for text in said]
                whole = [int(number) for share, number, _ in found if share == "100"]
                self.assertEqual(whole[:2], [1, 2])  # then, where it does not go straight there, once more by halves
                self.assertEqual(found[0][0], "100")
                self.assertEqual(found[-1][0], "100")
                self.assertLess(float(found[-1][2]), 1e-9)
                log = (folder / "run.log").read_text()
                for text in said:
                    self.assertIn(text, log)
                quiet = attempt(program, case, "--force", "-q", folder=folder, settings=settings)
                self.assertEqual((quiet.returncode, quiet.stdout, quiet.stderr), (0, "", ""))

    def test_a_mesh_in_metres_is_noticed_before_the_prestress_is_sought(self):
        """Of a wall alone, too, and however short the run is."""
        *settings, mesh = scene(self.base, "p2p1", "axisymmetric")
        metres = scaled(Path(mesh.removeprefix("mesh.file=")), self.base / "metres.msh", 1e-3)
        alone = CASE.format(inlet=0.2, more=PRESTRESS, end=1, scheme="midpoint").replace("[inlet]", "[load]")
        alone = re.sub(r"\[fluid\](.*\n)*?(?=\[structure\])", "", alone)
        wall_case = self.base / "wall in metres.toml"
        wall_case.write_text(alone)
        for case in (self.case("metres", more=PRESTRESS, end=1000), self.case("soon", more=PRESTRESS), wall_case):
            command = driver_command(
                MONOLITHIC,
                case,
                "--force",
                folder=self.base / "metres",
                settings=(*settings, f"mesh.file={metres}", "time.step=0.125", "time.end=0.125"),
            )
            said = subprocess.run(
                command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
            ).stdout
            self.assertIn("the mesh seems to be in m; lengths are in mm", said)
            self.assertLess(said.index("seems to be in m;"), said.index("prestress: "), said)

    def test_a_signal_ends_the_search_for_prestress_at_once(self):
        """Nothing is left of it."""
        size = ("--lumen-cells", 4, "--media-cells", 2, "--adventitia-cells", 2, "--axial-cells", 12, "--around", 24)
        mesh = make_mesh(self.base / "long.msh", "--length", 6, *size, "--order", 2)
        case = self.case("long", more=PRESTRESS)
        folder = self.base / "never"
        for number, code in ((signal.SIGTERM, 143), (signal.SIGINT, 130)):
            command = driver_command(
                MONOLITHIC,
                case,
                folder=folder,
                settings=(f"mesh.file={mesh}", "element=p2p1", "prestress.pressure=0.3"),
            )
            with self.subTest(signal=number), subprocess.Popen(
                command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
            ) as process:
                self.assertIn("prestress: ", process.stdout.readline())  # its first iteration
                process.send_signal(number)
                _, errors = process.communicate(timeout=100)
                self.assertEqual(process.returncode, code, errors)
                self.assertIn("interrupted before the first step", errors)
                self.assertFalse(folder.exists())

    def test_wall_alone_under_prestress_is_at_rest(self):
        text = CASE.format(inlet=0.1, more="[prestress]\npressure = 0.1\n" + TISSUE, end=0.25, scheme="euler")
        for section, following, put in (("[fluid]", "[structure]", ""), ("[time]", "[newton]", "")):
            text = text.replace(text[text.index(section) : text.index(following)], put)
        text = text.replace("[inlet]", "[load]").replace("damper = 0.5\n", "")
        text = text.replace("[[0, 0.05], [0.25, 0.05], [0.25, 0.1]]", "0.05") + "[static]\nload_steps = 2\n"
        case = self.base / "alone.toml"
        case.write_text(text)
        for element, geometry, components in (("p1", "3d", 3), ("p2p1", "axisymmetric", 2)):
            with self.subTest(element=element, geometry=geometry):

                def moved(*settings):
                    here = scene(self.base, element, geometry)
                    folder = run(MONOLITHIC, case, self.base / "alone", *here, *settings)
                    level = arrays(folder / "checkpoint.h5")["arrays/level0.wall"].reshape(-1, components + 1)
                    return np.abs(level[:, :components]).max()

                print(f"wall alone, {element} {geometry}: moves {moved():.1e} mm")
                self.assertLess(moved(), 1e-9)
                self.assertGreater(moved("load.pressure=0.12"), 1e-3)

    def test_both_drivers_agree_from_prestress_on(self):
        settings = scene(self.base, "p2p1", "axisymmetric")
        case = self.case("pulse", inlet=0.3, more=PRESTRESS + "\n" + TISSUE)
        folders = [run(program, case, self.base / f"pulse{i}", *settings) for i, program in enumerate(DRIVERS)]
        self.assertGreater(np.abs(wall(folders[0])[..., 2]).max(), 1e-4)
        for k in (2, 3):
            self.assertLess(difference(wall(folders[0])[..., k], wall(folders[1])[..., k]).max(), 1e-6)
        self.assertLess(difference(pressure(folders[0]), pressure(folders[1])).max(), 1e-6)
        for folder in folders:
            rows = np.genfromtxt(folder / "energy.csv", delimiter=",", names=True)
            self.assertEqual(
                list(rows.dtype.names[-4:]),
                ["support_work_uJ", "spring_energy_uJ", "damper_dissipation_uJ", "spring_force_uJ"],
            )
            scale = np.abs(rows["inlet_work_uJ"]).sum()
            self.assertLess(np.abs(rows["remainder_uJ"]).max(), 1e-6 * scale)
            self.assertGreater(rows["damper_dissipation_uJ"].sum(), 0)

    def test_ends_that_slide_or_are_free_take_their_openings_along(self):
        for element, geometry, scheme, fixed in (
            ("p2p1", "axisymmetric", "midpoint", '["normal"]'),
            ("p1", "axisymmetric", "tr-bdf2", "[]"),
            ("p1", "3d", "generalised-alpha", '["normal"]'),
        ):
            settings = scene(self.base, element, geometry)
            case = self.case("slide", more=f'[[support]]\nsurface = "wall_ends"\nfixed = {fixed}', scheme=scheme)
            self.between_openings(case, "resistance = 0.02\ndistal_pressure = 0.1")
            with self.subTest(element=element, geometry=geometry):
                folders = [run(program, case, self.base / f"slide{i}", *settings) for i, program in enumerate(DRIVERS)]
                moved = wall(folders[0])[-1]
                self.assertGreater(moved[0, 2], 0.3 * moved[:, 2].max())  # the end at the inlet widens
                for k in (2, 3):
                    one, other = (wall(folder)[..., k] for folder in folders)
                    self.assertLess(np.abs(one - other).max(), 1e-6 * np.abs(wall(folders[0])[..., 2:]).max())
                self.assertLess(difference(pressure(folders[0]), pressure(folders[1])).max(), 1e-6)
                for program, folder in zip(DRIVERS, folders):
                    rows = np.genfromtxt(folder / "energy.csv", delimiter=",", names=True)
                    scale = np.abs(rows["inlet_work_uJ"]).sum()
                    self.assertLess(np.abs(rows["remainder_uJ"]).max(), 1e-6 * scale)
                    begun = run(program, case, self.base / "begun", *settings, "time.end=0.25")
                    self.assertEqual(restart(program, case, begun, *settings), begun)
                    self.assertEqual(differing_arrays(folder / "checkpoint.h5", begun / "checkpoint.h5"), [])

    def test_a_flow_is_given_where_the_opening_moves(self):
        """Its pressure is found with the step, by both drivers; a run goes on with the same bits."""
        settings = scene(self.base, "p1", "axisymmetric")
        case = self.case("flow", more='[[support]]\nsurface = "wall_ends"\nfixed = ["z"]', scheme="midpoint")
        self.between_openings(case, "flow_rate = [[0, 0], [0.5, 0.5]]")
        folders = [run(program, case, self.base / f"flow{i}", *settings) for i, program in enumerate(DRIVERS)]
        self.assertLess(difference(pressure(folders[0]), pressure(folders[1])).max(), 1e-6)
        for program, folder in zip(DRIVERS, folders):
            rows = np.genfromtxt(folder / "openings.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
            rows = rows[rows["opening"] == "outlet"]
            np.testing.assert_allclose(rows["flow_mm3_per_ms"], -rows["time_ms"], atol=1e-3 * rows["time_ms"][-1])
            begun = run(program, case, self.base / "begun", *settings, "time.end=0.25")
            self.assertEqual(restart(program, case, begun, *settings), begun)
            self.assertEqual(differing_arrays(folder / "checkpoint.h5", begun / "checkpoint.h5"), [])

    def test_a_given_flow_s_refusals(self):
        settings = scene(self.base, "p1", "axisymmetric")
        case = self.case("flow", more='[[support]]\nsurface = "wall_ends"\nfixed = ["z"]')
        self.between_openings(case, 'flow_rate = -1.0\nprofile = "plug"')
        process = attempt(MONOLITHIC, case, "-q", folder=self.base / "refused", settings=settings)
        self.assertEqual(process.returncode, 1, process.stderr)
        self.assertIn("opening.outlet.profile: the wall's end at this opening is not clamped", process.stderr)
        text = case.read_text().replace("pressure = 0.2\n", "flow_rate = 1.0\n").replace('profile = "plug"\n', "")
        case.write_text(text)
        only = (*settings, "partitioned.scheme=iqn-ils")
        process = attempt(PARTITIONED, case, "-q", folder=self.base / "refused", settings=only)
        self.assertEqual(process.returncode, 1, process.stderr)
        self.assertIn("its pressure is not determined", process.stderr)

    def test_prestress_is_kept_and_used_again(self):
        settings = scene(self.base, "p2p1", "axisymmetric")
        for scheme, program in by_turns(("midpoint", "generalised-alpha"), DRIVERS):
            case = self.case("kept", inlet=0.25, more=PRESTRESS + "\n" + TISSUE, scheme=scheme)
            with self.subTest(program=program, scheme=scheme):
                whole = run(program, case, self.base / "whole", *settings)
                begun = run(program, case, self.base / "begun", *settings, "time.end=0.25")
                self.assertEqual(restart(program, case, begun, *settings), begun)
                self.assertEqual(differing_arrays(whole / "checkpoint.h5", begun / "checkpoint.h5"), [])
                again = run(program, case, self.base / "again", *settings, f"prestress.file={whole}/prestress.h5")
                self.assertEqual(differing_arrays(whole / "checkpoint.h5", again / "checkpoint.h5"), [])
        kept = f"prestress.file={self.base}/whole/prestress.h5"
        for changes, said in (
            ((*settings, "prestress.pressure=0.25"), "belongs to another wall or load"),
            ((*settings, "structure.layers.media.c10=4"), "belongs to another wall or load"),
            (scene(self.base, "p1", "axisymmetric"), "belongs to another mesh"),
            ((*settings, f"prestress.file={self.base}/whole/checkpoint.h5"), "is no prestress but a checkpoint of"),
            ((*settings, f"prestress.file={self.base}/none.h5"), "there is no file"),
        ):
            process = attempt(MONOLITHIC, case, "-q", folder=self.base / "refused", settings=(kept, *changes))
            self.assertEqual(process.returncode, 1, process.stderr)
            self.assertIn(said, process.stderr)
            self.assertEqual(process.stderr.count("\n"), 1, process.stderr)

    def test_surfaces_that_cannot_be_supported(self):
        settings = scene(self.base, "p1", "axisymmetric")
        for more, said in (
            ('[[support]]\nsurface = "outter"\nspring = 1', "has no such surface; did you mean outer?"),
            ('[[support]]\nsurface = "inlet"\nspring = 1', "do not bound the wall"),
            # The tube's far end is closed: the fluid sticks to it.
            (
                '[[support]]\nsurface = "wall_ends"\nfixed = ["z"]',
                "that meet the fluid in an opening can slide or be free",
            ),
        ):
            case = self.case("refused", more=more)
            process = attempt(MONOLITHIC, case, "-q", folder=self.base / "refused", settings=settings)
            self.assertEqual(process.returncode, 1, process.stderr)
            self.assertIn(said, process.stderr)
            self.assertEqual(process.stderr.count("\n"), 1, process.stderr)

    def test_wall_too_soft_for_its_prestress(self):
        settings = scene(self.base, "p2p1", "axisymmetric")
        case = self.case("soft", more="[prestress]\npressure = 1000")
        process = attempt(MONOLITHIC, case, "-q", folder=self.base / "soft", settings=settings)
        self.assertEqual(process.returncode, 2, process.stderr)
        self.assertIn("prestress: no unloaded shape found for more than", process.stderr)


class Gravity(FolderTest):
    """A column between rollers under its weight: u(y) = -rho g (L y - y^2 / 2) / (lambda + 2 mu), which is quadratic."""

    SHAPE = """
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0};
Line(1) = {1, 2};
s[] = Extrude { 0, 10, 0 } { Curve{1}; Layers{5}; };
Physical Surface("column") = {s[1]};
Physical Curve("wall_ends") = {1};
Physical Curve("symmetry_x") = {s[2], s[3]};
"""
    CASE = """
element = "p2p1"
geometry = "plane"
[mesh]
file = "column.msh"
[structure]
density = 2.0
gravity = [0, -1e-2, 0]
[structure.layers.column]
material = "linear-elastic"
lame_lambda = 40.0
lame_mu = 30.0
[static]
load_steps = 2
[output.points]
top = [1, 10, 0]
middle = [1, 5, 0]
"""

    def test_column_under_its_weight(self):
        (self.base / "column.geo").write_text(self.SHAPE)
        (self.base / "column.toml").write_text(self.CASE)
        made = execute(MESH, "geo", self.base / "column.geo", "--order", 2, "-q", "-o", self.base / "column.msh")
        self.assertEqual(made.returncode, 0, made.stderr)
        folder = run(MONOLITHIC, self.base / "column.toml", self.base / "column")
        rows = [line.split(",") for line in (folder / "points.csv").read_text().splitlines()]
        for name, height in (("top", 10.0), ("middle", 5.0)):
            last = [dict(zip(rows[0], row)) for row in rows if row[1] == name][-1]
            exact = -2.0 * 1e-2 * (10 * height - height**2 / 2) / (40 + 2 * 30)
            self.assertAlmostEqual(float(last["displacement_y_mm"]) / exact, 1, delta=1e-9)
        energy = [line.split(",") for line in (folder / "energy.csv").read_text().splitlines()]
        work = [float(row[energy[0].index("support_work_uJ")]) for row in energy[1:]]
        self.assertGreater(min(work), 0)

    def test_a_direction_that_the_scene_lacks_is_refused(self):
        (self.base / "column.toml").write_text(self.CASE.replace("-1e-2, 0]", "-1e-2, 1]"))
        process = attempt(MONOLITHIC, self.base / "column.toml", folder=self.base / "none")
        self.assertEqual(process.returncode, 1)
        self.assertIn("structure.gravity: points out of the plane", process.stderr)


if __name__ == "__main__":
    unittest.main()
