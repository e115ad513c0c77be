"""Openings by name: a periodic pressure, a resistance, a Windkessel and flow rates, with both drivers."""

import csv
import unittest
from pathlib import Path

import numpy as np
from programs import DRIVERS, MONOLITHIC, PARTITIONED, FolderTest, arrays, attempt, energy, make_mesh, restart, run

CASE = Path(__file__).with_name("openings.toml")
SCHEMES = ("euler", "midpoint", "bdf2", "generalised-alpha", "tr-bdf2")
WINDKESSEL = {"proximal": 0.5, "compliance": 1.0, "distal": 2.0, "initial_pressure": 0.1}  # as in the case file

RIGID = """
title = "a rigid pipe"
element = "p2p1"
geometry = "axisymmetric"
[mesh]
level = "coarse"
[fluid]
density = 1.0
viscosity = 1.0
{openings}
[time]
step = {step}
end = {end}
scheme = "{scheme}"
[newton]
tolerance = 1e-11
[output]
every = 0
"""


def openings(folder):
    """{opening: rows of (time, flow, mean pressure, Windkessel pressure)} of openings.csv, pressures in kPa."""
    rows = {}
    with (folder / "openings.csv").open() as file:
        reader = csv.reader(file)
        header = next(reader)
        assert header == ["time_ms", "opening", "flow_mm3_per_ms", "mean_pressure_Pa", "windkessel_pressure_Pa"]
        for time, name, flow, mean, stored in reader:
            rows.setdefault(name, []).append((float(time), float(flow), float(mean) / 1000, float(stored) / 1000))
    return {name: np.array(values) for name, values in rows.items()}


class Artery(FolderTest):
    """Fluid and wall, six millimetres of the coarse section."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = make_mesh(cls.base / "section.msh", "--axisymmetric", "--level", "coarse", "--length", 6)
        cls.settings = (f"mesh.file={cls.mesh}",)
        cls.runs = {}

    @classmethod
    def march(cls, program, name, *settings):
        key = (program, name)
        if key not in cls.runs:
            folder = cls.base / f"{Path(program).name}-{name}"
            cls.runs[key] = run(program, CASE, folder, *cls.settings, *settings)
        return cls.runs[key]

    def test_drivers_agree(self):
        one, other = (openings(self.march(program, "whole")) for program in DRIVERS)
        self.assertEqual(list(one), ["inlet", "outlet"])
        for name in one:
            for column in (1, 2, 3):
                size = np.abs(one[name][:, column]).max()
                np.testing.assert_allclose(one[name][:, column], other[name][:, column], atol=1e-6 * size + 1e-12)
        self.assertGreater(np.abs(one["outlet"][:, 1]).max(), 0.05)

    def test_drivers_agree_with_a_flow_rate(self):
        """A flow rate in place of the pressure; generalised-alpha, whose pressures lag; a restart of it."""
        text = CASE.read_text().replace(
            'pressure = { file = "beat.csv" }', "flow_rate = [[0, 0], [0.375, 1], [0.75, 0]]"
        )
        case = self.base / "flow.toml"
        case.write_text(text.replace("[time]", '[time]\nscheme = "generalised-alpha"'))
        runs = []
        for program in DRIVERS:
            folder = run(program, case, self.base / f"{Path(program).name}-flow", *self.settings)
            part = run(program, case, self.base / f"{Path(program).name}-flow-part", *self.settings, "time.end=0.75")
            restart(program, case, part, *self.settings)
            self.assertEqual((part / "openings.csv").read_bytes(), (folder / "openings.csv").read_bytes())
            self.assertSameResults(part, folder)
            runs.append(openings(folder))
        for name in runs[0]:
            for column in (1, 2, 3):
                size = np.abs(runs[0][name][:, column]).max()
                np.testing.assert_allclose(runs[0][name][:, column], runs[1][name][:, column], atol=1e-6 * size)
        time, flow = runs[0]["inlet"][:, :2].T
        phase = time % 0.75
        np.testing.assert_allclose(-flow, np.minimum(phase, 0.75 - phase) / 0.375, atol=1e-9)

    def test_restarts_bit_for_bit(self):
        for program in DRIVERS:
            whole = self.march(program, "whole")
            part = run(program, CASE, self.base / f"{Path(program).name}-part", *self.settings, "time.end=0.75")
            restart(program, CASE, part, *self.settings)
            self.assertEqual((part / "openings.csv").read_bytes(), (whole / "openings.csv").read_bytes())
            self.assertSameResults(part, whole)

    def test_a_disturbed_table_is_not_continued(self):
        part = run(MONOLITHIC, CASE, self.base / "disturbed", *self.settings, "time.end=0.75")
        rows = (part / "openings.csv").read_text().splitlines(keepends=True)
        rows[1], rows[2] = rows[2], rows[1]
        (part / "openings.csv").write_text("".join(rows))
        refused = attempt(MONOLITHIC, CASE, "--restart", part, folder=part, settings=self.settings)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("openings.csv: line 2: is of 'outlet', not of 'inlet'", refused.stderr)

    def test_energy_is_balanced_by_every_scheme(self):
        for scheme in SCHEMES:
            columns = energy(self.march(MONOLITHIC, scheme, f'time.scheme="{scheme}"', "time.end=0.75"))
            size = np.abs(columns["inlet_work"]).max()
            self.assertLess(np.abs(columns["remainder"]).max(), 1e-6 * size, scheme)

    def test_windkessel_stores_what_flows(self):
        """C dp_c/dt = Q - p_c / R_d, integrated over each step by the trapezoidal rule: to second order in the step."""
        rows = openings(self.march(MONOLITHIC, "fine", "time.step=0.025"))["outlet"]
        time, flow, _, stored = rows.T
        step = np.diff(time)
        rate = flow - stored / WINDKESSEL["distal"]
        gained = np.cumsum(0.5 * step * (rate[1:] + rate[:-1])) / WINDKESSEL["compliance"]
        np.testing.assert_allclose(stored[1:] - stored[0], gained, atol=2e-3 * np.abs(stored).max())

    def test_a_surface_of_the_wall_is_no_opening(self):
        settings = (*self.settings, "opening.outer.pressure=1")
        refused = attempt(MONOLITHIC, CASE, folder=self.base / "outer", settings=settings)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("do not bound the fluid", refused.stderr)

    def test_flow_given_everywhere_needs_a_scheme_that_lets_the_wall_answer(self):
        """The wall takes up what does not leave: the monolithic driver and Robin-Neumann agree, Dirichlet-Neumann says no."""
        text = CASE.read_text().split("[[opening]]")[0] + "".join(
            f'[[opening]]\nsurface = "{name}"\nflow_rate = {rate}\n'
            for name, rate in (("inlet", "[[0, 0], [0.5, 0.5]]"), ("outlet", "[[0, 0], [0.5, -0.45]]"))
        )
        case = self.base / "everywhere.toml"
        case.write_text(text + "[time]\nstep = 0.125\nend = 0.5\n")
        one, other = (
            openings(run(program, case, self.base / f"{Path(program).name}-all", *self.settings, *tight))
            for program, tight in (
                (MONOLITHIC, ("newton.tolerance=1e-10",)),
                (PARTITIONED, ("partitioned.tolerance=1e-8",)),
            )
        )
        self.assertAlmostEqual(one["outlet"][-1, 1], 0.45, delta=1e-9)
        pressure = one["inlet"][:, 2]
        np.testing.assert_allclose(other["inlet"][:, 2], pressure, atol=1e-4 * np.abs(pressure).max())
        settings = (*self.settings, "partitioned.scheme=iqn-ils")
        refused = attempt(PARTITIONED, case, folder=self.base / "refused", settings=settings)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("its pressure is not determined", refused.stderr)


class RigidPipe(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = make_mesh(cls.base / "section.msh", "--axisymmetric", "--level", "coarse", "--length", 6)

    def flow(self, name, text, scheme="euler", step=100, end=300):
        """Rows of openings.csv of a pipe with these openings."""
        case = self.base / f"{name}.toml"
        case.write_text(RIGID.format(openings=text, scheme=scheme, step=step, end=end))
        folder = run(MONOLITHIC, case, self.base / name, f"mesh.file={self.mesh}")
        return openings(folder), folder

    def test_resistance_is_its_pressure(self):
        """With the resistance that the outlet's pressure over the flow is, the flow is the same; so it is with the
        equal Windkessel in its steady state, and in the flow between them Poiseuille's law adds the resistances."""
        inlet = '[[opening]]\nsurface = "inlet"\npressure = 0.5\n'
        rows, _ = self.flow("pressure", inlet + '[[opening]]\nsurface = "outlet"\npressure = 0.2\n')
        rate = rows["outlet"][-1, 1]
        self.assertGreater(rate, 0)
        self.assertAlmostEqual(rows["inlet"][-1, 1], -rate, delta=1e-9 * rate)
        resistance = 0.2 / rate
        kinds = {
            "resistance": f"resistance = {resistance!r}",
            "raised": f"resistance = {0.5 * resistance!r}\ndistal_pressure = 0.1",
            "windkessel": f"windkessel = {{ proximal = {0.25 * resistance!r}, compliance = 0.1, "
            f"distal = {0.75 * resistance!r} }}",
        }
        for name, kind in kinds.items():
            rows, _ = self.flow(name, f'{inlet}[[opening]]\nsurface = "outlet"\n{kind}\n')
            self.assertAlmostEqual(rows["outlet"][-1, 1], rate, delta=1e-7 * rate, msg=name)
        self.assertAlmostEqual(rows["outlet"][-1, 3], 0.75 * 0.2, delta=1e-7)
        # The pipe's own: 8 mu L / (pi R^4), but for the profile near the ends, which is free of traction there.
        own = (0.5 - 0.2) / rate
        self.assertAlmostEqual(own / (8 * 1.0 * 6 / (np.pi * 1.43**4)), 1, delta=0.05)

    def test_flow_rates_are_met_by_every_scheme(self):
        """What is let in at each time is the table's value there, and leaves at once; the energy is balanced."""
        inlet = '[[opening]]\nsurface = "inlet"\nflow_rate = [[0, 0], [1, 2], [2, 0]]\nperiod = 2\n'
        for scheme, profile in zip(SCHEMES, ("plug", "parabolic", "womersley", "parabolic", "womersley")):
            text = f'{inlet}profile = "{profile}"\n[[opening]]\nsurface = "outlet"\nresistance = 0.3\n'
            rows, folder = self.flow(f"{scheme}-{profile}", text, scheme, 0.125, 2.5)
            time, flow, _, _ = rows["inlet"].T
            phase = time % 2
            np.testing.assert_allclose(-flow, 2 * np.minimum(phase, 2 - phase), atol=1e-9, err_msg=scheme)
            np.testing.assert_allclose(rows["outlet"][:, 1], -flow, atol=1e-8, err_msg=scheme)
            columns = energy(folder)
            size = np.abs(columns["inlet_work"]).max()
            self.assertLess(np.abs(columns["remainder"]).max(), 1e-6 * size, scheme)

    def test_a_table_of_flow_may_begin_behind_the_start_of_its_period(self):
        """Before its first row it has that row's value, in Womersley's profile too."""
        found = []
        for name, rows in (("late", "[[0.5, 1], [1, 2], [2, 1]]"), ("early", "[[0, 1], [0.5, 1], [1, 2], [2, 1]]")):
            text = (
                f'[[opening]]\nsurface = "inlet"\nflow_rate = {rows}\nperiod = 2\nprofile = "womersley"\n'
                '[[opening]]\nsurface = "outlet"\n'
            )
            found.append(arrays(self.flow(name, text, "midpoint", 0.125, 0.5)[1] / "checkpoint.h5"))
        np.testing.assert_allclose(found[0]["arrays/level0.flow"], found[1]["arrays/level0.flow"], atol=1e-9)

    def test_the_log_says_what_periods_and_profiles_are_made_of(self):
        text = (
            '[[opening]]\nsurface = "inlet"\nflow_rate = [[0, 1], [1, 2], [2, 1]]\nperiod = 2\nprofile = "womersley"\n'
            '[[opening]]\nsurface = "outlet"\npressure = [[0, 0], [1, 0.1], [2, 0]]\nperiod = 2\n'
        )
        case = self.base / "periodic.toml"
        case.write_text(RIGID.format(openings=text, scheme="midpoint", step=0.5, end=2))
        settings = (f"mesh.file={self.mesh}", "output.every=4", "output.statistics=true")
        logs = [
            (run(MONOLITHIC, case, self.base / f"periodic{i}", *settings, *more) / "run.log").read_text()
            for i, more in enumerate(((), ("output.period=1",)))
        ]
        self.assertRegex(logs[0], r"the flow of inlet in Womersley's profile: its mean and [1-9]\d* harmonics")
        self.assertIn(
            "statistics over periods of 2 ms, that of opening.inlet.flow_rate, opening.outlet.pressure", logs[0]
        )
        self.assertIn("statistics over periods of 1 ms\n", logs[1])

    def test_what_openings_a_mesh_and_a_rigid_fluid_cannot_have(self):
        cases = {
            "opening.outlett: the mesh": '[[opening]]\nsurface = "outlett"\npressure = 1\n',
            "did you mean outlet?": '[[opening]]\nsurface = "outlett"\npressure = 1\n',
            "its pressure undetermined": "".join(
                f'[[opening]]\nsurface = "{name}"\nflow_rate = 1\n' for name in ("inlet", "outlet")
            ),
            "no such surface on the volumes": '[[opening]]\nsurface = "outer"\npressure = 1\n',
        }
        for message, text in cases.items():
            case = self.base / "refused.toml"
            case.write_text(RIGID.format(openings=text, scheme="euler", step=1, end=2))
            for program in DRIVERS:
                refused = attempt(program, case, folder=self.base / "refused", settings=(f"mesh.file={self.mesh}",))
                self.assertEqual(refused.returncode, 1, refused.stderr)
                self.assertIn(message, refused.stderr)
                self.assertEqual(refused.stderr.count("\n"), 1, refused.stderr)
                self.assertFalse((self.base / "refused" / "openings.csv").exists())


if __name__ == "__main__":
    unittest.main()
