"""The five lines that the paper's report opens with follow from the runs."""

import unittest
from pathlib import Path

from study_case import StudyCase  # noqa: F401: the package's folder onto the path

from fsi_research.evidence.mesh_error import MeshError
from fsi_research.paper.answer import accuracy, cost, drivers, failures, wave
from fsi_research.paper.claims import NOT_REPRODUCED, REPRODUCED, Claim
from fsi_research.paper.cost import StepCost
from fsi_research.paper.runs import PaperRuns
from fsi_research.paper.speeds import Measured, Speeds
from fsi_research.paper.waves import Agreement
from fsi_compare.study.study_file import Method, Request, StudyMesh
from fsi_compare.study.study_run import DONE, StudyRun


def run_of(material="neo-hookean", mesh="coarse", method="monolithic", group="waves"):
    program = "fsi-monolithic" if "monolithic" in method else "fsi-partitioned"
    request = Request(
        group, material, Method(method, method, program, {}), {}, Path("a.toml"), StudyMesh(mesh, mesh, ()), {}, 1.0
    )
    return StudyRun(request, Path(f"{material}-{mesh}-{method}"), DONE, "", 1.0, "")


def step_cost(method, seconds, mesh="coarse"):
    return StepCost(run_of(mesh=mesh, method=method, group="cost"), None, 4, 10, 10, 4, 10, seconds)


def speeds_of(material, speed, height):
    return Speeds(material, "", 1.0, 1.2, 1.1, 0.9, {"coarse": Measured("coarse", speed, height)})


class Lines(unittest.TestCase):
    def test_drivers(self):
        near = [Agreement("neo-hookean", "coarse", 1e-6, 2e-5, 1.0), Agreement("artery", "coarse", 1e-6, 3e-5, 1.0)]
        line = drivers(near)
        self.assertIn("find the same wave. They differ by at most 3.0e-05", line)
        self.assertIn("(2 walls, coarse mesh)", line)
        self.assertIn("find different waves", drivers([*near, Agreement("artery", "fine", 1e-6, 2e-3, 1.0)]))
        self.assertIn("coarse and fine mesh", drivers([*near, Agreement("artery", "fine", 1e-6, 2e-3, 1.0)]))
        self.assertIn("not compared", drivers([]))
        unknown = Agreement("artery", "fine", 1e-6, float("nan"), 1.0)  # no common time level
        self.assertIn("not compared", drivers([unknown]))
        self.assertEqual(drivers([*near, unknown]), line)

    def test_wave(self):
        slow, fast = speeds_of("neo-hookean", 0.67, 32.6), speeds_of("artery", 0.87, 34.7)
        line = wave([slow, fast])
        self.assertIn("0.67 mm/ms and 33 Pa in the neo-Hookean wall, 0.87 mm/ms and 35 Pa in the artery wall", line)
        self.assertIn("fastest in the artery wall", line)
        self.assertIn("fastest in the neo-Hookean wall", wave([speeds_of("neo-hookean", 0.97, 32.6), fast]))
        self.assertNotIn("fastest", wave([slow]))
        self.assertNotIn("fastest", wave([slow, speeds_of("artery", 0.671, 34.7)]))  # as far as it is printed
        self.assertIn("cannot be followed", wave([]))
        self.assertIn("cannot be followed", wave([slow, speeds_of("artery", None, 34.7)]))

    def test_accuracy(self):
        runs = [run_of(), run_of("artery"), run_of(mesh="fine")]
        errors = [MeshError(p, d, "", 0.02, 0.03) for p, d in ((0.6, 0.5), (0.7, 0.55), (0.08, 0.06))]
        found = {run.folder: error for run, error in zip(runs, errors)}
        coarse = accuracy(PaperRuns(runs[:2]), found)
        self.assertIn("by 60 to 70 % in pressure and 50 to 55 % in displacement on the coarse mesh", coarse)
        self.assertIn("reference's own error is estimated as 2 to 3 %", coarse)
        self.assertIn("not what an artery does", coarse)
        both = accuracy(PaperRuns(runs), found)
        self.assertIn("; by 8 % in pressure and 6 % in displacement on the fine mesh", both)
        self.assertNotIn("not what an artery does", both)
        found[runs[1].folder] = MeshError(None, None, "no reference for it")
        self.assertIn("Unknown for artery, coarse mesh: no reference for it", accuracy(PaperRuns(runs), found))
        self.assertIn("is unknown (no reference for it).", accuracy(PaperRuns(runs[1:2]), found))

    def test_cost(self):
        ours, rival, paper = step_cost("monolithic", 0.01), step_cost("iqn-ils", 0.03), step_cost("fixed-point", 0.2)
        line = cost([ours, rival, paper])
        self.assertIn("0.01 s with our monolithic solver", line)
        self.assertIn("0.03 s with the quickest partitioned scheme (iqn-ils, 3.0 times as long)", line)
        self.assertIn("0.2 s with its fixed point", line)
        self.assertIn("2.0 times as fast", cost([ours, step_cost("iqn-ils", 0.005)]))
        self.assertIn("which timing does not tell apart", cost([ours, step_cost("iqn-ils", 0.011)]))
        self.assertIn("(fine mesh)", cost([ours, rival, step_cost("monolithic", 1.0, "fine")]))
        self.assertNotIn("partitioned", cost([ours]))
        self.assertIn("not measured", cost([]))

    def test_failures(self):
        claims = [Claim("5", "one thing", REPRODUCED, ""), Claim("5", "another", NOT_REPRODUCED, "")]
        line = failures(claims, 15, [])
        self.assertIn("of 2 claims: 1 reproduced, 1 not reproduced. All 15 runs ended well.", line)
        self.assertTrue(line.endswith("Not reproduced: another."), line)
        self.assertIn("1 run did not end well: see Missing.", failures(claims, 15, ["a run"]))
        self.assertNotIn("Not reproduced:", failures(claims[:1], 15, []))


if __name__ == "__main__":
    unittest.main()
