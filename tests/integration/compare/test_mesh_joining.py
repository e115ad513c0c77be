"""Points of several meshes that are one, volumes that touch, and facets that are sides of cells."""

import unittest

import numpy as np
import synthetic  # noqa: F401: the package's folder onto the path

from fsi_compare.base.errors import InputError
from fsi_compare.mesh_import.groups import Group, as_sides
from fsi_compare.mesh_import.joining import TooMany, distances_to, first_of_cluster, near_pairs, nearest_distance
from fsi_compare.mesh_import.parts import FoundMesh
from fsi_compare.mesh_import.raw_mesh import Block
from fsi_compare.mesh_import.sources import join
from fsi_compare.mesh_import.touching import contacts, doubled_words

BASE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])


class Joining(unittest.TestCase):
    def test_pairs_are_all_that_are_near(self):
        random = np.random.default_rng(3)
        first, second = random.random((300, 3)), random.random((400, 3))
        distances = np.linalg.norm(first[:, None] - second[None], axis=2)
        for tolerance in (0.01, 0.05, 0.11):
            i, j, there = near_pairs(first, second, tolerance)
            expected = np.argwhere(distances <= tolerance)
            np.testing.assert_array_equal(np.column_stack([i, j]), expected)
            np.testing.assert_allclose(there, distances[i, j], rtol=1e-14)
        with self.assertRaises(TooMany):
            near_pairs(first, second, 2.0)

    def test_distances_to_the_nearest(self):
        random = np.random.default_rng(4)
        first, second = random.random((50, 3)), random.random((60, 3))
        expected = np.linalg.norm(first[:, None] - second[None], axis=2).min(axis=1)
        np.testing.assert_allclose(distances_to(first, second, 2.0), expected, rtol=1e-14)
        self.assertAlmostEqual(nearest_distance(first, second, 2.0), expected.min(), delta=1e-15)
        self.assertEqual(nearest_distance(first, second + 10, 2.0), float("inf"))

    def test_chains_end_at_their_first_point(self):
        lowest = first_of_cluster(7, np.array([5, 3, 1]), np.array([6, 5, 3]))
        np.testing.assert_array_equal(lowest, [0, 1, 2, 1, 4, 1, 1])

    def two(self, shift):
        """A tetrahedron and, in a second file, its mirror image on the face z = 0, moved along x."""
        mirrored = BASE * [1, 1, -1] + [shift, 0, 0]
        blocks = [Block("tetra", np.arange(4)[None]), Block("tetra", np.array([[4, 6, 5, 7]]))]
        return FoundMesh(np.vstack([BASE, mirrored]), blocks, points_of={"set": np.array([2, 5])}), [4, 8]

    def contact(self, mesh):
        (found,) = contacts(mesh.points, {"a": mesh.blocks[:1], "b": mesh.blocks[1:]}, 3)
        return found.sides, found.points, found.distance

    def test_points_of_two_files_that_agree_in_single_precision_are_one(self):
        for shift, sides, points, distance in ((0, 1, 3, 0), (1e-8, 1, 3, 0), (1e-3, 0, 0, 1e-3)):
            mesh, ends = self.two(shift)
            join("a", mesh, ends, 0.0)
            found = self.contact(mesh)
            self.assertEqual(found[:2], (sides, points))
            self.assertAlmostEqual(found[2], distance, delta=1e-12)

    def test_a_tolerance_joins_points_of_one_file_too(self):
        mesh, _ = self.two(1e-3)
        self.assertEqual(join("a", mesh, [8], 0.0), [])
        self.assertEqual(self.contact(mesh)[0], 0)
        (said,) = join("a", mesh, [8], 2e-3)
        self.assertEqual(said, "--join 0.002: 3 points are joined to others, the farthest 0.001 mm apart.")
        self.assertEqual(self.contact(mesh), (1, 3, 0.0))
        np.testing.assert_array_equal(mesh.points_of["set"], [1, 2])

    def test_a_tolerance_as_long_as_an_edge_is_refused(self):
        mesh, ends = self.two(1e-3)
        with self.assertRaisesRegex(InputError, "--join: 1 mm is as long as an edge of a cell"):
            join("a", mesh, ends, 1.0)

    def test_points_that_are_left_of_an_interface_are_found(self):
        mesh, ends = self.two(0.0)
        mesh.points[6] += [0, 0, 1e-3]
        join("a", mesh, ends, 0.0)
        self.assertEqual(self.contact(mesh)[:2], (0, 2))
        said = doubled_words(mesh.points, mesh.blocks)
        self.assertRegex(
            said, r"^1 pairs of points are at most 0.001 mm apart, .*1 mm., one at .0, 1, 0. mm: .*--join 0.002 "
        )
        join("a", mesh, ends, 0.002)
        self.assertEqual(doubled_words(mesh.points, mesh.blocks), "")
        self.assertEqual(self.contact(mesh)[:2], (1, 3))

    def test_facets_get_the_nodes_of_sides_of_second_order(self):
        cell = Block("tetra10", np.arange(10)[None])
        mesh = FoundMesh(np.zeros((11, 3)), [cell])
        groups = [Group("fluid", 3, [cell]), Group("inlet", 2, [Block("triangle", np.array([[3, 0, 1]]))])]
        self.assertEqual(as_sides(mesh, groups), [])
        self.assertEqual(groups[1].parts[0].kind, "triangle6")
        self.assertEqual(set(groups[1].parts[0].nodes[0]), {0, 1, 3, 4, 7, 8})
        groups[1].parts = [Block("triangle", np.array([[3, 0, 1], [0, 1, 10]]))]
        ((group, corners),) = as_sides(mesh, groups)
        self.assertEqual(group.name, "inlet")
        np.testing.assert_array_equal(corners, [[0, 1, 10]])


if __name__ == "__main__":
    unittest.main()
