"""fsi-mesh lumen: from a segmented surface to the mesh of a lumen, and on to a run."""

import contextlib
import math
import os
import re
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

from programs import MESH, MONOLITHIC, FolderTest, attempt, execute, run
from vtp_files import write_vtp

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "gallery" / "carotid-from-stl"))
import surface as carotid  # noqa: E402

NOBODY = 65534
NAMES = tuple(f"--opening={name}={','.join(map(str, at))}" for name, at in carotid.OPENINGS.items())
CASE = """
element = "p1"
[mesh]
file = "wall.msh"
[fluid]
density = 1.06
viscosity = 3.5e-3
[structure]
density = 1.2
bulk_modulus = 1e4
[structure.layers.media]
material = "neo-hookean"
c10 = 60
[[opening]]
surface = "cca"
pressure = 0.2
[[opening]]
surface = "ica"
pressure = 0.0
[[opening]]
surface = "eca"
pressure = 0.0
[time]
step = 0.5
end = 0.5
"""
AT_REST = """
element = "p2p1"
[mesh]
file = "wall.msh"
[structure]
density = 1.2
bulk_modulus = 1e7
[structure.layers.media]
material = "neo-hookean"
c10 = 3.0
[[support]]
surface = "wall_ends"
fixed = ["normal"]
[[support]]
surface = "outer"
spring = 1e-6   # kPa/mm: against motions as a whole
[load]
pressure = PRESSURE
[static]
load_steps = 4
[newton]
tolerance = 1e-9
[output]
every = 4
fields = ["displacement", "von_mises_stress"]
"""


def tube(radius=2.0, length=12.0, around=20, slant=0.0):
    """Nodes and triangles of an open tube along z; its upper end leans by `slant` along x."""
    rows = round(length * around / (2 * math.pi * radius))
    angle = 2 * math.pi * (np.arange(around)[None, :] + 0.5 * (np.arange(rows + 1)[:, None] % 2)) / around
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    z = (length + slant * x) * np.arange(rows + 1)[:, None] / rows
    triangles = []
    for row in range(rows):
        for i in range(around):
            a, b = row * around + i, row * around + (i + 1) % around
            c, d = a + around, b + around
            triangles += [(a, b, d), (a, d, c)] if row % 2 else [(a, b, c), (b, d, c)]
    return np.stack((x, y, z), axis=-1).reshape(-1, 3), np.array(triangles)


class MeshLumen(FolderTest):
    def write(self, nodes, triangles, scale=1.0, name="lumen.stl"):
        carotid.write_stl(self.base / name, nodes, triangles, scale)

    def lumen(self, *options, name="lumen.stl"):
        (self.base / "lumen.msh").unlink(missing_ok=True)
        return execute(MESH, "lumen", self.base / name, "-o", self.base / "lumen.msh", "--format", "2.2", *options)

    def listed(self, *options, name="lumen.stl"):
        process = execute(MESH, "lumen", self.base / name, "--list-openings", *options)
        self.assertEqual(process.returncode, 0, process.stderr)
        return process.stdout

    def done(self, process):
        """Volume and smallest mean ratio of the fluid."""
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        row = re.search(r"^fluid +\d+ +([\d.]+) +([\d.]+)", process.stdout, re.MULTILINE)
        return float(row.group(1)), float(row.group(2))

    def expect(self, process, *words):
        self.assertEqual(process.returncode, 1, process.stdout)
        self.assertEqual(len(process.stderr.splitlines()), 1, process.stderr)
        for word in words:
            self.assertIn(word, process.stderr)
        self.assertFalse((self.base / "lumen.msh").exists())

    def surface(self, name):
        """Points and triangles of a surface of lumen.msh."""
        text = (self.base / "lumen.msh").read_text()
        number = re.search(rf'^2 (\d+) "{name}"', text, re.MULTILINE).group(1)
        lines = text.splitlines()
        start, end = lines.index("$Nodes") + 2, lines.index("$EndNodes")
        nodes = {line.split()[0]: np.array(line.split()[1:], dtype=float) for line in lines[start:end]}
        start, end = lines.index("$Elements") + 2, lines.index("$EndElements")
        elements = [line.split() for line in lines[start:end]]
        return np.array([[nodes[n] for n in e[-3:]] for e in elements if e[1] == "2" and e[3] == number])

    def plane(self, name):
        """Centre, unit normal and area of a flat surface, and how far its points are off."""
        corners = self.surface(name)
        areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
        normal = areas.sum(axis=0) / np.linalg.norm(areas.sum(axis=0))
        sizes = areas @ normal
        self.assertTrue((sizes > 0).all())
        centre = (corners.mean(axis=1) * sizes[:, None]).sum(axis=0) / sizes.sum()
        return centre, normal, sizes.sum(), np.abs((corners - centre) @ normal).max()

    def test_clean_jittered_open_and_closed(self):
        step = 0.25
        low, high = np.array((-9, -5, -12)), np.array((9, 5, 14))
        cells = np.meshgrid(*(np.arange(low[k] + step / 2, high[k], step) for k in range(3)), indexing="ij")
        exact = (carotid.level(np.stack(cells, axis=-1)) < 0).sum() * step**3
        for jitter, closed in ((0, True), (0.05, False)):
            with self.subTest(jitter=jitter, closed=closed):
                self.write(*carotid.carotid(jitter=jitter, closed=closed))
                text = self.listed()
                self.assertEqual(text.count("flat part" if closed else "hole"), 3, text)
                process = self.lumen(*NAMES, "--edge-length", 0.9)
                volume, worst = self.done(process)
                # Facets of 0.9 mm take 3.3 % of the area of a branch of radius 2, 1.5 % of one of radius 3.
                self.assertAlmostEqual(volume / exact, 0.98, delta=0.01)
                self.assertGreater(worst, 0.25)
                change = re.search(r"Smoothed 20 times: .* \(([+-][\d.]+) %\)", process.stdout)
                self.assertLess(abs(float(change.group(1))), 1)
                for name, at in carotid.OPENINGS.items():
                    centre, normal, area, off = self.plane(name)
                    self.assertLess(np.linalg.norm(centre - at), 0.25)
                    self.assertLess(off, 1e-9)
                    self.assertGreater(abs(normal[2]), 0.999)
                    self.assertGreater(area, 9)

    def test_from_surface_to_run(self):
        self.write(*carotid.carotid(jitter=0.05))
        self.done(self.lumen(*NAMES, "--edges-per-diameter", 4))
        process = execute(
            MESH, "thicken", self.base / "lumen.msh", "-o", self.base / "wall.msh", "--layer", "media=0.4"
        )
        self.assertEqual(process.returncode, 0, process.stderr)
        (self.base / "case.toml").write_text(CASE)
        process = attempt(MONOLITHIC, self.base / "case.toml", "-q", folder=self.base / "out")
        self.assertEqual((process.returncode, process.stderr), (0, ""))

    def test_edges_by_curvature(self):
        """Where branches part the surface bends round: edges are shorter there, and no shorter than the bound."""
        self.write(*carotid.carotid())
        plain = self.done(self.lumen(*NAMES, "--edge-length", 1.2))
        bent = self.lumen(*NAMES, "--edge-length", 1.2, "--edges-per-curvature", 6, "--shortest-edge", 0.6)
        said = re.search(r"6 per diameter of curvature, of ([\d.]+) to ([\d.]+) mm", bent.stdout)
        self.assertGreaterEqual(float(said.group(1)), 0.6)
        self.assertLessEqual(float(said.group(2)), 1.2)
        self.assertAlmostEqual(self.done(bent)[0] / plain[0], 1, delta=0.03)

    def test_cut_and_extension(self):
        """A tube whose end is slanted by 27 degrees, not along an axis: the cut is square to it, the extension round."""
        turn = np.linalg.qr(np.array(((1.0, 2, 3), (3, 1, 2), (2, 3, 1))))[0]
        turn *= np.sign(np.linalg.det(turn))
        nodes, triangles = tube(slant=0.5, around=40)
        nodes[:, 1] *= 0.8  # an ellipse
        self.write(nodes @ turn.T, triangles)
        axis, end = turn[:, 2], 12 * turn[:, 2]
        names = (f"--opening=inlet={','.join(map(str, 0 * end))}", f"--opening=outlet={','.join(map(str, end))}")
        self.done(self.lumen(*names, "--smoothing", 0, "--cut", "outlet=2"))
        centre, normal, area, off = self.plane("outlet")
        self.assertGreater(normal @ axis, math.cos(math.radians(0.5)))
        # 2 mm along the slanted end's normal, then along the axis to it: the place on the axis.
        self.assertLess(np.linalg.norm(centre - (centre @ axis) * axis), 0.05)
        self.assertAlmostEqual(area / (math.pi * 4 * 0.8), 1, delta=0.03)
        length = centre @ axis
        self.done(self.lumen(*names, "--smoothing", 0, "--cut", "outlet=2", "--extension", "outlet=1.5"))
        centre, normal, area, off = self.plane("outlet")
        self.assertLess(off, 1e-9)
        self.assertAlmostEqual((centre @ axis - length) / (1.5 * 2 * math.sqrt(4 * 0.8)), 1, delta=0.02)
        once = {}
        for corners in self.surface("outlet").tolist():
            for a, b in zip(corners, corners[1:] + corners[:1]):
                key = frozenset((tuple(a), tuple(b)))
                once[key] = key not in once
        away = [math.dist(x, centre) for edge, is_rim in once.items() if is_rim for x in edge]
        self.assertLess(max(away) / min(away), 1.03)  # of the ellipse 1.25
        self.assertAlmostEqual(max(away), 2 * math.sqrt(0.8), delta=0.06)

    def test_boundary_layers(self):
        """Layers of 0.1, 0.15 and 0.225 mm in a tube: as thick as asked, in the lumen, and their ends in the openings."""
        self.write(*tube(around=32))
        named = ("--opening=inlet=0,0,0", "--opening=outlet=0,0,12", "--smoothing", 0)
        volume, _ = self.done(self.lumen(*named))
        area = self.plane("outlet")[2]
        process = self.lumen(*named, "--layers", 3, "--first-thickness", 0.1, "--growth", 1.5)
        self.assertAlmostEqual(self.done(process)[0] / volume, 1, delta=1e-9)
        self.assertIn("3 layers along the wall: 0.1 mm at the wall, 0.475 mm together", process.stdout)
        centre, normal, with_layers, off = self.plane("outlet")
        self.assertAlmostEqual(with_layers / area, 1, delta=1e-9)
        self.assertLess(off, 1e-9)
        # Along each column of nodes that begins on the rim.
        points = np.unique(self.surface("outlet").reshape(-1, 3).round(9), axis=0)
        radius = np.hypot(points[:, 0], points[:, 1])
        for depth in (0, 0.1, 0.25, 0.475):
            self.assertGreater((np.abs(radius - 2 + depth) < 0.03).sum(), 20, depth)
        for depth in (0.05, 0.175, 0.36):
            self.assertEqual((np.abs(radius - 2 + depth) < 0.02).sum(), 0, depth)
        # Of the Stokes layer, sqrt(2) 2 / 8 mm.
        process = self.lumen(*named, "--layers", 3, "--womersley", 8)
        self.assertRegex(process.stdout, r"3 layers along the wall: .*, 0.35\d? mm together")
        self.done(process)
        process = execute(
            MESH, "thicken", self.base / "lumen.msh", "-o", self.base / "wall.msh", "-q", "--layer", "a=0.3"
        )
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        for options, words in (
            (("--layers", 3), ("--layers: has no thickness", "--womersley")),
            (("--womersley", 3), ("--layers: is not given",)),
            (
                ("--layers", 3, "--first-thickness", 0.4),
                ("--layers: are 1.46 mm thick together", "more than 0.4 of the radius"),
            ),
        ):
            self.expect(self.lumen(*named, *options), *words)

    def test_quadratic_layers_and_the_wall_on_them(self):
        """Edges of the wall and of layers thinner than their sagitta are curved: the volume is the cylinder's, no cell folds, and a
        wall that grows on it bears the stress of a thick tube (as in mesh_thicken, docs/theory.md, section 13.1)."""
        inner, outer, length, c10, k = 1.43, 1.69, 1.4, 3.0, 1.43**2 * (1.1**2 - 1)
        self.write(*tube(inner, length, around=160))
        options = ("--opening=in=0,0,0", f"--opening=out=0,0,{length}", "--smoothing=0", "--edge-length=0.7")
        layers = ("--layers=3", "--first-thickness=0.03")
        volume = length * math.pi * inner**2
        self.assertLess(self.done(self.lumen(*options, *layers))[0], 0.98 * volume)
        for extra in ((), layers):
            process = self.lumen(*options, *extra, "--order=2")
            self.assertAlmostEqual(self.done(process)[0] / volume, 1, delta=2e-3)
            self.assertIn("edges of the lumen's surface are curved", process.stdout)
        self.assertIn("Edges in the layers follow them.", process.stdout)
        media = f"media={outer - inner:g}"
        process = execute(MESH, "thicken", self.base / "lumen.msh", "-o", self.base / "wall.msh", "--layer", media)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertNotIn("left straight", process.stderr)  # that cells are thin is warned of
        self.assertIn("The lumen's edges are curved as in its mesh.", process.stdout)
        a, b = math.sqrt(inner**2 + k), math.sqrt(outer**2 + k)
        pressure = c10 * (math.log(outer * a / (inner * b)) + 0.5 * k * (a**-2 - b**-2))
        (self.base / "rest.toml").write_text(AT_REST.replace("PRESSURE", repr(pressure)))
        with h5py.File(run(MONOLITHIC, self.base / "rest.toml", self.base / "rest") / "fields.h5") as file:
            wall = file["wall"]
            points, cells = wall["points"][:], wall["cells"][:]
            found = wall["von_mises_stress"][max(wall["von_mises_stress"])][:]
        radius = np.hypot(points[:, 0], points[:, 1])
        face = np.isin(np.arange(len(points)), cells) & (np.abs(radius - inner) < 3e-3)
        self.assertGreater(face.sum(), 100)
        stretch = 1 + k / inner**2  # squared, around
        principal = np.array([1 / stretch, stretch, 1.0])
        error = found[face] / (c10 * math.sqrt(1.5 * ((principal - principal.mean()) ** 2).sum())) - 1
        print(f"von Mises stress at {face.sum()} nodes: mean {error.mean():+.4f}, worst {np.abs(error).max():.4f}")
        self.assertLess(abs(error.mean()), 0.01)
        self.assertLess(np.abs(error).max(), 0.03)

    def test_every_format_gives_the_same(self):
        nodes, triangles = tube()
        named = ("--opening=inlet=0,0,0", "--opening=outlet=0,0,12", "--edge-length", 0.9)
        faces = "\n".join(f"3 {a} {b} {c}" for a, b, c in triangles)
        points = "\n".join(" ".join(map(repr, x)) for x in nodes.tolist())
        ply = f"ply\nformat ascii 1.0\nelement vertex {len(nodes)}\nproperty double x\nproperty double y\nproperty double z\n"
        ply += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n{points}\n{faces}\n"
        (self.base / "lumen.ply").write_text(ply)
        lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in nodes.tolist()] + [
            f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles
        ]
        (self.base / "lumen.obj").write_text("\n".join(lines) + "\n")
        found = {}
        for name in ("lumen.ply", "lumen.obj"):
            found[name] = self.done(self.lumen(*named, name=name))
        for form in ("ascii", "binary", "zlib", "raw"):
            write_vtp(self.base / "lumen.vtp", nodes, triangles, form)
            found[form] = self.done(self.lumen(*named, name="lumen.vtp"))
        self.assertEqual(len(set(found.values())), 1, found)
        self.write(nodes, triangles)  # numbers of four bytes
        self.assertAlmostEqual(self.done(self.lumen(*named))[0] / found["raw"][0], 1, delta=1e-3)
        (self.base / "lumen.stl").write_bytes((self.base / "lumen.stl").read_bytes()[:5000])
        self.expect(self.lumen(*named), "lumen.stl", "cannot be read as .stl")
        self.expect(self.lumen(*named, name="none.stl"), "no such file")
        self.base.chmod(0o755)
        (self.base / "lumen.stl").chmod(0)
        with contextlib.suppress(PermissionError):  # the programs may lie where only root may look
            options = {"user": NOBODY} if os.geteuid() == 0 else {}
            process = execute(MESH, "lumen", self.base / "lumen.stl", "--list-openings", **options)
            self.expect(process, "lumen.stl: cannot be read; check its permissions")
        (self.base / "lumen.stl").chmod(0o644)
        (self.base / "empty.stl").touch()
        self.expect(self.lumen(*named, name="empty.stl"), "empty.stl: holds no triangles")
        (self.base / "lumen.vtp").write_text("<VTKFile")
        self.expect(self.lumen(*named, name="lumen.vtp"), "lumen.vtp: is cut off")

    def test_mended_and_said(self):
        nodes, triangles = tube()
        named = ("--opening=inlet=0,0,0", "--opening=outlet=0,0,12")
        self.write(nodes, triangles)
        right = self.done(self.lumen(*named))
        self.write(nodes, triangles[:, ::-1])
        process = self.lumen(*named)
        self.assertEqual(self.done(process)[0], right[0])
        self.assertIn("All triangles looked inwards and are turned.", process.stdout)
        some = triangles.copy()
        some[10:20] = some[10:20, ::-1]
        self.write(nodes, np.vstack((some, triangles[:3])))
        process = self.lumen(*named)
        self.assertEqual(self.done(process)[0], right[0])
        self.assertIn("10 triangles looked the other way", process.stdout)
        self.assertIn("3 triangles that were there twice are left out.", process.stdout)
        # A hole in the wall, closed smoothly; a tube in cm; an island.
        self.write(nodes, triangles[np.linalg.norm(nodes[triangles].mean(axis=1) - (2, 0, 6), axis=1) > 0.8])
        self.assertAlmostEqual(self.done(self.lumen(*named, "--closed", "2,0,6"))[0] / right[0], 1, delta=5e-3)
        self.write(nodes, triangles, 0.1)
        self.assertAlmostEqual(self.done(self.lumen(*named, "--unit", "cm"))[0] / right[0], 1, delta=1e-3)
        process = self.lumen("--list-openings", "--unit", "m")
        self.assertEqual(process.returncode, 0)
        self.assertRegex(process.stderr, r"--unit m: the widest opening, at \(.*\) mm, measures .* as no vessel's does")
        self.write(np.vstack((nodes, nodes + (9, 0, 0))), np.vstack((triangles, triangles[:40] + len(nodes))))
        self.assertAlmostEqual(self.done(self.lumen(*named, "--largest-shell"))[0] / right[0], 1, delta=1e-3)
        self.expect(self.lumen(*named), "surface: has 2 shells", "--largest-shell")

    def test_what_is_wrong_is_named(self):
        nodes, triangles = tube()
        named = ("--opening=inlet=0,0,0", "--opening=outlet=0,0,12")
        self.write(nodes, triangles)
        for options, words in (
            ((), ("--opening: is not given for number 1 at (0, 0, ", "--list-openings")),
            ((*named, "--opening", "b=0,0,12"), ("--opening b: is the same opening as outlet",)),
            ((*named[:1], "--opening", "b=3"), ("--opening b: there is no opening 3", "has 2")),
            ((*named[:1], "--opening", "b=0,0,90"), ("(0, 0, 90) mm is 78 mm away from the nearest opening",)),
            ((*named[:1], "--opening", "b"), ("is no NAME=NUMBER",)),
            ((*named[:1], "--opening", "wall=2"), ("is a name with another meaning",)),
            ((*named, "--closed", "2"), ("--closed: is the opening",)),
            ((*named, "--cut", "aorta=1"), ("--cut aorta: is no opening; the openings are",)),
            ((*named, "--cut", "inlet=-1"), ("is no NAME=LENGTH",)),
            ((*named, "--cut", "inlet=20"), ("--cut inlet: the plane at",)),
            ((*named, "--edge-length", 1, "--edges-per-diameter", 4), ("--edge",)),
        ):
            with self.subTest(options=options):
                self.expect(self.lumen(*options), *words)
        self.write(nodes, triangles, 1e-3)
        self.expect(self.lumen(*named), "--unit: is not given", "0.00397 mm", "the file may be in m")
        wave = 1.2 * np.sin(1.5 * nodes[:, [1]]) * np.clip((nodes[:, [2]] - 8) / 4, 0, 1)
        self.write(nodes + wave * (0, 0, 1), triangles)
        self.expect(
            self.lumen(*named, "--smoothing", 0), "--opening outlet: its rim at", "off a plane", "--cut outlet="
        )
        pushed = nodes.copy()
        pushed[np.linalg.norm(nodes - (2, 0, 6), axis=1) < 0.5] -= (4.5, 0, 0)  # through the other side
        self.write(pushed, triangles)
        self.expect(self.lumen(*named), "surface: cuts itself: ", "pairs of triangles cross, one at (-")
        edge = np.vstack((nodes, (5, 0, 6)))
        self.write(edge, np.vstack((triangles, (*triangles[200, :2], len(nodes)))))
        self.expect(self.lumen(*named), "lumen.stl: edge at (", "3 triangles meet there")
        self.write(*tube(around=4))
        self.expect(self.lumen(*named, "--smoothing", 1000), "--smoothing: 1000 passes change the volume from")


if __name__ == "__main__":
    unittest.main()
