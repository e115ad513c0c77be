"""summary.json says what a step takes in work units, and where the run was made; `fsi-compare cost` shows it."""

import csv
import unittest
from pathlib import Path

from programs import DRIVERS, MONOLITHIC, NEO_HOOKEAN, FolderTest, attempt, execute, restart, run, summary, table

HERE = Path(__file__).resolve()
RIGID, WALL = HERE.parents[1] / "rigid_pipe" / "rigid_pipe.toml", HERE.parents[1] / "wall" / "static_wall.toml"
LIMIT = HERE.parents[1] / "exit_codes" / "beyond_the_limit.toml"
SHORT = ("time.end=0.375", "partitioned.tolerance=1e-2")  # three steps
COMPARE = Path(MONOLITHIC).parent / "fsi-compare"


def seconds_per_step(folder, first=0):
    """From step `first` on, of iterations.csv."""
    return table(folder, "iterations.csv")[first:, 5].mean()


class WorkUnits(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.runs = {
            program: run(program, NEO_HOOKEAN, cls.base / Path(program).name, *SHORT, "output.every=0")
            for program in DRIVERS
        }

    def test_memory_is_that_of_the_program_alone(self):
        """What starts the run may hold more than the run does."""
        launcher = b"x" * (400 << 20)
        folder = run(MONOLITHIC, NEO_HOOKEAN, self.base / "launched", *SHORT, "output.every=0")
        self.assertLess(summary(folder)["peak_memory_MiB"], len(launcher) / (1 << 20))

    def assertMeasured(self, folder, first=0):
        found = summary(folder)
        unit = found["work_unit"]
        self.assertGreater(unit["seconds"], 0)
        self.assertGreater(unit["entries"], 0)
        self.assertIn(unit["products"], range(1, 6))
        self.assertGreaterEqual(unit["measuring_s"], unit["products"] * unit["seconds"])
        in_seconds = found["totals"]["work_units_per_step"] * unit["seconds"]
        self.assertAlmostEqual(in_seconds / seconds_per_step(folder, first), 1, places=6)
        return unit

    def test_both_drivers_divide_by_a_product_of_one_matrix(self):
        one, two = (self.assertMeasured(folder) for folder in self.runs.values())
        self.assertEqual(one["entries"], two["entries"])

    def test_machine_and_build_are_named(self):
        for folder in self.runs.values():
            found = summary(folder)
            self.assertTrue(found["machine"]["processor"])
            self.assertRegex(found["build"]["compiler"], r"^(gcc|clang) \d+\.\d+\.\d+$")
            self.assertIn(found["build"]["doubles_per_pack"], (2, 4, 8))
            self.assertTrue(found["build"]["instruction_set"])

    def test_scenes_of_one_medium_have_its_matrix(self):
        for case, settings in ((RIGID, ("time.end=2",)), (WALL, ())):
            found = [
                self.assertMeasured(run(program, case, self.base / f"{case.stem}-{i}", *settings))
                for i, program in enumerate(DRIVERS)
            ]
            self.assertEqual(found[0]["entries"], found[1]["entries"])

    def test_a_restarted_run_counts_its_own_steps(self):
        folder = run(MONOLITHIC, NEO_HOOKEAN, self.base / "restarted", "time.end=0.25")
        restart(MONOLITHIC, NEO_HOOKEAN, folder, "time.end=0.625")
        self.assertMeasured(folder, first=2)
        restart(MONOLITHIC, NEO_HOOKEAN, folder, "time.end=0.625")
        found = summary(folder)
        self.assertEqual((found["work_unit"], found["totals"]["work_units_per_step"]), (None, None), "no step was made")

    def test_a_run_without_a_step_has_no_unit(self):
        folder = self.base / "failed"
        finished = attempt(
            MONOLITHIC, LIMIT, "-q", folder=folder, settings=("static.load_steps=1", "load.pressure=200")
        )
        self.assertEqual(finished.returncode, 2, finished.stderr)
        found = summary(folder)
        self.assertEqual((found["work_unit"], found["totals"]["work_units_per_step"]), (None, None))

    def test_the_table_of_costs_shows_them(self):
        out = self.base / "cost"
        finished = execute(COMPARE, "cost", *self.runs.values(), "-o", out)
        self.assertEqual((finished.returncode, finished.stderr), (0, ""))
        self.assertNotIn("These runs are of", finished.stdout, "one machine, one build")
        with open(out / "cost.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        for row, folder in zip(rows, self.runs.values()):
            work = float(row["work_units_per_step"])
            self.assertEqual(work, summary(folder)["totals"]["work_units_per_step"])
            unit = summary(folder)["work_unit"]["seconds"]
            self.assertAlmostEqual(work * unit / float(row["wall_s_per_step"]), 1, places=6)


if __name__ == "__main__":
    unittest.main()
