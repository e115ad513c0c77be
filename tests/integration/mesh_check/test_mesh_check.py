"""fsi-mesh check: each kind of fault, made on purpose, is found with its place; right meshes raise no alarm."""

import functools
import re
import shlex
import unittest

import meshio
import numpy as np

from programs import MESH, FolderTest, execute

ROD = """
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 6, 1};
Cylinder(2) = {0, 0, 0, 0, 0, 6, 1.3};
BooleanFragments{ Volume{2}; Delete; }{ Volume{1}; Delete; }
Mesh.MeshSizeMax = 0.6;
Physical Volume("fluid") = {1};
Physical Volume("wall") = {2};
"""


class Mesh:
    """Points, mm; cells of each volume, triangles of each surface."""

    def __init__(self, points, volumes, surfaces):
        self.points, self.volumes, self.surfaces = points, volumes, surfaces

    def copy(self):
        return Mesh(
            self.points.copy(),
            {name: cells.copy() for name, cells in self.volumes.items()},
            {name: facets.copy() for name, facets in self.surfaces.items()},
        )

    def write(self, file):
        groups = [(3, name, 4, rows) for name, rows in self.volumes.items()]
        groups += [(2, name, 2, rows) for name, rows in self.surfaces.items()]
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(groups))]
        lines += [f'{dimension} {tag} "{name}"' for tag, (dimension, name, _, _) in enumerate(groups, 1)]
        lines += ["$EndPhysicalNames", "$Nodes", str(len(self.points))]
        lines += [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(self.points.tolist(), 1)]
        lines += ["$EndNodes", "$Elements", str(sum(len(rows) for _, _, _, rows in groups))]
        number = 0
        for tag, (_, _, kind, rows) in enumerate(groups, 1):
            for row in rows:
                number += 1
                lines.append(f"{number} {kind} 2 {tag} {tag} {' '.join(str(n + 1) for n in row)}")
        file.write_text("\n".join(lines + ["$EndElements", ""]))


class Surfaces(FolderTest):
    """Surfaces of tubes, in files."""

    def check(self, file, *options):
        return execute(MESH, "check", file, *options, cwd=self.base)

    @staticmethod
    def tube(around=12, along=8):
        angles = 2 * np.pi * np.arange(around) / around
        points = [(np.cos(a), np.sin(a), 0.5 * k) for k in range(along + 1) for a in angles]
        triangles = []
        for k in range(along):
            for i in range(around):
                a, b = k * around + i, k * around + (i + 1) % around
                triangles += [(a, b, b + around), (a, b + around, a + around)]
        return np.array(points), np.array(triangles)

    def write_stl(self, name, points, triangles):
        meshio.Mesh(points, [("triangle", triangles)]).write(self.base / name)


class Check(Surfaces):
    @classmethod
    @functools.cache
    def artery(cls):
        """A straight tube of fluid, media and adventitia, 3 mm long."""
        file = cls.base / "artery.msh"
        options = "--lumen-cells 3 --media-cells 2 --adventitia-cells 1 --around 12 --axial-cells 4 --length 3"
        process = execute(MESH, "artery", *options.split(), "-o", file, "-q", "--format", "2.2")
        assert process.returncode == 0, process.stderr
        mesh = meshio.read(file)
        parts = {2: {}, 3: {}}
        for name, (tag, dimension) in mesh.field_data.items():
            kind = "tetra" if dimension == 3 else "triangle"
            parts[dimension][name] = mesh.cells_dict[kind][mesh.cell_data_dict["gmsh:physical"][kind] == tag]
        return Mesh(mesh.points, parts[3], parts[2])

    def expect_stop(self, mesh, *patterns):
        """Each is found in a line of its own; a summary of one line ends the program with 1."""
        mesh.write(self.base / "wrong.msh")
        process = self.check("wrong.msh")
        self.assertEqual(process.returncode, 1, process.stdout + process.stderr)
        self.assertRegex(process.stderr, r"\Afsi-mesh: error: wrong\.msh: .* would stop a driver; .*\n\Z")
        for pattern in patterns:
            self.assertRegex(process.stdout, "(?m)^stops fsi-monolithic and fsi-partitioned.*" + pattern)
        return process.stdout

    def test_a_right_mesh_raises_no_alarm_and_its_layers_are_measured(self):
        self.artery().write(self.base / "right.msh")
        process = self.check("right.msh")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertNotRegex(process.stdout, "(?m)^(stops|warning)")
        # Paper's dimensions: media 0.26 mm, adventitia 0.13 mm thick.
        self.assertRegex(process.stdout, r"(?m)^media: thickness 0\.2[56]\d* mm at \(.*; 2 cells across$")
        self.assertRegex(process.stdout, r"(?m)^adventitia: thickness 0\.1[23]\d* mm at \(.*; 1 cell across$")
        self.assertRegex(
            process.stdout,
            r"(?m)^opening inlet: .* mm\^2, radius 1\.\d+ mm, at \(0, 0, 0\) mm, flat, round, one piece$",
        )
        self.assertRegex(
            process.stdout, r"(?m)^size: .* x .* x 3 mm if in mm, .* x 30 mm if in cm, .* x 3000 mm if in m$"
        )

    def test_flat_and_folded_cells(self):
        mesh = self.artery().copy()
        cell = mesh.volumes["fluid"][5]
        inside = [n for n in cell if np.hypot(*mesh.points[n, :2]) < 0.9 and 0 < mesh.points[n, 2] < 3]
        others = [n for n in cell if n != inside[0]]
        mesh.points[inside[0]] = mesh.points[others].mean(axis=0)
        self.expect_stop(mesh, r"degenerate tetrahedron, volume .* at \(.*\) mm")
        mesh = self.artery().copy()
        mesh.points[inside[0]] += 2 * (mesh.points[others].mean(axis=0) - mesh.points[inside[0]])
        self.expect_stop(mesh, r"inverted tetrahedron.* at \(.*\) mm.*fsi-mesh import wrong.msh -o NEW.msh")

    def test_what_is_said_to_mend_turned_cells_and_unused_nodes_does(self):
        mesh = self.artery().copy()
        mesh.volumes["fluid"][::7] = mesh.volumes["fluid"][::7][:, [1, 0, 2, 3]]
        mesh.points = np.vstack([mesh.points, [[0, 0, 1.234]]])
        count = len(mesh.volumes["fluid"][::7])
        self.expect_stop(mesh, rf"inverted tetrahedron.*, and {count - 1} more;", "unused nodes: 1 in no element")
        process = execute(MESH, "import", "wrong.msh", "-o", "NEW.msh", "-q", cwd=self.base)
        self.assertEqual(process.returncode, 0, process.stderr)
        process = self.check("NEW.msh")
        (self.base / "NEW.msh").unlink()
        self.assertEqual((process.returncode, process.stderr), (0, ""), process.stdout)

    def test_doubled_nodes_and_gaps(self):
        mesh = self.artery().copy()
        walls = np.unique(np.concatenate([mesh.volumes["media"], mesh.volumes["adventitia"]]))
        new = np.arange(len(mesh.points))
        new[walls] = len(mesh.points) + np.arange(len(walls))
        kept = mesh.points
        mesh.points = np.vstack([kept, kept[walls]])
        for name in ("media", "adventitia"):
            mesh.volumes[name] = new[mesh.volumes[name]]
        mesh.surfaces = {n: new[f] if n in ("wall_ends", "outer") else f for n, f in mesh.surfaces.items()}
        used = np.unique(np.concatenate([*mesh.volumes.values()]))
        renumber = np.zeros(len(mesh.points), int)
        renumber[used] = np.arange(len(used))
        mesh.points = mesh.points[used]
        for part in (mesh.volumes, mesh.surfaces):
            for name in part:
                part[name] = renumber[part[name]]
        text = self.expect_stop(
            mesh, r"nodes at \(.*\): two nodes in the same place", "the wall does not touch the fluid"
        )
        self.assertRegex(text, r"(?m)^warning: a gap: .*fluid.* share no points and no side")
        self.assertRegex(text, r"(?m)^warning: \d+ pairs of points .*--join .*: fsi-mesh import wrong.msh -o NEW.msh$")
        walls = np.unique(np.concatenate([mesh.volumes["media"], mesh.volumes["adventitia"]]))
        mesh.points[walls, :2] *= 1.02  # some 0.03 mm away
        text = self.expect_stop(mesh, "the wall does not touch the fluid")
        self.assertRegex(text, r"(?m)^warning: a gap: .*nearest points are 0\.02\d+ mm apart: try --join")
        mesh.points[walls, :2] *= 0.9
        self.expect_stop(
            mesh, r"\d+ cells of (fluid|media) reach into cells of (fluid|media), one at \(.*: they overlap"
        )

    def test_units_by_size(self):
        mesh = self.artery().copy()
        mesh.points *= 1e-3
        mesh.write(self.base / "metres.msh")
        process = self.check("metres.msh")
        self.assertRegex(process.stdout, r"(?m)^warning: the mesh is 0\.00\d+ mm long: --scale 1000 if it is in m; ")

    def test_surfaces_that_are_missing(self):
        mesh = self.artery().copy()
        del mesh.surfaces["wall_ends"]
        self.expect_stop(mesh, "wall_ends: the rim of the interface is not clamped: 24 of its nodes")
        mesh = self.artery().copy()
        del mesh.surfaces["inlet"], mesh.surfaces["outlet"]
        text = self.expect_stop(mesh, r"flat parts of the fluid's surface have no name: .* about \(0, 0, [03]\) mm.*")
        ends = re.findall(r" --opening NAME\d=(\S+)", text)
        self.assertEqual(sorted(float(end.split(",")[2]) for end in ends), [0, 3])

    def test_openings_that_are_no_disk(self):
        mesh = self.artery().copy()
        inlet = mesh.surfaces["inlet"]
        away = np.hypot(*mesh.points[inlet].mean(axis=1)[:, :2].T)
        for name, facets, what in (
            ("one triangle", inlet[:1], "is one triangle"),
            ("an annulus", inlet[away > 0.6], "has 2 rims, as an annulus"),
            ("pieces", np.vstack([inlet, mesh.surfaces["outlet"]]), "is in 2 pieces"),
        ):
            with self.subTest(name):
                wrong = mesh.copy()
                wrong.surfaces["inlet"] = facets
                if name == "pieces":
                    del wrong.surfaces["outlet"]
                wrong.write(self.base / "wrong.msh")
                self.assertRegex(self.check("wrong.msh").stdout, f"(?m)^warning: opening inlet {what}")
        bent = mesh.copy()
        nodes = np.unique(inlet)
        bent.points[nodes, 2] -= 0.3 * (1.43**2 - (bent.points[nodes, :2] ** 2).sum(axis=1))
        bent.write(self.base / "wrong.msh")
        self.assertRegex(
            self.check("wrong.msh").stdout, "(?m)^warning: opening inlet is bent: its vertices are up to 0"
        )
        oval = mesh.copy()
        oval.points[:, 0] *= 2
        oval.write(self.base / "oval.msh")
        process = self.check("oval.msh")
        self.assertEqual(process.returncode, 0, process.stdout)
        self.assertRegex(
            process.stdout, r"(?m)^opening inlet: .* flat, not round: its rim is 1\.\d+ to 2\.\d+ mm from there"
        )

    def test_corner_tetrahedra(self):
        # A cube in five: each of four tetrahedra has a corner of the cube for itself.
        points = np.array([(x, y, z) for x in (0, 2) for y in (0, 2) for z in (0, 2)], dtype=float)
        cells = np.array([[0, 3, 5, 6], [1, 0, 3, 5], [2, 0, 3, 6], [4, 0, 5, 6], [7, 3, 5, 6]])
        x = points[cells]
        wrong = np.linalg.det(x[:, 1:] - x[:, :1]) < 0
        cells[wrong] = cells[wrong][:, [0, 2, 1, 3]]
        sides = np.concatenate([cells[:, list(s)] for s in ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3))])
        ends = {n: sides[(points[sides, 2] == z).all(axis=1)] for n, z in (("inlet", 0), ("outlet", 2))}
        mesh = Mesh(points, {"fluid": cells}, ends)
        text = self.expect_stop(
            mesh, r".*with the element p2p1.*cells of the fluid in corners.*at \(.*refine wrong.msh --times 0"
        )
        process = execute(MESH, "refine", "wrong.msh", "--times", "0", "-o", "NEW.msh", "-q", cwd=self.base)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertNotIn("in corners", self.check("NEW.msh").stdout)
        (self.base / "NEW.msh").unlink()

    def test_formats_of_others(self):
        mesh = self.artery()
        cells = np.concatenate([*mesh.volumes.values()])
        region = np.repeat(np.arange(1, 4), [len(c) for c in mesh.volumes.values()])
        for name in ("mesh.vtu", "mesh.xdmf"):
            with self.subTest(name):
                meshio.Mesh(mesh.points, [("tetra", cells)], cell_data={"region": [region]}).write(self.base / name)
                process = self.check(name)
                self.assertEqual(process.returncode, 1)
                self.assertRegex(process.stdout, r"(?m)^taken for: fluid=region:1, ")
                self.assertRegex(process.stdout, "(?m)^stops .*: wall_ends: the physical surface is missing")
                self.assertNotRegex(process.stdout, "check-|fsi-mesh-")

    def test_the_command_that_mends_a_mesh_without_names_does(self):
        """In another unit; a coordinate that is zero to rounding is shown as zero."""
        mesh = self.artery()
        points = (mesh.points + [0, 0, -1.5]) / 10 + [1e-17, -2e-17, 0]
        meshio.Mesh(points, [("tetra", mesh.volumes["fluid"])]).write(self.base / "bare.vtu")
        process = self.check("bare.vtu", "--scale", 10, "--threads", 1)
        self.assertEqual(process.returncode, 1)
        self.assertNotRegex(process.stdout, r"\de-\d")
        command = shlex.split(re.search(r"; fsi-mesh (import .*) names them$", process.stdout, re.MULTILINE).group(1))
        process = execute(MESH, *command, "-q", cwd=self.base)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        process = self.check("NEW.msh")
        (self.base / "NEW.msh").unlink()
        self.assertEqual((process.returncode, process.stderr), (0, ""), process.stdout)
        self.assertEqual(process.stdout.count("\nopening NAME"), 2)
        # Of lumen and wall that do not touch, too.
        moved = mesh.points + [0, 0, 0.01]
        cells = [mesh.volumes["fluid"], mesh.volumes["media"] + len(mesh.points)]
        meshio.Mesh(
            np.vstack([mesh.points, moved]),
            [("tetra", np.concatenate(cells))],
            cell_data={"region": [np.repeat([1, 2], [len(c) for c in cells])]},
        ).write(self.base / "apart.vtu")
        self.assertRegex(
            self.check("apart.vtu").stdout,
            r"(?m)^warning: a gap: .*: fsi-mesh import apart.vtu --group fluid=region:1 --group wall=region:2 -o NEW.msh$",
        )

    def test_what_cannot_be_read_is_one_line(self):
        (self.base / "no.msh").write_text("no mesh\n")
        (self.base / "no.vtu").write_text("<VTKFile")
        (self.base / "no.stl").write_text("solid\n")
        for name in ("no.msh", "no.vtu", "no.stl", "absent.e", "absent.msh", "absent.stl", "."):
            with self.subTest(name):
                process = self.check(name)
                self.assertEqual((process.returncode, process.stdout), (1, ""))
                self.assertRegex(process.stderr, r"\Afsi-mesh: error: [^\n]+\n\Z")

    def test_surfaces(self):
        points, triangles = self.tube()
        self.write_stl("open.stl", points, triangles)
        process = self.check("open.stl")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertEqual(len(re.findall(r"(?m)^opening \d: a hole, .* radius 0\.9\d* mm, at", process.stdout)), 2)
        self.write_stl("wrong.stl", points, np.vstack([triangles, [[0, 1, 30]]]))
        process = self.check("wrong.stl")
        self.assertEqual(process.returncode, 1)
        self.assertRegex(process.stdout, r"(?m)^stops fsi-mesh lumen: ")
        self.write_stl("metres.stl", 1e-3 * points, triangles)
        self.assertRegex(self.check("metres.stl").stdout, r"(?m)^stops fsi-mesh lumen: --unit: is not given, and in mm")
        self.assertEqual(self.check("metres.stl", "--unit", "m").returncode, 0)


class NoLumen(Surfaces):
    """Closed surfaces: slightly domed ends are found; where there is none, it is said what the surface is."""

    def closed(self, dome, around=24, rings=4):
        points, triangles = self.tube(around, 16)
        points, triangles = list(points), list(triangles)
        for first, end, z in ((0, -1, 0.0), (16 * around, 1, 8.0)):
            before = [first + i for i in range(around)]
            for r in range(rings - 1, 0, -1):
                s = r / rings
                now = [len(points) + i for i in range(around)]
                points += [
                    (s * np.cos(a), s * np.sin(a), z + end * dome * (1 - s**2))
                    for a in 2 * np.pi * np.arange(around) / around
                ]
                for i in range(around):
                    j = (i + 1) % around
                    both = [(before[i], before[j], now[j]), (before[i], now[j], now[i])]
                    triangles += [t[::end] for t in both]
                before = now
            points.append((0, 0, z + end * dome))
            triangles += [(before[i], before[(i + 1) % around], len(points) - 1)[::end] for i in range(around)]
        return np.array(points), np.array([list(t) for t in triangles])

    def listed(self, name):
        return execute(MESH, "lumen", name, "--list-openings", cwd=self.base)

    def lumen(self, name, *options):
        return execute(MESH, "lumen", name, "-o", "lumen.msh", *options, cwd=self.base)

    def test_ends_may_be_slightly_domed(self):
        for dome in (0.0, 0.05, 0.1, 0.2):  # of the radius
            with self.subTest(dome=dome):
                self.write_stl("domed.stl", *self.closed(dome))
                process = self.listed("domed.stl")
                self.assertEqual((process.returncode, process.stderr), (0, ""))
                rows = process.stdout.splitlines()[1:]
                self.assertEqual(len(rows), 2, process.stdout)
                area = 12 * np.sin(np.pi / 12)  # of 24 sides
                for row in rows:
                    self.assertAlmostEqual(float(row.split()[1]), area, delta=2e-3)
                self.assertEqual(len(re.findall(r"\(0, 0, [08]\) mm", process.stdout)), 2)

    def test_a_seam_that_rounding_opens_is_closed(self):
        """As of scripts that go once around, cos(2 pi) in the place of cos(0); points a thousandth apart are two."""
        points, triangles = self.closed(0.0)
        for away, code in ((3e-16, 0), (1e-3, 1)):
            seam = np.flatnonzero(np.abs(points[:, 1]) < 1e-9)
            seam = seam[points[seam, 0] > 0.5]
            new = np.arange(len(points))
            new[seam] = len(points) + np.arange(len(seam))
            below = points[triangles].mean(axis=1)[:, 1] < 0
            rows = np.where(below[:, None], new[triangles], triangles)
            corners = np.vstack([points, points[seam] - [0, away, 0]])
            text = [f"v {x!r} {y!r} {z!r}" for x, y, z in corners.tolist()]
            text += ["f " + " ".join(str(n + 1) for n in row) for row in rows]
            (self.base / "seam.obj").write_text("\n".join(text) + "\n")
            process = self.listed("seam.obj")
            self.assertEqual(process.returncode, code, process.stdout + process.stderr)
            if code == 0:
                self.assertEqual((process.stderr, len(process.stdout.splitlines())), ("", 3))
            else:  # there is no end then, but one hole
                said = r"error: seam\.obj: surface: has a slit near \(.*\) mm, as points that are there twice leave; "
                self.assertRegex(process.stderr, said)

    def test_a_wall_with_both_faces_is_no_lumen(self):
        points, triangles = self.tube()
        count = len(points)
        both = np.vstack([points, points * [1.3, 1.3, 1]])
        faces = [triangles[:, ::-1], triangles + count]
        for first, end in ((0, 1), (8 * 12, -1)):
            i, j = first + np.arange(12), first + (np.arange(12) + 1) % 12
            ring = np.vstack([np.stack([i, j, j + count], 1), np.stack([i, j + count, i + count], 1)])
            faces.append(ring[:, ::end])
            self.write_stl("wall.stl", both, np.vstack(faces))
            process = self.listed("wall.stl")
            self.assertEqual(process.returncode, 1)
            self.assertEqual(len(process.stdout.splitlines()), 3 if end == 1 else 0, process.stdout)  # of openings
            what = (
                "openings 1 and 2 lie around each other"
                if end == 1
                else "is closed and runs through itself like a ring"
            )
            self.assertRegex(process.stderr, rf"\Afsi-mesh: error: wall\.stl: surface: {what}.*\n\Z")
            self.assertRegex(self.check("wall.stl").stdout, f"(?m)^stops fsi-mesh lumen: surface: {what}")
            named = ("--opening", "a=1", "--opening", "b=2") if end == 1 else ()
            process = self.lumen("wall.stl", *named)
            self.assertEqual((process.returncode, process.stdout), (1, ""))
            self.assertRegex(process.stderr, rf"\Afsi-mesh: error: wall\.stl: surface: {what}.*\n\Z")

    def test_a_slit_is_closed_or_refused(self):
        """The list, check and the mesh say the same of it, and how it is closed."""
        points, triangles = self.tube(12, 24)
        row = 12 * np.arange(9, 16)  # a line of nodes along the tube, split between its ends
        doubled = row[1:-1]
        new = np.arange(len(points))
        new[doubled] = len(points) + np.arange(len(doubled))
        beside = points[triangles].mean(axis=1)[:, 1] < 0
        rows = np.where(beside[:, None], new[triangles], triangles)
        both = np.vstack([points, points[doubled] - [0, 0.01, 0]])
        self.write_stl("slit.stl", both, rows)
        said = (
            r"surface: has a slit near \(.*\) mm, as points that are there twice leave; "
            r"join them, or give --closed (\d+), its number in --list-openings"
        )
        process = self.listed("slit.stl")
        self.assertEqual((process.returncode, len(process.stdout.splitlines())), (1, 4), process.stderr)
        self.assertRegex(process.stderr, rf"\Afsi-mesh: error: slit\.stl: {said}\n\Z")
        place = re.search(said, process.stderr).group(1)
        process = self.check("slit.stl")
        self.assertRegex(process.stdout, rf"(?m)^stops fsi-mesh lumen: {said}$")
        self.assertIn("slit.stl: one of the lines above would stop fsi-mesh lumen;", process.stderr)
        named = ("--opening", "a=0,0,0", "--opening", "b=0,0,12")
        for options in (named, (*named, "--opening", f"c={place}")):
            process = self.lumen("slit.stl", *options)
            self.assertRegex(process.stderr, rf"\Afsi-mesh: error: slit\.stl: {said}\n\Z")
        process = self.lumen("slit.stl", *named, "--closed", place, "--smoothing", "0")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertIn(" is closed.", process.stdout)
        process = self.lumen("slit.stl", "--closed", "1", "--closed", "2", "--closed", "3")
        self.assertIn("fsi-mesh: error: --closed: leaves the surface no opening;", process.stderr)

    def test_a_surface_without_ends(self):
        points, triangles = self.closed(2.0)
        self.write_stl("long.stl", points, triangles)
        process = self.listed("long.stl")
        self.assertEqual((process.returncode, process.stdout), (1, ""))
        self.assertIn("long.stl: surface: is closed, and no part of it is an end", process.stderr)


if __name__ == "__main__":
    unittest.main()
