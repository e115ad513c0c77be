"""`fsi-compare verify` of meshes that several commands make: which words a family changes, and what it says."""

import json
import os
import re
import subprocess
import tomllib
import unittest
from pathlib import Path

import fake_family
from fake_family import A, B, STEP, behave, calls
from test_verify_command import CASE, VerifyCase

from fsi_compare.verify.chain_sizes import GROWTH, Lumen, apart, sized, times

SURFACE = """\
import sys
open(sys.argv[-1], "w").write("surface")
open(__file__ + ".calls", "a").write("x")
"""
HERE = Path(".")


def changed(text, factor):
    words = apart(text.split())
    return " ".join(sized(words, "--mesh").finer(factor, HERE))


class Words(unittest.TestCase):
    """Of single commands."""

    def test_own_mesh_has_the_words_as_they_are(self):
        for text in ("lumen a.stl --edge-length 0.70 --layers 3", "thicken --layer media=0.40", "a.py --edge 0.6"):
            self.assertEqual(changed(text, 1.0), text)

    @unittest.skipUnless(os.environ.get("FSI_COMPARE"), "FSI_COMPARE names the built program, beside which fsi-mesh is")
    def test_growth_of_layers_is_the_program_s(self):
        program = Path(os.environ["FSI_COMPARE"]).with_name("fsi-mesh")
        text = subprocess.run([program, "lumen", "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
        self.assertEqual(float(re.search(r"--growth .*=([0-9.]+)\n", text).group(1)), GROWTH)

    def test_edges_of_a_lumen(self):
        others = "--opening in=1,0,-12 --cut in=2 --extension in=1 --smoothing 20"
        self.assertEqual(
            changed(f"lumen a.stl --edges-per-diameter 6 {others}", 1.5), f"lumen a.stl --edges-per-diameter 9 {others}"
        )
        self.assertEqual(
            changed(f"lumen a.stl --edge-length=0.9 {others}", 1.5), f"lumen a.stl --edge-length 0.6 {others}"
        )
        curved = "lumen a.stl --edge-length 0.9 --edges-per-curvature 8 --shortest-edge 0.3"
        self.assertEqual(
            changed(curved, 2.0), "lumen a.stl --edge-length 0.45 --edges-per-curvature 16 --shortest-edge 0.15"
        )

    def test_thin_layers_keep_their_thickness_and_their_growth(self):
        def layers(text):
            n, growth, first = (
                float(re.search(rf"--{name} (\S+)", text)[1]) for name in ("layers", "growth", "first-thickness")
            )
            return n, first * sum(growth**k for k in range(int(n))), growth**n

        own = "lumen a.stl --edge-length 1 --layers 4 --growth 1.3 --first-thickness 0.05"
        for factor, number in ((0.5, 2), (1.5, 6), (2.0, 8)):
            made = layers(changed(own, factor))
            self.assertEqual(made[0], number)
            self.assertAlmostEqual(made[1], layers(own)[1], places=7)
            self.assertAlmostEqual(made[2], 1.3**4, places=7)
        stokes = changed("lumen a.stl --edge-length 1 --layers 4 --womersley 3", 2.0)
        self.assertIn("--layers 8", stokes)
        self.assertIn("--womersley 3", stokes)
        self.assertNotIn("--first-thickness", stokes)
        self.assertAlmostEqual(float(re.search(r"--growth (\S+)", stokes)[1]) ** 8, 1.2**4, places=7)
        self.assertEqual(Lumen(tuple(own.split())).counts, [4])

    def test_wall_keeps_its_thickness(self):
        two = "thicken --layer media=0.4:2 adventitia=0.2 --thickness-smoothing 5 --layer outer=0.1:3"
        self.assertEqual(
            changed(two, 2.0),
            "thicken --layer media=0.4:4 adventitia=0.2:2 --thickness-smoothing 5 --layer outer=0.1:6",
        )
        self.assertEqual(
            changed("thicken --layer=media=60%:2 --thickness-ratio 0.25", 0.5),
            "thicken --layer media=60%:1 --thickness-ratio 0.25",
        )
        command = sized(two.split(), "--mesh")
        self.assertEqual(command.elements, {"media": 2, "adventitia": 1, "outer": 3})
        self.assertEqual(command.counts, [2, 3])  # one element cannot become fewer

    def test_one_element_stays_one_at_a_ratio_of_one_and_a_half(self):
        self.assertEqual([times(1, f) for f in (0.3, 1 / 1.5, 1.4, 1.5, 1.96, 2.25)], [1, 1, 1, 1, 2, 2])
        self.assertEqual([times(2, f) for f in (0.5, 1.5, 2)], [1, 3, 4])


class Chains(VerifyCase):
    LUMEN = "lumen --edges-per-diameter 6 --opening in=0,0,-12"
    WALL = "thicken --layer media=0.4 --layer adventitia=0.2"

    def setUp(self):
        super().setUp()
        self.script = self.base / "surface.py"
        self.script.write_text(SURFACE)
        self.words = f"{self.script} --jitter 0.05 | {self.LUMEN} | {self.WALL}"

    def chain(self, *words, mesh=None):
        return self.verify("--mesh", mesh or self.words, *words, mesh=False)

    def made(self, name):
        return [line.split(f" {name} ")[1] for line in calls(self.programs) if f"fsi-mesh {name} " in line]

    def test_each_command_is_made_finer_and_coarser(self):
        code, out, err = self.chain()
        self.assertEqual(code, 0, err)
        edges = {re.search(r"--edges-per-diameter (\S+)", line)[1] for line in self.made("lumen")}
        self.assertEqual(edges, {"4", "6", "9"})
        self.assertTrue(all("--opening in=0,0,-12" in line for line in self.made("lumen")))
        self.assertTrue(all("--layer media=0.4 --layer adventitia=0.2 " in line for line in self.made("thicken")))
        row = self.bars()["tip: displacement x, at the end"]
        self.assertEqual(row["verdict"], "converges as its elements do")
        self.assertAlmostEqual(float(row["order_mesh"]), 3, delta=0.05)
        self.assertIn("as many in all meshes (media: 1, adventitia: 1)", out)
        notes = json.loads((self.out / "verification.json").read_text())["notes"]
        self.assertIn("Meshes: fsi-mesh surface.py --jitter 0.05 | lumen", notes[0])
        self.assertIn("smoothed surface", notes[1])

    def test_surface_is_made_once_and_all_is_found_again(self):
        self.chain()
        self.assertEqual(self.script.with_name("surface.py.calls").read_text(), "x")
        parts = sorted(path.name.split("-")[0] for path in (self.out / "meshes" / "parts").iterdir())
        self.assertEqual(parts, ["lumen"] * 3 + ["surface"])
        before = len(calls(self.programs))
        self.chain()
        self.assertFalse([line for line in calls(self.programs)[before:] if "-o" in line])
        self.script.write_text(SURFACE.replace("surface", "vessel"))  # another vessel
        self.chain()
        self.assertEqual(len(self.made("thicken")), 6)

    def test_mesh_that_is_lost_is_made_of_the_kept_lumen(self):
        self.chain()
        for lost in (self.out / "meshes").glob("tube-x1.5*"):
            lost.unlink()
        self.chain()
        self.assertEqual((len(self.made("lumen")), len(self.made("thicken"))), (3, 4))

    def test_script_and_wall(self):
        code, out, err = self.chain(mesh=f"geo {self.geo} | thicken --layer wall=0.3:2")
        self.assertEqual(code, 0, err)
        layers = {re.search(r"--layer (\S+)", line)[1] for line in self.made("thicken")}
        self.assertEqual(
            layers, {"wall=0.3:1", "wall=0.3:2", "wall=0.3:4"}
        )  # twos, so that the wall's elements stay whole
        sizes = {re.search(r"size=(\S+)", line)[1] for line in self.made("geo")}
        self.assertEqual(sizes, {"0.5", "1", "2"})
        self.assertNotIn("as many in all meshes", out)
        self.assertNotIn("smoothed surface", (self.out / "verification.json").read_text())

    def test_lumen_that_fails_leaves_the_other_meshes(self):
        behave(self.programs, end={"--edges-per-diameter 9": [1, "the wall folds at (1, 2, 3)"]})
        code, _, err = self.chain()
        self.assertEqual(code, 2)
        self.assertIn("the mesh of size 0.667 cannot be made", err)
        self.assertIn("the wall folds", err)

    def test_demanded_error(self):
        code, _, err = self.chain("--error", "2%", "--of", "displacement")
        self.assertEqual(code, 0, err)
        text = (self.out / "found.toml").read_text()
        found = tomllib.loads(text)
        step, size = found["time"]["step"], fake_family.size_of(found["mesh"]["file"])
        self.assertLess(A * size**3 + B * (step / STEP) ** 2, 0.02)
        self.assertIn(f"#   python3 {self.script} --jitter 0.05 -o found-1.stl\n", text)
        self.assertRegex(text, r"#   fsi-mesh lumen found-1.stl --edges-per-diameter [\d.]+ .*-o found-2.msh\n")
        self.assertIn("#   fsi-mesh thicken found-2.msh --layer media=0.4", text)

    def test_adapted_meshes_halve_the_chains_own(self):
        code, _, err = self.chain("--adapt", "--of", "displacement")
        self.assertEqual(code, 0, err)
        self.assertEqual(len(self.made("thicken")), 1)
        self.assertTrue(self.made("adapt")[0].startswith(str(self.out / "meshes" / "tube-x1.msh")))
        self.assertNotIn("--geo", self.made("adapt")[0])
        text = (self.out / "report.md").read_text()
        self.assertIn("cells are halved", text)
        self.assertIn("is in no bar. It is where the meshes are made of the shape: by the commands of", text)

    def test_scene_of_the_gallery_needs_no_words(self):
        scene = self.base / "vessel"
        scene.mkdir()
        (scene / "surface.py").write_text(SURFACE)
        (scene / "vessel.toml").write_text(CASE)
        (scene / "scene.py").write_text(
            f'"""A vessel\n\nOf a surface."""\nMESH = "surface.py | {self.LUMEN} | {self.WALL}"\n'
            "numbers = draw = lambda runs: []\n"
        )
        self.case = scene / "vessel.toml"
        code, _, err = self.verify(mesh=False)
        self.assertEqual(code, 0, err)
        self.assertEqual(len(self.made("lumen")), 3)
        self.assertTrue((scene / "surface.py.calls").exists())

    def test_mistakes(self):
        (self.base / "lumen.msh").write_text("")
        (self.base / "lumen.geo").write_text("")
        (self.base / "a.stl").write_text("")
        surface, lumen = self.base / "a.stl", self.base / "lumen.msh"
        for text, said in (
            (f"lumen {surface} | {self.WALL}", "edges are as long as those of the surface, which is no size"),
            (f"lumen {surface} --edge-length 1 --edges-per-curvature 8", "give --shortest-edge MM beside it"),
            (f"lumen {surface} --edges-per-diameter six | {self.WALL}", "'six' is no positive number"),
            (f"lumen {self.base / 'b.stl'} --edge-length 1 | {self.WALL}", "there is no such file"),
            (f"thicken {lumen} --layer a=1", f"{lumen.with_suffix('.geo')} | thicken ...\", without"),
            (f"thicken {surface} --layer a=1", "filled from a surface whose triangles stay"),
            (f"{self.script} | thicken --layer a=1", "filled from a surface whose triangles stay"),
            (f"geo {self.geo} | thicken --layer a", "is no layer"),
            (f"geo {self.geo} | thicken --layer a=1 -o wall.msh", "leave it out"),
            (f"geo {self.geo} | smooth", "'smooth' makes no family of meshes"),
            (f"import a.vtu | {self.WALL}", "'import' makes no family of meshes"),
            (f"geo {self.geo} | ", "a command of the mesh is empty"),
            (f"geo '{self.geo} | thicken", "No closing quotation"),
        ):
            with self.subTest(text):
                code, _, err = self.chain(mesh=text)
                self.assertEqual(code, 1)
                self.assertEqual(len([line for line in err.splitlines() if "error:" in line]), 1, err)
                self.assertIn(said, err)
                self.assertEqual(calls(self.programs), [])


if __name__ == "__main__":
    unittest.main()
