"""Nothing is computed or written that a scene does not need: the counters and phases of summary.json show it."""

import unittest

from programs import (
    ARTERY,
    DRIVERS,
    MONOLITHIC,
    NEO_HOOKEAN,
    PARTITIONED,
    FolderTest,
    arrays,
    calls,
    difference,
    make_mesh,
    pressure,
    restart,
    run,
    summary,
    table,
)

AXISYMMETRIC = NEO_HOOKEAN.parent / "axisymmetric" / NEO_HOOKEAN.name

SHORT = ("time.end=0.375", "partitioned.tolerance=1e-2")  # three steps; what is counted needs no convergence


class Coupled(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.runs = {program: run(program, NEO_HOOKEAN, cls.base / str(i), *SHORT) for i, program in enumerate(DRIVERS)}

    def test_mesh_motion_is_assembled_once(self):
        for folder in self.runs.values():
            self.assertEqual(calls(folder)["assembly: mesh motion"], 1)
            self.assertEqual(summary(folder)["counters"]["mesh motion factorisations"], 1)

    def test_partitioned_solves_each_part_as_often_as_it_says(self):
        """A pass of Dirichlet-Neumann moves the mesh once."""
        folder = run(PARTITIONED, NEO_HOOKEAN, self.base / "dirichlet", *SHORT, "partitioned.scheme=iqn-ils")
        counted, totals = calls(folder), summary(folder)["totals"]
        self.assertEqual(totals["outer_iterations"], table(folder, "iterations.csv")[:, 2].sum())
        self.assertEqual(totals["newton_iterations"], table(folder, "iterations.csv")[:, 3].sum())
        self.assertEqual(counted["solve: mesh motion"], totals["outer_iterations"])
        self.assertEqual(counted["solve: fluid"] + counted["solve: wall"], totals["newton_iterations"])

    def test_partitioned_keeps_its_factors(self):
        counted, totals = calls(self.runs[PARTITIONED]), summary(self.runs[PARTITIONED])["totals"]
        for part in ("fluid", "wall"):
            made = sum(counted.get(f"{kind}: {part}", 0) for kind in ("factorisation", "set-up"))
            self.assertEqual(made, counted[f"assembly: {part} jacobian"])
            self.assertEqual(made, 1)
        self.assertGreater(totals["newton_iterations"], totals["steps"])

    def test_drivers_assemble_only_their_own_systems(self):
        self.assertFalse([name for name in calls(self.runs[PARTITIONED]) if "coupled" in name])
        self.assertFalse([name for name in calls(self.runs[MONOLITHIC]) if ": fluid" in name or ": wall" in name])

    def test_sizes_are_those_of_the_mesh(self):
        reported = summary(self.runs[MONOLITHIC])
        mesh, unknowns = reported["mesh"], reported["unknowns"]
        self.assertEqual(mesh["nodes"], mesh["fluid_nodes"] + mesh["wall_nodes"] - mesh["interface_nodes"])
        counters = reported["counters"]
        self.assertEqual(counters["fluid elements"] + counters["structure elements"], mesh["tetrahedra"])
        self.assertEqual(unknowns["coupled"], unknowns["fluid"] + unknowns["wall"] + unknowns["mesh_motion"])
        points = arrays(self.runs[MONOLITHIC] / "fields.h5")
        self.assertEqual(len(points["fluid/points"]), mesh["fluid_nodes"])
        self.assertEqual(len(points["wall/points"]), mesh["wall_nodes"])


class ConstantOperators(FolderTest):
    """Switched off, the economy costs time and nothing else: the same bits."""

    def pair(self, name, program, *settings):
        return [
            run(
                program,
                NEO_HOOKEAN,
                self.base / f"{name}-{form}",
                *SHORT,
                *settings,
                f"economy.constant_operators={form}",
            )
            for form in ("kept", "rebuilt")
        ]

    def test_monolithic_builds_in_each_newton_iteration(self):
        for name, settings, built in (
            ("fast", (), "mesh motion factorisations"),
            ("direct", ("monolithic.linear_solver=direct",), None),
            ("ilu", ("monolithic.linear_solver=ilu",), "mesh motion set-ups"),
        ):
            with self.subTest(name):
                kept, rebuilt = self.pair(name, MONOLITHIC, *settings)
                self.assertSameResults(kept, rebuilt)
                counted = calls(rebuilt)
                self.assertEqual(calls(kept)["assembly: mesh motion"], 1)
                self.assertEqual(counted["assembly: mesh motion"], 1 + counted["assembly: coupled residual"])
                if built:
                    reported, totals = summary(kept)["counters"], summary(rebuilt)["totals"]
                    self.assertLessEqual(reported[built], counted["assembly: coupled jacobian"])
                    self.assertGreaterEqual(summary(rebuilt)["counters"][built], totals["newton_iterations"])

    def test_dirichlet_neumann_builds_in_each_mesh_motion(self):
        kept, rebuilt = self.pair("iqn-ils", PARTITIONED, "partitioned.scheme=iqn-ils")
        self.assertSameResults(kept, rebuilt)
        counted = calls(rebuilt)
        for phase in ("assembly: mesh motion", "factorisation: mesh motion"):
            self.assertEqual(calls(kept)[phase], 1)
            self.assertEqual(counted[phase], 1 + counted["solve: mesh motion"])

    def test_robin_neumann_builds_in_each_newton_iteration_of_the_fluid(self):
        kept, rebuilt = self.pair("robin", PARTITIONED, "partitioned.scheme=robin-neumann-iqn")
        self.assertSameResults(kept, rebuilt)
        counted = calls(rebuilt)
        self.assertEqual(calls(kept)["assembly: mesh motion"], 1)
        self.assertEqual(summary(kept)["counters"]["mesh motion factorisations"], 1)
        self.assertEqual(counted["assembly: mesh motion"], 1 + counted["assembly: fluid residual"])
        self.assertGreaterEqual(summary(rebuilt)["counters"]["mesh motion factorisations"], counted["solve: fluid"])


class PlaneSystems(FolderTest):
    """From 10,000 unknowns on both drivers iterate where the wall's inertia prevails, and factorise where its stiffness does."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_mesh(cls.base / "mesh.msh", "--axisymmetric", "--for", "p2p1", "--waves", "resolved")
        cls.settings = (f"mesh.file={mesh}", "partitioned.scheme=block-newton")

    def steps(self, program, name, step, **how):
        settings = (*self.settings, f"time.step={step}", f"time.end={4 * step}")
        return run(program, AXISYMMETRIC, self.base / f"{name}-{DRIVERS.index(program)}", *settings, **how)

    def test_short_steps_are_iterated(self):
        folders = [self.steps(program, "short", 0.015625) for program in DRIVERS]
        self.assertGreater(summary(folders[0])["unknowns"]["coupled"], 10_000)
        for folder in folders:
            self.assertFalse([name for name in calls(folder) if name.startswith("factorisation")])
            self.assertIn("stiffness", summary(folder)["choices"]["linear.direct_below"]["reason"])
        self.assertIn("set-up: coupled", calls(folders[0]))
        for phase in ("set-up: fluid", "set-up: wall", "solve: fluid and wall"):
            self.assertIn(phase, calls(folders[1]))
        self.assertLess(difference(*(pressure(folder) for folder in folders)).max(), 1e-5)

    def test_long_steps_are_factorised(self):
        monolithic, partitioned = (self.steps(program, "long", 0.25) for program in DRIVERS)
        self.assertIn("factorisation: coupled", calls(monolithic))
        self.assertIn("factorisation: fluid", calls(partitioned))
        self.assertIn("factorisation: wall", calls(partitioned))
        self.assertNotIn("solve: fluid and wall", calls(partitioned))
        self.assertLess(difference(pressure(monolithic), pressure(partitioned)).max(), 1e-5)

    def test_a_restart_chooses_alike(self):
        whole = self.steps(PARTITIONED, "whole", 0.015625)
        half = self.base / "half"
        settings = (*self.settings, "time.step=0.015625")
        run(PARTITIONED, AXISYMMETRIC, half, *settings, "time.end=0.03125", threads=2)
        restart(PARTITIONED, AXISYMMETRIC, half, *settings, "time.end=0.0625")
        self.assertSameResults(whole, half)


class Fibres(FolderTest):
    def fibres(self, name, case, *settings):
        counters = summary(run(MONOLITHIC, case, self.base / name, "time.end=0.125", *settings))["counters"]
        return counters.get("elements with fibres"), counters["structure elements"]

    def test_only_where_there_are_some(self):
        self.assertIsNone(self.fibres("none", NEO_HOOKEAN)[0])
        with_fibres, elements = self.fibres("all", ARTERY)
        self.assertEqual(with_fibres, elements)
        layer = (
            "structure.layers.adventitia.material=artery",
            "structure.layers.adventitia.k1=0.562",
            "structure.layers.adventitia.k2=0.7112",
            "structure.layers.adventitia.alpha=62",
        )
        with_fibres, elements = self.fibres("one", NEO_HOOKEAN, *layer)
        self.assertTrue(0 < with_fibres < elements)


class Output(FolderTest):
    def result(self, name, *settings):
        return run(MONOLITHIC, NEO_HOOKEAN, self.base / name, "time.end=0.25", *settings)

    def test_fields_are_those_asked_for(self):
        for wanted in ("pressure", "velocity", "displacement"):
            folder = self.result(wanted, f'output.fields=["{wanted}"]', "output.every=1")
            fields = {name.split("/")[1] for name in arrays(folder / "fields.h5") if name.count("/") == 2} - {"written"}
            self.assertEqual(fields, {wanted})
            text = (folder / "fields.xdmf").read_text()
            for field in ("pressure", "velocity", "displacement"):
                self.assertEqual(field in text, field == wanted)

    def test_no_fields_when_none_are_wanted(self):
        for name, setting in (("every", "output.every=0"), ("fields", "output.fields=[]")):
            folder = self.result(name, setting)
            self.assertFalse(list(folder.glob("fields.*")))
            self.assertTrue((folder / "checkpoint.h5").exists())

    def test_fields_are_written_when_asked_for(self):
        folder = self.result("steps", "time.end=0.625", "output.every=2")
        self.assertEqual(list(arrays(folder / "fields.h5")["steps/number"]), [0, 2, 4, 5])  # and the last step

    def test_no_checkpoint_when_none_is_wanted(self):
        self.assertFalse((self.result("none", "output.checkpoint_every=0") / "checkpoint.h5").exists())


if __name__ == "__main__":
    unittest.main()
