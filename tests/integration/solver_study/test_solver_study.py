"""`fsi-compare solvers` with the real programs on the coarse mesh."""

import csv
import json
import os
import sys
import unittest
from pathlib import Path

from msh import Mesh
from programs import LINEAR_STUDY, MONOLITHIC, FolderTest, execute

COMPARE_FOLDER = Path(__file__).resolve().parents[3] / "compare"
sys.path[:0] = [str(COMPARE_FOLDER), str(COMPARE_FOLDER / "research")]
sys.path.append(str(Path(__file__).resolve().parents[1] / "compare"))

import fake_linear_study  # noqa: E402
from fsi_compare.starting.programs import Program  # noqa: E402
from fsi_research.linear.stress import ASPECT_RATIO, make_stretched_mesh  # noqa: E402

COMPARE = os.environ["FSI_COMPARE"]


def shape(value):
    """Keys and types of a JSON value, a list's by its first entry; numbers are one type."""
    if isinstance(value, dict):
        return {key: shape(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [shape(entry) for entry in value[:1]]
    return float if isinstance(value, (int, float)) and not isinstance(value, bool) else type(value)


def common(whole, part):
    """What of the shape `whole` has a name in `part`."""
    if isinstance(whole, dict) and isinstance(part, dict):
        return {key: common(entry, part[key]) for key, entry in whole.items() if key in part}
    if isinstance(whole, list) and isinstance(part, list) and whole and part:
        return [common(whole[0], part[0])]
    return whole


def rows(file):
    with open(file, newline="") as opened:
        return list(csv.DictReader(opened))


class Study(FolderTest):
    def study(self, *words):
        return execute(COMPARE, "solvers", "--program", LINEAR_STUDY, "-o", self.base / "study", "--threads", 1, *words)

    def test_first_and_later_system(self):
        words = ("--methods", "lower,amg_fgmres,direct", "--materials", "neo-hookean", "--meshes", "coarse")
        done = self.study(*words)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for part in ("Table 3", "Table 4", "Table 5", "Cost of the methods", "Newton system 2 of step 12 (t = 1.5 ms)"):
            self.assertIn(part, done.stdout)

        out = self.base / "study"
        for system in ("step1_newton1", "step12_newton2"):
            cost = {row["method"]: row for row in rows(out / f"cost_{system}.csv")}
            self.assertEqual(set(cost), {"direct", "lower", "amg_fgmres"})
            for method, row in cost.items():
                with self.subTest(system=system, method=method):
                    self.assertEqual(row["status"], "converged")
                    self.assertLessEqual(float(row["relative_residual"]), 1.000001e-9)
                    self.assertGreater(float(row["solve_seconds"]), 0)
                    if method != "direct":
                        self.assertLessEqual(float(row["difference_to_direct"]), 1e-7)
                        self.assertGreater(int(row["flow_cycles"]), 0)
                        self.assertGreaterEqual(float(row["operator_complexity"]), 1)
            # 1,032 nodes: three displacements or velocities and a pressure at most, boundary conditions taken off
            self.assertLess(int(cost["direct"]["unknowns"]), 8 * 1032)
        first = {row["method"]: row for row in rows(out / "table5_multilevel_step1_newton1.csv")}["amg_fgmres"]
        self.assertEqual((first["paper_iterations"], first["above_limit"]), ("6", "no"))
        newton = [float(row["increment"]) for row in rows(out / "table3_newton.csv") if row["increment"]]
        self.assertLess(newton[3], 1e-8 * newton[0])  # quadratic, as without fsi-compare

        result = out / "runs" / "neo-hookean-coarse" / "linear_solvers.json"
        self.assert_the_stand_in_says_nothing_else(result)
        before = result.stat().st_mtime_ns
        done = self.study(*words)
        self.assertEqual(done.returncode, 0)
        self.assertIn("there already", done.stderr)
        self.assertEqual(result.stat().st_mtime_ns, before)

    def assert_the_stand_in_says_nothing_else(self, result):
        """What the stand-in for the program in the tests of `compare.solvers` writes, the program writes."""
        folder = self.base / "stand-in"
        options = ["--systems", "1:1,12:2", "--solvers", "lower,amg_fgmres,direct"]
        words = [folder / Path(LINEAR_STUDY).name, "neo-hookean.toml", "-o", folder, *options, "--tolerance", "1e-9"]
        folder.mkdir()
        self.assertEqual(fake_linear_study.main([str(word) for word in words]), 0)
        said = shape(json.loads((folder / result.name).read_text()))
        self.assertEqual(common(shape(json.loads(result.read_text())), said), said)

    def test_a_misspelt_setting_is_one_error(self):
        done = self.study(
            "--methods",
            "direct",
            "--materials",
            "neo-hookean",
            "--meshes",
            "coarse",
            "--systems",
            "1:1",
            "--set",
            "fluid.densty=1",
        )
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
        self.assertIn("density", done.stderr)


class StretchedMesh(FolderTest):
    def test_elements_are_as_long_as_the_table_says(self):
        for stretch in (ASPECT_RATIO, 1 / ASPECT_RATIO):
            with self.subTest(stretch=stretch):
                file = self.base / f"{stretch:g}.msh"
                self.assertEqual(make_stretched_mesh(Program(Path(MONOLITHIC), ""), file, "coarse", stretch), "")
                mesh = Mesh(file)
                self.assertEqual(len(mesh.nodes), 1032)  # as the level
                stations = sorted({round(float(point.split()[2]), 6) for point in mesh.nodes.values()})
                self.assertAlmostEqual(stations[1] - stations[0], stretch * 0.75, places=5)

    def test_as_many_nodes_as_the_level(self):
        file = self.base / "intermediate.msh"
        self.assertEqual(make_stretched_mesh(Program(Path(MONOLITHIC), ""), file, "intermediate", ASPECT_RATIO), "")
        self.assertEqual(len(Mesh(file).nodes), 7182)


if __name__ == "__main__":
    unittest.main()
