"""The kind `skip` of fsi-compare study: pairs of runs with and without an economy."""

import unittest

import numpy as np
from folder_case import FolderCase
from synthetic import parabola, write_run

from fsi_compare.base.errors import InputError
from fsi_research.skip import study as skip
from fsi_compare.study.context import Context
from fsi_compare.reporting.report import Report
from fsi_compare.study.study_file import read_study
from fsi_compare.study.study_run import DONE, NOT_CONVERGED, StudyRun

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
  { label = "kept", set = { newton.mode = "kept" } }, { label = "anew", set = { newton.mode = "full" } },
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
SECONDS = {
    ("kept", "1"): 1.0,
    ("kept", "2"): 1.2,
    ("kept", "3"): 1.25,
    ("anew", "1"): 4.0,
    ("anew", "2"): 6.0,
    ("anew", "3"): 5.0,
}


class Skip(FolderCase):
    def setUp(self):
        super().setUp()
        (self.base / "tube.toml").write_text("")

    def study(self, text=STUDY):
        file = self.base / "study.toml"
        file.write_text(text)
        study = read_study(file, ["skip"])
        skip.check(study)
        return study

    def evaluate(self, status=DONE, seconds_of=SECONDS):
        study = self.study()
        runs = []
        for i, request in enumerate(study.requests):
            form = str(request.values.get("economy", request.group))
            seconds = seconds_of.get((form, str(request.values.get("repeat"))), 2.0)
            wave = parabola(0.66)
            folder = write_run(
                self.base / "runs" / str(i),
                lambda t, z, f=form: (1 + 1e-6 * (f == "anew")) * wave(t, z),
                0.125 * np.arange(1, 5),
                totals={"steps": 4, "wall_s": seconds},
                phases={
                    "factorisation: coupled": {"seconds": 0.5, "calls": 12 if form == "anew" else 1},
                    "output": {"seconds": 0.125, "calls": 4},
                },
                counters={} if request.case == "pipe" else {"structure elements": 100},
            )
            runs.append(
                StudyRun(
                    request, folder, status if form == "anew" else DONE, "diverged" if status != DONE else "", 3.0, ""
                )
            )
        self.out.mkdir(exist_ok=True)
        report = Report(self.out, study.title)
        self.code = skip.evaluate(Context(study, runs, None, report))
        self.page = report.write().read_text()
        self.runs = runs
        return {row["economy"]: row for row in self.csv("skip.csv")}

    def test_medians_counts_and_answers(self):
        rows = self.evaluate()
        self.assertEqual(self.code, 0)
        row = rows["kept"]
        self.assertEqual(
            [float(row[name]) for name in ("with_s", "without_s", "with_count", "without_count")], [1.2, 5.0, 1, 12]
        )
        self.assertAlmostEqual(float(row["ratio"]), 5.0 / 1.2)
        self.assertEqual((float(row["noise"]), row["in_noise"]), (1.5, "False"))
        self.assertAlmostEqual(float(row["largest_difference"]), 1e-6, 12)
        self.assertEqual((row["with"], row["switched_off"]), ("kept", "anew"))
        row = rows["pipe"]
        self.assertEqual(
            (row["switched_off"], float(row["with_count"]), float(row["without_count"])), ("a stiff wall", 0, 100)
        )
        self.assertIn(">it yields<", self.page)
        self.assertEqual(row["in_noise"], "True")  # 2 s in both forms
        self.assertIn(">1.00 (in the noise)<", self.page)
        self.assertIn("say nothing: no wall.", self.page)
        self.assertGreater((self.out / "skip.png").stat().st_size, 1000)

    def test_the_largest_savings_are_named(self):
        self.evaluate()
        self.assertIn("The largest savings: factors kept, 4.2 times", self.page)

    def test_one_slow_repetition_makes_its_row_noise(self):
        rows = self.evaluate(seconds_of={**SECONDS, ("kept", "3"): 9.0})
        self.assertEqual((float(rows["kept"]["noise"]), rows["kept"]["in_noise"]), (9.0, "True"))
        self.assertIn("No saving shows in the seconds.", self.page)

    def test_no_row_has_less_noise_than_the_median_row(self):
        rows = [
            skip.Measured(None, 1.0, ratio, noise, None, None, None)
            for ratio, noise in ((0.95, 1.0), (1.3, 1.2), (1.3, 1.4))
        ]
        self.assertEqual(
            [(m.noise, m.in_noise) for m in skip.with_common_noise(rows)], [(1.2, True), (1.2, False), (1.4, True)]
        )
        self.assertEqual(skip.with_common_noise([]), [])

    def test_counters(self):
        self.evaluate()
        run = self.runs[0]
        self.assertEqual(
            [skip.counter(run, name) for name in ("output seconds", "output", "steps", "fibres")], [0.125, 4, 4, 0]
        )

    def test_a_run_that_failed_leaves_its_economy_out(self):
        rows = self.evaluate(NOT_CONVERGED)
        self.assertEqual((self.code, list(rows)), (2, ["pipe"]))
        self.assertIn("did not come to their end", self.page)

    def test_refusals(self):
        for expected, old, new in (
            ("has 1 forms", ' { label = "anew", set = { newton.mode = "full" } },', ""),
            ("'pipe-of' is no group of runs", 'off = "pipe-off"', 'off = "pipe-of"'),
            ("report.economies.kept.counter: is missing", ', counter = "factorisation: coupled"', ""),
            ("is no group of runs; did you mean 'kept'", "kept = { label", "keep = { label"),
            ("report.economies: is missing", STUDY[STUDY.index("[report") :], ""),
        ):
            with self.assertRaises(InputError) as caught:
                self.study(STUDY.replace(old, new))
            self.assertIn(expected, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
