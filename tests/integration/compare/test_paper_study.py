"""The kind `paper`: cuts, energy, phases, claims, and the whole study with drivers that answer at once."""

import json
import re
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np
from fake_drivers import behave, build_anew, calls
from folder_case import FolderCase
from study_case import StudyCase
from test_report import outside_references

from fsi_research.catalogue import paper
from fsi_compare.starting.case_digest import case_digest
from fsi_compare.base.errors import InputError
from fsi_research.evidence import energy_plots, phase_bars
from fsi_research.evidence.fields import TETRAHEDRA
from fsi_research.studies import CATALOGUE
from fsi_research.catalogue.names import MATERIALS
from fsi_research.linear.grid import Grid
from fsi_research.linear.study import Outcome, Request as LinearRequest
from fsi_research.paper import cost as paper_cost
from fsi_research.paper.claims import (
    FEWER,
    IN_PART,
    MIXED,
    MORE,
    NO_RUN,
    NOT_COMPARABLE,
    Claim,
    claims_table,
    compared,
    rules_table,
    tally,
    unexamined,
)
from fsi_research.paper.energy import remainders
from fsi_research.paper.solver_claims import observed_orders, solver_claims
from fsi_research.paper.speeds import Measured, Speeds, speed_table
from fsi_research.paper.wave_claims import wave_claims
from fsi_research.studies import FOLDER as READY
from fsi_research.evidence.plane_cut import cut
from fsi_compare.study.study_file import Method, Request, read_study
from fsi_compare.study.study_run import DONE, StudyRun
from fsi_research.evidence.tube_pictures import round_factor


class PlaneCut(unittest.TestCase):
    CUBE = np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
    # six tetrahedra around the diagonal from node 0 to node 7
    CELLS = np.array([[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]])

    @staticmethod
    def area(triangles):
        a, b = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
        return float(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2)

    def test_areas_of_cuts_through_a_cube(self):
        for normal, offset, kept, area in (
            ([0, 0, 1], 0.3, [0, 1], 1.0),
            ([1, 0, 0], 0.77, [1, 2], 1.0),
            ([1, 1, 0], 0.6, [0, 2], 0.6),
            ([1, 1, 1], 1.5, [0, 1], 0.75),
            ([0, 0, 1], 2.0, [0, 1], 0.0),
        ):
            triangles, _, owners = cut(self.CELLS, self.CUBE @ np.array(normal, float) - offset, self.CUBE[:, kept])
            self.assertAlmostEqual(self.area(triangles), area, 12, normal)
            self.assertEqual(len(triangles), len(owners))

    def test_linear_values_are_carried_along(self):
        field = self.CUBE @ np.array([2.0, -1, 3]) + 0.5
        triangles, _, _ = cut(self.CELLS, self.CUBE[:, 2] - 0.4, np.column_stack((self.CUBE, field)))
        np.testing.assert_allclose(triangles[:, :, 2], 0.4, atol=1e-14)
        np.testing.assert_allclose(triangles[:, :, :3] @ [2.0, -1, 3] + 0.5, triangles[:, :, 3], atol=1e-13)

    def test_a_plane_through_nodes(self):
        triangles, _, _ = cut(self.CELLS, self.CUBE[:, 2] - 0.0, self.CUBE[:, :2])
        self.assertTrue(np.isfinite(triangles).all())

    def test_quadratic_cells_are_cut_into_linear_ones(self):
        corners = np.array([[0, 0, 0], [2, 0, 0], [0.3, 1.5, 0], [0.1, 0.2, 1.0]])
        edges = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
        nodes = np.vstack((corners, [corners[list(edge)].mean(axis=0) for edge in edges]))
        parts = nodes[TETRAHEDRA]
        volumes = np.abs(np.linalg.det(parts[:, 1:] - parts[:, :1])) / 6
        np.testing.assert_allclose(volumes, np.linalg.det(corners[1:] - corners[0]) / 6 / 8, rtol=1e-12)

    def test_magnification(self):
        for displacement, factor in (
            (0.045, 10),
            (0.5, 1),
            (0.026, 10),
            (0.0249, 20),
            (3.0, 1),
            (0.0, 1),
            (1e-4, 5000),
        ):
            self.assertEqual(round_factor(displacement), factor)


def run_in(folder, program="fsi-monolithic", group="waves", case="neo-hookean", method="monolithic", **values):
    request = Request(group, case, Method(method, method, program, {}), values, Path("none.toml"), None, {}, 60)
    return StudyRun(request, folder, DONE, "", 1.0, "")


class Energy(FolderCase):
    def test_none_without_the_file(self):
        self.assertIsNone(energy_plots.balance(run_in(self.base)))

    def test_sums_and_signs(self):
        (self.base / "energy.csv").write_text(
            "step,time_ms,fluid_kinetic_energy_uJ,wall_kinetic_energy_uJ,wall_isochoric_energy_uJ,"
            "wall_volumetric_energy_uJ,"
            "inlet_work_uJ,inlet_kinetic_inflow_uJ,outlet_kinetic_outflow_uJ,viscous_dissipation_uJ,"
            "numerical_dissipation_uJ,remainder_uJ\n"
            "1,0.125,4,1,2,0.5,10,1,0.5,1,2,0\n2,0.25,3,1,2,0.5,0,0,0.5,0.25,0.25,-0.001\n"
        )
        found = energy_plots.balance(run_in(self.base))
        self.assertEqual(found.parts["supplied"].tolist(), [10.5, 10.0])
        self.assertEqual(found.parts["elastic"].tolist(), [2.5, 2.5])
        self.assertEqual(found.parts["lost by discretisation"].tolist(), [2.0, 2.25])
        self.assertAlmostEqual(found.largest_remainder, 0.001 / 10.5)
        table = energy_plots.energy_table([found], ["a run"])
        self.assertEqual(table.rows[0][:3], ["a run", "10", "30.00"])

    def test_the_worst_of_each_group(self):
        def one(left_over):
            return energy_plots.Balance(
                np.array([1.0]), {"supplied": np.array([2.0]), energy_plots.REMAINDER: np.array([left_over])}
            )

        pairs = [
            (run_in(self.base), one(2e-9)),
            (run_in(self.base), one(-4e-9)),
            (run_in(self.base, case="artery"), one(2e-6)),
            (run_in(self.base, "fsi-partitioned", "stopped-early"), one(0.2)),
        ]
        self.assertEqual(
            [(r.group, r.approach, r.wall, r.runs, r.worst) for r in remainders(pairs)],
            [
                ("waves", "monolithic", "without fibres", 2, 2e-9),
                ("waves", "monolithic", "with fibres", 1, 1e-6),
                ("stopped-early", "partitioned", "without fibres", 1, 0.1),
            ],
        )


class Phases(FolderCase):
    def test_parts_make_up_the_whole(self):
        phases = {
            "assembly: fluid residual": 1.0,
            "assembly: interface balance": 0.5,
            "factorisation: fluid": 0.25,
            "set-up: wall": 0.5,
            "solve: wall": 2.0,
            "output": 0.125,
            "energy balance": 0.125,
            "something new": 0.25,
        }
        (self.base / "summary.json").write_text(
            json.dumps(
                {
                    "phases": {name: {"calls": 1, "seconds": s} for name, s in phases.items()},
                    "totals": {"steps": 2, "wall_s": 6.0},
                }
            )
        )
        (self.base / "coupling.csv").write_text("step,coupling_s\n1,0.125\n2,0.125\n")
        parts = phase_bars.phase_seconds(run_in(self.base, "fsi-partitioned"))
        self.assertEqual(
            parts, {"assembly": 1.0, "set-up": 0.75, "solve": 2.0, "coupling": 0.75, "output": 0.25, "other": 1.25}
        )
        self.assertEqual(sum(parts.values()), 6.0)
        table = phase_bars.phase_table([run_in(self.base)], ["a run"])
        self.assertEqual(table.rows[0], ["a run", "500", "375", "1000", "375", "125", "625", "3000"])


class Verdicts(unittest.TestCase):
    def test_the_tally_follows_from_the_table(self):
        found = [
            Claim("5", "a", IN_PART, ""),
            Claim("5", "b", IN_PART, ""),
            Claim("5", "c", NOT_COMPARABLE, ""),
            unexamined("5", "d", "a rule"),
            Claim("5", "e", FEWER, ""),
        ]
        self.assertEqual(tally(found), "Of 4 claims: 2 in part, 1 not comparable, 1 no run for it.")
        self.assertEqual(
            [row[2] for row in claims_table(found).rows], [IN_PART, IN_PART, NOT_COMPARABLE, NO_RUN, FEWER]
        )
        self.assertEqual(rules_table(found).rows, [["5", "d", "a rule"]])

    def test_comparisons(self):
        self.assertEqual([compared(3, 0), compared(0, 0), compared(0, 2), compared(3, 2)], [FEWER, FEWER, MORE, MIXED])

    def test_order_of_newtons_increments(self):
        np.testing.assert_allclose(observed_orders([1.0, 1e-1, 1e-2, 1e-4, 1e-8]), [1.0, 2.0, 2.0])
        np.testing.assert_allclose(observed_orders([1.0, 1e-1, 1e-2, 1e-15]), [1.0])  # the last one is round-off
        # what follows round-off is round-off too
        np.testing.assert_allclose(observed_orders([1.0, 1e-1, 1e-2, 1e-15, 1e-13]), [1.0])
        self.assertEqual(observed_orders([1.0, 1e-5]), [])
        self.assertEqual(observed_orders([]), [])
        self.assertEqual(observed_orders([1.0, 2.0, 0.5]), [])  # not converging yet
        self.assertLess(observed_orders([1.0, 0.1, 0.2])[-1], 0)  # not any more
        # the coarse mesh's: the fourth is above round-off, and shows the order
        first, last = observed_orders([2.2, 1.7e-2, 6.4e-6, 4.9e-13])
        self.assertAlmostEqual(first, 1.62, 2)
        self.assertAlmostEqual(last, 2.08, 2)

    def newton_claim(self, **increments):
        """Of a grid whose coarse mesh has these increments by material, _ for -."""
        steps = {name.replace("_", "-"): [SimpleNamespace(step=1, increments=e)] for name, e in increments.items()}
        outcomes = [
            Outcome(
                LinearRequest(material, Path(), material, "coarse", (), (), ((1, 1),), 1e-9, 1),
                SimpleNamespace(newton=newton, systems={(1, 1): None}, mesh={}),
            )
            for material, newton in steps.items()
        ]
        return next(c for c in solver_claims(Grid(outcomes), None, {}) if "quadratically" in c.claim)

    def test_newton_is_judged_by_the_last_order_above_round_off(self):
        quadratic = [2.2, 1.7e-2, 6.4e-6, 4.9e-13]
        claim = self.newton_claim(neo_hookean=quadratic)
        self.assertEqual(claim.verdict, "reproduced")
        self.assertIn("observed order 2.08, at least 1.8 in 1 of 1 cells; 4 iterations", claim.ours)
        for text in (claim.why, claim.rule):  # the rule stands beside the claim too
            self.assertIn("ln(e3/e2) / ln(e2/e1) of the last three increments above 2e-14 of the first", text)
        linear = [2.2, 2.2e-2, 2.2e-4, 2.2e-6]
        claim = self.newton_claim(neo_hookean=quadratic, mooney_rivlin=linear)
        self.assertEqual(claim.verdict, "in part")
        self.assertIn("below it: Mooney-Rivlin C 1.00", claim.why)
        self.assertNotIn("fibres", claim.why)
        # quadratic at first and linear in the end is not quadratic
        stalled = [2.2, 1.7e-2, 6.4e-6, 4.9e-10, 4e-13]
        self.assertEqual(self.newton_claim(neo_hookean=stalled).verdict, "not reproduced")


class Levels(unittest.TestCase):
    """Wave speeds on levels of resolution, and what their errors make of a claim."""

    @staticmethod
    def wall(material, *levels):
        found, before = {}, None
        for name, speed in zip(("coarse", "intermediate", "fine, 0.05"), levels):
            found[name] = Measured(
                name, speed, 10 * speed, before and abs(speed - before), before and 10 * abs(speed - before)
            )
            before = speed
        return Speeds(material, "", 1.0, 1.2, 1.1, 0.9, found)

    def verdicts(self, neo_hookean, mooney_rivlin, artery):
        walls = [self.wall(name, *levels) for name, levels in zip(MATERIALS, (neo_hookean, mooney_rivlin, artery))]
        return [claim.verdict for claim in wave_claims([], [], walls)][3:]

    def test_within_the_errors_is_in_part(self):
        self.assertEqual(self.verdicts((0.7, 0.71), (0.7, 0.72), (0.5, 0.51)), ["reproduced"] * 3)
        self.assertEqual(self.verdicts((0.7, 0.71), (0.7, 0.72), (0.6, 0.7)), ["reproduced", "in part", "in part"])
        self.assertEqual(
            self.verdicts((0.6, 0.62), (0.7, 0.9), (1.0, 1.0)), ["not reproduced", "not reproduced", "not reproduced"]
        )
        # on the finest level that all have
        self.assertEqual(self.verdicts((0.7, 0.71, 0.1), (0.7, 0.72, 9.0), (0.5, 0.51)), ["reproduced"] * 3)
        self.assertEqual(self.verdicts((), (0.7, 0.72), (1.0,)), [NO_RUN] * 3)

    def test_table(self):
        table = speed_table(
            [self.wall("artery", 0.87, 0.82, 1.0), self.wall("neo-hookean", 0.67, 0.63)],
            ["coarse", "intermediate", "fine, 0.05"],
        )
        self.assertEqual(table.rows[0][5:9], ["0.870", "0.820", "1.000", "0.180"])
        self.assertEqual(table.rows[1][5:9], ["0.670", "0.630", "-", "0.040"])
        self.assertIn("Error: estimated by the difference of the two finest levels", table.notes[-1])

    def test_one_level_has_no_error(self):
        table = speed_table([self.wall("artery", 0.87)], ["coarse"])
        self.assertEqual(table.rows[0][5:], ["0.870", "8.7"])
        self.assertNotIn("error", [name for _, name in table.heads])
        self.assertEqual(len(table.heads), len(table.rows[0]))
        self.assertNotIn("Error: estimated", " ".join(table.notes))


class PaperNumbers(unittest.TestCase):
    def test_rounds_of_the_paper(self):
        own = paper_cost.paper_rounds()
        self.assertEqual((own["monolithic"], own["partitioned"], own["cycles"]), (40, 52.5 * 4.5, 360))
        self.assertAlmostEqual(own["saving"], 0.83, 2)
        self.assertAlmostEqual(own["cycles_per_system"], 3.05, 2)

    def test_parameters(self):
        self.assertEqual(paper.parameters("artery")["alpha"], [29, 62])
        self.assertEqual(paper.mesh_counts("fine")["tetrahedra"], 308736)


class Checks(FolderCase):
    def refused(self, old, new, *expected):
        text = (READY / "paper.toml").read_text().replace("../../../meshes", str(READY.parents[2] / "meshes"))
        self.assertIn(old, text)
        path = self.base / "paper.toml"
        path.write_text(text.replace(old, new))
        with self.assertRaises(InputError) as caught:
            study = read_study(path, CATALOGUE.kinds)
            CATALOGUE.kind(study.kind).check(study)
        for part in expected:
            self.assertIn(part, str(caught.exception))

    def test_refusals(self):
        self.refused("[runs.newton]", "[runs.newtn]", "runs.newtn", "did you mean 'newton'?")
        self.refused("[runs.waves]", "[runs.cost2]", "runs.cost2")
        self.refused("[report.linear]", "[report.linar]", "report.linar", "did you mean 'linear'?")
        self.refused('"amli_fgmres"', '"amli_fgmre"', "report.linear.methods", "did you mean 'amli_fgmres'?")
        self.refused(
            'later_meshes = ["coarse"',
            'later_meshes = ["corse"',
            "report.linear.later_meshes",
            "did you mean 'coarse'?",
        )
        for jobs in ("0", "true", '"two"'):
            self.refused("jobs = 2 ", f"jobs = {jobs} ", "report.linear.jobs", "give 1 or more")
        self.refused("neo-hookean =", "neohookean =", "runs.cost", "'neo-hookean' is unknown")
        self.refused("[methods.monolithic]", "[methods.mono]", "runs.waves")


class CaseDigest(FolderCase):
    def digest(self, text, program="fsi-monolithic"):
        path = self.base / "case.toml"
        path.write_text(text)
        return case_digest(path, program)

    def test_only_what_decides_counts(self):
        text = 'title = "A"\n[monolithic]\nmode = "kept"\n[partitioned]\nscheme = "aitken"\n'
        same = self.digest(text)
        self.assertEqual(self.digest("# a comment\n" + text), same)
        self.assertEqual(self.digest(text.replace("aitken", "iqn-ils")), same)
        self.assertNotEqual(self.digest(text.replace("kept", "full")), same)
        other = self.digest(text.replace("aitken", "iqn-ils"), "fsi-partitioned")
        self.assertNotEqual(other, self.digest(text, "fsi-partitioned"))
        self.assertNotEqual(self.digest("no TOML"), self.digest("none either"))


class WholeStudy(StudyCase):
    """With drivers whose waves are all the same, and linear solvers whose counts are the paper's."""

    def setUp(self):
        super().setUp()
        text = (READY / "paper.toml").read_text().replace("../../../meshes", str(READY.parents[2] / "meshes"))
        self.study.write_text(text)

    def claims(self):
        return {row["claim"]: row for row in self.csv("claims.csv")}

    def verdict(self, word):
        return next(row["verdict"] for claim, row in self.claims().items() if word in claim)

    def test_quick_form(self):
        code, _, err = self.call("--quick")
        self.assertEqual(code, 0, err)
        page = (self.out / "report.html").read_text()
        self.assertEqual(outside_references(page), [])
        for name in (
            "claims",
            "table1_parameters",
            "table2_meshes",
            "table3_newton",
            "table4_block_preconditioners_step1_newton1",
            "table5_multilevel_step1_newton1",
            "agreement",
            "stopped_early",
            "wave_speed",
            "cost_statement",
            "cost_saving",
            "phases_coarse",
        ):
            self.assertTrue((self.out / f"{name}.csv").is_file(), name)
        for name in (
            "pressure_neo-hookean",
            "pressure_mooney-rivlin",
            "pressure_artery",
            "pressure_materials",
            "stopped_early",
            "wave_speed",
            "phases_coarse",
        ):
            self.assertTrue((self.out / f"{name}.png").is_file() and (self.out / f"{name}.svg").is_file(), name)
        self.assertIn("The runs hold no <code>energy.csv</code>", page)
        headings = re.findall(r"<h2[^>]*>([^<]*)</h2>", page)
        self.assertEqual(headings[:3], ["The answer", "The waves", "Claims"])
        self.assertEqual(headings[-2:], ["Rules", "About this report"])
        self.assertEqual(re.search(r'<ol class="answer">(.*?)</ol>', page).group(1).count("<li>"), 5)
        self.assertLess(page.index("<caption>The paper's claims, one by one"), page.index("<details>"))
        self.assertLess(page.index("<details>"), page.index("<caption>What each verdict asks for"))
        self.assertLess(page.index("<caption>What each verdict asks for"), page.index("</details>"))
        self.assertIn("find the same wave", page)
        self.assertIn("The curves lie on each other: the largest difference is 0.0e+00 of", page)
        # no caption of what is not there: one level has no error bars, one material's density is not tried
        self.assertNotIn("their bars", page)
        self.assertNotIn("the printed value is tried", page)
        self.assertNotIn("Deformed wall and velocity", page)
        self.assertEqual(self.verdict("conform very well"), "reproduced")
        self.assertEqual(self.verdict("smaller magnitude than the monolithic one"), "not reproduced")
        self.assertEqual(self.verdict("artery's wave is slower"), "not reproduced")
        self.assertEqual(self.verdict("diagonal preconditioner"), "reproduced")
        self.assertEqual(self.verdict("increase when the mesh is refined"), "no run for it")
        self.assertIn("The linear systems were solved 2 at once", page)
        made = len(calls(self.programs))
        with mock.patch("fsi_compare.reporting.pictures.Figure.savefig"):  # the second time about the runs alone
            code, _, err = self.call("--quick", "-q")
        self.assertEqual((code, len(calls(self.programs))), (0, made), err)

    def test_fresh_leaves_the_linear_systems(self):
        def call(*words):
            with mock.patch("fsi_compare.reporting.pictures.Figure.savefig"), mock.patch(
                "fsi_compare.reporting.report.Report.image"
            ):
                return self.call("--quick", *words)

        call()
        linear = len(list(self.out.glob("linear/runs/*/request.json")))
        made = len(calls(self.programs))
        self.assertGreater(linear, 0)
        build_anew(self.programs, "fsi-linear-study")
        code, _, err = call("--fresh")
        self.assertEqual((code, len(calls(self.programs))), (0, 2 * made - linear), err)
        self.assertIn(
            f"warning: {linear} of {linear} runs of linear systems were made by another build of "
            "fsi-linear-study 0.1.0: removing `linear/runs` makes them again\n",
            err,
        )
        self.assertNotIn("finished runs", err)

    def test_a_missing_run_is_told_and_its_claims_are_left_open(self):
        behave(self.programs, end={"fibre_scale": [2, "no convergence"], "scheme=aitken": [2, "no convergence either"]})
        with mock.patch("fsi_compare.reporting.pictures.Figure.savefig"), mock.patch(
            "fsi_compare.reporting.report.Report.image"
        ):
            code, _, err = self.call("--quick", "-q")
        self.assertEqual(code, 2, err)
        page = (self.out / "report.html").read_text()
        self.assertIn("not converged: no convergence either", page)
        self.assertEqual(self.verdict("fixed-point iterations a step"), "no run for it")

    def test_full_form(self):
        with mock.patch("fsi_compare.reporting.pictures.Figure.savefig"), mock.patch(
            "fsi_compare.reporting.report.Report.image"
        ) as image:
            code, _, err = self.call("-q")
        self.assertEqual(code, 0, err)
        verdicts = {row["verdict"] for row in self.claims().values()}
        self.assertNotIn("no run for it", verdicts)
        self.assertEqual(self.verdict("increase when the mesh is refined"), "reproduced")
        # one cell of Mooney-Rivlin's: 12 where the paper has 11
        self.assertEqual(self.verdict("Table 5, iterations"), "fewer and more")
        self.assertEqual(self.verdict("similarly for all Newton iterations"), "reproduced")
        self.assertEqual(self.verdict("very similar range"), "reproduced")
        self.assertEqual(self.verdict("more robust than the partitioned"), "not reproduced")
        page = (self.out / "report.html").read_text()
        examined = [row for row in self.claims().values() if "Table" not in row["claim"].split(",")[0]]
        self.assertIn(f"Of {len(examined)} claims: ", page)
        self.assertTrue(all(row["rule"] for row in examined))
        captions = " ".join(call.args[1] for call in image.call_args_list)
        self.assertIn("their bars are the difference of the two finest levels", captions)
        self.assertIn("Error of mesh and step: unknown (wall_displacement.csv is missing or incomplete).", captions)
        self.assertIn("the printed value is tried above", page)
        self.assertIn("fine, 0.05", {row["level"] for row in self.csv("wave_speed.csv")})
        meshes = [row["mesh"] for row in self.csv("table2_meshes.csv")]
        self.assertEqual(meshes[::3], ["coarse", "intermediate", "fine"])
        self.assertIn("fibres times 0.5", {row["reading"] for row in self.csv("wave_speed.csv")})
        self.assertIn("wall density 1.2 kg/m^3", {row["reading"] for row in self.csv("wave_speed.csv")})

    def test_the_list_names_the_linear_systems_too(self):
        code, out, _ = self.call("--list")
        self.assertEqual(code, 0)
        self.assertIn("linear systems: artery, fine: diagonal, lower,", out)
        self.assertIn("linear systems: artery, coarse, later ones: diagonal, lower,", out)
        self.assertIn("resolved: artery, monolithic, mesh fine", out)
        self.assertNotIn("fine", self.call("--list", "--quick")[1])


if __name__ == "__main__":
    unittest.main()
