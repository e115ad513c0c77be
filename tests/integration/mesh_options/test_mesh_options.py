"""The options of fsi-mesh that choose the kind of mesh: what is written and what is said about it."""

import re
import unittest

from programs import MESH, FolderTest, execute

FEW = ("--length", 2, "--lumen-cells", 2, "--axial-cells", 3)


class MeshOptions(FolderTest):
    def made(self, *options):
        """The lines of an ASCII 2.2 file, and what the program printed."""
        file = self.base / "mesh.msh"
        process = execute(MESH, "artery", "-o", file, "--format", "2.2", *options)
        self.assertEqual(process.returncode, 0, process.stderr)
        return file.read_text().splitlines(), process

    def groups(self, lines):
        """Names of the physical groups by dimension."""
        found = {}
        start = lines.index("$PhysicalNames") + 2
        for line in lines[start : lines.index("$EndPhysicalNames")]:
            dimension, _, name = line.split()
            found.setdefault(int(dimension), []).append(name.strip('"'))
        return found

    def types(self, lines):
        """gmsh's numbers of the element types in the file."""
        start = lines.index("$Elements") + 2
        return {int(line.split()[1]) for line in lines[start : lines.index("$EndElements")]}

    def test_kinds(self):
        layers = ["fluid", "media", "adventitia"]
        ends = ["inlet", "outlet", "wall_ends", "outer"]
        for options, types, surfaces in (
            ((), {2, 4}, ends),
            (("--order", 2), {9, 11}, ends),
            (("--axisymmetric",), {1, 2}, ends),
            (("--axisymmetric", "--order", 2), {8, 9}, ends),
            (("--sector", 90, "--order", 2), {9, 11}, [*ends, "symmetry_x", "symmetry_y"]),
            (("--sector", 180), {2, 4}, [*ends, "symmetry_y"]),
            (("--sector", 60), {2, 4}, [*ends, "symmetry_1", "symmetry_y"]),
            (("--sector", 90, "--mirrored"), {2, 4}, ends),
            (("--sector", 60, "--mirrored", "--order", 2), {9, 11}, ends),
        ):
            with self.subTest(options=options):
                lines, process = self.made(*FEW, *options)
                self.assertEqual(self.types(lines), types)
                dimension = 2 if "--axisymmetric" in options else 3
                self.assertEqual(self.groups(lines), {dimension - 1: surfaces, dimension: layers})
                nodes = int(lines[lines.index("$Nodes") + 1])
                self.assertIn(f"{nodes} nodes, ", process.stdout)

    def test_recommended_mesh_says_what_it_is(self):
        _, process = self.made("--for", "p2p1", "--axisymmetric", "--error", "5%")
        said, report = process.stdout.split("\n", 1)
        found = re.fullmatch(
            r"p2p1, axisymmetric, damped waves: cells through lumen (\d+).*, media (\d+), adventitia (\d+), along the axis (\d+).*; "
            r"error in space of the neo-Hookean wave (.*) % of pressure, (.*) % of displacement, measured",
            said,
        )
        lumen, media, adventitia, axial = (int(word) for word in found.groups()[:4])
        across = lumen + media + adventitia
        self.assertIn(f"{(2 * across + 1) * (2 * axial + 1)} nodes, {2 * across * axial} ", report)
        self.assertLessEqual(max(float(word) for word in found.groups()[4:]), 5)

    def test_recommended_mesh_does_not_warn_of_itself(self):
        _, process = self.made("--for", "p2p1", "--sector", 90, "--axial-cells", 24)
        self.assertEqual(process.stderr, "")
        _, process = self.made("--sector", 90, "--axial-cells", 200, "--length", 2)
        self.assertIn("fsi-mesh: warning: ", process.stderr)

    def test_what_contradicts_itself_is_refused_and_named(self):
        file = self.base / "none.msh"
        for words, named in (
            (("--for", "p2p1", "--level", "fine"), "--for"),
            (("--for", "p2p1", "--error", "3"), "--error: '3' is no percentage"),
            (("--waves", "resolved"), "--waves: belongs to --for"),
            (("--for", "p2p1", "--waves", "all"), "waves"),
            (("--for", "p7"), "--for: there are no meshes recommended for 'p7'"),
            (("--sector", "50"), "--sector: 50 degrees will not do"),
            (("--sector", "90", "--axisymmetric"), "--sector"),
            (("--sector", "90", "--around", "9"), "--around: 9 cells cannot be shared by 4 sectors"),
            (("--mirrored",), "--mirrored"),
            (("--order", "3"), "--order"),
            (("--axial-grading", "0"), "--axial-grading"),
            (("--media-cells", "0"), "--media-cells"),
            (("--lumen-cells", "two"), "--lumen-cells"),
        ):
            with self.subTest(words=words):
                process = execute(MESH, "artery", "-o", file, *words)
                self.assertEqual((process.returncode, process.stdout), (1, ""))
                self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
                self.assertIn(named, process.stderr)
                self.assertFalse(file.exists())


if __name__ == "__main__":
    unittest.main()
