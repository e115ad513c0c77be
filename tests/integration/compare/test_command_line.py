"""fsi-compare as a user meets it: options, exit codes, printed tables, files written."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from folder_case import FolderCase
from fsi_compare import cli
from synthetic import TIMES, Z, parabola, write_run


class CommandLine(FolderCase):
    def setUp(self):
        super().setUp()
        wave = parabola(0.66)
        self.one = write_run(self.base / "one", wave)
        self.two = write_run(self.base / "two", lambda t, z: 0.99 * wave(t, z), program="fsi-partitioned")

    def assert_refused(self, expected, *arguments):
        code, out, err = self.call(*arguments)
        self.assertEqual(code, 1)
        self.assertEqual(out, "")
        self.assertEqual(err.count("\n"), 1)
        self.assertTrue(err.startswith("fsi-compare: error: "), err)
        self.assertIn(expected, err)
        self.assertFalse(self.out.exists(), "nothing may be written when the input is bad")

    def test_each_command_is_that_of_its_module(self):
        for name, module in {**cli.OF_RESULTS, **cli.OF_RUNS, **cli.OF_IMPORT}.items():
            with self.subTest(name):
                (commands,) = (a.choices for a in cli.parser("1.2.3", {name: module})._actions if a.choices)
                self.assertEqual(list(commands), [name])

    def test_tables(self):
        code, out, err = self.call("pressure", self.one, self.two, "-o", self.out)
        self.assertEqual((code, err), (0, ""))
        self.assertIn("Pressure of partitioned against monolithic (reference)", out)
        rows = [line.split() for line in out.splitlines()]
        # the second run is the first one times 0.99
        at_three = next(row for row in rows if row[:1] == ["3"])
        self.assertAlmostEqual(float(at_three[1]), 0.01 * parabola(0.66)(3, Z).max(), places=4)
        self.assertEqual((at_three[2], at_three[4]), ("1.00e-02", "1.00e-02"))
        self.assertIn("1.00e-02", next(line for line in out.splitlines() if line.strip().startswith("all 96")))
        self.assertEqual(out.count("speed between 4.5 and 9 ms: 0.6600 mm/ms"), 2)
        self.assertIn("49.5000", out)

    def test_times_of_short_runs(self):
        short = write_run(self.base / "short", parabola(0.5), times=np.arange(1, 31) / 10)
        asked = "1.5,3,4.5,6,7.5,9"  # those of long runs, by name: refused, not replaced
        self.assert_refused("4.5 ms is outside the run", "pressure", short, short, "-o", self.out, "--times", asked)
        code, _, err = self.call("pressure", short, short, "-o", self.out, "-q")
        self.assertEqual((code, err), (0, ""))
        times = sorted({float(row["time_ms"]) for row in self.csv("pressure_waves.csv")})
        self.assertEqual(times, [0.5, 1, 1.5, 2, 2.5, 3])

    def test_csv(self):
        self.call("pressure", self.one, self.two, "-o", self.out, "--times", "3,1.55", "--labels", "mono, part", "-q")
        rows = self.csv("pressure_waves.csv")
        self.assertEqual(list(rows[0]), ["run", "time_ms", "z_mm", "pressure_Pa"])
        self.assertEqual(len(rows), 2 * 2 * 181)
        self.assertEqual(
            [(row["run"], row["time_ms"]) for row in rows[::181]],
            [("mono", "1.55"), ("mono", "3.0"), ("part", "1.55"), ("part", "3.0")],
        )
        wave = parabola(0.66)
        np.testing.assert_array_equal([float(row["pressure_Pa"]) for row in rows[181:362]], wave(3.0, Z))
        np.testing.assert_allclose(
            [float(row["pressure_Pa"]) for row in rows[:181]], 0.6 * wave(1.5, Z) + 0.4 * wave(1.625, Z), atol=1e-12
        )

    def test_json(self):
        self.call("pressure", self.one, self.two, "-o", self.out, "-q")
        data = json.loads((self.out / "pressure_waves.json").read_text())
        self.assertEqual(data["reference"], "monolithic")
        self.assertAlmostEqual(data["runs"][1]["speed_mm_per_ms"], 0.66, places=9)
        self.assertAlmostEqual(data["runs"][1]["largest_difference"]["l2_relative"], 0.01, places=12)
        self.assertEqual(len(data["runs"][0]["peaks"]), 6)

    def test_files_and_quiet(self):
        code, out, err = self.call("pressure", self.one, self.two, "-o", self.out, "-q", "--threads", "2")
        self.assertEqual((code, out, err), (0, "", ""))
        self.assertEqual(
            sorted(path.name for path in self.out.iterdir()),
            ["pressure_waves." + kind for kind in ("csv", "json", "png", "svg")],
        )
        umask = os.umask(0)
        os.umask(umask)
        self.assertEqual((self.out / "pressure_waves.csv").stat().st_mode & 0o777, 0o666 & ~umask)

    def test_second_call_replaces_the_files(self):
        self.call("pressure", self.one, self.two, "-o", self.out, "-q")
        first = {path.name: path.read_bytes() for path in self.out.iterdir()}
        self.call("pressure", self.one, self.two, "-o", self.out, "-q")
        self.assertEqual(first, {path.name: path.read_bytes() for path in self.out.iterdir()})

    def test_single_run(self):
        code, out, _ = self.call("pressure", self.one, "-o", self.out)
        self.assertEqual(code, 0)
        self.assertNotIn("against", out)
        self.assertIn("Peak of monolithic", out)

    def test_other_points_and_short_run(self):
        coarse = write_run(self.base / "coarse", lambda t, z: 2 * t + z, TIMES[:24], np.linspace(0, 18, 37))
        fine = write_run(self.base / "fine", lambda t, z: 2 * t + z, TIMES[:24])
        code, out, err = self.call("pressure", fine, coarse, "-o", self.out, "--times", "1,2")
        self.assertEqual((code, err), (0, ""))
        self.assertIn("speed between 4.5 and 9 ms: n/a", out)
        data = json.loads((self.out / "pressure_waves.json").read_text())
        self.assertLess(data["runs"][1]["largest_difference"]["max_norm_Pa"], 1e-12)

    def made(self, name, mesh, times=TIMES, **more):
        return write_run(self.base / name, parabola(0.66), times, mesh=mesh, **more)

    def compared(self, *runs, words=("--times", "1,2", "--labels", "one,two")):
        """(printed, error output, warnings of the JSON file) of runs that can be compared."""
        code, out, err = self.call("pressure", *runs, "-o", self.out, *words)
        self.assertEqual(code, 0, err)
        return out, err, json.loads((self.out / "pressure_waves.json").read_text())

    def test_different_meshes_are_named_with_a_warning(self):
        coarse = self.made("coarse", {"name": "level coarse", "nodes": 1032, "hash": "03"})
        fine = self.made("fine", {"name": "level fine", "nodes": 54540, "hash": "04"})
        out, err, data = self.compared(coarse, fine)
        expected = "the runs' meshes differ (one: level coarse, 1032 nodes; two: level fine, 54540 nodes)"
        self.assertEqual(err.count("\n"), 1)
        self.assertTrue(err.startswith(f"fsi-compare: warning: {expected}"), err)
        self.assertIn(f"Note: {expected}", out)
        self.assertIn("mesh level fine, 54540 nodes, step 0.125 ms", out)
        self.assertEqual(len(data["warnings"]), 1)
        self.assertTrue(data["warnings"][0].startswith(expected))
        self.assertEqual(
            [(run["mesh"], run["step_ms"], run["end_ms"]) for run in data["runs"]],
            [("level coarse, 1032 nodes", [0.125, 0.125], 12.0), ("level fine, 54540 nodes", [0.125, 0.125], 12.0)],
        )
        _, err, data = self.compared(coarse, fine, words=("--times", "1", "-q"))
        self.assertEqual((err, len(data["warnings"])), ("", 1))

    def test_meshes_of_one_name_that_are_not_the_same(self):
        one, two = ({"name": "tube.msh", "nodes": 99, "hash": key} for key in ("03", "04"))
        _, err, _ = self.compared(self.made("a", one), self.made("b", two))
        self.assertIn("meshes differ", err)

    def test_different_steps_and_lengths_are_named_with_a_warning(self):
        mesh = {"name": "level coarse", "nodes": 1032, "hash": "03"}
        whole, half = self.made("whole", mesh), self.made("half", mesh, TIMES[:48] / 2)
        _, err, data = self.compared(whole, half)
        self.assertIn("the runs' time steps differ (one: step 0.125 ms; two: step 0.0625 ms)", err)
        self.assertIn("the runs' lengths differ (one: 12 ms; two: 3 ms)", err)
        self.assertEqual((err.count("\n"), len(data["warnings"])), (2, 2))
        changed = self.made("changed", mesh, np.concatenate([TIMES[:48], TIMES[47] + TIMES[:96] / 2]))
        _, err, _ = self.compared(whole, changed)
        self.assertIn("(one: step 0.125 ms; two: steps of 0.0625 to 0.125 ms)", err)
        self.assertNotIn("lengths", err)

    def test_nothing_is_said_of_equal_or_unknown_conditions(self):
        mesh = {"name": "level coarse", "nodes": 1032, "hash": "03"}
        a, b = self.made("a", mesh), self.made("b", mesh, program="fsi-partitioned")
        out, err, data = self.compared(a, b)
        self.assertEqual((err, data["warnings"]), ("", []))
        self.assertNotIn("Note:", out)
        _, err, data = self.compared(a, self.one)  # whose summary holds no mesh
        self.assertEqual((err, data["runs"][1]["mesh"]), ("", None))

    def test_title(self):
        self.call("pressure", self.one, self.two, "-o", self.out, "-q")
        self.assertIn("Synthetic tube", (self.out / "pressure_waves.svg").read_text())
        self.call("pressure", self.one, self.two, "-o", self.out, "-q", "--title", "My heading")
        self.assertIn("My heading", (self.out / "pressure_waves.svg").read_text())

    def test_time_outside_names_the_range(self):
        short = write_run(self.base / "short", parabola(0.6), TIMES[:24])
        self.assert_refused(
            "short/centerline_pressure.csv: --times: 4.5 ms is outside the run; give times between 0.125 and 3 ms",
            "pressure",
            self.one,
            short,
            "-o",
            self.out,
            "--times",
            "1.5,3,4.5",
        )

    def test_other_length(self):
        short = write_run(self.base / "short", parabola(0.6), TIMES, Z[:100])
        self.assert_refused(
            "z_mm: runs from 0 to 9.9 mm, the first run's from 0 to 18 mm", "pressure", self.one, short, "-o", self.out
        )

    def test_unfinished_run(self):
        running = write_run(self.base / "running", parabola(0.6), status="running")
        self.assert_refused(
            "running/summary.json: status: the run is not finished", "pressure", self.one, running, "-o", self.out
        )

    def test_wrong_use(self):
        one, two, out = self.one, self.two, ("-o", self.out)
        self.assert_refused("--times: 'x' is not a number", "pressure", one, "--times", "1,x", *out)
        self.assert_refused("--times: -1 is not a time", "pressure", one, "--times=-1", *out)
        self.assert_refused("--times: 3 is given twice", "pressure", one, "--times", "3,3", *out)
        self.assert_refused("--labels: 1 labels for 2 runs", "pressure", one, two, "--labels", "a", *out)
        self.assert_refused("--labels: 'a' is given twice", "pressure", one, two, "--labels", "a,a", *out)
        self.assert_refused("--labels: a label is empty", "pressure", one, two, "--labels", "a,", *out)
        self.assert_refused("--threads: 0 is not positive", "pressure", one, "--threads", "0", *out)
        self.assert_refused("see fsi-compare pressure --help", "pressure")
        self.assert_refused("no command; see fsi-compare --help")
        self.assert_refused("invalid choice: 'presure'", "presure", one)
        self.assert_refused("--colour", "pressure", one, "--colour")

    def test_output_is_a_file(self):
        code, _, err = self.call("pressure", self.one, "-o", self.one / "summary.json")
        self.assertEqual(code, 1)
        self.assertIn("summary.json: --output: is a file, not a folder; name another folder", err)

    def test_help_and_version(self):
        self.assertEqual(self.call("--version"), (0, "fsi-compare 1.2.3\n", ""))
        code, out, _ = self.call("pressure", "--help")
        self.assertEqual(code, 0)
        for option in ("--output", "--times", "--labels", "--title", "--threads", "--quiet"):
            self.assertIn(option, out)


@unittest.skipUnless(os.environ.get("FSI_COMPARE"), "FSI_COMPARE names the built program")
class BuiltProgram(unittest.TestCase):
    def call(self, *arguments, **options):
        words = [os.environ["FSI_COMPARE"], *map(str, arguments)]
        return subprocess.run(words, capture_output=True, text=True, **options)

    def test_version(self):
        done = self.call("--version")
        self.assertEqual((done.returncode, done.stdout), (0, f"fsi-compare {os.environ['FSI_VERSION']}\n"))

    def test_runs_from_anywhere_with_a_foreign_python_path(self):
        with tempfile.TemporaryDirectory() as folder:
            base = Path(folder)
            (base / "numpy.py").write_text("raise ImportError('not the one')")
            one = write_run(base / "a run", parabola(0.6))
            done = self.call(
                "pressure", one.name, "-o", "my output", cwd=base, env={**os.environ, "PYTHONPATH": folder}
            )
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue((base / "my output" / "pressure_waves.png").is_file())

    def test_exit_code_of_an_error(self):
        done = self.call("pressure", "/nowhere")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertEqual(
            done.stderr, "fsi-compare: error: /nowhere: no such folder; give the folder that a run wrote with -o\n"
        )


if __name__ == "__main__":
    unittest.main()
