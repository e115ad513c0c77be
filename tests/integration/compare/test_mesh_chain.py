"""Meshes of a scene that several commands make, one from the file of the other, and the words that name them."""

import sys
from pathlib import Path

import synthetic  # noqa: F401: the package's folder onto the path
from folder_case import FolderCase

from fsi_compare.base.errors import InputError
from fsi_compare.gallery.mesh_chain import as_typed, links, make_mesh, with_places
from fsi_compare.study.runner import recipe
from fsi_compare.study.study_file import StudyMesh

# Writes its words, and what is in the files that it is given, to the file behind -o; "fail" ends it with an error.
MAKER = f"""#!{sys.executable}
import os, sys
words = sys.argv[1:]
if "fail" in words:
    sys.exit("fsi-mesh: error: told to fail")
said = [open(w).read() if os.path.isfile(w) else os.path.basename(w) for w in words[:-2]]
open(words[-1], "w").write("(" + " ".join(said) + ")")
"""
SCRIPT = 'import sys\nopen(sys.argv[-1], "w").write("surface of " + sys.argv[1])\n'


class MeshChain(FolderCase):
    def setUp(self):
        super().setUp()
        self.maker = self.base / "fsi-mesh"
        self.maker.write_text(MAKER)
        self.maker.chmod(0o755)
        (self.base / "surface.py").write_text(SCRIPT)
        (self.base / "table.csv").write_text("table")
        self.target = self.base / "made.msh"

    def make(self, text):
        end = make_mesh(with_places(text.split(), self.base), self.target, self.maker, "scene.py: MESH")
        left = [path.name for path in self.base.iterdir()]
        return end, left

    def test_each_command_takes_the_file_of_the_one_before(self):
        end, left = self.make("surface.py 3mm | lumen --edge 0.6 | thicken --thickness-from table.csv")
        self.assertEqual(end.code, 0, end.message)
        self.assertEqual(
            self.target.read_text(), "(thicken (lumen surface of 3mm --edge 0.6 -q) --thickness-from table -q)"
        )
        self.assertEqual(sorted(left), ["fsi-mesh", "made.msh", "surface.py", "table.csv"])

    def test_one_command_is_what_it_was(self):
        self.make("geo tube.geo --order 2")
        self.assertEqual(self.target.read_text(), "(geo tube.geo --order 2 -q)")

    def test_a_command_that_fails_ends_the_chain(self):
        end, left = self.make("surface.py 3mm | lumen fail | thicken")
        self.assertNotEqual(end.code, 0)
        self.assertIn("told to fail", end.message)
        self.assertEqual(sorted(left), ["fsi-mesh", "surface.py", "table.csv"])

    def test_chains_that_make_no_mesh(self):
        for text, message in (
            ("surface.py", "a script makes a surface"),
            ("geo a.geo | surface.py", "a script makes a surface"),
            ("geo a.geo | | thicken", "a command of the mesh is empty"),
            ("geo a.geo |", "a command of the mesh is empty"),
        ):
            with self.subTest(text), self.assertRaisesRegex(InputError, message):
                links(text.split(), Path("made.msh"), "scene.py")

    def test_all_files_that_are_named_decide(self):
        words = with_places("thicken --thickness-from table.csv".split(), self.base)
        mesh = StudyMesh("a", "", ("lumen.geo", "|", *words), "geo")
        before = recipe(mesh)
        self.assertEqual(recipe(mesh), before)
        (self.base / "table.csv").write_text("another")
        self.assertNotEqual(recipe(mesh), before)

    def test_files_between_are_kept_and_found_again(self):
        kept, words = self.base / "parts", with_places(
            "surface.py 3mm | lumen --edge 0.6 | thicken a".split(), self.base
        )
        other = [*words[:-1], "b"]
        for chosen in (words, other):
            self.assertEqual(make_mesh(chosen, self.target, self.maker, "scene.py", kept).code, 0)
        self.assertEqual(self.target.read_text(), "(thicken (lumen surface of 3mm --edge 0.6 -q) b -q)")
        made = {path.name: path.stat().st_mtime_ns for path in kept.iterdir()}
        self.assertEqual(sorted(name.split("-")[0] for name in made), ["lumen", "surface"])  # one of each for both
        make_mesh(words, self.target, self.maker, "scene.py", kept)
        self.assertEqual({path.name: path.stat().st_mtime_ns for path in kept.iterdir()}, made)
        (self.base / "surface.py").write_text(SCRIPT.replace("surface", "another"))
        make_mesh(words, self.target, self.maker, "scene.py", kept)
        self.assertEqual(self.target.read_text(), "(thicken (lumen another of 3mm --edge 0.6 -q) a -q)")
        fails = [word if word != "0.6" else "fail" for word in words]
        self.assertNotEqual(make_mesh(fails, self.target, self.maker, "scene.py", kept).code, 0)
        self.assertEqual(len(list(kept.iterdir())), 4)  # nothing of the one that failed

    def test_commands_as_typed(self):
        words = "surface.py --jitter 0.05 | lumen --edges-per-diameter 5 | thicken --layer wall=100%:2".split()
        self.assertEqual(
            as_typed(words, Path("made.msh"), "scene.py"),
            [
                "python3 surface.py --jitter 0.05 -o made-1.stl",
                "fsi-mesh lumen made-1.stl --edges-per-diameter 5 -o made-2.msh",
                "fsi-mesh thicken made-2.msh --layer wall=100%:2 -o made.msh",
            ],
        )


if __name__ == "__main__":
    import unittest

    unittest.main()
