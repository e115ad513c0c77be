"""A test case of a kind of study that runs families about scenes, with programs whose errors are known."""

import unittest.mock

from fake_family import install
from folder_case import FolderCase


class FamilyStudyCase(FolderCase):
    def setUp(self):
        super().setUp()
        self.programs = install(self.base / "bin")
        self.study = self.base / "study.toml"
        self.patch("fsi_compare.reporting.report.Report.figure", unittest.mock.Mock())

    def patch(self, target, new):
        patch = unittest.mock.patch(target, new)
        patch.start()
        self.addCleanup(patch.stop)

    def call_study(self, text):
        self.study.write_text(text)
        programs = [f"--{n}={self.programs / ('fsi-' + n)}" for n in ("monolithic", "partitioned")]
        return self.call("study", self.study, "-o", self.out, *programs)

    def assert_named(self, text, *mistakes):
        """Each (old, new, said): the study with `new` for `old` is refused with words that hold `said`."""
        for old, new, said in mistakes:
            code, _, err = self.call_study(text.replace(old, new))
            self.assertEqual(code, 1)
            self.assertIn(said, err)
