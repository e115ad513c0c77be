"""A run that was stopped, in whatever way, goes on bit for bit as if it had not been."""

import random
import shutil
import subprocess
import time
import unittest
from pathlib import Path

import numpy as np
from programs import (
    ARTERY,
    MONOLITHIC,
    NEO_HOOKEAN,
    PARTITIONED,
    TABLES,
    FolderTest,
    arrays,
    attempt,
    difference,
    driver_command,
    iterations_without_seconds,
    make_mesh,
    make_small_mesh,
    newton_history,
    pressure,
    restart,
    run,
    summary,
    table,
    times,
)

STEP = 0.125  # ms, of the case files


class Restart:
    """Tests of both drivers: the artery on a short mesh, fibres and kept Jacobians included."""

    steps = 8
    settings = ()
    kills = 4

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_small_mesh(cls.base / "small.msh")
        cls.settings = (f"mesh.file={mesh}", *cls.settings)
        cls.whole = cls.march("whole")

    @classmethod
    def until(cls, step, *settings):
        """All settings of a run that ends after a step; fields are written every second one."""
        return (*cls.settings, f"time.end={step * STEP}", "output.every=2", *settings)

    @classmethod
    def march(cls, name, *settings, steps=None):
        return run(cls.program, ARTERY, cls.base / name, *cls.until(steps or cls.steps, *settings))

    def go_on(self, folder, *settings, into=None):
        return restart(self.program, ARTERY, folder, *self.until(self.steps, *settings), into=into)

    def test_in_place(self):
        folder = self.march("in_place", steps=2)
        self.assertEqual(table(folder, "iterations.csv")[:, 0].tolist(), [1, 2])
        self.assertSameResults(self.go_on(folder), self.whole)
        self.assertEqual(summary(folder)["restarted_from_step"], 2)
        self.assertEqual(*(summary(of)["wall_deformation"] for of in (folder, self.whole)), "extremes of the whole run")

    def test_in_place_by_name(self):
        folder = self.march("by_name", steps=2)
        self.assertSameResults(self.go_on(folder, into=folder), self.whole)

    def test_into_another_folder(self):
        folder = self.march("source", steps=2)
        before = {file.name: file.read_bytes() for file in folder.iterdir()}
        self.assertSameResults(self.go_on(folder, into=self.base / "elsewhere"), self.whole)
        self.assertEqual({file.name: file.read_bytes() for file in folder.iterdir()}, before)

    def test_again_and_again(self):
        folder = self.march("again", steps=1)
        for step in range(2, self.steps + 1):
            restart(self.program, ARTERY, folder, *self.until(step))
        self.assertSameTables(folder, self.whole)

    def test_of_a_finished_run_changes_nothing(self):
        folder = self.march("finished")
        self.assertSameResults(self.go_on(folder), self.whole)

    def test_fields_keep_what_the_shorter_run_had(self):
        folder = self.go_on(self.march("fields", steps=3))  # a run writes its last step, planned or not
        longer, fields = arrays(self.whole / "fields.h5"), arrays(folder / "fields.h5")
        self.assertEqual(fields["steps/number"].tolist(), sorted([*longer["steps/number"], 3]))
        for name, values in longer.items():
            if not name.startswith("steps/"):
                self.assertEqual(fields[name].tobytes(), values.tobytes(), name)

    def test_at_a_time_that_is_no_binary_fraction(self):
        """3 * 0.1 > 0.3 in doubles: the shorter run's last time must be the longer one's third."""
        settings = ("time.step=0.1", "inlet.until=0.2")  # steps end where the load jumps
        whole = self.march("decimal_whole", *settings, "time.end=0.5")
        folder = self.march("decimal", *settings, "time.end=0.3")
        self.assertSameTables(self.go_on(folder, *settings, "time.end=0.5"), whole)

    def test_with_quadratic_predictor(self):
        """It needs three finished levels; after the third step all of them have moved."""
        whole = self.march("predictor_whole", "time.predictor=2")
        folder = self.go_on(self.march("predictor", "time.predictor=2", steps=3), "time.predictor=2")
        self.assertSameTables(folder, whole)
        without = self.march("no_predictor", "time.predictor=0")
        self.assertNotEqual((folder / "flow.csv").read_bytes(), (without / "flow.csv").read_bytes())

    def test_wall_clock_and_counts_go_on(self):
        folder = self.go_on(self.march("counts", steps=2))
        rows = table(folder, "iterations.csv")
        self.assertEqual(rows[:, 0].tolist(), list(range(1, self.steps + 1)))
        self.assertTrue((rows[:, 5] > 0).all())
        self.assertEqual((folder / "run.log").read_text().count("restarted after step 2"), 1)

    # ---- Another step

    def test_with_half_the_step(self):
        """The times are those of both steps, to the end; what was there stays."""
        first = self.steps // 4
        folder = self.march("halved", steps=first)
        before = {name: (folder / name).read_text() for name in TABLES}
        process = attempt(
            self.program, ARTERY, "--restart", folder, settings=self.until(self.steps, "time.step=0.0625")
        )
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        said = (
            f"time.step is 0.0625 ms from step {first + 1} on, 0.125 ms before: "
            f"{2 * (self.steps - first)} steps to come"
        )
        self.assertIn(said, process.stdout)
        self.assertIn(said, (folder / "run.log").read_text())
        expected = [STEP * k for k in range(1, first + 1)]
        expected += [STEP * (first + k / 2) for k in range(1, 2 * (self.steps - first) + 1)]
        self.assertEqual(times(folder), [f"{time:g}" for time in expected])
        for name, text in before.items():
            self.assertTrue((folder / name).read_text().startswith(text), name)
        self.assertEqual(np.unique(table(folder, "flow.csv")[:, 0]).tolist(), expected)
        self.assertEqual(arrays(folder / "fields.h5")["steps/time"][-1], self.steps * STEP)

    def test_with_another_step_is_what_it_is_wherever_it_stops(self):
        """Restarts after the change, with the same step, change no bit."""
        begun = self.march("begun", steps=2)
        changed = ("time.step=0.0625",)
        whole = self.go_on(begun, *changed, into=self.base / "changed_whole")
        stopped = restart(self.program, ARTERY, begun, *self.until(3, *changed), into=self.base / "changed")
        self.assertEqual(len(times(stopped)), 4)
        self.assertNotIn("time.step is", (self.go_on(stopped, *changed) / "run.log").read_text().split("restarted")[-1])
        self.assertSameTables(stopped, whole)

    def test_with_a_step_that_misses_the_end(self):
        """The last one is cut short."""
        folder = self.march("misses", steps=1)
        restart(self.program, ARTERY, folder, *self.settings, "time.step=0.25", "time.end=0.5")
        self.assertEqual(times(folder), ["0.125", "0.375", "0.5"])
        self.assertNoNan(folder)

    # ---- Kills

    def start(self, folder, *settings):
        command = driver_command(
            self.program, ARTERY, "-q", folder=folder, settings=(*self.until(self.steps, "output.every=1"), *settings)
        )
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def kill_when(self, process, reached):
        """Kills as soon as the condition holds; returns whether the run was still going on."""
        with process:
            deadline = time.monotonic() + 100
            while process.poll() is None and not reached() and time.monotonic() < deadline:
                time.sleep(0.0005)
            process.kill()
        return process.returncode < 0

    def test_after_kills_at_random_moments(self):
        each = "output.checkpoint_every=1"  # by time such a run has one at its end
        whole = self.march("kill_whole", "output.every=1", each)
        seconds = table(whole, "iterations.csv")[1:, 5].sum()  # after the first checkpoint
        killed = 0
        for k in range(self.kills):
            folder, delay = self.base / f"killed{k}", random.uniform(0, 0.9 * seconds)
            process = self.start(folder, each)
            saved = []

            def reached():
                if not saved and (folder / "checkpoint.h5").exists():
                    saved.append(time.monotonic())
                return saved and time.monotonic() > saved[0] + delay

            killed += self.kill_when(process, reached)
            with self.subTest(delay=delay):
                self.go_on(folder, "output.every=1")
                self.assertSameResults(folder, whole)
                self.assertEqual(
                    sorted(file.name for file in folder.iterdir()), sorted(file.name for file in whole.iterdir())
                )
        self.assertGreater(killed, 0, "every run was faster than its kill")

    def test_from_a_checkpoint_before_the_last_finished_step(self):
        whole = self.march("every_whole", "output.every=1", "output.checkpoint_every=3")
        rows = lambda folder: len(iterations_without_seconds(folder)) - 1
        for k in range(10):
            folder = self.base / f"every{k}"
            process = self.start(folder, "output.checkpoint_every=3")
            caught = self.kill_when(process, lambda: (folder / "iterations.csv").exists() and rows(folder) >= 4)
            step = int(arrays(folder / "checkpoint.h5")["step"][0])
            if caught and rows(folder) > step:
                break
        self.assertGreater(rows(folder), step, "no kill fell between two checkpoints")
        self.assertEqual(step % 3, 0)
        torn = (folder / "flow.csv").read_bytes() + b"0.625,1.2"  # as a kill within a write would leave it
        (folder / "flow.csv").write_bytes(torn)
        self.go_on(folder, "output.every=1", "output.checkpoint_every=3")
        self.assertSameResults(folder, whole)

    # ---- Mistakes

    def test_refuses_what_is_not_the_same_run(self):
        folder = self.march("refused", steps=1)
        before = {file.name: file.read_bytes() for file in folder.iterdir()}
        mesh = make_mesh(self.base / "other.msh", "--level", "coarse", "--length", 5)
        for case, settings, what in (
            (NEO_HOOKEAN, (), "another case"),
            (ARTERY, ("fluid.density=2",), "another case"),
            (ARTERY, ("time.newmark_beta=0.9",), "another case"),
            (ARTERY, (f"mesh.file={mesh}",), "another mesh"),
            (ARTERY, ('output.fields=["velocity"]', "output.every=1"), "displacement: is a field that this restart"),
        ):
            process = attempt(self.program, case, "--restart", folder, settings=self.until(2, *settings))
            self.assertEqual(process.returncode, 1)
            self.assertIn(what, process.stderr)
        program = MONOLITHIC if self.program == PARTITIONED else PARTITIONED
        process = attempt(program, ARTERY, "--restart", folder, settings=self.until(2))
        self.assertEqual(process.returncode, 1)
        self.assertIn("was written by", process.stderr)
        self.assertEqual({file.name: file.read_bytes() for file in folder.iterdir()}, before)

    def test_refuses_a_damaged_checkpoint(self):
        folder = self.march("damaged", steps=1)
        for name, damage in (("cut", lambda b: b[:-100]), ("bit", lambda b: b[:-9] + bytes([b[-9] ^ 1]) + b[-8:])):
            copy = self.base / f"damaged_{name}"
            shutil.copytree(folder, copy)
            (copy / "checkpoint.h5").write_bytes(damage((folder / "checkpoint.h5").read_bytes()))
            process = attempt(self.program, ARTERY, "--restart", copy, settings=self.until(2))
            self.assertEqual(process.returncode, 1)
            self.assertIn("checksum", process.stderr)


class Monolithic(Restart, FolderTest):
    program = MONOLITHIC

    def test_with_a_jacobian_renewed_in_the_run(self):
        folder = self.march("renewed", steps=5)
        renewed = [any(again for *_, again in step) for step in newton_history(folder)]
        self.assertTrue(any(renewed[1:]), "no Jacobian was renewed after the first step: the test shows nothing")
        self.assertSameTables(self.go_on(folder), self.whole)

    def test_wave_with_half_the_step(self):
        """It is nearer than that of the large step to that of the small step throughout."""
        folder = self.march("wave", steps=2)
        restart(self.program, ARTERY, folder, *self.until(self.steps, "time.step=0.0625"))
        fine = pressure(self.march("fine", "time.step=0.0625"))[-1]
        error = lambda run: np.abs(pressure(run)[-1] - fine).max() / np.abs(fine).max()
        print(f"against the small step throughout: halved early {error(folder):.3f}, never {error(self.whole):.3f}")
        self.assertLess(error(folder), 0.7 * error(self.whole))

    def test_with_full_newton(self):
        whole = self.march("full_whole", "newton.mode=full")
        folder = self.go_on(self.march("full", "newton.mode=full", steps=2), "newton.mode=full")
        self.assertSameTables(folder, whole)


class Partitioned(Restart, FolderTest):
    program = PARTITIONED
    steps = 5
    # To be quick; bits must agree at any tolerance. A pressure for each layer, other than in the monolithic runs.
    settings = ("partitioned.tolerance=1e-1", "structure.layer_pressure=separate")
    kills = 3

    def test_with_half_the_step_as_the_monolithic_driver(self):
        """The levels of both lengths are extrapolated in one driver and not in the other: the answers agree."""
        found = []
        for program, *settings in (
            (PARTITIONED, "partitioned.tolerance=1e-7", "time.predictor=2"),
            (MONOLITHIC, "time.predictor=0"),
        ):
            folder = self.base / f"agree_{Path(program).name}"
            run(program, ARTERY, folder, *self.until(2, *settings))
            restart(program, ARTERY, folder, *self.until(4, "time.step=0.0625", *settings))
            found.append(pressure(folder))
        apart = difference(*found)
        print("partitioned against monolithic, step by step:", apart)
        self.assertEqual(len(apart), 6)
        self.assertLess(apart.max(), 1e-5)


if __name__ == "__main__":
    unittest.main()
