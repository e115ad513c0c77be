"""fsi-compare gallery: what it says of scenes that are right, wrong, or no scenes. The ready scenes have tests of their
own, registered in CMakeLists.txt."""

import csv
import shutil
import unittest
from pathlib import Path

from programs import MESH, FolderTest, execute

COMPARE = Path(MESH).parent / "fsi-compare"
READY = Path(__file__).resolve().parents[3] / "gallery"


class Gallery(FolderTest):
    def setUp(self):
        super().setUp()
        self.own = self.base / "own"
        shutil.rmtree(self.own, ignore_errors=True)
        shutil.copytree(READY / "static-tube", self.own / "static-tube")

    def gallery(self, *words):
        return execute(COMPARE, "gallery", *words, "-o", self.base / "out")

    def own_scene(self, old, new):
        path = self.own / "static-tube" / "scene.py"
        text = path.read_text()
        self.assertIn(old, text)
        path.write_text(text.replace(old, new))
        return self.gallery("--from", self.own)

    def test_page_of_a_scene(self):
        process = self.gallery("--from", self.own, "--jobs", 1, "--threads", 1)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertIn("2 of 2 numbers as known", process.stdout)
        text = (self.base / "out" / "report.md").read_text()
        for part in (
            "## Static tube",
            "fsi-mesh geo gallery/static-tube/tube.geo --order 2",
            "integral over the wall",
            "static_tube.png",
            "at 100 % of the load.",
            "with one thread, one program at a time",
        ):
            self.assertIn(part, text)
        self.assertTrue((self.base / "out" / "static_tube.png").is_file())
        self.assertEqual(
            sorted(p.name for p in (self.own / "static-tube").iterdir()), ["scene.py", "static-tube.toml", "tube.geo"]
        )

    def test_the_kept_page_has_every_scene_but_the_long_ones(self):
        listed = execute(COMPARE, "gallery", "--list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        page = (READY.parent / "docs" / "evidence" / "gallery.md").read_text(encoding="utf-8")
        titles = [line.split(maxsplit=1)[1] for line in listed.stdout.splitlines() if not line.endswith(" (long)")]
        self.assertGreaterEqual(len(titles), 16)
        for title in titles:
            self.assertIn(f"## {title}\n", page)

    def test_the_page_of_peers_has_every_case_by_both_drivers(self):
        listed = execute(COMPARE, "gallery", "--peers", "--list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        names = [line.split()[0] for line in listed.stdout.splitlines()]
        self.assertGreaterEqual(len(names), 6)
        self.assertIn("mok-flap", names)
        with open(READY.parent / "docs" / "data" / "peers.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        for name in names:
            drivers = {row["driver"] for row in rows if row["scene"] == name}
            self.assertEqual(drivers, {"monolithic", "partitioned"}, name)
            self.assertTrue(all(row["reason"] for row in rows if row["scene"] == name), name)

    def test_a_number_that_is_off_fails(self):
        process = self.own_scene("exact_radius(load),", "1.001 * exact_radius(load),")
        self.assertEqual(process.returncode, 2)
        self.assertIn("differs by 0.1 % from", process.stderr)
        self.assertIn("(!)", (self.base / "out" / "report.md").read_text())

    def test_a_run_that_is_refused_fails_and_the_page_says_so(self):
        path = self.own / "static-tube" / "static-tube.toml"
        path.write_text(path.read_text().replace("c10 = 3.0", "c10 = -3.0"))
        process = self.gallery("--from", self.own)
        self.assertEqual(process.returncode, 2)
        self.assertIn("c10", process.stderr)
        self.assertIn("failed", (self.base / "out" / "report.md").read_text())

    def test_what_is_no_scene_is_refused_in_one_line(self):
        for process, words in (
            (self.gallery("statictube"), ("'statictube' is no scene", "static-tube")),
            (self.gallery("--from", self.base / "nothing"), ("holds no scene",)),
            (self.own_scene("MESH = ", "MSH = "), ("scene.py", "MESH")),
            (self.own_scene("MSH = ", "MESH = 1 / 0  # "), ("scene.py", "division by zero")),
        ):
            with self.subTest(words=words):
                self.assertEqual(process.returncode, 1, process.stdout)
                self.assertEqual(len(process.stderr.splitlines()), 1, process.stderr)
                for word in words:
                    self.assertIn(word, process.stderr)


STUDY = """
title = "A flag under its weight, a channel around it, and both at once"
kind = "scenes"
[cases]
structure = { scene = "turek-hron-csm2" }
flow = { scene = "turek-hron-cfd1", set = { time.end = 2000.0 } }
both = { scene = "turek-hron-fsi3", set = { time.end = 4.0 } }
[methods.monolithic]
program = "fsi-monolithic"
[methods.partitioned]
program = "fsi-partitioned"
[runs.all]
quick = true
"""


class StudyOfScenes(FolderTest):
    def test_one_table_of_both_drivers(self):
        study = self.base / "study.toml"
        study.write_text(STUDY)
        process = execute(COMPARE, "study", study, "--quick", "-o", self.base / "out")
        self.assertEqual(process.returncode, 2, process.stderr)  # the flow has not become steady in two steps
        with open(self.base / "out" / "scenes.csv", newline="", encoding="utf-8") as file:
            rows = {(row["scene"][11:], row["quantity"], row["program"][4:]): row for row in csv.DictReader(file)}
        self.assertEqual(len(rows), 2 * (2 + 2 + 1))
        for driver in ("monolithic", "partitioned"):
            self.assertLess(float(rows["csm2", "u_y", driver]["relative_error"]), 0.01)
            self.assertEqual(int(rows["csm2", "u_y", driver]["steps"]), 20)
            self.assertGreater(float(rows["cfd1", "lift", driver]["relative_error"]), 0.02)
            self.assertEqual(float(rows["cfd1", "lift", driver]["step_ms"]), 1000)
            self.assertLess(float(rows["fsi3", "u_y", driver]["relative_error"]), 0.01)
        self.assertIn("(!)", process.stdout)
        before = (self.base / "out" / "scenes.csv").read_bytes()
        execute(COMPARE, "study", study, "--quick", "-o", self.base / "out")
        self.assertEqual((self.base / "out" / "scenes.csv").read_bytes(), before, "no run was made anew: same seconds")


if __name__ == "__main__":
    unittest.main()
