"""`fsi-compare verify` with programs whose errors are known."""

import contextlib
import csv
import json
import re
import tomllib
import unittest
import unittest.mock
from pathlib import Path

import fake_family
from fake_family import A, B, SIZE, STEP, behave, calls, install
from folder_case import FolderCase

GEO = """\
DefineConstant[ size = 1.0, wall = 0.3 ];
Point(1) = {0, 0, 0, size};
"""
CASE = """\
title = "A tube"
element = "p2p1"
geometry = "plane"
[mesh]
file = "tube.msh"
[fluid]
density = 1.0
viscosity = 1.0
[time]
step = 0.5
end = 8.0
[output.points]
tip = [0, 0, 0]
"""


class VerifyCase(FolderCase):
    pictures = False  # they take longer than all else

    def setUp(self):
        super().setUp()
        self.programs = install(self.base / "bin")
        self.geo = self.base / "shape.geo"
        self.geo.write_text(GEO)
        self.case = self.base / "tube.toml"
        self.case.write_text(CASE)
        if not self.pictures:
            figure = unittest.mock.patch("fsi_compare.reporting.report.Report.figure")
            figure.start()
            self.addCleanup(figure.stop)

    def verify(self, *words, mesh=True):
        named = ["--mesh", f"geo {self.geo}"] if mesh else []
        programs = [f"--{n}={self.programs / ('fsi-' + n)}" for n in ("monolithic", "partitioned")]
        return self.call("verify", self.case, "-o", self.out, *programs, *named, *words)

    def run_case(self, case, place, *settings):
        """By hand, as one who knows nothing of the family."""
        words = [word for setting in settings for word in ("--set", setting)]
        fake_family.main([str(self.programs / "fsi-monolithic"), str(case), "-o", str(place), *words])

    def mesh_of_size(self, size):
        path = self.base / "mine.msh"
        fake_family.write_mesh(path, size)
        return path

    def rows(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def bars(self):
        return {row["quantity"]: row for row in self.csv("bars.csv")}


def bars_beside(case, run):
    """By quantity, as the report of a run has them; empty where it says that the error is unknown."""
    place = case.base / "reports" / run.name
    code, _, err = case.call("report", run, "-o", place)
    case.assertEqual(code, 0, err)
    table = place / "error_bars.csv"
    unknown = (place / "report.md").read_text().count("is unknown. `fsi-compare verify")
    case.assertEqual(unknown, 0 if table.exists() else 1)
    return {row["quantity"]: row for row in case.rows(table)} if table.exists() else {}


class Verified(unittest.TestCase):
    """One verification, looked at from all sides."""

    @classmethod
    def setUpClass(cls):
        cls.case = case = VerifyCase()
        case.pictures = True
        case.setUp()
        cls.addClassCleanup(case.doCleanups)
        cls.code, cls.text, cls.err = case.verify("--drivers", "monolithic,partitioned", "--times", "2,3")
        cls.bars, cls.members = case.bars(), case.csv("members.csv")

    def test_bars_hold_the_errors_and_their_orders_are_observed(self):
        self.assertEqual(self.code, 0, self.err)
        row = self.bars["tip: displacement x, at the end"]
        self.assertEqual(row["verdict"], "converges as its elements do")
        self.assertAlmostEqual(float(row["order_mesh"]), 3, delta=0.05)
        self.assertAlmostEqual(float(row["order_step"]), 2, delta=0.05)
        value = abs(float(row["value"]))
        self.assertTrue(A * value * 0.9 <= float(row["error_mesh"]) <= 2.1 * A * value)
        self.assertTrue(B * value * 0.9 <= float(row["error_step"]) <= 2.1 * B * value)
        pressure = self.bars["tip: pressure, at the end"]
        self.assertTrue(10 <= float(pressure["error"]) <= 20.1)
        self.assertAlmostEqual(float(pressure["estimate_of_exact"]), 100, delta=0.1)
        self.assertIn("tip: displacement x, largest", self.text)

    def test_has_the_members_that_are_promised(self):
        members = {(round(float(r["mesh"]), 3), float(r["step"])) for r in self.members}
        self.assertEqual(members, {(1.5, 1), (1, 1), (0.667, 1), (1, 2), (1, 0.5), (0.667, 0.5)})
        self.assertEqual(sum(r["member"] == "looser" for r in self.members), 2)
        self.assertEqual({row["driver"] for row in self.case.csv("bars.csv")}, {"monolithic", "partitioned"})

    def test_solver_has_a_part_where_its_tolerance_shows(self):
        rows = {row["driver"]: row for row in self.case.csv("bars.csv") if "x, largest" in row["quantity"]}
        solver = 3 * 1e-3 * 27e-3 / 9  # three times what the tolerance of the case leaves
        for driver in ("monolithic", "partitioned"):  # both stop by Newton's, for the case names no scheme
            self.assertAlmostEqual(float(rows[driver]["error_solver"]), solver, delta=0.01 * solver)

    def test_times_that_are_asked_for(self):
        self.assertIn("tip: displacement x, at 2 ms", self.bars)

    def test_writes_all_forms(self):
        page = (self.case.out / "report.html").read_text()
        self.assertIn("tip: displacement x", page)
        self.assertTrue((self.case.out / "waves_1.svg").exists())
        data = json.loads((self.case.out / "verification.json").read_text())
        self.assertEqual([one["driver"] for one in data["sets"]], ["monolithic", "partitioned"])
        self.assertEqual({one["run"]["mesh_hash"] for one in data["sets"]}, {"1"})
        self.assertEqual(sum(len(one["quantities"]) for one in data["sets"]), len(self.case.csv("bars.csv")))

    def test_goes_on_where_it_stopped(self):
        first = len(calls(self.case.programs))
        lost = next(self.case.out.glob("runs/tube-monolithic-*"))
        (lost / "study_run.json").unlink()  # as a call that was killed leaves it
        self.case.verify("--drivers", "monolithic,partitioned", "--of", "displacement")
        self.assertTrue(all("displacement" in name for name in self.case.bars()))
        again = [line for line in calls(self.case.programs)[first:] if "fsi-monolithic" in line]
        self.assertEqual(len(again), 1, again)
        self.assertFalse(any("fsi-mesh" in line for line in calls(self.case.programs)[first:]))

    def test_name_that_no_quantity_has(self):
        code, _, err = self.case.verify("--drivers", "monolithic,partitioned", "--of", "vorticity")
        self.assertEqual(code, 1)
        self.assertIn("--of vorticity", err)

    def test_bars_stand_beside_the_run_in_its_report(self):
        runs = {r["member"]: self.case.out / "runs" / r["folder"] for r in self.members if r["driver"] == "monolithic"}
        code, _, err = self.case.call("report", runs["own"], runs["step 2"], "-o", self.case.base / "report")
        self.assertEqual(code, 0, err)
        text = (self.case.base / "report" / "report.md").read_text()
        self.assertIn("tip: displacement x, at the end", text)
        self.assertEqual(text.count("is unknown. `fsi-compare verify"), 1)

    def test_run_of_other_tolerances_has_no_bars(self):
        """Case, mesh and steps are the same."""
        runs = {r["member"]: self.case.out / "runs" / r["folder"] for r in self.members if r["driver"] == "partitioned"}
        self.assertEqual(bars_beside(self.case, runs["looser"]), {})
        self.assertNotEqual(bars_beside(self.case, runs["own"]), {})


class OtherFamilies(VerifyCase):
    def test_counts_of_cells_are_multiplied(self):
        self.geo.write_text("DefineConstant[ cells = 8 ];\nTransfinite Curve{1} = cells + 1;\n")
        code, _, err = self.verify("--list")
        self.assertEqual(code, 0, err)
        from fsi_compare.verify.geo_sizes import read_sizes

        self.assertEqual(read_sizes(self.geo).settings(2.0, {}), {"cells": 16})

    def test_mesh_file_is_refined(self):
        fake_family.write_mesh(self.base / "tube.msh", 1.0)
        code, _, err = self.verify("--coarser", mesh=False)
        self.assertEqual(code, 1)
        code, _, err = self.verify(mesh=False)
        self.assertEqual(code, 0, err)
        self.assertEqual(sorted({float(r["mesh"]) for r in self.csv("members.csv")}), [0.25, 0.5, 1])
        refined = [line.split(" refine ")[1] for line in calls(self.programs) if " refine " in line]
        self.assertEqual({line.split()[0] for line in refined}, {str(self.base / "tube.msh")})
        self.assertEqual({line.split("--times ")[1].split()[0] for line in refined}, {"1", "2"})

    def test_says_that_the_shape_is_in_no_bar_of_a_mesh_file(self):
        fake_family.write_mesh(self.base / "tube.msh", 1.0)
        said = "is in no bar"
        _, out, _ = self.verify("--of", "pressure", mesh=False)
        self.assertIn(said, out)
        self.assertEqual(
            sum(said in note for note in json.loads((self.out / "verification.json").read_text())["notes"]), 1
        )
        self.assertIn(said, (self.out / "report.html").read_text())
        _, out, _ = self.verify("--of", "pressure")
        self.assertNotIn(said, out + (self.out / "report.html").read_text())

    def test_scheme_that_the_scene_chooses_says_which_tolerance_is_looser(self):
        """Without a scheme in the case: where the wall stands in the fluid, and around a vessel."""
        for chosen, key in (("iqn-ils", "partitioned.tolerance"), (None, "newton.error_tolerance")):
            with self.subTest(chosen=chosen):
                behave(self.programs, **({"chosen": chosen} if chosen else {}))
                (self.programs / "calls.txt").unlink(missing_ok=True)
                code, _, err = self.verify("--drivers", "partitioned", "-o", self.base / str(chosen))
                self.assertEqual(code, 0, err)
                loosened = [
                    word
                    for line in calls(self.programs)
                    for word in fake_family.settings(line.split())
                    if word.endswith("tolerance")
                ]
                self.assertEqual(loosened, [key])

    def test_mesh_file_that_its_script_does_not_make(self):
        """Made by `fsi-mesh geo tube.geo --set size=0.25`, and by another version of gmsh."""
        (self.base / "tube.geo").write_text(GEO)
        for size, words in (
            (0.25, "tube.msh has 80000 nodes, the mesh that the family is built around 5000"),
            (0.98, ""),
        ):
            with self.subTest(size):
                fake_family.write_mesh(self.base / "tube.msh", size)
                code, _, err = self.verify("--of", "pressure", mesh=False)
                self.assertEqual(code, 0, err)
                self.assertIn(words, err)
                self.assertEqual('--mesh "geo tube.geo --set NAME=VALUE"' in err, bool(words), err)
                self.assertEqual(bool(words), "80000 nodes" in (self.out / "report.md").read_text())
        fake_family.write_mesh(self.base / "tube.msh", 0.25)
        _, _, err = self.verify(
            "--of", "pressure", "--mesh", f"geo {self.base / 'tube.geo'} --set size=0.25", mesh=False
        )
        self.assertNotIn("nodes", err)

    def test_case_that_names_no_mesh_in_the_working_folder(self):
        self.case.write_text(CASE.replace('[mesh]\nfile = "tube.msh"\n', ""))
        with contextlib.chdir(self.base):
            code, _, err = self.call(
                "verify", self.case.name, "-o", self.out, f"--monolithic={self.programs / 'fsi-monolithic'}"
            )
        self.assertEqual(code, 1)
        self.assertIn("tube.toml: mesh.file: there is no file", err)

    def test_members_that_end_after_other_numbers_of_periods(self):
        """time.periods ends that of longer steps a period earlier, which is told; without it nothing is."""
        opening = '[[opening]]\nsurface = "inlet"\nperiod = 2.0\n'
        self.case.write_text(CASE.replace("end = 8.0", 'end = 8.0\nperiods = "until 2%"') + opening)
        behave(self.programs, ends={"time.step=1.0": 6.0})
        code, _, err = self.verify("--times", "5,7")
        self.assertEqual(code, 0, err)
        self.assertIn("tip: displacement x, mean of the last period", self.bars())
        self.assertIn("time.periods ends a member at 6 ms, before 7 ms of --times", err)
        said = "time.periods ends members at 6 to 8 ms"
        self.assertIn(said, err)
        self.assertIn(said, (self.out / "report.md").read_text())
        behave(self.programs)
        code, _, err = self.verify("-o", self.base / "alike")
        self.assertEqual(code, 0, err)
        self.assertNotIn("time.periods", err)

    def test_list_runs_nothing(self):
        code, out, _ = self.verify("--list")
        self.assertEqual(code, 0)
        self.assertIn("monolithic: mesh 1.5", out)
        self.assertEqual(calls(self.programs), [])


class AdaptedMeshes(VerifyCase):
    """--adapt: meshes made from the runs before."""

    def adaptations(self):
        return [line.split(" adapt ")[1].split() for line in calls(self.programs) if " adapt " in line]

    def test_each_is_made_from_the_run_on_the_one_before(self):
        code, out, err = self.verify("--adapt", "--of", "displacement")
        self.assertEqual(code, 0, err)
        sizes = sorted({round(float(row["mesh"]), 3) for row in self.csv("members.csv")})
        self.assertEqual(sizes, [0.444, 0.667, 1])
        runs = {row["member"]: self.out / "runs" / row["folder"] for row in self.csv("members.csv")}
        first, second = self.adaptations()
        self.assertEqual(
            [Path(words[1]).name for words in (first, second)], [runs["own"].name, runs["mesh 0.667"].name]
        )
        self.assertEqual(Path(second[0]).name, "tube-a1.msh")
        self.assertEqual([words[words.index("--nodes") + 1] for words in (first, second)], ["11250", "25312"])
        self.assertIn(str(self.geo.resolve()), first)
        row = self.bars()["tip: displacement x, at the end"]
        self.assertEqual(row["verdict"], "converges as its elements do")
        self.assertIn("from the error indicator of the run on the one before", (self.out / "report.md").read_text())
        before = len(calls(self.programs))
        self.verify("--adapt", "--of", "displacement")  # all of it is found again
        self.assertFalse([line for line in calls(self.programs)[before:] if "-o" in line])

    def test_bare_mesh_and_counts_of_cells_are_halved(self):
        fake_family.write_mesh(self.base / "tube.msh", 1.0)
        code, _, err = self.verify("--adapt", "--of", "displacement", mesh=False)
        self.assertEqual(code, 0, err)
        self.assertNotIn("--geo", self.adaptations()[0])
        self.assertEqual(self.adaptations()[0][0], str((self.base / "tube.msh").resolve()))
        self.assertIn("cells are halved", (self.out / "report.md").read_text())
        self.assertIn("is in no bar", (self.out / "report.md").read_text())

    def test_demand_is_met_by_adapted_meshes(self):
        code, _, err = self.verify("--adapt", "--error", "0.5%", "--of", "displacement")
        self.assertEqual(code, 0, err)
        text = (self.out / "found.toml").read_text()
        self.assertIn("found.msh: fsi-mesh adapt ", text)
        self.assertNotIn("error_indicator", text)  # the case has not asked for it
        found = tomllib.loads(text)
        step, size = found["time"]["step"], fake_family.size_of(found["mesh"]["file"])
        self.assertLess(A * size**3 + B * (step / STEP) ** 2, 0.005)

    def test_mesh_that_cannot_be_adapted_leaves_what_is_there(self):
        behave(self.programs, end={" adapt ": [1, "the mesh has no room"]})
        code, _, err = self.verify("--adapt", "--of", "displacement")
        self.assertEqual(code, 2)
        self.assertIn("the mesh of size 0.667 cannot be made", err)
        self.assertIn("the run on the mesh before it is missing", err)
        self.assertIn("a third mesh is missing", self.bars()["tip: displacement x, at the end"]["advice"])

    def test_wrong_words(self):
        code, _, err = self.verify("--adapt", "--coarser")
        self.assertEqual(code, 1)
        self.assertEqual(len([line for line in err.splitlines() if "error:" in line]), 1, err)
        self.assertIn("--adapt", err)
        fake_family.install(self.base / "bin")
        (self.base / "tube.msh").write_text("no mesh")
        from fsi_compare.base.errors import InputError
        from fsi_compare.verify.adapting import nodes_of

        with self.assertRaisesRegex(InputError, "cannot be read"):
            nodes_of(self.base / "tube.msh")

    def test_meshes_that_stop_growing_give_no_bars(self):
        behave(self.programs, least=0.9)  # as Mesh.MeshSizeMin of a script
        for words in (("--adapt",), ()):
            _, out, _ = self.verify(*words, "--of", "displacement")
            for row in self.csv("bars.csv"):
                self.assertEqual((row["error"], row["verdict"][:12]), ("", "not in the r"), row)
                self.assertIn("let nothing but the script's sizes decide", row["advice"])

    def test_curves_that_adaptation_does_not_help_are_named(self):
        behave(self.programs, grows=True)
        _, _, err = self.verify("--adapt")
        self.assertIn("has not paid for tip: displacement x", err)
        self.assertNotIn("tip: pressure", err)
        self.assertIn("velocity, displacement and pressure, each alike", (self.out / "report.md").read_text())

    def members(self):
        return {(round(float(row["mesh"]), 3), float(row["step"])) for row in self.csv("members.csv")}

    def test_adaptation_stops_where_it_does_not_pay(self):
        """Displacement grows from mesh to mesh, pressure gains: the second of four adaptations is the last, and steps are halved on
        the mesh before it."""
        behave(self.programs, grows=True)
        code, _, err = self.verify("--adapt", "--levels", "5")
        self.assertEqual(code, 0, err)  # nothing is missing
        self.assertEqual(len(self.adaptations()), 2)
        self.assertEqual(self.members(), {(1, 2), (1, 1), (1, 0.5), (0.667, 1), (0.667, 0.5), (0.444, 1)})
        said = re.search(r"adaptation stops: the second one has changed displacement \((.*) %, before (.*) %\) by", err)
        changed = A * (1.5**6 - 1.5**3) / (1 + A * 1.5**6), A * (1.5**3 - 1) / (
            1 + A * 1.5**3
        )  # of y = 1 + A h^-3
        for text, share in zip(said.groups(), changed):
            self.assertEqual(text, f"{100 * share:.2g}")
        self.assertIn("adaptation stops", (self.out / "report.md").read_text())
        self.assertIn("adaptation stops", (self.out / "verification.json").read_text())
        bars = self.bars()
        self.assertEqual(bars["tip: displacement x, curve"]["error"], "")
        true = 10  # of 100 + 10 h^2 at h = 1
        self.assertTrue(true <= float(bars["tip: pressure, curve"]["error"]) <= 2.1 * true)
        before = len(calls(self.programs))
        self.verify("--adapt", "--levels", "5")  # all of it is found again
        self.assertFalse([line for line in calls(self.programs)[before:] if "-o" in line])

    def test_what_is_asked_for_says_whether_adaptation_pays(self):
        behave(self.programs, grows=True)
        code, _, err = self.verify("--adapt", "--levels", "4", "--of", "pressure")
        self.assertEqual((code, len(self.adaptations())), (0, 3), err)
        self.assertNotIn("adaptation stops", err)
        self.assertIn((0.296, 0.5), self.members())

    def test_demand_out_of_reach_of_adaptation(self):
        behave(self.programs, grows=True)
        code, out, err = self.verify("--adapt", "--error", "0.5%", "--of", "displacement")
        self.assertEqual(code, 2, err)
        self.assertEqual(len(self.adaptations()), 2)
        self.assertIn("Adaptation has stopped", out)


class DemandedError(VerifyCase):
    def test_reaches_it_and_leaves_a_case_that_runs(self):
        code, out, err = self.verify("--error", "2%", "--of", "displacement", "--drivers", "monolithic,partitioned")
        self.assertEqual(code, 0, err)
        self.assertTrue(all(float(row["error_percent"]) <= 2 for row in self.csv("bars.csv")))
        self.assertIn("fsi-partitioned with these settings", out)
        found = tomllib.loads((self.out / "found.toml").read_text())
        step, size = found["time"]["step"], fake_family.size_of(found["mesh"]["file"])
        self.assertLess(A * size**3 + B * (step / STEP) ** 2, 0.02)
        self.assertTrue(step < STEP or size < SIZE)
        family = [line for line in calls(self.programs) if "fsi-partitioned" in line]
        self.assertEqual(len(family), 1)  # the family is one driver's
        members = [tuple(round(float(row[name]), 6) for name in ("mesh", "step")) for row in self.csv("members.csv")]
        plain = [key for key, row in zip(members, self.csv("members.csv")) if "looser" not in row["member"]]
        self.assertEqual(len(plain), len(set(plain)))  # each once, whatever way has led to it
        newton = found["newton"]["error_tolerance"]  # the other driver has it, too: it stops by the same
        self.assertIn(f"newton.error_tolerance={newton}", family[0])
        self.assertNotIn("partitioned", found)
        self.assertIn(f"# found.msh: fsi-mesh geo {self.geo.resolve()}", (self.out / "found.toml").read_text())

    def test_other_scheme_keeps_its_tolerance_and_says_so(self):
        self.case.write_text(CASE + '[partitioned]\nscheme = "iqn-ils"\n')
        _, out, _ = self.verify("--error", "2%", "--of", "displacement", "--drivers", "monolithic,partitioned")
        self.assertIn("fsi-partitioned stops by partitioned.tolerance, as in the case", out)

    def test_bars_are_of_the_run_found(self):
        """The family's first centre was passed without being run: it has none."""
        self.verify("--error", "1%", "--of", "displacement")
        found = self.csv("bars.csv")
        runs = {name: self.base / name for name in ("as_it_began", "as_found")}
        begin = f"mesh.file={self.mesh_of_size(1.5 * SIZE)}", f"time.step={2 * STEP}"
        self.run_case(self.case, runs["as_it_began"], *begin)
        self.run_case(self.out / "found.toml", runs["as_found"])
        first, best = (bars_beside(self, run) for run in runs.values())
        self.assertEqual(first, {})
        self.assertEqual({row["quantity"]: row["error"] for row in found}, {n: row["error"] for n, row in best.items()})
        name = "tip: displacement x, at the end"
        last = self.rows(runs["as_found"] / "points.csv")[-1]
        self.assertAlmostEqual(float(best[name]["value"]), float(last["displacement_x_mm"]), places=12)

    def test_family_costs_less_than_its_centre(self):
        """Seconds as those of a run in two dimensions: that of the settings found and all others together."""
        self.verify("--error", "0.1%", "--of", "displacement")
        runs = [(float(row["mesh"]), float(row["step"])) for row in self.csv("members.csv")]
        cost = [mesh**-2.6 / step for mesh, step in runs]
        self.assertLess(sum(cost), 3 * max(cost))
        found = tomllib.loads((self.out / "found.toml").read_text())
        size, step = fake_family.size_of(found["mesh"]["file"]), found["time"]["step"] / STEP
        self.assertAlmostEqual(max(cost), size**-2.6 / step, delta=0.1 * max(cost))

    def test_out_of_reach_of_the_budget(self):
        """On a machine of any speed: the first family has five runs at least, of which each takes 0.3 s or more."""
        behave(self.programs, seconds=0.3)
        code, out, err = self.verify("--error", "0.0001%", "--of", "displacement", "--budget", "0.03")
        self.assertEqual(code, 2)
        self.assertIn("ut of reach", out)
        self.assertIn("of the budget are left", out)
        self.assertFalse((self.out / "found.toml").exists())

    def test_moves_come_to_an_end(self):
        code, out, err = self.verify("--error", "0.0001%", "--of", "displacement")
        self.assertEqual(code, 2)
        self.assertIn("has moved 6 times", out)
        self.assertIn("0.0001 % are not reached", out)


class Trouble(VerifyCase):
    def one_line(self, code, err, *words):
        self.assertEqual(code, 1)
        self.assertEqual(len([line for line in err.splitlines() if "error:" in line]), 1, err)
        for word in words:
            self.assertIn(word, err)

    def test_member_that_fails_leaves_the_others(self):
        behave(self.programs, end={"time.step=0.25": [2, "step 3: no convergence"]})
        code, _, err = self.verify()
        self.assertEqual(code, 2)
        row = self.bars()["tip: pressure, at the end"]
        self.assertEqual(row["verdict"], "converges as its elements do")
        bad = self.bars()["tip: displacement x, at the end"]
        self.assertTrue(bad["verdict"].startswith("not in the range"))
        self.assertEqual(bad["error"], "")
        self.assertIn("no convergence", (self.out / "report.md").read_text())

    def test_swings_get_no_bar(self):
        behave(self.programs, swing=True)
        self.verify()
        row = self.bars()["tip: displacement x, at the end"]
        self.assertNotEqual(row["verdict"], "converges as its elements do")

    def test_own_run_that_fails(self):
        behave(self.programs, end={"fsi-monolithic": [2, "step 1: no convergence"]})
        code, _, err = self.verify()
        self.one_line(code, err, "no convergence", "mend the case first")

    def test_script_without_sizes(self):
        self.geo.write_text("Point(1) = {0, 0, 0, 0.5};\n")
        code, _, err = self.verify()
        self.one_line(code, err, "DefineConstant", "no constant that says how fine")
        self.assertFalse(self.out.exists())

    def test_mesh_that_cannot_be_refined(self):
        fake_family.write_mesh(self.base / "tube.msh", 1.0)
        behave(self.programs, end={"refine": [1, "a cell would fold"]})
        code, _, err = self.verify(mesh=False)
        self.assertEqual(code, 2)
        self.assertIn("a cell would fold", err)

    def test_missing_mesh(self):
        code, _, err = self.verify(mesh=False)
        self.one_line(code, err, "mesh.file", "--mesh")

    def test_nothing_sampled(self):
        behave(self.programs, nothing=True)
        code, _, err = self.verify()
        self.one_line(code, err, "samples nothing", "output.points")

    def test_budget_that_is_too_small(self):
        code, _, err = self.verify("--budget", "0.00001")
        self.one_line(code, err, "--budget", "too short", "takes about")

    def test_budget_is_held_against_runs_that_have_been_made(self):
        """A bare mesh, whose finest member has a quarter of its size: runs of 0.2 s, of which each takes as long as any other,
        fit 12 s, which sixteen to forty times the seconds of a quarter of the size do not."""
        behave(self.programs, seconds=0.2)
        fake_family.write_mesh(self.base / "tube.msh", 1.0)
        code, out, err = self.verify("--budget", "0.2", "--of", "displacement", mesh=False)
        self.assertEqual(code, 0, err)
        self.assertEqual(min(float(row["mesh"]) for row in self.csv("members.csv")), 0.25)

    def test_wrong_words(self):
        for words, said in (
            (("--drivers", "explicit"), "no driver"),
            (("--levels", "2"), "--levels"),
            (
                ("--times", "5,50"),
                "--times: 50 ms is before the first step of the case, or after its end; give times from 0.5 to 8",
            ),
            (("--times", "0.1"), "--times: 0.1 ms is before the first step of the case"),
            (("--budget", "-1"), "--budget"),
            (("--error", "200%"), "--error"),
            (("--time-limit", "nan"), "--time-limit: nan s is no time"),
            (("--time-limit", "-1"), "--time-limit: -1 s is no time"),
            (("--mesh", f"geo {self.geo} --set size=small"), "--set size: 'small' is no number"),
            (("--mesh", "artery --lumen-cells few"), "artery --lumen-cells: 'few' is no number"),
        ):
            code, _, err = self.verify(*words)
            self.one_line(code, err, said)
        for entries, said in (
            ('mesh = "text"\n[time]\nstep = 1\n', "mesh: is no section"),
            ('[time]\nend = "late"\n', "time.end: late is no number"),
            ('[time]\nstep = "adaptive"\ntolerance = "small"\n', "time.tolerance: small is no number"),
            ("element = [1]\n[time]\nstep = 1\n", "element: '[1]' is unknown"),
            ('[mesh]\nlevel = "finest"\n[time]\nstep = 1\n', "artery --level: 'finest' is no level"),
        ):
            self.case.write_text(entries)
            code, _, err = self.verify(mesh=False)
            self.one_line(code, err, said)
        self.case.write_text("[static]\n")
        code, _, err = self.verify("--times", "5")
        self.one_line(code, err, "--times: a static case has none")
        self.case.write_text('title = "no time"\n')
        code, _, err = self.verify()
        self.one_line(code, err, "time", "is missing")


if __name__ == "__main__":
    unittest.main()
