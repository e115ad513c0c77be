"""Kind `calibration`: bars are held against the truth, with programs whose errors are known."""

import unittest

import numpy as np
from fake_family import A, B
from family_study_case import FamilyStudyCase

from fsi_compare.gallery.scene import READY, read_scene
from fsi_compare.verify.tolerances import ERROR_TOLERANCE

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

    def test_curve_that_the_scene_knows_is_the_truth(self):
        def known(scene, name, times):
            return np.sin(times / 4) if name == "tip: displacement x" else None

        self.patch("fsi_compare.gallery.scene.Scene.known_curve", known)
        code, _, err = self.call_study(STUDY)
        self.assertEqual(code, 0, err)
        rows = {row["quantity"]: row for row in self.csv("records.csv") if row["family"] == "normal"}
        row = rows["tip: displacement x, at the end"]
        self.assertEqual((row["truth_from"], float(row["truth"])), ("exact", float(np.sin(1))))
        # 4 cells and steps of 0.5 ms: what the fake driver makes of both, and of its tolerance
        self.assertAlmostEqual(
            float(row["true_error"]), np.sin(1) * (A * 2**3 + B + 1e-3 * ERROR_TOLERANCE), places=9
        )
        self.assertGreater(float(row["bar"]), float(row["true_error"]))
        self.assertEqual(rows["tip: pressure, at the end"]["truth_from"], "finer run")

    def test_curves_that_scenes_know(self):
        for name, times in (("static-tube", [0.5, 1.0]), ("ring-in-time", [0.5, 1.0, 6.0])):
            scene = read_scene(READY / name)
            inner = scene.known_curve("inner wall: radial", np.array(times))
            grown = (1.43 + inner) ** 2 - 1.43**2  # of the square of each radius alike: the wall keeps its volume
            for point, radius in (("media", 1.56), ("outer", 1.82)):
                moved = scene.known_curve(f"{point}: displacement x", np.array(times))
                np.testing.assert_allclose((radius + moved) ** 2 - radius**2, grown, rtol=1e-12)
            self.assertIsNone(scene.known_curve("media: pressure", np.array(times)))
        ring = read_scene(READY / "pulsating-ring")
        times = np.array([0.5, 1.0, 2.0, 3.0, 4.0])
        table = np.array([ring.module.EXACT[time] for time in times])  # docs/theory.md, section 13.2
        np.testing.assert_allclose(1.43 + ring.known_curve("inner wall: radial", times), table, atol=1e-9)
        self.assertIsNone(read_scene(READY / "stenosis").known_curve("inner wall: radial", np.array([1.0])))

    def test_mistakes_are_named(self):
        self.assert_named(
            STUDY,
            ("reference = [0.125, 0.125]", "reference = [2, 0.5]", "no pair of sizes"),
            ("ring-in-time = { reference", "other = { reference", "report.scenes.ring-in-time: is missing"),
            ('trap = "none"', 'snare = "none"', "snare"),
        )


if __name__ == "__main__":
    unittest.main()
