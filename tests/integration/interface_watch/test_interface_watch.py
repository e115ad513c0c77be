"""What a run leaves between fluid and wall, by both drivers: a good run, one stopped early, schemes, restart, processes."""

import unittest

import numpy as np
from programs import DRIVERS, MONOLITHIC, PARTITIONED, FolderTest, attempt, restart, run, summary
from scenes import KINDS, WALL, scene

CASE = f"""[mesh]
file = "tube.msh"
[fluid]
density = 1.0
viscosity = 3e-3
{WALL}
[inlet]
pressure = [[0, 0], [0.5, 1.0]]
[time]
step = 0.125
end = 1.5
[newton]
tolerance = 1e-11
[partitioned]
tolerance = 1e-10
[output]
every = 0
"""
SCHEMES = ("euler", "bdf2", "midpoint", "generalised-alpha", "tr-bdf2")


class WatchTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.case = self.base / "case.toml"
        self.case.write_text(CASE)

    def left(self, folder):
        """Gap over displacement, lasting imbalance over traction."""
        found = summary(folder)["interface"]
        self.assertGreater(found["largest_displacement_mm"], 1e-4)
        self.assertGreater(found["largest_traction_kPa"], 1e-2)
        gap = max(found["largest_slip_mm"], found["largest_separation_mm"])
        return (
            gap / found["largest_displacement_mm"],
            found["lasting_unbalanced_traction_kPa"] / found["largest_traction_kPa"],
        )


class Watch(WatchTest):
    def test_a_good_run_leaves_next_to_nothing(self):
        for kind in KINDS:
            settings = (*scene(self.base, *kind), "time.end=0.5")
            for program in DRIVERS:
                with self.subTest(kind=kind, program=program):
                    gap, imbalance = self.left(run(program, self.case, self.base / "good", *settings))
                    self.assertLess(gap, 1e-8)
                    self.assertLess(imbalance, 1e-7)

    def test_every_scheme(self):
        settings = scene(self.base, "p1", "axisymmetric")
        for scheme in SCHEMES:
            with self.subTest(scheme=scheme):
                folder = run(MONOLITHIC, self.case, self.base / "scheme", *settings, f"time.scheme={scheme}")
                gap, imbalance = self.left(folder)
                self.assertLess(gap, 1e-8)
                self.assertLess(imbalance, 1e-7)
                self.assertEqual(summary(folder)["interface"]["weighed_steps"], 2)  # of 12 steps

    def test_a_run_stopped_early_is_seen_and_said(self):
        """Aitken's relaxation to 0.3: each step passes its test."""
        settings = (*scene(self.base, "p1", "axisymmetric"), "partitioned.scheme=aitken", "partitioned.tolerance=0.3")
        process = attempt(PARTITIONED, self.case, folder=self.base / "early", settings=settings)
        self.assertEqual(process.returncode, 0, process.stderr)
        gap, imbalance = self.left(self.base / "early")
        self.assertGreater(max(gap, imbalance), 0.01)
        said = [line for line in process.stdout.splitlines() if "where they meet" in line]
        self.assertTrue(said, process.stdout)
        self.assertIn("partitioned.tolerance", said[0])

    def test_a_restart_goes_on_with_the_same_numbers(self):
        settings = (*scene(self.base, "p1", "axisymmetric"), "partitioned.tolerance=1e-3")
        for program in DRIVERS:
            whole = run(program, self.case, self.base / "whole", *settings)
            begun = run(program, self.case, self.base / "begun", *settings, "time.end=0.75")
            restart(program, self.case, begun, *settings)
            self.assertEqual(summary(whole)["interface"], summary(begun)["interface"])


class Shared(WatchTest):
    def test_processes_see_the_same(self):
        settings = (*scene(self.base, "p2p1", "3d"), "partitioned.tolerance=1e-3", "time.end=0.5")
        alone, two = (
            summary(
                run(PARTITIONED, self.case, self.base / f"of{count}", *settings, processes=count if count > 1 else None)
            )["interface"]
            for count in (1, 2)
        )
        for name in ("largest_displacement_mm", "largest_traction_kPa"):
            np.testing.assert_allclose(two[name], alone[name], rtol=1e-5)
        for name in ("largest_separation_mm", "largest_unbalanced_traction_kPa"):  # what a tolerance of 1e-3 leaves
            self.assertLess(two[name], 100 * alone[name] + 1e-12)


if __name__ == "__main__":
    unittest.main()
