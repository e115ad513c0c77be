"""One study, one folder."""

import contextlib
import io
import os
import subprocess
import time
import unittest
from pathlib import Path

from folder_case import FolderCase
from synthetic import parabola, write_run

from fsi_compare.base.errors import InputError
from fsi_compare.base.folder_lock import NAME, locked

HOST = os.uname().nodename
DRIVER = Path(os.environ.get("FSI_COMPARE", "")).parent / "fsi-monolithic"
CASE = Path(__file__).resolve().parents[3] / "meshes" / "artery" / "neo-hookean.toml"


class Lock(FolderCase):
    def setUp(self):
        super().setUp()
        self.file = self.base / NAME

    def text(self, host=HOST, process=2**22 + 1):
        return f"x, process {process} on host {host}\n"

    def said(self):
        err = io.StringIO()
        with contextlib.redirect_stderr(err), locked(self.base):
            self.assertTrue(self.file.exists())
        self.assertFalse(self.file.exists())
        return err.getvalue()

    def test_it_names_the_process(self):
        with locked(self.base):
            self.assertEqual(self.file.read_text(), f"fsi-compare, process {os.getpid()} on host {HOST}\n")
        self.assertEqual(self.said(), "")

    def test_a_folder_that_another_works_in_is_refused(self):
        with locked(self.base):
            with self.assertRaises(InputError) as caught, locked(self.base):
                pass
        self.assertIn(f"a run works in it (fsi-compare, process {os.getpid()} on host {HOST})", str(caught.exception))
        self.assertEqual(self.said(), "")

    def test_a_lock_that_was_left_is_taken_over_with_a_word(self):
        for text in (self.text(), self.text(process=os.getppid())):  # a number that is another's by then
            self.file.write_text(text)
            said = self.said()
            self.assertEqual(said.count("\n"), 1)
            self.assertIn("fsi-compare: note: ", said)
            self.assertIn("which has ended", said)

    @unittest.skipUnless(DRIVER.exists(), "beside no driver")
    def test_a_driver_and_a_study_keep_each_other_out(self):
        command = [DRIVER, CASE, "-q", "-o", self.base, "--threads", "1", "--set", "time.end=1000"]
        with locked(self.base):
            refused = subprocess.run(command, stderr=subprocess.PIPE, text=True)
        self.assertEqual((refused.returncode, refused.stderr.count("\n")), (1, 1))
        self.assertIn(f"a run works in it (fsi-compare, process {os.getpid()} on host {HOST})", refused.stderr)
        with subprocess.Popen(command, stderr=subprocess.DEVNULL) as driver:
            while not (self.file.exists() and self.file.read_text()):
                self.assertIsNone(driver.poll())
                time.sleep(0.01)
            with self.assertRaises(InputError) as caught, locked(self.base):
                pass
            driver.kill()
        holder = f"fsi-monolithic, process {driver.pid} on host {HOST}"
        self.assertIn(f"a run works in it ({holder})", str(caught.exception))
        self.assertIn(f"took over the lock of {holder}, which has ended", self.said())

    def test_a_lock_of_another_host_is_not_touched(self):
        self.file.write_text(self.text(host="elsewhere"))
        with self.assertRaises(InputError) as caught, locked(self.base):
            pass
        self.assertIn("if it does not, remove", str(caught.exception))
        self.assertTrue(self.file.exists())

    def test_a_lock_that_does_not_say_whose_it_is(self):
        self.file.write_text("nonsense\n")
        with self.assertRaises(InputError) as caught, locked(self.base):
            pass
        self.assertIn("does not say by whom; if no run works in the folder, remove that file", str(caught.exception))
        self.file.write_text("")  # its owner was killed before it could write its name
        self.assertEqual(self.said(), "")

    def test_results_are_read_beside_a_lock(self):
        run = write_run(self.base / "run", parabola(0.6))
        (run / NAME).write_text(self.text(host="elsewhere"))
        code, _, err = self.call("pressure", run, "-q", "-o", self.out)
        self.assertEqual((code, err), (0, ""))


if __name__ == "__main__":
    unittest.main()
