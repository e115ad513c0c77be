"""The kind `skip` of fsi-compare study: pairs of runs with and without an economy."""

import csv
import tempfile
import unittest
from pathlib import Path

import numpy as np
from synthetic import parabola, write_run

from fsi_compare.errors import InputError
from fsi_compare.studies.skip import study as skip
from fsi_compare.studies.context import Context
from fsi_compare.studies.report import Report
from fsi_compare.studies.study_file import read_study
from fsi_compare.studies.study_run import DONE, NOT_CONVERGED, StudyRun

STUDY = """
title = "Economies"
kind = "skip"
[cases]
tube = "tube.toml"
pipe = "tube.toml"
[methods.whole]
program = "fsi-monolithic"
[runs.kept]
cases = ["tube"]
[runs.kept.vary]
economy = [
  { label = "kept", set = { monolithic.mode = "kept" } }, { label = "anew", set = { monolithic.mode = "full" } },
]
repeat = [
  { label = 1, set = { title = "a" } }, { label = 2, set = { title = "b" } }, { label = 3, set = { title = "c" } },
]
[runs.pipe]
cases = ["pipe"]
[runs.pipe-off]
cases = ["tube"]
[report.economies]
kept = { label = "Factors kept", counter = "factorisation: coupled" }
[report.economies.pipe]
label = "No wall"
off = "pipe-off"
off_label = "a stiff wall"
counter = "structure elements"
differs = "it yields"
"""
SECONDS = {("kept", "1"): 1.0, ("kept", "2"): 1.2, ("kept", "3"): 9.0, ("anew", "1"): 4.0, ("anew", "2"): 6.0,
           ("anew", "3"): 5.0}


class Skip(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.base = Path(temporary.name)
        (self.base / "tube.toml").write_text("")

    def study(self, text=STUDY):
        file = self.base / "study.toml"
        file.write_text(text)
        study = read_study(file, ["skip"])
        skip.check(study)
        return study

    def evaluate(self, status=DONE):
        study = self.study()
        runs = []
        for i, request in enumerate(study.requests):
            form = str(request.values.get("economy", request.group))
            seconds = SECONDS.get((form, str(request.values.get("repeat"))), 2.0)
            wave = parabola(0.66)
            folder = write_run(self.base / "runs" / str(i), lambda t, z,
                               f=form: (1 + 1e-6 * (f == "anew")) * wave(t, z),
                               0.125 * np.arange(1, 5), totals={"steps": 4, "wall_s": seconds},
                               phases={"factorisation: coupled": {"seconds": 0.5, "calls": 12 if form == "anew" else 1},
                                       "output": {"seconds": 0.125, "calls": 4}},
                               counters={} if request.case == "pipe" else {"structure elements": 100})
            runs.append(StudyRun(request, folder, status if form == "anew" else DONE,
                                 "diverged" if status != DONE else "", 3.0, ""))
        out = self.base / "out"
        out.mkdir(exist_ok=True)
        report = Report(out, study.title)
        self.code = skip.evaluate(Context(study, runs, None, report))
        self.page = report.write().read_text()
        self.runs = runs
        with open(out / "skip.csv", newline="") as file:
            return {row["economy"]: row for row in csv.DictReader(file)}

    def test_medians_counts_and_answers(self):
        rows = self.evaluate()
        self.assertEqual(self.code, 0)
        row = rows["kept"]
        self.assertEqual([float(row[name]) for name in ("with_s", "without_s", "with_count", "without_count")],
                         [1.2, 5.0, 1, 12])
        self.assertAlmostEqual(float(row["ratio"]), 5.0 / 1.2)
        self.assertEqual(float(row["spread"]), 9.0)
        self.assertAlmostEqual(float(row["largest_difference"]), 1e-6, 12)
        self.assertEqual((row["with"], row["switched_off"]), ("kept", "anew"))
        row = rows["pipe"]
        self.assertEqual((row["switched_off"], float(row["with_count"]), float(row["without_count"])),
                         ("a stiff wall", 0, 100))
        self.assertIn(">it yields<", self.page)
        self.assertGreater((self.base / "out" / "skip.png").stat().st_size, 1000)

    def test_what_is_built_once_is_told(self):
        self.evaluate()
        with open(self.base / "out" / "constant_operators.csv", newline="") as file:
            row, = csv.DictReader(file)  # output is no operator
        self.assertEqual((row["phase"], row["calls"], float(row["saved_s"])), ("factorisation: coupled", "1", 1.5))

    def test_counters(self):
        self.evaluate()
        run = self.runs[0]
        self.assertEqual([skip.counter(run, name) for name in ("output seconds", "output", "steps", "fibres")],
                         [0.125, 4, 4, 0])

    def test_a_run_that_failed_leaves_its_economy_out(self):
        rows = self.evaluate(NOT_CONVERGED)
        self.assertEqual((self.code, list(rows)), (2, ["pipe"]))
        self.assertIn("did not come to their end", self.page)

    def test_refusals(self):
        for expected, old, new in (("has 1 forms", ' { label = "anew", set = { monolithic.mode = "full" } },', ""),
                                   ("'pipe-of' is no group of runs", 'off = "pipe-off"', 'off = "pipe-of"'),
                                   ("report.economies.kept.counter: is missing", ', counter = "factorisation: coupled"',
                                    ""),
                                   ("is no group of runs; did you mean 'kept'", "kept = { label", "keep = { label"),
                                   ("report.economies: is missing", STUDY[STUDY.index("[report"):], "")):
            with self.assertRaises(InputError) as caught:
                self.study(STUDY.replace(old, new))
            self.assertIn(expected, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
