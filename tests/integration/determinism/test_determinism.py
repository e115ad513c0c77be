"""The same input gives the same bits, whatever the number of threads: of both drivers, every element, coupling scheme and
linear solver."""

import unittest

from programs import ARTERY, DRIVERS, MONOLITHIC, PARTITIONED, FolderTest, by_turns, make_small_mesh, run, summary
from scenes import KINDS, forms, scene

SCHEMES = (
    "aitken",
    "constant",
    "explicit",
    "iqn-ils",
    "iqn-imvj",
    "newton-krylov",
    "robin-neumann",
    "robin-neumann-inexact",
    "robin-neumann-iqn",
    "robin-neumann-imvj",
    "robin-robin",
    "robin-robin-corrected",
    "robin-robin-parallel",
    "semi-implicit",
)
SOLVERS = ("fast", "direct")
THREADS = (1, 2, 4)
ONE_AND_ODD = (1, 3)  # shares of unequal size; where there are many combinations of methods
# The coupling stops far from convergence: whatever differs would be left in the results.
LOOSE = ("time.end=0.25", "partitioned.tolerance=1e-1", "output.every=1")


class Determinism(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = f"mesh.file={make_small_mesh(cls.base / 'small.msh')}"

    def assertSameBits(self, program, *settings, numbers=ONE_AND_ODD):
        """Runs with each number of threads, and twice with one of them, give the same bits."""
        runs = [(threads, "") for threads in numbers] + [(numbers[1], "-again")]
        folders = [
            run(program, ARTERY, self.base / f"{threads}{again}", *settings, *LOOSE, threads=threads)
            for threads, again in runs
        ]
        self.assertEqual([summary(folder)["threads"] for folder in folders], [threads for threads, _ in runs])
        for folder in folders[1:]:
            self.assertSameResults(folders[0], folder)

    def test_monolithic(self):
        for solver in (*SOLVERS, "amg_fgmres", "ilu_exact"):
            with self.subTest(solver=solver):
                self.assertSameBits(MONOLITHIC, self.mesh, f"monolithic.linear_solver={solver}", numbers=THREADS)

    def test_every_coupling_scheme(self):
        for scheme, solver in by_turns(SCHEMES, SOLVERS):
            # One pass a step holds where the wall is heavy.
            heavy = ("structure.density=1e5",) if scheme == "explicit" else ()
            # Without iterations time schemes that damp nothing are refused.
            heavy += ("time.scheme=euler",) if scheme.startswith("robin-robin") else ()
            settings = (f"partitioned.scheme={scheme}", f"partitioned.linear_solver={solver}", *heavy)
            with self.subTest(scheme=scheme, solver=solver):
                self.assertSameBits(PARTITIONED, self.mesh, *settings)

    def test_every_element(self):
        for (element, geometry), program, solver in by_turns(KINDS, DRIVERS, SOLVERS):
            settings = (*scene(self.base, element, geometry), *forms(ARTERY))
            section = "monolithic" if program == MONOLITHIC else "partitioned"
            with self.subTest(program=program, element=element, geometry=geometry, solver=solver):
                self.assertSameBits(program, *settings, f"{section}.linear_solver={solver}")


if __name__ == "__main__":
    unittest.main()
