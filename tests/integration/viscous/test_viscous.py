"""Blood whose viscosity depends on the shear rate, in a wall of viscous layers and such with Maxwell branches: both drivers,
solvers, restart, processes."""

import unittest
from pathlib import Path

import numpy as np
from programs import (
    DRIVERS,
    MESH,
    MONOLITHIC,
    FolderTest,
    arrays,
    attempt,
    differing_arrays,
    energy,
    execute,
    restart,
    run,
)
from scenes import KINDS, WALL, scene

LAWS = {
    "carreau-yasuda": "mu0 = 0.056, mu_inf = 3.45e-3, lambda = 3313.0, n = 0.3568",
    "casson": "yield_stress = 5e-4, plastic_viscosity = 4e-3, regularisation = 1e3",
    "power-law": "consistency = 0.01, exponent = 0.6, lowest_viscosity = 1e-3, highest_viscosity = 0.5",
}
CASE = """[mesh]
file = "tube.msh"
[fluid]
density = 1.06
viscosity_model = {{ name = "{name}", {constants} }}
{wall}
[inlet]
pressure = [[0, 0], [0.5, 1.0]]
[time]
step = 0.125
end = 0.5
[newton]
tolerance = 1e-11
[partitioned]
tolerance = 1e-10
[output]
every = 4
fields = ["displacement", "velocity", "pressure", "wall_shear_stress"]
"""
VISCOUS = WALL.replace("c10 = 3.0", "c10 = 3.0\nviscosity = 2.0").replace("c10 = 0.3\n", "c10 = 0.3\nviscosity = 0.5\n")
MAXWELL = WALL.replace(  # a layer with two branches, one with a branch and a viscosity
    "c10 = 3.0", "c10 = 3.0\nmaxwell = [{ shear = 2.0, time = 0.2 }, { shear = 1.0, time = 2.0 }]"
).replace("c10 = 0.3\n", "c10 = 0.3\nviscosity = 0.5\nmaxwell = [{ shear = 0.2, time = 0.1 }]\n")
BRANCHES = "arrays/level0.branches"
SQUARE = """
Point(1) = {-0.5, -0.5, 0}; Point(2) = {0.5, -0.5, 0}; Point(3) = {0.5, 0.5, 0}; Point(4) = {-0.5, 0.5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1, 2, 3, 4} = 3; Transfinite Surface{1} Alternated;
Physical Surface("wall") = {1}; Physical Curve("right") = {2}; Physical Curve("left") = {4};
"""
SPINNING = """element = "p2p1"
geometry = "plane"
[mesh]
file = "square.msh"
[structure]
density = 1.2
[structure.layers.wall]
material = "compressible-neo-hookean"
young = 1000.0
poisson = 0.3
viscosity = 10.0
[[support]]
surface = "right"
spring = 1e-9
traction = [0, 2.0]
until = 0.1
[[support]]
surface = "left"
traction = [0, -2.0]
until = 0.1
[newton]
tolerance = 1e-10
[time]
step = 0.2
end = 32
scheme = "euler"
"""


class ViscousTest(FolderTest):
    def case(self, law="carreau-yasuda", walls=VISCOUS):
        file = self.base / f"{law}.toml"
        file.write_text(CASE.format(name=law, constants=LAWS[law], wall=walls))
        return file

    def assertAgree(self, one, other, most):
        """Displacements, velocities and pressures of the last level, relative to the largest of each field."""
        fields = [arrays(folder / "checkpoint.h5") for folder in (one, other)]
        for medium in ("mesh", "wall", "flow"):
            values, others = (of[f"arrays/level0.{medium}"] for of in fields)
            self.assertGreater(np.abs(values).max(), 1e-4)
            self.assertLess(np.abs(values - others).max(), most * np.abs(values).max(), medium)


class Viscous(ViscousTest):
    def test_drivers_agree_and_energy_is_accounted_for(self):
        for number, (kind, law) in enumerate(zip(KINDS, [*LAWS, *LAWS])):
            wall = (MAXWELL, VISCOUS)[number % 2]
            case, settings = self.case(law, wall), scene(self.base, *kind)
            with self.subTest(kind=kind, law=law):
                folders = [run(program, case, self.base / Path(program).name, *settings) for program in DRIVERS]
                self.assertAgree(*folders, 1e-8)
                rows = energy(folders[0])
                self.assertGreater(rows["viscous_dissipation"][-1], 0)
                self.assertGreater(rows["wall_viscous_dissipation"][-1], 0)
                if wall == MAXWELL:
                    self.assertGreater(rows["wall_branch_energy"][-1], 0)
                self.assertLess(np.abs(rows["remainder"]).max(), 1e-7 * np.abs(rows["inlet_work"]).sum())

    def test_a_square_that_spins_loses_nothing_to_its_viscosity(self):
        """Four turns behind a torque of 0.1 ms: of the energy the strain's rate at the end of each step took 8.8 times."""
        (self.base / "square.geo").write_text(SQUARE)
        execute(MESH, "geo", self.base / "square.geo", "-o", self.base / "square.msh")
        (self.base / "square.toml").write_text(SPINNING)
        rows = energy(run(MONOLITHIC, self.base / "square.toml", self.base / "square"))
        free = slice(8, None)  # the square has come to rest in itself
        kinetic = rows["wall_kinetic_energy"][free]
        self.assertGreater(kinetic[0], 0.05)
        self.assertLess(np.abs(rows["wall_viscous_dissipation"][free]).sum(), 1e-5 * kinetic[0])

    def test_a_run_goes_on_with_the_same_bits(self):
        settings = scene(self.base, "p2p1", "axisymmetric")
        for program in DRIVERS:
            case = self.case(walls=MAXWELL)
            whole = run(program, case, self.base / "whole", *settings)
            begun = run(program, case, self.base / "begun", *settings, "time.end=0.25")
            self.assertEqual(restart(program, case, begun, *settings), begun)
            self.assertEqual(differing_arrays(whole / "checkpoint.h5", begun / "checkpoint.h5"), [])
            self.assertGreater(np.abs(arrays(whole / "checkpoint.h5")[BRANCHES]).max(), 1e-4)

    def test_every_scheme_and_adaptive_steps_keep_branches(self):
        settings = (*scene(self.base, "p1", "axisymmetric"), "output.every=2")
        case = self.case(walls=MAXWELL)
        for scheme in ("euler", "bdf2", "generalised-alpha", "tr-bdf2"):
            with self.subTest(scheme=scheme):
                settled = (*settings, f"time.scheme={scheme}")
                whole = run(MONOLITHIC, case, self.base / "whole", *settled)
                begun = run(MONOLITHIC, case, self.base / "begun", *settled, "time.end=0.25")
                restart(MONOLITHIC, case, begun, *settled)
                self.assertEqual(differing_arrays(whole / "checkpoint.h5", begun / "checkpoint.h5"), [])
                rows = energy(whole)
                self.assertLess(np.abs(rows["remainder"]).max(), 1e-7 * np.abs(rows["inlet_work"]).sum())
        steps = (*settings, "time.step=adaptive", "time.tolerance=1e-3")
        folders = [run(program, case, self.base / Path(program).name, *steps) for program in DRIVERS]
        self.assertAgree(*folders, 1e-7)

    def test_a_prestressed_wall_begins_at_rest(self):
        """What its branches keep is the strain from the unloaded shape: under the pressure of the mesh nothing moves."""
        file = self.base / "prestressed.toml"
        text = CASE.format(name="casson", constants=LAWS["casson"], wall=MAXWELL)
        inlet = "[inlet]\npressure = [[0, 0], [0.5, 1.0]]\n"
        self.assertIn(inlet, text)
        ends = "".join(f'[[opening]]\nsurface = "{name}"\npressure = 0.3\n' for name in ("inlet", "outlet"))
        file.write_text(text.replace(inlet, ends + "[prestress]\npressure = 0.3\n"))
        settings = scene(self.base, "p2p1", "axisymmetric")
        for program in DRIVERS:
            fields = arrays(run(program, file, self.base / "prestressed", *settings) / "checkpoint.h5")
            self.assertGreater(np.abs(fields[BRANCHES]).max(), 0.01)
            self.assertLess(np.abs(fields["arrays/level0.mesh"]).max(), 1e-9)

    def test_a_checkpoint_knows_both_viscosities(self):
        settings = (*scene(self.base, "p2p1", "axisymmetric"), "fluid.viscosity=4e-3")
        begun = run(MONOLITHIC, self.case(), self.base / "known", *settings, "time.end=0.25")
        branch = "structure.layers.media.maxwell=[{ shear = 1.0, time = 1.0 }]"
        for change in ("fluid.viscosity_model.n=0.4", "structure.layers.media.viscosity=2.1", branch):
            refused = attempt(
                MONOLITHIC, self.case(), "-q", "--restart", begun, folder=begun, settings=(*settings, change)
            )
            self.assertEqual(refused.returncode, 1, refused.stderr)
            self.assertIn(change.split("=")[0], refused.stderr)

    def test_the_log_says_which_viscosity_stands_for_all_and_what_stresses_lack(self):
        settings = scene(self.base, "p1", "axisymmetric")
        folder = run(MONOLITHIC, self.case(), self.base / "said", *settings)
        log = (folder / "run.log").read_text()
        self.assertIn("kPa ms, that of carreau-yasuda at 100 1/s", log)
        self.assertNotIn("elastic law", log)
        for walls, lacking in ((VISCOUS, True), (MAXWELL, True), (WALL, False)):
            fields = 'output.fields=["von_mises_stress"]'
            folder = run(MONOLITHIC, self.case(walls=walls), self.base / "stress", *settings, fields, "time.end=0.125")
            warned = "it lacks what viscosity and Maxwell branches add in layer" in (folder / "run.log").read_text()
            self.assertEqual(warned, lacking)

    def test_a_constant_law_is_the_constant(self):
        """The loops of a law, with one that does not change, give what a constant viscosity gives, to rounding."""
        settings = scene(self.base, "p2p1", "axisymmetric")
        constants = "consistency = 0.01, exponent = 1.0, lowest_viscosity = 1e-6, highest_viscosity = 1.0"
        file = self.case("power-law", WALL)
        text = file.read_text()
        law = f'viscosity_model = {{ name = "power-law", {LAWS["power-law"]} }}'
        self.assertIn(law, text)
        folders = []
        for name, entry in (
            ("law", f'viscosity_model = {{ name = "power-law", {constants} }}'),
            ("constant", "viscosity = 0.01"),
        ):
            file.write_text(text.replace(law, entry))
            folders.append(run(MONOLITHIC, file, self.base / name, *settings))
        self.assertAgree(*folders, 1e-9)


class Shared(ViscousTest):
    """Several processes, and PETSc."""

    def test_solvers_agree(self):
        settings = scene(self.base, "p2p1", "axisymmetric")
        folders = [
            run(MONOLITHIC, self.case(), self.base / solver, *settings, f"monolithic.linear_solver={solver}")
            for solver in ("direct", "fast", "petsc")
        ]
        for folder in folders[1:]:
            self.assertAgree(folders[0], folder, 1e-8)

    def test_two_and_three_processes_agree_with_one(self):
        settings = scene(self.base, "p1", "3d")
        case = self.case(walls=MAXWELL)
        for program in DRIVERS:
            alone = run(program, case, self.base / "alone", *settings)
            for processes in (2, 3):
                together = run(program, case, self.base / "together", *settings, processes=processes)
                self.assertAgree(alone, together, 1e-8)
                kept, others = (arrays(folder / "checkpoint.h5")[BRANCHES] for folder in (alone, together))
                self.assertLess(np.abs(kept - others).max(), 1e-8 * np.abs(kept).max())

    def test_other_laws_on_three_processes(self):
        settings = scene(self.base, "p1", "3d")
        for program, law in zip(DRIVERS, ("casson", "power-law")):
            alone = run(program, self.case(law), self.base / "alone", *settings)
            together = run(program, self.case(law), self.base / "together", *settings, processes=3)
            self.assertAgree(alone, together, 1e-8)

    def test_a_run_of_three_processes_goes_on_with_one(self):
        settings = scene(self.base, "p2p1", "axisymmetric")
        case = self.case(walls=MAXWELL)
        alone = run(MONOLITHIC, case, self.base / "alone", *settings)
        begun = run(MONOLITHIC, case, self.base / "begun", *settings, "time.end=0.25", processes=3)
        restart(MONOLITHIC, case, begun, *settings)
        self.assertAgree(alone, begun, 1e-8)


if __name__ == "__main__":
    unittest.main()
