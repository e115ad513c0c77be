"""The time axis: its end is hit, and the load of a step is the mean of the pressure over it."""

import unittest

import numpy as np
from programs import MONOLITHIC, NEO_HOOKEAN, FolderTest, arrays, attempt, make_mesh, make_small_mesh, run, table, times

PULSE, DURATION = 1.332, 0.125  # kPa, ms, of the paper's cases


class TimeAxis(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = f"mesh.file={make_small_mesh(cls.base / 'small.msh')}"

    def march(self, name, *settings):
        return run(MONOLITHIC, NEO_HOOKEAN, self.base / name, self.mesh, *settings)

    def test_end_is_hit(self):
        for step, end, count in ((0.1, "0.3", 3), (0.125, "0.375", 3), (0.07, "0.49", 7)):  # 3 * 0.1 > 0.3 in doubles
            pulse = f"inlet.until={2 * step}"  # steps end where the load jumps
            folder = self.march(end, f"time.step={step}", f"time.end={end}", pulse, "output.every=1")
            self.assertEqual((len(times(folder)), times(folder)[-1]), (count, end))
            for name in ("centerline_pressure.csv", "wall_displacement.csv", "flow.csv"):
                self.assertEqual(table(folder, name)[-1, 0], float(end))
            self.assertEqual(arrays(folder / "checkpoint.h5")["time"][0], float(end))
            self.assertAlmostEqual(arrays(folder / "fields.h5")["steps/time"][-1], float(end), places=14)

    def test_end_off_the_steps_is_refused(self):
        for end in ("0.3", "0.1"):
            settings = (self.mesh, f"time.end={end}")
            process = attempt(MONOLITHIC, NEO_HOOKEAN, folder=self.base / "off", settings=settings)
            self.assertEqual(process.returncode, 1)
            self.assertIn("time.end", process.stderr)
            self.assertFalse((self.base / "off").exists())

    def test_steps_around_the_pulse_see_the_same_impulse(self):
        """The step is twice as long as the pulse, as long, or half as long. Were the pressure sampled instead of
        averaged, the first would see no pulse at all, or one of twice the impulse."""
        flows = [
            table(self.march(f"pulse{step}", f"time.step={step}", "time.end=0.25"), "flow.csv")[-1, 1]
            for step in (0.25, 0.125, 0.0625)
        ]
        print("inlet flow at 0.25 ms:", flows)
        np.testing.assert_allclose(flows, flows[-1], rtol=0.3)  # first order in 0.25 ms, early in a wave of 1 ms


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
