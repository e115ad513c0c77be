"""`fsi-compare study --list` without a name: the ready studies, and what each still has to run."""

import os
import unittest
from unittest import mock

from fake_drivers import behave, calls
from folder_case import FolderCase
from study_case import STUDY, StudyCase

from fsi_compare.study import catalogue
from fsi_research import studies


class Overview(StudyCase):
    """In a folder with two ready studies: `two` has two runs, one of them in its quick form; `six` has six."""

    def setUp(self):
        super().setUp()
        ready = self.base / "ready"
        ready.mkdir()
        (ready / "tube.toml").write_text('title = "A tube"\n')  # a case file beside the studies
        (ready / "two.toml").write_text(STUDY)
        varied = STUDY.replace("[runs.all]", '[runs.all]\nvary = { "time.step" = [0.125, 0.25, 0.125, 0.5] }')
        (ready / "six.toml").write_text(varied.replace("Two runs", "Six runs").rpartition("quick")[0])
        self.ready = ready
        patch = mock.patch.object(studies, "CATALOGUE", catalogue.Catalogue(catalogue.OWN.modules, (ready,)))
        patch.start()
        self.addCleanup(patch.stop)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.base)

    def call(self, *words):
        programs = (
            "--monolithic",
            self.programs / "fsi-monolithic",
            "--partitioned",
            self.programs / "fsi-partitioned",
        )
        return FolderCase.call(self, "study", *words, *programs)

    def lines(self, *words):
        code, out, err = self.call("--list", *words)
        self.assertEqual((code, err), (0, ""))
        return out.splitlines()

    def test_a_line_for_each_study(self):
        self.assertEqual(
            self.lines(),
            [
                "six  Six runs (results/studies/six: 0 of 6 runs finished, 6 to run)",
                "two  Two runs (results/studies/two: 0 of 2 runs finished, 2 to run)",
            ],
        )
        self.assertFalse((self.base / "results").exists(), "a list makes nothing")
        self.assertEqual(calls(self.programs), [])

    def test_finished_runs_are_counted(self):
        behave(self.programs, end={"scheme=iqn-ils": [2, "no convergence"]})
        self.call("two", "-q")
        self.assertIn("two: 2 of 2 runs finished (1 failed), 0 to run", self.lines()[1])
        self.assertIn("six: 0 of 6 runs finished, 6 to run", self.lines()[0])
        behave(self.programs, version="0.2.0")  # runs of another version are made again
        self.assertIn("two: 0 of 2 runs finished, 2 to run", self.lines()[1])

    def test_part_of_a_study(self):
        self.call("two", "--quick", "-q")
        os.rename("results/studies/two-quick", "results/studies/two")
        self.assertIn("two: 1 of 2 runs finished, 1 to run", self.lines()[1])

    def test_quick_form(self):
        self.call("two", "--quick", "-q")
        lines = self.lines("--quick")
        self.assertIn("has no quick form", lines[0])
        self.assertIn("results/studies/two-quick: 1 of 1 runs finished, 0 to run", lines[1])

    def test_own_meshes_are_not_made_for_the_list(self):
        study = self.ready / "two.toml"
        own = '[meshes.own]\noptions = ["--size", "0.5"]\n[runs.all]\nvary = { mesh = ["own", "coarse"] }'
        study.write_text(study.read_text().replace("[runs.all]", own))
        self.assertIn("two: 0 of 4 runs finished, 4 to run", self.lines()[1])
        self.assertFalse((self.base / "results").exists())

    def test_without_programs(self):
        with mock.patch("fsi_compare.starting.programs.find_beside", return_value=None):
            code, out, err = FolderCase.call(self, "study", "--list")
        self.assertEqual(code, 0)
        self.assertIn("two  Two runs (2 runs asked for)", out)
        self.assertIn("warning: finished runs cannot be counted: fsi-monolithic", err)

    def test_wrong_use(self):
        for words, expected in (
            ((), "STUDY: is missing; give a study file, or a ready study: six, two"),
            (("--list", "-o", "somewhere"), "--output: is of one study"),
        ):
            code, out, err = self.call(*words)
            self.assertEqual((code, out), (1, ""))
            self.assertIn(expected, err)


class ReadyStudies(StudyCase):
    def test_the_projects_own(self):
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.base)
        programs = (
            "--monolithic",
            self.programs / "fsi-monolithic",
            "--partitioned",
            self.programs / "fsi-partitioned",
        )
        code, out, err = FolderCase.call(self, "study", "--list", *programs)
        self.assertEqual((code, err), (0, ""))
        self.assertEqual([line.split()[0] for line in out.splitlines()], list(studies.CATALOGUE.ready))
        # with the linear systems: 3 materials on 3 meshes, and the later ones on 2
        listed = FolderCase.call(self, "study", "paper", "--list", *programs)[1].splitlines()
        paper = next(line for line in out.splitlines() if line.startswith("paper"))
        self.assertEqual(sum(line.startswith("linear systems") for line in listed), 15)
        self.assertRegex(paper, rf"0 of {len(listed)} runs finished, {len(listed)} to run")


if __name__ == "__main__":
    unittest.main()
