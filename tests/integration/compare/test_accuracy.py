"""fsi-compare accuracy: errors of runs against a run or a kept reference, at each time and the worst of them."""

import json
import unittest

import numpy as np
from folder_case import FolderCase
from synthetic import TIMES, Z, artery_like, pressure_csv, write_run

ITERATIONS = "step,time_ms,outer_iterations,newton_iterations,linear_iterations,wall_s\n"
WAVE = artery_like(0.66)


def times(factor, wave=WAVE):
    return lambda t, z: (factor(t) if callable(factor) else factor) * wave(t, z)


class AccuracyOfRuns(FolderCase):
    def run_of(self, name, pressure=1.0, displacement=1.0, levels=TIMES, z=Z, **summary):
        folder = write_run(self.base / name, times(pressure), levels, z, **summary)
        lines = pressure_csv(times(displacement), levels, z).replace("pressure_Pa", "radial_mm,axial_mm").splitlines()
        (folder / "wall_displacement.csv").write_text("\n".join([lines[0], *(f"{one},0" for one in lines[1:])]) + "\n")
        rows = "".join(f"{i},{t},1,3,20,0.5\n" for i, t in enumerate(levels, 1))
        (folder / "iterations.csv").write_text(ITERATIONS + rows)
        return folder

    def assert_refused(self, expected, *arguments):
        code, out, err = self.call("accuracy", *arguments, "-o", self.out)
        self.assertEqual((code, out, err.count("\n")), (1, "", 1))
        self.assertIn(expected, err)
        self.assertFalse(self.out.exists())

    def test_a_tube_beside_its_axisymmetric_twin(self):
        exact = self.run_of("exact")
        tube = self.run_of("tube", 1.25, lambda t: 1 + t / 100, mesh={"nodes": 9603}, element="p1", geometry="3d")
        twin = self.run_of("twin", 0.99, 1.0, mesh={"nodes": 4053}, element="p2p1", geometry="axisymmetric")
        code, out, err = self.call("accuracy", exact, tube, twin, "-o", self.out)
        self.assertEqual((code, err), (0, ""))
        rows = self.csv("accuracy.csv")
        self.assertEqual([(row["run"], row["time_ms"]) for row in rows[3:5]], [("tube", "6.0"), ("twin", "1.5")])
        for row, radial in zip(rows, (0.015, 0.03, 0.045, 0.06)):
            self.assertAlmostEqual(float(row["pressure_relative_L2"]), 0.25, places=12)
            self.assertAlmostEqual(float(row["radial_relative_L2"]), radial, places=12)
            self.assertEqual(
                (row["element"], row["geometry"], row["nodes"], float(row["wall_s"])), ("p1", "3d", "9603", 48.0)
            )
        worst = next(line.split() for line in out.splitlines() if line.strip().startswith("tube"))
        self.assertEqual(worst[-6:], ["1.5", "3", "4.5", "6", "3.75", "6"])
        self.assertNotIn("Time steps differ", out)

    def test_a_finished_run_of_a_vessel_that_branches_is_not_called_unfinished(self):
        tube, fork = self.run_of("tube"), self.run_of("fork")
        for missing in ("centerline_pressure.csv", "wall_displacement.csv"):
            (fork / missing).unlink()
            for runs in ((tube, fork), (fork, tube)):
                self.assert_refused("is missing, though the run is finished: only straight tubes", *runs)
                code, _, err = self.call("accuracy", *runs, "-o", self.out)
                self.assertIn("fsi-compare pressure or fsi-compare report", err)
                self.assertNotIn("give the result folder of a finished run", err)

    def test_a_kept_reference_and_another_step(self):
        kept = self.base / "kept"
        kept.mkdir()
        own = {"pressure_Pa": 0.01, "averaged_pressure_Pa": 0.01, "radial_mm": 0.01}
        (kept / "reference.json").write_text(json.dumps({"description": "made up", "own_error": own}))
        levels = np.array([1.5, 3.0])
        (kept / "centerline_pressure.csv").write_text(pressure_csv(WAVE, levels))
        for file, column in (("averaged_pressure", "averaged_pressure_Pa"), ("wall_displacement", "radial_mm")):
            (kept / f"{file}.csv").write_text(pressure_csv(WAVE, levels).replace("pressure_Pa", column))
        run = self.run_of("run", 1.5)
        self.assert_refused("6 ms is outside", kept, run, "--times", "6")
        code, out, _ = self.call("accuracy", kept, run, "--times", "1.5,3", "-o", self.out)
        self.assertEqual(code, 0)
        self.assertIn("Time steps differ", out)
        self.assertEqual(
            [round(float(row["pressure_relative_L2"]), 12) for row in self.csv("accuracy.csv")], [0.5, 0.5]
        )

    def test_refuses_what_does_not_compare(self):
        exact = self.run_of("exact")
        self.assert_refused("no such folder", exact, self.base / "none")
        self.assert_refused("7 ms is outside", exact, self.run_of("short", levels=TIMES[:48]), "--times", "7")
        self.assert_refused("same geometry", exact, self.run_of("stub", z=Z[:90]))
        (exact / "wall_displacement.csv").unlink()
        self.assert_refused("wall_displacement.csv: is missing", exact, self.base / "short")


if __name__ == "__main__":
    unittest.main()
