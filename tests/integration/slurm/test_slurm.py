"""The example for Slurm, with an srun that starts the command once and a driver of three lives: out of time, done, done."""

import os
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(os.environ["FSI_SOURCES"]) / "scripts" / "slurm" / "fsi-duo.sbatch"

SRUN = """\
#!/bin/bash
[ "$1" = --mpi=pmix ] || exit 99
shift
exec "$@"
"""
DRIVER = """\
#!/bin/bash
echo "$OMP_NUM_THREADS $*" >> calls.txt
case " $* " in
  *" --restart "*) echo '{ "status": "done" }' > results/artery/summary.json ;;
  *) mkdir -p results/artery; touch results/artery/checkpoint.h5
     echo '{ "status": "interrupted" }' > results/artery/summary.json; exit 143 ;;
esac
"""


class Slurm(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        for name, text in (("srun", SRUN), ("fsi-monolithic", DRIVER)):
            file = self.folder / name
            file.write_text(text)
            file.chmod(file.stat().st_mode | stat.S_IXUSR)

    def job(self):
        """(exit code, output) of the job, as Slurm starts it."""
        environment = {"PATH": f"{self.folder}:{os.environ['PATH']}", "SLURM_CPUS_PER_TASK": "2", "SLURM_NTASKS": "8"}
        words = ["bash", str(SCRIPT)]
        job = subprocess.run(words, cwd=self.folder, env=environment, capture_output=True, text=True, timeout=60)
        self.assertEqual(job.stderr, "")
        return job.returncode, job.stdout

    def test_goes_on_until_done(self):
        self.assertEqual(self.job(), (143, "results/artery: out of time; hand the job in again to go on\n"))
        self.assertEqual(self.job(), (0, "results/artery: done\n"))
        self.assertEqual(self.job(), (0, "results/artery: done already\n"))
        calls = (self.folder / "calls.txt").read_text().splitlines()
        self.assertEqual(
            calls,
            [
                "2 artery.toml -o results/artery --force -q --threads 2",
                "2 artery.toml --restart results/artery -q --threads 2",
            ],
        )

    def test_every_option_of_sbatch_says_what_it_is_for_or_what_to_change(self):
        options = [line for line in SCRIPT.read_text().splitlines() if line.startswith("#SBATCH")]
        self.assertGreaterEqual(len(options), 8)
        for name in ("--nodes", "--ntasks-per-node", "--cpus-per-task", "--mem-per-cpu", "--time", "--signal=TERM@180"):
            self.assertTrue(any(name in option for option in options), name)


if __name__ == "__main__":
    unittest.main()
