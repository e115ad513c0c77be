"""Both drivers with every element in every geometry: one solution, the same bits, an energy balance that closes."""

import re
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
    by_turns,
    energy,
    make_mesh,
    pressure,
    restart,
    run,
    summary,
    table,
)
from scenes import ELEMENTS, KINDS, TUBES, forms, scene

CASES = (NEO_HOOKEAN, MOONEY_RIVLIN, ARTERY)
# One scheme of each family with every material; the others with the first. "explicit" solves other equations.
FAMILIES = ("robin-neumann-iqn",)
SCHEMES = ("aitken", "iqn-ils", "iqn-imvj", "newton-krylov", "robin-neumann", "robin-neumann-imvj")


def columns(folder):
    """Every column of values, by file and place; plane scenes have no table of the wall."""
    files = ("centerline_pressure.csv", "wall_displacement.csv", "flow.csv")
    return {
        f"{file}, column {k}": column
        for file in files
        if (folder / file).exists()
        for k, column in enumerate(table(folder, file).T)
    }


def apart(folder, other):
    """Largest difference between two runs in any column, relative to the largest value of that column."""
    one, two = columns(folder), columns(other)
    assert one.keys() == two.keys()
    return max((np.abs(one[name] - two[name]).max() / max(np.abs(two[name]).max(), 1e-300) for name in one), default=0)


class Kinds(FolderTest):
    """Runs of six steps with an element in a geometry."""

    def march(self, program, case, kind, name, *settings, threads=1):
        folder = self.base / "-".join((*kind, case.stem, name))
        fixed = (*scene(self.base, *kind), *forms(case), "time.end=0.75", "output.every=2")
        return run(program, case, folder, *fixed, *settings, threads=threads)


class Agreement(Kinds):
    tight = ("newton.tolerance=1e-11",)

    def test_partitioned_is_monolithic(self):
        of_all = by_turns(KINDS, CASES, FAMILIES)
        of_one = by_turns(KINDS, (NEO_HOOKEAN,), SCHEMES)
        for kind, case, scheme in (*of_all, *of_one):
            with self.subTest(kind=kind, case=case.stem, scheme=scheme):
                exact = self.march(MONOLITHIC, case, kind, "monolithic", *self.tight)
                folder = self.march(
                    PARTITIONED, case, kind, scheme, f"partitioned.scheme={scheme}", "partitioned.tolerance=1e-10"
                )
                found = apart(folder, exact)
                print(f"{' '.join(kind)}, {case.stem}, {scheme}: apart by at most {found:.1e}")
                self.assertLess(found, 1e-7)

    def test_constant_relaxation(self):
        """A factor that is small enough for walls as light as these."""
        for kind in KINDS:
            with self.subTest(kind=kind):
                settings = ("time.end=0.125",)
                found = apart(
                    self.march(
                        PARTITIONED,
                        NEO_HOOKEAN,
                        kind,
                        "constant",
                        *settings,
                        "partitioned.scheme=constant",
                        "partitioned.relaxation=0.05",
                        "partitioned.tolerance=1e-8",
                        "partitioned.max_iterations=2000",
                    ),
                    self.march(MONOLITHIC, NEO_HOOKEAN, kind, "one-step", *self.tight, *settings),
                )
                self.assertLess(found, 1e-5)

    def test_fast_is_direct(self):
        for kind, case in by_turns(KINDS, (NEO_HOOKEAN, ARTERY)):
            with self.subTest(kind=kind, case=case.stem):
                direct, fast = (
                    self.march(
                        MONOLITHIC,
                        case,
                        kind,
                        solver,
                        *self.tight,
                        f"monolithic.linear_solver={solver}",
                        "linear.direct_below=0",
                    )
                    for solver in ("direct", "fast")
                )
                self.assertEqual(table(direct, "iterations.csv")[:, 4].sum(), 0)
                self.assertGreater(table(fast, "iterations.csv")[:, 4].sum(), 0)
                self.assertLess(apart(fast, direct), 1e-8)


class Twins(FolderTest):
    """Graded meshes of short elements at the inlet, where the fluid's first passes go far."""

    def agree(self, name, *settings):
        folders = [
            run(program, NEO_HOOKEAN.parent / name, self.base / Path(program).name, "time.end=0.5", *settings)
            for program in DRIVERS
        ]
        one, two = (columns(folder) for folder in folders)
        for name in one:
            if not name.startswith("flow"):  # nothing has come to the outlet yet
                self.assertLess(np.abs(one[name] - two[name]).max(), 1e-5 * np.abs(two[name]).max(), name)

    def test_axisymmetric_twin_by_both_drivers(self):
        self.agree("axisymmetric/neo-hookean.toml")

    def test_graded_quarter_by_both_drivers(self):
        cells = "--lumen-cells 4 --media-cells 1 --adventitia-cells 1 --around 12 --axial-cells 36".split()
        grading = "--lumen-grading 3 --axial-grading 4".split()
        mesh = make_mesh(self.base / "quarter.msh", "--sector", "90", "--order", "2", *cells, *grading)
        self.agree("neo-hookean.toml", "element=p2p1", "structure.layer_pressure=separate", f"mesh.file={mesh}")


class Bits(Kinds):
    def test_do_not_depend_on_the_number_of_threads(self):
        for kind, program in by_turns(KINDS, DRIVERS):
            with self.subTest(kind=kind, program=Path(program).name):
                folders = [
                    self.march(
                        program,
                        ARTERY,
                        kind,
                        f"threads{threads}",
                        "time.end=0.375",
                        "partitioned.tolerance=1e-2",
                        threads=threads,
                    )
                    for threads in (1, 2)
                ]
                self.assertSameResults(*folders)

    def test_do_not_depend_on_a_restart(self):
        for kind, program in by_turns(KINDS, DRIVERS[::-1]):
            with self.subTest(kind=kind, program=Path(program).name):
                loose = ("partitioned.tolerance=1e-2",)
                whole = self.march(program, ARTERY, kind, "whole", *loose)
                stopped = self.march(program, ARTERY, kind, "stopped", *loose, "time.end=0.25")
                self.assertEqual(table(stopped, "iterations.csv")[:, 0].tolist(), [1, 2])
                restart(
                    program,
                    ARTERY,
                    stopped,
                    *scene(self.base, *kind),
                    *forms(ARTERY),
                    *loose,
                    "time.end=0.75",
                    "output.every=2",
                )
                self.assertSameResults(stopped, whole)


class Energy(Kinds):
    def test_nothing_is_left_over(self):
        """Taylor-Hood elements whose sides are curved or move do not integrate convection exactly; what they miss has a
        column."""
        for kind, case in by_turns(KINDS, CASES):
            with self.subTest(kind=kind, case=case.stem):
                rows = energy(self.march(MONOLITHIC, case, kind, "energy", "newton.tolerance=1e-10"))
                work = rows["inlet_work"].sum()
                left_over = np.abs(rows["remainder"]).max() / work
                missed = np.abs(rows.get("fluid_quadrature", 0)).max() / work
                print(f"{' '.join(kind)}, {case.stem}: left over {left_over:.1e}, by quadrature {missed:.1e}")
                self.assertGreater(work, 0)
                self.assertLess(left_over, 1e-8)
                self.assertEqual("fluid_quadrature" in rows, kind[0] == "p2p1")
                self.assertLess(missed, 2e-3)
                self.assertEqual("fluid_stabilisation" in rows and rows["fluid_stabilisation"].any(), kind[0] == "p1")


class Parts(Kinds):
    """Scenes of one medium."""

    fluid = '[mesh]\nfile = ""\n[fluid]\ndensity = 1.0\nviscosity = 0.1\n[inlet]\npressure = 1.0\n'
    wall = (
        '[mesh]\nfile = ""\n[structure]\ndensity = 1.2\nbulk_modulus = 1e3\n[load]\npressure = 0.01\n'
        '[structure.layers.media]\nmaterial = "neo-hookean"\nc10 = 3.0\n'
        '[structure.layers.adventitia]\nmaterial = "neo-hookean"\nc10 = 0.3\n'
    )
    tight = "[newton]\ntolerance = 1e-8\n"
    in_time, at_rest = "[time]\nstep = 0.5\nend = 2\n" + tight, "[static]\nload_steps = 2\n" + tight

    def both(self, kind, name, text):
        """The runs of both drivers, which must agree: there is nothing to couple."""
        case = self.base / f"{name}.toml"
        case.write_text(text)
        folders = [self.base / f"{'-'.join(kind)}-{name}-{d}" for d in range(len(DRIVERS))]
        if not folders[0].exists():  # one of the other tests has asked for it
            for program, folder in zip(DRIVERS, folders):
                run(program, case, folder, *scene(self.base, *kind))
            self.assertNoNan(folders[0])
            self.assertLess(apart(*folders), 1e-9)
        return folders[0]

    def test_fluid_between_rigid_walls(self):
        for kind in KINDS:
            with self.subTest(kind=kind):
                folder = self.both(kind, "fluid", self.fluid + self.in_time)
                flow, rows = table(folder, "flow.csv"), energy(folder)
                self.assertTrue((flow[:, 1] > 0).all())
                self.assertLess(np.abs(flow[:, 1] - flow[:, 2]).max(), 1e-9 * flow[-1, 1])
                self.assertLess(np.abs(rows["remainder"]).max(), 1e-8 * rows["inlet_work"].sum())
                self.assertEqual(pressure(folder).shape[0], 4)
                self.assertEqual([name for name in rows if "wall" in name], [])

    def test_a_quarter_carries_a_quarter_of_the_flow(self):
        for element in ("p1", "p2p1"):
            quarter, whole = (
                table(self.both((element, geometry), "fluid", self.fluid + self.in_time), "flow.csv")[-1, 1]
                for geometry in ("3d", "axisymmetric")
            )
            print(f"{element}: four quarters of the flow over that of the axisymmetric scene {4 * quarter / whole:.4f}")
            self.assertAlmostEqual(4 * quarter / whole, 1, delta={"p1": 0.25, "p2p1": 0.02}[element])

    def test_annulus_has_no_centre_line(self):
        """Fluid between two cylinders: the axis is none of its places."""
        for element, order in ELEMENTS.items():
            mesh = make_mesh(self.base / "section.msh", *TUBES["axisymmetric"], "--order", order, "--format", "2.2")
            shifted = re.sub(
                r"(?m)^(\d+) (\S+) (0 \S+)$", lambda node: f"{node[1]} {float(node[2]) + 1} {node[3]}", mesh.read_text()
            )
            file = self.base / f"annulus{order}.msh"
            file.write_text(shifted)
            case = self.base / "annulus.toml"
            case.write_text(self.fluid + self.in_time)
            settings = (f"element={element}", "geometry=axisymmetric", f"mesh.file={file}")
            folder = run(MONOLITHIC, case, self.base / f"annulus-{element}", *settings, "time.end=20")
            self.assertFalse((folder / "centerline_pressure.csv").exists())
            # Steady flow between cylinders of radii a and b under a pressure gradient (H. Lamb, Hydrodynamics, 331).
            a, b = 1, 2.43
            exact = np.pi / (8 * 0.1 * 3) * (b**4 - a**4 - (b**2 - a**2) ** 2 / np.log(b / a))
            ratio = table(folder, "flow.csv")[-1, 1] / exact
            print(f"{element}: flow through the annulus over the exact one {ratio:.4f}")
            self.assertAlmostEqual(ratio, 1, delta={"p1": 0.25, "p2p1": 0.02}[element])

    def test_wall_alone(self):
        for kind in KINDS:
            for name, section in (("dynamic", self.in_time), ("static", self.at_rest)):
                with self.subTest(kind=kind, what=name):
                    folder = self.both(kind, name, self.wall + section)
                    rows = energy(folder)
                    self.assertLess(np.abs(rows["remainder"]).max(), 1e-8 * rows["load_work"].sum())
                    self.assertGreater(rows["wall_isochoric_energy"][-1], 0)
                    self.assertEqual([name for name in rows if "fluid" in name], [])
                    self.assertEqual((folder / "wall_displacement.csv").exists(), kind[1] != "plane")
                    self.assertFalse((folder / "centerline_pressure.csv").exists())

    def test_summary_tells_element_geometry_and_cells(self):
        for element, geometry in KINDS:
            with self.subTest(element=element, geometry=geometry):
                found = summary(self.both((element, geometry), "fluid", self.fluid + self.in_time))
                self.assertEqual((found["element"], found["geometry"]), (element, geometry))
                cells = {"3d": "tetrahedra"}.get(geometry, "triangles")
                self.assertEqual({"tetrahedra", "triangles"} & set(found["mesh"]), {cells})
                self.assertGreater(found["mesh"][cells], 0)


if __name__ == "__main__":
    unittest.main()
