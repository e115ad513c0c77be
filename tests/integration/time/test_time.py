"""The time axis: its end is hit, and named times; the load of a step is the mean of the pressure over it; the scheme that a
case without one has."""

import unittest

import numpy as np
from programs import (
    DRIVERS,
    MONOLITHIC,
    NEO_HOOKEAN,
    FolderTest,
    arrays,
    attempt,
    by_turns,
    make_mesh,
    make_small_mesh,
    restart,
    run,
    table,
    times,
)

PULSE, DURATION = 1.332, 0.125  # kPa, ms, of the paper's cases


class TimeAxis(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = f"mesh.file={make_small_mesh(cls.base / 'small.msh')}"

    def march(self, name, *settings):
        return run(MONOLITHIC, NEO_HOOKEAN, self.base / name, self.mesh, *settings)

    @staticmethod
    def ends(folder):
        return table(folder, "iterations.csv")[:, 1].tolist()

    def test_end_is_hit(self):
        for step, end, count in ((0.1, "0.3", 3), (0.125, "0.375", 3), (0.07, "0.49", 7)):  # 3 * 0.1 > 0.3 in doubles
            pulse = f"inlet.until={2 * step}"  # steps end where the load jumps
            folder = self.march(end, f"time.step={step}", f"time.end={end}", pulse, "output.every=1")
            self.assertEqual((len(times(folder)), times(folder)[-1]), (count, end))
            for name in ("centerline_pressure.csv", "wall_displacement.csv", "flow.csv"):
                self.assertEqual(table(folder, name)[-1, 0], float(end))
            self.assertEqual(arrays(folder / "checkpoint.h5")["time"][0], float(end))
            self.assertAlmostEqual(arrays(folder / "fields.h5")["steps/time"][-1], float(end), places=14)

    def test_an_end_between_steps_is_hit_by_two_shorter_ones(self):
        for program in DRIVERS:
            with self.subTest(program=program):
                settings = (self.mesh, "output.every=2")
                whole = run(program, NEO_HOOKEAN, self.base / "whole", *settings, "time.end=0.55")
                self.assertEqual(self.ends(whole), [0.125, 0.25, 0.375, 0.4625, 0.55])
                said = "the last steps have 0.0875 ms in place of 0.125 ms"
                self.assertEqual((whole / "run.log").read_text().count(said), 1)
                stopped = run(program, NEO_HOOKEAN, self.base / "stopped", *settings, "time.end=0.25")
                restart(program, NEO_HOOKEAN, stopped, *settings, "time.end=0.55")
                self.assertSameResults(stopped, whole)
                # From an end between steps new ones begin.
                restart(program, NEO_HOOKEAN, stopped, *settings, "time.end=0.8")
                self.assertEqual(self.ends(stopped), [0.125, 0.25, 0.375, 0.4625, 0.55, 0.675, 0.8])

    def test_the_shortest_end_is_a_step(self):
        process = attempt(MONOLITHIC, NEO_HOOKEAN, folder=self.base / "off", settings=(self.mesh, "time.end=0.1"))
        self.assertEqual(process.returncode, 1)
        self.assertIn("time.end: 0.1 is less than one step of 0.125", process.stderr)
        self.assertFalse((self.base / "off").exists())

    def test_steps_end_at_named_times(self):
        """With equal and with adaptive steps, in fields.h5, too, and after a restart with the same bits."""
        adaptive = ("time.step=adaptive", "time.tolerance=0.3", "time.first_step=0.03")
        kinds = (("equal", ()), ("adaptive", (*adaptive, "output.interval=0.25")))
        for (kind, more), program in by_turns(kinds, DRIVERS):
            with self.subTest(program=program, steps=kind):
                settings = (self.mesh, "output.every=3", "output.times=[0.2,0.4]", *more)
                whole = run(program, NEO_HOOKEAN, self.base / "named", *settings, "time.end=0.75")
                ends = self.ends(whole)
                for time in (0.125, 0.2, 0.4, 0.75):
                    self.assertIn(time, ends)
                entries = arrays(whole / "fields.h5")["steps/time"].tolist()
                if kind == "equal":
                    self.assertEqual(ends, [0.125, 0.2, 0.3, 0.4, 0.525, 0.65, 0.75])
                    self.assertEqual(entries, [0, 0.2, 0.3, 0.4, 0.65, 0.75])
                else:
                    self.assertEqual(entries, [0, 0.2, 0.25, 0.4, 0.5, 0.75])
                stopped = run(program, NEO_HOOKEAN, self.base / "stopped", *settings, "time.end=0.4")
                restart(program, NEO_HOOKEAN, stopped, *settings, "time.end=0.75")
                self.assertEqual(self.ends(stopped), ends)
                self.assertSameResults(stopped, whole)

    def test_steps_around_the_pulse_see_the_same_impulse(self):
        """The step is twice as long as the pulse, as long, or half as long. Were the pressure sampled instead of
        averaged, the first would see no pulse at all, or one of twice the impulse."""
        flows = [
            table(self.march(f"pulse{step}", f"time.step={step}", "time.end=0.25"), "flow.csv")[-1, 1]
            for step in (0.25, 0.125, 0.0625)
        ]
        print("inlet flow at 0.25 ms:", flows)
        np.testing.assert_allclose(flows, flows[-1], rtol=0.3)  # first order in 0.25 ms, early in a wave of 1 ms


AXISYMMETRIC = NEO_HOOKEAN.parent / "axisymmetric" / "neo-hookean.toml"  # names no scheme


class Scheme(FolderTest):
    """The scene's rate is 0.2/ms: 1/8 ms is short, 1 ms long."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_mesh(cls.base / "section.msh", "--axisymmetric", "--for", "p2p1", "--error", "5%")
        cls.settings = (f"mesh.file={mesh}", "output.every=0")

    def march(self, name, *settings, before=None):
        """The log and the error stream of a run, or of one that goes on in its folder."""
        options = ("--restart", self.base / name) if before else ("--force",)
        process = attempt(
            MONOLITHIC, AXISYMMETRIC, "-q", *options, folder=self.base / name, settings=(*self.settings, *settings)
        )
        self.assertEqual(process.returncode, 0, process.stderr)
        log = (self.base / name / "run.log").read_text()
        return (log[len(before) :] if before else log), process.stderr

    def test_is_chosen_for_the_length_of_the_steps(self):
        log, said = self.march("short", "time.step=0.125", "time.end=0.5")
        self.assertIn("time scheme: midpoint, chosen", log)
        self.assertIn("midpoint rule, theta = 0.52", log)
        self.assertEqual(said, "")
        # A run that goes on keeps its scheme. What that costs is said.
        later, said = self.march("short", "time.step=0.5", "time.end=2.5", before=log)
        self.assertIn("time scheme: midpoint, that of the run so far", later)
        self.assertIn("midpoint rule, theta = 0.5625", later)
        self.assertEqual(said.count("the midpoint rule has theta = 0.562"), 1)
        self.assertEqual(later.count("the midpoint rule has theta = 0.562"), 1)

        log, said = self.march("long", "time.step=1", "time.end=2")
        self.assertIn("time scheme: tr-bdf2, chosen because steps of 1 ms are long", log)
        self.assertEqual(said, "")
        later, said = self.march("long", "time.step=0.125", "time.end=2.5", before=log)
        self.assertIn("time scheme: tr-bdf2, that of the run so far", later)
        self.assertEqual(said, "")

    def test_warns_once_where_the_order_is_lost(self):
        for settings, theta in ((("time.scheme=midpoint",), 0.562), (("time.damping=0.3",), 0.8)):
            log, said = self.march(f"lost{theta}", "time.step=1", "time.end=2", *settings)
            for text in (log, said):
                self.assertEqual(text.count(f"the midpoint rule has theta = {theta} and"), 1, text)
        log, said = self.march("kept", "time.step=1", "time.end=2", "time.damping=0.05")
        self.assertIn("theta = 0.5500", log)
        self.assertEqual(said, "")

    def test_of_steps_of_different_length_gives_the_range_of_theta(self):
        log, _ = self.march("range", "time.step=0.125", "time.end=0.55")
        self.assertRegex(log, r"steps of 0.0875 to 0.125 ms: midpoint rule, theta = 0.51\d+ to 0.52\d+")


class Impulse(FolderTest):
    """In a rigid pipe, viscosity negligible, the flow is the impulse, Q = A/(rho L) int p dt, whatever the step."""

    def flow(self, name, step, *settings):
        folder = run(MONOLITHIC, self.case, self.base / name, f"time.step={step}", *settings)
        return table(folder, "flow.csv")[-1, 1]

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_mesh(cls.base / "pipe.msh", "--size", 0.35, "--axial-size", 1.0, "--length", 12)
        cls.case = cls.base / "pipe.toml"
        cls.case.write_text(
            f"""
            mesh.file = "{mesh.name}"
            fluid = {{density = 1.0, viscosity = 1e-4}}
            inlet = {{pressure = {PULSE}, until = {DURATION}}}
            time = {{step = 0.125, end = 0.5}}
            output.every = 0
            """
        )

    def test_does_not_depend_on_the_step(self):
        flows = [self.flow(f"step{step}", step) for step in (0.5, 0.25, 0.1, 0.125, 0.0625, 0.03125)]
        print("flow at 0.5 ms:", flows)
        np.testing.assert_allclose(flows[1:], flows[-1], rtol=0.005)
        # Under pressure still, which the single step is, the stabilisation lets a little more through.
        np.testing.assert_allclose(flows[0], flows[-1], rtol=0.1)

    def test_is_that_of_the_pressure(self):
        """In the layer of elements at the wall the velocity falls to zero: with a quarter of the radius each, they take
        a fifth of the flow away."""
        ideal = np.pi * 1.43**2 * PULSE * DURATION / (1.0 * 12)
        ratio = self.flow("ideal", 0.0625) / ideal
        print("flow over that of an ideal fluid:", ratio)
        self.assertTrue(0.75 < ratio < 1.0, ratio)

    def test_table_of_the_same_impulse(self):
        """A triangle of the same area, its corners off the steps."""
        table_ = f"inlet.pressure=[[0, 0], [0.11, {2 * PULSE * DURATION / 0.29}], [0.29, 0]]"
        np.testing.assert_allclose(self.flow("triangle", 0.125, table_), self.flow("pulse", 0.125), rtol=0.02)

    def test_pressure_stays_without_end(self):
        steady = self.flow("steady", 0.125, f"inlet.pressure=[[0, {PULSE}]]")
        self.assertAlmostEqual(steady / self.flow("pulse4", 0.125), 0.5 / DURATION, delta=0.1)


if __name__ == "__main__":
    unittest.main()
