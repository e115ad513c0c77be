"""How many threads a run takes, and what that costs beside other jobs."""

import os
import re
import resource
import subprocess
import unittest
from pathlib import Path

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

    def sleeps(self, name, threads, **environment):
        """How often threads of a run of 12 coarse steps gave their core away of their own will."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        process = execute(*self.command(self.base / name, threads, "time.end=1.5"), env={**os.environ, **environment})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        return after.ru_nvcsw - before.ru_nvcsw

    def test_log_tells_how_many_and_why(self):
        for threads, count, why in ((0, 1, "the mesh is too small for more"), (2, 2, "as asked")):
            folder = self.base / f"why{threads}"
            self.assertEqual(execute(*self.command(folder, threads, "time.end=0.125")).returncode, 0)
            self.assertIn(f"threads: {count}, {why}", (folder / "run.log").read_text())
            self.assertEqual(summary(folder)["threads"], count)

    def test_waiting_threads_leave_the_cores_to_others(self):
        """Threads that spin at the end of each loop, while a job on their core keeps the other one from it, burned ten
        times the seconds that the work takes. Those that wait by sleeping do so at many of the loops' ends; those that
        spin, as asked, sleep no more than a single thread, which waits for files alone."""
        loops = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(len(os.sched_getaffinity(0)))]
        try:
            asleep, spinning = self.sleeps("asleep", 2), self.sleeps("spinning", 2, OMP_WAIT_POLICY="active")
        finally:
            for loop in loops:
                loop.kill()
                loop.wait()
        print(f"two threads slept {asleep} times, and {spinning} times where they were to spin")
        self.assertGreater(asleep, 3 * spinning)

    def test_dense_kernels_are_for_the_vectors_of_the_processor(self):
        """OpenBLAS takes kernels of 128 bits on processors that are newer than itself."""
        flags = Path("/proc/cpuinfo").read_text()
        if not re.search(r"^flags.*\bavx2\b.*\bfma\b|^flags.*\bfma\b.*\bavx2\b", flags, re.MULTILINE):
            self.skipTest("this processor has no vectors of 256 bits")
        environment = {key: value for key, value in os.environ.items() if key != "OPENBLAS_CORETYPE"}

        def kernels(**more):
            return execute(MONOLITHIC, "--version", env={**environment, "OPENBLAS_VERBOSE": "2", **more}).stderr

        wide = "SkylakeX" if re.search(r"^flags.*\bavx512vl\b", flags, re.MULTILINE) else "Haswell"
        self.assertIn(f"Core: {wide}", kernels())
        self.assertIn("Core: Nehalem", kernels(OPENBLAS_CORETYPE="Nehalem"))  # of the user

    def test_memory_is_asked_for_in_large_pages(self):
        """What the C library of a running program was told. What the kernel makes of it differs from machine to machine."""
        environment = {key: value for key, value in os.environ.items() if key != "GLIBC_TUNABLES"}

        def told(folder, **more):
            command = self.command(self.base / folder, 1, "time.end=100")
            with subprocess.Popen(list(map(str, command)), env={**environment, **more}) as process:
                try:
                    entries = []
                    while not any(entry.startswith(b"GOMP_SPINCOUNT=") for entry in entries):
                        self.assertIsNone(process.poll())
                        entries = Path(f"/proc/{process.pid}/environ").read_bytes().split(b"\0")
                finally:
                    process.kill()
            return [entry for entry in entries if entry.startswith(b"GLIBC_TUNABLES=")]

        self.assertTrue(told("large")[0].startswith(b"GLIBC_TUNABLES=glibc.malloc.hugetlb=1"))
        small = "glibc.malloc.hugetlb=0"  # of the user
        self.assertEqual(told("small", GLIBC_TUNABLES=small), [f"GLIBC_TUNABLES={small}".encode()])

    def test_environment_of_the_user_holds(self):
        """Who names the waiting himself is obeyed: the program does not start itself again."""
        for name, value in (("OMP_WAIT_POLICY", "active"), ("GOMP_SPINCOUNT", "100")):
            process = execute(MONOLITHIC, "--version", env={**os.environ, name: value})
            self.assertEqual(process.returncode, 0)
            self.assertTrue(process.stdout.startswith("fsi-monolithic "))


if __name__ == "__main__":
    unittest.main()
