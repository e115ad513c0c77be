"""The library: units from headers, tables of any kind, what is absent, and what is wrong with a folder."""

import json
import subprocess
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np
from folder_case import FolderCase
from synthetic import TIMES, Z, gaussian, write_run

import fsi_compare
from fsi_compare.reporting.first_read import case_lines
from fsi_compare.reporting.plots import plot_line
from fsi_compare.reporting.run_player import line_figure, panels
from fsi_compare.results.table import read_table
from fsi_compare.results.units import split_unit


class Units(unittest.TestCase):
    def test_units_of_headers(self):
        for header, expected in {
            "time_ms": ("time", "ms"),
            "z_mm": ("z", "mm"),
            "inlet_flow_mm3_per_ms": ("inlet_flow", "mm^3/ms"),
            "flow_mm2_per_ms": ("flow", "mm^2/ms"),
            "mean_pressure_Pa": ("mean_pressure", "Pa"),
            "fluid_kinetic_energy_uJ": ("fluid_kinetic_energy", "uJ"),
            "wall_s": ("wall", "s"),
            "shear_rate_per_ms": ("shear_rate", "1/ms"),
            "resistance_kPa_ms_per_mm3": ("resistance", "kPa ms/mm^3"),
            "force_mN": ("force", "mN"),
            "step": ("step", ""),
            "solver_error": ("solver_error", ""),
            "pass_per_step": ("pass_per_step", ""),
            "ms": ("ms", ""),
            "loads_mm_per": ("loads_mm_per", ""),
        }.items():
            self.assertEqual(split_unit(header), expected, header)


class Tables(FolderCase):
    def run_with(self, name, text, **summary):
        folder = write_run(self.base / "run", gaussian(0.66), **summary)
        (folder / name).write_text(text)
        return fsi_compare.open_run(folder, unfinished="status" in summary)

    def test_words_numbers_and_gaps(self):
        run = self.run_with("probe.csv", "time_ms,where,force_mN,work_uJ\n1,a,0.5,\n2,b,-1e-3,7\n2,a,3,8\n")
        table = run.table("probe")
        self.assertEqual(list(table), ["time", "where", "force", "work"])
        self.assertEqual([table.unit(name) for name in table], ["ms", "", "mN", "uJ"])
        np.testing.assert_array_equal(table["time"], [1, 2, 2])
        self.assertEqual(table["where"].tolist(), ["a", "b", "a"])
        np.testing.assert_array_equal(table["force_mN"], [0.5, -1e-3, 3])
        np.testing.assert_array_equal(table["work"], [np.nan, 7, 8])
        np.testing.assert_array_equal(table.where(where="a")["force"], [0.5, 3])
        self.assertEqual({name: part.rows for name, part in table.groups("where").items()}, {"a": 2, "b": 1})
        self.assertEqual(table.label("force"), "force in mN")
        self.assertNotIn("pressure", table)
        self.assertIn("probe.csv", run.tables)

    def test_names_that_differ_in_their_unit_only(self):
        table = self.run_with("coupling.csv", "residual,residual_mm\n1,2\n").coupling
        self.assertEqual(list(table), ["residual", "residual_mm"])
        self.assertEqual((table["residual"][0], table["residual_mm"][0], table.unit("residual_mm")), (1, 2, "mm"))

    def test_openings(self):
        rows = "".join(
            f"{t},{name},{q * t},{100 * q + t},{0 if name == 'a' else 5 * t}\n"
            for t in (1, 2, 3)
            for name, q in (("a", 2), ("b", -1))
        )
        header = "time_ms,opening,flow_mm3_per_ms,mean_pressure_Pa,windkessel_pressure_Pa\n"
        openings = self.run_with("openings.csv", header + rows).openings
        self.assertEqual(list(openings), ["a", "b"])
        np.testing.assert_array_equal(openings["a"].flow, [2, 4, 6])
        np.testing.assert_array_equal(openings["b"].mean_pressure, [-99, -98, -97])
        self.assertIsNone(openings["a"].windkessel_pressure)
        np.testing.assert_array_equal(openings["b"].windkessel_pressure, [5, 10, 15])

    def test_names_that_look_like_numbers(self):
        points = "time_ms,point,x_mm,y_mm,z_mm,pressure_Pa\n1,1,0,0,0,5\n1,w,0,0,1,6\n"
        run = self.run_with("points.csv", points)
        self.assertEqual({name: table["pressure"].tolist() for name, table in run.points.items()}, {"1": [5], "w": [6]})
        header = "time_ms,opening,flow_mm3_per_ms,mean_pressure_Pa,windkessel_pressure_Pa\n"
        (run.folder / "openings.csv").write_text(header + "1,1,2,3,0\n1,2,-2,4,0\n")
        (run.folder / "network.csv").write_text("time_ms,element,volume_mm3\n1,inf,2\n1,coil,\n")
        self.assertEqual(", ".join(run.openings), "1, 2")
        self.assertEqual(run.table("network")["element"].tolist(), ["inf", "coil"])

    def test_closed_ends_are_no_openings(self):
        header = "time_ms,inlet_flow_mm3_per_ms,outlet_flow_mm3_per_ms,inlet_pressure_Pa,outlet_pressure_Pa\n"
        run = self.run_with("flow.csv", header + "1,0,0,0,0\n2,3,0,400,0\n")
        self.assertEqual({name: one.flow.tolist() for name, one in run.openings.items()}, {"inlet": [0, -3]})
        (run.folder / "flow.csv").write_text(header + "1,0,0,0,0\n2,0,0,0,0\n")
        self.assertEqual(fsi_compare.open_run(run.folder).openings, {})

    def test_static_runs(self):
        run = self.run_with("energy.csv", "step,time_ms,wall_isochoric_energy_uJ,remainder_uJ\n1,0.5,2,0\n2,1,4,0\n")
        (run.folder / "iterations.csv").write_text("step,time_ms\n1,0.5\n2,1\n")
        (run.folder / "wall_displacement.csv").write_text("time_ms,z_mm,radial_mm\n0.5,0,1\n0.5,1,2\n1,0,2\n1,1,4\n")
        self.assertTrue(run.static)
        self.assertIn("**steps**: 2 of 0.5 of the load, to 1 of the load", case_lines([run], ["run"]))
        self.assertEqual(plot_line([run], 0.5, "wall_line", "radial").get_title(), "0.5 of the load")
        shown = next(panel for panel in panels([run]) if panel.title.startswith("Radial"))
        axes = line_figure(shown, ["run"], [0.5], run.static).axes
        self.assertEqual(axes[0].get_title(), "0.50 of the load")
        (run.folder / "energy.csv").write_text("step,wall_kinetic_energy_uJ,wall_isochoric_energy_uJ\n1,2,3\n")
        run = fsi_compare.open_run(run.folder)
        self.assertFalse(run.static)
        self.assertIn("**steps**: 2 of 0.5 ms, to 1 ms", case_lines([run], ["run"]))

    def test_samples(self):
        """Two lines, one of two points and one of three, and a plane, at two times."""
        points = {"a": [(0, 0, 0), (0, 0, 2)], "bent one": [(0, 0, 0), (3, 0, 4), (3, 5, 4)]}
        lines = "time_ms,line,s_mm,x_mm,y_mm,z_mm,pressure_Pa,velocity_x_mm_per_ms,velocity_y_mm_per_ms,velocity_z_mm_per_ms\n"
        for t in (1, 2):
            for name, at in points.items():
                lines += "".join(
                    f"{t},{name},{5 * i},{x},{y},{z},{10 * t + i},{3 * t},,{4 * t}\n" for i, (x, y, z) in enumerate(at)
                )
        run = self.run_with("lines.csv", lines.replace(",,", ",0,"))
        (run.folder / "planes.csv").write_text(
            "time_ms,plane,flow_mm3_per_ms,pressure_Pa,area_mm2\n1,p,2,3,4\n2,p,5,6,7\n"
        )
        self.assertEqual(list(run.lines), ["a", "bent one"])
        bent = run.lines["bent one"]
        np.testing.assert_array_equal(bent.s, [0, 5, 10])
        np.testing.assert_array_equal(bent.points, points["bent one"])
        np.testing.assert_array_equal(bent["pressure"], [[10, 11, 12], [20, 21, 22]])
        np.testing.assert_array_equal(bent.at(1.5, "pressure"), [15, 16, 17])
        self.assertEqual(
            (list(bent.values)[0], bent.vectors, bent.units["velocity_x"]), ("pressure", ["velocity"], "mm/ms")
        )
        np.testing.assert_allclose(bent.magnitude("velocity"), [[5, 5, 5], [10, 10, 10]])
        np.testing.assert_array_equal(run.planes["p"]["flow"], [2, 5])
        self.assertEqual((run.points, run.surfaces), ({}, {}))
        headings = {panel.title: panel.y for panel in panels([run]) if panel.lines or panel.series}
        self.assertEqual(headings["Velocity along the line bent one"], ("velocity", "mm/ms"))
        self.assertEqual(headings["Flow: plane p"], ("flow", "mm^3/ms"))

    def test_wrong_tables(self):
        for text, problem in (
            ("", "is empty"),
            ("a,a\n1,2\n", "line 1: column 'a' is there twice"),
            ("a,\n1,2\n", "line 1: a column has no name"),
            ("a,b\n1,2\n3\n", "line 3: has 1 values instead of 2"),
            ("a,b\n1,2\n3,x\n", "line 3: b 'x' is not a number"),
            ("a,b\n1,2\n3,4", "line 3: is cut off"),
            ("a,b\n1,2\n3,1e200\n", "line 3: b 1e200 is too large"),
            ("a,b\n1,2\n3,1_0\n", "line 3: b '1_0' is not a number"),
        ):
            with self.subTest(text):
                (self.base / "probe.csv").write_text(text)
                with self.assertRaisesRegex(fsi_compare.InputError, f"probe.csv: {problem}"):
                    read_table(self.base / "probe.csv")

    def test_run_that_goes_on(self):
        run = self.run_with("probe.csv", "time_ms,a\n1,2\n2,", status="running")
        np.testing.assert_array_equal(run.table("probe")["time"], [1])
        self.assertEqual(run.status, "running")
        with self.assertRaisesRegex(fsi_compare.InputError, "not finished"):
            fsi_compare.open_run(run.folder)


class Folders(FolderCase):
    def test_what_is_absent(self):
        run = fsi_compare.open_run(write_run(self.base / "run", gaussian(0.66)))
        self.assertEqual((run.wall_line, run.energy, run.coupling), (None, None, None))
        self.assertEqual((run.openings, run.fields), ({}, {}))
        with self.assertRaisesRegex(fsi_compare.InputError, "has no table 'iterations.csv'; did you mean"):
            run.time
        with self.assertRaisesRegex(fsi_compare.InputError, "has no 'presure'; did you mean 'pressure'"):
            run.centre_line["presure"]
        with self.assertRaisesRegex(fsi_compare.InputError, "line centre line: 99 ms is outside the run"):
            run.centre_line.at(99, "pressure")

    def test_no_run(self):
        with self.assertRaisesRegex(fsi_compare.InputError, "no such folder"):
            fsi_compare.open_run(self.base / "none")
        with self.assertRaisesRegex(fsi_compare.InputError, "no such folder"):
            fsi_compare.open_run(self.base / "none", unfinished=True)
        (self.base / "summary.json").write_text(json.dumps({"program": "other", "status": "running"}))
        with self.assertRaisesRegex(fsi_compare.InputError, "program: is missing or unknown"):
            fsi_compare.open_run(self.base, unfinished=True)

    def test_line_with_other_points_at_a_time(self):
        folder = write_run(self.base / "run", gaussian(0.66))
        (folder / "centerline_pressure.csv").write_text("time_ms,z_mm,pressure_Pa\n1,0,1\n1,1,1\n2,0,1\n2,3,1\n")
        with self.assertRaisesRegex(fsi_compare.InputError, "has not the same points at each time"):
            fsi_compare.open_run(folder).centre_line


class Fields(FolderCase):
    """Two files of entries, with a scalar of nodes, a vector of cells and a symmetric tensor of nodes."""

    POINTS, CELLS = np.arange(15.0).reshape(5, 3), np.array([[0, 1, 2, 3], [1, 2, 3, 4]], dtype=np.int32)
    SHAPES = {"pressure": (5,), "traction": (2, 3), "rate": (5, 6)}

    def write(self, path, entries):
        """`entries`: (number, time, whether it is finished)."""
        with h5py.File(path, "w") as h5:
            h5["steps/number"] = np.array([number for number, _, _ in entries])
            h5["steps/time"] = np.array([time for _, time, _ in entries])
            h5["fluid/points"], h5["fluid/cells"] = self.POINTS, self.CELLS
            for name, shape in self.SHAPES.items():
                for number, time, _ in entries:
                    h5[f"fluid/{name}/{number:08d}"] = np.arange(np.prod(shape)).reshape(shape) + 100 * time
                h5[f"fluid/{name}"].attrs["unit"] = np.bytes_("kPa" if name != "rate" else "1/ms")
                h5[f"steps/written/fluid.{name}"] = np.array([done for _, _, done in entries], dtype=np.uint8)

    def test_entries_of_all_files(self):
        folder = write_run(self.base / "run", gaussian(0.66))
        self.write(folder / "fields.h5", [(0, 0.0, 1), (4, 0.5, 1), (8, 1.0, 1)])
        self.write(folder / "fields-0002.h5", [(8, 1.0, 1), (12, 2.0, 1), (16, 3.0, 0)])
        fields = fsi_compare.open_run(folder).fields
        self.assertEqual(list(fields), ["fluid"])
        fluid = fields["fluid"]
        self.assertEqual((fluid.names, fluid.units["rate"]), (["pressure", "rate", "traction"], "1/ms"))
        np.testing.assert_array_equal(fluid.times, [0, 0.5, 1, 2])
        np.testing.assert_array_equal(fluid.points, self.POINTS)
        np.testing.assert_array_equal(fluid.cells, self.CELLS)
        self.assertIsNone(fluid.layers)
        for name, shape in self.SHAPES.items():
            for time in (0, 0.5, 1, 1.25, 2):  # linear in time
                expected = np.arange(np.prod(shape)).reshape(shape) + 100 * time
                np.testing.assert_allclose(fluid.at(time, name), expected, rtol=1e-14)
        for wrong, problem in (
            (lambda: fluid.at(2.5, "rate"), "2.5 ms is outside what was written; give a time between 0 and 2 ms"),
            (lambda: fluid.at(1, "presure"), "has no field 'presure'; did you mean 'pressure'"),
        ):
            with self.assertRaisesRegex(fsi_compare.InputError, problem):
                wrong()

    def test_damaged_file(self):
        folder = write_run(self.base / "run", gaussian(0.66))
        (folder / "fields.h5").write_bytes(b"no HDF5")
        with self.assertRaisesRegex(fsi_compare.InputError, "fields.h5: cannot be read"):
            fsi_compare.open_run(folder).fields


class Comparison(FolderCase):
    def lines(self, first, second):
        one = write_run(self.base / "one", first)
        two = write_run(self.base / "two", second)
        return fsi_compare.open_run(one).centre_line, fsi_compare.open_run(two).centre_line

    def test_norms(self):
        """A wave against another one 10 % higher and one Pa: closed forms."""
        reference, other = self.lines(lambda t, z: 0 * z + 2 * t, lambda t, z: 0 * z + 2.2 * t + 1)
        found = fsi_compare.difference(other, reference, "pressure")
        np.testing.assert_allclose(found.max_norm, 0.2 * TIMES + 1)
        np.testing.assert_allclose(found.max_relative, (0.2 * TIMES + 1) / (2 * TIMES))
        np.testing.assert_allclose(found.l2_norm, (0.2 * TIMES + 1) * np.sqrt(Z[-1]))
        np.testing.assert_allclose(found.l2_relative, found.max_relative)
        self.assertEqual((found.unit, found.largest.levels), ("Pa", len(TIMES)))
        between = fsi_compare.difference(other, reference, "pressure", times=[1.3])
        np.testing.assert_allclose(between.max_norm, 0.2 * 1.3 + 1)
        with self.assertRaisesRegex(fsi_compare.InputError, "outside the run"):
            fsi_compare.difference(other, reference, "pressure", times=[13])
        with self.assertRaisesRegex(fsi_compare.InputError, "is not there"):
            fsi_compare.difference(None, reference, "pressure")

    def test_names_of_the_library(self):
        for name in fsi_compare.__all__:
            self.assertTrue((getattr(fsi_compare, name).__doc__ or "").strip(), name)
        with self.assertRaises(AttributeError):
            fsi_compare.no_such_name

    def test_library_without_the_studies(self):
        script = (
            "import sys, fsi_compare\n"
            "found = [getattr(fsi_compare, name) for name in fsi_compare.__all__]\n"
            "print([name for name in sys.modules if name.startswith(('fsi_research', 'fsi_compare.cli'))])\n"
        )
        place = str(Path(fsi_compare.__file__).parents[1])
        ended = subprocess.run([sys.executable, "-B", "-c", script], capture_output=True, text=True, cwd=place)
        self.assertEqual((ended.returncode, ended.stdout), (0, "[]\n"), ended.stderr)


if __name__ == "__main__":
    unittest.main()
