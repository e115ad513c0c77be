"""Short runs of a study are timed several times; the one of median seconds stays."""

import json
import unittest
from pathlib import Path

from fake_drivers import behave, calls
from study_case import STUDY, StudyCase

from fsi_research.accuracy.timing import timing_words
from fsi_research.evidence.timings import spread
from fsi_compare.study.runner import RECORD
from fsi_compare.study.study_run import DONE, StudyRun


class Repeats(StudyCase):
    def repeat(self, text="repeats = 3\n"):
        self.study.write_text(text + STUDY)

    def records(self):
        return {
            path.parent.name.split("-")[1]: json.loads(path.read_text())
            for path in sorted((self.out / "runs").glob(f"*/{RECORD}"))
        }

    def wall_s(self, name):
        (folder,) = (self.out / "runs").glob(f"tube-{name}-*")  # the repetitions are gone
        return json.loads((folder / "summary.json").read_text())["totals"]["wall_s"]

    def test_the_median_stays(self):
        # Calls 1 and 2 are the two runs, 3 and 4 their second time, 5 and 6 their third.
        behave(self.programs, seconds=[3.0, 10.0, 1.0, 30.0, 2.0, 20.0])
        self.repeat()
        code, _, err = self.call()
        self.assertEqual((code, len(calls(self.programs))), (0, 6), err)
        self.assertEqual((self.wall_s("mono"), self.wall_s("part")), (2.0, 20.0))
        self.assertEqual([record["timings"] for record in self.records().values()], [[1, 2, 3], [10, 20, 30]])

    def test_what_has_been_timed_is_not_timed_again(self):
        self.call()
        self.repeat()
        self.call()
        self.assertEqual(len(calls(self.programs)), 2 + 4)
        self.call()
        self.assertEqual(len(calls(self.programs)), 6)

    def test_long_runs_are_timed_once(self):
        self.repeat("repeats = 3\nrepeat_below = 1e-3\n")
        self.call()
        self.assertEqual(len(calls(self.programs)), 2)

    def test_the_quick_form_times_once(self):
        self.repeat()
        self.call("--quick")
        self.assertEqual(len(calls(self.programs)), 1)

    def test_failures_are_not_repeated(self):
        behave(self.programs, end={"mono": [2, "no"]})
        self.repeat()
        self.call()
        self.assertEqual(len(calls(self.programs)), 2 + 2)

    def test_other_results_are_a_fault(self):
        behave(self.programs, drifts=True)
        self.repeat()
        self.call()
        self.assertEqual({record["status"] for record in self.records().values()}, {"crashed"})
        self.assertIn("not the same", next(iter(self.records().values()))["message"])

    def test_a_repetition_that_fails_is_a_fault_not_a_crash_of_the_study(self):
        behave(self.programs, end={"-2 -q": [2, "no"]})
        self.repeat()
        code, _, err = self.call()
        self.assertNotIn("Traceback", err)
        self.assertEqual({record["status"] for record in self.records().values()}, {"crashed"})

    def test_leftovers_of_a_killed_repetition_do_no_harm(self):
        self.call()
        (folder,) = (self.out / "runs").glob("tube-mono-*")
        leftover = folder.with_name(folder.name + "-2")
        leftover.mkdir()
        (leftover / "centerline_pressure.csv").write_text("time_ms,z_mm,pre")
        self.repeat()
        self.assertEqual(self.call()[0], 0)
        self.assertEqual({record["status"] for record in self.records().values()}, {"done"})
        self.assertFalse(leftover.exists())

    def test_bad_number(self):
        self.repeat("repeats = 0\n")
        code, _, err = self.call()
        self.assertEqual(code, 1)
        self.assertIn("repeats", err)


class Spread(unittest.TestCase):
    def test_slowest_over_fastest(self):
        self.assertEqual(spread([2.0, 3.0, 5.0]), 2.5)
        self.assertIsNone(spread([2.0]))
        self.assertIsNone(spread([]))

    def test_words(self):
        def run(name, *timings):
            return StudyRun(None, Path(name), DONE, "", 1.0, "", timings)

        self.assertEqual(timing_words([run("a")]), "Seconds are single timings.")
        words = timing_words([run("a", 1.0, 1.1, 1.2), run("b", 1.0, 1.5, 2.0), run("b", 1.0, 1.5, 2.0), run("c")])
        self.assertIn("medians of 3 timings, those of the 1 longest runs single ones", words)
        self.assertIn("2.00 at most", words)
