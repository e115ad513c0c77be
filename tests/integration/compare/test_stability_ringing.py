"""Runs that name a pressure alternating from step to step, in the report of a stability study."""

import unittest

import numpy as np
from folder_case import FolderCase
from synthetic import parabola, write_run

from fsi_compare.reporting.report import Report
from fsi_research.evidence.cross_check import AGREES, Cell
from fsi_compare.study.study_file import Method, Request
from fsi_compare.study.study_run import DONE, StudyRun
from fsi_research.stability.ringing import ringing, ringing_table
from fsi_research.stability.settings import Settings

SETTINGS = Settings("", 1e-3, [], [], {"time.step": {"label": "Step in ms"}}, None, "", "")


class Ringing(FolderCase):
    def cell(self, method, step, amplitude=None, quantity="time.step"):
        folder = self.base / f"{method} {step}"
        said = {} if amplitude is None else {"ringing": {"amplitude_Pa": amplitude, "time_ms": 1.0, "said": "..."}}
        write_run(folder, parabola(0.66), 0.125 * np.arange(1, 5), **said)
        request = Request(
            "steps", "tube", Method(method, method, "fsi-monolithic", {}), {quantity: step}, None, None, {}, 1
        )
        return Cell(StudyRun(request, folder, DONE, "", 1.0, ""), AGREES, 4, None, None)

    def page(self, cells):
        self.out.mkdir(exist_ok=True)
        report = Report(self.out, "A map")
        ringing(report, cells, SETTINGS)
        return report.write().read_text()

    def test_one_row_for_methods_that_name_the_same(self):
        cells = [self.cell("fast", 0.25, 6.0), self.cell("direct", 0.25, 6.04), self.cell("fast", 0.5, 12.0)]
        table = ringing_table(cells, SETTINGS)
        self.assertEqual(
            [row[:4] for row in table.rows],
            [["Step in ms", "0.25", "fast, direct", "6"], ["Step in ms", "0.5", "fast", "12"]],
        )
        self.assertEqual([row[2:4] for row in table.csv_rows], [["fast", 6.0], ["direct", 6.04], ["fast", 12.0]])
        self.assertGreater(table.csv_rows[0][4], 0)

    def test_counts_those_that_ring(self):
        self.assertIn("1 of 2 runs named it", self.page([self.cell("fast", 0.25, 6.0), self.cell("fast", 0.5)]))

    def test_no_section_where_nothing_rings(self):
        self.assertNotIn("alternate", self.page([self.cell("fast", 0.25)]))
        self.assertIn("0 of 1 runs named it", self.page([self.cell("fast", "euler", quantity="scheme")]))

    def test_a_summary_of_another_form_names_nothing(self):
        cell = self.cell("fast", 0.25)
        (cell.run.folder / "summary.json").write_text('{"status": "done", "ringing": [1]}')
        self.assertIn("0 of 2", self.page([cell, self.cell("fast", "euler", quantity="scheme")]))


if __name__ == "__main__":
    unittest.main()
