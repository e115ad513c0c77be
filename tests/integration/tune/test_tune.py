"""fsi-compare tune: Windkessels for 80/120 mmHg and a flow split, rigid and elastic, with both drivers."""

import csv
import json
import shutil
import unittest
from pathlib import Path

import numpy as np
from programs import MESH, MONOLITHIC, FolderTest, execute, make_mesh, run

COMPARE = Path(MESH).parent / "fsi-compare"
HERE = Path(__file__).parent
MMHG, PERIOD = 0.133322387415, 800.0
LOW, HIGH = 80 * MMHG, 120 * MMHG
TARGETS = """
[pressure]
inlet = "80/120mmHg"
[split]
lower = "60%"
"""


def openings(folder):
    """{opening: rows of (time, outward flow, mean pressure in kPa)}."""
    rows = {}
    with (folder / "openings.csv").open() as file:
        for row in csv.DictReader(file):
            values = (row["time_ms"], row["flow_mm3_per_ms"], row["mean_pressure_Pa"])
            rows.setdefault(row["opening"], []).append([float(value) for value in values])
    return {name: np.array(values) * (1, 1, 1e-3) for name, values in rows.items()}


def last_beat(rows):
    return rows[rows[:, 0] > rows[-1, 0] - PERIOD + 1e-6]


def table(path):
    with path.open() as file:
        return list(csv.DictReader(file))


class Tune(FolderTest):
    def tune(self, case, *words, out="out"):
        return execute(COMPARE, "tune", self.base / case, "-o", self.base / out, *words)

    def case(self, name, old="", new=""):
        text = (HERE / name).read_text()
        self.assertIn(old, text)
        (self.base / name).write_text(text.replace(old, new))
        return name


class Fork(Tune):
    """A rigid fork, whose beats take two seconds."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        shutil.copy(HERE / "fork.geo", cls.base)
        shutil.copy(HERE / "fork.toml", cls.base)
        (cls.base / "targets.toml").write_text(TARGETS)
        words = ["--targets", cls.base / "targets.toml"]
        cls.first = execute(COMPARE, "tune", cls.base / "fork.toml", "-o", cls.base / "out", *words)
        cls.words = words

    def test_targets_are_met_within_three_beats(self):
        self.assertEqual(self.first.returncode, 0, self.first.stderr)
        rows = table(self.base / "out" / "targets.csv")
        beats = max(int(row["beat"]) for row in rows)
        self.assertIn(beats, (2, 3))
        last = [row for row in rows if int(row["beat"]) == beats]
        asked = [("inlet", LOW), ("inlet", HIGH), ("lower", 0.6), ("upper", 0.4)]
        self.assertEqual(len(last), len(asked))
        for row, (name, value) in zip(last, asked):
            self.assertEqual(row["opening"], name)
            self.assertAlmostEqual(float(row["asked"]), value, delta=1e-9)
            self.assertAlmostEqual(float(row["found"]), value, delta=0.01 * value)
        said = json.loads((self.base / "out" / "tune.json").read_text())
        self.assertTrue(said["reached"])
        self.assertEqual(len(said["beats"]), beats)
        for law in said["windkessels"].values():
            self.assertAlmostEqual(law["proximal"] / (law["proximal"] + law["distal"]), 0.08, delta=1e-4)
        self.assertIn("upper: 40 % of the flow", self.first.stderr)  # what none was asked for

    def test_the_case_that_is_left_keeps_what_was_asked_for(self):
        """Two beats of it, by the driver alone: what the second shows is read off its tables here."""
        folder = run(MONOLITHIC, self.base / "out" / "tuned.toml", self.base / "two", f"time.end={2 * PERIOD}")
        rows = {name: last_beat(values) for name, values in openings(folder).items()}
        self.assertAlmostEqual(rows["inlet"][:, 2].min(), LOW, delta=0.015 * LOW)
        self.assertAlmostEqual(rows["inlet"][:, 2].max(), HIGH, delta=0.015 * HIGH)
        lower, upper = (rows[name][:, 1].sum() for name in ("lower", "upper"))
        self.assertAlmostEqual(lower / (lower + upper), 0.6, delta=0.006)

    def test_a_call_that_was_killed_goes_on(self):
        """Without the record of the last beat, as a kill leaves it."""
        before = (self.base / "out" / "targets.csv").read_bytes()
        records = sorted(
            (self.base / "out" / "runs").glob("*/study_run.json"), key=lambda path: path.stat().st_mtime_ns
        )
        kept = [path.stat().st_mtime_ns for path in records[:-1]]
        self.assertTrue(kept)
        records[-1].unlink()
        again = self.tune("fork.toml", *self.words)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual([path.stat().st_mtime_ns for path in records[:-1]], kept)
        self.assertTrue(records[-1].exists())
        self.assertEqual((self.base / "out" / "targets.csv").read_bytes(), before)


class Tube(Tune):
    """An elastic tube with prestress, whose case runs until it is periodic, from a lumped start."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        sizes = ("--inner-radius", 3, "--media", 0.6, "--adventitia", 0, "--length", 20)
        cells = ("--lumen-cells", 4, "--media-cells", 1, "--axial-cells", 6)
        make_mesh(cls.base / "tube.msh", "--axisymmetric", *sizes, *cells)

    def test_both_drivers_find_the_same(self):
        found = {}
        for driver in ("monolithic", "partitioned"):
            process = self.tune(
                self.case("tube.toml"), "--pressure", "inlet=80/120mmHg", "--driver", driver, out=driver
            )
            self.assertEqual(process.returncode, 0, process.stderr)
            rows = table(self.base / driver / "targets.csv")
            for row, value in zip(rows[-2:], (LOW, HIGH)):
                self.assertAlmostEqual(float(row["found"]), value, delta=0.01 * value)
            self.assertLessEqual(int(rows[-1]["beat"]), 3)
            found[driver] = json.loads((self.base / driver / "tune.json").read_text())["windkessels"]["outlet"]
            text = (self.base / driver / "tuned.toml").read_text()
            self.assertIn('start = "given"', text)
            self.assertIn('periods = "until 1%"', text)
        for key, value in found["monolithic"].items():
            self.assertAlmostEqual(found["partitioned"][key], value, delta=1e-2 * value)
        vessel = table(self.base / "monolithic" / "vessel.csv")
        self.assertTrue(all(float(row["compliance_mm3_per_kPa"]) > 0 for row in vessel))

    def test_a_case_that_is_tuned_takes_one_beat(self):
        process = self.tune(self.case("tube.toml"), "--mean-pressure", "outlet=12kPa", "--proximal", "kept")
        self.assertEqual(process.returncode, 0, process.stderr)
        tuned = self.base / "out" / "tuned.toml"
        self.assertIn("proximal = 0.15,", tuned.read_text())
        again = execute(COMPARE, "tune", tuned, "--mean-pressure", "outlet=12kPa", "-o", self.base / "again")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(len(table(self.base / "again" / "targets.csv")), 1)

    def test_what_cannot_be_reached_is_said(self):
        (self.base / "no").mkdir()
        (self.base / "no" / "tuned.toml").write_text("of an earlier call")
        process = self.tune(self.case("tube.toml"), "--pressure", "inlet=80/82mmHg", "--beats", 2, out="no")
        self.assertEqual(process.returncode, 2, process.stderr)
        for words in (
            "Not reached in 2 beats.",
            "any compliance behind the outlets gives a pulse",
            "smaller --proximal",
        ):
            self.assertIn(words, process.stdout)
        self.assertFalse((self.base / "no" / "tuned.toml").exists())
        self.assertFalse(json.loads((self.base / "no" / "tune.json").read_text())["reached"])

    def test_a_case_that_no_driver_takes(self):
        case = self.case("tube.toml", "c10 = 130.0", "c10 = -130.0")
        process = self.tune(case, "--pressure", "inlet=80/120mmHg", "-q", out="bad")
        self.assertEqual(process.returncode, 1)
        self.assertIn("c10", process.stderr)
        self.assertEqual(len(process.stderr.splitlines()), 1, process.stderr)
        self.assertFalse((self.base / "bad" / "tune.json").exists())


if __name__ == "__main__":
    unittest.main()
