"""Runs that end when they have become periodic, and Windkessels that begin so."""

import csv
import re
import unittest
from pathlib import Path

import numpy as np
from programs import (
    DRIVERS,
    MONOLITHIC,
    PARTITIONED,
    FolderTest,
    arrays,
    attempt,
    make_mesh,
    restart,
    run,
    summary,
    times,
)

CASE = Path(__file__).with_name("periodic_end.toml")
PERIOD, PHASES = 12, 32
SECTION = ("--axisymmetric", "--level", "coarse", "--length", 6)

RIGID = """
title = "A rigid pipe and a Windkessel"
element = "p2p1"
geometry = "axisymmetric"
[mesh]
level = "coarse"
[fluid]
density = 1.0
viscosity = 0.1
[[opening]]
surface = "inlet"
flow_rate = [[0, 0], [3, 1], [6, 0.3], [12, 0]]
period = 12
[[opening]]
surface = "outlet"
windkessel = { proximal = 0.5, compliance = 16, distal = 5 }
[time]
step = 0.25
end = 1200
periods = "until 1%"
scheme = "euler"
[output]
every = 0
energy = false
"""


def mean_around(time, value, phase):
    """Values linear between steps, weighted by a hat up to the phases on both sides: by Simpson's rule, exactly."""
    width = PERIOD / PHASES
    at = phase + width * np.linspace(-1, 1, 2 * 6 + 1)  # steps of 0.25 ms end on every fourth of these
    at = at[at >= 0]
    weight = (1 - np.abs(at - phase) / width) * np.append(np.tile([2.0, 4.0], len(at) // 2), 1.0)
    weight[0] /= 2
    return np.sum(weight * np.interp(at, time, value)) / np.sum(weight)


def changes_in_tables(folder):
    """Changes of pressure and flow from the second period on, as openings.csv has them."""
    series = {}
    with (folder / "openings.csv").open() as file:
        for row in csv.DictReader(file):
            for column in ("mean_pressure_Pa", "flow_mm3_per_ms"):
                series.setdefault((column, row["opening"]), []).append((float(row["time_ms"]), float(row[column])))
    count = int(round(max(t for t, _ in series["flow_mm3_per_ms", "inlet"]) / PERIOD))
    found = {}
    for column in ("mean_pressure_Pa", "flow_mm3_per_ms"):
        beats = []
        for (name, _), values in series.items():
            if name == column:
                time, value = np.transpose([(0, np.nan), *values])
                value[0] = value[1]  # the state at rest is in no table; it belongs to the first period only
                means = [mean_around(time, value, i * PERIOD / PHASES) for i in range(PHASES * count)]
                beats.append(np.reshape(means, (count, PHASES)))
        ranges = np.max([beat.max(axis=1) - beat.min(axis=1) for beat in beats], axis=0)
        differences = np.max([np.abs(np.diff(beat, axis=0)).max(axis=1) for beat in beats], axis=0)
        found[column] = differences / ranges[1:]
    return found


class PeriodicEnd(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_mesh(cls.base / "small.msh", *SECTION)
        cls.settings = (f"mesh.file={mesh}",)
        cls.whole = run(MONOLITHIC, CASE, cls.base / "whole", *cls.settings)

    def test_a_run_ends_after_the_first_period_that_repeats_the_one_before(self):
        said = summary(self.whole)
        periodicity = said["periodicity"]
        self.assertTrue(periodicity["reached"])
        self.assertEqual(said["status"], "done")
        self.assertEqual(float(times(self.whole)[-1]), periodicity["changes"][-1]["end_ms"])
        largest = [max(c["pressure"], c["flow"], c["displacement"]) for c in periodicity["changes"]]
        self.assertGreater(len(largest), 2)
        distances = [c.get("distance", np.inf) for c in periodicity["changes"]]
        self.assertTrue(all(max(pair) > 0.01 for pair in zip(largest[:-1], distances[:-1])), (largest, distances))
        self.assertLessEqual(max(largest[-1], distances[-1]), 0.01)

    def test_changes_are_those_of_the_tables(self):
        found = changes_in_tables(self.whole)
        said = summary(self.whole)["periodicity"]["changes"]
        # The second period's first phase is compared with the state at rest.
        for key, column in (("pressure", "mean_pressure_Pa"), ("flow", "flow_mm3_per_ms")):
            np.testing.assert_allclose([c[key] for c in said[1:]], found[column][1:], rtol=1e-6, err_msg=key)

    def test_the_partitioned_driver_ends_at_the_same_time(self):
        folder = run(PARTITIONED, CASE, self.base / "partitioned", *self.settings)
        a, b = (summary(run)["periodicity"]["changes"] for run in (self.whole, folder))
        self.assertEqual(len(a), len(b))
        for mine, other in zip(a, b):
            for key in mine:
                self.assertAlmostEqual(mine[key], other[key], delta=1e-4 * mine[key] + 1e-6)

    def test_a_restart_compares_with_the_period_before(self):
        folder = run(MONOLITHIC, CASE, self.base / "part", *self.settings, "time.end=37")
        self.assertIn("not periodic within 1 %", (folder / "run.log").read_text())
        self.assertFalse(summary(folder)["periodicity"]["reached"])
        restart(MONOLITHIC, CASE, folder, *self.settings)
        self.assertEqual(summary(folder)["periodicity"], summary(self.whole)["periodicity"])
        self.assertEqual((folder / "openings.csv").read_bytes(), (self.whole / "openings.csv").read_bytes())

    def test_what_has_ended_goes_on_when_less_change_is_asked_for(self):
        end = times(self.whole)[-1]
        folder = restart(MONOLITHIC, CASE, self.whole, *self.settings, into=self.base / "again")
        self.assertEqual(times(folder)[-1], end, "nothing is left to do")
        restart(MONOLITHIC, CASE, folder, *self.settings, 'time.periods="until 0.1%"')
        self.assertGreater(float(times(folder)[-1]), float(end))

    def test_a_lumped_start_needs_fewer_periods(self):
        """A rigid pipe whose Windkessel takes seven periods to forget its start."""
        rigid = self.base / "rigid.toml"
        rigid.write_text(RIGID)
        ends = {}
        for start in ("given", "lumped"):
            folder = run(MONOLITHIC, rigid, self.base / start, *self.settings, f'time.start="{start}"')
            self.assertTrue(summary(folder)["periodicity"]["reached"])
            self.assertEqual({c["displacement"] for c in summary(folder)["periodicity"]["changes"]}, {0})
            ends[start] = round(float(times(folder)[-1]) / PERIOD)
        self.assertGreater(ends["given"], 20)
        self.assertLessEqual(ends["lumped"], 3)
        said = re.search(r"outlet starts from (\S+) kPa behind it", (folder / "run.log").read_text())
        with (folder / "openings.csv").open() as file:
            last = [row for row in csv.DictReader(file) if row["opening"] == "outlet"][-1]
        self.assertAlmostEqual(
            float(last["windkessel_pressure_Pa"]) / 1000, float(said[1]), delta=0.01 * float(said[1])
        )

    def test_a_lumped_start_finds_all_that_a_law_keeps(self):
        """With the flow through an inertance, too, every period is the same: L/R_p is longer than two of them."""
        four = self.base / "four.toml"
        four.write_text(
            RIGID.replace("windkessel = { proximal = 0.5,", "windkessel4 = { proximal = 0.5, inertance = 15,").replace(
                'periods = "until 1%"\n', 'start = "lumped"\n'
            )
        )
        folder = run(MONOLITHIC, four, self.base / "four", *self.settings, "time.end=24")
        with (folder / "openings.csv").open() as file:
            rows = [row for row in csv.DictReader(file) if row["opening"] == "outlet"]
        for column in ("mean_pressure_Pa", "windkessel_pressure_Pa"):
            first, second = (np.array([float(row[column]) for row in rows[at : at + 48]]) for at in (0, 48))
            np.testing.assert_allclose(first[1:], second[1:], rtol=0.01)
        settings = [*self.settings, "opening.outlet.windkessel4.initial_flow=1"]
        refused = attempt(MONOLITHIC, four, folder=self.base / "refused", settings=settings)
        self.assertEqual(refused.returncode, 1)
        self.assertIn('initial_flow: is found by time.start = "lumped"', refused.stderr)

    def test_behind_a_slow_windkessel_the_limit_is_as_near_as_asked_for(self):
        """Its pressure obeys C dp/dt = Q - p/R_d: in the periodic state its mean is R_d times that of the flow."""
        rigid = self.base / "slow.toml"
        rigid.write_text(RIGID)
        compliance, distal, flow = 12.0, 5.0, 4.35 / 12  # R_d C of 5 periods; the table's mean
        settings = (f"opening.outlet.windkessel.compliance={compliance}", "time.step=1")
        folder = run(MONOLITHIC, rigid, self.base / "slow", *self.settings, *settings)
        said = summary(folder)["periodicity"]
        self.assertTrue(said["reached"])
        with (folder / "openings.csv").open() as file:
            rows = [row for row in csv.DictReader(file)]
        of = {name: [row for row in rows if row["opening"] == name][-12:] for name in ("inlet", "outlet")}
        pulse = max(np.ptp([float(row["mean_pressure_Pa"]) for row in last]) for last in of.values()) / 1000
        behind = np.mean([float(row["windkessel_pressure_Pa"]) for row in of["outlet"]]) / 1000
        left = abs(behind - distal * flow) / pulse
        self.assertLess(left, 0.011)
        self.assertGreater(left, 0.006, "not much longer than needed")
        last = said["changes"][-1]
        self.assertAlmostEqual(last["contraction"], np.exp(-12 / (distal * compliance)), delta=5e-3)
        self.assertLess(last["pressure"], 0.3 * left, "the change from the period before says less")

    def test_what_keeps_a_run_from_its_end_is_named(self):
        """Steps of 0.7 ms meet the kinks of the inflow elsewhere in each period of 12 ms, and a pressure shows it."""
        rigid = self.base / "kinks.toml"
        rigid.write_text(RIGID.replace('"euler"', '"tr-bdf2"'))
        folder = run(
            MONOLITHIC,
            rigid,
            self.base / "kinks",
            *self.settings,
            "time.step=0.7",
            "time.end=160",
            "opening.outlet.windkessel.compliance=0.5",
        )
        said, log = summary(folder)["periodicity"], (folder / "run.log").read_text()
        self.assertLess(len(said["changes"]), 10)
        self.assertIn("no whole number of steps of 0.7 ms", log)
        self.assertIn("time.step = 0.6 fits (20 a period)", log)
        if not said["reached"]:
            self.assertTrue(said["limited_by_steps"])
            self.assertIn("periodic within 1 % but for its steps", log)
        slow = run(
            MONOLITHIC,
            rigid,
            self.base / "short",
            *self.settings,
            "time.end=48",
            "time.step=1",
            "opening.outlet.windkessel.compliance=100",
        )
        self.assertRegex(
            (slow / "run.log").read_text(),
            r"outlet remembers 500 ms, 41.7 periods \(distal times compliance\): time.start = "
            r"\"lumped\".* about \d+ periods later",
        )

    def test_fields_have_the_end_of_each_period(self):
        """Whatever else they are written for: the run ends there, and statistics are of the period that ends."""
        rigid = self.base / "fields.toml"
        rigid.write_text(RIGID.replace("every = 0", 'every = 1000\nfields = ["pressure"]\nstatistics = true'))
        settings = (*self.settings, "opening.outlet.windkessel.compliance=0.5")
        for steps in (("time.step=0.25",), ("time.step=0.7",), ("time.step=0.7", "output.interval=50")):
            folder = run(MONOLITHIC, rigid, self.base / f"fields-{len(steps)}-{steps[0]}", *settings, *steps)
            written = arrays(folder / "fields.h5")
            finished = written["steps/written/fluid.tawss"] == 1
            entries, ends = written["steps/time"][finished], [float(time) for time in times(folder)]
            self.assertEqual(entries[-1], ends[-1])
            periods = [c["end_ms"] for c in summary(folder)["periodicity"]["changes"]]
            for end in [PERIOD, *periods]:
                self.assertIn(min(time for time in ends if time >= end - 1e-9), entries)
            shear = written[f"fluid/tawss/{written['steps/number'][finished][-1]:08}"]
            self.assertGreater(shear.max(), 0)

    def test_a_restart_with_another_start_names_the_key(self):
        rigid = self.base / "start.toml"
        rigid.write_text(RIGID)
        folder = run(MONOLITHIC, rigid, self.base / "start", *self.settings, 'time.start="lumped"', "time.end=36")
        refused = attempt(
            MONOLITHIC, rigid, "--restart", folder, folder=folder, settings=[*self.settings, "time.end=48"]
        )
        self.assertEqual(refused.returncode, 1)
        self.assertIn("continue with the time.start and time.period of the earlier run", refused.stderr)

    def test_what_is_refused(self):
        windkessel = "opening.outlet.windkessel.initial_pressure=1"
        for settings, message in (
            (["time.periods=5"], 'time.periods: is not a text; give "until 1%"'),
            (['time.periods="until 1"'], 'time.periods: "until 1" is unknown; give "until 1%"'),
            (['time.periods="until 0%"'], "time.periods: 0 % is not above 0"),
            (
                ["time.end=30"],
                "time.end: 30 ms is less than three periods of 12 ms, whose changes are compared; give at least 36",
            ),
            (["time.period=1e-6"], "ms are more than a million periods of 1e-06 ms; give at most 1"),
            (['time.start="lumped"', windkessel], 'is found by time.start = "lumped"; leave one of the two out'),
            (['time.start="lumped"', "opening.third.pressure=1"], "needs one opening whose pressure is given"),
        ):
            for program in DRIVERS:
                refused = attempt(program, CASE, folder=self.base / "refused", settings=[*self.settings, *settings])
                self.assertEqual(refused.returncode, 1, refused.stderr)
                self.assertIn(message, refused.stderr)
                self.assertFalse((self.base / "refused").exists())


class Shared(FolderTest):
    """Several processes."""

    def test_several_processes_see_the_same_changes(self):
        settings = (f"mesh.file={make_mesh(self.base / 'small.msh', *SECTION)}",)
        for program, processes in zip(DRIVERS, (3, 2)):
            alone = run(program, CASE, self.base / Path(program).name, *settings)
            together = run(program, CASE, self.base / "together", *settings, processes=processes)
            self.assert_same_changes(alone, together)
        begun = run(MONOLITHIC, CASE, self.base / "begun", *settings, "time.end=37", processes=2)
        restart(MONOLITHIC, CASE, begun, *settings)
        self.assert_same_changes(self.base / Path(MONOLITHIC).name, begun)

    def assert_same_changes(self, one, other):
        a, b = (summary(folder)["periodicity"]["changes"] for folder in (one, other))
        self.assertEqual([c["end_ms"] for c in a], [c["end_ms"] for c in b])
        for mine, others in zip(a, b):
            for key in ("pressure", "flow", "displacement"):
                self.assertAlmostEqual(mine[key], others[key], delta=1e-8)


if __name__ == "__main__":
    unittest.main()
