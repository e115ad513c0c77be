"""Ctrl-C, a polite kill and a terminal that is closed end a run after the step in progress, with all that a restart needs."""

import shlex
import signal
import subprocess
import time
import unittest

from programs import (
    DRIVERS,
    MONOLITHIC,
    NEO_HOOKEAN,
    FolderTest,
    arrays,
    driver_command,
    execute,
    make_small_mesh,
    run,
    summary,
    table,
)

STEPS = 400  # more than any machine makes before a signal comes


class Interruption(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = f"mesh.file={make_small_mesh(cls.base / 'small mesh.msh')}"  # a name to be quoted
        cls.settings = (cls.mesh, "partitioned.tolerance=1e-2", "output.every=0")

    def start(self, program, folder, *options, steps=STEPS):
        command = driver_command(
            program, NEO_HOOKEAN, *options, folder=folder, settings=(*self.settings, f"time.end={0.125 * steps:g}")
        )
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def wait_for_steps(self, process, folder, count):
        deadline = time.monotonic() + 100
        while process.poll() is None and time.monotonic() < deadline:
            if (folder / "iterations.csv").exists() and len(table_rows(folder)) >= count:
                return
            time.sleep(0.001)
        self.fail(f"no {count} steps: {process.communicate()}")

    def test_ends_after_the_step_and_says_how_to_go_on(self):
        for program in DRIVERS:
            for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)):
                folder = self.base / f"run {code} {program[-8:]}"
                with self.subTest(program=program, signal=number), self.start(program, folder, "-q") as process:
                    self.wait_for_steps(process, folder, 2)
                    process.send_signal(number)
                    output, errors = process.communicate(timeout=100)
                    self.assertEqual((process.returncode, output), (code, ""))
                    self.assertEqual(errors.count("\n"), 1, errors)
                    self.assertIn(": interrupted after step ", errors)
                    self.assertEqual(summary(folder)["status"], "interrupted")
                    done = summary(folder)["totals"]["steps"]
                    self.assertLess(done, STEPS)
                    self.assertEqual(table(folder, "iterations.csv")[:, 0].tolist(), list(range(1, done + 1)))
                    self.assertEqual(arrays(folder / "checkpoint.h5")["step"][0], done)
                    self.assertIn(errors.split("continue by: ")[1].strip(), (folder / "run.log").read_text())

                    # The command is ready to be pasted; a later --set overrules an earlier one.
                    command = errors.split("continue by: ")[1].strip()
                    self.assertIn(shlex.quote(str(folder)), command)
                    whole = execute("sh", "-c", f"{command} --set time.end={0.125 * (done + 1):g}")
                    self.assertEqual((whole.returncode, whole.stderr), (0, ""))
                    self.assertEqual(summary(folder)["status"], "done")
                    self.assertEqual(summary(folder)["restarted_from_step"], done)
                    self.assertEqual(len(table_rows(folder)), done + 1)

    def test_goes_on_bit_for_bit(self):
        folder = self.base / "bits"
        with self.start(MONOLITHIC, folder) as process:
            self.wait_for_steps(process, folder, 3)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=100)
        steps = summary(folder)["totals"]["steps"] + 3
        settings = (*self.settings, f"time.end={0.125 * steps:g}")
        run(MONOLITHIC, NEO_HOOKEAN, folder, *settings, options=("--restart", folder))
        self.assertSameTables(folder, run(MONOLITHIC, NEO_HOOKEAN, self.base / "bits_whole", *settings))

    def test_checkpoint_is_saved_although_the_case_wants_none(self):
        folder = self.base / "unsaved"
        with self.start(MONOLITHIC, folder, "--set", "output.checkpoint_every=0") as process:
            self.wait_for_steps(process, folder, 1)
            self.assertFalse((folder / "checkpoint.h5").exists())
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=100)
        self.assertEqual(arrays(folder / "checkpoint.h5")["step"][0], summary(folder)["totals"]["steps"])

    def test_second_signal_ends_at_once(self):
        """Both come while the process is stopped, so that no step can end between them."""
        folder = self.base / "twice"
        with self.start(MONOLITHIC, folder) as process:
            self.wait_for_steps(process, folder, 1)
            process.send_signal(signal.SIGSTOP)
            process.send_signal(signal.SIGTERM)
            process.send_signal(signal.SIGINT)
            process.send_signal(signal.SIGCONT)
            process.communicate(timeout=100)
            self.assertIn(process.returncode, (-signal.SIGINT, -signal.SIGTERM))
        self.assertEqual(summary(folder)["status"], "running")
        self.assertTrue((folder / "run.lock").exists(), "nothing is cleared up")
        command = [*driver_command(MONOLITHIC, NEO_HOOKEAN, folder=folder, settings=self.settings)]
        refused = execute(*command)
        self.assertEqual((refused.returncode, refused.stdout), (1, ""))
        self.assertIn('unfinished run of fsi-monolithic (status "running", ', refused.stderr)


def table_rows(folder):
    """Finished steps, while the file is being written."""
    return (folder / "iterations.csv").read_text().splitlines()[1:]


if __name__ == "__main__":
    unittest.main()
