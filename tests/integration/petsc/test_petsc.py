"""Linear systems by PETSc, from the case file to the results: what it finds, what it refuses."""

import unittest

import numpy as np
from programs import MONOLITHIC, NEO_HOOKEAN, PARTITIONED, FolderTest, attempt, difference, make_small_mesh, pressure
from programs import restart, run

END = 0.375  # ms, three steps


class Petsc(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = f"mesh.file={make_small_mesh(cls.base / 'tube.msh')}"
        cls.exact = pressure(cls.solve("direct", "direct"))

    @classmethod
    def solve(cls, name, solver, *settings, end=END, **how):
        tight = ("newton.tolerance=1e-10", f"monolithic.linear_solver={solver}", f"time.end={end}")
        return run(MONOLITHIC, NEO_HOOKEAN, cls.base / name, cls.mesh, *tight, "output.every=0", *settings, **how)

    def expect_exact(self, folder):
        self.assertLess(difference(pressure(folder), self.exact).max(), 1e-8, folder)

    def refusal(self, *settings, program=MONOLITHIC, **how):
        folder = self.base / "refused"
        finished = attempt(program, NEO_HOOKEAN, "-q", folder=folder, settings=(self.mesh, *settings), **how)
        self.assertEqual(finished.returncode, 1, finished.stderr)
        return finished.stderr

    def test_one_process(self):
        self.expect_exact(self.solve("petsc", "petsc"))

    def test_options_change_the_way_but_not_the_answer(self):
        self.expect_exact(self.solve("jacobi", "petsc", "petsc.options=-fsi_velocity_pc_type pbjacobi"))

    def test_a_restart_goes_on_with_the_same_bits(self):
        whole = self.solve("whole", "petsc")
        first = self.solve("first", "petsc", end=END / 3)
        tight = ("newton.tolerance=1e-10", "monolithic.linear_solver=petsc", f"time.end={END}")
        restart(MONOLITHIC, NEO_HOOKEAN, first, self.mesh, *tight, "output.every=0")
        np.testing.assert_array_equal(pressure(first), pressure(whole))

    def test_two_processes(self):
        velocity = "petsc.options=-fsi_velocity_pc_type pbjacobi"
        for name, solver, said, *settings in (
            ("fast", "fast", "linear solver: fast, where it iterates preconditioned by block-factors"),
            ("simple", "fast", "preconditioned by simple", "linear.preconditioner=simple"),
            ("options", "fast", '"petsc" in place of "fast", since the case has [petsc] options', velocity),
            ("petsc", "petsc", "linear solver: petsc"),
            ("direct", "direct", "MUMPS"),
        ):
            folder = self.solve(f"two-{name}", solver, "linear.direct_below=0", *settings, processes=2)
            self.expect_exact(folder)
            self.assertEqual((folder / "run.log").read_text().count(said), 1, name)

    def test_two_processes_refuse_the_solvers_of_the_paper(self):
        said = self.refusal("monolithic.linear_solver=amg_fgmres", processes=2)
        self.assertIn('monolithic.linear_solver: "amg_fgmres" works on one process', said)

    def test_options_that_are_none(self):
        for options, said in (
            ("-ksp_type gmres", 'options has "-ksp_type"; give options that begin with -fsi_'),
            ("-fsi_ksp_rtol 1e-3", "linear.tolerance"),
            ("-fsi_velocity_pc_sor_itz 3", '"-fsi_velocity_pc_sor_itz" is no option'),
            ("-fsi_ksp_type gmress", "gmress"),
        ):
            for program, section in ((MONOLITHIC, "monolithic"), (PARTITIONED, "partitioned")):
                found = self.refusal(f"petsc.options={options}", f"{section}.linear_solver=petsc", program=program)
                self.assertIn(": petsc", found)
                self.assertIn(said, found)


if __name__ == "__main__":
    unittest.main()
