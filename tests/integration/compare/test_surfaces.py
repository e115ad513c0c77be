"""Surfaces of runs, cuts through them, their packing for a page, the renderer of stills, and the command `picture`: on meshes
whose areas and values are known."""

import base64
import unittest
import zlib

import numpy as np
from folder_case import FolderCase
from synthetic import write_run
from synthetic_fields import (
    boxes,
    channel,
    channel_fields,
    displacement,
    half_plane,
    LENGTH,
    pressure,
    TIMES,
    WALL,
    WIDTH,
    write_fields,
    write_turned,
)

from fsi_compare import InputError, open_run
from fsi_compare.drawing.camera import Camera
from fsi_compare.drawing.colours import scale_of, scale_of_difference
from fsi_compare.drawing.raster import BACKGROUND, Mesh, rendered
from fsi_compare.drawing.sweep import OPEN, swept
from fsi_compare.reporting.first_read import constants_table, periodic_end, thickness_table
from fsi_compare.reporting.scene_packing import NONE, packed_counts, packed_numbers
from fsi_compare.reporting.scene_thinning import clustered
from fsi_compare.results.boundary import boundary_of, normals_of
from fsi_compare.runs.steadiness import cycle_change, period_of, sawtooth

UP = np.array([0.0, 0.0, 1.0])


def area(surface):
    return np.linalg.norm(normals_of(surface.points, surface.triangles, UP), axis=1).sum()


def quadratic(points, cells):
    """The same tetrahedra with nodes in the middle of their edges, in VTK's order."""
    edges = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
    ends, middle = np.unique(np.sort(cells[:, edges].reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    return np.concatenate([points, points[ends].mean(axis=1)]), np.hstack([cells, len(points) + middle.reshape(-1, 6)])


class OfAChannel(FolderCase):
    def setUp(self):
        super().setUp()
        self.folder = write_run(self.base / "run", lambda t, z: z + t, geometry="3d")
        write_fields(self.folder)

    def test_areas(self):
        run = open_run(self.folder)
        side = WIDTH * LENGTH
        for name, size in (
            ("interface", side),
            ("inner", side),
            ("lumen", 4 * side),
            ("openings", 2 * WIDTH**2),
            ("out", WIDTH**2),
            ("outer", side + 2 * WALL * LENGTH + 2 * WALL * WIDTH),
        ):
            surface = run.surface(name)
            self.assertAlmostEqual(area(surface), size, places=9, msg=name)
            self.assertEqual(surface.cells.reshape(-1, 4)[:, 0].tolist(), [3] * len(surface.triangles))
        outwards = normals_of(run.surface("out").points, run.surface("out").triangles, UP)
        self.assertTrue((outwards[:, 2] > 0).all())

    def test_values_are_those_of_the_nodes(self):
        run = open_run(self.folder)
        lumen = run.surface("lumen")
        np.testing.assert_array_equal(lumen.at(3.0, "pressure"), run.fields["fluid"].at(3.0, "pressure")[lumen.nodes])
        np.testing.assert_array_equal(lumen.points, run.fields["fluid"].points[lumen.nodes])

    def test_quadratic_cells(self):
        mesh = {name: quadratic(*part) for name, part in channel().items()}
        write_fields(self.folder, mesh)
        run = open_run(self.folder)
        self.assertAlmostEqual(area(run.surface("lumen")), 4 * WIDTH * LENGTH, places=9)
        self.assertEqual(len(run.surface("interface").triangles), 4 * 2 * 2 * 6)  # four of each face
        self.assertEqual(run.meshes.openings, ["in<b>", "out"])

    def of_two_outlets(self, up, down):
        """A parabola of velocity flows out at both ends: its flows are `up` at z = 0, `down` at the other."""
        points, cells = quadratic(*channel()["fluid"])
        speed = lambda p, t: 6 * t * p[:, 0] * (1 - p[:, 0]) * (-up + (up + down) * p[:, 2] / LENGTH)
        along = lambda p, t: np.stack([0 * p[:, 0], 0 * p[:, 0], speed(p, t)], axis=1)
        fields = {"velocity": ("mm/ms", along), "pressure": ("kPa", lambda p, t: np.full(len(p), t))}
        write_fields(self.folder, {"fluid": (points, cells)}, {"fluid": fields})
        rows = [f"{t},{name},{flow * t},{1000 * t},0" for t in TIMES[1:] for name, flow in (("down", down), ("up", up))]
        head = "time_ms,opening,flow_mm3_per_ms,mean_pressure_Pa,windkessel_pressure_Pa"
        (self.folder / "openings.csv").write_text("\n".join([head, *rows, ""]))
        return open_run(self.folder)

    def test_openings_that_differ_little(self):
        run = self.of_two_outlets(1.0, 1.002)
        self.assertEqual(run.meshes.openings, ["down", "up"])
        self.assertEqual(set(run.surface("up").points[:, 2]), {0.0})
        self.assertEqual(set(run.surface("down").points[:, 2]), {LENGTH})

    def test_openings_that_cannot_be_told_apart(self):
        run = self.of_two_outlets(1.0, 1.0)
        self.assertEqual(run.meshes.openings, ["down or up 1", "down or up 2"])
        self.assertAlmostEqual(area(run.surface("openings")), 2 * WIDTH**2, places=9)
        with self.assertRaisesRegex(
            InputError, "has no surface 'up'.* It has lumen, openings, down or up 1, down or up 2"
        ):
            run.surface("up")

    def test_layers_have_nodes_of_their_own(self):
        y, z = np.linspace(0, WIDTH, 3), np.linspace(0, LENGTH, 7)
        inner, outer = (boxes(WIDTH + WALL * np.array(x), y, z) for x in ((0, 0.5), (0.5, 1)))
        wall = np.concatenate([inner[0], outer[0]]), np.concatenate([inner[1], outer[1] + len(inner[0])])
        for media in ({"fluid": channel()["fluid"], "wall": wall}, {"wall": wall}):
            write_fields(self.folder, media, {name: {"displacement": ("mm", displacement)} for name in media})
            run = open_run(self.folder)
            self.assertEqual("inner" in run.meshes.names, "fluid" in media)
            sides = 2 * WIDTH * WALL + 2 * WALL * LENGTH + WIDTH * LENGTH
            self.assertAlmostEqual(area(run.surface("outer")), sides + (0 if "fluid" in media else WIDTH * LENGTH))
        self.assertEqual(run.meshes.openings, [])

    def test_nothing_tells_openings_from_walls(self):
        write_fields(self.folder, factor=0.0)
        self.assertEqual(open_run(self.folder).meshes.openings, [])

    def test_cut(self):
        for mesh in (channel(), {name: quadratic(*part) for name, part in channel().items()}):
            write_fields(self.folder, mesh)
            run = open_run(self.folder)
            origin, normal = np.array([0.3, 0.4, 1.7]), np.array([0.6, 0.0, 0.8])
            cut = run.meshes.cut("fluid", origin, normal)
            np.testing.assert_allclose((cut.points - origin) @ normal, 0, atol=1e-12)
            self.assertAlmostEqual(area(cut), WIDTH * WIDTH / 0.8, places=9)
            np.testing.assert_allclose(cut.at(2.5, "pressure"), pressure(cut.points, 2.5), atol=1e-12)

    def test_fields_of_cells(self):
        mesh, fields = channel(), channel_fields()
        middles = {name: points[cells].mean(axis=1) for name, (points, cells) in mesh.items()}
        fields["fluid"]["error_indicator"] = ("1", lambda p, t: t * middles["fluid"][:, 2])
        write_fields(self.folder, mesh, fields)
        out = open_run(self.folder).surface("out")
        values = out.at(2.0, "error_indicator")
        self.assertTrue(((values > 2 * (LENGTH - LENGTH / 6)) & (values < 2 * LENGTH)).all())

    def test_wrong_names(self):
        run = open_run(self.folder)
        with self.assertRaisesRegex(InputError, "has no surface 'inerface'; did you mean 'interface'"):
            run.surface("inerface")
        (self.folder / "fields.h5").unlink()
        with self.assertRaisesRegex(InputError, "set output.fields and output.every"):
            open_run(self.folder).surface("lumen")

    def test_picture(self):
        figure = open_run(self.folder).picture("wall_shear_stress", 4.0, unit="Pa", factor=2.0)
        texts = [text.get_text() for text in figure.texts]
        self.assertIn("run · t = 4 ms · displacement x 2", texts)
        self.assertTrue(
            any(text.startswith("wall shear stress in Pa (colours end at the 99th percentile") for text in texts)
        )

    def test_picture_of_a_static_run(self):
        (self.folder / "energy.csv").write_text("step,time_ms,wall_isochoric_energy_uJ\n1,1,2\n")
        texts = [text.get_text() for text in open_run(self.folder).picture("displacement", 0.5).texts]
        self.assertIn("run · 0.5 of the load", texts)

    def test_thinner_surfaces_keep_nodes(self):
        write_fields(self.folder, channel((8, 8, 32)))
        run = open_run(self.folder)
        lumen = run.surface("lumen")
        few = clustered(lumen, len(lumen.triangles) // 4)
        self.assertLessEqual(len(few.triangles), len(lumen.triangles) // 4)
        self.assertGreater(len(few.triangles), len(lumen.triangles) // 12)
        np.testing.assert_array_equal(few.points, run.fields["fluid"].points[few.nodes])
        self.assertGreater(area(few), 0.6 * area(lumen))


class Turned(FolderCase):
    def test_parts(self):
        folder = write_run(self.base / "run", lambda t, z: z + t, geometry="axisymmetric")
        run = open_run(write_turned(folder))
        self.assertEqual(run.meshes.names, ["lumen", "openings", "inlet", "outlet", "fluid section"])
        lumen = run.surface("lumen")
        self.assertEqual(lumen.points[:, 0].tolist(), [2.0] * len(lumen.points))
        points, triangles, source = swept(lumen.points, lumen.triangles)
        self.assertEqual(len(points), len(source))
        made = np.linalg.norm(normals_of(points, triangles, UP), axis=1).sum()
        self.assertAlmostEqual(made / ((1 - OPEN / 360) * 2 * np.pi * 2 * 10), 1, delta=2e-3)
        self.assertGreater(len(run.picture().axes), 1)

    def test_boundary_of_triangles(self):
        points, cells = half_plane()
        found = boundary_of(points, cells[:, ::-1], np.array([0.0, -1.0, 0.0]))  # whichever way cells turn
        normals = normals_of(points, found.faces, np.array([0.0, -1.0, 0.0]))
        outwards = points[found.faces].mean(axis=1) - [1, 0, 5]
        self.assertTrue((np.einsum("ij,ij->i", normals, outwards) > 0).all())
        self.assertEqual(len(found.faces), 2 * (8 + 10))


def unpacked(packed):
    """As templates/scene_data.js does it."""
    data = np.frombuffer(zlib.decompress(base64.b64decode(packed["data"])), np.uint8)
    low, high = data.reshape(2, -1).astype(np.uint32)
    numbers = np.cumsum((low + 256 * high).reshape(packed["rows"], -1), axis=0) % 65536
    return np.where(numbers == NONE, np.nan, packed["low"] + packed["step"] * numbers)


class Packing(unittest.TestCase):
    def test_numbers_come_back(self):
        values = np.random.default_rng(1).normal(size=(7, 5, 3))
        values[2, 1, 0] = np.nan
        found = unpacked(packed_numbers(values))
        span = np.nanmax(values) - np.nanmin(values)
        self.assertLessEqual(np.nanmax(np.abs(found - values.reshape(7, 15))), 0.5001 * span / 65534)
        self.assertTrue(np.isnan(found[2, 3]))
        self.assertEqual(unpacked(packed_numbers(np.full((3, 2), 4.5))).tolist(), [[4.5, 4.5]] * 3)

    def test_counts_come_back(self):
        numbers = np.array([[0, 70000, 3], [5, 2, 1 << 24]])
        packed = packed_counts(numbers)
        planes = (
            np.frombuffer(zlib.decompress(base64.b64decode(packed["data"])), np.uint8).reshape(4, -1).astype(np.int64)
        )
        changes = (planes * (256 ** np.arange(4))[:, None]).sum(axis=0)
        self.assertEqual((np.cumsum(changes) % (1 << 32)).tolist(), numbers.ravel().tolist())


class Colours(unittest.TestCase):
    def test_single_nodes_do_not_stretch_the_range(self):
        values = np.linspace(0, 1, 1001)
        values[500] = 1000.0
        scale = scale_of([values, 0.5 * values], signed=False)
        self.assertEqual((scale.low, scale.diverging, scale.largest), (0.0, False, 1000.0))
        self.assertAlmostEqual(scale.high, 0.991, places=3)

    def test_signs(self):
        self.assertEqual((scale_of([np.array([-3.0, 4.0])], True).low), -scale_of([np.array([-3.0, 4.0])], True).high)
        self.assertFalse(scale_of([np.array([3.0, 4.0])], True).diverging)
        self.assertTrue(scale_of_difference([np.array([1.0, 2.0])]).diverging)
        self.assertEqual(scale_of([np.array([0.0, 0.0])], False).high, 1.0)


class Renderer(unittest.TestCase):
    COLOURS = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 3, axis=1)

    def square(self, z, place):
        points = np.array([[0.0, 0, z], [1, 0, z], [1, 1, z], [0, 1, z]])
        return Mesh(points, np.array([[0, 1, 2], [0, 2, 3]]), np.full(4, place), lit=False)

    def test_what_is_nearer_hides(self):
        camera = Camera(np.array([0.0, 0, 1]), np.array([0.0, 1, 0]))
        small = self.square(1.0, 1.0)
        small = Mesh(small.points * [0.5, 0.5, 1], small.triangles, small.places, lit=False)
        for meshes in ([self.square(0.0, 0.2), small], [small, self.square(0.0, 0.2)]):
            image, scale = rendered(meshes, camera, 106, 106, self.COLOURS)
            self.assertAlmostEqual(scale, 100, places=6)
            self.assertEqual(image[80, 30].tolist(), [255] * 3)  # below the middle: y is upwards
            self.assertEqual(image[30, 80].tolist(), [51] * 3)
            self.assertEqual(image[0, 0].tolist(), [BACKGROUND] * 3)
            self.assertEqual(int((image[:, :, 0] == 51).sum()), 7500)

    def test_cut_away(self):
        camera = Camera(np.array([0.0, 0, 1]), np.array([0.0, 1, 0]))
        mesh = self.square(0.0, 0.2)
        half = Mesh(mesh.points, mesh.triangles, mesh.places, False, mesh.points[:, 0] - 0.5)
        image, _ = rendered([half], camera, 106, 106, self.COLOURS)
        self.assertEqual(int((image[:, :, 0] == 51).sum()), 5000)


class Curves(unittest.TestCase):
    def test_sawtooth(self):
        t = np.linspace(0, 1, 41)
        self.assertLess(sawtooth(t**2), 1e-12)
        self.assertAlmostEqual(sawtooth(t + 0.01 * (-1.0) ** np.arange(41)), 0.01, places=9)

    def test_cycles(self):
        t = np.arange(1, 301) * 2.0
        flow = np.sin(2 * np.pi * t / 100) + 0.3 * np.sin(6 * np.pi * t / 100)
        self.assertAlmostEqual(period_of(t, {"a": flow, "b": t}), 100.0)
        self.assertIsNone(period_of(t, {"a": t, "b": np.ones_like(t)}))
        drift = flow + 0.001 * t
        self.assertAlmostEqual(cycle_change(t, drift, 100.0), 0.1 / np.ptp(drift[-50:]), places=9)


class PeriodicEnd(FolderCase):
    def said(self, name, **periodicity):
        return periodic_end(open_run(write_run(self.base / name, lambda t, z: z + t, periodicity=periodicity)))

    def test_what_a_run_came_to_is_said(self):
        changes = [
            {"end_ms": end, "pressure": 0.001, "flow": c, "displacement": 0.0} for end, c in ((24, 0.2), (36, 0.008))
        ]
        self.assertEqual(
            self.said("reached", period_ms=12, asked=0.01, changes=changes),
            "periodic within 1 % after 3 periods, the last of which changed by 0.8 %",
        )
        self.assertEqual(
            self.said("missed", period_ms=12, asked=0.005, changes=changes),
            "not periodic within 0.5 % after 3 periods, the last of which changed by 0.8 %",
        )
        changes[-1]["distance"] = 0.04
        self.assertEqual(
            self.said("far", period_ms=12, asked=0.01, changes=changes, reached=False),
            "not periodic within 1 % after 3 periods, the last of which changed by 0.8 %; "
            "the mean is about 4 % from the periodic state",
        )
        changes[-1].update(pressure=0.06, distance=0.001)
        self.assertIn(
            "periodic within 1 % but for its steps",
            self.said("steps", period_ms=12, asked=0.01, changes=changes, reached=False, limited_by_steps=True),
        )
        self.assertEqual(self.said("short", period_ms=12, asked=0.01, changes=[]), "no two periods were compared")
        self.assertEqual(periodic_end(open_run(write_run(self.base / "other", lambda t, z: z + t))), "")


class VaryingConstants(FolderCase):
    def test_ranges_and_sources_of_constants_that_vary(self):
        ends = {"smallest": 0.3, "largest": 30.0, "mean": 4.25}
        entry = {"layer": "media", "constant": "c10", "unit": "kPa", **ends, "sources": ["c.csv", "region plaque"]}
        entries = [entry, {"layer": "media", "mean": "NaN"}, 3]
        runs = [
            open_run(write_run(self.base / name, lambda t, z: z + t, **summary))
            for name, summary in (("of", {"varying_constants": entries}), ("no", {}), ("bad", {"varying_constants": 1}))
        ]
        table = constants_table(runs, ["of", "no", "bad"])
        self.assertEqual(table.rows[0], ["of", "media", "c10", "0.3", "4.25", "30", "kPa", "c.csv, region plaque"])
        self.assertEqual(table.rows[1:], [["of", "media", "", "-", "-", "-", "", ""]])
        self.assertEqual(constants_table(runs[1:], ["no", "bad"]).rows, [])


class WallThickness(FolderCase):
    def test_ranges_and_places_of_layers(self):
        entry = {
            "layer": "media",
            "smallest": 0.26,
            "smallest_at": [0, 1.5, 2],
            "largest": 0.31,
            "largest_at": [1, 2, 3],
        }
        runs = [
            open_run(write_run(self.base / name, lambda t, z: z + t, **summary))
            for name, summary in (("of", {"wall_thickness": [entry, 3]}), ("no", {}), ("bad", {"wall_thickness": 1}))
        ]
        table = thickness_table(runs, ["of", "no", "bad"])
        self.assertEqual(table.rows, [["of", "media", "0.26", "0, 1.5, 2", "0.31", "1, 2, 3"]])
        self.assertEqual(thickness_table(runs[1:], ["no", "bad"]).rows, [])


class Command(FolderCase):
    def setUp(self):
        super().setUp()
        self.folder = write_run(self.base / "run", lambda t, z: z + t, geometry="3d")
        write_fields(self.folder)

    def test_writes_a_picture(self):
        for name, start in (("a.png", b"\x89PNG"), ("b.pdf", b"%PDF")):
            file = self.base / "new" / name
            code, out, err = self.call("picture", self.folder, "--field", "velocity", "--time", "3.5", "-o", file)
            self.assertEqual((code, err), (0, ""))
            self.assertTrue(file.read_bytes().startswith(start))

    def test_wrong_use(self):
        for arguments, problem in (
            (["--field", "presure"], "has no field 'presure'; did you mean 'pressure'"),
            (["--time", "9"], "9 ms is outside what was written; give a time between 0 and 4 ms"),
            (["--unit", "bar", "--field", "pressure"], "'bar' does not fit a field in kPa; give kPa or Pa or mmHg"),
            (["--unit", "Pa", "--field", "velocity"], "'Pa' does not fit a field in mm/ms"),
            (["--range", "3,1"], "--range: 3,1 does not increase"),
            (["--range", "low"], "--range: 'low' is no range"),
            (["--view", "up"], "'up' is unknown"),
            (["--factor", "-1"], "--factor: -1.0 is no factor"),
        ):
            code, out, err = self.call("picture", self.folder, *arguments, "-o", self.base / "no" / "a.png")
            self.assertEqual((code, out), (1, ""), arguments)
            self.assertIn(problem, err)
            self.assertFalse((self.base / "no").exists())
        code, _, err = self.call("picture", self.folder, "-o", self.base / "a.bmp")
        self.assertEqual(code, 1)
        self.assertIn("is no picture's name", err)

    def test_damaged_fields(self):
        whole = (self.folder / "fields.h5").read_bytes()
        for damaged in (whole[: len(whole) // 2], b"", b"no HDF5"):
            (self.folder / "fields.h5").write_bytes(damaged)
            for command in (
                ["picture", self.folder, "-o", self.out / "a.png"],
                ["report", self.folder, "-o", self.out],
            ):
                code, out, err = self.call(*command)
                self.assertEqual((code, out), (1, ""))
                self.assertRegex(err, r"fields\.h5: .*cannot be read: .*; run it again\n$")
                self.assertEqual(err.count("\n"), 1)
                self.assertFalse(self.out.exists())

    def test_no_fields(self):
        (self.folder / "fields.h5").unlink()
        code, out, err = self.call("picture", self.folder, "-o", self.out / "a.png")
        self.assertEqual((code, out), (1, ""))
        self.assertIn("has written no fields; set output.fields and output.every (not 0) in the case", err)
        code, _, err = self.call("report", self.folder, "-o", self.out)
        self.assertEqual((code, err), (0, ""))
        self.assertIn("set output.fields and output.every (not 0)", (self.out / "report.html").read_text())


if __name__ == "__main__":
    unittest.main()
