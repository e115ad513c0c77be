"""Study files: what is refused, and in which words; what a good one asks for."""

import unittest
import unittest.mock

from folder_case import FolderCase

from fsi_compare.base.errors import InputError
from fsi_research.studies import CATALOGUE, FOLDER
from fsi_compare.study.study_file import read_study

GOOD = """\
title = "A study"
kind = "runs"
threads = 1
set = { time.end = 1.0 }
[cases]
tube = "tube.toml"
pipe = "pipe.toml"
[methods.mono]
program = "fsi-monolithic"
[methods.part]
program = "fsi-partitioned"
label = "by turns"
set = { partitioned.scheme = "aitken", time.end = 2.0 }
[meshes.flat]
options = ["--axial-size", "0.2"]
[runs.steps]
cases = ["tube"]
vary = { "time.step" = [0.1, 0.2], mesh = ["coarse", "flat"] }
[runs.parts]
vary = { processes = [1, 3] }
[runs.loads]
methods = ["mono"]
[runs.loads.vary]
load = [{ label = "none", set = { inlet.pressure = 0.0 } }, { label = "one", set = { inlet.pressure = 1.0 } }]
[runs.loads.quick]
cases = ["pipe"]
"""


class StudyFile(FolderCase):
    def setUp(self):
        super().setUp()
        self.path = self.base / "study.toml"
        for name in ("tube", "pipe"):
            (self.path.parent / f"{name}.toml").write_text("")

    def read(self, text, quick=False):
        self.path.write_text(text)
        return read_study(self.path, CATALOGUE.kinds, quick)

    def refused(self, old, new, *expected):
        self.assertIn(old, GOOD)
        with self.assertRaises(InputError) as caught:
            self.read(GOOD.replace(old, new, 1))
        message = str(caught.exception)
        self.assertNotIn("\n", message)
        for text in (str(self.path), *expected):
            self.assertIn(text, message)

    def test_a_good_one(self):
        study = self.read(GOOD)
        self.assertEqual(len(study.requests), 2 * 4 + 2 * 2 * 2 + 2 * 2)
        first = study.requests[0]
        self.assertEqual((first.group, first.case, first.method.name), ("steps", "tube", "mono"))
        self.assertEqual(dict(first.values), {"time.step": 0.1, "mesh": "coarse"})
        self.assertEqual(dict(first.settings), {"time.end": 1.0, "time.step": 0.1})
        self.assertEqual(first.mesh.name, "coarse")
        part = next(r for r in study.requests if r.method.name == "part")
        self.assertEqual(part.settings["time.end"], 2.0)  # the method's own above the study's
        self.assertEqual((part.method.label, part.settings["partitioned.scheme"]), ("by turns", "aitken"))
        load = study.requests[-1]
        self.assertEqual((load.values["load"], load.settings["inlet.pressure"]), ("one", 1.0))

    def test_processes(self):
        study = self.read(GOOD)
        parts = [request for request in study.requests if request.group == "parts"]
        self.assertEqual([request.processes for request in parts], [1, 3] * 4)
        self.assertEqual(parts[1].label, "tube, mono, processes 3")
        self.assertEqual({r.processes for r in study.requests if r.group != "parts"}, {None})
        pair = '[{ label = "a", mesh = "flat", processes = 2 }, { label = "b", processes = 5 }]'
        study = self.read(GOOD.replace("processes = [1, 3]", f"weak = {pair}"))
        found = [(r.processes, r.mesh and r.mesh.name) for r in study.requests if r.group == "parts"][:2]
        self.assertEqual(found, [(2, "flat"), (5, None)])

    def test_processes_up_to_the_cores(self):
        for cores, expected in ((1, [1]), (2, [1, 2]), (6, [1, 2, 4, 6]), (8, [1, 2, 4, 8])):
            with unittest.mock.patch("fsi_compare.study.study_file.usable_cores", lambda n=cores: n):
                study = self.read(GOOD.replace("[1, 3]", '"cores"'))
            self.assertEqual([r.processes for r in study.requests if r.group == "parts"][: len(expected)], expected)

    def test_quick_form(self):
        study = self.read(GOOD, quick=True)
        self.assertEqual({(r.group, r.case) for r in study.requests}, {("loads", "pipe")})

    def test_not_a_study(self):
        for text, expected in (
            ("", "kind: is missing"),
            ("title =", "is not TOML"),
            ("kind = 3", "kind: is not a text"),
        ):
            with self.assertRaises(InputError) as caught:
                self.read(text)
            self.assertIn(expected, str(caught.exception))
        with self.assertRaises(InputError) as caught:
            read_study(self.path.parent / "none.toml", CATALOGUE.kinds)
        self.assertIn("none.toml: no such study", str(caught.exception))

    def test_misspelt_names_with_the_nearest(self):
        self.refused("threads = 1", "treads = 1", "treads: is unknown", "did you mean 'threads'?")
        self.refused('label = "by turns"', 'lable = "by turns"', "methods.part.lable: is unknown", "'label'")
        self.refused('kind = "runs"', 'kind = "run"', "kind: 'run' is unknown", "did you mean 'runs'?")
        self.refused('cases = ["tube"]', 'cases = ["tub"]', "runs.steps", "'tub' is unknown", "did you mean 'tube'?")
        self.refused('methods = ["mono"]', 'methods = ["momo"]', "runs.loads", "did you mean 'mono'?")
        self.refused('"coarse", "flat"', '"coarse", "flut"', "runs.steps.vary.mesh", "did you mean 'flat'?")
        self.refused("[runs.loads.quick]", "[runs.loads.quik]", "runs.loads.quik", "did you mean 'quick'?")

    def test_bad_programs_cases_and_meshes(self):
        self.refused(
            'program = "fsi-monolithic"',
            'program = "fsi-mono"',
            "methods.mono.program",
            "did you mean 'fsi-monolithic'?",
        )
        self.refused('program = "fsi-monolithic"', "", "methods.mono.program: is missing")
        self.refused('tube = "tube.toml"', 'tube = "tub.toml"', "cases.tube", "no such case file")
        self.refused(
            'options = ["--axial-size", "0.2"]', 'options = "--axial-size"', "meshes.flat.options", "list of words"
        )
        self.refused("[meshes.flat]", "[meshes.coarse]", "meshes.coarse", "a level's name already")

    def test_bad_values(self):
        self.refused("threads = 1", "threads = 0", "threads: 0 is not a whole number from 1")
        self.refused("threads = 1", "time_limit = -3", "time_limit: -3 is not a positive number")
        self.refused("[0.1, 0.2]", "0.1", "runs.steps.vary.time.step", "is not a list of values")
        self.refused(
            '"time.step" = [0.1',
            "step = [0.1",
            "runs.steps.vary.step",
            "neither 'mesh', 'processes' nor a key of the case file",
        )
        self.refused("[1, 3]", "[0]", "runs.parts.vary.processes: 0 is no number of processes", '"cores"')
        self.refused("[1, 3]", '["many"]', "runs.parts.vary.processes: many is no number of processes")
        self.refused("[1, 3]", '"core"', "runs.parts.vary.processes", "is not a list of values")
        self.refused("threads = 1", "processes = 0", "processes: 0 is not a whole number from 1")
        self.refused('label = "none", ', "", "runs.loads.vary.load", "has no label")


class ReadyStudies(unittest.TestCase):
    def test_each_parses_and_checks_in_both_forms(self):
        self.assertIn("paper", CATALOGUE.ready)
        for name in CATALOGUE.ready:
            for quick in (False, True):
                with self.subTest(study=name, quick=quick):
                    study = read_study(CATALOGUE.path(name), CATALOGUE.kinds, quick)
                    if not study.requests:
                        self.assertTrue(quick, "no runs at all")
                        continue
                    CATALOGUE.kind(study.kind).check(study)

    def test_case_files_beside_them_are_no_studies(self):
        for path in FOLDER.glob("*.toml"):
            self.assertEqual(path.stem in CATALOGUE.ready, "\nkind = " in path.read_text(), path)

    def test_unknown_name(self):
        with self.assertRaises(InputError) as caught:
            CATALOGUE.path("papr")
        self.assertIn("did you mean 'paper'?", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
