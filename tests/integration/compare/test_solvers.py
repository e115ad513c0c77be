"""`fsi-compare solvers` against a program whose numbers are known."""

import os
import re
import shutil
import subprocess
import sys
import time
import unittest
from unittest import mock

from fake_linear_study import behave, calls, install
from folder_case import FolderCase
from synthetic import COMPARE

from fsi_research.catalogue import paper
from fsi_research.catalogue.names import BLOCK_PRECONDITIONERS, MATERIALS, METHODS, MULTILEVEL
from fsi_compare.study.mesh_levels import MESHES
from fsi_research.linear.command import CASES

SMALL = ("--materials", "neo-hookean", "--meshes", "coarse", "--methods", "amg,amg_fgmres,direct", "--systems", "1:1")


class StudyTest(FolderCase):
    draw = False  # pictures take seconds

    def setUp(self):
        if not self.draw:
            patch = mock.patch("fsi_research.linear.solver_pictures.write_solver_pictures", return_value=[])
            patch.start()
            self.addCleanup(patch.stop)
        super().setUp()
        self.program = install(self.base)
        self.cases = self.base / "cases"
        self.cases.mkdir()
        for material in MATERIALS:
            (self.cases / f"{material}.toml").write_text(f'title = "{material}"\n')

    def call(self, *arguments, own_program=True):
        words = ["solvers", "-o", self.out, "--case-dir", self.cases, *arguments]
        if own_program:
            words += ["--program", self.program]
        return super().call(*words)

    def line(self, text, *starts):
        """Words of the first line that begins with the given words."""
        return next(words for words in map(str.split, text.splitlines()) if words[: len(starts)] == list(starts))


class PaperNumbers(unittest.TestCase):
    def test_complete(self):
        for material in MATERIALS:
            for mesh in MESHES:
                self.assertEqual(len(paper.newton_increments(material, mesh)), 4)
                for method in (*BLOCK_PRECONDITIONERS, *MULTILEVEL):
                    self.assertGreater(paper.iterations(method, material, mesh), 0)

    def test_some_by_hand(self):
        self.assertEqual(paper.iterations("diagonal", "mooney-rivlin", "fine"), 227)
        self.assertEqual(paper.iterations("amg_fgmres", "mooney-rivlin", "fine"), 9)
        self.assertEqual(paper.iterations("ilu", "artery", "intermediate"), 48)
        self.assertEqual(paper.newton_increments("artery", "fine"), [69, 0.07, 1.2e-5, 4e-9])
        self.assertIsNone(paper.iterations("fast", "artery", "coarse"))

    def test_artery_at_rest_is_held_to_neo_hookean(self):
        self.assertEqual(paper.limit("lower", "artery", "coarse", at_rest=True), 28)
        self.assertEqual(paper.limit("lower", "artery", "coarse", at_rest=False), 25)
        self.assertEqual(paper.limit("lower", "mooney-rivlin", "coarse", at_rest=True), 29)


class WithPictures(StudyTest):
    draw = True

    def test_legend_covers_no_panel(self):
        from fsi_research.linear.solver_pictures import cost_figure, iterations_figure

        with mock.patch(
            "fsi_research.linear.solver_pictures.write_solver_pictures",
            side_effect=lambda folder, grid: grids.append(grid) or [],
        ):
            for arguments in (SMALL, ("--systems", "1:1")):
                grids = []
                self.assertEqual(self.call(*arguments)[0], 0)
                for figure in (iterations_figure(grids[0], (1, 1)), cost_figure(grids[0], (1, 1))):
                    figure.canvas.draw()
                    renderer = figure.canvas.get_renderer()
                    legend = figure.legends[0].get_window_extent(renderer)
                    self.assertGreaterEqual(legend.x0, 0)
                    self.assertLessEqual(legend.x1, figure.bbox.x1)
                    for axes in figure.axes:
                        if axes.get_visible():
                            self.assertFalse(legend.overlaps(axes.get_tightbbox(renderer)))

    def test_same_bytes_and_no_run_twice(self):
        self.call(*SMALL)
        first = {path.name: path.read_bytes() for path in self.out.glob("*.*")}
        self.assertEqual(
            sorted(name for name in first if name.endswith(("png", "svg"))),
            [
                "cost_step1_newton1.png",
                "cost_step1_newton1.svg",
                "iterations_step1_newton1.png",
                "iterations_step1_newton1.svg",
            ],
        )
        self.call(*SMALL)
        self.assertEqual(first, {path.name: path.read_bytes() for path in self.out.glob("*.*")})
        self.assertEqual(len(calls(self.program)), 1)

    def test_nothing_to_draw(self):
        behave(self.program, end={"neo-hookean coarse": [2, "Newton's method stalls"]})
        code, _, err = self.call(*SMALL)
        self.assertEqual(code, 2, err)
        self.assertEqual([path.suffix for path in self.out.iterdir() if path.suffix in (".png", ".svg")], [])

    def test_names_differ_in_grey(self):
        from fsi_research.linear.solver_pictures import MATERIAL_LINES, MESH_MARKS

        for lines in (MATERIAL_LINES, MESH_MARKS):
            self.assertEqual(len({line["marker"] for line in lines.values()}), len(lines))


class Tables(StudyTest):
    def test_all_of_the_paper(self):
        behave(
            self.program,
            iterations=[
                ["neo-hookean", "fine", "1:1", "amg", 13],
                ["artery", "coarse", "1:1", "lower", 28],
                ["neo-hookean", "coarse", "1:1", "upper", 30],
                ["neo-hookean", "coarse", "1:1", "upper_exact", 20],
            ],
        )
        code, out, err = self.call()
        self.assertEqual(code, 0, err)
        self.assertEqual(len(calls(self.program)), 9)
        for part in (
            "Table 3",
            "Table 4: iterations of GMRES with block preconditioners, Newton system 1 of step 1 (t = 0.125 ms)",
            "Newton system 2 of step 12 (t = 1.5 ms)",
            "Cost of the methods",
        ):
            self.assertIn(part, out)
        self.assertEqual(
            self.line(out, "neo-Hookean", "1"),
            ["neo-Hookean", "1", "2.2e+00", "6.2e+01", "2.2e+00", "6.8e+01", "2.2e+00", "6.9e+01"],
        )
        # material, method, then ours, exact, ratio, paper's for each mesh
        self.assertEqual(self.line(out, "P_U")[:5], ["P_U", "30*", "20", "1.50!", "28"])
        self.assertEqual(self.line(out, "AMG")[:7], ["AMG", "7", "(7)", "8", "(8)", "13*", "(12)"])
        self.assertIn(
            "more than 3 iterations above the coarse mesh on the fine one: AMG neo-Hookean (6), AMG Mooney-Rivlin", out
        )
        self.assertIn("At rest the fibres do nothing", out)

        rows = {
            (r["material"], r["mesh"], r["method"]): r
            for r in self.csv("table4_block_preconditioners_step1_newton1.csv")
        }
        self.assertEqual(len(rows), 45)
        artery = rows["artery", "coarse", "lower"]  # 25 in the paper's own column
        self.assertEqual(
            (artery["paper_iterations"], artery["limit_iterations"], artery["above_limit"]), ("25", "28", "no")
        )
        later = {
            (r["material"], r["mesh"], r["method"]): r
            for r in self.csv("table4_block_preconditioners_step12_newton2.csv")
        }["artery", "coarse", "lower"]
        self.assertEqual((later["limit_iterations"], later["above_limit"], later["time_ms"]), ("25", "yes", "1.5"))
        upper = rows["neo-hookean", "coarse", "upper"]
        self.assertEqual((upper["iterations"], upper["exact_iterations"], upper["ratio_to_exact"]), ("30", "20", "1.5"))
        self.assertEqual(len(self.csv("table5_multilevel_step1_newton1.csv")), 54)
        newton = self.csv("table3_newton.csv")
        self.assertEqual(len(newton), 36)
        self.assertEqual((newton[0]["increment"], newton[0]["paper_increment"]), ("2.2", "62.0"))

        markdown = (self.out / "solvers.md").read_text()
        self.assertIn("| method | neo-Hookean: C |", markdown)
        self.assertIn(r"13\* (12)", markdown)
        for table in re.findall(r"(?:^\|.*\n)+", markdown, re.MULTILINE):
            self.assertEqual(len({re.sub(r"\\\|", "", line).count("|") for line in table.splitlines()}), 1)

    def test_another_tolerance_is_said(self):
        _, out, _ = self.call(*SMALL, "--tolerance", "1e-6")
        self.assertIn("Solved to 1e-06, in the paper to 1e-09.", out)

    def test_costs_have_units(self):
        self.call(*SMALL)
        rows = self.csv("cost_step1_newton1.csv")
        self.assertEqual([row["method"] for row in rows], ["direct", "amg", "amg_fgmres"])
        amg = rows[1]
        self.assertEqual(
            [amg[name] for name in ("iterations", "set_up_seconds", "wall_cycles", "memory_MiB", "unknowns")],
            ["7", "0.125", "14", "12.5", "4662"],
        )
        self.assertAlmostEqual(float(amg["solve_seconds"]), 4662e-6 * 7)
        self.assertAlmostEqual(float(amg["work_units"]), 4662e-3 * 7)
        self.assertEqual((rows[0]["operator_complexity"], rows[0]["difference_to_direct"]), ("", ""))

    def test_without_a_direct_solve_nothing_is_compared_with_it(self):
        words = ("--materials", "neo-hookean", "--meshes", "coarse", "--systems", "1:1")
        with_direct, without = (self.call(*words, "--methods", m)[1] for m in ("amg,direct", "amg"))
        for text in ("to direct", "relative difference to the direct solver's solution above 1e-07: none"):
            self.assertIn(text, with_direct)
            self.assertNotIn(text, without)

    def test_order_of_the_preconditioners(self):
        blocks = (
            "--materials",
            "neo-hookean",
            "--meshes",
            "coarse",
            "--systems",
            "1:1",
            "--methods",
            "diagonal,lower,ssor",
        )
        _, out, _ = self.call(*blocks)
        self.assertIn("order of the preconditioners as in the paper: yes", out)
        behave(self.program, version="0.2.0", iterations=[["neo-hookean", "coarse", "1:1", "lower", 20]])
        _, out, _ = self.call(*blocks)
        self.assertIn("order of the preconditioners as in the paper: no: P_L 20 < P_SSOR 27 (neo-Hookean C)", out)

    def test_sub_problems(self):
        _, out, _ = self.call(*SMALL, "--sub-problems")
        self.assertIn("AMG of the sub-problems alone", out)
        rows = self.csv("sub_problems.csv")
        self.assertEqual(
            [(r["problem"], r["levels"], r["convergence_factor"]) for r in rows],
            [("mesh", "2", "0.12"), ("mesh", "3", "0.15"), ("wall", "3", "")],
        )
        self.assertIn("n.c.", out)  # a factor above one

    def test_without(self):
        code, _, _ = self.call(
            "--materials", "neo-hookean", "--methods", "direct,fast", "--systems", "1:1", "--without", "fine:direct"
        )
        self.assertEqual(code, 0)
        self.assertEqual([("direct" in call) for call in calls(self.program)], [True, True, False])
        self.assertEqual(len(self.csv("cost_step1_newton1.csv")), 5)


class WithoutPetsc(StudyTest):
    HELP = "  --systems STEP:IT,...\n  --solvers NAME,...  default fast,direct; petsc is not in this build"
    FEW = ("--materials", "neo-hookean", "--meshes", "coarse", "--systems", "1:1")

    def setUp(self):
        super().setUp()
        behave(self.program, help=self.HELP)

    def test_it_is_left_out_of_all(self):
        code, out, err = self.call(*self.FEW)
        self.assertEqual(code, 0, err)
        self.assertEqual(err.count("is without petsc, which is left out"), 1)
        methods = [row["method"] for row in self.csv("cost_step1_newton1.csv")]
        self.assertEqual(sorted(methods), sorted(set(METHODS) - {"petsc"}))

    def test_asked_for_by_name_it_is_an_error(self):
        code, _, err = self.call(*self.FEW, "--methods", "fast,petsc")
        self.assertEqual(code, 1)
        self.assertIn("--methods: petsc is not in this build", err)
        self.assertEqual(calls(self.program), [])

    def test_where_nobody_asks_nothing_is_said(self):
        code, _, err = self.call(*SMALL)
        self.assertEqual(code, 0, err)
        self.assertNotIn("petsc", err)


class Failures(StudyTest):
    def test_not_converged_is_no_number(self):
        behave(self.program, iterations=[["neo-hookean", "coarse", "1:1", "amg", None]])
        code, out, err = self.call(*SMALL)
        self.assertEqual(code, 2, err)
        self.assertEqual(self.line(out, "AMG"), ["AMG", "n.c.", "(7)"])
        self.assertIn("n.c.: AMG, neo-Hookean C: no convergence in 500 iterations", out)
        self.assertNotIn("2.50e-01", out)
        row = self.csv("cost_step1_newton1.csv")[1]
        self.assertEqual(
            (row["status"], row["iterations"], row["solve_seconds"], row["relative_residual"]),
            ("not converged", "", "", ""),
        )
        self.assertEqual(row["message"], "no convergence in 500 iterations")
        row = self.csv("table5_multilevel_step1_newton1.csv")[0]
        self.assertEqual((row["iterations"], row["above_limit"]), ("", ""))

    def test_the_true_residual_decides(self):
        behave(self.program, residual={"amg_fgmres": 3e-8})
        code, out, _ = self.call(*SMALL)
        self.assertEqual(code, 2)
        self.assertIn("n.c.: AMG_FGMRES, neo-Hookean C: true residual is 3.0e-08, above 1e-09", out)

    def test_a_failed_run_does_not_end_the_study(self):
        behave(self.program, end={"neo-hookean fine": [1, "out of memory"], "mooney-rivlin coarse": [2, "no step"]})
        code, out, err = self.call(
            "--methods", "amg,direct", "--materials", "neo-hookean,mooney-rivlin", "--systems", "1:1", "-q"
        )
        self.assertEqual((code, out), (2, ""))
        self.assertEqual(
            err.splitlines(),
            ["[2/6] mooney-rivlin-coarse: failed: no step", "[5/6] neo-hookean-fine: failed: out of memory"],
        )
        rows = {
            (r["material"], r["mesh"]): r
            for r in self.csv("table5_multilevel_step1_newton1.csv")
            if r["method"] == "amg"
        }
        self.assertEqual(
            (rows["neo-hookean", "fine"]["status"], rows["neo-hookean", "fine"]["message"]), ("failed", "out of memory")
        )
        self.assertEqual(rows["mooney-rivlin", "fine"]["iterations"], "12")
        # the failed ones are tried again, the others not
        behave(self.program)
        self.assertEqual(
            self.call("--methods", "amg,direct", "--materials", "neo-hookean,mooney-rivlin", "--systems", "1:1", "-q"),
            (0, "", ""),
        )
        self.assertEqual(len(calls(self.program)), 8)

    def test_two_at_once_give_the_same_tables(self):
        words = ("--methods", "amg,direct", "--materials", "neo-hookean,mooney-rivlin", "--systems", "1:1", "-q")
        self.assertEqual(self.call(*words), (0, "", ""))
        table = self.csv("table5_multilevel_step1_newton1.csv")
        shutil.rmtree(self.out)
        self.assertEqual(self.call(*words, "--jobs", "2"), (0, "", ""))
        self.assertEqual(self.csv("table5_multilevel_step1_newton1.csv"), table)
        self.assertEqual(len(calls(self.program)), 12)

    def test_all_failed(self):
        behave(self.program, end={"neo-hookean coarse": [2, "Newton's method stalls"]})
        code, out, _ = self.call(*SMALL)
        self.assertEqual(code, 2)
        self.assertIn("failed: neo-Hookean C: Newton's method stalls", out)

    def test_a_result_that_lacks_something(self):
        behave(self.program, omit=["amg"])
        code, _, err = self.call(*SMALL)
        self.assertEqual(code, 2)
        self.assertIn("holds no solver amg", err)
        behave(self.program, cut=True)
        code, _, err = self.call(*SMALL)
        self.assertEqual(code, 2)
        self.assertIn("is not JSON", err)
        self.assertEqual(len(calls(self.program)), 2)


class Restart(StudyTest):
    def runs(self, *arguments):
        """How many runs the call starts."""
        before = len(calls(self.program))
        code, _, err = self.call(*arguments)
        self.assertEqual(code, 0, err)
        return len(calls(self.program)) - before

    def test_finished_runs_stay(self):
        self.assertEqual(self.runs(*SMALL), 1)
        self.assertEqual(self.runs(*SMALL), 0)
        _, _, err = self.call(*SMALL)
        self.assertIn("[1/1] neo-hookean-coarse: there already", err)
        # fewer methods are there too; another mesh is not
        self.assertEqual(self.runs(*SMALL[:4], "--methods", "amg", "--systems", "1:1"), 0)
        self.assertEqual(self.runs(*SMALL[:2], "--meshes", "coarse,intermediate", *SMALL[4:]), 1)

    def test_what_makes_a_run_stale(self):
        self.runs(*SMALL)
        self.assertEqual(self.runs(*SMALL[:4], "--methods", "amg,amli", "--systems", "1:1"), 1)
        self.assertEqual(self.runs(*SMALL), 1)
        self.assertEqual(self.runs(*SMALL[:-1], "1:1,12:2"), 1)
        self.assertEqual(self.runs(*SMALL), 0)
        self.assertEqual(self.runs(*SMALL, "--tolerance", "1e-8"), 1)
        self.assertEqual(self.runs(*SMALL), 1)
        self.assertEqual(self.runs(*SMALL, "--set", "fluid.density=2"), 1)
        self.assertEqual(self.runs(*SMALL, "--set", "fluid.density=2", "--threads", "1"), 1)
        self.assertEqual(self.runs(*SMALL), 1)
        self.assertEqual(self.runs(*SMALL, "--sub-problems"), 1)
        self.assertEqual(self.runs(*SMALL), 0)
        (self.cases / "neo-hookean.toml").write_text('title = "another"\n')
        self.assertEqual(self.runs(*SMALL), 1)
        behave(self.program, version="0.1.1")
        self.assertEqual(self.runs(*SMALL), 1)

    def test_another_case_hash_or_half_a_file(self):
        self.runs(*SMALL)
        file = self.out / "runs" / "neo-hookean-coarse" / "linear_solvers.json"
        good = file.read_text()
        file.write_text(good.replace("0123456789abcdef", "fedcba9876543210"))
        self.assertEqual(self.runs(*SMALL), 1)
        for bad in (good[:-20], "[]", "{}", good.replace('"converged": true', '"converged": "yes"')):
            file.write_text(bad)
            self.assertEqual(self.runs(*SMALL), 1)

    def test_old_results_do_not_pass_for_new_ones(self):
        self.runs(*SMALL)
        behave(self.program, version="0.2.0", end={"neo-hookean coarse": [2, "stalls"]})
        code, out, _ = self.call(*SMALL)
        self.assertEqual(code, 2)
        self.assertIn("failed", self.line(out, "AMG"))

    def test_command_line_of_a_run(self):
        self.runs(*SMALL, "--threads", "1", "--set", "structure.density=2", "--sub-problems")
        self.assertEqual(
            calls(self.program),
            [
                f"{self.cases}/neo-hookean.toml -o {self.out}/runs/neo-hookean-coarse -q --systems 1:1 "
                "--solvers amg,amg_fgmres,direct --tolerance 1e-09 --sub-problems --threads 1 "
                "--set structure.density=2 --set mesh.level=coarse"
            ],
        )

    def test_a_study_that_is_ended_leaves_no_run_behind(self):
        behave(self.program, sleep=600)
        code = (
            "import sys; sys.path[:0] = sys.argv.pop(1), sys.argv.pop(1); "
            "from fsi_research.start import main; sys.exit(main(sys.argv[1:]))"
        )
        words = [
            sys.executable,
            "-E",
            "-B",
            "-c",
            code,
            COMPARE,
            COMPARE / "research",
            "solvers",
            "-o",
            self.out,
            "--case-dir",
            self.cases,
            "--program",
            self.program,
            *SMALL,
        ]
        study = subprocess.Popen(list(map(str, words)), stderr=subprocess.PIPE, text=True)
        pid = self.base / "pid"
        until = time.monotonic() + 120  # then it hangs
        while not (pid.exists() and pid.read_text()):
            self.assertLess(time.monotonic(), until)
            time.sleep(0.05)
        study.terminate()
        _, err = study.communicate(timeout=120)
        self.assertEqual(
            (study.returncode, err),
            (143, "fsi-compare: interrupted by SIGTERM; finished runs are kept, the same command goes on\n"),
        )
        with self.assertRaises(ProcessLookupError):
            os.kill(int(pid.read_text()), 0)
        behave(self.program)
        self.assertEqual(self.runs(*SMALL), 1)

    def test_the_default_cases_are_there(self):
        for material in MATERIALS:
            self.assertTrue((CASES / f"{material}.toml").is_file(), CASES)

    def test_time_left(self):
        _, _, err = self.call(*SMALL[:2], "--meshes", "coarse,intermediate", *SMALL[4:])
        self.assertRegex(
            err,
            r"^\[1/2\] neo-hookean-coarse: [\d.]+ s, about [\d.]+ s left\n\[2/2\] "
            r"neo-hookean-intermediate: [\d.]+ s\n$",
        )


class Stress(StudyTest):
    ROWS = 20

    def test_rows(self):
        self.make_mesh_maker()
        code, out, err = self.call("--stress")
        self.assertEqual(code, 0, err)
        rows = self.csv("stress.csv")
        self.assertEqual(len(rows), 2 * self.ROWS)
        self.assertEqual({row["method"] for row in rows}, {"fast", "amg_fgmres"})
        self.assertEqual(
            self.line(out, "neo-Hookean", "coarse", "bulk", "modulus", "1e+07", "kPa")[6:],
            ["9", "0.167", "yes", "6", "0.153", "yes"],
        )
        densities = sorted({float(row["value"]) for row in rows if row["quantity"] == "density wall/fluid"})
        self.assertEqual(densities, [10.0**i for i in range(-3, 4)])
        for expected in (
            "--set time.step=0.0125 --set time.end=0.0125",
            "--set structure.bulk_modulus=100.0",
            "--set fluid.density=1.0 --set structure.density=1000.0",
            "--set fluid.viscosity=0.35",
            "--set mesh.file=",
        ):
            self.assertTrue(any(expected in call for call in calls(self.program)), expected)
        self.assertFalse(any("inlet" in call for call in calls(self.program)))
        self.assertIn("| neo-Hookean | coarse | viscosity |", (self.out / "stress.md").read_text())
        self.assertEqual(self.call("--stress", "-q"), (0, "", ""))
        self.assertEqual(len(calls(self.program)), self.ROWS)

    def test_no_mesh_maker(self):
        with mock.patch.dict(os.environ, PATH=""):
            code, out, _ = self.call("--stress", "--methods", "fast")
        self.assertEqual(code, 2)
        self.assertEqual(len(calls(self.program)), self.ROWS - 2)
        self.assertIn(
            "failed: edge along/across axis 20: fsi-mesh is neither beside fsi-linear-study nor on the path", out
        )

    def test_not_converged(self):
        self.make_mesh_maker()
        behave(self.program, iterations=[["neo-hookean", "coarse", "1:1", "amg_fgmres", None]])
        code, out, _ = self.call("--stress")
        self.assertEqual(code, 2)
        self.assertEqual(
            self.line(out, "neo-Hookean", "coarse", "viscosity", "0.35", "kPa", "ms")[6:],
            ["9", "0.167", "yes", "n.c.", "-", "no"],
        )

    def test_wrong_use(self):
        for words, expected in (
            (("--systems", "12:2"), "--systems: --stress is about the first system"),
            (("--set", "time.step=1"), "--set: time.step is varied by --stress"),
        ):
            code, _, err = self.call("--stress", *words)
            self.assertEqual(code, 1)
            self.assertIn(expected, err)

    def make_mesh_maker(self):
        maker = self.base / "fsi-mesh"
        maker.write_text('#!/bin/sh\nwhile [ "$1" != -o ]; do shift; done\necho mesh >"$2"\n')
        maker.chmod(0o755)


class WrongUse(StudyTest):
    def assert_refused(self, expected, *arguments, **options):
        code, out, err = self.call(*arguments, **options)
        self.assertEqual((code, out), (1, ""), err)
        self.assertEqual(err.count("\n"), 1, err)
        self.assertTrue(err.startswith("fsi-compare: error: "), err)
        self.assertIn(expected, err)
        self.assertEqual(calls(self.program), [])

    def test_names(self):
        self.assert_refused(
            "--methods: 'amg_fgmre' is unknown; nearest: amg_fgmres; names are direct, fast",
            "--methods",
            "direct,amg_fgmre",
        )
        self.assert_refused(
            "--materials: 'neohookean' is unknown; nearest: neo-hookean; names are neo-hookean, "
            "mooney-rivlin, artery",
            "--materials",
            "neohookean",
        )
        self.assert_refused("--meshes: 'corse' is unknown; nearest: coarse", "--meshes", "corse")
        self.assert_refused("--methods: 'amg' is given twice", "--methods", "amg,amg")
        self.assert_refused("--methods: '' is unknown", "--methods", "amg,")

    def test_values(self):
        self.assert_refused("--systems: '12' is not a system; give STEP:ITERATION", "--systems", "12")
        self.assert_refused("--systems: '0:1' is not a system", "--systems", "0:1")
        self.assert_refused("--systems: 1:1 is given twice", "--systems", "1:1,1:1")
        self.assert_refused("--tolerance: 0 will not do", "--tolerance", "0")
        self.assert_refused("--tolerance: nan will not do", "--tolerance", "nan")
        self.assert_refused("--threads: -1 is negative", "--threads", "-1")
        self.assert_refused("--jobs", "--jobs", "0")
        self.assert_refused("--set: 'time.end' is not an entry", "--set", "time.end")
        self.assert_refused("--set: mesh.level is chosen by --meshes", "--set", "mesh.level=fine")
        self.assert_refused("--set: a.b is given twice", "--set", "a.b=1", "--set", "a.b=2")
        self.assert_refused("--without: 'direct' has no ':'", "--without", "direct")
        self.assert_refused("--without: 'diret' is unknown; nearest: direct", "--without", "fine:diret")
        self.assert_refused(
            "--without: leaves no method on the fine mesh", "--methods", "direct", "--without", "fine:direct"
        )
        self.assert_refused("unrecognized arguments: --colour", "--colour")
        self.assert_refused("see fsi-compare solvers --help", "--tolerance", "small")

    def test_program(self):
        self.assert_refused(
            "/nowhere: --program: no such program; build it", "--program", "/nowhere", own_program=False
        )
        self.assert_refused("--program: is not a program", "--program", self.cases, own_program=False)
        self.assert_refused("--program: is not fsi-linear-study", "--program", "/bin/echo", own_program=False)
        with mock.patch.dict(os.environ, PATH=""), mock.patch("sys.argv", ["/nowhere/fsi-compare"]):
            self.assert_refused(
                "fsi-linear-study: --program: is neither beside fsi-compare nor on the path", own_program=False
            )

    def test_found_beside_fsi_compare(self):
        with mock.patch("sys.argv", [str(self.base / "fsi-compare")]):
            self.assertEqual(self.call(*SMALL, "-q", own_program=False), (0, "", ""))

    def test_cases(self):
        (self.cases / "artery.toml").unlink()
        self.assert_refused("artery.toml: --case-dir: no such case file")
        self.assert_refused("/nowhere: --case-dir: no such folder", "--case-dir", "/nowhere")

    def test_output(self):
        self.out.write_text("")
        self.assert_refused("out: --output: is a file, not a folder")
        self.assert_refused("cannot be made", "-o", "/proc/solvers")

    def test_what_every_run_refuses(self):
        behave(self.program, end={"neo-hookean coarse": [1, "fluid.densty: unknown key; nearest: fluid.density"]})
        code, out, err = self.call(*SMALL, "-q", "--set", "fluid.densty=1")
        self.assertEqual(
            (code, out, err), (1, "", "fsi-compare: error: fluid.densty: unknown key; nearest: fluid.density\n")
        )

    def test_help(self):
        code, out, _ = self.call("--help")
        self.assertEqual(code, 0)
        for word in (
            "--methods",
            "--materials",
            "--meshes",
            "--systems",
            "--stress",
            "--sub-problems",
            "--program",
            *METHODS,
        ):
            self.assertIn(word, out)


if __name__ == "__main__":
    unittest.main()
