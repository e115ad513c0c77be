"""Walls whose constants a file or regions give from place to place: both drivers, restart, processes, wrong inputs."""

import unittest

import numpy as np
from programs import DRIVERS, MONOLITHIC, FolderTest, arrays, attempt, differing_arrays, energy, restart, run, summary
from scenes import FLUID, KINDS, WALL, scene
from vtp_files import write_vtp

CASE = """[mesh]
file = "tube.msh"
{fluid}
{wall}
[inlet]
pressure = [[0, 0], [0.5, 1.0]]
[time]
step = 0.125
end = 0.5
[newton]
tolerance = 1e-11
[partitioned]
tolerance = 1e-10
[output]
every = 4
fields = ["displacement", "velocity", "pressure", "von_mises_stress", "constants"]
"""
FROM_FILE = '{ file = "stiffness.csv", field = "c10", within = 1.0 }'
PLAQUE = """[[structure.region]]
name = "plaque"
layers = ["media"]
shape = "sphere"
centre = [1.3, 0.0, 1.5]
radius = 0.8
c10 = 30.0
viscosity = 2.0
"""
SOFT_EDGE = PLAQUE + "transition = 0.6\n"
BOX = """[[structure.region]]
name = "{name}"
layers = ["media"]
shape = "box"
low = [-9.0, -9.0, -9.0]
high = [9.0, 9.0, {high}]
"""


def points(value):
    """A table of points all over the scenes' walls, three-dimensional and in a plane."""
    rows = ["x,y,z,c10"]
    for x in np.linspace(-0.2, 3.2, 14):
        for y in np.linspace(0.0, 2.0, 9):
            rows += [f"{x},{y},{z},{value(x, y, z)}" for z in np.linspace(0.0, 3.0, 11)]
    return "\n".join(rows) + "\n"


class VaryingTest(FolderTest):
    def case(self, wall=WALL, name="case"):
        file = self.base / f"{name}.toml"
        file.write_text(CASE.format(fluid=FLUID, wall=wall))
        return file

    def field(self, value=lambda x, y, z: 3 + x + 0.5 * y + 2 * z):
        (self.base / "stiffness.csv").write_text(points(value))
        return WALL.replace("c10 = 3.0", f"c10 = {FROM_FILE}\nviscosity = 0.5")

    def assertAgree(self, one, other, most):
        """Displacements, velocities and pressures of the last level, relative to the largest of each field."""
        fields = [arrays(folder / "checkpoint.h5") for folder in (one, other)]
        for medium in ("mesh", "wall", "flow"):
            values, others = (of[f"arrays/level0.{medium}"] for of in fields)
            self.assertGreater(np.abs(values).max(), 1e-4)
            self.assertLess(np.abs(values - others).max(), most * np.abs(values).max(), medium)

    def assertInBalance(self, wall, *settings):
        """Of a prestressed wall alone: the shape of the mesh is that under the load, so that nothing moves."""
        case = self.case(wall + "[prestress]\npressure = 0.5\n")
        loaded = case.read_text().replace(FLUID, "").replace("[inlet]", "[load]").replace("[[0, 0], [0.5, 1.0]]", "0.5")
        case.write_text(loaded.replace('"velocity", ', ""))
        folder = run(
            MONOLITHIC,
            case,
            self.base / "balance",
            *scene(self.base, "p2p1", "axisymmetric"),
            *settings,
            "time.end=0.25",
        )
        moved = np.abs(arrays(folder / "checkpoint.h5")["arrays/level0.wall"].reshape(-1, 3)[:, :2]).max()
        self.assertLess(moved, 1e-9)


class LawsWithoutLoopsOfTheirOwn(VaryingTest):
    """They run through the element loops of constants that vary."""

    YEOH = WALL.replace('material = "neo-hookean"\nc10 = 3.0', 'material = "yeoh"\nc10 = 3.0\nc20 = 20.0\nc30 = 400.0')
    FIBRES = WALL.replace(
        'material = "neo-hookean"\nc10 = 3.0',
        'material = "holzapfel-gasser-ogden"\nc10 = 3.0\nk1 = 2.0\nk2 = 0.8\nk1_second = 1.0\nk2_second = 2.0\n'
        "alpha = 29.0\nkappa = 0.1\nviscosity = 0.5",
    )

    def test_drivers_agree_and_restarts_keep_bits(self):
        plain = run(MONOLITHIC, self.case(), self.base / "plain", *scene(self.base, "p1", "axisymmetric"))
        for wall, kind in ((self.YEOH, ("p1", "axisymmetric")), (self.FIBRES, ("p2p1", "axisymmetric"))):
            settings = (*scene(self.base, *kind), "output.every=2")
            case = self.case(wall)
            with self.subTest(kind=kind):
                both = [run(program, case, self.base / f"by{i}", *settings) for i, program in enumerate(DRIVERS)]
                self.assertAgree(*both, 1e-8)
                begun = run(MONOLITHIC, case, self.base / "begun", *settings, "time.end=0.25")
                restart(MONOLITHIC, case, begun, *settings)
                self.assertEqual(differing_arrays(both[0] / "checkpoint.h5", begun / "checkpoint.h5"), [])
                rows = energy(both[0])
                self.assertLess(np.abs(rows["remainder"]).max(), 1e-2 * rows["wall_isochoric_energy"].max())
                if wall is self.YEOH:
                    walls = [arrays(folder / "checkpoint.h5")["arrays/level0.wall"] for folder in (both[0], plain)]
                    apart = np.abs(walls[0] - walls[1]).max()
                    self.assertGreater(apart, 1e-3 * np.abs(walls[1]).max(), "the terms of higher order are seen")

    def test_without_terms_of_higher_order_yeoh_is_neo_hookean(self):
        settings = scene(self.base, "p2p1", "axisymmetric")
        alone = WALL.replace('"neo-hookean"', '"yeoh"')
        folders = [
            run(MONOLITHIC, self.case(wall), self.base / f"by{i}", *settings) for i, wall in enumerate((WALL, alone))
        ]
        self.assertAgree(*folders, 1e-10)

    def test_their_constants_vary_too(self):
        """A field that is constant is the constant, and one that is not is another wall."""
        settings = scene(self.base, "p2p1", "axisymmetric")
        field = '{ file = "stiffness.csv", field = "c10", within = 1.0 }'
        runs = []
        for i, value in enumerate((20.0, None)):
            (self.base / "stiffness.csv").write_text(points(lambda x, y, z: value or 20 + 60 * x))
            wall = self.YEOH.replace("c20 = 20.0", f"c20 = {field}")
            runs.append(run(MONOLITHIC, self.case(wall), self.base / f"painted{i}", *settings))
        constant = run(MONOLITHIC, self.case(self.YEOH), self.base / "constant", *settings)
        self.assertAgree(runs[0], constant, 1e-12)
        walls = [arrays(folder / "checkpoint.h5")["arrays/level0.wall"] for folder in (runs[1], constant)]
        self.assertGreater(np.abs(walls[0] - walls[1]).max(), 1e-4 * np.abs(walls[1]).max())
        shown = [values for name, values in arrays(runs[1] / "fields.h5").items() if "c20" in name.split("/")]
        self.assertGreater(len(shown), 0, "the constant is a field")
        self.assertGreater(len(np.unique(shown[0])), 5)

    def test_a_region_may_give_what_the_layer_leaves_to_follow(self):
        """Outside the region the second family is as the first one, whose constants may vary themselves."""
        settings = scene(self.base, "p2p1", "axisymmetric")
        (self.base / "stiffness.csv").write_text(points(lambda x, y, z: 2 + x))
        for first, edge in (("2.0", SOFT_EDGE), ("2.0", PLAQUE), (FROM_FILE, SOFT_EDGE)):
            alike = self.FIBRES.replace("k1_second = 1.0\nk2_second = 2.0\n", "").replace("k1 = 2.0", f"k1 = {first}")
            region = edge.replace("c10 = 30.0\nviscosity = 2.0\n", "k1_second = 2.0\nk2_second = 0.8\n")
            same = [
                run(MONOLITHIC, self.case(wall), self.base / f"alike{i}", *settings)
                for i, wall in enumerate((alike, alike + region))
            ]
            with self.subTest(first=first, region=region):
                if first == "2.0":
                    self.assertAgree(*same, 1e-10)
                fields = arrays(same[1] / "fields.h5")

                def shown(constant):
                    found = [v for name, v in fields.items() if {constant, "wall"} <= set(name.split("/"))]
                    return found[0][found[0] > 0]  # the other layers have another law

                values = shown("k1_second")
                if first == "2.0":
                    self.assertLess(np.abs(values - 2.0).max(), 1e-6)
                else:
                    self.assertAlmostEqual(values.max(), shown("k1").max(), places=6)
                    self.assertLess(values.min(), shown("k1").min(), "the region has its own")

    def test_a_prestressed_wall_is_in_balance(self):
        for wall in (self.YEOH, self.FIBRES):
            with self.subTest(wall=wall):
                self.assertInBalance(wall, "structure.fibre_frame=cylinder")


class Varying(VaryingTest):
    def test_with_maxwell_branches(self):
        """Branches belong to the layer, also in what a region cuts out of it."""
        branches = "viscosity = 0.5\nmaxwell = [{ shear = 2.0, time = 0.2 }]"
        constant = WALL.replace("c10 = 3.0", f"c10 = 3.0\n{branches}")
        settings = (*scene(self.base, "p2p1", "axisymmetric"), "output.every=2")
        same = self.field(lambda x, y, z: 3.0).replace("viscosity = 0.5", branches)
        runs = [run(MONOLITHIC, self.case(w), self.base / n, *settings) for w, n in ((constant, "one"), (same, "two"))]
        self.assertAgree(*runs, 1e-11)
        wall = self.field().replace("viscosity = 0.5", branches) + PLAQUE.replace("viscosity = 2.0\n", "")
        both = [run(program, self.case(wall), self.base / f"by{i}", *settings) for i, program in enumerate(DRIVERS)]
        self.assertAgree(*both, 1e-8)
        begun = run(MONOLITHIC, self.case(wall), self.base / "begun", *settings, "time.end=0.25")
        restart(MONOLITHIC, self.case(wall), begun, *settings)
        self.assertEqual(differing_arrays(both[0] / "checkpoint.h5", begun / "checkpoint.h5"), [])
        own = PLAQUE + 'material = "neo-hookean"\nmaxwell = [{ shear = 1.0, time = 1.0 }]\n'
        refused = attempt(MONOLITHIC, self.case(WALL + own), "-q", folder=self.base / "no", settings=settings)
        self.assertEqual(refused.returncode, 1, refused.stderr)
        self.assertIn("structure.region.plaque.maxwell", refused.stderr)
        still = self.base / "still.toml"
        still.write_text(f'[mesh]\nfile = "tube.msh"\n{WALL}{SOFT_EDGE}[load]\npressure = 0.5\n[static]\n')
        refused = attempt(MONOLITHIC, still, "-q", folder=self.base / "no", settings=settings)
        self.assertEqual(refused.returncode, 1, refused.stderr)
        self.assertIn("structure.region.plaque.viscosity: resists the rate of strain", refused.stderr)

    def test_drivers_agree(self):
        for kind, wall in zip(KINDS, [self.field(), self.field() + SOFT_EDGE, WALL + PLAQUE] * 2):
            settings = scene(self.base, *kind)
            place = (
                ("structure.region.plaque.centre=[1.5, 1.2, 0.0]",) if kind[1] == "plane" and "plaque" in wall else ()
            )
            with self.subTest(kind=kind, regions=wall.count("[[")):
                folders = [
                    run(program, self.case(wall), self.base / f"run{i}", *settings, *place)
                    for i, program in enumerate(DRIVERS)
                ]
                self.assertAgree(*folders, 1e-8)

    def test_a_field_that_is_constant_is_the_constant(self):
        settings = scene(self.base, "p2p1", "axisymmetric")
        wall = self.field(lambda x, y, z: 3.0).replace("viscosity = 0.5", "")
        varying = run(MONOLITHIC, self.case(wall), self.base / "varying", *settings)
        constant = run(MONOLITHIC, self.case(), self.base / "constant", *settings)
        self.assertAgree(varying, constant, 1e-10)

    def test_a_field_of_vtk_is_that_of_the_table(self):
        """Points with a field, in each of the encodings that programs write."""
        settings = scene(self.base, "p2p1", "axisymmetric")
        wall = self.field()
        table = run(MONOLITHIC, self.case(wall), self.base / "table", *settings)
        rows = np.loadtxt(self.base / "stiffness.csv", delimiter=",", skiprows=1)
        for form in ("ascii", "binary", "zlib", "raw"):
            write_vtp(self.base / "stiffness.vtp", rows[:, :3], np.zeros((0, 3), dtype=int), form, c10=rows[:, 3])
            case = self.case(wall.replace("stiffness.csv", "stiffness.vtp"))
            folder = run(MONOLITHIC, case, self.base / "vtk", *settings)
            self.assertEqual(differing_arrays(table / "checkpoint.h5", folder / "checkpoint.h5"), [], form)

    def test_a_region_is_a_volume_of_the_mesh(self):
        """One that takes the whole of a layer, with a material of its own, is that layer with the material."""
        settings = scene(self.base, "p2p1", "axisymmetric")
        cover = """[[structure.region]]
name = "all"
layers = ["media"]
shape = "box"
low = [-9.0, -9.0, -9.0]
high = [9.0, 9.0, {high}]
material = "mooney-rivlin"
c10 = 2.0
c01 = 0.5
"""
        other = WALL.replace('material = "neo-hookean"\nc10 = 3.0', 'material = "mooney-rivlin"\nc10 = 2.0\nc01 = 0.5')
        self.assertNotEqual(other, WALL)
        half = WALL + cover.format(high=1.5)
        mixed = run(MONOLITHIC, self.case(half), self.base / "mixed", *settings)
        ends = other + cover.format(high=1.5).replace(
            '"mooney-rivlin"\nc10 = 2.0\nc01 = 0.5', '"neo-hookean"\nc10 = 3.0'
        )
        turned = run(
            MONOLITHIC,
            self.case(
                ends.replace("low = [-9.0, -9.0, -9.0]", "low = [-9.0, -9.0, 1.5]").replace(
                    "high = [9.0, 9.0, 1.5]", "high = [9.0, 9.0, 9.0]"
                )
            ),
            self.base / "turned",
            *settings,
        )
        self.assertAgree(mixed, turned, 1e-9)
        plain = run(MONOLITHIC, self.case(), self.base / "plain", *settings)
        with self.assertRaises(AssertionError):
            self.assertAgree(mixed, plain, 1e-3)

    def test_a_region_has_a_field(self):
        """Of whole elements, with a transition, and with a file that has values in the region only."""
        settings = scene(self.base, "p2p1", "axisymmetric")
        wall = self.field()
        field = f"c10 = {FROM_FILE}\n"
        low = BOX.format(name="low", high=1.5)
        high = BOX.format(name="high", high=9.0).replace("-9.0, -9.0, -9.0", "-9.0, -9.0, 1.5")
        number = WALL.replace("c10 = 3.0", "c10 = 20.0\nviscosity = 0.5")
        below = run(MONOLITHIC, self.case(number + low + field), self.base / "below", *settings)
        above = run(MONOLITHIC, self.case(wall + high + "c10 = 20.0\n"), self.base / "above", *settings)
        self.assertAgree(below, above, 1e-9)
        own = low + field + 'material = "neo-hookean"\nviscosity = 0.5\n'
        self.assertAgree(below, run(MONOLITHIC, self.case(number + own), self.base / "own", *settings), 1e-9)
        whole = run(MONOLITHIC, self.case(wall), self.base / "whole", *settings)
        both = number + BOX.format(name="all", high=9.0) + field + "transition = 0.2\n"
        self.assertAgree(whole, run(MONOLITHIC, self.case(both), self.base / "both", *settings), 1e-11)
        rows = (self.base / "stiffness.csv").read_text().splitlines()
        (self.base / "stiffness.csv").write_text(
            "\n".join(r for r in rows if r[0] == "x" or float(r.split(",")[2]) < 1.9)
        )
        near = number + low + field.replace("within = 1.0", "within = 0.35") + "transition = 0.2\n"
        runs = [run(program, self.case(near), self.base / f"near{i}", *settings) for i, program in enumerate(DRIVERS)]
        self.assertAgree(*runs, 1e-8)
        entry = summary(runs[0])["varying_constants"][0]
        self.assertEqual(entry["sources"], ["region low", "stiffness.csv"])
        self.assertEqual(entry["largest"], 20)
        far = near.replace("high = [9.0, 9.0, 1.5]", "high = [9.0, 9.0, 2.9]")
        refused = attempt(MONOLITHIC, self.case(far), "-q", folder=self.base / "far", settings=settings)
        self.assertEqual(refused.returncode, 1, refused.stderr)
        self.assertRegex(refused.stderr, r"stiffness\.csv: structure\.region\.low\.c10: has a hole at \(")
        self.field(lambda x, y, z: 4.0)
        again = attempt(
            MONOLITHIC, self.case(near), "-q", "--restart", runs[0], folder=self.base / "near0", settings=settings
        )
        self.assertEqual(again.returncode, 1, again.stderr)
        self.assertIn("structure.region.low.c10", again.stderr)

    def test_a_run_goes_on_with_the_same_bits_and_knows_its_field(self):
        settings = scene(self.base, "p2p1", "axisymmetric")
        case = self.case(self.field() + SOFT_EDGE)
        for program in DRIVERS:
            whole = run(program, case, self.base / "whole", *settings)
            begun = run(program, case, self.base / "begun", *settings, "time.end=0.25")
            self.assertEqual(restart(program, case, begun, *settings), begun)
            self.assertEqual(differing_arrays(whole / "checkpoint.h5", begun / "checkpoint.h5"), [])
        good = case.read_text()
        for field, text, said in (
            (4.0, good, "structure.layers.media.c10"),
            (None, good.replace("radius = 0.8", "radius = 0.9"), "structure.region.plaque.radius"),
        ):
            self.field(*([] if field is None else [lambda x, y, z: field]))
            case.write_text(text)
            refused = attempt(program, case, "-q", "--restart", begun, folder=begun, settings=settings)
            self.assertEqual(refused.returncode, 1, refused.stderr)
            self.assertIn(said, refused.stderr)

    def test_log_and_fields_show_the_constants(self):
        folder = run(
            MONOLITHIC, self.case(self.field() + PLAQUE), self.base / "shown", *scene(self.base, "p1", "axisymmetric")
        )
        log = (folder / "run.log").read_text()
        self.assertRegex(log, r"structure\.region\.plaque: \d+ elements of media are media/plaque")
        self.assertRegex(log, r"structure\.layers\.media\.c10 varies from [\d.]+ to [\d.]+ kPa, mean [\d.]+")
        varying = {entry["constant"]: entry for entry in summary(folder)["varying_constants"]}
        self.assertEqual(list(varying), ["c10"], "the viscosity is a number")
        said = varying["c10"]
        self.assertEqual((said["layer"], said["unit"], said["sources"]), ("media", "kPa", ["stiffness.csv"]))
        # 3 + x + y / 2 + 2 z of points with x in [-0.2, 3.2], y in [0, 2] and z in [0, 3] mm.
        self.assertTrue(2.8 < said["smallest"] < said["mean"] < said["largest"] < 13.2, said)
        found = {name: values for name, values in arrays(folder / "fields.h5").items() if "c10" in name.split("/")}
        self.assertGreater(len(found), 0)
        values = next(iter(found.values()))
        self.assertEqual(values.max(), 30)
        self.assertAlmostEqual(values.min(), 0.3)
        self.assertGreater(len(np.unique(values)), 5)

    def test_a_prestressed_wall_is_in_balance(self):
        """The shape of the mesh is that under the load, whatever the constants: nothing moves under it."""
        wall = WALL + PLAQUE.replace("viscosity = 2.0\n", "")
        for transition in ("0.0", "0.6"):
            self.assertInBalance(wall, f"structure.region.plaque.transition={transition}")


class Shared(VaryingTest):
    """Several processes."""

    def test_three_processes_with_quadratic_cells(self):
        """All at once: a field, one in a region with a transition, whole elements, Maxwell branches; and on with one."""
        settings = scene(self.base, "p2p1", "3d")
        media = self.field().replace("viscosity = 0.5", "maxwell = [{ shear = 2.0, time = 0.2 }]")
        soft = BOX.format(name="low", high=1.0) + f"c10 = {FROM_FILE}\ntransition = 0.4\n".replace(
            "c10", "viscosity", 1
        )
        case = self.case(media + soft + PLAQUE)
        for program in DRIVERS:
            alone = run(program, case, self.base / "alone", *settings)
            together = run(program, case, self.base / "together", *settings, processes=3)
            self.assertAgree(alone, together, 1e-8)
            kept, others = (arrays(folder / "checkpoint.h5")["arrays/level0.branches"] for folder in (alone, together))
            self.assertLess(np.abs(kept - others).max(), 1e-8 * np.abs(kept).max())
            begun = run(program, case, self.base / "begun", *settings, "time.end=0.25", processes=3)
            restart(program, case, begun, *settings)
            self.assertAgree(alone, begun, 1e-8)
            ranges = [summary(folder)["varying_constants"] for folder in (alone, together)]
            for one, other in zip(*ranges):
                for name in ("smallest", "mean", "largest"):
                    self.assertAlmostEqual(one[name], other[name], delta=1e-12 * one["largest"])

    def test_processes_agree_with_one(self):
        settings = scene(self.base, "p1", "3d")
        case = self.case(self.field() + SOFT_EDGE)
        for program, processes in zip(DRIVERS, (2, 3)):
            alone = run(program, case, self.base / "alone", *settings)
            together = run(program, case, self.base / "together", *settings, processes=processes)
            self.assertAgree(alone, together, 1e-8)
            fields = [arrays(folder / "fields.h5") for folder in (alone, together)]
            names = [name for name in fields[0] if "c10" in name.split("/")]
            self.assertTrue(names)
            for name in names:
                self.assertLess(np.abs(fields[0][name] - fields[1][name]).max(), 1e-12)

    def test_a_hole_ends_all_with_one_line(self):
        settings = scene(self.base, "p1", "3d")
        refused = attempt(
            MONOLITHIC,
            self.case(self.field()),
            "-q",
            folder=self.base / "hole",
            processes=2,
            settings=(*settings, "structure.layers.media.c10.within=0.01"),
        )
        self.assertEqual(refused.returncode, 1, refused.stderr)
        self.assertIn("has a hole at (", refused.stderr)
        self.assertFalse((self.base / "hole").exists())


class BadFields(VaryingTest):
    def refused(self, wall, *settings):
        answer = attempt(
            MONOLITHIC,
            self.case(wall),
            "-q",
            folder=self.base / "none",
            settings=(*scene(self.base, "p1", "axisymmetric"), *settings),
        )
        self.assertEqual(answer.returncode, 1, answer.stderr)
        self.assertFalse((self.base / "none").exists())
        # Viscous layers, whose stresses are asked for, are warned of.
        errors = [line for line in answer.stderr.splitlines() if ": warning: " not in line]
        self.assertEqual(len(errors), 1, answer.stderr)
        return answer.stderr

    def test_files(self):
        wall = self.field()
        table = self.base / "stiffness.csv"
        good = table.read_text()
        for change, said in (
            (("0.0,0.0,", "0.0,nan,", 1), "no number"),
            ((",c10\n", ",c01\n", 1), "column c10"),
            (("x,", "a,", 1), "column x"),
            (("\n", "\n0,0,0,-1\n", 1), "c10 = -1 at (0, 0, 0) mm is not positive"),
            (("\n", "\n0,0,0,nan\n", 1), "nan at (0, 0, 0) mm, no finite number"),
            (("\n", "\n0,0,0,\n", 1), "nan at (0, 0, 0) mm, no finite number"),
        ):
            table.write_text(good.replace(*change))
            with self.subTest(said=said):
                self.assertIn(said, self.refused(wall))
        table.write_text(good)
        self.assertIn("has a hole at (", self.refused(wall.replace("within = 1.0", "within = 0.01")))
        self.assertIn("no such file", self.refused(wall.replace("stiffness.csv", "other.csv")))
        self.assertIn("the extension .txt", self.refused(wall.replace("stiffness.csv", "other.txt")))
        self.assertIn("did you mean structure.layers.media.c10.field?", self.refused(wall.replace("field =", "feld =")))
        self.assertIn("is not positive", self.refused(wall.replace("within = 1.0", "within = -1.0")))
        write_vtp(self.base / "other.vtp", np.eye(3), np.array([[0, 1, 2]]), "ascii", hardness=np.ones(3))
        self.assertIn(
            '"c10" is none of its fields; give hardness', self.refused(wall.replace("stiffness.csv", "other.vtp"))
        )
        (self.base / "torn.vtu").write_text("<VTKFile type='UnstructuredGrid'")
        self.assertIn("is cut off", self.refused(wall.replace("stiffness.csv", "torn.vtu")))

    def test_regions(self):
        for change, said in (
            (("radius = 0.8", "radius = 0.01"), "no element of media has its centre in it"),
            (("radius = 0.8", "radius = 0.01\ntransition = 0.001"), "no element of media lies in it"),
            (("radius = 0.8", ""), "radius: missing"),
            (("radius = 0.8", "radius = -1"), "is not positive"),
            (("radius = 0.8", "radius = 0.8\nlow = [0, 0, 0]"), "is no key of a sphere"),
            (('"sphere"', '"ball"'), '"ball" is unknown'),
            (('["media"]', '["intima"]'), '"intima" is no layer'),
            (("c10 = 30.0", "c10 = -3.0"), "is not positive"),
            (("c10 = 30.0", "k1 = 3.0"), "no constant of neo-hookean, the material of media; did you mean c10?"),
            (("c10 = 30.0\nviscosity = 2.0\n", ""), "has no constants"),
            (('name = "plaque"\n', ""), "name: missing"),
        ):
            with self.subTest(said=said):
                self.assertIn(said, self.refused(WALL + PLAQUE.replace(*change)))
        painted = 'shape = "surface"\nfile = "paint.stl"\nwithin = 0.3\n'
        sphere = 'shape = "sphere"\ncentre = [1.3, 0.0, 1.5]\nradius = 0.8\n'
        self.assertIn("paint.stl: no such file", self.refused(WALL + PLAQUE.replace(sphere, painted)))
        self.assertIn("leave no element to media/plaque", self.refused(WALL + PLAQUE + PLAQUE.replace("plaque", "cap")))

    def test_units(self):
        """Pascals where kilopascals are meant are told, and the run goes on."""
        wall = self.field(lambda x, y, z: 3e6)
        said = attempt(MONOLITHIC, self.case(wall), "--check", settings=scene(self.base, "p1", "axisymmetric"))
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("looks like a value in", said.stderr)

    def test_a_field_in_cm_and_dynes(self):
        """It is refused with the unit that explains it, told that 1e5 are 10 kPa then, and read with both units."""
        settings = scene(self.base, "p1", "axisymmetric")
        wall = self.field(lambda x, y, z: 1e5)
        rows = (self.base / "stiffness.csv").read_text().splitlines()
        in_cm = [rows[0]] + [
            ",".join([*(str(float(x) / 10) for x in row.split(",")[:3]), row.split(",")[3]]) for row in rows[1:]
        ]
        (self.base / "stiffness.csv").write_text("\n".join(in_cm) + "\n")
        wall = wall.replace("within = 1.0", "within = 0.5")
        refused = attempt(MONOLITHIC, self.case(wall), folder=self.base / "none", settings=settings)
        self.assertEqual(refused.returncode, 1, refused.stderr)
        said = refused.stderr.splitlines()[-1]
        for words in ("has a hole at (", 'times 10 its places would fit: give length_unit = "cm"', "to be 10 kPa"):
            self.assertIn(words, said)
        both = wall.replace("within = 0.5", 'within = 0.5, length_unit = "cm"')
        said = attempt(MONOLITHIC, self.case(both), "--check", settings=settings)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn('looks like a value in dyn/cm^2; did you mean 10 kPa? Give unit = "dyn/cm^2"', said.stderr)
        units = both.replace('"cm"', '"cm", unit = "dyn/cm^2"')
        said = attempt(MONOLITHIC, self.case(units), "--check", settings=settings)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertNotIn("looks like", said.stderr)
        self.assertIn("varies from 10 to 10 kPa", said.stdout)
        wall = wall.replace("stiffness.csv", "soft.csv")  # as it should be, without a warning
        (self.base / "soft.csv").write_text(points(lambda x, y, z: 3))
        self.assertIn(
            "is no known unit of length",
            self.refused(wall.replace("within = 0.5", 'within = 0.5, length_unit = "furlong"')),
        )
        self.assertIn(
            "is no known unit of c10", self.refused(wall.replace("within = 0.5", 'within = 0.5, unit = "mm"'))
        )


if __name__ == "__main__":
    unittest.main()
