"""Kind `calibration`: bars are held against the truth, with programs whose errors are known."""

import unittest

from family_study_case import FamilyStudyCase

STUDY = """\
title = "Bars"
kind = "calibration"
time_limit = 60
[cases]
ring-in-time = { scene = "ring-in-time", set = { "time.step" = 0.5, "time.end" = 4.0 } }
[methods.monolithic]
program = "fsi-monolithic"
[runs.own]
[report.scenes]
ring-in-time = { reference = [0.125, 0.125], trap = "none" }
"""


class Calibration(FamilyStudyCase):
    def test_bars_of_known_errors_hold(self):
        code, out, err = self.call_study(STUDY)
        self.assertEqual(code, 0, err)
        rows = self.csv("records.csv")
        self.assertEqual({row["family"] for row in rows}, {"normal", "coarse"})
        for row in rows:
            if "displacement" in row["quantity"] and "L2" not in row["quantity"]:
                self.assertTrue(0.9 <= float(row["bar_by_error"]) <= 4, row)
        whole = next(row for row in self.csv("scores.csv") if row["scene_family"] == "all")
        self.assertEqual(float(whole["misled"]), 0)
        self.assertGreaterEqual(float(whole["held_percent"]), 95)
        self.assertIn("In the median the bar is", (self.out / "report.md").read_text())

    def test_mistakes_are_named(self):
        self.assert_named(
            STUDY,
            ("reference = [0.125, 0.125]", "reference = [2, 0.5]", "no pair of sizes"),
            ("ring-in-time = { reference", "other = { reference", "report.scenes.ring-in-time: is missing"),
            ('trap = "none"', 'snare = "none"', "snare"),
        )


if __name__ == "__main__":
    unittest.main()
