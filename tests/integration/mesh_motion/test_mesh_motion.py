"""Mesh motions by name: where the harmonic one folds the others go on, and both drivers find one solution with them."""

import unittest

from programs import (
    DRIVERS,
    LINEAR_STUDY,
    MONOLITHIC,
    NEO_HOOKEAN,
    PARTITIONED,
    FolderTest,
    attempt,
    difference,
    make_mesh,
    make_small_mesh,
    pressure,
    restart,
    run,
    summary,
    wall,
)

AXISYMMETRIC = NEO_HOOKEAN.parent / "axisymmetric" / NEO_HOOKEAN.name


def method(name, *settings):
    return (f"mesh_motion.method={name}", *settings)


class Folding(FolderTest):
    """A tube with clamped ends that suction pulls in: next to them the mesh is squeezed."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_mesh(cls.base / "tube.msh", "--axisymmetric", "--level", "coarse", "--length", 6)
        cls.settings = (f"mesh.file={mesh}", "element=p1", "inlet.pressure=-3", "inlet.until=2", "time.step=0.0625")
        cls.settings += ("time.end=2", "time.retries=0", "output.every=0")

    def test_the_harmonic_mesh_folds_and_the_hint_names_the_others(self):
        for program in DRIVERS:
            process = attempt(program, AXISYMMETRIC, "-q", "--force", folder=self.base / "h", settings=self.settings)
            self.assertEqual(process.returncode, 2, process.stderr)
            self.assertIn("a mesh element of the fluid near z = 0.", process.stderr)
            self.assertIn('mesh_motion.method = "stiffened" or "nonlinear-elastic" can', process.stderr)

    def test_the_others_go_on(self):
        for name in ("stiffened", "nonlinear-elastic"):
            of_drivers = []
            for program in DRIVERS:
                folder = self.base / f"{name}-{program.rsplit('/', 1)[-1]}"
                run(program, AXISYMMETRIC, folder, *self.settings, *method(name), "partitioned.tolerance=1e-8")
                of_drivers.append(wall(folder)[:, :, 2])
            inward = -of_drivers[0].min()
            apart = difference(of_drivers[1], of_drivers[0]).max()
            print(f"{name}: wall moves in by {inward:.3f} mm, drivers apart by {apart:.1e}")
            self.assertGreater(inward, 0.4)
            self.assertLess(apart, 1e-6)


class Drivers(FolderTest):
    """All ways to solve, three dimensions, a short artery."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_small_mesh(cls.base / "small.msh")
        # Ten times the usual pressure, so that the pseudo-solid is not linear.
        cls.settings = (f"mesh.file={mesh}", "time.end=0.5", "output.every=0", "inlet.pressure=13.32")

    def case(self, program, folder, *settings):
        return run(program, NEO_HOOKEAN, self.base / folder, *self.settings, *settings)

    def test_every_driver_and_solver_finds_one_solution(self):
        solutions = {}
        for name in ("harmonic", "stiffened", "nonlinear-elastic"):
            direct = self.case(MONOLITHIC, f"{name}-direct", *method(name, "monolithic.linear_solver=direct"))
            solutions[name] = direct
            others = {"fast": self.case(MONOLITHIC, f"{name}-fast", *method(name, "linear.direct_below=0"))}
            for scheme in ("robin-neumann-iqn", "iqn-ils"):
                settings = (f"partitioned.scheme={scheme}", "partitioned.tolerance=1e-9", "linear.direct_below=0")
                others[scheme] = self.case(PARTITIONED, f"{name}-{scheme}", *method(name, *settings))
            for way, folder in others.items():
                apart = difference(pressure(folder), pressure(direct)).max()
                print(f"{name}, {way}: pressure apart by {apart:.1e}")
                self.assertLess(apart, 1e-6)
        for name in ("stiffened", "nonlinear-elastic"):
            moved, plain = (wall(solutions[of])[:, :, 2] for of in (name, "harmonic"))
            apart = abs(moved - plain).max() / abs(plain).max()
            print(f"{name}: wall moves otherwise than with the harmonic motion by {apart:.1e}")
            self.assertGreater(apart, 1e-4, "the mesh inside is another one")
            self.assertLess(apart, 0.02, "the flow hardly sees where inner nodes are")

    def test_restarts_have_the_bits_of_an_uninterrupted_run(self):
        for program, scheme in ((MONOLITHIC, "iqn-ils"), (PARTITIONED, "iqn-ils"), (PARTITIONED, "robin-neumann-iqn")):
            settings = method("nonlinear-elastic", f"partitioned.scheme={scheme}")
            whole = self.case(program, f"whole-{scheme}", *settings)
            self.case(program, f"half-{scheme}", *settings, "time.end=0.25")
            half = restart(program, NEO_HOOKEAN, self.base / f"half-{scheme}", *self.settings, *settings, threads=2)
            self.assertSameResults(half, whole)

    def test_counters_tell_the_cost(self):
        counts = {}
        for name in ("stiffened", "nonlinear-elastic"):
            settings = method(name, "partitioned.scheme=iqn-ils")
            counts[name] = summary(self.case(PARTITIONED, f"count-{name}", *settings))["counters"]
        self.assertEqual(counts["nonlinear-elastic"]["mesh motion factorisations"], 4, "one a step")

    def test_solvers_of_the_harmonic_operator_are_refused(self):
        for program, options in ((MONOLITHIC, ("--set", "monolithic.linear_solver=amg_gmres")), (LINEAR_STUDY, ())):
            process = attempt(
                program,
                NEO_HOOKEAN,
                "-q",
                *options,
                folder=self.base / "refused",
                settings=self.settings + method("nonlinear-elastic"),
            )
            self.assertEqual(process.returncode, 1, process.stderr)
            self.assertIn('mesh_motion.method: "nonlinear-elastic" does not go with', process.stderr)
        amg = method("stiffened", "monolithic.linear_solver=amg_gmres", "newton.tolerance=1e-8")
        apart = difference(
            pressure(self.case(MONOLITHIC, "amg", *amg)),
            pressure(self.case(MONOLITHIC, "no-amg", *method("stiffened", "newton.tolerance=1e-8"))),
        ).max()
        self.assertLess(apart, 1e-6)


if __name__ == "__main__":
    unittest.main()
