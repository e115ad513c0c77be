"""Which arrays and sets of a file are parts of its mesh, and which number its cells."""

import tracemalloc
import unittest

import numpy as np
import synthetic  # noqa: F401: the package's folder onto the path

from fsi_compare.base.errors import InputError
from fsi_compare.mesh_import.groups import boundary_of, choose_groups, corner_keys, facets_between, left_out
from fsi_compare.mesh_import.parts import found_mesh
from fsi_compare.mesh_import.raw_mesh import Block, RawMesh

CORNERS = ((1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1))


def cube(n):
    """n^3 cubes of 6 tetrahedra each: points, cells."""
    side = np.arange(n + 1) / n
    points = np.stack(np.meshgrid(side, side, side, indexing="ij"), -1).reshape(-1, 3)
    a, b, c = (k.ravel() for k in np.meshgrid(*[np.arange(n)] * 3, indexing="ij"))
    v = [((a + (k >> 2 & 1)) * (n + 1) + b + (k >> 1 & 1)) * (n + 1) + c + (k & 1) for k in range(8)]
    return points, np.concatenate([np.stack([v[0], v[r], v[q], v[7]], 1) for q, r in CORNERS])


def found(n=2, **more):
    points, cells = cube(n)
    return found_mesh("a.vtu", RawMesh(points, [("tetra", cells)], **more), 1.0)


class MeshParts(unittest.TestCase):
    def test_numbers_of_cells_are_no_parts_and_cost_no_more_than_cells(self):
        points, cells = cube(20)
        data = {"ModelRegionID": np.repeat([1, 2], len(cells) // 2), "GlobalElementID": 1 + np.arange(len(cells))}
        data["count"] = np.arange(len(cells))[::-1]  # many values under a name that says nothing
        mesh = RawMesh(points, [("tetra", cells)], {name: [values] for name, values in data.items()})
        mesh.point_data = {"GlobalNodeID": np.arange(len(points)), "pressure": points[:, 0] / 3}
        tracemalloc.start()
        parts = found_mesh("a.vtu", mesh, 1.0)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        self.assertEqual(list(parts.cells), ["ModelRegionID:1", "ModelRegionID:2", "all"])
        self.assertEqual([len(parts.cells[name][0]) for name in parts.cells], [24000, 24000, 48000])
        self.assertEqual(parts.points_of, {})
        self.assertEqual(
            parts.passed_over,
            [
                "GlobalElementID (numbers of cells)",
                "count (48000 values at 48000 cells)",
                "GlobalNodeID (numbers of points)",
                "pressure (no whole numbers)",
            ],
        )
        self.assertLess(peak, 1000 * len(cells))  # a mask of the cells for each value would be 48000 bytes a cell

    def test_few_values_are_parts_whatever_their_type(self):
        for values in (np.arange(48) % 3, (np.arange(48) % 3).astype(np.float32), (np.arange(48) % 3)[:, None]):
            parts = found(cell_data={"tissue": [values]})
            self.assertEqual(list(parts.cells), ["tissue:0", "tissue:1", "tissue:2", "all"])
            np.testing.assert_array_equal(parts.cells["tissue:1"][0], np.arange(1, 48, 3))
        for values in (np.full(48, np.inf), np.full(48, 1e300), np.full(48, 0.5), np.ones((48, 3))):
            self.assertEqual(list(found(cell_data={"x": [values]}).cells), ["all"])

    def test_faces_of_many_numbers_are_parts_by_their_name(self):
        self.assertEqual(len(found(cell_data={"ModelFaceID": [np.arange(48)]}).cells), 49)
        self.assertEqual(len(found(cell_data={"face": [np.arange(48)]}).cells), 1)

    def test_entries_without_a_value_are_in_no_part(self):
        values = np.full(48, np.nan)
        values[[3, 5]] = 7
        parts = found(cell_data={"tag": [values]})
        np.testing.assert_array_equal(parts.cells["tag:7"][0], [3, 5])

    def test_one_number_of_volumes_and_surfaces_is_two_parts(self):
        points, cells = cube(2)
        blocks = [("tetra", cells), ("triangle", cells[:4, :3])]
        mesh = RawMesh(points, blocks, {"tag": [np.ones(48), np.array([1, 1, 2, 2])]})
        parts = found_mesh("a.vtu", mesh, 1.0)
        self.assertEqual(list(parts.cells), ["tag:1", "tag:1:triangles", "tag:2", "all"])
        groups = choose_groups("a.vtu", parts, [("fluid", "tag:1"), ("inlet", "tag:1:triangles")])
        self.assertEqual(
            [(g.name, g.dimension, len(g.parts[0].nodes)) for g in groups], [("fluid", 3, 48), ("inlet", 2, 2)]
        )

    def test_a_cell_is_of_one_group(self):
        parts = found(cell_sets={"one": [np.arange(30)], "two": [np.arange(28, 48)]})
        with self.assertRaisesRegex(InputError, "--group two: two shares 2 cells with one, which is one"):
            choose_groups("a.vtu", parts, [])
        for again in ("one", "all"):  # what a name has it does not get twice
            groups = choose_groups("a.vtu", parts, [("wall", "one"), ("wall", again)])
            self.assertEqual({group.name for group in groups}, {"wall"})
            cells = np.concatenate([block.nodes for group in groups for block in group.parts])
            self.assertEqual(len(cells), 30 if again == "one" else 48)
        three = found(cell_sets={"a": [np.arange(20)], "b": [np.arange(20, 40)], "c": [np.arange(18, 48)]})
        with self.assertRaisesRegex(InputError, "--group fluid: c shares 2 cells with a, which is wall"):
            choose_groups("a.vtu", three, [("wall", "a"), ("fluid", "b"), ("fluid", "c")])

    def test_a_part_without_cells_or_sides_is_no_group(self):
        points, cells = cube(2)
        blocks = [("tetra", cells), ("line", cells[:3, :2])]
        sets = {"fluid": [np.arange(48), np.arange(0)], "curve": [np.arange(0), np.arange(3)]}
        sets["nothing"] = [np.arange(0), np.arange(0)]
        mesh = found_mesh("a.vtu", RawMesh(points, blocks, cell_sets=sets, point_sets={"inlet": np.arange(9)}), 1.0)
        for part, words in (("curve", "has no cells or sides"), ("nothing", "has no elements")):
            with self.assertRaisesRegex(InputError, f"--group inlet: the part {part} {words}; its parts are fluid"):
                choose_groups("a.vtu", mesh, [("fluid", "fluid"), ("inlet", part)])
        self.assertEqual([group.name for group in choose_groups("a.vtu", mesh, [])], ["fluid"])
        self.assertEqual(left_out(mesh), ["curve (no cells or sides)", "nothing (no cells or sides)", "inlet (points)"])

    def test_all_is_a_part_of_a_mesh_without_names_and_taken_by_name_only(self):
        parts = found()
        self.assertEqual(len(choose_groups("a.vtu", parts, [("wall", "all")])[0].parts[0].nodes), 48)
        with self.assertRaisesRegex(InputError, "names no parts; give NAME=PART; its parts are all .tetrahedra."):
            choose_groups("a.vtu", parts, [])

    def test_points_and_sets_that_cannot_be_are_refused(self):
        points, cells = cube(2)
        lost = points.copy()
        lost[cells[0, 0]] = np.nan
        for raw, words in (
            (RawMesh(lost, [("tetra", cells)]), "tetra: has a point whose coordinates are no numbers"),
            (RawMesh(points, [("tetra", cells + 1)]), "tetra: names a point that is not there"),
            (
                RawMesh(points, [("tetra", cells)], point_sets={"s": np.array([27])}),
                "s: names a point that is not there",
            ),
            (
                RawMesh(points, [("tetra", cells)], cell_sets={"s": [np.array([48])]}),
                "s: names a cell that is not there",
            ),
        ):
            with self.assertRaisesRegex(InputError, words):
                found_mesh("a.vtu", raw, 1.0)

    def test_the_boundary_of_a_cube_is_its_sides(self):
        points, cells = cube(3)
        for blocks in ([Block("tetra", cells)], [Block("tetra", cells[:70]), Block("tetra", cells[70:])]):
            (boundary,) = boundary_of(blocks, 3)
            self.assertEqual(len(boundary.nodes), 6 * 9 * 2)
            a, b, c = (points[boundary.nodes[:, k]] for k in range(3))
            self.assertAlmostEqual(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2, 6, delta=1e-12)

    def test_keys_of_corners_that_no_product_holds(self):
        nodes = np.array([[0, 3 * 10**6, 1], [3 * 10**6, 1, 0], [1, 2, 3], [0, 3 * 10**6, 2]])
        keys = corner_keys("triangle", nodes)
        self.assertEqual(keys[0], keys[1])
        self.assertEqual(len(set(keys.tolist())), 3)

    def test_a_set_of_corners_of_quadratic_cells_gives_their_sides(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
        pairs = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))
        points = np.vstack([points, [(points[a] + points[b]) / 2 for a, b in pairs]])
        mesh = found_mesh("a.inp", RawMesh(points, [("tetra10", np.arange(10)[None])]), 1.0)
        (side,) = facets_between(mesh, np.array([0, 1, 3]))
        self.assertEqual(sorted(side.nodes[0]), [0, 1, 3, 4, 7, 8])
        (side,) = facets_between(mesh, np.array([0, 1, 3, 4, 7, 8]))
        self.assertEqual(sorted(side.nodes[0]), [0, 1, 3, 4, 7, 8])
        self.assertEqual(facets_between(mesh, np.array([0, 1, 3, 4, 7])), [])


if __name__ == "__main__":
    unittest.main()
