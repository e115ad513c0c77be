"""The same input and number of threads give the same bits; another number of threads the same numbers."""

import unittest

from programs import ARTERY, DRIVERS, FolderTest, difference, make_small_mesh, pressure, run, summary, table, wall


class Determinism(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_small_mesh(cls.base / "small.msh")
        # The coupling stops far from convergence: whatever differs would be left in the results.
        settings = (f"mesh.file={mesh}", "time.end=0.5", "partitioned.tolerance=1e-1", "output.every=1")
        cls.runs = {}
        for d, program in enumerate(DRIVERS):
            for threads in (1, 2):
                cls.runs[program, threads] = [
                    run(program, ARTERY, cls.base / f"{d}-{threads}-{k}", *settings, threads=threads) for k in range(2)
                ]

    def test_threads_are_those_asked_for(self):
        for (_, threads), folders in self.runs.items():
            self.assertEqual([summary(folder)["threads"] for folder in folders], [threads, threads])

    def test_two_runs_have_the_same_bits(self):
        for (program, threads), folders in self.runs.items():
            with self.subTest(program=program, threads=threads):
                self.assertSameResults(*folders)

    def test_one_and_two_threads_agree(self):
        """Assembly adds in a fixed order; the dense kernels inside a factorisation need not."""
        for program in DRIVERS:
            one, two = (self.runs[program, threads][0] for threads in (1, 2))
            apart = [
                difference(pressure(two), pressure(one)).max(),
                difference(wall(two)[:, :, 2], wall(one)[:, :, 2]).max(),
                difference(table(two, "flow.csv")[:, 1:2], table(one, "flow.csv")[:, 1:2]).max(),
            ]
            print(f"{program}: 2 against 1 thread, pressure, wall, flow:", apart)
            self.assertLessEqual(max(apart), 1e-10)
            self.assertEqual(table(one, "iterations.csv")[:, :4].tolist(), table(two, "iterations.csv")[:, :4].tolist())


if __name__ == "__main__":
    unittest.main()
