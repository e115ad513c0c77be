"""Networks of lumped elements behind openings: both drivers, every scheme, restarts, processes, closed loops, mistakes."""

import csv
import unittest
from pathlib import Path

import numpy as np
from programs import DRIVERS, MONOLITHIC, PARTITIONED, FolderTest, attempt, make_mesh, restart, run

CASE = Path(__file__).with_name("circulation.toml")
ARTERY = Path(__file__).parents[1] / "openings" / "openings.toml"  # between a pressure and a Windkessel
SCHEMES = ("euler", "midpoint", "bdf2", "generalised-alpha", "tr-bdf2")
WINDKESSEL = "windkessel = { proximal = 0.5, compliance = 1.0, distal = 2.0, initial_pressure = 0.1 }\n"
SAME = """
[[network.element]]
name = "first"
kind = "resistor"
between = ["outlet", "arteries"]
resistance = 0.5
[[network.element]]
name = "compliance"
kind = "capacitor"
between = ["arteries", "ground"]
compliance = 1.0
initial_pressure = 0.1
[[network.element]]
name = "second"
kind = "resistor"
between = ["arteries", "ground"]
resistance = 2.0
"""
JOINED = """
[[opening]]
surface = "inlet"
[[opening]]
surface = "outlet"
[[network.element]]
name = "pump"
kind = "flow"
between = ["ground", "tank"]
flow_rate = [[0, 0], [0.5, 1], [1, 0]]
[[network.element]]
name = "tank"
kind = "capacitor"
between = ["tank", "ground"]
compliance = 0.2
[[network.element]]
name = "inertia"
kind = "inductor"
between = ["inlet", "tank"]
inertance = 0.05
[[network.element]]
name = "back"
kind = "resistor"
between = ["outlet", "tank"]
resistance = 0.3
[[network.element]]
name = "leak"
kind = "resistor"
between = ["outlet", "ground"]
resistance = 5
[time]
"""


def rows_of(folder, name):
    """{name in the second column: rows of numbers, the time first, NaN where there is none} of a table."""
    rows = {}
    with (folder / name).open() as file:
        reader = csv.reader(file)
        next(reader)
        for time, of, *values in reader:
            rows.setdefault(of, []).append([float(time), *(float(value) if value else np.nan for value in values)])
    return {of: np.array(values) for of, values in rows.items()}


def stored(folder):
    """Times, and the sum of the volumes in the network."""
    elements = rows_of(folder, "network.csv").values()
    volumes = [rows[:, 4] for rows in elements if not np.isnan(rows[:, 4]).any()]
    return next(iter(elements))[:, 0], np.sum(volumes, axis=0)


class Networks(FolderTest):
    """Six millimetres of the coarse section of the artery."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = make_mesh(cls.base / "section.msh", "--axisymmetric", "--level", "coarse", "--length", 6)
        cls.settings = (f"mesh.file={cls.mesh}",)
        cls.runs = {}

    @classmethod
    def march(cls, program, name="whole", *settings, case=CASE, **how):
        key = (program, name)
        if key not in cls.runs:
            folder = cls.base / f"{Path(program).name}-{name}"
            cls.runs[key] = run(program, case, folder, *cls.settings, *settings, **how)
        return cls.runs[key]

    def assert_alike(self, one, other, share, tables=("network.csv", "openings.csv")):
        for table in tables:
            a, b = rows_of(one, table), rows_of(other, table)
            self.assertEqual(list(a), list(b))
            sizes = np.max([np.abs(np.nan_to_num(rows)).max(axis=0) for rows in b.values()], axis=0)
            for name in a:
                for column in range(1, a[name].shape[1]):
                    np.testing.assert_allclose(
                        a[name][:, column],
                        b[name][:, column],
                        rtol=0,
                        atol=share * sizes[column],
                        err_msg=f"{table} {name}",
                    )

    def test_a_windkessel_of_elements_is_a_windkessel(self):
        text = ARTERY.read_text()
        self.assertIn(WINDKESSEL, text)
        case = self.base / "elements.toml"
        case.write_text(text.replace(WINDKESSEL, SAME))
        (self.base / "beat.csv").write_bytes(ARTERY.with_name("beat.csv").read_bytes())
        for scheme in SCHEMES:
            for program in DRIVERS if scheme == "midpoint" else DRIVERS[:1]:
                settings = (f'time.scheme="{scheme}"', "time.end=0.75")
                one = self.march(program, f"windkessel-{scheme}", *settings, case=ARTERY)
                other = self.march(program, f"elements-{scheme}", *settings, case=case)
                for name, rows in rows_of(one, "openings.csv").items():
                    same = rows_of(other, "openings.csv")[name]
                    for column in (1, 2):
                        size = np.abs(rows[:, column]).max()
                        np.testing.assert_allclose(rows[:, column], same[:, column], rtol=0, atol=1e-9 * size)
                kept = rows_of(one, "openings.csv")["outlet"][:, 3]
                np.testing.assert_allclose(
                    rows_of(other, "network.csv")["compliance"][:, 2], kept, rtol=0, atol=1e-9 * np.abs(kept).max()
                )

    def test_a_loop_with_a_ventricle_runs_alike_in_both_drivers(self):
        one, other = (self.march(program) for program in DRIVERS)
        self.assert_alike(one, other, 1e-8)
        flow = rows_of(one, "network.csv")["aortic"][:, 1]
        self.assertGreater(flow.max(), 0.3)
        self.assertLess(np.abs(flow[30:45]).max(), 1e-3 * flow.max())  # closed from 62 to 90 ms

    def test_what_leaves_the_network_is_in_the_tube(self):
        """Backward Euler: what the network gains in a step is the flow out of the tube at its end."""
        folder = self.march(MONOLITHIC, "euler", 'time.scheme="euler"')
        time, volume = stored(folder)
        openings = rows_of(folder, "openings.csv")
        gained = 2 * np.cumsum(openings["inlet"][:, 1] + openings["outlet"][:, 1])  # steps of 2 ms
        start = 250.0
        np.testing.assert_allclose(volume - start, gained, rtol=0, atol=1e-10 * start)
        self.assertGreater(np.abs(gained).max(), 1)  # the tube widens
        self.assertEqual(len(time), 60)

    def rigid(self):
        """The same loop without the wall."""
        first, rest = CASE.read_text().split("[structure]")
        case = self.base / "rigid.toml"
        case.write_text(first + rest[rest.index("[[opening]]") :])
        return case

    def test_a_loop_with_a_rigid_tube_keeps_its_volume(self):
        for program, scheme in ((MONOLITHIC, "midpoint"), (MONOLITHIC, "generalised-alpha"), (PARTITIONED, "bdf2")):
            folder = self.march(program, f"rigid-{scheme}", f'time.scheme="{scheme}"', case=self.rigid())
            _, volume = stored(folder)
            np.testing.assert_allclose(volume, 250.0, rtol=0, atol=1e-10 * 250)
            ventricle = rows_of(folder, "network.csv")["ventricle"][:, 4]
            self.assertGreater(np.ptp(ventricle), 10)

    def test_restarts_bit_for_bit(self):
        for program in DRIVERS:
            whole = self.march(program)
            part = run(program, CASE, self.base / f"{Path(program).name}-part", *self.settings, "time.end=30")
            restart(program, CASE, part, *self.settings)
            for table in ("network.csv", "openings.csv"):
                self.assertEqual((part / table).read_bytes(), (whole / table).read_bytes(), table)
            self.assertSameResults(part, whole)

    def joined(self):
        """Inlet and outlet by one network, with a pump, and inertia right behind the inlet."""
        text = CASE.read_text()
        case = self.base / "joined.toml"
        case.write_text(text[: text.index("[[opening]]")] + JOINED + text[text.index("[time]") + 6 :])
        return case, ("time.step=0.1", "time.end=1")

    def test_two_openings_are_joined(self):
        case, settings = self.joined()
        one, other = (self.march(program, "joined", *settings, case=case) for program in DRIVERS)
        self.assert_alike(one, other, 1e-8)
        again = self.march(
            PARTITIONED, "joined-iqn", *settings, 'partitioned.scheme="iqn-ils"', 'time.scheme="euler"', case=case
        )
        self.assert_alike(
            again, self.march(MONOLITHIC, "joined-euler", *settings, 'time.scheme="euler"', case=case), 1e-6
        )
        inertia, inlet = rows_of(one, "network.csv")["inertia"], rows_of(one, "openings.csv")["inlet"]
        np.testing.assert_allclose(inertia[:, 1], inlet[:, 1], rtol=0, atol=1e-9 * np.abs(inlet[:, 1]).max())

    def test_solvers_and_processes_agree(self):
        case, settings = self.joined()
        whole = self.march(MONOLITHIC, "joined", *settings, case=case)
        for name, more, how in (
            ("direct", ('monolithic.linear_solver="direct"',), {}),
            ("iterative", ("linear.direct_below=0",), {}),
            ("petsc", ('monolithic.linear_solver="petsc"',), {}),
            ("two", (), {"processes": 2}),
            ("three", (), {"processes": 3}),
        ):
            self.assert_alike(self.march(MONOLITHIC, name, *settings, *more, case=case, **how), whole, 1e-7)
        for processes in (2, 3):
            shared = self.march(PARTITIONED, f"shared{processes}", *settings, case=case, processes=processes)
            self.assert_alike(shared, whole, 1e-7)

    def test_a_valve_that_chatters_is_named(self):
        """Long steps in a rigid tube with much flow, and few iterations for them."""
        sizes = {
            "ventricle": {"period": 300, "peak": 100, "relaxed": 150, "initial_volume": 2500},
            "aortic": {"resistance": 0.02},
            "proximal": {"resistance": 0.1},
            "arteries": {"initial_pressure": 10},
            "veins": {"initial_pressure": 1},
            "mitral": {"resistance": 0.01},
        }
        of_network = [f"network.element.{name}.{key}={x}" for name, keys in sizes.items() for key, x in keys.items()]
        settings = (*self.settings, *of_network, "time.step=10", "time.end=300", "time.retries=0")
        settings += ("newton.tolerance=1e-3",)
        failed = attempt(
            MONOLITHIC, self.rigid(), folder=self.base / "chatters", settings=(*settings, "newton.max_iterations=5")
        )
        self.assertEqual(failed.returncode, 2)
        self.assertRegex(failed.stderr, r"network\.element\.aortic opened and closed \d+ times in its iterations")
        self.assertIn("a larger width or leak of that valve", failed.stderr)

    def test_check_says_what_the_network_is(self):
        said = attempt(MONOLITHIC, CASE, "--check", settings=self.settings)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("2 openings, 3 other nodes, 7 elements in 2 loops, closed, 250 mm^3 at the start", said.stdout)
        refused = attempt(
            MONOLITHIC, CASE, "--check", settings=(*self.settings, 'network.element.aortic.kind="valvee"')
        )
        self.assertEqual(refused.returncode, 1)
        self.assertIn("--set: network.element.aortic.kind", refused.stderr)


if __name__ == "__main__":
    unittest.main()
