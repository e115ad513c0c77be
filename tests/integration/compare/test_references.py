"""Kind `references`: known numbers get bars from a family of runs, and what they are off by is counted in these."""

import math
import unittest

from family_study_case import FamilyStudyCase

STUDY = """\
title = "Known"
kind = "references"
time_limit = 60
[cases]
ring-in-time = { scene = "ring-in-time", set = { "time.step" = 0.5, "time.end" = 4.0 } }
[methods.monolithic]
program = "fsi-monolithic"
[runs.own]
[report.scenes]
ring-in-time = { levels = 3 }
"""


def numbers(scene, runs):
    """The fake's last displacement: beside its limit, beside twice that, and beside one that others know no
    better than that; that of the other driver, and its pressure, which is of second order in space."""
    from fsi_compare.gallery.scene import Number

    found = []
    for run in runs:
        table = run.table("points.csv")
        x, exact = float(table["displacement_x_mm"][-1]), math.sin(1.0)
        found += [
            Number("exact", "mm", run.program, x, exact, 0.1, "formula"),
            Number("wrong", "mm", run.program, x, 2 * exact, 0.6, "formula"),
            Number("vague", "mm", run.program, x, 2 * exact, 0.6, "published", spread=0.6),
            Number("shared", "mm", run.program, x, x, 0.1, "the other driver"),
            Number("pressure", "Pa", run.program, float(table["pressure_Pa"][-1]), 100.0, 0.1, "formula"),
        ]
    return found


class References(FamilyStudyCase):
    def setUp(self):
        super().setUp()
        self.patch("fsi_compare.gallery.scene.Scene.numbers", numbers)

    def test_what_a_number_is_off_by_is_counted_in_its_bar(self):
        code, _, err = self.call_study(STUDY)
        self.assertEqual(code, 0, err)
        rows = {row["number"]: row for row in self.csv("references.csv")}
        self.assertEqual(set(rows), {"exact", "wrong", "vague", "pressure"})
        # 3 and 2 by the sizes of elements; these are taken from numbers of cells, and counts of cells are whole.
        of_mesh = {name: float(rows[name]["order_mesh"]) for name in ("exact", "pressure")}
        self.assertAlmostEqual(of_mesh["exact"] / of_mesh["pressure"], 1.5, delta=0.1)
        self.assertGreater(of_mesh["exact"], 2.2)
        self.assertAlmostEqual(float(rows["exact"]["order_step"]), 2, delta=0.1)
        self.assertTrue(0.25 < float(rows["exact"]["in_bars"]) <= 1, rows["exact"])
        self.assertGreater(float(rows["wrong"]["in_bars"]), 1)
        text = (self.out / "report.md").read_text()
        self.assertIn("4 have a bar", text)
        self.assertIn("3 of these differ from what is known by no more", text)
        self.assertIn("Furthest off: ring-in-time, wrong", text)

    def test_a_finer_family_narrows_the_bar(self):
        bars = []
        for finer in ("false", "true"):
            code, _, err = self.call_study(STUDY.replace("levels = 3", f"levels = 3, finer = {finer}"))
            self.assertEqual(code, 0, err)
            bars.append(float(next(row for row in self.csv("references.csv") if row["number"] == "exact")["bar"]))
        self.assertLess(bars[1], bars[0])

    def test_mistakes_are_named(self):
        self.assert_named(
            STUDY,
            ("levels = 3", 'finer = "yes"', "neither true nor false"),
            ("ring-in-time = { levels", "other = { levels", "report.scenes.other: is no case"),
            ("levels = 3", "meshes = 3", "meshes"),
            ('{ scene = "ring-in-time", set', '{ file = "known.toml", set', "cases.ring-in-time"),
        )


if __name__ == "__main__":
    unittest.main()
