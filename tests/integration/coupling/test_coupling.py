"""The coupling schemes of the partitioned driver: one solution, few passes, restarts, reports, failures."""

import csv
import unittest

from programs import (
    ARTERY,
    MESH,
    MONOLITHIC,
    NEO_HOOKEAN,
    PARTITIONED,
    FolderTest,
    attempt,
    by_turns,
    calls,
    difference,
    execute,
    make_mesh,
    make_small_mesh,
    pressure,
    restart,
    run,
    summary,
    table,
    wall,
)

AXISYMMETRIC = NEO_HOOKEAN.parent / "axisymmetric" / NEO_HOOKEAN.name
GALLERY = NEO_HOOKEAN.parents[2] / "gallery"
QUICK = ("iqn-ils", "iqn-imvj", "robin-neumann", "robin-neumann-iqn", "robin-neumann-imvj")
# Most passes per step, mean of the first eight steps at 1e-6: without differences of earlier steps the first ones take
# twice as many as later ones (coarse mesh, 96 steps: 5.1, 4.9, 4.8, 2.6, 3.3).
LIMITS = {"iqn-ils": 12, "iqn-imvj": 12, "robin-neumann": 12, "robin-neumann-iqn": 8, "robin-neumann-imvj": 8}


def scheme(name, *settings):
    return (f"partitioned.scheme={name}", *settings)


def coupling_table(folder):
    """Rows of coupling.csv as dictionaries of numbers."""
    with open(folder / "coupling.csv", encoding="utf-8") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


class Schemes:
    """All schemes that converge, coarse mesh."""

    end = 0.5  # ms: 4 steps

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.settings = (f"time.end={cls.end}", "output.every=0")
        cls.monolithic = run(MONOLITHIC, cls.case, cls.base / "monolithic", *cls.settings)

    def test_each_gives_the_monolithic_solution(self):
        for name in self.schemes:
            with self.subTest(scheme=name):
                folder = run(
                    PARTITIONED,
                    self.case,
                    self.base / name,
                    *self.settings,
                    *scheme(name, "partitioned.tolerance=1e-9", "partitioned.max_iterations=2000"),
                )
                apart = difference(pressure(folder), pressure(self.monolithic))
                print(f"{self.case.stem}, {name}: pressure apart by at most {apart.max():.1e}")
                self.assertLess(apart.max(), 1e-6)
                for component in (2, 3):
                    apart = difference(wall(folder)[:, :, component], wall(self.monolithic)[:, :, component])
                    self.assertLess(apart.max(), 1e-6)

    def test_quick_ones_are_quick(self):
        for name in QUICK:
            with self.subTest(scheme=name):
                folder = run(
                    PARTITIONED, self.case, self.base / f"quick-{name}", "time.end=1", "output.every=0", *scheme(name)
                )
                counts = table(folder, "iterations.csv")[:, 2]
                print(f"{self.case.stem}, {name}: passes per step {counts}")
                self.assertLessEqual(counts.mean(), LIMITS[name])


class NeoHookean(Schemes, FolderTest):
    case = NEO_HOOKEAN
    schemes = (*QUICK, "newton-krylov", "aitken")

    def test_constant_too(self):
        """Some 500 passes a step: one step."""
        one = ("time.end=0.125", "output.every=0")
        whole = run(MONOLITHIC, self.case, self.base / "one", *one)
        folder = run(
            PARTITIONED,
            self.case,
            self.base / "constant",
            *one,
            *scheme("constant", "partitioned.tolerance=1e-8", "partitioned.max_iterations=3000"),
        )
        self.assertLess(difference(pressure(folder), pressure(whole)).max(), 1e-5)

    def test_force_tolerance_is_kept(self):
        folder = run(
            PARTITIONED,
            self.case,
            self.base / "force",
            *self.settings,
            *scheme("iqn-ils", "partitioned.tolerance=1e-3", "partitioned.force_tolerance=1e-6"),
        )
        for row in coupling_table(folder):
            self.assertLessEqual(row["force_residual"], 1e-6)

    def test_first_guess_of_any_order(self):
        for order, name in by_turns((0, 1, 2), ("iqn-ils", "robin-neumann-iqn")):
            with self.subTest(order=order, scheme=name):
                folder = run(
                    PARTITIONED,
                    self.case,
                    self.base / f"{name}-{order}",
                    *self.settings,
                    *scheme(name, f"time.predictor={order}", "partitioned.tolerance=1e-8"),
                )
                self.assertLess(difference(pressure(folder), pressure(self.monolithic)).max(), 1e-5)


class Artery(Schemes, FolderTest):
    case = ARTERY
    schemes = QUICK


class Restart(FolderTest):
    """What a scheme keeps between steps comes back bit for bit."""

    schemes = (*QUICK, "newton-krylov")

    def test_goes_on_bit_for_bit(self):
        mesh = f"mesh.file={make_small_mesh(self.base / 'small.msh')}"
        for name in self.schemes:
            with self.subTest(scheme=name):
                settings = (mesh, "output.every=2", *scheme(name, "partitioned.max_iterations=400"))
                whole = run(PARTITIONED, ARTERY, self.base / f"{name}-whole", *settings, "time.end=0.75")
                folder = run(PARTITIONED, ARTERY, self.base / f"{name}-cut", *settings, "time.end=0.375")
                rows = (folder / "coupling.csv").read_text().splitlines()
                restart(PARTITIONED, ARTERY, folder, *settings, "time.end=0.75")
                self.assertSameTables(folder, whole)
                self.assertEqual((folder / "coupling.csv").read_text().splitlines()[:4], rows[:4])
                seconds = ("fluid_s", "wall_s", "mesh_motion_s", "coupling_s")
                for a, b in zip(coupling_table(folder), coupling_table(whole)):
                    self.assertEqual(
                        {k: v for k, v in a.items() if k not in seconds},
                        {k: v for k, v in b.items() if k not in seconds},
                    )

    def test_goes_on_bit_for_bit_in_each_time_scheme(self):
        """Quadratic axisymmetric elements; the load jumps before the cut."""
        mesh = make_mesh(
            self.base / "section.msh", "--axisymmetric", "--length", 3, "--lumen-cells", 3, "--axial-cells", 6
        )
        time_schemes = ("midpoint", "bdf2", "generalised-alpha", "tr-bdf2")
        for scheme_in_time, name in by_turns(time_schemes, ("robin-neumann-iqn", "iqn-imvj")):
            with self.subTest(scheme=name, time=scheme_in_time):
                settings = (
                    f"mesh.file={mesh}",
                    f"time.scheme={scheme_in_time}",
                    "time.step=0.0625",
                    *scheme(name, "output.every=2"),
                )
                base = self.base / f"{name}-{scheme_in_time}"
                whole = run(PARTITIONED, AXISYMMETRIC, f"{base}-whole", *settings, "time.end=0.375")
                folder = run(PARTITIONED, AXISYMMETRIC, f"{base}-cut", *settings, "time.end=0.1875")
                restart(PARTITIONED, AXISYMMETRIC, folder, *settings, "time.end=0.375")
                self.assertSameTables(folder, whole)

    def test_goes_on_with_another_scheme(self):
        """What the other one kept is of no use, but does no harm."""
        settings = ("output.every=0",)
        folder = run(PARTITIONED, NEO_HOOKEAN, self.base / "one", *settings, *scheme("iqn-ils", "time.end=0.25"))
        restart(PARTITIONED, NEO_HOOKEAN, folder, *settings, *scheme("robin-neumann-iqn", "time.end=0.5"))
        self.assertEqual(len(coupling_table(folder)), 4)


class Reports(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = run(PARTITIONED, NEO_HOOKEAN, cls.base / "run", "time.end=0.5", *scheme("iqn-ils"))

    def test_one_row_per_step_that_agrees_with_the_others(self):
        rows, iterations = coupling_table(self.folder), table(self.folder, "iterations.csv")
        self.assertEqual(len(rows), 4)
        for row, line in zip(rows, iterations):
            self.assertEqual([row["step"], row["time_ms"], row["iterations"]], line[:3].tolist())
            self.assertEqual(row["fluid_newton_iterations"] + row["wall_newton_iterations"], line[3])
            self.assertEqual(row["fluid_linear_iterations"] + row["wall_linear_iterations"], line[4])
            parts = [row[name] for name in ("fluid_s", "wall_s", "mesh_motion_s", "coupling_s")]
            self.assertTrue(all(part > 0 for part in parts))
            self.assertLessEqual(sum(parts), line[5])
            self.assertLessEqual(row["displacement_residual"], 1e-6)
            self.assertGreater(row["displacement_residual_mm"], 0)
            self.assertLess(row["force_residual"], 1e-4)
        self.assertGreater(rows[-1]["columns"], 0)

    def test_log_tells_every_pass(self):
        lines = [line for line in (self.folder / "run.log").read_text().splitlines() if "|d~ - d|" in line]
        self.assertEqual(len(lines), summary(self.folder)["totals"]["outer_iterations"])
        self.assertTrue(all("force" in line for line in lines))

    def test_sub_problems_keep_their_factors(self):
        counted = calls(self.folder)
        made = [counted.get(f"{kind}: {part}", 0) for kind in ("factorisation", "set-up") for part in ("fluid", "wall")]
        self.assertLessEqual(sum(made), 5)

    def test_monolithic_runs_have_none(self):
        folder = run(MONOLITHIC, NEO_HOOKEAN, self.base / "monolithic", "time.end=0.125", "output.every=0")
        self.assertFalse((folder / "coupling.csv").exists())


class Failures(FolderTest):
    def refused(self, *settings):
        folder = self.base / "failed"
        process = attempt(PARTITIONED, NEO_HOOKEAN, "-q", "--force", folder=folder, settings=settings)
        self.assertEqual(process.returncode, 2, process.stderr)
        self.assertEqual(summary(folder)["status"], "not converged")
        return process.stderr

    def test_explicit_blows_up_where_the_added_mass_is_large(self):
        """Wall against fluid: rho_s h / (rho_f m) is 0.01 here; docs/coupling.md has the limits."""
        message = self.refused(*scheme("explicit"), "time.end=2")
        self.assertIn("the explicit coupling", message)
        self.assertIn("iqn-ils", message)

    def test_explicit_has_the_limits_of_theory(self):
        """Densities below and above 2 and 6 times rho_f m / (0.884 h), for an extrapolation of order 1 and 2, of a wall that
        moves as a whole: with little stabilisation."""
        fluid, thickness, added = 1.0, 0.39, 46.3  # mg/mm^3, mm, mm
        for order, factor in ((1, 2), (2, 6)):
            limit = factor * fluid * added / (0.884 * thickness)
            settings = (
                *scheme("explicit"),
                "structure.stabilisation=1e-5",
                f"time.predictor={order}",
                "output.every=0",
                "partitioned.velocity_gap=1e9",
            )
            with self.subTest(order=order):
                self.assertIn("unstable", self.refused(*settings, f"structure.density={limit / 1.5}"))
                folder = run(
                    PARTITIONED,
                    NEO_HOOKEAN,
                    self.base / f"stable-{order}",
                    *settings,
                    f"structure.density={limit * 1.5}",
                )
                self.assertEqual(table(folder, "iterations.csv")[:, 2].tolist(), [1] * 96)

    def test_explicit_is_no_answer_at_its_limit(self):
        """It neither grows nor decays there, and the pressure is tens of times too high."""
        message = self.refused(*scheme("explicit"), "structure.density=1200", "time.end=2")
        self.assertIn("its pressure is wrong", message)
        self.assertIn("iqn-ils", message)

    def test_explicit_goes_on_from_a_checkpoint_as_without_one(self):
        settings = (*scheme("explicit"), "structure.density=1400")
        whole = self.refused(*settings, "time.end=2")
        folder = run(PARTITIONED, NEO_HOOKEAN, self.base / "parts", *settings, "time.end=0.5")
        process = attempt(
            PARTITIONED, NEO_HOOKEAN, "-q", "--restart", folder, folder=folder, settings=(*settings, "time.end=2")
        )
        self.assertEqual(process.returncode, 2, process.stderr)
        self.assertEqual(whole.split("[")[0], process.stderr.split("[")[0])

    def test_explicit_needs_an_extrapolation(self):
        process = attempt(
            PARTITIONED, NEO_HOOKEAN, "-q", folder=self.base / "none", settings=scheme("explicit", "time.predictor=0")
        )
        self.assertEqual(process.returncode, 1)
        self.assertIn("time.predictor", process.stderr)

    def test_robin_robin_says_that_it_does_not_iterate(self):
        folder = self.base / "loose"
        process = attempt(PARTITIONED, NEO_HOOKEAN, "-q", folder=folder, settings=scheme("robin-robin", "time.end=0.5"))
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(process.stderr.count("does not iterate"), 1, process.stderr)
        self.assertIn("block-newton", process.stderr)
        passes = table(folder, "iterations.csv")[:, 2]
        self.assertTrue((passes[:2] > 1).all(), "iterated behind jumps of the load: the start, the pulse's end")
        self.assertEqual(passes[2:].tolist(), [1] * 2)
        self.assertIn("partitioned.robin_coefficient", (folder / "run.log").read_text())

    def test_robin_robin_refuses_what_it_does_not_serve(self):
        for settings, key in (
            (scheme("robin-robin", "time.scheme=midpoint"), "time.scheme"),
            (scheme("robin-robin-corrected", "time.scheme=tr-bdf2"), "time.scheme"),
            (scheme("robin-robin-parallel", "time.scheme=bdf2"), "time.scheme"),
            (scheme("robin-robin-parallel", "time.predictor=0"), "time.predictor"),
            (scheme("robin-robin", "partitioned.robin_coefficient=0"), "partitioned.robin_coefficient"),
        ):
            with self.subTest(settings=settings):
                process = attempt(PARTITIONED, NEO_HOOKEAN, "-q", folder=self.base / "none", settings=settings)
                self.assertEqual(process.returncode, 1, process.stderr)
                self.assertIn(key, process.stderr)

    def test_constant_ends_early_when_it_diverges(self):
        """The largest stable factor is 0.013 on this mesh."""
        message = self.refused(*scheme("constant", "partitioned.relaxation=0.016"), "partitioned.max_iterations=2000")
        self.assertIn("diverges", message)
        self.assertIn("partitioned.relaxation", message)

    def test_too_few_iterations(self):
        message = self.refused(*scheme("iqn-ils"), "time.end=0.25", "partitioned.max_iterations=3")
        self.assertIn("3 iterations", message)
        self.assertIn("partitioned.max_iterations", message)


class SchemeByTheScene(FolderTest):
    """Where the case names no scheme, the one that takes fewer passes there is chosen, and the log says why."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.case = GALLERY / "aneurysm" / "aneurysm.toml"  # names none; its wall answers within 0.14 ms
        assert "scheme" not in cls.case.read_text()
        mesh = cls.base / "aneurysm.msh"
        execute(MESH, "geo", cls.case.with_suffix(".geo"), "--order", "2", "--set", "size=0.8", "-o", mesh)
        cls.settings = (f"mesh.file={mesh}", "output.every=0")

    def chosen(self, name, case, *settings):
        """The scheme and the reason of a run that warns of nothing."""
        process = attempt(PARTITIONED, case, "-q", folder=self.base / name, settings=settings)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        choice = summary(self.base / name)["choices"]["partitioned.scheme"]
        log = (self.base / name / "run.log").read_text()
        self.assertIn(f"partitioned.scheme = {choice['value']}: {choice['reason']}", log)
        return choice["value"], choice["reason"]

    def test_unnamed_is_an_interface_iteration(self):
        for name, step, end in (("short", 0.125, 0.25), ("long", 2, 8)):
            settings = (*self.settings, f"time.step={step}", f"time.end={end}")
            self.assertEqual(self.chosen(name, self.case, *settings), ("robin-neumann-inexact", "the case names none"))
            self.assertEqual(summary(self.base / name)["coupling_kind"], "interface")
            log = (self.base / name / "run.log").read_text().splitlines()
            self.assertIn("coupling kind: interface; ", log[1])
            passes = table(self.base / name, "iterations.csv")[:, 2]
            print(f"passes a step, {name}: {passes.tolist()}")
            self.assertLess(passes.max(), 30)

    def test_block_newton_in_short_and_long_steps(self):
        block = scheme("block-newton")
        _, reason = self.chosen("block", self.case, *self.settings, *block, "time.step=0.125", "time.end=0.25")
        self.assertIn("is 1 times the membrane's, as a step of 0.125 ms is, as its time scheme solves it, 0.", reason)
        _, reason = self.chosen("block_long", self.case, *self.settings, *block, "time.step=2", "time.end=8")
        self.assertIn(
            "is 10 times the membrane's, as a step of 2 ms is, as its time scheme solves it, 4.3 times", reason
        )
        for folder in ("block", "block_long"):
            self.assertEqual(summary(self.base / folder)["coupling_kind"], "block")
            passes = table(self.base / folder, "iterations.csv")[:, 2]
            print(f"linear passes a step, {folder}: {passes.tolist()}")
            self.assertLess(passes.max(), 60)

    def test_options_of_another_scheme_are_said(self):
        process = attempt(
            PARTITIONED,
            self.case,
            "-q",
            folder=self.base / "foreign",
            settings=(*self.settings, "time.end=0.25", "partitioned.robin_coefficient=3"),
        )
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(process.stderr.count("partitioned.robin_coefficient has no effect"), 1, process.stderr)

    def test_what_the_case_names_is_kept(self):
        settings = (*self.settings, "time.end=0.25", *scheme("iqn-imvj"))
        self.assertEqual(self.chosen("named", self.case, *settings), ("iqn-imvj", "named by the case"))

    def test_adaptive_steps_go_by_the_longest(self):
        block = scheme("block-newton")
        adaptive = (*self.settings, *block, "time.step=adaptive", "time.end=1")
        self.assertIn("is 1 times the membrane's", self.chosen("adaptive", self.case, *adaptive)[1])
        _, reason = self.chosen(
            "longest", self.case, *self.settings, *block, "time.step=adaptive", "time.end=4", "time.largest_step=4"
        )
        self.assertIn("is 10 times the membrane's, as the longest step of 4 ms", reason)

    def test_a_wall_in_the_fluid(self):
        flag = GALLERY / "turek-hron-fsi3" / "turek-hron-fsi3.toml"
        mesh = f"mesh.file={flag_mesh(self.base)}"
        self.chosen("flag", flag, mesh, "time.end=2")
        self.assertLess(table(self.base / "flag", "iterations.csv")[:, 2].max(), 30)
        _, reason = self.chosen("block_flag", flag, mesh, *scheme("block-newton"), "time.end=2")
        self.assertIn("is 10000 times the membrane's, as the wall stands in the fluid", reason)

    def test_goes_on_bit_for_bit(self):
        settings = (*self.settings, "time.step=0.5")
        whole = run(PARTITIONED, self.case, self.base / "whole", *settings, "time.end=3")
        folder = run(PARTITIONED, self.case, self.base / "cut", *settings, "time.end=1.5")
        restart(PARTITIONED, self.case, folder, *settings, "time.end=3")
        self.assertSameTables(folder, whole)


def flag_mesh(folder):
    """A coarse one of Turek's and Hron's channel."""
    mesh = folder / "flag.msh"
    sizes = [word for size in ("far=80", "near=25", "flag=20", "tip=20", "wake=60") for word in ("--set", size)]
    made = execute(MESH, "geo", GALLERY / "turek-hron-cfd1" / "channel.geo", "--order", "2", *sizes, "-o", mesh)
    if made.returncode != 0:
        raise AssertionError(made.stderr)
    return mesh


class SchemesThatDoNotSuit(FolderTest):
    """Robin-Neumann's impedance is that of a tube around the fluid, within steps that its wall does not outrun."""

    def warnings(self, name, case, *settings):
        process = attempt(PARTITIONED, case, "-q", folder=self.base / name, settings=settings)
        self.assertEqual(process.returncode, 0, process.stderr)
        return process.stderr

    def test_robin_neumann_warns_and_names_another_scheme(self):
        flag = GALLERY / "turek-hron-fsi3" / "turek-hron-fsi3.toml"
        settings = (f"mesh.file={flag_mesh(self.base)}", "time.end=2")
        said = self.warnings("robin", flag, *settings, *scheme("robin-neumann-iqn"))
        for part in (f"{flag}: partitioned.scheme", '"robin-neumann-iqn"', "stands in the fluid", 'name "iqn-ils"'):
            self.assertIn(part, said)
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertIn("stands in the fluid", (self.base / "robin" / "run.log").read_text())
        self.assertEqual(self.warnings("iqn", flag, *settings), "")

    def test_inexact_passes_are_refused_where_the_wall_stands_in_the_fluid(self):
        flag = GALLERY / "turek-hron-fsi3" / "turek-hron-fsi3.toml"
        settings = (f"mesh.file={flag_mesh(self.base)}", "time.end=2", *scheme("robin-neumann-inexact"))
        process = attempt(PARTITIONED, flag, "-q", folder=self.base / "inexact", settings=settings)
        self.assertEqual(process.returncode, 1, process.stderr)
        for part in (f"{flag}: partitioned.scheme", "stands in the fluid", '"iqn-ils"'):
            self.assertIn(part, process.stderr)
        self.assertFalse((self.base / "inexact").exists())

    def test_a_tube_is_no_reason_to_warn(self):
        self.assertEqual(self.warnings("tube", AXISYMMETRIC, "mesh.level=coarse", "time.end=0.125"), "")

    def test_long_steps_want_another_scheme(self):
        settings = ("mesh.level=coarse", "time.step=4", "time.end=4", "time.scheme=euler")
        said = self.warnings("long", AXISYMMETRIC, *settings, *scheme("robin-neumann-iqn"))
        for part in (f"{AXISYMMETRIC}: partitioned.scheme", "a step of 4 ms", '"robin-neumann-iqn"', '"iqn-ils"'):
            self.assertIn(part, said)
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertEqual(self.warnings("long-iqn", AXISYMMETRIC, *settings, *scheme("iqn-ils")), "")


if __name__ == "__main__":
    unittest.main()
