"""One study, one folder."""

import contextlib
import io
import os
import subprocess
import unittest

from folder_case import FolderCase
from synthetic import parabola, write_run

from fsi_compare.base.errors import InputError
from fsi_compare.starting.folder_lock import NAME, locked, start_of

HOST = os.uname().nodename


class Lock(FolderCase):
    def setUp(self):
        super().setUp()
        self.file = self.base / NAME

    def text(self, host=HOST, process=2**22 + 1, start=1):
        with open("/proc/sys/kernel/random/boot_id") as boot:
            return f"program x\nhost {host}\nprocess {process}\nstart {start}\nboot {boot.read()}"

    def said(self):
        err = io.StringIO()
        with contextlib.redirect_stderr(err), locked(self.base):
            self.assertTrue(self.file.exists())
        self.assertFalse(self.file.exists())
        return err.getvalue()

    def test_it_names_the_process(self):
        with locked(self.base):
            lines = dict(line.split(" ", 1) for line in self.file.read_text().splitlines())
            self.assertEqual(lines["program"], "fsi-compare")
            self.assertEqual((lines["host"], lines["process"]), (HOST, str(os.getpid())))
            self.assertEqual(int(lines["start"]), start_of(os.getpid()))
        self.assertEqual(self.said(), "")

    def test_a_folder_that_another_works_in_is_refused(self):
        with locked(self.base):
            with self.assertRaises(InputError) as caught, locked(self.base):
                pass
        self.assertIn(f"a run works in it (fsi-compare, process {os.getpid()} on host {HOST})", str(caught.exception))
        self.assertEqual(self.said(), "")

    def test_a_lock_that_was_left_is_taken_over_with_a_word(self):
        ended = subprocess.Popen(["true"])
        ended.wait()
        for text in (self.text(), self.text(process=ended.pid), self.text(process=os.getpid())):
            self.file.write_text(text)
            said = self.said()
            self.assertEqual(said.count("\n"), 1)
            self.assertIn("fsi-compare: note: ", said)
            self.assertIn("which has ended", said)

    def test_a_lock_of_a_process_that_runs_holds_without_the_kernel(self):
        self.file.write_text(self.text(process=os.getppid(), start=start_of(os.getppid())))
        with self.assertRaises(InputError), locked(self.base):
            pass
        self.assertTrue(self.file.exists())

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
