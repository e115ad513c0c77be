"""Entries of the wrong kind, in summaries, tables and study files: refused in one line that names file and key."""

import json
import unittest

import fake_drivers
from study_case import STUDY, StudyCase
from folder_case import FolderCase
from fsi_compare.runs.verification import find_verification, identity


class Summaries(FolderCase):
    def setUp(self):
        super().setUp()
        self.run = self.base / "run"
        self.run.mkdir()
        fake_drivers.write_results(self.run, "fsi-monolithic", steps=8)
        self.summary = json.loads((self.run / "summary.json").read_text())

    def cost(self):
        return self.call("cost", self.run, "-q", "-o", self.out)

    def test_kinds(self):
        for key, value in (
            ("mesh", []),
            ("mesh", {"nodes": "many"}),
            ("phases", 3),
            ("phases", {"solve: coupled": 5}),
            ("phases", {"solve: coupled": {"calls": -1, "seconds": 1.0}}),
            ("phases", {"solve: coupled": {"calls": 1, "seconds": float("nan")}}),
            ("phases", {"solve: coupled": {"calls": 1, "seconds": 10**400}}),
            ("unknowns", {"coupled": 1.5}),
            ("threads", "two"),
            ("peak_memory_MiB", True),
            ("totals", {"steps": []}),
            ("title", 7),
        ):
            (self.run / "summary.json").write_text(json.dumps({**self.summary, key: value}))
            code, out, err = self.cost()
            self.assertEqual((code, out, err.count("\n")), (1, "", 1), err)
            self.assertIn(f"summary.json: {key}", err)
            self.assertFalse(self.out.exists())

    def test_null_counts_as_missing(self):
        for key in ("mesh", "phases", "unknowns", "threads", "peak_memory_MiB", "restarted_from_step", "totals"):
            (self.run / "summary.json").write_text(json.dumps({**self.summary, key: None}))
            self.assertEqual(self.cost()[0], 0, key)

    def test_bars_that_are_no_list_count_as_none(self):
        summary = {**self.summary, "case_hash": "1", "mesh": {"hash": "2"}}
        run = identity(self.run, summary)
        for quantities in (5, "many", {"a": 1}, None, [7]):
            text = json.dumps({"sets": [{"run": run, "quantities": quantities}]})
            (self.run / "verification.json").write_text(text)
            self.assertEqual(find_verification(self.run, summary), [])

    def test_tables(self):
        lines = (self.run / "iterations.csv").read_text().splitlines()
        for changed, expected in (
            ([lines[0] + ",step", *(line + ",1" for line in lines[1:])], "column 'step' is there twice"),
            ([*lines, lines[-1]], "step does not increase"),
            ([lines[0], "1,0.125,1,3,9,1_0"], "'1_0' is not a number"),
            ([lines[0], "1,0.125,1,3,9,-1"], "wall_s is negative"),
            ([lines[0], "1,0.125,1,3,9,1e300"], "is too large"),
        ):
            (self.run / "iterations.csv").write_text("\n".join(changed) + "\n")
            code, _, err = self.cost()
            self.assertEqual((code, err.count("\n")), (1, 1))
            self.assertIn(expected, err)


class Studies(StudyCase):
    def assert_refused(self, text, *expected):
        self.study.write_text(text)
        code, out, err = self.call()
        self.assertEqual((code, out, err.count("\n")), (1, "", 1), err)
        self.assertTrue(err[:-1].isprintable())
        for part in expected:
            self.assertIn(part, err)
        self.assertFalse(self.out.exists())

    def test_lists_of_names(self):
        group = "[runs.all]\n"
        for entry in ("methods = [[]]", "methods = 3", "methods = [{}]", 'methods = "mono"', "cases = [1]"):
            self.assert_refused(STUDY.replace(group, f"{group}{entry}\n"), "runs.all." + entry.split()[0])

    def test_values_that_are_varied(self):
        for value in ("[1]", "1979-05-27", "1" + "0" * 30, "{ label = [1], set = {} }"):
            self.assert_refused(STUDY + f'vary = {{ "time.step" = [{value}] }}\n', "runs.all.vary.time.step")

    def test_numbers_with_their_limits(self):
        for entry in ("threads = 1" + "0" * 30, "repeats = 1000000", "jobs = true", "time_limit = nan"):
            self.assert_refused(entry + "\n" + STUDY.replace("time_limit = 60\n", ""), entry.split()[0])

    def test_names(self):
        self.assert_refused(STUDY.replace("[methods.mono]", f'[methods.{"a" * 5000}]'), "has more than 200 characters")
        self.assert_refused(STUDY.replace("[methods.mono]", '[methods."a\\u001b"]'), "holds a control character")
        self.assert_refused(STUDY.replace("Two runs", "Two \\u0007 runs"), "title: holds a control character")
        for name in ("../a", "a/b", ".", "a" * 100):
            self.assert_refused(STUDY + f'[meshes."{name}"]\noptions = ["--size", "1"]\n', "is no name for a file")

    def test_deep_nesting(self):
        self.assert_refused(STUDY + "x = " + "[" * 100_000, "levels")
        self.assert_refused(STUDY + "set" + ".a" * 60 + " = 1\n", "levels")

    def test_too_many_runs(self):
        axes = ", ".join(f'"a.{i}" = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]' for i in range(6))
        self.assert_refused(STUDY + f"vary = {{ {axes} }}\n", "asks for more than 100000 runs")

    def test_long_names_make_runs_all_the_same(self):
        name = "a" * 199
        self.study.write_text(STUDY.replace("[methods.mono]", f"[methods.{name}]").replace('["mono"]', f'["{name}"]'))
        code, _, err = self.call()
        self.assertEqual(code, 0, err)

    def test_settings_that_only_a_driver_can_judge(self):
        self.study.write_text(STUDY + 'set = { "time.end" = "x", "time.step" = 0, a = [[1], 2.5] }\n')
        self.assertEqual(self.call()[0], 0)


if __name__ == "__main__":
    unittest.main()
