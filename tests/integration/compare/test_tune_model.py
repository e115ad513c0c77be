"""The model of `fsi-compare tune`: vessels recovered from curves that they made, periodic states in closed form, values
found again."""

import unittest
from pathlib import Path

import numpy as np
import synthetic  # noqa: F401: the package's folder onto the path

from fsi_compare.tune.beat import Repetition, cut_off, shown_by_run
from fsi_compare.tune.circuit import PHASES, GivenFlow, GivenPressure, Windkessel, mean_flows, periodic_state
from fsi_compare.tune.curves import Curves, mean, over_period
from fsi_compare.tune.scene import read_scene
from fsi_compare.tune.solving import Model, Rule, reachable_pulse, solved
from fsi_compare.tune.targets import DIASTOLIC, FLOW, MEAN, SPLIT, SYSTOLIC, Target
from fsi_compare.tune.tuning import BeatFailed, Demand, Ran, tune
from fsi_compare.tune.vessel import Vessel, fitted_vessel, not_negative

PERIOD = 800.0  # ms
PHASE = 2 * np.pi * np.arange(PHASES) / PHASES
PULSE = GivenFlow(-(5.0 + 4.0 * np.sin(PHASE) + 2.0 * np.cos(2 * PHASE)))  # 5 mm^3/ms enter on average
OUTLETS = {"left": Windkessel(0.3, 120.0, 4.0), "right": Windkessel(0.5, 90.0, 6.0, 1.0)}
FORK = Vessel({"inlet": 0.02, "left": 0.05, "right": 0.08}, {"inlet": 1.0, "left": 3.0, "right": 5.0}, 9.0)


def curves_of_state(state, every=4):
    time = PERIOD / PHASES * np.arange(PHASES)[::every] + PERIOD / PHASES
    parts = (
        {n: np.roll(v, -1)[::every] for n, v in part.items()} for part in (state.pressure, state.flow, state.stored)
    )
    return Curves(time, *parts)


class Fit(unittest.TestCase):
    def test_a_rigid_vessel_is_recovered(self):
        rigid = Vessel(FORK.resistance, FORK.inertance, 0.0)
        found = fitted_vessel(curves_of_state(periodic_state(rigid, {"inlet": PULSE, **OUTLETS}, PERIOD)), False)
        # The flow of the inlet is the sum of the others': what all three have in common cannot be told from it.
        for name in ("left", "right"):
            self.assertAlmostEqual(found.resistance["inlet"] + found.resistance[name], 0.02 + rigid.resistance[name], 4)
            self.assertAlmostEqual(found.inertance["inlet"] + found.inertance[name], 1.0 + rigid.inertance[name], 2)
        self.assertEqual(found.compliance, 0)
        self.assertLess(found.unexplained_pressure, 1e-3)

    def test_an_elastic_vessel_is_recovered(self):
        found = fitted_vessel(curves_of_state(periodic_state(FORK, {"inlet": PULSE, **OUTLETS}, PERIOD), 2), True)
        self.assertAlmostEqual(found.compliance, 9.0, delta=0.01)
        for name, value in FORK.resistance.items():
            self.assertAlmostEqual(found.resistance[name], value, delta=0.002)
            self.assertAlmostEqual(found.inertance[name], FORK.inertance[name], delta=0.03)
        self.assertLess(found.unexplained_volume, 1e-3)

    def test_noise_is_said_to_be_unexplained(self):
        curves = curves_of_state(periodic_state(FORK, {"inlet": PULSE, **OUTLETS}, PERIOD))
        noise = np.random.default_rng(1).normal(0, 0.3, len(curves.time))
        noisy = Curves(curves.time, {**curves.pressure, "left": curves.pressure["left"] + noise}, curves.flow, {})
        left = [noisy.pressure["inlet"] - noisy.pressure[name] for name in ("left", "right")]
        differences = np.concatenate([0.5 * (d[1:] + d[:-1]) for d in left])
        share = np.linalg.norm(0.5 * (noise[1:] + noise[:-1])) / np.linalg.norm(differences)
        self.assertGreater(share, 0.3)
        self.assertAlmostEqual(fitted_vessel(noisy, True).unexplained_pressure, share, delta=0.05 * share)

    def test_least_squares_stay_positive(self):
        matrix = np.array([[1.0, 1.0], [0.0, 1.0], [2.0, 1.0]])
        np.testing.assert_allclose(not_negative(matrix, matrix @ [2.0, 3.0]), [2, 3], rtol=1e-6)
        # By hand: with x >= 0 the best of |A x - A (2, -3)| has x_2 = 0 and x_1 = (1, 0, 2) . (-1, -3, 1) / 5.
        np.testing.assert_allclose(not_negative(matrix, matrix @ [2.0, -3.0]), [0.2, 0], atol=1e-9)


class PeriodicState(unittest.TestCase):
    def test_windkessel_of_a_flow_that_is_on_and_off(self):
        """C p' = Q - p / R with Q on in the first half: p rises to R Q and falls, exponentials that meet."""
        law, on = Windkessel(0.2, 100.0, 3.0), 4.0
        flow = GivenFlow(np.where(np.arange(PHASES) < PHASES // 2, -on, 0.0))
        vessel = Vessel({"in": 0.0, "out": 0.0}, {"in": 0.0, "out": 0.0}, 0.0)
        state = periodic_state(vessel, {"in": flow, "out": law}, PERIOD)
        decay = np.exp(-PERIOD / 2 / (law.distal * law.compliance))
        lowest, highest = (law.distal * on * x / (1 + decay) for x in (decay, 1.0))
        stored = state.stored["out"]
        # Samples of a jump stand for a flow that changes half a phase earlier: of first order in the phase.
        self.assertAlmostEqual(stored.min(), lowest, delta=0.01)
        self.assertAlmostEqual(stored.max(), highest, delta=0.01)
        quarter = law.distal * on - (law.distal * on - lowest) * np.exp(-PERIOD / 4 / (law.distal * law.compliance))
        self.assertAlmostEqual(stored[PHASES // 4], quarter, delta=0.01)

    def test_one_harmonic_by_its_impedance(self):
        vessel = Vessel({"in": 0.1, "out": 0.2}, {"in": 20.0, "out": 30.0}, 5.0)
        law = Windkessel(0.3, 50.0, 2.0, 1.5)
        w = 2 * np.pi / PERIOD
        state = periodic_state(vessel, {"in": GivenFlow(-2 - np.cos(PHASE)), "out": law}, PERIOD)
        branch = 0.2 + 30j * w + 0.3 + 2.0 / (1 + 1j * w * 100)
        point = 1 / (1 / branch + 5j * w)
        expected = 1.5 + 2 * (0.1 + 0.2 + 0.3 + 2.0) + np.real((0.1 + 20j * w + point) * np.exp(1j * PHASE))
        np.testing.assert_allclose(state.pressure["in"], expected, rtol=1e-6)
        out = 2 + np.real(point / branch * np.exp(1j * PHASE))
        np.testing.assert_allclose(state.flow["out"], out, rtol=1e-6)

    def test_flow_between_two_given_pressures(self):
        vessel = Vessel({"a": 0.5, "b": 1.5}, {"a": 0.0, "b": 0.0}, 0.0)
        ends = {"a": GivenPressure(np.full(PHASES, 5.0)), "b": GivenPressure(1 + np.sin(PHASE))}
        state = periodic_state(vessel, ends, PERIOD)
        np.testing.assert_allclose(state.flow["b"], (4 - np.sin(PHASE)) / 2, rtol=1e-6)
        self.assertAlmostEqual(mean_flows(vessel, ends)["b"], 2.0, 6)

    def test_mean_flows_are_those_of_the_state(self):
        ends = {"inlet": PULSE, **OUTLETS}
        state = periodic_state(FORK, ends, PERIOD)
        for name, flow in mean_flows(FORK, ends).items():
            self.assertAlmostEqual(flow, float(state.flow[name].mean()), 9)
        self.assertAlmostEqual(sum(mean_flows(FORK, ends).values()), 0, 9)


class Values(unittest.TestCase):
    """Targets that known values have, from others."""

    def setUp(self):
        case = {name: Windkessel(0.1, 40.0, 2.0, law.distal_pressure) for name, law in OUTLETS.items()}
        self.model = Model(FORK, {"inlet": PULSE, **case}, case, PERIOD)
        self.rule = Rule(0.08)
        whole = {"left": 4.5, "right": 6.5}
        flows = mean_flows(FORK, {"inlet": PULSE, **{n: self.rule.law(case[n], whole[n], 1.0) for n in whole}})
        total = flows["left"] + flows["right"]
        self.known = {n: self.rule.law(case[n], whole[n], 210 * flows[n] / total) for n in whole}
        state = self.model.state(self.known)
        self.pressure, self.share = state.pressure["inlet"], flows["left"] / total

    def found(self, targets, correction=None):
        none = np.zeros(len(targets)) if correction is None else correction
        return solved(self.model, targets, self.rule, none)

    def test_known_values_are_found_again(self):
        targets = [
            Target("inlet", DIASTOLIC, float(self.pressure.min())),
            Target("inlet", SYSTOLIC, float(self.pressure.max())),
            Target("left", SPLIT, self.share),
            Target("right", SPLIT, 1 - self.share),
        ]
        solution = self.found(targets)
        for name, law in self.known.items():
            for key in ("proximal", "compliance", "distal"):
                value = getattr(law, key)
                self.assertAlmostEqual(getattr(solution.values[name], key), value, delta=1e-4 * value)
        np.testing.assert_allclose(solution.foreseen, [t.value for t in targets], rtol=1e-4)

    def test_what_a_run_shows_beyond_the_model_is_taken_off(self):
        low, high = float(self.pressure.min()), float(self.pressure.max())
        targets = [Target("inlet", DIASTOLIC, low + 0.2), Target("inlet", SYSTOLIC, high + 0.5)]
        solution = self.found(targets, np.array([0.2, 0.5]))
        state = self.model.state(solution.values)
        self.assertAlmostEqual(state.pressure["inlet"].min(), low, delta=1e-3)
        self.assertAlmostEqual(state.pressure["inlet"].max(), high, delta=1e-3)

    def test_a_mean_pressure_leaves_compliances_as_they_are(self):
        solution = self.found([Target("left", MEAN, 9.0), Target("left", FLOW, 3.0), Target("right", FLOW, 2.0)])
        self.assertEqual([law.compliance for law in solution.values.values()], [40, 40])
        state = self.model.state(solution.values)
        self.assertAlmostEqual(float(state.pressure["left"].mean()), 9.0, delta=1e-3)
        self.assertAlmostEqual(float(state.flow["right"].mean()), 2.0, delta=1e-3)

    def test_a_pulse_out_of_reach(self):
        targets = [Target("inlet", DIASTOLIC, 9.9), Target("inlet", SYSTOLIC, 10.0)]
        solution = self.found(targets)
        self.assertGreater(float(np.abs(solution.foreseen - [9.9, 10.0]).max()), 0.5)
        least, most = reachable_pulse(self.model, targets, self.rule, solution)
        self.assertGreater(least, 0.1)
        self.assertGreater(most, least)

    def test_proximal_values_can_be_kept(self):
        self.rule = Rule(None)
        solution = self.found([Target("inlet", MEAN, 12.0)])
        self.assertEqual([law.proximal for law in solution.values.values()], [0.1, 0.1])


CASE = {
    "time": {"step": 4.0, "end": 800.0},
    "structure": {},
    "opening": [
        {"surface": "inlet", "flow_rate": [[0, 1]], "period": PERIOD},
        {"surface": "left", "windkessel": {"proximal": 0.1, "compliance": 60, "distal": 2, "initial_pressure": 9}},
        {"surface": "right", "windkessel": {"proximal": 0.1, "compliance": 60, "distal": 2, "initial_pressure": 9}},
    ],
}
TARGETS = [
    Target("inlet", DIASTOLIC, 9.0),
    Target("inlet", SYSTOLIC, 14.0),
    Target("left", SPLIT, 0.7),
    Target("right", SPLIT, 0.3),
]


class Tuning(unittest.TestCase):
    """Beats that a vessel makes whose openings show half a kilopascal more than its model, as a run with losses of
    its own."""

    def run_beat(self, number, settings):
        self.asked.append(dict(settings))
        if number == self.fails:
            raise BeatFailed("it blew up")
        ends = {"inlet": PULSE}
        for name in ("left", "right"):
            law = {key.rsplit(".", 1)[1]: value for key, value in settings.items() if f".{name}." in key}
            ends[name] = Windkessel(*(law.get(k, d) for k, d in (("proximal", 0.1), ("compliance", 60), ("distal", 2))))
        state = periodic_state(FORK, ends, PERIOD)
        curves = curves_of_state(state)
        return Ran(
            Curves(curves.time, {n: p + 0.5 for n, p in curves.pressure.items()}, curves.flow, curves.stored), 1.0
        )

    def tune(self, fails=0, beats=3, tolerance=0.01):
        self.asked, self.fails, self.told = [], fails, []
        scene = read_scene(Path("case.toml"), CASE)
        return tune(scene, Demand(TARGETS, Rule(0.08), tolerance, beats), self.run_beat, self.told.append)

    def test_targets_are_met_in_the_second_or_third_beat(self):
        outcome = self.tune()
        self.assertTrue(outcome.reached, outcome.lines)
        self.assertIn(len(outcome.beats), (2, 3))
        np.testing.assert_allclose(outcome.beats[-1].got, [t.value for t in TARGETS], rtol=0.01)
        self.assertEqual(self.asked[0], {})
        self.assertEqual(len(self.told), len(outcome.beats))

    def test_the_same_beats_are_asked_for_again(self):
        self.tune()
        before = self.asked
        self.tune()
        self.assertEqual(self.asked, before)

    def test_one_beat_is_not_enough(self):
        outcome = self.tune(beats=1)
        self.assertFalse(outcome.reached)
        self.assertIn("Not reached in 1 beat.", outcome.lines)

    def test_a_beat_that_fails_is_said(self):
        outcome = self.tune(fails=2)
        self.assertFalse(outcome.reached)
        self.assertEqual(len(outcome.beats), 1)
        self.assertIn("Beat 2 did not come to its end: it blew up", outcome.lines)
        self.assertIn("opening.left.windkessel.compliance = ", outcome.lines[-1])

    def test_extremes_at_the_end_of_the_lead_are_doubtful(self):
        time = np.arange(1, 101) * 8.0
        falling = Curves(time, {"inlet": 20 - time / 100}, {"inlet": np.ones(100)}, {})
        said = cut_off(falling, TARGETS[:2], PERIOD)
        self.assertEqual(len(said), 1)
        self.assertIn("systolic pressure at inlet", said[0])


class Beats(unittest.TestCase):
    def test_phases_of_a_period(self):
        time = np.arange(1, 101) * 8.0
        values = np.sin(2 * np.pi * time / PERIOD)
        np.testing.assert_allclose(over_period(time, values, PERIOD, 200)[::2], np.roll(values, 1), atol=1e-12)
        self.assertAlmostEqual(mean(time, 1 + values, PERIOD), 1.0, delta=1e-3)

    def test_extremes_behind_the_lead(self):
        time = np.arange(1, 101) * 8.0
        pressure = np.where(time < 70, 50.0, 10 + np.sin(2 * np.pi * time / PERIOD))
        curves = Curves(time, {"a": pressure}, {"a": np.ones(100)}, {})
        shown = shown_by_run(curves, [Target("a", DIASTOLIC, 1), Target("a", SYSTOLIC, 1)], ["a"], PERIOD)
        np.testing.assert_allclose(shown, [9, 11], atol=1e-3)

    def test_the_periodic_start_of_an_exponential(self):
        kept = np.exp(-0.6)
        self.assertAlmostEqual(Repetition(3.0, 10 + kept * (3.0 - 10), kept).periodic, 10.0)
        self.assertAlmostEqual(Repetition(3.0, 10 + kept * (3.0 - 10), kept).distance, 7.0)


if __name__ == "__main__":
    unittest.main()
