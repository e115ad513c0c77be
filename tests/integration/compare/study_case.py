"""A test case with fake drivers, a case file and a study of two runs."""

import json

from fake_drivers import install
from folder_case import FolderCase

from fsi_compare.study.runner import RECORD

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


class StudyCase(FolderCase):
    def setUp(self):
        super().setUp()
        self.programs = install(self.base / "bin")
        self.study = self.base / "study.toml"
        self.study.write_text(STUDY)
        self.case_file = self.base / "tube.toml"
        self.case_file.write_text('title = "A tube"\n')

    def words(self, *arguments):
        words = (
            "study",
            self.study,
            "-o",
            self.out,
            "--monolithic",
            self.programs / "fsi-monolithic",
            "--partitioned",
            self.programs / "fsi-partitioned",
            *arguments,
        )
        return [str(word) for word in words]

    def call(self, *arguments):
        return super().call(*self.words(*arguments))

    @staticmethod
    def record(place):
        return json.loads((place / RECORD).read_text())

    def outcomes(self):
        return {row["method"]: (row["status"], row["message"]) for row in self.csv("runs.csv")}
