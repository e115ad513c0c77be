"""The coupling of several processes: every scheme gives what it gives on one, and so does every mesh motion."""

import unittest

import numpy as np
from programs import MOONEY_RIVLIN, NEO_HOOKEAN, PARTITIONED, FolderTest, attempt, restart, run, table
from scenes import scene

BOUND = 1e-8  # relative to the largest value


def pressures(folder):
    return table(folder, "centerline_pressure.csv")[:, 2]


class Shared(FolderTest):
    kind = ("p1", "axisymmetric")
    tight = ("partitioned.tolerance=1e-10", "partitioned.max_iterations=1000", "output.every=0")

    def settings(self, *more):
        return (*scene(self.base, *self.kind), *self.tight, "time.end=0.25", *more)

    def march(self, name, processes, *more, case=NEO_HOOKEAN):
        return run(PARTITIONED, case, self.base / f"{name}-{processes}", *self.settings(*more), processes=processes)

    def assert_same(self, folder, alone):
        found, known = pressures(folder), pressures(alone)
        self.assertEqual(found.shape, known.shape)
        apart = np.abs(found - known).max() / np.abs(known).max()
        print(f"{folder.name}: pressure apart by {apart:.1e}", flush=True)
        self.assertLess(apart, BOUND)


class Schemes(Shared):
    def check(self, name, processes, *more):
        more = (f"partitioned.scheme={name}", *more)
        alone, folder = (self.march(name, n, *more) for n in (None, processes))
        self.assert_same(folder, alone)
        return (table(one, "iterations.csv")[:, 2] for one in (folder, alone))

    def test_each_gives_what_one_process_gives(self):
        for k, name in enumerate(("iqn-ils", "iqn-imvj", "robin-neumann", "robin-neumann-imvj", "newton-krylov")):
            with self.subTest(scheme=name):
                self.check(name, 2 + k % 2)

    def test_relaxation(self):
        self.check("aitken", 3, "time.end=0.125")

    def test_one_pass_a_step(self):
        self.check("explicit", 2, "time.scheme=euler", "structure.density=12000", "time.end=0.5")
        self.check("robin-robin", 3, "time.scheme=euler", "time.end=0.5")
        self.check("robin-robin-corrected", 3, "time.scheme=bdf2", "time.end=0.5")
        self.check("robin-robin-parallel", 2, "time.scheme=euler", "time.end=0.5")

    def test_with_factors_not_a_pass_more(self):
        """The interface's algebra alone: the sub-problems' equations are solved to rounding on any number."""
        shared, alone = self.check("iqn-ils", 3, "partitioned.linear_solver=direct")
        np.testing.assert_allclose(shared, alone, atol=1)


class MeshMotions(Shared):
    def test_each_gives_what_one_process_gives(self):
        for processes, method in ((3, "stiffened"), (2, "nonlinear-elastic")):
            with self.subTest(method=method):
                more = ("partitioned.scheme=iqn-ils", f"mesh_motion.method={method}")
                alone, folder = (self.march(method, n, *more, case=MOONEY_RIVLIN) for n in (None, processes))
                self.assert_same(folder, alone)


class Restart(Shared):
    def test_differences_of_passes_go_to_another_number_of_processes(self):
        for name, before, after in (
            ("iqn-ils", 3, 2),
            ("robin-neumann-imvj", 2, None),
            ("robin-robin-corrected", 2, 3),
            ("semi-implicit", 3, 2),
        ):
            with self.subTest(scheme=name):
                more = (f"partitioned.scheme={name}",)
                alone = self.march(f"whole-{name}", None, *more, "time.end=0.375")
                part = self.march(f"part-{name}", before, *more)
                settings = self.settings(*more, "time.end=0.375")
                into = self.base / f"on-{name}"
                folder = restart(PARTITIONED, NEO_HOOKEAN, part, *settings, into=into, processes=after)
                self.assert_same(folder, alone)
                passes = [table(one, "iterations.csv")[-1, 2] for one in (folder, alone)]
                self.assertLess(abs(passes[0] - passes[1]), 4, "begun anew it takes twice as many")


class Failures(Shared):
    def test_all_processes_end_with_one_message(self):
        settings = self.settings("partitioned.scheme=explicit", "time.scheme=euler")
        process = attempt(PARTITIONED, NEO_HOOKEAN, "-q", folder=self.base / "unstable", settings=settings, processes=2)
        self.assertEqual(process.returncode, 2, process.stderr)
        self.assertEqual(process.stderr.count("the explicit coupling is unstable"), 1, process.stderr)


if __name__ == "__main__":
    unittest.main()
