"""A test case with fake drivers, a case file and a study of two runs."""

import contextlib
import csv
import io
import tempfile
import unittest
from pathlib import Path

import synthetic  # noqa: F401: the package's folder onto the path
from fake_drivers import install

from fsi_compare.cli import main

STUDY = """\
title = "Two runs"
kind = "runs"
time_limit = 60
[cases]
tube = "tube.toml"
[methods.mono]
program = "fsi-monolithic"
[methods.part]
program = "fsi-partitioned"
set = { partitioned.scheme = "iqn-ils" }
[runs.all]
quick = { methods = ["mono"] }
"""


class StudyCase(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.base = Path(temporary.name)
        self.programs = install(self.base / "bin")
        self.study = self.base / "study.toml"
        self.study.write_text(STUDY)
        self.case_file = self.base / "tube.toml"
        self.case_file.write_text('title = "A tube"\n')
        self.out = self.base / "out"

    def words(self, *arguments):
        words = ("study", self.study, "-o", self.out, "--monolithic", self.programs / "fsi-monolithic",
                 "--partitioned", self.programs / "fsi-partitioned", *arguments)
        return [str(word) for word in words]

    def call(self, *arguments):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = main(self.words(*arguments), version="1.2.3")
            except SystemExit as end:
                code = end.code
        return code, out.getvalue(), err.getvalue()

    def csv(self, name):
        with open(self.out / name, newline="") as file:
            return list(csv.DictReader(file))

    def outcomes(self):
        return {row["method"]: (row["status"], row["message"]) for row in self.csv("runs.csv")}
