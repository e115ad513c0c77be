"""fsi-mesh import of a case of svMultiPhysics: what comes of it is the case that one would write by hand, for both
drivers; what has no counterpart is named; what is wrong is refused in one line, with nothing written."""

import csv
import math
import re
import shutil
import signal
import subprocess
import time
import tomllib
import unittest
from pathlib import Path

import numpy as np
import svmultiphysics_tube as peer

from programs import DRIVERS, MESH, FolderTest, attempt, execute, run

BY_HAND = """
element = "p1"
[mesh]
file = "mesh.msh"
[fluid]
density = 1.06
viscosity = 4e-3
[structure]
density = 1.2
[structure.layers.wall]
material = "neo-hookean"
young = 400
poisson = 0.45
[[opening]]
surface = "inlet"
pressure = 2.0
backflow = 0.2
[[opening]]
surface = "outlet"
windkessel = { proximal = 1.21e-2, compliance = 150, distal = 0.1212, initial_pressure = 2 }
backflow = 0.2
[[support]]
surface = "wall_ends"
fixed = ["x", "y", "z"]
[[support]]
surface = "outside"
spring = 10.0
damper = 1.0
[mesh_motion]
method = "stiffened"
[time]
step = 0.1
end = 0.4
scheme = "generalised-alpha"
spectral_radius = 0.5
[output]
every = 2
"""


class PeerCases(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.points, cls.media, cls.faces = peer.write_meshes(cls.base)
        cls.count = 0

    def imported(self, text, *options):
        """The process, and the folder that it was to make."""
        type(self).count += 1
        (self.base / "solver.xml").write_text(text)
        folder = self.base / f"case-{self.count}"
        return execute(MESH, "import", "solver.xml", "-o", folder, *options, cwd=self.base), folder

    def made(self, text, *options):
        process, folder = self.imported(text, *options)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(
            sorted(p.name for p in folder.iterdir() if p.suffix != ".csv"), ["case.toml", "import.log", "mesh.msh"]
        )
        return process, folder, tomllib.loads((folder / "case.toml").read_text())

    def refused(self, text, *words, options=()):
        before = sorted(path.name for path in self.base.iterdir())
        process, folder = self.imported(text, *options)
        self.assertEqual(process.returncode, 1, process.stdout)
        self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
        for word in words:
            self.assertIn(word, process.stderr)
        self.assertIn("; ", process.stderr)
        self.assertEqual(
            sorted({path.name for path in self.base.iterdir()} - {"solver.xml"}), sorted(set(before) - {"solver.xml"})
        )
        return process.stderr

    def write_by_hand(self, folder):
        """The same tube by gmsh's format, from the numbers of the tube, in mm; and the case as one would write it."""
        folder.mkdir()
        groups = {"inlet": "fluid_inlet", "outlet": "fluid_outlet", "outside": "outside"}
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "6"]
        lines += ['3 1 "fluid"', '3 2 "wall"', '2 3 "inlet"', '2 4 "outlet"', '2 5 "outside"', '2 6 "wall_ends"']
        lines += ["$EndPhysicalNames", "$Nodes", str(len(self.points))]
        lines += [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(self.points.tolist(), 1)]
        elements = [(4, 1, self.media["fluid"]), (4, 2, self.media["wall"])]
        elements += [(2, 3 + i, self.faces[face]) for i, face in enumerate(groups.values())]
        elements += [(2, 6, self.faces["wall_inlet"]), (2, 6, self.faces["wall_outlet"])]
        rows = [
            f"{kind} 2 {tag} {tag} {' '.join(map(str, row))}" for kind, tag, nodes in elements for row in (nodes + 1)
        ]
        lines += ["$EndNodes", "$Elements", str(len(rows))] + [f"{i} {row}" for i, row in enumerate(rows, 1)]
        (folder / "mesh.msh").write_text("\n".join(lines + ["$EndElements", ""]))
        (folder / "case.toml").write_text(BY_HAND)

    def columns(self, file):
        with open(file, newline="") as text:
            return list(csv.DictReader(text))

    def test_both_drivers_find_what_the_case_by_hand_has(self):
        _, folder, _ = self.made(peer.fsi())
        by_hand = self.base / "by-hand"
        self.write_by_hand(by_hand)
        names = {"lumen_inlet": "inlet", "lumen_outlet": "outlet"}
        for program in DRIVERS:
            # So that what the solvers leave is far below what is compared.
            tight = ("newton.error_tolerance=1e-9", "partitioned.tolerance=1e-9")
            ours, theirs = (
                run(program, case / "case.toml", case / f"run-{Path(program).name}", *tight)
                for case in (by_hand, folder)
            )
            mine, yours = (self.columns(at / "openings.csv") for at in (ours, theirs))
            self.assertEqual(len(mine), len(yours))
            self.assertGreater(len(mine), 6)
            largest = {
                key: max(abs(float(row[key])) for row in mine) for key in mine[0] if key not in ("time_ms", "opening")
            }
            self.assertGreater(largest["flow_mm3_per_ms"], 0.01)
            for a, b in zip(mine, yours):
                self.assertEqual(a["opening"], names[b["opening"]])
                for key, size in largest.items():
                    self.assertAlmostEqual(float(a[key]), float(b[key]), delta=1e-9 * size)
            mine, yours = (self.columns(at / "wall_displacement.csv") for at in (ours, theirs))
            moved = ("radial_mm", "axial_mm")
            size = max(abs(float(row[key])) for row in mine for key in moved)
            self.assertGreater(size, 1e-5)
            for a, b in zip(mine, yours, strict=True):
                for key in moved:
                    self.assertAlmostEqual(float(a[key]), float(b[key]), delta=1e-9 * size)

    def test_a_signal_leaves_nothing_behind(self):
        """Whether it comes while the case is read, or while its mesh is looked at."""
        (self.base / "solver.xml").write_text(peer.fsi())
        before = sorted(self.base.iterdir())
        for number, code in ((signal.SIGTERM, 143), (signal.SIGINT, 130)):
            for awaited in ("*.part", "*.part/*", "*.part/given.msh"):
                with self.subTest(signal=number, awaited=awaited):
                    command = [str(MESH), "import", "solver.xml", "-o", "interrupted"]
                    with subprocess.Popen(command, cwd=self.base, stderr=subprocess.PIPE, text=True) as process:
                        deadline = time.monotonic() + 100
                        while not any(self.base.glob(awaited)) and time.monotonic() < deadline:
                            self.assertIsNone(process.poll(), "has ended before the signal")
                        process.send_signal(number)
                        _, errors = process.communicate(timeout=100)
                    self.assertEqual((process.returncode, errors), (code, "fsi-mesh: interrupted\n"))
                    self.assertEqual(sorted(self.base.iterdir()), before)

    def test_units_follow_from_length_mass_and_time(self):
        """A case in SI with the numbers of the same tube is the same case."""
        _, _, cgs = self.made(peer.fsi())
        fluid = peer.FLUID_VALUES.replace("1.06", "1060").replace("0.04", "0.004")
        wall = peer.WALL_VALUES.replace("1.2", "1200").replace("4.0e6", "4e5")
        conditions = {
            "lumen_inlet": "<Type> Neu </Type> <Value> 2.0e3 </Value>",
            "lumen_outlet": peer.RCR.replace("1.5e-5", "1.5e-10")
            .replace("1212", "1.212e8")
            .replace("121 ", "1.21e7 ")
            .replace("2e4", "2e3"),
            "wall_inlet": peer.CLAMP,
            "wall_outlet": peer.CLAMP,
            "wall_outer": "<Type> Robin </Type> <Stiffness> 1e7 </Stiffness> <Damping> 1000 </Damping>",
        }
        scaled = peer.fsi(wall, fluid, conditions).replace(
            "<Add_face", "<Mesh_scale_factor> 0.01 </Mesh_scale_factor> <Add_face", 1
        )
        scaled = scaled.replace(
            '<Add_mesh name="vessel">', '<Add_mesh name="vessel"> <Mesh_scale_factor> 0.01 </Mesh_scale_factor>'
        )
        _, _, si = self.made(scaled, "--units", "si")
        self.assertEqual(cgs, si)

    def test_flow_between_rigid_walls(self):
        """Its sign turned, as its Fourier series, with its period; a wall is closed."""
        times = [0, 0.25, 0.5, 0.75, 1.0]
        (self.base / "inlet.flow").write_text(
            "5 3\n" + "".join(f"{t} {-0.4 - 0.3 * math.sin(2 * math.pi * t)}\n" for t in times)
        )
        inlet = "<Type> Dir </Type> <Time_dependence> Unsteady </Time_dependence> <Profile> Parabolic </Profile>"
        inlet += "<Temporal_values_file_path> inlet.flow </Temporal_values_file_path> <Impose_flux> true </Impose_flux>"
        conditions = {"lumen_inlet": inlet, "lumen_outlet": peer.RCR, "lumen_wall": peer.CLAMP}
        process, folder, case = self.made(peer.rigid(conditions))
        self.assertNotIn("structure", case)
        self.assertEqual(case["fluid"]["closed"], ["lumen_wall"])
        opening = case["opening"][0]
        self.assertEqual((opening["period"], opening["profile"]), (1000.0, "parabolic"))
        rows = self.columns(folder / opening["flow_rate"]["file"])
        # Of the polygon through the points the first mode is b = 8/pi^2 of its height, the second none.
        height = 0.3 * 8 / math.pi**2
        for row in rows:
            expected = 0.4 + height * math.sin(2 * math.pi * float(row["time_ms"]) / 1000)
            self.assertAlmostEqual(float(row["flow_mm3_per_ms"]), expected, delta=1e-12)
        off = 100 * 0.3 * (1 - 8 / math.pi**2) / (0.4 + height)
        self.assertIn(f"off its points by {off:.2g} % of its largest value", (folder / "import.log").read_text())
        for program in DRIVERS:
            done = run(program, folder / "case.toml", folder / f"run-{Path(program).name}")
            flows = [
                float(r["flow_mm3_per_ms"])
                for r in self.columns(done / "openings.csv")
                if r["opening"] == "lumen_inlet"
            ]
            self.assertAlmostEqual(flows[-1], -0.4 - height * math.sin(2 * math.pi * 4e-3), delta=2e-3)

    def test_a_velocity_is_a_flow_over_the_area(self):
        at = self.points[self.faces["fluid_inlet"]]
        area = 0.5 * np.linalg.norm(np.cross(at[:, 1] - at[:, 0], at[:, 2] - at[:, 0]), axis=1).sum()
        inlet = "<Type> Dir </Type> <Value> -20 </Value> <Profile> Flat </Profile>"  # 20 cm/s = 0.2 mm/ms, inwards
        conditions = {"lumen_inlet": inlet, "lumen_wall": peer.CLAMP}
        process, _, case = self.made(peer.rigid(conditions))
        self.assertEqual(case["opening"][0]["profile"], "plug")
        self.assertAlmostEqual(case["opening"][0]["flow_rate"], 0.2 * area, delta=1e-12)
        self.assertIn("a velocity (no Impose_flux)", process.stderr)
        # The other end has no condition: free of traction, as there.
        self.assertEqual(case["opening"][1], {"surface": "lumen_outlet", "backflow": 0.0})

    def test_a_face_whose_normal_velocity_is_zero_is_a_plane_of_symmetry(self):
        """Where its normal is an axis; else it is refused, never a wall. A direction that holds all is one."""
        held = "<Type> Dir </Type> <Value> 0.0 </Value> <Effective_direction> {} </Effective_direction>"
        pressure = "<Type> Neu </Type> <Value> 2e4 </Value>"
        conditions = {"lumen_inlet": pressure, "lumen_outlet": held.format("(0, 0, 1)"), "lumen_wall": peer.CLAMP}
        _, folder, case = self.made(peer.rigid(conditions))
        self.assertEqual(case["fluid"]["closed"], ["lumen_wall"])
        self.assertEqual([opening["surface"] for opening in case["opening"]], ["lumen_inlet"])
        names = set(re.findall(r'^2 \d+ "(.*)"$', (folder / "mesh.msh").read_text(), re.MULTILINE))
        self.assertEqual(names, {"lumen_inlet", "lumen_wall", "symmetry_z"})
        self.assertIn("lumen_outlet: a plane of symmetry, called symmetry_z here", (folder / "import.log").read_text())
        for program in DRIVERS:
            process = attempt(program, folder / "case.toml", "--check")
            self.assertEqual(process.returncode, 0, process.stderr)
        _, folder, case = self.made(peer.rigid({**conditions, "lumen_wall": held.format("1 1 -1")}))
        self.assertEqual(case["fluid"]["closed"], ["lumen_wall"])
        for face, direction, axes in (
            ("lumen_outlet", "(1, 0, 0)", "x"),
            ("lumen_outlet", "(0, 1, 1)", "y and z"),
            ("lumen_wall", "(0, 0, 1)", "z"),
        ):
            text = peer.rigid({**conditions, face: held.format(direction)})
            words = f"holds the velocity along {axes} only, and the face is no plane of symmetry"
            self.refused(text, f"Add_BC {face}/Effective_direction: {words}", "take it out where the face is a wall")

    def test_a_case_is_no_mesh(self):
        (self.base / "solver.xml").write_text(peer.fsi())
        for options in (("--list",), ("-o", "out.msh")):
            process = execute(MESH, "import", "solver.xml", *options, cwd=self.base)
            self.assertEqual(process.returncode, 1)
            self.assertIn("is a case of svMultiPhysics, no mesh; give -o FOLDER", process.stderr)
        process = execute(MESH, "import", "solver.xml", "--units", "si", "-o", "out.msh", cwd=self.base)
        self.assertIn("--units: is for cases", process.stderr)

    def test_fibres_by_their_angle(self):
        law = '<Constitutive_model type="HGO"> <a4> 2e4 </a4> <b4> 0.8 </b4> <a6> 2e4 </a6> <b6> 0.8 </b6> '
        law += "<kappa> 0.1 </kappa> </Constitutive_model>"
        wall = peer.WALL_VALUES.replace('<Constitutive_model type="neoHookean"> </Constitutive_model>', law)
        self.refused(peer.fsi(wall), "gives fibres by vectors", "--fibre-angle DEGREES")
        self.refused(peer.fsi(wall), "-29 is no angle", options=("--fibre-angle=-29",))
        process, folder, case = self.made(peer.fsi(wall), "--fibre-angle", "29")
        layer = case["structure"]["layers"]["vessel"]
        expected = {"c10": 400 / 2.9, "k1": 2.0, "k2": 0.8, "alpha": 29.0, "kappa": 0.1}
        self.assertEqual(layer.pop("material"), "holzapfel-gasser-ogden")
        self.assertEqual(layer.keys(), expected.keys())
        for key, value in expected.items():
            self.assertAlmostEqual(layer[key], value, delta=1e-12 * abs(value))
        self.assertAlmostEqual(case["structure"]["bulk_modulus"], 400 / 0.3, delta=1e-9)
        self.assertIn("not by the vectors of the case", process.stderr)
        for program in DRIVERS:
            process = attempt(program, folder / "case.toml", "--check")
            self.assertEqual(process.returncode, 0, process.stderr)

    def test_a_linear_wall(self):
        conditions = {"wall_inlet": peer.CLAMP, "wall_outlet": "<Type> Neu </Type> <Value> -1e3 </Value>"}
        values = "<Density> 1.2 </Density> <Elasticity_modulus> 4e6 </Elasticity_modulus>"
        values += "<Poisson_ratio> 0.4 </Poisson_ratio>"
        _, _, case = self.made(peer.wall_alone(conditions, values, "lElas"))
        expected = {"vessel": {"material": "linear-elastic", "young": 400.0, "poisson": 0.4}}
        self.assertEqual(case["structure"]["layers"], expected)

    def test_a_wall_alone(self):
        conditions = {
            "wall_inlet": peer.CLAMP,
            "wall_outlet": "<Type> Dir </Type> <Effective_direction> (0, 0, 1) </Effective_direction>",
            "wall_inner": "<Type> Neu </Type> <Value> 1e4 </Value> <Follower_pressure_load> 1 </Follower_pressure_load>",
        }
        _, folder, case = self.made(peer.wall_alone(conditions))
        supports = {support.pop("surface"): support for support in case["support"]}
        self.assertEqual(supports["wall_outlet"], {"fixed": ["z"]})
        self.assertEqual(supports["wall_inlet"], {"fixed": ["x", "y", "z"]})
        self.assertEqual(list(supports.values())[-1], {"pressure": 1.0})
        for program in DRIVERS[:1]:
            run(program, folder / "case.toml", folder / "run")

    def test_a_load_on_a_flat_face_keeps_its_direction(self):
        conditions = {"wall_inlet": peer.CLAMP, "wall_outlet": "<Type> Neu </Type> <Value> -1e4 </Value>"}
        _, folder, case = self.made(peer.wall_alone(conditions))
        (support,) = [support for support in case["support"] if support["surface"] == "wall_outlet"]
        for part, expected in zip(support["traction"], (0, 0, 1.0), strict=True):  # a pull outwards, along z
            self.assertAlmostEqual(part, expected, delta=1e-12)
        run(DRIVERS[0], folder / "case.toml", folder / "run")

    def test_what_has_no_counterpart_is_named_with_its_place(self):
        text = peer.fsi(peer.WALL_VALUES.replace("quad", "M94")).replace(
            "<Coupled>", "<Nonsense> 3 </Nonsense> <Coupled>", 1
        )
        text = text.replace("<Continue_previous_simulation> 0", "<Continue_previous_simulation> 1")
        process, folder, _ = self.made(text)
        log = (folder / "import.log").read_text()
        for line in ("LS (lines", "Nonsense (line", "M94: K/2 (J - 1)^2", "Continue_previous_simulation (line 4)"):
            self.assertEqual(len([row for row in log.splitlines() if line in row]), 1, line)
        # What may change a result is a warning, the rest is not.
        for word in ("Nonsense", "M94", "Continue_previous_simulation"):
            self.assertIn(word, process.stderr)
        self.assertNotIn("LS", process.stderr)
        for row in process.stderr.splitlines():
            self.assertTrue(row.startswith("fsi-mesh: warning: "), row)

    def test_wrong_cases(self):
        good = peer.fsi()
        inlet = {"lumen_inlet": "<Type> Neu </Type> <Value> 1 </Value>", "lumen_outlet": peer.RCR}
        for text, *words in (
            (good[:-30], "is no XML", "line"),
            ("", "is no XML"),
            ("<a/>", "a: is no case that ours reads"),
            ('<!DOCTYPE a [<!ENTITY b "c">]><svMultiPhysicsFile>&b;</svMultiPhysicsFile>', "has a document type (a)"),
            (good.replace('type="FSI"', 'type="FSJ"'), "'FSJ' is no equation", "did you mean 'FSI'"),
            (good.replace('type="FSI"', 'type="CMM"'), "wall without thickness", "fsi-mesh thicken"),
            (
                good.replace('Add_BC name="lumen_outlet"', 'Add_BC name="lumen_outlte"'),
                "no face 'lumen_outlte'",
                "'lumen_outlet'?",
            ),
            (peer.rigid(inlet), "lumen_wall: has no Add_BC, and is not flat"),
            (good.replace("mesh/wall/mesh-complete.mesh.vtu", "mesh/wall/none.vtu"), "there is no file", "none.vtu"),
            (good.replace("surfaces/fluid_inlet", "surfaces/none"), "there is no file", "none.vtp"),
            (
                good.replace("lumen/mesh-surfaces/fluid_inlet", "wall/mesh-surfaces/outside"),
                "lumen_inlet",
                "sides of no cell",
            ),
            (good.replace("> 1.06 <", "> heavy <"), "Density: 'heavy' is no finite number", "line"),
            (good.replace("> 1.06 <", "> inf <"), "Density: 'inf' is no finite number"),
            (good.replace("> 1.06 <", "> -1 <"), "Density: -1 is not positive"),
            (good.replace("> 0.45 <", "> 0.6 <"), "Poisson's ratio 0.6"),
            (good.replace("> 0.45 <", "> 0.5 <"), "has no bulk modulus"),
            (good.replace("> 1e-4 <", "> 0 <"), "Time_step_size: 0 is no length of a step"),
            (good.replace("> 4 <", "> 4.5 <"), "Number_of_time_steps: 4.5"),
            (good.replace('type="neoHookean"', 'type="Guccione"'), "Guccione's law of the heart"),
            (good.replace('type="neoHookean"', 'type="neoHook"'), "'neoHook' is no constitutive model"),
            (good.replace("> quad <", "> cubic <"), "'cubic' is no penalty model"),
            (good.replace('model="Constant"', 'model="Const4"'), "'Const4' is no viscosity model"),
            (good.replace("> RCR <", "> Coupled <"), "Time_dependence 'Coupled' has no counterpart", "[network]"),
            (good.replace("> 1.5e-5 <", "> 0 <"), "Capacitance: 0 is not positive"),
            (good.replace("<Type> Robin", "<Type> Robbin"), "Type 'Robbin'"),
            (good.replace("<Domain> 1 </Domain>", "<Domain> 7 </Domain>"), "of the domain 7"),
        ):
            with self.subTest(words[0]):
                self.refused(text, *words)
        self.refused(good, "'cgz' is no system of units", "did you mean 'cgs'", options=("--units", "cgz"))
        self.refused(good, "--group", "is not for cases", options=("--group", "a=b"))
        (self.base / "bad.flow").write_text("3 2\n0 1\n1 nan\n2 3\n")
        unsteady = "<Type> Neu </Type> <Time_dependence> Unsteady </Time_dependence> "
        unsteady += "<Temporal_values_file_path> bad.flow </Temporal_values_file_path>"
        self.refused(peer.rigid({**inlet, "lumen_inlet": unsteady, "lumen_wall": peer.CLAMP}), "bad.flow", "line 3")

    def test_lumen_and_wall_that_share_no_face(self):
        """Nodes 2e-4 mm apart: refused, and one by --join, which says so."""
        moved = self.points + [2e-4, 0, 0]
        peer.write_volume(self.base / "mesh" / "moved.vtu", 0.1 * moved, self.media["wall"], 2)
        text = peer.fsi().replace("mesh/wall/mesh-complete.mesh.vtu", "mesh/moved.vtu")
        for name in ("wall_inlet", "wall_outlet", "outside", "inside"):
            face = self.faces["interface" if name == "inside" else name]
            peer.write_face(self.base / "mesh" / f"{name}.vtp", 0.1 * moved, face, 1)
            text = text.replace(f"mesh/wall/mesh-surfaces/{name}.vtp", f"mesh/{name}.vtp")
        self.refused(text, "Add_projection wall_inner", "share no face", "--join MM")
        process, folder, _ = self.made(text, "--join", "0.001")
        self.assertRegex((folder / "import.log").read_text(), r"--join 0.001: \d+ points are joined to others")
        (log,) = [row for row in (folder / "import.log").read_text().splitlines() if row.startswith("wall_inner")]
        self.assertIn("on the interface", log)

    def test_a_folder_that_is_there_stays_as_it_is(self):
        (self.base / "there").mkdir()
        (self.base / "there" / "mine").write_text("x")
        (self.base / "solver.xml").write_text(peer.fsi())
        process = execute(MESH, "import", "solver.xml", "-o", "there", cwd=self.base)
        self.assertEqual(process.returncode, 1)
        self.assertIn("there: is there already", process.stderr)
        self.assertEqual([path.name for path in (self.base / "there").iterdir()], ["mine"])

    def test_a_configuration_of_precice_says_what_lacks(self):
        text = '<precice-configuration><participant name="Fluid"/><participant name="Solid"/>'
        text += '<coupling-scheme:a><time-window-size value="0.01"/><max-time value="5"/></coupling-scheme:a>'
        text += "</precice-configuration>"
        self.refused(text, "does not hold the fluid's mesh", "Fluid and Solid", "wall=FILE.inp")

    def test_a_deck_of_calculix_beside_it_is_read(self):
        folder = self.base / "solid"
        folder.mkdir()
        self.addCleanup(shutil.rmtree, folder)
        deck = "** a wall\n*INCLUDE, INPUT=all.msh\n*MATERIAL, NAME=EL\n*ELASTIC\n 3e5, 0.3\n*DENSITY\n1200\n"
        (folder / "tube.inp").write_text(deck + "*STEP\n*DYNAMIC, DIRECT, NLGEOM\n 1e-4, 0.01\n*END STEP\n")
        said = self.refused("<precice-configuration/>", "wall=solid/tube.inp")
        self.assertIn(
            'material = "saint-venant-kirchhoff", young = 300, poisson = 0.3, density = 1.2, time.step = 0.1', said
        )
        (folder / "tube.inp").write_text(deck.replace("3e5, 0.3", "stiff"))
        self.refused("<precice-configuration/>", "line 4: *ELASTIC: has not 2 numbers")

    def test_a_mesh_of_dolfin_is_no_case(self):
        self.refused('<dolfin><mesh celltype="tetrahedron" dim="3"/></dolfin>', "is a mesh of dolfin", "-o FILE.msh")

    def test_each_case_passes_the_drivers_check(self):
        _, folder, _ = self.made(peer.fsi())
        for program in DRIVERS:
            process = attempt(program, folder / "case.toml", "--check")
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertTrue(re.search(r"opening lumen_outlet +Windkessel", process.stdout), process.stdout)


if __name__ == "__main__":
    unittest.main()
