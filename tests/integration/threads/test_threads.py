"""How many threads a run takes, and what that costs beside other jobs."""

import os
import resource
import subprocess
import unittest

from programs import MONOLITHIC, NEO_HOOKEAN, FolderTest, driver_command, execute, make_mesh, summary


class Threads(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = f"mesh.file={make_mesh(cls.base / 'coarse.msh', '--level', 'coarse')}"

    def command(self, folder, threads, *settings):
        return driver_command(
            MONOLITHIC,
            NEO_HOOKEAN,
            "-q",
            folder=folder,
            threads=threads,
            settings=(self.mesh, "output.every=0", *settings),
        )

    def seconds_on_cores(self, name, threads):
        """CPU seconds of 12 coarse steps."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        process = execute(*self.command(self.base / name, threads, "time.end=1.5"))
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        return after.ru_utime - before.ru_utime

    def test_log_tells_how_many_and_why(self):
        for threads, count, why in ((0, 1, "the mesh is too small for more"), (2, 2, "as asked")):
            folder = self.base / f"why{threads}"
            self.assertEqual(execute(*self.command(folder, threads, "time.end=0.125")).returncode, 0)
            self.assertIn(f"threads: {count}, {why}", (folder / "run.log").read_text())
            self.assertEqual(summary(folder)["threads"], count)

    def test_waiting_threads_leave_the_cores_to_others(self):
        """Threads that spin at the end of each loop, while a job on their core keeps the other one from it, burned ten
        times the seconds that the work takes."""
        one = self.seconds_on_cores("one", 1)
        loops = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(len(os.sched_getaffinity(0)))]
        try:
            two = self.seconds_on_cores("two", 2)
        finally:
            for loop in loops:
                loop.kill()
                loop.wait()
        print(f"CPU seconds: one thread {one:.2f}, two beside busy cores {two:.2f}")
        self.assertLess(two, 2.5 * one)

    def test_environment_of_the_user_holds(self):
        """Who names the waiting himself is obeyed: the program does not start itself again."""
        for name, value in (("OMP_WAIT_POLICY", "active"), ("GOMP_SPINCOUNT", "100")):
            process = execute(MONOLITHIC, "--version", env={**os.environ, name: value})
            self.assertEqual(process.returncode, 0)
            self.assertTrue(process.stdout.startswith("fsi-monolithic "))


if __name__ == "__main__":
    unittest.main()
