"""fsi-compare export: ParaView's reader and meshio find in its files what the run has written, bit for bit."""

import json
import unittest
from pathlib import Path

import h5py
import numpy as np
from other_readers import read_by_others
from programs import ARTERY, MESH, MONOLITHIC, FolderTest, execute, restart, run
from scenes import forms, scene

COMPARE = Path(MESH).parent / "fsi-compare"
READER = Path(__file__).with_name("read_series.py")
KINDS = {
    ("p1", "axisymmetric"): ("vtkTriangle", "triangle"),
    ("p2p1", "axisymmetric"): ("vtkQuadraticTriangle", "triangle6"),
    ("p2p1", "3d"): ("vtkQuadraticTetra", "tetra10"),
}
TIMES = [0.0, 0.125, 0.25]


def shown(file):
    return json.loads(read_by_others(READER, file))


class Export(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.runs = {
            kind: run(
                MONOLITHIC,
                ARTERY,
                cls.base / "-".join(kind),
                *scene(cls.base, *kind),
                *forms(ARTERY),
                "time.end=0.25",
                "output.every=1",
                'output.fields=["displacement", "velocity", "pressure", "cauchy_stress"]',
            )
            for kind in KINDS
        }

    def export(self, *words):
        return execute(COMPARE, "export", *words)

    def written(self, folder, medium):
        """Arrays of the medium in fields.h5: mesh, and fields by number of the entry."""
        with h5py.File(folder / "fields.h5") as h5:
            part = h5[medium]
            numbers = [f"{number:08d}" for number in h5["steps/number"]]
            mesh = {name: part[name][()] for name in ("points", "cells", "layer") if name in part}
            names = [name for name in part if name not in mesh]
            return mesh, [{name: part[f"{name}/{number}"][()] for name in names} for number in numbers]

    def compare(self, found, mesh, fields, time):
        self.assertEqual(np.ravel(found["time"]).tolist(), [time])
        np.testing.assert_array_equal(found["points"], mesh["points"])
        np.testing.assert_array_equal(found["cells"], mesh["cells"])
        together = {**found["fields"]["points"], **found["fields"]["cells"]}
        np.testing.assert_array_equal(together.pop("layer"), mesh["layer"])
        self.assertEqual(sorted(together), sorted(fields))
        for name, values in fields.items():
            if name == "cauchy_stress":  # xx, xy, xz, yy, yz, zz; VTK numbers xx, yy, zz, xy, yz, xz
                values = values[:, [0, 3, 5, 1, 4, 2]]
            np.testing.assert_array_equal(together[name], values)

    def test_series_are_what_was_written(self):
        for kind, folder in self.runs.items():
            process = self.export(folder)
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertIn("8 files written", process.stdout)
            for medium in ("fluid", "wall"):
                with self.subTest(kind=kind, medium=medium):
                    mesh, fields = self.written(folder, medium)
                    self.assertTrue(fields[-1])
                    series = shown(folder / "vtu" / f"{medium}.pvd")
                    self.assertEqual([entry["time"] for entry in series], TIMES)
                    for entry, values, time in zip(series, fields, TIMES):
                        self.compare(entry, mesh, values, time)
                        self.assertEqual(entry["kinds"], [KINDS[kind][0]])
                    one = shown(folder / "vtu" / f"{medium}-0002.vtu")
                    self.compare(one, mesh, fields[2], TIMES[2])
                    self.assertEqual(one["kinds"], [KINDS[kind][1]])

    def test_chosen_fields_and_times(self):
        folder = self.runs["p1", "axisymmetric"]
        out = self.base / "chosen"
        process = self.export(folder, "--to", "pvd", "--fields", "pressure", "--times", "0.125,0.1875", "-o", out, "-q")
        self.assertEqual((process.returncode, process.stdout), (0, ""), process.stderr)
        mesh, fields = self.written(folder, "fluid")
        first, second = shown(out / "fluid.pvd")
        self.compare(first, mesh, {"pressure": fields[1]["pressure"]}, 0.125)
        middle = 0.5 * fields[1]["pressure"] + 0.5 * fields[2]["pressure"]
        self.compare(second, mesh, {"pressure": middle}, 0.1875)

    def test_field_that_a_restart_has_added(self):
        """The earlier times have the fields of the earlier run, for ParaView, too."""
        kind = "p1", "axisymmetric"
        whole = run(
            MONOLITHIC,
            ARTERY,
            self.base / "added",
            *scene(self.base, *kind),
            *forms(ARTERY),
            *("time.end=0.25", "output.every=1", 'output.fields=["velocity", "pressure"]'),
        )
        fields = 'output.fields=["displacement", "velocity", "pressure"]'
        words = (*scene(self.base, *kind), *forms(ARTERY), "time.end=0.375", "output.every=1", fields)
        restart(MONOLITHIC, ARTERY, whole, *words)
        process = self.export(whole)
        self.assertEqual(process.returncode, 0, process.stderr)
        series = shown(whole / "vtu" / "fluid.pvd")
        self.assertEqual([entry["time"] for entry in series], [*TIMES, 0.375])
        for entry in series:
            added = ["displacement"] if entry["time"] > 0.25 else []
            self.assertEqual(sorted(entry["fields"]["points"]), [*added, "pressure", "velocity"])
        process = self.export(whole, "--times", "0.125", "-o", self.base / "refused")
        self.assertEqual(process.returncode, 1)
        self.assertIn("fluid/displacement: 0.125 ms is outside what was written", process.stderr)

    def test_wrong_use_is_said_in_one_line(self):
        folder = self.runs["p1", "axisymmetric"]
        bare = run(
            MONOLITHIC,
            ARTERY,
            self.base / "bare",
            *scene(self.base, "p1", "axisymmetric"),
            "output.every=0",
            "time.end=0.125",
        )
        for words, said in (
            ((folder, "--fields", "presure"), "'presure' is not in this run; did you mean 'pressure'?"),
            ((folder, "--times", "0.125,9"), "9 ms is outside what was written"),
            ((folder, "--times", "1,1"), "1 is given twice"),
            ((folder, "--times", "soon"), "'soon' is not a number"),
            ((folder, "--to", "exodus"), "invalid choice: 'exodus'"),
            ((bare,), "holds no fields; set output.every"),
            ((self.base / "none",), "no such folder"),
        ):
            with self.subTest(said=said):
                out = self.base / "refused"
                process = self.export(*words, "-o", out)
                self.assertEqual(process.returncode, 1)
                self.assertIn(said, process.stderr)
                self.assertEqual(process.stderr.count("\n"), 1)
                self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
