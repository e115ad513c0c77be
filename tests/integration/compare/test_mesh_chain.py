"""Meshes of a scene that several commands make, one from the file of the other, and the words that name them."""

import sys
from pathlib import Path

import synthetic  # noqa: F401: the package's folder onto the path
from folder_case import FolderCase

from fsi_compare.base.errors import InputError
from fsi_compare.studies.gallery.mesh_chain import links, make_mesh, with_places
from fsi_compare.studies.running.runner import recipe
from fsi_compare.studies.running.study_file import StudyMesh

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

    def test_a_chain_makes_no_family(self):
        case = self.base / "case.toml"
        case.write_text('[mesh]\nfile = "no.msh"\n[time]\nstep = 1\nend = 2\n')
        driver = self.base / "fsi-monolithic"
        driver.write_text("#!/bin/sh\necho fsi-monolithic 1.2.3\n")
        driver.chmod(0o755)
        words = ["--monolithic", driver, "--mesh", "geo a.geo | thicken --layer a=1"]
        code, _, err = self.call("verify", case, "-o", self.out, *words)
        self.assertEqual(code, 1)
        self.assertIn("--mesh: a mesh of several commands makes no family of meshes; make its mesh", err)


if __name__ == "__main__":
    import unittest

    unittest.main()
