"""Steps that choose their lengths, steps that failed and are halved, and a pressure that alternates from step to step."""

import unittest

import numpy as np
from programs import (
    DRIVERS,
    MONOLITHIC,
    NEO_HOOKEAN,
    FolderTest,
    arrays,
    attempt,
    make_mesh,
    make_small_mesh,
    restart,
    run,
    summary,
    table,
)

ADAPTIVE = ("time.step=adaptive", "time.tolerance=0.3", "time.first_step=0.03", "output.interval=0.25")
AXISYMMETRIC = NEO_HOOKEAN.parent / "axisymmetric" / "neo-hookean.toml"
PULSE = 0.125  # ms, of the case file


class Small(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = f"mesh.file={make_small_mesh(cls.base / 'small.msh')}"


class AdaptiveSteps(Small):
    def test_stops_are_hit_and_a_restart_has_the_same_bits(self):
        for program in DRIVERS:
            with self.subTest(program=program):
                settings = (self.mesh, *ADAPTIVE)
                whole = run(program, NEO_HOOKEAN, self.base / "whole", *settings, "time.end=1.5")
                ends = table(whole, "iterations.csv")[:, 1]
                print("steps end at", ends)
                self.assertGreater(np.diff(ends[ends >= PULSE]).max(), 1.5 * np.diff(ends[ends >= PULSE]).min())
                for stop in (PULSE, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5):
                    self.assertIn(stop, ends)
                self.assertEqual(arrays(whole / "fields.h5")["steps/time"].tolist(), [0.25 * k for k in range(7)])
                self.assertEqual(np.unique(table(whole, "flow.csv")[:, 0]).tolist(), ends.tolist())
                # 1 ms is a stop of the whole run too.
                folder = run(program, NEO_HOOKEAN, self.base / "stopped", *settings, "time.end=1")
                restart(program, NEO_HOOKEAN, folder, *settings, "time.end=1.5")
                self.assertSameResults(folder, whole)

    def test_a_tighter_tolerance_takes_more_steps(self):
        counts = [
            summary(
                run(
                    MONOLITHIC,
                    NEO_HOOKEAN,
                    self.base / f"tolerance{tolerance}",
                    self.mesh,
                    "time.step=adaptive",
                    f"time.tolerance={tolerance}",
                    "time.end=0.5",
                    "output.every=0",
                )
            )["totals"]["steps"]
            for tolerance in (0.1, 0.02)
        ]
        self.assertLess(counts[0], counts[1])

    def test_rejected_steps_are_counted(self):
        folder = run(
            MONOLITHIC,
            NEO_HOOKEAN,
            self.base / "rejected",
            self.mesh,
            "time.step=adaptive",
            "time.tolerance=0.01",
            "time.first_step=0.125",
            "time.smallest_step=0.02",
            "time.end=1",
            "output.every=0",
        )
        rejected = summary(folder)["totals"]["rejected_steps"]
        self.assertGreater(rejected, 0)
        self.assertEqual((folder / "run.log").read_text().count(" rejected with "), rejected)
        self.assertEqual(summary(folder)["totals"]["steps"], len(table(folder, "iterations.csv")))

    def test_goes_on_from_equal_steps_and_back(self):
        folder = run(MONOLITHIC, NEO_HOOKEAN, self.base / "mixed", self.mesh, "time.end=0.25")
        restart(MONOLITHIC, NEO_HOOKEAN, folder, self.mesh, *ADAPTIVE, "time.end=0.5")
        restart(MONOLITHIC, NEO_HOOKEAN, folder, self.mesh, "time.end=1")
        ends = table(folder, "iterations.csv")[:, 1]
        self.assertEqual(ends[:2].tolist(), [0.125, 0.25])
        self.assertEqual(ends[-5:].tolist(), [0.5, 0.625, 0.75, 0.875, 1.0])


class FailedSteps(Small):
    """Too few iterations for steps of this length, but not for half of it."""

    settings = ("time.step=0.5", "time.end=2", "newton.mode=full", "newton.max_iterations=3")

    def test_are_halved_and_return_to_the_grid(self):
        folder = run(MONOLITHIC, NEO_HOOKEAN, self.base / "halved", self.mesh, *self.settings, "output.every=1")
        ends = table(folder, "iterations.csv")[:, 1].tolist()
        print("steps end at", ends)
        grid = [PULSE, 0.625, 1.125, 1.625, 2.0]
        self.assertGreater(len(ends), len(grid))
        self.assertEqual([end for end in ends if end in grid], grid)
        self.assertEqual(arrays(folder / "fields.h5")["steps/time"].tolist(), [0, *grid])
        failed = summary(folder)["totals"]["failed_steps"]
        self.assertGreater(failed, 0)
        self.assertEqual((folder / "run.log").read_text().count("; again with "), failed)

    def test_are_walked_to_where_they_may_not_be_halved(self):
        """Each step through solutions of shorter ones: the levels are those of whole steps, and so is what they hold."""
        settings = (self.mesh, *self.settings, "time.retries=0")
        walked = run(MONOLITHIC, NEO_HOOKEAN, self.base / "walked", *settings)
        at_once = run(MONOLITHIC, NEO_HOOKEAN, self.base / "at_once", *settings, "newton.max_iterations=30")
        self.assertIn("; again from solutions of shorter steps", (walked / "run.log").read_text())
        self.assertNotIn("; again", (at_once / "run.log").read_text())
        self.assertEqual(summary(walked)["totals"]["steps"], summary(at_once)["totals"]["steps"])
        one, other = (table(folder, "wall_displacement.csv") for folder in (walked, at_once))
        self.assertEqual(one.shape, other.shape)
        self.assertLess(np.abs(one - other).max(), 1e-6 * np.abs(other).max())

    def test_end_the_run_where_no_way_leads_to_them(self):
        process = attempt(
            MONOLITHIC,
            NEO_HOOKEAN,
            folder=self.base / "given_up",
            settings=(self.mesh, *self.settings, "time.retries=0", "newton.max_iterations=1"),
        )
        self.assertEqual(process.returncode, 2, process.stderr)


class Ringing(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_mesh(cls.base / "section.msh", "--axisymmetric", "--for", "p2p1", "--error", "5%")
        cls.settings = (f"mesh.file={mesh}", "time.end=3", "output.every=0")

    def test_is_named(self):
        folder = run(
            MONOLITHIC,
            AXISYMMETRIC,
            self.base / "rings",
            *self.settings,
            "time.scheme=generalised-alpha",
            "time.spectral_radius=1",
        )
        ringing = summary(folder)["ringing"]
        print(ringing["said"])
        self.assertIn("a smaller time.spectral_radius", ringing["said"])
        self.assertGreater(ringing["amplitude_Pa"], 1)
        self.assertIn("the pressure alternates from step to step", (folder / "run.log").read_text())

    def test_of_a_loose_solver_is_ended_by_the_tolerance_that_is_named(self):
        def ringing(name, tolerance):
            settings = ("time.step=0.03125", "time.end=1", f"newton.tolerance={tolerance}")
            return summary(run(MONOLITHIC, AXISYMMETRIC, self.base / name, *self.settings, *settings)).get("ringing")

        self.assertIn("; give newton.tolerance = 3e-03, and if", ringing("loose", 0.3)["said"])
        self.assertIsNone(ringing("tighter", 3e-3))

    def test_is_not_seen_where_there_is_none(self):
        folder = run(MONOLITHIC, AXISYMMETRIC, self.base / "sound", *self.settings)
        self.assertNotIn("ringing", summary(folder))


if __name__ == "__main__":
    unittest.main()
