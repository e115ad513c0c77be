"""Tables of samples, and runs of vessels without a centre line."""

import dataclasses
import json
import unittest
from pathlib import Path
from typing import Any

import numpy as np
import synthetic
from folder_case import FolderCase

from fsi_compare.base.errors import InputError
from fsi_compare.reporting.pressure import check_comparable
from fsi_compare.results.line import lines_of
from fsi_compare.runs.run_folder import read_run
from fsi_compare.runs.samples import differences_of_tables, read_samples
from fsi_compare.study.study_run import StudyRun
from fsi_research.evidence.cross_check import has_pressure

LINE = """time_ms,line,s_mm,x_mm,y_mm,z_mm,pressure_Pa,velocity_x_mm_per_ms
0.5,a,0,1,0,0,10,0.5
0.5,a,2,1,0,2,20,
0.5,centerline,0,0,0,0,1,2
0.5,centerline,1,0,0,1,3,4
1,a,0,1,0,0,30,0.25
1,a,2,1,0,2,40,
1,centerline,0,0,0,0,5,6
1,centerline,1,0,0,1,7,8
"""
FLOW = "time_ms,inlet_flow_mm3_per_ms,outlet_flow_mm3_per_ms\n0.5,1,2\n1,3,4\n"
FLOW_AND_PRESSURE = (
    "time_ms,inlet_flow_mm3_per_ms,outlet_flow_mm3_per_ms,inlet_pressure_Pa,outlet_pressure_Pa\n"
    "0.5,1,2,30,10\n1,3,4,50,20\n"
)
NO_REQUEST: Any = None  # of a study: what was read does not ask


class Samples(FolderCase):
    def table(self, text=LINE, name="lines.csv"):
        path = self.base / name
        path.write_text(text)
        return path

    def test_lines_by_name(self):
        lines = read_samples(self.table())
        self.assertEqual(set(lines), {"a", "centerline"})
        a = lines["a"]
        np.testing.assert_array_equal(a.times, [0.5, 1])
        np.testing.assert_array_equal(a.places["s_mm"], [0, 2])
        np.testing.assert_array_equal(a.values["pressure_Pa"], [[10, 20], [30, 40]])
        np.testing.assert_array_equal(a.values["velocity_x_mm_per_ms"], [[0.5, np.nan], [0.25, np.nan]])

    def test_tables_without_names_are_one_sample(self):
        flow = read_samples(self.table(FLOW, "flow.csv"))
        np.testing.assert_array_equal(flow[""].values["inlet_flow_mm3_per_ms"], [[1], [3]])

    def test_what_is_broken_is_named(self):
        for text, said in (
            (LINE[:-1], "is cut off"),
            (LINE.split("\n")[0] + "\n", "no time level"),
            (LINE.replace("1,a,2,1,0,2,40,\n", ""), "has not the same points at each time"),
            (LINE.replace("1,a,2,1,0,2", "1,a,2,1,0,2.5"), "has not the same points at each time"),
            (LINE.replace("10,0.5", "ten,0.5"), "line 2: pressure_Pa 'ten' is not a number"),
            (LINE.replace("10,0.5", "inf,0.5"), "line 2: pressure_Pa is inf"),
            (LINE.replace("10,0.5", "10"), "line 2: has 7 values instead of 8"),
        ):
            with self.assertRaises(InputError) as refused:
                read_samples(self.table(text))
            self.assertIn(said, str(refused.exception))

    def test_differences_are_of_times_and_places_in_common(self):
        for folder, text in (
            ("one", LINE),
            ("other", LINE.replace("1,centerline", "1.25,centerline").replace("30", "33")),
        ):
            (self.base / folder).mkdir()
            (self.base / folder / "lines.csv").write_text(text)
        found = differences_of_tables(self.base / "one", self.base / "other", ("lines.csv", "planes.csv"))
        by = {(d.sample, d.column): d for d in found}
        self.assertEqual((by["a", "pressure_Pa"].largest, by["a", "pressure_Pa"].size), (3, 40))
        self.assertEqual(by["a", "velocity_x_mm_per_ms"].largest, 0)
        self.assertEqual(by["centerline", "pressure_Pa"].levels, 1)

    def finished(self, name, **tables):
        folder = synthetic.write_run(self.base / name, synthetic.parabola(0.8))
        (folder / "centerline_pressure.csv").unlink()
        for table, text in tables.items():
            (folder / f"{table}.csv").write_text(text)
        return folder

    def test_a_bent_tube_has_the_centre_line_that_was_found(self):
        run = read_run(self.finished("bent", lines=LINE))
        np.testing.assert_array_equal(run.pressure.z, [0, 1])
        np.testing.assert_array_equal(run.pressure.pressure, [[1, 3], [5, 7]])

    def test_messages_name_the_table_that_the_line_is_from(self):
        run = read_run(self.finished("bent", lines=LINE))
        with self.assertRaisesRegex(InputError, r"lines\.csv: --times: 99 ms is outside the run"):
            check_comparable([run], [99.0])
        longer = dataclasses.replace(run, pressure=dataclasses.replace(run.pressure, z=10 * run.pressure.z))
        with self.assertRaisesRegex(
            InputError, r"lines\.csv: s_mm: runs from 0 to 1 mm, the first run's from 0 to 10 mm"
        ):
            check_comparable([longer, run], [])

    def test_studies_take_the_line_that_the_case_asks_for(self):
        asked = LINE.replace("centerline", "b")
        for lines, pressure in ((asked, [[10, 20], [30, 40]]), (LINE, [[1, 3], [5, 7]])):
            name = f"line{len(pressure)}{pressure[0][0]}"
            run = StudyRun(NO_REQUEST, self.finished(name, lines=lines), "done", "", 1.0, "")
            self.assertTrue(has_pressure(run.folder))
            np.testing.assert_array_equal(run.pressure.pressure, pressure)
        along = StudyRun(
            NO_REQUEST, synthetic.write_run(self.base / "along", synthetic.parabola(0.8)), "done", "", 1, ""
        )
        self.assertTrue(has_pressure(along.folder))
        np.testing.assert_array_equal(along.pressure.pressure, read_run(along.folder).pressure.pressure)
        # A line that leaves the fluid has no pressure all along it.
        for lines in ("", asked.replace(",10,", ",,").replace(",1,2\n", ",,2\n")):
            without = self.finished(f"without{len(lines)}", **({"lines": lines} if lines else {"flow": FLOW}))
            self.assertFalse(has_pressure(without))

    def test_one_reader_serves_the_library_too(self):
        samples, lines = read_samples(self.table()), lines_of(self.table())
        self.assertEqual(list(lines), list(samples))
        np.testing.assert_array_equal(lines["a"]["pressure"], samples["a"].values["pressure_Pa"])
        np.testing.assert_array_equal(lines["a"].points, [[1, 0, 0], [1, 0, 2]])
        self.assertEqual(lines["a"].units, {"pressure": "Pa", "velocity_x": "mm/ms"})
        # A run that goes on: what its last level lacks is left out with it.
        growing = lines_of(self.table(LINE[: LINE.rindex("7,8")]), finished=False)
        self.assertEqual([len(growing[name].times) for name in ("a", "centerline")], [2, 1])

    def test_of_branching_vessels_flows_and_samples_are_compared(self):
        one = self.finished("one", flow=FLOW)
        other = self.finished("other", flow=FLOW.replace("3,4", "3,4.5"), lines=LINE)
        code, out, err = self.call("pressure", one, other, "-o", self.out)
        self.assertEqual((code, err), (0, ""))
        self.assertIn("outlet_flow_mm3_per_ms", out)
        rows = {row["column"]: row for row in self.csv("sample_differences.csv")}
        self.assertEqual(float(rows["outlet_flow_mm3_per_ms"]["largest_difference"]), 0.5)
        self.assertEqual(float(rows["inlet_flow_mm3_per_ms"]["largest_difference"]), 0)

    def report_and_pressure(self, one, other, *options):
        """What both commands write of two runs: {table: rows}, and the report's text."""
        for command in ("pressure", "report"):
            given = options if command == "pressure" else ()
            code, _, err = self.call(command, one, other, "-o", self.base / command, "--labels", "A,B", *given, "-q")
            self.assertEqual((code, err), (0, ""))
        return (self.base / "report" / "report.md").read_text()

    def test_reports_of_branching_vessels_have_the_same_differences(self):
        one = self.finished("one", flow=FLOW_AND_PRESSURE, lines=LINE.replace("centerline", "b"))
        other = self.finished(
            "other", flow=FLOW_AND_PRESSURE.replace("3,4,", "3,4.5,"), lines=LINE.replace("centerline", "b")
        )
        text = self.report_and_pressure(one, other)
        tables = [(self.base / command / "sample_differences.csv").read_text() for command in ("pressure", "report")]
        self.assertEqual(*tables)
        self.assertEqual(tables[0].count("\n"), 1 + 4 + 2 * 2)  # columns of the flow, and of each line
        self.assertIn("| B | flow.csv |  | outlet\\_flow\\_mm3\\_per\\_ms | 5.000e-01 | 4.000e+00 | 2 |", text)
        self.assertFalse((self.base / "report" / "differences.csv").exists(), "a table without rows")

    def test_reports_of_bent_tubes_have_the_same_differences(self):
        """Along the centre line that was found; the other tables beside it."""
        one = self.finished("one", flow=FLOW_AND_PRESSURE, lines=LINE)
        other = self.finished(
            "other", flow=FLOW_AND_PRESSURE, lines=LINE.replace(",5,6", ",5.5,6").replace(",7,8", ",7.25,8")
        )
        text = self.report_and_pressure(one, other, "--times", "0.5,1")
        printed = json.loads((self.base / "pressure" / "pressure_waves.json").read_text())
        (largest,) = (run["largest_difference"] for run in printed["runs"][1:])
        self.out = self.base / "report"
        (row,) = self.csv("differences.csv")
        self.assertEqual((row["run"], row["quantity"], int(row["levels"])), ("B", "pressure", largest["common_levels"]))
        self.assertEqual(float(row["max_relative"]), largest["max_relative"])
        self.assertEqual(float(row["l2_relative"]), largest["l2_relative"])
        self.assertAlmostEqual(largest["max_relative"], 0.5 / 7, places=15)
        rows = {(row["sample"], row["column"]): row for row in self.csv("sample_differences.csv")}
        self.assertEqual(float(rows["centerline", "pressure_Pa"]["largest_difference"]), 0.5)
        self.assertIn("| B | pressure | 7.14e-02 |", text)

    def test_a_missing_last_level_leaves_the_common_ones(self):
        """A run whose last level could not be had is compared up to the one before."""
        whole = self.finished("whole", flow=FLOW_AND_PRESSURE)
        short = self.finished("short", flow=FLOW_AND_PRESSURE.replace("1,3,4,50,20\n", ""))
        self.report_and_pressure(whole, short)
        self.out = self.base / "report"
        self.assertEqual({row["times"] for row in self.csv("sample_differences.csv")}, {"1"})

    def test_nothing_in_common(self):
        code, _, err = self.call(
            "pressure", self.finished("one", flow=FLOW), self.finished("other", lines=LINE), "-o", self.out
        )
        self.assertEqual(code, 1)
        self.assertIn("has no samples at times in common", err)


if __name__ == "__main__":
    unittest.main()
