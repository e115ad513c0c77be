"""Signals, streams and the environment, as a user meets them."""

import os
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from fake_drivers import behave, calls
from study_case import StudyCase
from synthetic import parabola, write_run

PACKAGE = Path(__file__).resolve().parents[3] / "compare"
SCRIPT = "import sys; sys.path.insert(0, sys.argv.pop(1)); from fsi_compare.start import program; program()"
PATIENCE = 120  # s, after which a test that hangs fails
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class Program(StudyCase):
    def start(self, *words, **options):
        command = [sys.executable, "-E", "-B", "-c", SCRIPT, str(PACKAGE), *map(str, words)]
        return subprocess.Popen(command, stderr=subprocess.PIPE, text=True, **options)

    def wait_for(self, happens):
        latest = time.monotonic() + PATIENCE
        while not happens():
            self.assertLess(time.monotonic(), latest, "it does not begin")
            time.sleep(0.02)

    def assert_gone(self, pid):
        latest = time.monotonic() + PATIENCE
        while os.path.exists(f"/proc/{pid}"):
            self.assertLess(time.monotonic(), latest, "a driver outlives the study")
            time.sleep(0.02)

    def begin(self, *words, deaf=False, **options):
        """A study whose second run lasts; (process, process number of the driver)."""
        self.call("--quick", "-q")
        behave(self.programs, sleep=600, deaf=deaf)
        (self.programs / "pid").unlink(missing_ok=True)
        process = self.start(*self.words("-q", *words), **options)
        pid = self.programs / "pid"
        self.wait_for(lambda: pid.exists() and pid.read_text().endswith("\n"))
        return process, int(pid.read_text().split()[-1])


class Signals(Program):
    def test_a_study_ends_with_one_message_and_goes_on_when_called_again(self):
        for number in SIGNALS:
            process, driver = self.begin()
            process.send_signal(number)
            _, err = process.communicate(timeout=PATIENCE)
            self.assertEqual(process.returncode, 128 + number)
            said = f"fsi-compare: interrupted by {number.name}; finished runs are kept, the same command goes on\n"
            self.assertEqual(err, said)
            self.assert_gone(driver)
            self.assertEqual(len(list(self.out.glob("runs/*/study_run.json"))), 1)
            self.assertFalse((self.out / "run.lock").exists())
        behave(self.programs)
        before = len(calls(self.programs))
        self.assertEqual(super().call("-q")[0], 0)
        self.assertEqual(len(calls(self.programs)) - before, 1)

    def test_a_second_signal_ends_it_at_once(self):
        process, driver = self.begin(deaf=True)
        process.send_signal(signal.SIGTERM)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 130)
        self.assert_gone(driver)

    def test_a_killed_study_takes_its_runs_with_it(self):
        process, driver = self.begin()
        process.kill()
        process.communicate(timeout=PATIENCE)
        self.assert_gone(driver)

    def test_a_signal_that_was_ignored_stays_ignored(self):
        ignore = lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)  # noqa: E731
        process, driver = self.begin(preexec_fn=ignore)
        process.send_signal(signal.SIGHUP)
        time.sleep(0.5)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 143)

    def test_a_signal_at_the_start(self):
        block = lambda: signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)  # noqa: E731: as the launcher does
        for number in SIGNALS:
            process = self.start("cost", "nothing", preexec_fn=block)
            process.send_signal(number)
            _, err = process.communicate(timeout=PATIENCE)
            self.assertEqual((process.returncode, err), (128 + number, f"fsi-compare: interrupted by {number.name}\n"))


class Surroundings(Program):
    def test_streams(self):
        run = write_run(self.base / "run", parabola(0.6))
        words = ["cost", run, "-o", self.out]
        (run / "iterations.csv").write_text("outer_iterations,newton_iterations,linear_iterations,wall_s\n1,3,9,0.5\n")
        for redirection, code, said in (
            (">&-", 0, ""),
            ("<&- >&-", 0, ""),
            ("| true", 0, ""),
            (">/dev/full", 1, "fsi-compare: error: standard output: cannot be written: No space left on device"),
        ):
            script = f'set -o pipefail; "$@" {redirection}'
            command = ["bash", "-c", script, "bash", sys.executable, "-E", "-B", "-c", SCRIPT, PACKAGE, *words]
            done = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertEqual(done.stderr.partition(";")[0].strip(), said)
            self.assertTrue((self.out / "cost.csv").read_text().startswith("run,"))

    def test_settings_of_the_pictures_library(self):
        run = write_run(self.base / "run", parabola(0.6))
        file = self.base / "matplotlibrc"
        file.write_text("backend: [\n")
        for change in ({"MPLBACKEND": "nonsense"}, {"MPLCONFIGDIR": str(file)}, {"MATPLOTLIBRC": str(file)}):
            process = self.start("pressure", run, "-q", "-o", self.out, cwd=self.base, env={**os.environ, **change})
            _, err = process.communicate(timeout=PATIENCE)
            self.assertEqual((process.returncode, err), (0, ""))


if __name__ == "__main__":
    unittest.main()
