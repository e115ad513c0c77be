"""fsi-compare cost: the table of what finished runs took."""

import json
import unittest

from folder_case import FolderCase
from synthetic import parabola, write_run

ITERATIONS = "step,time_ms,outer_iterations,newton_iterations,linear_iterations,wall_s\n"
COUPLING = "step,time_ms,displacement_residual,force_residual\n"


def phases(**calls):
    """Phases of a summary: solve__mesh_motion is "solve: mesh motion"."""

    def spelt(name):
        return name.replace("set_up", "set-up").replace("__", ": ").replace("_", " ")

    return {spelt(name): {"seconds": 0.1, "calls": n} for name, n in calls.items()}


class Cost(FolderCase):
    def setUp(self):
        super().setUp()
        common = {"mesh": {"nodes": 1032}, "unknowns": {"coupled": 4662}, "threads": 1, "peak_memory_MiB": 30.5}
        self.whole = write_run(
            self.base / "whole", parabola(0.66), phases=phases(solve__coupled=10, factorisation__coupled=1), **common
        )
        (self.whole / "iterations.csv").write_text(ITERATIONS + "1,0.125,1,6,0,0.5\n2,0.25,1,4,0,0.25\n")
        self.parts = write_run(
            self.base / "parts",
            parabola(0.66),
            program="fsi-partitioned",
            phases=phases(
                solve__fluid=30, solve__wall=20, solve__mesh_motion=11, factorisation__fluid=1, set_up__wall=2
            ),
            **common,
        )
        (self.parts / "iterations.csv").write_text(ITERATIONS + "1,0.125,8,30,70,1\n2,0.25,3,20,30,0.5\n")
        (self.parts / "coupling.csv").write_text(COUPLING + "1,0.125,4e-7,2e-6\n2,0.25,9e-7,1e-6\n")

    def assert_refused(self, expected, *arguments):
        code, out, err = self.call("cost", *arguments, "-o", self.out)
        self.assertEqual((code, out, err.count("\n")), (1, "", 1))
        self.assertIn(expected, err)
        self.assertFalse(self.out.exists())

    def test_numbers(self):
        code, out, err = self.call("cost", self.whole, self.parts, "-o", self.out)
        self.assertEqual((code, err), (0, ""))
        whole, parts = self.csv("cost.csv")
        self.assertEqual((whole["run"], whole["program"], whole["steps"]), ("whole", "monolithic", "2"))
        self.assertEqual((float(whole["wall_s"]), float(parts["wall_relative_to_first"])), (0.75, 2.0))
        self.assertEqual((whole["coupling_iterations_mean"], whole["displacement_residual_max"]), ("", ""))
        self.assertEqual(
            (
                float(parts["coupling_iterations_mean"]),
                parts["coupling_iterations_min"],
                parts["coupling_iterations_max"],
            ),
            (5.5, "3", "8"),
        )
        self.assertEqual(
            [parts[f"solves_{name}"] for name in ("whole", "fluid", "wall", "mesh")], ["", "30", "20", "11"]
        )
        self.assertEqual((whole["solves_whole"], whole["preparations_whole"]), ("10", "1"))
        self.assertEqual((parts["newton_iterations"], parts["linear_iterations"]), ("50", "100"))
        self.assertEqual((float(parts["displacement_residual_max"]), float(parts["force_residual_max"])), (9e-7, 2e-6))
        row = next(line for line in out.splitlines() if line.strip().startswith("parts"))
        for cell in ("partitioned", "5.50", "3-8", "15.0", "10.0", "2.00", "9.0e-07"):
            self.assertIn(cell, row)
        self.assertIn("| parts | partitioned |", (self.out / "cost.md").read_text())

    def test_labels_and_quiet(self):
        code, out, _ = self.call("cost", self.whole, self.parts, "-o", self.out, "--labels", "a,b", "-q")
        self.assertEqual((code, out), (0, ""))
        self.assertTrue((self.out / "cost.csv").read_text().splitlines()[2].startswith("b,"))

    def test_says_what_does_not_compare(self):
        summary = json.loads((self.parts / "summary.json").read_text())
        (self.parts / "summary.json").write_text(
            json.dumps({**summary, "threads": 2, "restarted_from_step": 1, "mesh": {"nodes": 7}})
        )
        _, out, _ = self.call("cost", self.whole, self.parts, "-o", self.out)
        for note in ("different numbers of threads", "differ in mesh", "Restarted"):
            self.assertIn(note, out)

    def doctor(self, folder, **entries):
        """Writes these entries into the run's summary; None removes one."""
        path = folder / "summary.json"
        summary = {**json.loads(path.read_text()), **entries}
        path.write_text(json.dumps({key: value for key, value in summary.items() if value is not None}))

    def test_work_units_of_runs_that_measured_them(self):
        self.doctor(self.whole, totals={"steps": 2, "work_units_per_step": 150.0})
        self.doctor(self.parts, totals={"steps": 2, "work_units_per_step": 600.0})
        _, out, _ = self.call("cost", self.whole, self.parts, "-o", self.out)
        whole, parts = self.csv("cost.csv")
        self.assertEqual([float(run["work_units_per_step"]) for run in (whole, parts)], [150, 600])
        self.assertEqual([float(run["work_units_relative_to_first"]) for run in (whole, parts)], [1, 4])
        self.assertLess(out.index("work units"), out.index("seconds per step"), "work units come first")
        row = next(line for line in out.splitlines() if line.strip().startswith("parts"))
        self.assertRegex(row, r" 600 +4\.00 +0\.75 +2\.00 ")
        self.assertIn("Work units: ", out)

    def test_runs_without_work_units_have_empty_cells(self):
        self.doctor(self.parts, totals={"steps": 2, "work_units_per_step": 600.0}, work_unit={"seconds": 0.00125})
        self.doctor(self.whole, work_unit=None, totals={"steps": 2, "work_units_per_step": None})
        _, out, _ = self.call("cost", self.whole, self.parts, "-o", self.out)
        whole, parts = self.csv("cost.csv")
        self.assertEqual((whole["work_units_per_step"], float(parts["work_units_per_step"])), ("", 600))
        self.assertEqual(parts["work_units_relative_to_first"], "")
        row = next(line for line in out.splitlines() if line.strip().startswith("whole"))
        self.assertRegex(row, r" 1 +2 +0\.375 ", "an empty cell between steps and seconds")

    def test_names_machines_and_builds_that_differ(self):
        build = {"compiler": "gcc 12.2.0", "instruction_set": "x86-64-v4"}
        for folder in (self.whole, self.parts):
            self.doctor(folder, machine={"processor": "Maker A"}, build=build)
        _, out, _ = self.call("cost", self.whole, self.parts, "-o", self.out)
        self.assertNotIn("These runs are of", out)
        self.doctor(self.parts, machine={"processor": "Maker B"})
        _, out, _ = self.call("cost", self.whole, self.parts, "-o", self.out)
        said = "These runs are of 2 processors: Maker A, Maker B; compare work units, not seconds."
        self.assertEqual(out.count(said), 1)
        self.assertIn(said, (self.out / "cost.md").read_text())
        self.doctor(self.parts, build={**build, "instruction_set": "x86-64-v3"})
        _, out, _ = self.call("cost", self.whole, self.parts, "-o", self.out)
        builds = "0.1.0 gcc 12.2.0 x86-64-v4, 0.1.0 gcc 12.2.0 x86-64-v3"
        self.assertIn(f"Maker A, Maker B; and of 2 builds: {builds}; compare work units", out)
        self.doctor(self.parts, machine={"processor": "Maker A"}, build=build, version="0.2.0")
        _, out, _ = self.call("cost", self.whole, self.parts, "-o", self.out)
        self.assertIn("These runs are of 2 builds: 0.1.0 gcc 12.2.0 x86-64-v4, 0.2.0 gcc", out)

    def test_a_run_that_does_not_name_its_build_is_another_one(self):
        _, out, _ = self.call("cost", self.whole, self.parts, "-o", self.out)
        self.assertNotIn("These runs are of", out, "neither names one")
        self.doctor(self.parts, build={"compiler": "gcc 12.2.0", "instruction_set": "x86-64-v4"})
        _, out, _ = self.call("cost", self.whole, self.parts, "-o", self.out)
        self.assertIn("2 builds: 0.1.0 gcc 12.2.0 x86-64-v4, one that does not name itself;", out)

    def test_refusals(self):
        self.assert_refused("no such folder", self.base / "missing")
        self.assert_refused("2 labels for 1 runs", self.whole, "--labels", "a,b")
        (self.parts / "coupling.csv").write_text(COUPLING + "1,0.125,nan,2e-6\n")
        self.assert_refused("coupling.csv: line 2: displacement_residual is nan", self.parts)
        (self.whole / "iterations.csv").write_text(ITERATIONS)
        self.assert_refused("iterations.csv: holds no time step", self.whole)
        (self.whole / "iterations.csv").unlink()
        self.assert_refused("iterations.csv: is missing", self.whole)
        (self.whole / "summary.json").write_text('{"program": "fsi-monolithic", "status": "running"}')
        self.assert_refused("the run is not finished", self.whole)


if __name__ == "__main__":
    unittest.main()
