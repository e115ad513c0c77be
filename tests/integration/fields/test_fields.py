"""ParaView's reader finds in fields.xdmf, and meshio in fluid.xdmf and wall.xdmf, what the run computed."""

import json
import subprocess
import time
import unittest
from pathlib import Path

import numpy as np
from other_readers import read_by_others
from programs import (
    ARTERY,
    DRIVERS,
    MONOLITHIC,
    NEO_HOOKEAN,
    FolderTest,
    arrays,
    driver_command,
    make_small_mesh,
    restart,
    run,
    summary,
    times,
)
from scenes import KINDS, forms, scene

READER = Path(__file__).with_name("read_fields.py")
MESHIO_READER = Path(__file__).with_name("read_by_meshio.py")
STEPS, STEP = 5, 0.125


def shown_by_paraview(folder):
    return json.loads(read_by_others(READER, folder))


def shown_by_meshio(folder, *options):
    """{medium: {times, cells, points, fields}} once all is found equal to the HDF5 files."""
    return json.loads(read_by_others(MESHIO_READER, folder, *options))


class Fields(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh = mesh = make_small_mesh(cls.base / "small.msh")
        cls.folders = [
            run(
                program,
                ARTERY,
                cls.base / str(d),
                f"mesh.file={mesh}",
                f"time.end={STEPS * STEP}",
                "output.every=2",
                "partitioned.tolerance=1e-2",
            )
            for d, program in enumerate(DRIVERS)
        ]
        cls.shown = [shown_by_paraview(folder) for folder in cls.folders]

    def each(self):
        return zip(self.folders, self.shown)

    def test_times_and_grids(self):
        for folder, shown in self.each():
            self.assertEqual(shown["times"], [0, 2 * STEP, 4 * STEP, 5 * STEP])
            mesh = summary(folder)["mesh"]
            for grids in shown["grids"]:
                self.assertEqual(sorted(grids), ["fluid", "wall"])
                for part in ("fluid", "wall"):
                    self.assertEqual(len(grids[part]["points"]), mesh[f"{part}_nodes"])
                    self.assertEqual(grids[part]["kinds"], ["vtkTetra"])
                    self.assertEqual(sorted(grids[part]["point fields"]), ["displacement", "pressure", "velocity"])
                    self.assertIn("layer", grids[part]["cell fields"])
                self.assertEqual(len(set(grids["wall"]["cell fields"]["layer"])), 2)
                self.assertEqual(len(grids["fluid"]["cells"]) + len(grids["wall"]["cells"]), mesh["tetrahedra"])

    def test_series_of_each_medium(self):
        for folder in self.folders:
            found, mesh = shown_by_meshio(folder), summary(folder)["mesh"]
            self.assertEqual(sorted(found), ["fluid", "wall"])
            for medium, series in found.items():
                self.assertEqual(series["times"], [0, 2 * STEP, 4 * STEP, 5 * STEP])
                self.assertEqual(series["points"], mesh[f"{medium}_nodes"])
                self.assertEqual(series["cells"], "tetra")
                self.assertEqual(series["fields"], ["displacement", "layer", "pressure", "velocity"])

    def test_series_of_a_restarted_run(self):
        """In place, with fields of its own beyond the end of the first run."""
        mesh = self.base / "small.msh"
        settings = (f"mesh.file={mesh}", "output.every=2")
        folder = run(MONOLITHIC, ARTERY, self.base / "restarted", *settings, f"time.end={4 * STEP}")
        restart(MONOLITHIC, ARTERY, folder, *settings, f"time.end={8 * STEP}")
        for series in shown_by_meshio(folder).values():
            self.assertEqual(series["times"], [0, 2 * STEP, 4 * STEP, 6 * STEP, 8 * STEP])

    def test_series_of_a_killed_run(self):
        settings = (f"mesh.file={self.base / 'small.msh'}", "output.every=1", "time.end=1000")
        folder = self.base / "killed"
        process = subprocess.Popen(driver_command(MONOLITHIC, ARTERY, "-q", folder=folder, settings=settings))
        try:
            self.wait_for(lambda: (folder / "checkpoint.h5").exists() and len(times(folder)) > 5)
        finally:
            process.kill()
            process.wait()
        found = shown_by_meshio(folder, "--killed")
        self.assertEqual(sorted(found), ["fluid", "wall"])
        for series in found.values():
            self.assertGreater(len(series["times"]), 4)
            np.testing.assert_array_equal(series["times"], STEP * np.arange(len(series["times"])))

    def wait_for(self, ready, patience=60):
        end = time.monotonic() + patience
        while not ready():
            self.assertLess(time.monotonic(), end, "the run does not get on")
            time.sleep(0.02)

    def test_last_values_are_those_of_the_checkpoint(self):
        for folder, shown in self.each():
            state, grids = arrays(folder / "checkpoint.h5"), shown["grids"][-1]
            fluid, wall = (grids[part]["point fields"] for part in ("fluid", "wall"))
            flow, solid = (state[f"arrays/level0.{part}"].reshape(-1, 4) for part in ("flow", "wall"))
            for found, computed in (
                (fluid["velocity"], flow[:, :3]),
                (fluid["pressure"], flow[:, 3]),
                (fluid["displacement"], state["arrays/level0.mesh"].reshape(-1, 3)),
                (wall["displacement"], solid[:, :3]),
                (wall["pressure"], solid[:, 3]),
                (wall["velocity"], state["arrays/wall_velocity"].reshape(-1, 3)),
            ):
                np.testing.assert_array_equal(np.array(found), computed)
                self.assertGreater(np.abs(computed).max(), 0)

    def test_rest_is_zero(self):
        for _, shown in self.each():
            for grid in shown["grids"][0].values():
                self.assertFalse(any(np.any(values) for values in grid["point fields"].values()))

    def test_a_field_that_the_scene_has_not_is_told(self):
        asked = 'output.fields=["velocity", "fibre_stress"]'
        settings = (f"mesh.file={self.mesh}", "time.end=0.25", "output.every=2", asked)
        folder = run(MONOLITHIC, NEO_HOOKEAN, self.base / "lacking", *settings)
        log = (folder / "run.log").read_text()
        self.assertIn('output.fields: "fibre_stress" is no field of this scene: nothing is written of it', log)
        self.assertNotIn('"velocity" is no field', log)

    def test_steps_differ(self):
        for _, shown in self.each():
            pressures = [grids["fluid"]["point fields"]["pressure"] for grids in shown["grids"]]
            self.assertEqual(len({tuple(pressure) for pressure in pressures}), 4)

    def test_fluid_and_wall_move_together_on_the_interface(self):
        for folder, shown in self.each():
            for grids in shown["grids"]:
                fluid, wall = grids["fluid"], grids["wall"]
                at = {tuple(point): i for i, point in enumerate(wall["points"])}
                both = [(i, at[tuple(point)]) for i, point in enumerate(fluid["points"]) if tuple(point) in at]
                self.assertEqual(len(both), summary(folder)["mesh"]["interface_nodes"])
                inside = np.array(fluid["point fields"]["displacement"])[[i for i, _ in both]]
                outside = np.array(wall["point fields"]["displacement"])[[j for _, j in both]]
                # Exactly in the monolithic driver, to its loose tolerance in the partitioned one.
                limit = 0 if "monolithic" in summary(folder)["program"] else 1e-2 * np.linalg.norm(outside)
                self.assertLessEqual(np.linalg.norm(inside - outside), limit)

    def test_pressures_per_layer(self):
        """The wall has its nodes once for each layer: between layers the pressure jumps, the displacement does not."""
        mesh = make_small_mesh(self.base / "layers.msh")
        settings = (f"mesh.file={mesh}", f"time.end={2 * STEP}", "output.every=2")
        for d, program in enumerate(DRIVERS):
            folder = run(program, ARTERY, self.base / f"layers-{d}", *settings, "structure.layer_pressure=separate")
            wall = shown_by_paraview(folder)["grids"][-1]["wall"]
            places = {}
            for i, point in enumerate(wall["points"]):
                places.setdefault(tuple(point), []).append(i)
            copies = [nodes for nodes in places.values() if len(nodes) > 1]
            self.assertTrue(copies and all(len(nodes) == 2 for nodes in copies))
            self.assertEqual(len(wall["points"]), summary(folder)["mesh"]["wall_nodes"])
            fields = {name: np.array(values) for name, values in wall["point fields"].items()}
            first, second = np.array(copies).T
            for name in ("displacement", "velocity"):
                np.testing.assert_array_equal(fields[name][first], fields[name][second])
            jumps = np.abs(fields["pressure"][first] - fields["pressure"][second])
            self.assertGreater(jumps.max(), 0.1 * np.abs(fields["pressure"]).max())


VERTICES = {"3d": 4, "axisymmetric": 3, "plane": 3}
CELLS = {
    ("p1", 3): "vtkTriangle",
    ("p1", 4): "vtkTetra",
    ("p2p1", 3): "vtkQuadraticTriangle",
    ("p2p1", 4): "vtkQuadraticTetra",
}
# Ends of the edges in VTK's order of mid-edge nodes (VTK User's Guide, quadratic cells).
EDGES = {3: ((0, 1), (1, 2), (2, 0)), 4: ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))}
# Along which axes of space the components of vectors in the arrays lie.
AXES = {"3d": (0, 1, 2), "axisymmetric": (0, 2), "plane": (0, 1)}


class Kinds(FolderTest):
    """Every element in every geometry, as ParaView shows it."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.runs = {}
        for kind in KINDS:
            settings = (*scene(cls.base, *kind), *forms(ARTERY), "time.end=0.375", "output.every=3")
            folder = run(MONOLITHIC, ARTERY, cls.base / "-".join(kind), *settings)
            cls.runs[kind] = folder, shown_by_paraview(folder)

    def each(self):
        """(element, geometry, state, part, last grid shown) of fluid and wall of all runs."""
        for (element, geometry), (folder, shown) in self.runs.items():
            state = arrays(folder / "checkpoint.h5")
            for part in ("fluid", "wall"):
                yield element, geometry, state, part, shown["grids"][-1][part]

    def test_cells(self):
        for (element, geometry), (folder, shown) in self.runs.items():
            grids, mesh = shown["grids"][-1], summary(folder)["mesh"]
            cells = sum(len(grids[part]["cells"]) for part in ("fluid", "wall"))
            self.assertEqual(cells, mesh["tetrahedra" if geometry == "3d" else "triangles"])
        for element, geometry, _, _, grid in self.each():
            self.assertEqual(grid["kinds"], [CELLS[element, VERTICES[geometry]]])

    def test_series_of_each_medium(self):
        names = {("p1", 3): "triangle", ("p1", 4): "tetra", ("p2p1", 3): "triangle6", ("p2p1", 4): "tetra10"}
        for (element, geometry), (folder, shown) in self.runs.items():
            for medium, series in shown_by_meshio(folder).items():
                self.assertEqual(series["times"], shown["times"])
                self.assertEqual(series["cells"], names[element, VERTICES[geometry]])
                self.assertEqual(series["points"], len(shown["grids"][-1][medium]["points"]))

    def test_middles_are_between_their_ends(self):
        """In VTK's order, on the curve: near the middle of the edge, and in tubes at the mean radius and angle."""
        for element, geometry, _, part, grid in self.each():
            if element != "p2p1":
                continue
            vertices = VERTICES[geometry]
            points, cells = np.array(grid["points"]), np.array(grid["cells"])
            bent = 0.0
            for middle, (a, b) in enumerate(EDGES[vertices], start=vertices):
                ends, at = points[cells[:, [a, b]]], points[cells[:, middle]]
                length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
                off = np.linalg.norm(at - ends.mean(axis=1), axis=1) / length
                bent = max(bent, off.max())
                self.assertLess(off.max(), 0.25)
                if geometry == "3d" and part == "wall":
                    radius = np.linalg.norm(ends[:, :, :2], axis=2).mean(axis=1)
                    np.testing.assert_allclose(np.linalg.norm(at[:, :2], axis=1), radius, rtol=1e-12)
            if geometry != "axisymmetric":
                self.assertGreater(bent, 0.005)  # the geometry is quadratic

    def test_values_are_those_of_the_checkpoint(self):
        for element, geometry, state, part, grid in self.each():
            axes, fields = AXES[geometry], {name: np.array(found) for name, found in grid["point fields"].items()}
            n = len(axes)
            mixed = state[f"arrays/level0.{'flow' if part == 'fluid' else 'wall'}"].reshape(-1, n + 1)
            vectors = {
                "velocity": mixed[:, :n] if part == "fluid" else state["arrays/wall_velocity"].reshape(-1, n),
                "displacement": mixed[:, :n] if part == "wall" else state["arrays/level0.mesh"].reshape(-1, n),
            }
            for name, computed in vectors.items():
                self.assertEqual(fields[name].shape, (len(grid["points"]), 3))
                np.testing.assert_array_equal(fields[name][: len(computed), axes], computed)
                others = [axis for axis in range(3) if axis not in axes]
                self.assertFalse(fields[name][:, others].any())
                self.assertGreater(np.abs(computed).max(), 0)
            # Middles between layers are written once for each, behind the others.
            at = {tuple(point): i for i, point in reversed(list(enumerate(grid["points"])))}
            behind = range(len(mixed), len(grid["points"]))
            self.assertEqual(len(behind) > 0, element == "p2p1" and part == "wall")
            for i in behind:
                np.testing.assert_array_equal(fields["velocity"][i], fields["velocity"][at[tuple(grid["points"][i])]])
            cells, vertices = np.array(grid["cells"]), VERTICES[geometry]
            carry = np.unique(cells[:, :vertices])
            np.testing.assert_array_equal(fields["pressure"][carry], mixed[carry, n])
            if element == "p2p1":
                for middle, (a, b) in enumerate(EDGES[vertices], start=vertices):
                    mean = fields["pressure"][cells[:, [a, b]]].mean(axis=1)
                    np.testing.assert_allclose(fields["pressure"][cells[:, middle]], mean, rtol=1e-14)


if __name__ == "__main__":
    unittest.main()
