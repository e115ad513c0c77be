"""Ctrl-C, a polite kill and a terminal that is closed end a run soon, in the middle of a step too, with all that a restart
needs."""

import shlex
import signal
import subprocess
import time
import unittest

from programs import (
    DRIVERS,
    MONOLITHIC,
    NEO_HOOKEAN,
    PARTITIONED,
    FolderTest,
    arrays,
    driver_command,
    execute,
    make_small_mesh,
    run,
    summary,
    table,
)

# A step that takes as good as for ever: passes that hardly change anything.
ENDLESS = ("partitioned.scheme=constant", "partitioned.relaxation=1e-9", "partitioned.max_iterations=1000000")
SIGNALS = ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129))
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
            for number, code in SIGNALS:
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
        """Also where the step that was given up followed one without a checkpoint."""
        for program in DRIVERS:
            for every in (1, 0):
                with self.subTest(program=program, checkpoint_every=every):
                    folder = self.base / f"bits {program[-8:]} {every}"
                    checkpoints = f"output.checkpoint_every={every}"
                    with self.start(program, folder, "--set", checkpoints) as process:
                        self.wait_for_steps(process, folder, 3)
                        process.send_signal(signal.SIGINT)
                        process.communicate(timeout=100)
                    steps = summary(folder)["totals"]["steps"] + 3
                    settings = (*self.settings, f"time.end={0.125 * steps:g}")
                    run(program, NEO_HOOKEAN, folder, *settings, options=("--restart", folder))
                    whole = run(program, NEO_HOOKEAN, f"{folder}-whole", *settings)
                    self.assertSameTables(folder, whole)

    def wait_for_log(self, process, folder, words):
        deadline = time.monotonic() + 100
        while process.poll() is None and time.monotonic() < deadline:
            if (folder / "run.log").exists() and words in (folder / "run.log").read_text():
                return
            time.sleep(0.01)
        self.fail(f"no {words}: {process.communicate()}")

    def test_a_step_without_end_is_given_up(self):
        """The step before it stays, and the run that goes on with other settings has the bits of one that nobody
        disturbed."""
        settings = (*self.settings, "time.end=0.75")
        whole = run(PARTITIONED, NEO_HOOKEAN, self.base / "whole", *settings)
        for number, code in SIGNALS:
            folder = run(PARTITIONED, NEO_HOOKEAN, self.base / f"endless {code}", *self.settings, "time.end=0.25")
            command = driver_command(
                PARTITIONED, NEO_HOOKEAN, "--restart", folder, folder=folder, settings=(*settings, *ENDLESS)
            )
            with self.subTest(signal=number), subprocess.Popen(
                command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
            ) as process:
                self.wait_for_log(process, folder, "restarted after step 2")
                time.sleep(0.2)  # into the step
                process.send_signal(number)
                _, errors = process.communicate(timeout=100)
                self.assertEqual(process.returncode, code, errors)
                answer, last = errors.splitlines()
                self.assertRegex(
                    answer,
                    r"^fsi-partitioned: ends (within about \d.*|after the solve in progress), giving up the step in progress; "
                    "once more ends now$",
                )
                self.assertIn(": interrupted after step 2 of 6", last)
                self.assertEqual(summary(folder)["status"], "interrupted")
                self.assertEqual(arrays(folder / "checkpoint.h5")["step"][0], 2)
                run(PARTITIONED, NEO_HOOKEAN, folder, *settings, options=("--restart", folder))
                self.assertSameTables(folder, whole)

    def test_a_first_step_without_end_is_given_up(self):
        folder = self.base / "first"
        settings = tuple(word for setting in ENDLESS for word in ("--set", setting))
        with self.start(PARTITIONED, folder, "-q", *settings) as process:
            self.wait_for_log(process, folder, "partitioned.scheme = constant")
            time.sleep(0.2)
            process.send_signal(signal.SIGTERM)
            _, errors = process.communicate(timeout=100)
            self.assertEqual(process.returncode, 143, errors)
        self.assertIn("interrupted before the end of the first step", errors)
        self.assertEqual(errors.count("\n"), 1, "quiet: only how it ended")
        self.assertEqual(summary(folder)["status"], "interrupted")

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
