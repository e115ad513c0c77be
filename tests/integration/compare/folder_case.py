"""A test case with a folder of its own."""

import contextlib
import csv
import io
import tempfile
import unittest
from pathlib import Path

import synthetic  # noqa: F401: the package's folder onto the path

from fsi_research.start import main


class FolderCase(unittest.TestCase):
    """`base`: the folder; `out`: within it, where fsi-compare is told to write. `main`: of fsi-compare in the source tree."""

    main = staticmethod(main)

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.base = Path(temporary.name)
        self.out = self.base / "out"

    def call(self, *arguments):
        """(exit code, output, error output) of fsi-compare."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = self.main([str(word) for word in arguments], version="1.2.3")
            except SystemExit as end:
                code = end.code
        return code, out.getvalue(), err.getvalue()

    def csv(self, name):
        with open(self.out / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
