"""Both drivers on several processes compute what one computes, however the mesh is cut."""

import os
import subprocess
import unittest
from pathlib import Path

import numpy as np
from programs import (
    ARTERY,
    DRIVERS,
    MONOLITHIC,
    MOONEY_RIVLIN,
    NEO_HOOKEAN,
    PARTITIONED,
    FolderTest,
    attempt,
    driver_command,
    make_mesh,
    restart,
    run,
    summary,
    table,
    wall,
)
from scenes import KINDS, forms, scene

MATERIALS = (NEO_HOOKEAN, MOONEY_RIVLIN, ARTERY)
# So tight that what is left is round-off and the linear solver's last digits.
TIGHT = {MONOLITHIC: "newton.tolerance=1e-10", PARTITIONED: "partitioned.tolerance=1e-10"}
BOUND = 1e-8  # relative to the largest value of a column
# Small systems are factorised unless the case says otherwise. Where PETSc has options it solves them, here with what it takes
# for large ones.
ITERATION = "linear.direct_below=0"
PETSC = "petsc.options=-fsi_pressure_pc_type gamg"
METHODS = ((), (ITERATION,), (PETSC,))


def tight(program):
    return (TIGHT[program],)


TABLES = ("centerline_pressure.csv", "wall_displacement.csv", "flow.csv", "openings.csv")


def apart(folder, other, files=TABLES):
    """Largest difference between two runs in any column, relative to the largest value of that column."""
    largest = 0.0
    for file in files:
        if (other / file).exists():
            one, two = (np.genfromtxt(place / file, delimiter=",", skip_header=1) for place in (folder, other))
            numbers = ~np.isnan(two).all(axis=0)  # other columns are names
            one, two = one[:, numbers], two[:, numbers]
            scale = np.maximum(np.abs(two).max(axis=0), 1e-300)
            largest = max(largest, float((np.abs(one - two) / scale).max()))
    return largest


def energies_apart(folder, other):
    """The same of the energy balance, relative to its largest number: what is left over is rounding."""
    one, two = (np.genfromtxt(place / "energy.csv", delimiter=",", skip_header=1)[:, 2:] for place in (folder, other))
    return np.abs(one - two).max() / np.abs(two).max()


class Processes(FolderTest):
    def march(self, program, case, kind, processes, *settings, name="", **how):
        folder = self.base / "-".join((*kind, case.stem, Path(program).name, str(processes), name))
        fixed = (*scene(self.base, *kind), *forms(case), "time.end=0.375", "output.every=0", *tight(program))
        return run(program, case, folder, *fixed, *settings, processes=processes, **how)


class Agreement(Processes):
    """Every element and geometry, both drivers, each material; on 2 and 3 processes as on one without mpirun, by a
    factorisation, by iteration and by PETSc in turn."""

    def runs(self, kind):
        first = KINDS.index(kind)
        for i, program in enumerate(DRIVERS):
            yield program, MATERIALS[(first + i) % len(MATERIALS)]

    def test_pressure_is_that_of_one_process(self):
        for kind in KINDS:
            for i, (program, case) in enumerate(self.runs(kind)):
                alone = self.march(program, case, kind, None)
                for processes in (2, 3):
                    with self.subTest(kind=kind, program=Path(program).name, case=case.stem, processes=processes):
                        method = METHODS[(KINDS.index(kind) + i + processes) % 3]
                        folder = self.march(program, case, kind, processes, *method)
                        found = apart(folder, alone)
                        print(*(*kind, Path(program).name, case.stem, *method, f"{processes}: {found:.1e}"), flush=True)
                        self.assertLess(found, BOUND)
                        self.check_summary(folder, alone, processes)
                        self.assertEqual(summary(folder)["totals"]["linear_iterations"] > 0, method != ())
                        if program == PARTITIONED and not method:
                            self.check_passes(folder, alone)

    def test_adaptive_steps_are_those_of_one_process(self):
        """Each process must find the same error of a step, and so take the same ones."""
        steps = ("time.step=adaptive", "time.scheme=bdf2", "time.tolerance=0.3", "time.first_step=0.03", "time.end=2")
        for program in DRIVERS:
            with self.subTest(program=Path(program).name):
                alone, folder = (
                    self.march(program, NEO_HOOKEAN, ("p1", "axisymmetric"), n, *steps, name="adaptive")
                    for n in (None, 2)
                )
                times, expected = (table(place, "iterations.csv")[:, 1] for place in (folder, alone))
                self.assertEqual(len(times), len(expected))
                self.assertGreater(len(np.unique(np.diff(times).round(6))), 3)
                self.assertLess(np.abs(times - expected).max(), 1e-6)
                self.assertLess(apart(folder, alone), 1e-5)

    def check_passes(self, folder, alone):
        """Sub-problems are solved as exactly as by one process, so that their coupling takes as many passes."""
        passes, expected = (table(place, "iterations.csv")[:, 2] for place in (folder, alone))
        self.assertLessEqual(np.abs(passes - expected).max(), 1, (passes, expected))

    def check_summary(self, folder, alone, processes):
        found, whole = summary(folder), summary(alone)
        self.assertEqual((found["processes"], found["status"]), (processes, "done"))
        for entry in ("mesh", "unknowns"):
            self.assertEqual(found[entry], whole[entry])
        own = found["per_process"]
        nodes = processes * own["owned_nodes"]["mean"]
        self.assertGreaterEqual(nodes, found["mesh"]["nodes"])  # those on the interface twice
        self.assertGreater(own["halo_nodes"]["maximum"], 0)
        for name in ("messages_per_step", "bytes_per_step"):
            self.assertGreater(own[name]["maximum"], 0)
        self.assertGreater(own["reductions_per_step"], 0)
        self.assertLessEqual(own["peak_memory_MiB"]["minimum"], own["peak_memory_MiB"]["maximum"])

    def test_mpirun_of_one_is_no_mpirun(self):
        one, alone = (self.march(MONOLITHIC, NEO_HOOKEAN, ("p1", "axisymmetric"), n, name="bits") for n in (1, None))
        self.assertSameTables(one, alone)

    def test_the_same_bits_again(self):
        kind = ("p1", "plane")
        for method in (ITERATION, PETSC):
            names = (f"{name}-{method[:6]}" for name in ("a", "b"))
            first, again = (self.march(PARTITIONED, NEO_HOOKEAN, kind, 3, method, name=name) for name in names)
            self.assertSameTables(first, again)


class Large(FolderTest):
    """Systems that no one factorises: velocities, pressures by multigrid, and the mesh motion are iterated for by all
    processes together."""

    def test_as_on_one_process(self):
        cells = ("--lumen-cells", 4, "--media-cells", 1, "--adventitia-cells", 1, "--axial-cells", 48, "--around", 16)
        mesh = make_mesh(self.base / "tube.msh", *cells)
        for program in DRIVERS:
            settings = (f"mesh.file={mesh}", "time.end=0.25", "output.every=0", *tight(program))
            alone, *shared = (
                run(program, NEO_HOOKEAN, self.base / f"{Path(program).name}-{n}", *settings, processes=n)
                for n in (None, 2, 3)
            )
            for folder in shared:
                with self.subTest(program=Path(program).name, processes=summary(folder)["processes"]):
                    # The wave has not reached the outlet: its flow is rounding.
                    files = ("centerline_pressure.csv", "wall_displacement.csv")
                    self.assertLess(apart(folder, alone, files), BOUND)
                    took, of_one = (summary(place)["totals"]["linear_iterations"] for place in (folder, alone))
                    self.assertLess(took, 1.15 * of_one)


class JudgedByTheWall(FolderTest):
    """A plane system of 10,000 unknowns or more is iterated where its wall is light to solve, and factorised where it is not,
    by several processes as by one."""

    def test_each_as_on_one_process(self):
        mesh = make_mesh(
            self.base / "tube.msh",
            *("--axisymmetric", "--for", "p2p1", "--lumen-cells", 6, "--media-cells", 2, "--adventitia-cells", 2),
            *("--axial-cells", 96),
        )
        for step, steps, iterates in ((1 / 32, 3, True), (1.0, 2, False)):
            with self.subTest(step=step):
                settings = (
                    *(f"mesh.file={mesh}", "geometry=axisymmetric", "element=p2p1", "inlet.until=100"),
                    *("inlet.pressure=0.1", f"time.step={step}", f"time.end={steps * step}", "output.every=0"),
                    *tight(MONOLITHIC),
                )
                alone, folder = (
                    run(MONOLITHIC, NEO_HOOKEAN, self.base / f"{step}-{n}", *settings, processes=n) for n in (None, 2)
                )
                self.assertGreater(summary(alone)["unknowns"]["coupled"], 10000)
                for place in (alone, folder):
                    self.assertEqual("set-up: coupled" in summary(place)["phases"], iterates)
                    self.assertEqual("factorisation: coupled" in summary(place)["phases"], not iterates)
                self.assertIn("below 4 times its inertia", (folder / "run.log").read_text())
                # The wave has not reached the outlet: its flow is rounding.
                self.assertLess(apart(folder, alone, ("centerline_pressure.csv", "wall_displacement.csv")), BOUND)


class Restart(Processes):
    def test_three_to_two(self):
        kind = ("p1", "3d")
        for program in DRIVERS:
            with self.subTest(program=Path(program).name):
                alone = self.march(program, NEO_HOOKEAN, kind, None, "time.end=0.75")
                part = self.march(program, NEO_HOOKEAN, kind, 3, name="part")
                settings = (*scene(self.base, *kind), "time.end=0.75", "output.every=0", *tight(program))
                for processes in (2, None):
                    into = self.base / f"{Path(program).name}-from-3-to-{processes}"
                    whole = restart(program, NEO_HOOKEAN, part, *settings, into=into, processes=processes)
                    self.assertLess(apart(whole, alone), BOUND)
                    self.assertEqual(len(table(whole, "iterations.csv")), 6)

    def test_two_to_two(self):
        """Bit for bit, by iteration, by PETSc and by a factorisation."""
        kind = ("p1", "plane")
        methods = (ITERATION, PETSC, "petsc.options=")
        for program, method in ((MONOLITHIC, ITERATION), *((PARTITIONED, method) for method in methods)):
            with self.subTest(program=Path(program).name, method=method):
                name = str(len(method))
                whole = self.march(program, ARTERY, kind, 2, "time.end=0.75", method, name=f"whole-{name}")
                part = self.march(program, ARTERY, kind, 2, method, name=f"part-{name}")
                settings = (
                    *scene(self.base, *kind),
                    *forms(ARTERY),
                    "time.end=0.75",
                    "output.every=0",
                    *tight(program),
                    method,
                )
                again = restart(program, ARTERY, part, *settings, processes=2)
                self.assertSameTables(again, whole)


class Cuts(FolderTest):
    """Where parts are cut. A surface with more nodes than any process owns is cut."""

    def march(self, program, mesh, processes, name, *more):
        settings = (f"mesh.file={mesh}", "time.end=0.25", "output.every=0", *tight(program), *more)
        return run(program, NEO_HOOKEAN, self.base / name, *settings, processes=processes)

    def test_parts_without_one_of_the_media(self):
        """12 nodes, of which each process has one or two: some have no fluid, some no wall, some nothing on the
        interface. In stages of several lengths, so that factors change there as well."""
        mesh = make_mesh(
            self.base / "twelve.msh",
            *("--axisymmetric", "--length", 1, "--lumen-cells", 1, "--media-cells", 1, "--adventitia-cells", 1),
            *("--axial-cells", 2),
        )
        for program in DRIVERS:
            name = Path(program).name
            more = ("geometry=axisymmetric", "time.scheme=tr-bdf2")
            alone = self.march(program, mesh, None, f"{name}-twelve", *more)
            with self.subTest(program=name):
                folder = self.march(program, mesh, 8, f"{name}-twelve-8", *more)
                self.assertLess(apart(folder, alone), BOUND)
                self.assertLessEqual(summary(folder)["per_process"]["owned_nodes"]["minimum"], 1)

    def test_an_opening_and_an_interface_across_processes(self):
        file = make_mesh(
            self.base / "ring.msh",
            *("--length", 1, "--lumen-cells", 3, "--media-cells", 1, "--adventitia-cells", 1),
            *("--axial-cells", 2, "--around", 8),
        )
        inlet, interface = 1 + 3 * 8, 3 * 8  # the axis and rings; rings along the wall
        for program in DRIVERS:
            name = Path(program).name
            with self.subTest(program=name):
                alone, folder = (self.march(program, file, n, f"{name}-{n}") for n in (None, 8))
                self.assertLess(apart(folder, alone), BOUND)
                most = summary(folder)["per_process"]["owned_nodes"]["maximum"]
                self.assertLess(most, min(inlet, interface))


SLIDING = """title = "a vessel whose ends slide"
element = "p1"
stabilisation = "projected"
[mesh]
file = "tube.msh"
[fluid]
density = 1.0
viscosity = 3.5e-3
[structure]
density = 1.2
bulk_modulus = 1e5
[structure.layers.media]
material = "neo-hookean"
c10 = 3.0
[structure.layers.adventitia]
material = "neo-hookean"
c10 = 0.3
[[opening]]
surface = "inlet"
ENTERING
[[opening]]
surface = "outlet"
windkessel = { proximal = 0.02, compliance = 1.0, distal = 0.1 }
[[support]]
surface = "wall_ends"
fixed = FIXED
[[support]]
surface = "outer"
normal_spring = 2.0
[time]
step = 0.125
end = 0.25
scheme = "midpoint"
[output]
every = 0
"""


class Openings(FolderTest):
    """Openings that move with wall ends which slide or are free; a pressure or a flow is given there."""

    def test_they_move_as_on_one_process(self):
        for element, geometry, fixed, entering, solver, processes in (
            ("p1", "3d", '["normal"]', "pressure = [[0, 0], [0.25, 0.2]]", "fast", 3),
            ("p2p1", "axisymmetric", "[]", "flow_rate = [[0, 0], [0.25, 2.0]]", "direct", 2),
        ):
            case = self.base / f"{geometry}.toml"
            case.write_text(SLIDING.replace("FIXED", fixed).replace("ENTERING", entering))
            for program in DRIVERS:
                name = Path(program).name
                section = name.removeprefix("fsi-")
                settings = (*scene(self.base, element, geometry), *tight(program), f"{section}.linear_solver={solver}")
                with self.subTest(program=name, geometry=geometry):
                    alone, folder = (
                        run(program, case, self.base / f"{geometry}-{name}-{n}", *settings, processes=n)
                        for n in (None, processes)
                    )
                    widened = np.abs(wall(alone)[-1][0, 2])
                    self.assertGreater(widened, 0.1 * np.abs(wall(alone)[..., 2]).max())
                    found = max(apart(folder, alone), energies_apart(folder, alone))
                    print(f"{element} {geometry}, {name}, {solver}, {processes}: {found:.1e}", flush=True)
                    self.assertLess(found, BOUND)


class Refusals(Processes):
    def test_the_paper_s_solvers(self):
        settings = (*scene(self.base, "p1", "3d"), "monolithic.linear_solver=amg_fgmres")
        process = attempt(MONOLITHIC, NEO_HOOKEAN, "-q", folder=self.base / "paper", settings=settings, processes=2)
        self.assertEqual(process.returncode, 1, process.stderr)
        self.assertIn("monolithic.linear_solver", process.stderr)
        self.assertIn("one process", process.stderr)
        self.assertFalse((self.base / "paper").exists())


class WithoutMpi(FolderTest):
    """A build without MPI (FSI_MPI=OFF)."""

    def test_one_process(self):
        for program in DRIVERS:
            folder = run(
                program, NEO_HOOKEAN, self.base / Path(program).name, *scene(self.base, "p1", "plane"), "time.end=0.25"
            )
            self.assertEqual(summary(folder)["processes"], 1)

    def test_petsc_is_refused(self):
        for program, key in zip(DRIVERS, ("monolithic", "partitioned")):
            settings = (*scene(self.base, "p1", "plane"), f"{key}.linear_solver=petsc")
            refused = attempt(program, NEO_HOOKEAN, folder=self.base / "petsc", settings=settings)
            self.assertEqual(refused.returncode, 1)
            self.assertIn('linear_solver: "petsc" is not in this build, which is without MPI', refused.stderr)
            self.assertFalse((self.base / "petsc").exists())

    def test_several_are_refused(self):
        environment = {**os.environ, "OMPI_COMM_WORLD_SIZE": "2", "OMPI_COMM_WORLD_RANK": "0"}
        command = driver_command(MONOLITHIC, NEO_HOOKEAN, folder=self.base / "two")
        process = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60)
        self.assertEqual(process.returncode, 1)
        self.assertIn("this build is without MPI", process.stderr)
        self.assertFalse((self.base / "two").exists())


if __name__ == "__main__":
    unittest.main()
