"""Folders that are not a finished run must be refused in one line that names file, place, problem and remedy."""

import json
import unittest

from folder_case import FolderCase
from synthetic import TIMES, Z, parabola, pressure_csv, write_run

from fsi_compare.base.errors import InputError
from fsi_compare.runs.coupling import with_coupling
from fsi_compare.runs.labels import default_labels
from fsi_compare.runs.run_folder import read_run
from fsi_compare.study.study_file import Method, Request
from fsi_compare.study.study_run import StudyRun

SHORT = TIMES[:4]


class ReadsRun(FolderCase):
    def run_of(self, name, **arguments):
        return read_run(write_run(self.base / name, parabola(0.5), SHORT, **arguments))

    def test_numbers_survive_in_full_precision(self):
        run = self.run_of("run")
        self.assertEqual(run.program, "fsi-monolithic")
        self.assertEqual(run.title, "Synthetic tube")
        self.assertTrue((run.pressure.times == SHORT).all())
        self.assertTrue((run.pressure.z == Z).all())
        for t, row in zip(SHORT, run.pressure.pressure):
            self.assertTrue((row == parabola(0.5)(t, Z)).all())

    def test_further_and_missing_summary_keys_are_tolerated(self):
        run = self.run_of("run", phases={"assembly": {"seconds": 1.0, "calls": 2}}, anything=[1, 2])
        self.assertEqual(run.summary["anything"], [1, 2])
        (run.folder / "summary.json").write_text('{"program": "fsi-partitioned", "status": "done"}')
        run = read_run(run.folder)
        self.assertEqual((run.program, run.title, run.version), ("fsi-partitioned", "", ""))

    def test_further_columns_and_windows_line_ends_are_tolerated(self):
        folder = self.run_of("run").folder
        text = (folder / "centerline_pressure.csv").read_text()
        wider = text.replace("\n", ",7\n").replace("Pa,7", "Pa,note", 1).replace("\n", "\r\n")
        (folder / "centerline_pressure.csv").write_bytes(wider.encode())
        self.assertEqual(read_run(folder).pressure.pressure.shape, (4, 181))

    def test_labels_are_as_short_as_they_can_be(self):
        a = self.run_of("a")
        b = self.run_of("b", program="fsi-partitioned")
        c = self.run_of("c", title="Mooney-Rivlin")
        d = self.run_of("d")
        self.assertEqual(default_labels([a, b]), ["monolithic", "partitioned"])
        self.assertEqual(default_labels([a, c]), ["monolithic, Synthetic tube", "monolithic, Mooney-Rivlin"])
        self.assertEqual(default_labels([a, d]), ["monolithic, a", "monolithic, d"])
        self.assertEqual(len(set(default_labels([a, a]))), 2)

    def test_labels_say_how_fluid_and_wall_were_coupled(self):
        """As far as the run says it: old ones do not."""
        scheme = {"partitioned.scheme": {"value": "iqn-ils", "reason": "the wall stands in the fluid"}}
        a = self.run_of("a", coupling_kind="monolithic")
        b = self.run_of("b", program="fsi-partitioned", coupling_kind="interface", choices=scheme)
        c = self.run_of("c", program="fsi-partitioned", choices=scheme)
        self.assertEqual(default_labels([a, b]), ["monolithic", "partitioned (interface, iqn-ils)"])
        self.assertEqual(default_labels([a, c]), ["monolithic", "partitioned (iqn-ils)"])
        self.assertEqual(with_coupling("a", a.program, a.summary), "a")
        self.assertEqual(with_coupling("mine", b.program, b.summary), "mine (interface, iqn-ils)")

    def test_method_of_a_study_has_its_kind(self):
        def label(settings, **summary):
            method = Method("x", "IQN-ILS", "fsi-partitioned", settings)
            request = Request("g", "c", method, {}, self.base, None, settings, 1.0)
            folder = self.run_of(f"study-{len(settings)}-{len(summary)}", program="fsi-partitioned", **summary).folder
            return StudyRun(request, folder, "done", "", 1.0, "").method_label

        scheme = {"partitioned.scheme": {"value": "iqn-ils", "reason": "named"}}
        named = {"partitioned.scheme": "iqn-ils"}
        self.assertEqual(label(named, coupling_kind="interface", choices=scheme), "IQN-ILS, interface")
        self.assertEqual(label({}, coupling_kind="interface", choices=scheme), "IQN-ILS, interface, iqn-ils")
        self.assertEqual(label(named), "IQN-ILS")


class RefusesBadFolder(FolderCase):
    def setUp(self):
        super().setUp()
        self.folder = write_run(self.base / "run", parabola(0.5), SHORT)
        self.pressure = self.folder / "centerline_pressure.csv"
        self.summary = self.folder / "summary.json"

    def assert_refused(self, *parts, folder=None):
        with self.assertRaises(InputError) as caught:
            read_run(folder or self.folder)
        message = str(caught.exception)
        self.assertNotIn("\n", message)
        for part in parts:
            self.assertIn(part, message)

    def change_summary(self, **values):
        summary = json.loads(self.summary.read_text())
        summary.update(values)
        self.summary.write_text(json.dumps({key: value for key, value in summary.items() if value is not None}))

    def change_line(self, number, text):
        lines = self.pressure.read_text().splitlines()
        lines[number - 1 : number] = [] if text is None else [text]
        self.pressure.write_text("\n".join(lines) + "\n")

    def test_no_folder(self):
        self.assert_refused("nowhere: no such folder;", folder=self.folder / "nowhere")

    def test_file_for_folder(self):
        self.assert_refused("summary.json: is not a folder;", folder=self.summary)

    def test_no_summary(self):
        self.summary.unlink()
        self.assert_refused("summary.json: is missing; give the result folder of a finished run")

    def test_summary_cut_off(self):
        self.summary.write_text(self.summary.read_text()[:25])
        self.assert_refused("summary.json: line 1: is not JSON")

    def test_summary_is_no_object(self):
        self.summary.write_text("[]")
        self.assert_refused("summary.json: is not a JSON object")

    def test_no_program(self):
        self.change_summary(program=None)
        self.assert_refused("summary.json: program: is missing")

    def test_unknown_program(self):
        self.change_summary(program="fsi-mesh")
        self.assert_refused("program: 'fsi-mesh' is unknown; it must be fsi-monolithic or fsi-partitioned")

    def test_running(self):
        self.change_summary(status="running")
        self.assert_refused("summary.json: status: the run is not finished; wait", "--restart " + str(self.folder))

    def test_not_converged(self):
        self.change_summary(status="not converged")
        self.assert_refused("status: the run stopped without converging; see", "run.log")

    def test_interrupted(self):
        self.change_summary(status="interrupted")
        self.assert_refused("status: the run was interrupted; resume it with", "--restart " + str(self.folder))

    def test_advice_is_a_whole_command(self):
        for status in ("running", "interrupted"):
            self.change_summary(status=status, case="my cases/tube.toml")
            self.assert_refused(f"resume it with fsi-monolithic 'my cases/tube.toml' --restart {self.folder}")

    def test_failed(self):
        self.change_summary(status="failed")
        self.assert_refused("status: the run failed; see", "run.log")

    def test_no_status(self):
        self.change_summary(status=None)
        self.assert_refused("status: is missing")

    def test_unknown_status(self):
        self.change_summary(status="fine")
        self.assert_refused("status: 'fine' is unknown; it must be 'done'")

    def test_no_csv(self):
        self.pressure.unlink()
        self.assert_refused("centerline_pressure.csv: is missing")

    def test_empty_csv(self):
        self.pressure.write_text("")
        self.assert_refused("centerline_pressure.csv: is empty")

    def test_header_only(self):
        self.pressure.write_text("time_ms,z_mm,pressure_Pa\n")
        self.assert_refused("centerline_pressure.csv: holds no time level")

    def test_wrong_column(self):
        self.change_line(1, "time_ms,z_mm,pressure_kPa")
        self.assert_refused(
            "line 1: column 'pressure_Pa' is missing; the first line must read time_ms,z_mm,pressure_Pa"
        )

    def test_last_line_cut_off(self):
        self.pressure.write_text(self.pressure.read_text()[:-4])
        self.assert_refused("line 725: is cut off; the run was interrupted")

    def test_missing_value(self):
        self.change_line(300, "0.25,11.7")
        self.assert_refused("line 300: has 2 values instead of 3")

    def test_not_a_number(self):
        self.change_line(300, "0.25,11.7,abc")
        self.assert_refused("line 300: pressure_Pa 'abc' is not a number")

    def test_nan(self):
        self.change_line(300, "0.25,11.7,nan")
        self.assert_refused("line 300: pressure_Pa is nan;", "run.log")

    def test_partial_last_level(self):
        lines = self.pressure.read_text().splitlines()[:-81]
        self.pressure.write_text("\n".join(lines) + "\n")
        self.assert_refused("time_ms 0.5: has 100 of 181 points; the run was interrupted")

    def test_line_lost_inside(self):
        self.change_line(300, None)
        self.assert_refused("time_ms 0.25: has 180 of 181 points")

    def test_points_differ(self):
        self.change_line(300, "0.25,11.65,1")
        self.assert_refused("line 300: z_mm differs from the first time level's")

    def test_points_not_ordered(self):
        self.change_line(5, "0.125,0.1,1")
        self.assert_refused("line 5: z_mm does not increase")

    def test_time_goes_back(self):
        text = pressure_csv(parabola(0.5), [0.125, 0.5, 0.25])
        self.pressure.write_text(text)
        self.assert_refused("line 364: time_ms goes back from 0.5 to 0.25")

    def test_single_point(self):
        self.pressure.write_text(pressure_csv(parabola(0.5), SHORT, Z[:1]))
        self.assert_refused("line 2: the first time level has a single point")

    def test_binary(self):
        self.pressure.write_bytes(b"\x89HDF\xff\xfe")
        self.assert_refused("centerline_pressure.csv: is not a text file")


if __name__ == "__main__":
    unittest.main()
