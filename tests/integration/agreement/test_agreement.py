"""The converged partitioned step and the monolithic step solve the same equations."""

import unittest

import numpy as np
from programs import (
    ARTERY,
    MONOLITHIC,
    MOONEY_RIVLIN,
    NEO_HOOKEAN,
    PARTITIONED,
    FolderTest,
    difference,
    pressure,
    run,
    summary,
    table,
    wall,
)

STEPS = 8
SETTINGS = ("time.end=1", "output.every=0")  # ms: 8 steps of 0.125


class Agreement:
    """Both drivers on one of the paper's cases, coarse mesh."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.monolithic = run(MONOLITHIC, cls.case, cls.base / "monolithic", *SETTINGS)
        cls.converged = cls.partitioned("converged", 1e-9)

    @classmethod
    def partitioned(cls, name, tolerance, *settings):
        return run(PARTITIONED, cls.case, cls.base / name, f"partitioned.tolerance={tolerance}", *SETTINGS, *settings)

    def test_pressure_agrees_at_every_time_level(self):
        self.assertEqual(pressure(self.monolithic).shape[0], STEPS)
        apart = difference(pressure(self.converged), pressure(self.monolithic))
        print(f"{self.case.stem}: largest difference of pressure, relative, per step:", apart)
        self.assertLess(apart.max(), 1e-6)  # the demand of the study

    def test_wall_and_flow_agree_at_every_time_level(self):
        for component in (2, 3):
            apart = difference(wall(self.converged)[:, :, component], wall(self.monolithic)[:, :, component])
            self.assertLess(apart.max(), 1e-6)
        flows = [table(folder, "flow.csv")[:, 1:2] for folder in (self.converged, self.monolithic)]
        self.assertLess(difference(*flows).max(), 1e-6)

    def test_steps_took_the_iterations_they_report(self):
        self.assertIterationsEndAt(self.converged, 1e-9)

    def assertIterationsEndAt(self, folder, tolerance):
        """Each step's iterations end with the first that meets the tolerance, and are as many as reported."""
        counts = table(folder, "iterations.csv")[:, 2]
        errors = [
            float(line.split("|d~ - d| / |d~| = ")[1].split()[0])
            for line in (folder / "run.log").read_text().splitlines()
            if "|d~ - d|" in line
        ]
        self.assertEqual(len(errors), counts.sum())
        last = np.cumsum(counts).astype(int) - 1
        for i, error in enumerate(errors):
            self.assertEqual(error <= tolerance, i in last, f"coupling iteration {i + 1}: {error}")


class NeoHookean(Agreement, FolderTest):
    case = NEO_HOOKEAN

    def test_loose_coupling_changes_the_wave(self):
        """The paper's partitioned wave is smaller than its monolithic one: what too loose a tolerance can do.
        With Aitken's method: one pass of the others leaves far less than they are asked for."""
        apart, peaks = {}, {}
        for tolerance in (1e-1, 1e-2):
            folder = self.partitioned(f"loose{tolerance}", tolerance, "partitioned.scheme=aitken")
            self.assertIterationsEndAt(folder, tolerance)
            apart[tolerance] = difference(pressure(folder), pressure(self.monolithic))
            loose, exact = (np.abs(pressure(of)).max(axis=1) for of in (folder, self.monolithic))
            peaks[tolerance] = loose / exact
            print(f"tolerance {tolerance}: difference per step:", apart[tolerance], "ratio of peaks:", peaks[tolerance])
        tight = difference(pressure(self.converged), pressure(self.monolithic)).max()
        self.assertGreater(apart[1e-1].max(), 0.1)
        self.assertGreater(apart[1e-2].max(), 0.005)
        self.assertGreater(apart[1e-2].max(), 1e4 * tight)


class EachKind(FolderTest):
    """Of coupling, each in a case that names no scheme unless the kind is to be named."""

    def test_each_agrees_with_the_monolithic_driver(self):
        case = NEO_HOOKEAN.parent / "axisymmetric" / NEO_HOOKEAN.name
        assert "scheme" not in case.read_text()
        monolithic = run(MONOLITHIC, case, self.base / "monolithic", *SETTINGS)
        self.assertEqual(summary(monolithic)["coupling_kind"], "monolithic")
        for name, kind, settings in (
            ("unnamed", "interface", ()),
            ("gap", "interface", ("partitioned.scheme=iqn-imvj",)),
            ("block", "block", ("partitioned.scheme=block-newton",)),
        ):
            with self.subTest(kind=kind, scheme=name):
                folder = run(PARTITIONED, case, self.base / name, "partitioned.tolerance=1e-8", *SETTINGS, *settings)
                self.assertEqual(summary(folder)["coupling_kind"], kind)
                self.assertIn(f"coupling kind: {kind}; ", (folder / "run.log").read_text())
                apart = difference(pressure(folder), pressure(monolithic))
                print(f"{name}: largest difference of pressure, relative, per step:", apart)
                self.assertLess(apart.max(), 1e-6)


class MooneyRivlin(Agreement, FolderTest):
    case = MOONEY_RIVLIN


class Artery(Agreement, FolderTest):
    case = ARTERY

    def test_fibres_act(self):
        """From rest the fibres are slack; they must have switched on for the agreement to mean anything."""
        slack = run(MONOLITHIC, NEO_HOOKEAN, self.base / "slack", *SETTINGS)
        self.assertGreater(difference(pressure(self.monolithic), pressure(slack)).max(), 1e-2)


if __name__ == "__main__":
    unittest.main()
