"""Files that are read whole or refused, and output that is complete or absent."""

import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from folder_case import FolderCase
from synthetic import parabola, write_run

from fsi_compare.base.errors import InputError
from fsi_compare.base.files import output_folder, read_bytes, read_json, read_toml, replacing, sweep, together

GONE = 2**22 + 1  # no process has this number


class Reading(FolderCase):
    def assert_refused(self, read, expected):
        with self.assertRaises(InputError) as caught:
            read(self.base / "file", "there should be one", "mend it")
        self.assertIn(expected, str(caught.exception))

    def test_what_is_no_regular_file(self):
        file = self.base / "file"
        self.assert_refused(read_bytes, "is missing; there should be one")
        for make, expected in (
            (file.mkdir, "cannot be read: Is a directory; mend it"),
            (lambda: os.mkfifo(file), "is not a regular file"),
            (lambda: file.symlink_to("/dev/zero"), "is not a regular file"),
            (lambda: file.symlink_to("file"), "cannot be read: Too many levels of symbolic links"),
        ):
            make()
            self.assert_refused(read_bytes, expected)
            file.rmdir() if file.is_dir() else file.unlink()

    def test_names_that_no_file_can_have(self):
        for name in ("a" * 5000, "a\0b"):
            with self.assertRaises(InputError):
                read_bytes(self.base / name, "", "")

    def test_json_that_cannot_be_worked_with(self):
        for text, expected in (
            ("[" * 100_000, "levels"),
            ("[" * 60 + "]" * 60, "levels"),
            ("9" * 5000, "is not JSON"),
            ('{"a"', "line 1: is not JSON"),
            ('["\\ud800"]', "half a character"),
        ):
            (self.base / "file").write_text(text)
            self.assert_refused(read_json, expected)

    def test_toml_that_cannot_be_worked_with(self):
        for text in ("a = " + "[" * 100_000, "a" + ".a" * 60 + " = 1", "a = " + "9" * 5000, "a = 1\na = 2"):
            (self.base / "file").write_text(text)
            self.assert_refused(read_toml, "levels" if "[" in text or ".a" in text else "is not TOML")


class Writing(FolderCase):
    def test_all_files_of_a_call_or_none(self):
        with together(self.out) as place:
            (place / "one").write_text("1")
        with self.assertRaises(InputError):
            with together(self.out) as place:
                (place / "one").write_text("2")
                raise InputError("", "", "stop")
        self.assertEqual([(path.name, path.read_text()) for path in self.out.iterdir()], [("one", "1")])

    def test_a_folder_made_for_nothing_is_removed(self):
        with self.assertRaises(InputError):
            with output_folder(self.out / "a" / "b"):
                raise InputError("", "", "stop")
        self.assertFalse(self.out.exists())
        with output_folder(self.out / "a" / "b") as place:
            (place / "file").write_text("")
        self.assertTrue((self.out / "a" / "b" / "file").exists())

    def test_what_a_killed_call_left_is_swept_away(self):
        self.out.mkdir()
        host = os.uname().nodename
        (self.out / f".{host}-{GONE}-x.part").mkdir()
        (self.out / f".{host}-{GONE}-x.part" / "report.md").write_text("")
        kept = [f".{host}-{os.getpid()}-x.part", f".elsewhere-{GONE}-x.part", ".hidden", "a.part"]
        for name in kept:
            (self.out / name).write_text("")
        sweep(self.out)
        self.assertEqual(sorted(os.listdir(self.out)), sorted(kept))

    def test_a_file_that_cannot_be_written_leaves_the_old_one(self):
        path = self.base / "file"
        path.write_text("old")
        with self.assertRaises(InputError) as caught:
            with replacing(path):
                raise OSError(28, "No space left on device")
        self.assertIn("file: cannot be written: No space left on device", str(caught.exception))
        self.assertEqual([(p.name, p.read_text()) for p in self.base.iterdir()], [("file", "old")])

    def test_a_full_disk(self):
        run = write_run(self.base / "run", parabola(0.6))
        script = "import sys; sys.path.insert(0, sys.argv.pop(1)); from fsi_compare.start import program; program()"
        package = Path(__file__).resolve().parents[3] / "compare"
        for size in (0, 5000, 60_000):
            words = ["prlimit", f"--fsize={size}", sys.executable, "-E", "-B", "-c", script, package, "pressure", run]
            done = subprocess.run([*words, "-q", "-o", self.out], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
            self.assertIn("File too large", done.stderr)
            self.assertFalse(self.out.exists())

    @unittest.skipUnless(os.environ.get("FSI_COMPARE"), "FSI_COMPARE names the built program")
    def test_a_full_disk_leaves_no_byte_code(self):
        # Python 3.11 does not notice when its byte code is cut: it would lie beside the sources, and end every later call.
        built = Path(os.environ["FSI_COMPARE"])
        sources, copied = Path(__file__).resolve().parents[3] / "compare", self.base / "compare"
        shutil.copytree(sources, copied, ignore=shutil.ignore_patterns("__pycache__"))
        for name in ("fsi-compare", "fsi-python"):
            text = (built.parent / name).read_text()
            self.assertIn(str(sources), text)
            (self.base / name).write_text(text.replace(str(sources), str(copied)))
            (self.base / name).chmod(0o755)
        run = write_run(self.base / "run", parabola(0.6))
        call = [self.base / "fsi-compare", "pressure", run, "-q", "-o", self.out]
        options = {"capture_output": True, "text": True, "env": dict(os.environ)}
        options["env"].pop("PYTHONDONTWRITEBYTECODE", None)  # a user's environment has none
        limited = subprocess.run(["prlimit", "--fsize=5000", *call], **options)
        self.assertEqual(limited.returncode, 1, limited.stderr)
        subprocess.run([self.base / "fsi-python", "-c", "import fsi_compare"], check=True, **options)
        free = subprocess.run(call, **options)
        self.assertEqual((free.returncode, free.stderr), (0, ""))
        self.assertEqual(list(copied.rglob("__pycache__")), [])


if __name__ == "__main__":
    unittest.main()
