"""The energy balance of whole runs: energy.csv of both drivers, of every kind of scene (docs/energy.md)."""

import unittest
from pathlib import Path

import numpy as np
from programs import (
    ARTERY,
    DRIVERS,
    LONG,
    MONOLITHIC,
    MOONEY_RIVLIN,
    NEO_HOOKEAN,
    PARTITIONED,
    FolderTest,
    calls,
    energy,
    iterations_without_seconds,
    make_mesh,
    make_small_mesh,
    pressure,
    restart,
    run,
    table,
)

FOLDER = Path(__file__).parent.parent
RIGID_PIPE = FOLDER / "rigid_pipe" / "rigid_pipe.toml"
STATIC, DYNAMIC = (FOLDER / "wall" / f"{kind}_wall.toml" for kind in ("static", "dynamic"))

ENERGIES = ("fluid_kinetic_energy", "wall_kinetic_energy", "wall_isochoric_energy", "wall_volumetric_energy")
NUMERICAL = (
    "fluid_inertia",
    "fluid_mesh_motion",
    "fluid_divergence",
    "fluid_stabilisation",
    "wall_inertia",
    "wall_stress",
    "wall_stabilisation",
)
STEPS = ("time.end=1", "output.every=0")  # ms: 8 steps of 0.125


def closes(rows):
    """Largest difference between the remainder and what the other columns leave over."""
    get = lambda name: rows.get(name, np.zeros(len(rows["step"])))
    change = np.diff(sum(get(name) for name in ENERGIES), prepend=0)
    supply = get("inlet_work") + get("load_work") + get("inlet_kinetic_inflow") - get("outlet_kinetic_outflow")
    numerical = sum(get(name) for name in NUMERICAL)
    np.testing.assert_allclose(numerical, rows["numerical_dissipation"], rtol=1e-12, atol=1e-18)
    return np.abs(supply - change - get("viscous_dissipation") - numerical - rows["remainder"]).max()


class Coupled(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.cases = {case.stem: case for case in (NEO_HOOKEAN, MOONEY_RIVLIN, ARTERY)}
        cls.runs = {name: run(MONOLITHIC, case, cls.base / name, *STEPS) for name, case in cls.cases.items()}

    def test_nothing_is_left_over(self):
        """Newton's tolerance is 1e-8 and its convergence quadratic or nearly."""
        for name, folder in self.runs.items():
            rows = energy(folder)
            work = rows["inlet_work"].sum()
            left_over = np.abs(rows["remainder"]).max() / work
            print(
                f"{name}: work {work:.4g} uJ, lost by viscosity {rows['viscous_dissipation'].sum() / work:.4f}, by "
                f"discretisation {rows['numerical_dissipation'].sum() / work:.4f}, left over at most {left_over:.1e}"
            )
            self.assertGreater(work, 0.1)
            self.assertLess(left_over, 1e-8)
            self.assertLess(closes(rows), 1e-14 * work)

    def test_work_is_pressure_times_inflow(self):
        for folder in self.runs.values():
            rows = energy(folder)
            inflow = table(folder, "flow.csv")[:, 1]
            self.assertAlmostEqual(rows["inlet_work"][0], 1.332 * 0.125 * inflow[0], places=12)
            self.assertEqual(rows["inlet_work"][1:].tolist(), [0] * 7)

    def test_energies_and_dissipation_have_their_sign(self):
        for folder in self.runs.values():
            rows = energy(folder)
            for name in (*ENERGIES, "viscous_dissipation", "fluid_inertia", "fluid_stabilisation"):
                self.assertTrue((rows[name] > 0).all(), name)

    def test_a_loose_tolerance_leaves_something_over(self):
        """The check that the check can fail."""
        folder = run(MONOLITHIC, NEO_HOOKEAN, self.base / "loose", *STEPS, "newton.tolerance=1e-1")
        rows = energy(folder)
        self.assertGreater(np.abs(rows["remainder"]).max(), 1e-7 * rows["inlet_work"].sum())

    def test_drivers_agree(self):
        """To what the coupling leaves, which the remainder shows."""
        one = energy(self.runs["neo-hookean"])
        work = one["inlet_work"].sum()
        left_over = []
        for tolerance in (1e-3, 1e-7):
            folder = run(
                PARTITIONED,
                NEO_HOOKEAN,
                self.base / str(tolerance),
                *STEPS,
                f"partitioned.tolerance={tolerance}",
                "partitioned.scheme=iqn-ils",
            )
            other = energy(folder)
            self.assertEqual(list(one), list(other))
            left_over.append(np.abs(other["remainder"]).max() / work)
            apart = max(np.abs(one[name] - other[name]).max() / work for name in one)
            print(f"partitioned, tolerance {tolerance}: left over {left_over[-1]:.1e}, off the monolithic {apart:.1e}")
        self.assertLess(apart, 1e-6)
        self.assertLess(left_over[1], 1e-7)
        self.assertGreater(left_over[0], 10 * left_over[1])

    def test_none_when_none_is_wanted(self):
        with_it = self.runs["neo-hookean"]
        folder = run(MONOLITHIC, NEO_HOOKEAN, self.base / "none", *STEPS, "output.energy=false")
        self.assertFalse((folder / "energy.csv").exists())
        self.assertNotIn("energy balance", calls(folder))
        self.assertEqual(calls(with_it)["energy balance"], 9)  # the start and 8 steps
        self.assertEqual(iterations_without_seconds(folder), iterations_without_seconds(with_it))
        self.assertEqual(pressure(folder).tobytes(), pressure(with_it).tobytes())


class Schemes(FolderTest):
    """Every scheme in time has its own dissipation, and nothing is left over: of a pulse that ends within the run, by
    both drivers, also where a run goes on from a checkpoint."""

    steps = 5
    stops = 2 * [(1, 3)] if LONG else [(1,), (3,)]  # of each driver: at the jump of the load, and in between
    tolerance = {MONOLITHIC: "newton.tolerance=1e-10", PARTITIONED: "partitioned.tolerance=1e-9"}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = f"mesh.file={make_small_mesh(cls.base / 'small.msh')}"

    def settings(self, program, scheme, steps):
        return (
            self.mesh,
            f"time.scheme={scheme}",
            f"time.end={0.125 * steps}",
            "output.every=0",
            self.tolerance[program],
        )

    def march(self, program, scheme, steps, name):
        folder = self.base / f"{Path(program).name}-{scheme}-{name}"
        return run(program, NEO_HOOKEAN, folder, *self.settings(program, scheme, steps))

    def test_nothing_is_left_over_and_a_restart_changes_no_bit(self):
        for scheme in ("euler", "midpoint", "bdf2", "generalised-alpha", "tr-bdf2"):
            wholes = [self.march(program, scheme, self.steps, "whole") for program in DRIVERS]
            for program, whole, stops in zip(DRIVERS, wholes, self.stops):
                rows = energy(whole)
                work = np.abs(rows["inlet_work"]).sum()
                left_over = np.abs(rows["remainder"]).max() / work
                print(
                    f"{Path(program).name}, {scheme}: work {work:.4g} uJ, lost by discretisation "
                    f"{rows['numerical_dissipation'].sum() / work:.4f}, left over at most {left_over:.1e}"
                )
                self.assertLess(left_over, 1e-8)
                self.assertLess(closes(rows), 1e-13 * work)
                for stop in stops:
                    folder = self.march(program, scheme, stop, f"stop{stop}")
                    restart(program, NEO_HOOKEAN, folder, *self.settings(program, scheme, self.steps))
                    same = (folder / "energy.csv").read_bytes() == (whole / "energy.csv").read_bytes()
                    self.assertTrue(same, f"{program}, {scheme}: energy.csv differs after a restart at {stop}")
            one, other = (energy(whole) for whole in wholes)
            for name in one:
                self.assertLess(np.abs(one[name] - other[name]).max(), 1e-6 * work, f"{scheme}: {name}")


class RigidPipe(FolderTest):
    """Between rigid walls the flow comes to rest as Poiseuille's: what the pressure does, viscosity consumes."""

    def test_viscosity_takes_the_work_of_the_inlet(self):
        stabilisation = []
        for size in (0.5, 0.25):
            mesh = make_mesh(
                self.base / f"{size}.msh",
                "--inner-radius",
                1,
                "--length",
                12,
                "--media",
                0.2,
                "--adventitia",
                0,
                "--size",
                size,
                "--axial-size",
                3 * size,
            )
            folders = [
                run(program, RIGID_PIPE, self.base / f"{size}-{d}", f"mesh.file={mesh}")
                for d, program in enumerate(DRIVERS)
            ]
            self.assertSameTables(*folders)
            rows = energy(folders[0])
            self.assertEqual([name for name in rows if "wall" in name or "mesh" in name or "load" in name], [])
            work = rows["inlet_work"]
            self.assertLess(np.abs(rows["remainder"]).max(), 1e-9 * work[-1])
            self.assertLess(closes(rows), 1e-13 * work.sum())
            last = {name: column[-1] / work[-1] for name, column in rows.items()}
            print(
                f"size {size}, last step, over the work of the inlet: viscosity {last['viscous_dissipation']:.4f}, "
                f"stabilisation {last['fluid_stabilisation']:.4f}, inertia {last['fluid_inertia']:.1e}"
            )
            self.assertLess(abs(np.diff(rows["fluid_kinetic_energy"])[-1]), 1e-4 * work[-1])  # steady
            self.assertAlmostEqual(last["viscous_dissipation"] + last["fluid_stabilisation"], 1, delta=1e-4)
            stabilisation.append(last["fluid_stabilisation"])
            # Poiseuille's dissipation 8 pi mu L U^2 of the mean velocity U, here of the flow found.
            flow = table(folders[0], "flow.csv")[-1, 1]
            poiseuille = 8 * np.pi * 12 * (flow / np.pi) ** 2
            print("  over Poiseuille's dissipation:", rows["viscous_dissipation"][-1] / poiseuille)
        self.assertAlmostEqual(rows["viscous_dissipation"][-1] / poiseuille, 1, delta=0.1)
        self.assertLess(stabilisation[1], 0.06)
        self.assertGreater(np.log2(stabilisation[0] / stabilisation[1]), 1)  # of the mesh: it goes with it


class Wall(FolderTest):
    def test_static_wall_stores_what_the_load_does(self):
        """Small strains, so p is a multiple of the volume V swept. N steps, each with its last pressure, do the work
        p V (N + 1) / 2N, of which wall and stabilisation store p V / 2; the rest is of the steps. What the
        stabilisation takes in a step holds its share of both."""
        for steps in (2, 8):
            folder = run(MONOLITHIC, STATIC, self.base / str(steps), f"static.load_steps={steps}")
            rows = energy(folder)
            self.assertEqual([name for name in rows if "fluid" in name or "kinetic" in name or "inlet" in name], [])
            work = rows["load_work"].sum()
            self.assertLess(np.abs(rows["remainder"]).max(), 1e-9 * work)
            self.assertLess(closes(rows), 1e-14 * work)
            stored = rows["wall_isochoric_energy"][-1] + rows["wall_volumetric_energy"][-1]
            stabilisation = rows["wall_stabilisation"].sum()
            print(f"{steps} steps, over work: stored {stored / work:.5f}, stabilisation {stabilisation / work:.5f}")
            self.assertAlmostEqual((stored * (steps + 1) / steps + stabilisation) / work, 1, delta=0.002)
            self.assertAlmostEqual(rows["wall_stress"].sum() * steps / stored, 1, delta=0.01)

    def test_dynamic_wall_closes_its_balance(self):
        for settings in ((), ("time.scheme=euler", "time.newmark_beta=0.25", "time.newmark_gamma=0.5")):
            rows = energy(run(MONOLITHIC, DYNAMIC, self.base / "dynamic", *settings))
            work = np.abs(rows["load_work"]).sum()
            self.assertTrue((rows["wall_kinetic_energy"] > 0).all())
            self.assertLess(np.abs(rows["remainder"]).max(), 1e-8 * work)
            self.assertLess(closes(rows), 1e-13 * work)
            print(f"{settings}: lost by discretisation over work", rows["numerical_dissipation"].sum() / work)


if __name__ == "__main__":
    unittest.main()
