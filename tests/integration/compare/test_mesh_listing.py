"""What fsi-mesh import --list says of a mesh: sizes, contacts, units, the command."""

import shlex
import unittest

import numpy as np
import synthetic  # noqa: F401: the package's folder onto the path
from pathlib import Path

from fsi_compare.mesh_import.listing import listing
from fsi_compare.mesh_import.parts import found_mesh
from fsi_compare.mesh_import.raw_mesh import RawMesh
from fsi_compare.mesh_import.sources import Source, join
from test_mesh_parts import cube


def said(mesh, scale=1.0, join=0.0, words=("a.vtu",)):
    return listing(mesh, words, [Source("", Path(words[0]))], scale, join)


def two_cubes(length=1.0, gap=0.0, **more):
    """Of 8 cubes of 6 tetrahedra each, one beside the other along x, with points of their own."""
    points, cells = cube(2)
    whole = np.vstack([points, points + [1, 0, 0]]) * length
    whole[len(points) :, 0] += gap
    blocks = [("tetra", np.concatenate([cells, cells + len(points)]))]
    return RawMesh(whole, blocks, {"region": [np.repeat([3, 4], len(cells))]}, **more)


class MeshListing(unittest.TestCase):
    def test_each_part_has_its_volume_and_its_size_under_each_guess_of_the_unit(self):
        lines = said(found_mesh("a.vtu", two_cubes(2.0), 1.0))
        self.assertRegex(
            lines[1], r"^region:3 +48 tetrahedra +volume 8 unit.3 +2 x 2 x 2 +20 x 20 x 20 +2e.03 x 2e.03 x 2e.03$"
        )
        self.assertRegex(lines[3], r"^all +96 tetrahedra +volume 16 unit.3 +4 x 2 x 2 +40 x 20 x 20 ")
        lines = said(found_mesh("a.vtu", two_cubes(2.0), 10.0), 10.0)
        self.assertRegex(lines[1], r"^region:3 +48 tetrahedra +volume 8000 mm.3 +20 x 20 x 20$")

    def test_units_are_guessed_by_the_size(self):
        for length, words in (
            (0.02, "by its size m (--scale 1000 if m)."),
            (5.0, "by its size mm or cm (--scale 1 if mm, --scale 10 if cm); the command below takes it for mm."),
            (50.0, "Unit: by its size mm (--scale 1 if mm)."),
            (1e4, "no vessel is 2e+04 mm, cm or m long"),
        ):
            lines = said(found_mesh("a.vtu", two_cubes(length), 1.0))
            self.assertIn(words, next(line for line in lines if line.startswith("Unit: ")))

    def test_whether_parts_touch(self):
        points, cells = cube(2)
        left = np.array([points[row, 0].mean() < 0.5 for row in cells])
        mesh = RawMesh(points, [("tetra", cells)], {"region": [np.where(left, 3, 4)]})
        self.assertIn("region:3 and region:4 touch: 8 triangles, 9 points.", said(found_mesh("a.vtu", mesh, 1.0)))
        lines = said(found_mesh("a.vtu", two_cubes(1.0, 1e-3), 1.0))
        words = "region:3 and region:4 share no points and no side, their nearest points are 0.001 mm apart: try --join 0.002."
        self.assertIn(words, lines)
        self.assertTrue(any(line.startswith("9 pairs of points are at most 0.001 mm apart") for line in lines), lines)

    def command(self, lines):
        at = next(i for i, line in enumerate(lines) if line.startswith("The command"))
        return shlex.split(lines[at + 1])

    def test_the_command_names_media_by_their_names_and_flat_faces(self):
        points, cells = cube(2)
        left = np.array([points[row, 0].mean() < 0.5 for row in cells])
        corner = np.array([[0, 1, 3], [0, 1, 9]])  # of two sides of the cube
        end = np.array([[0, 1, 3], [1, 3, 4]])
        nothing = np.zeros(0, dtype=np.int64)
        sets = {
            "Volume1": [np.flatnonzero(left), nothing, nothing],
            "my blood": [np.flatnonzero(left), nothing, nothing],
            "Wall": [np.flatnonzero(~left), nothing, nothing],
            "bent": [nothing, np.arange(2), nothing],
            "Surface2": [nothing, nothing, np.arange(2)],
            "in": [nothing, nothing, np.arange(2)],
        }
        mesh = RawMesh(points, [("tetra", cells), ("triangle", corner), ("triangle", end)], cell_sets=sets)
        words = self.command(said(found_mesh("a.inp", mesh, 1.0), words=("a.inp",)))
        expected = ["fsi-mesh", "import", "a.inp", "-o", "a.msh", "--group", "fluid=my blood", "--group", "wall=Wall"]
        self.assertEqual(words, [*expected, "--group", "in=in"])

    def test_of_media_without_names_the_narrower_one_is_the_fluid(self):
        raw = two_cubes(1.0)
        raw.points[len(raw.points) // 2 :] *= [1, 3, 3]
        words = self.command(said(found_mesh("a.vtu", raw, 1.0)))
        self.assertIn("fluid=region:3", words)
        self.assertIn("wall=region:4", words)

    def test_a_bent_surface_in_two_blocks_is_not_flat(self):
        points, cells = cube(2)
        one, other = np.array([[0, 1, 3]]), np.array([[0, 1, 9]])  # of two sides of the cube
        nothing = np.zeros(0, dtype=np.int64)
        sets = {"blood": [np.arange(48), nothing, nothing], "bent": [nothing, np.arange(1), np.arange(1)]}
        sets["in"] = [nothing, np.arange(1), nothing]
        raw = RawMesh(points, [("tetra", cells), ("triangle", one), ("triangle", other)], cell_sets=sets)
        words = self.command(said(found_mesh("a.inp", raw, 1.0), words=("a.inp",)))
        self.assertIn("in=in", words)
        self.assertNotIn("bent=bent", words)

    def test_a_wall_alone_gets_no_opening(self):
        points, cells = cube(2)
        raw = RawMesh(points, [("tetra", cells)], cell_sets={"wall": [np.arange(48)]})
        self.assertNotIn("--flat-ends", self.command(said(found_mesh("a.vtu", raw, 1.0))))
        lines = said(found_mesh("a.vtu", RawMesh(points, [("tetra", cells)]), 1.0))
        self.assertIn("--flat-ends", self.command(lines))
        self.assertIn("  or, where that is a wall without fluid, --group wall=all --wall-faces", lines)

    def test_the_faces_of_a_wall_are_named_in_three_dimensions_only(self):
        raw = RawMesh(np.array([[0, 0], [1, 0], [0, 1.0]]), [("triangle", np.array([[0, 1, 2]]))])
        lines = said(found_mesh("a.vtu", raw, 1.0))
        self.assertIn("  or, where that is a wall without fluid, --group wall=all", lines)
        self.assertNotIn("--wall-faces", " ".join(lines))

    def test_of_many_volumes_it_is_said_which_touch(self):
        points, cells = cube(2)
        whole = np.vstack([points + [2 * k, 0, 0] for k in range(5)] + [points + [1, 0, 0]])
        rows = np.concatenate([cells + len(points) * k for k in range(6)])
        raw = RawMesh(whole, [("tetra", rows)], {"region": [np.repeat(np.arange(6), len(cells))]})
        mesh = found_mesh("a.vtu", raw, 1.0)
        join("a.vtu", mesh, [len(whole)], 1e-6)
        lines = said(mesh)
        self.assertIn("region:0 and region:5 touch: 8 triangles, 9 points.", lines)
        self.assertIn("No side in common with another one has: region:2, region:3, region:4.", lines)
        self.assertFalse([line for line in lines if "far apart" in line])

    def test_a_gap_as_long_as_an_edge_is_no_reason_to_join(self):
        lines = said(found_mesh("a.vtu", two_cubes(1.0, 0.2), 1.0))
        (line,) = [line for line in lines if "share no points" in line]
        self.assertTrue(line.endswith("apart, as far as points of one of them."), line)

    def test_many_parts_are_cut(self):
        points, cells = cube(4)
        raw = RawMesh(points, [("tetra", cells)], {"ModelFaceID": [np.arange(len(cells))]})
        lines = said(found_mesh("a.vtu", raw, 1.0))
        self.assertEqual(lines[201], "... and 185 parts more")


if __name__ == "__main__":
    unittest.main()
