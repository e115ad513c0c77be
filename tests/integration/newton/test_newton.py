"""Newton's method on the coupled system: its Jacobian is exact, and a kept one serves while it can."""

import unittest

from programs import (
    ARTERY,
    MONOLITHIC,
    MOONEY_RIVLIN,
    NEO_HOOKEAN,
    FolderTest,
    calls,
    difference,
    newton_history,
    pressure,
    run,
    summary,
)

STEPS = 12
TOLERANCE = 1e-8  # of the case files: last increment over first
# Rounding leaves increments of 1e-15 to 4e-15 and residuals (kPa mm^2; about 1 at the first start) of 1e-14, of which
# Newton's method has an estimate some ten times larger.
ROUNDING = 1e-12


class Newton(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.full, cls.kept = {}, {}
        for case in (NEO_HOOKEAN, MOONEY_RIVLIN, ARTERY):
            for mode, folders in (("full", cls.full), ("kept", cls.kept)):
                folders[case] = run(
                    MONOLITHIC,
                    case,
                    cls.base / f"{case.stem}-{mode}",
                    "time.end=1.5",
                    f"newton.mode={mode}",
                    "monolithic.linear_solver=direct",
                    "output.every=0",
                )

    def histories(self):
        for case, folder in self.full.items():
            history = newton_history(folder)
            self.assertEqual(len(history), STEPS)
            for step, iterations in enumerate(history, start=1):
                yield case, step, iterations

    def test_few_iterations_reach_the_tolerance(self):
        for case, step, iterations in self.histories():
            # From rest there is nothing to extrapolate; the artery's fibres switch on in the first step.
            most = 5 if step > 1 or case == ARTERY else 4
            with self.subTest(case=case.stem, step=step):
                self.assertLessEqual(len(iterations), most)
                increment, residual, *_ = iterations[-1]
                self.assertTrue(increment <= TOLERANCE * iterations[0][0] or residual <= ROUNDING, iterations)
                self.assertTrue(all(length == 1 for _, _, length, _ in iterations), "a step was cut")
                self.assertTrue(all(renewed for *_, renewed in iterations), "a Jacobian was kept")

    def test_increments_decay_quadratically(self):
        """increment_(k+1) <= C increment_k^2 in the last two iterations. C was at most 0.3, and 6 where fibres switch
        on, since the stress has a kink there. A Jacobian with an error contracts linearly: by a hundredth, say, which
        from an increment of 1e-4 needs C = 100."""
        for case, step, iterations in self.histories():
            largest = 20 if case == ARTERY else 1
            increments = [increment for increment, *_ in iterations]
            with self.subTest(case=case.stem, step=step):
                for before, after in list(zip(increments, increments[1:]))[-2:]:
                    self.assertLessEqual(after, max(largest * before**2, ROUNDING))

    def test_residual_falls_to_rounding(self):
        for case, step, iterations in self.histories():
            with self.subTest(case=case.stem, step=step):
                self.assertLess(iterations[-1][1], ROUNDING)

    def test_kept_jacobian_gives_the_same_pressures(self):
        for case in self.full:
            apart = difference(pressure(self.kept[case]), pressure(self.full[case]))
            print(f"{case.stem}: kept against full, relative, per step:", apart)
            # Chord iterations stop at an increment of 1e-8 of the step's first one and leave a few of these.
            self.assertLess(apart.max(), 1e-7)

    def test_full_mode_factorises_in_each_iteration(self):
        for folder in self.full.values():
            newton = summary(folder)["totals"]["newton_iterations"]
            self.assertEqual(newton, sum(len(iterations) for iterations in newton_history(folder)))
            for phase in ("assembly: coupled jacobian", "factorisation: coupled", "solve: coupled"):
                self.assertEqual(calls(folder)[phase], newton, phase)

    def test_kept_mode_factorises_when_the_log_says_so(self):
        for folder in self.kept.values():
            renewals = sum(renewed for step in newton_history(folder) for *_, renewed in step)
            self.assertEqual(calls(folder)["factorisation: coupled"], renewals)
            self.assertEqual(calls(folder)["assembly: coupled jacobian"], renewals)
            self.assertEqual(calls(folder)["solve: coupled"], summary(folder)["totals"]["newton_iterations"])

    def test_one_factorisation_serves_while_the_residual_keeps_falling(self):
        for case in (NEO_HOOKEAN, MOONEY_RIVLIN):
            self.assertEqual(calls(self.kept[case])["factorisation: coupled"], 1)
        # The fibres' switching makes some old Jacobians useless, not most of them.
        artery = self.kept[ARTERY]
        self.assertLess(calls(artery)["factorisation: coupled"], STEPS)
        self.assertGreater(calls(artery)["factorisation: coupled"], 1)


class Fast(FolderTest):
    """The default linear solver against the direct one on the coarse mesh, from the pulse on while its wave travels."""

    def runs(self, case):
        settings = ("time.end=2.5", "output.every=0", "output.checkpoint_every=0")
        direct = run(MONOLITHIC, case, self.base / f"{case.stem}-direct", "monolithic.linear_solver=direct", *settings)
        return direct, run(MONOLITHIC, case, self.base / f"{case.stem}-fast", *settings)

    def test_same_pressures_and_no_factorisation(self):
        for case in (NEO_HOOKEAN, MOONEY_RIVLIN, ARTERY):
            with self.subTest(case=case.stem):
                direct, fast = self.runs(case)
                apart = difference(pressure(fast), pressure(direct))
                print(f"{case.stem}: fast against direct, relative, largest of all steps:", apart.max())
                self.assertLess(apart.max(), 1e-6)
                self.assertNotIn("factorisation: coupled", calls(fast))
                totals = summary(fast)["totals"]
                self.assertEqual(summary(direct)["totals"]["linear_iterations"], 0)
                self.assertGreater(totals["linear_iterations"], totals["newton_iterations"])

    def test_inexact_newton_solves_only_as_far_as_it_pays(self):
        """Tight linear solves reach the same solution in more work."""
        settings = ("time.end=1", "output.every=0", "newton.mode=full")
        loose = run(MONOLITHIC, NEO_HOOKEAN, self.base / "loose", *settings)
        tight = run(MONOLITHIC, NEO_HOOKEAN, self.base / "tight", "linear.tolerance=1e-9", *settings)
        self.assertLess(difference(pressure(loose), pressure(tight)).max(), 1e-7)
        self.assertLess(summary(loose)["totals"]["linear_iterations"], summary(tight)["totals"]["linear_iterations"])
        self.assertGreater(summary(loose)["totals"]["newton_iterations"], summary(tight)["totals"]["newton_iterations"])


if __name__ == "__main__":
    unittest.main()
