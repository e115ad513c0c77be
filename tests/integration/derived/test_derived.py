"""What users read off: wall shear stress, stresses of the wall, forces on surfaces, averages over periods. Exact where a
flow is known, the same from both drivers and after a restart, and nothing of it computed unless asked for."""

import re
import unittest
from pathlib import Path

import h5py
import numpy as np
from programs import (
    DRIVERS,
    MONOLITHIC,
    NEO_HOOKEAN,
    PARTITIONED,
    ARTERY,
    FolderTest,
    arrays,
    attempt,
    calls,
    differing_arrays,
    make_mesh,
    restart,
    run,
    summary,
    table,
)
from scenes import forms, scene

PIPE = Path(__file__).with_name("pipe.toml")
RADIUS, LENGTH, VISCOSITY, PRESSURE = 1.0, 8.0, 1.0, 0.1  # of the meshes made here and the case file
FIELDS = "wall_shear_stress cauchy_stress principal_stress von_mises_stress fibre_stress thickness".split()
STEP, PERIOD = 0.125, 0.5  # ms
DERIVED = (
    f"output.fields={['displacement', 'velocity', 'pressure', *FIELDS]}",
    "output.surfaces=['interface','inlet','outlet']",
    "output.forces.all.surfaces=['walls']",
    "output.statistics=true",
    f"output.period={PERIOD}",
    "output.error_indicator=true",
    "output.every=1",
)


def surfaces(folder):
    """{surface: rows of (time, area, force, pressure's part, viscous part)} of surfaces.csv."""
    lines = (Path(folder) / "surfaces.csv").read_text().splitlines()[1:]
    rows: dict = {}
    for line in lines:
        time, name, *numbers = line.split(",")
        rows.setdefault(name, []).append([float(time), *map(float, numbers)])
    return {name: np.array(found) for name, found in rows.items()}


def fields(folder, grid, name):
    """Values of a field by entry, in the order of their times, and the points."""
    with h5py.File(Path(folder) / "fields.h5", "r") as file:
        found = [item for item in _datasets(file) if f"/{grid}/" in f"/{item}/" and f"/{name}/" in f"/{item}/"]
        values = [file[item][()] for item in sorted(found)]
        points = file[next(item for item in _datasets(file) if item.endswith(f"{grid}/points"))][()]
    return values, points


def _datasets(file):
    names = []
    file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
    return names


class SteadyPipe(FolderTest):
    def shear_errors(self, element, cells):
        """Relative error of the wall shear stress half way along against that of Poiseuille's flow of the pipe's own
        flow rate, 4 mu Q / (pi R^3); and the run's folder."""
        mesh = make_mesh(
            self.base / f"{element}-{cells}.msh",
            *("--axisymmetric", "--inner-radius", RADIUS, "--length", LENGTH, "--media", 0.2, "--adventitia", 0),
            *("--lumen-cells", cells, "--media-cells", 1, "--axial-cells", 6 * cells),
            *("--order", 2 if element == "p2p1" else 1),
        )
        folder = run(MONOLITHIC, PIPE, self.base / f"{element}-{cells}", f"mesh.file={mesh}", f"element={element}")
        flow = table(folder, "flow.csv")[-1, 2]
        values, points = fields(folder, "fluid", "wall_shear_stress")
        on_wall = (np.abs(points[:, 0] - RADIUS) < 1e-9) & (np.abs(points[:, 2] - LENGTH / 2) < LENGTH / 8)
        inside = points[:, 0] < RADIUS - 1e-9
        self.assertTrue((values[-1][inside] == 0).all())
        exact = 4 * VISCOSITY * flow / (np.pi * RADIUS**3)
        return np.abs(values[-1][on_wall, 2] / exact - 1).max(), folder

    def test_wall_shear_stress_is_that_of_poiseuilles_flow(self):
        # Quadratic elements hold the flow itself: what is left comes from the ends.
        self.assertLess(self.shear_errors("p2p1", 4)[0], 1e-5)
        errors = [self.shear_errors("p1", cells)[0] for cells in (4, 8, 16)]
        order = np.log2(errors[-2] / errors[-1])
        print(f"p1: wall shear stress of Poiseuille's flow, errors {errors}, order {order:.2f}")
        self.assertLess(errors[-1], 0.006)
        self.assertGreater(order, 1.7)

    def test_the_walls_bear_what_the_pressure_pushes(self):
        for element in ("p1", "p2p1"):
            folder = self.shear_errors(element, 4)[1]
            rows = surfaces(folder)
            push = PRESSURE * np.pi * RADIUS**2
            # The fluid's momentum changes little: what flows in flows out, of another profile.
            self.assertAlmostEqual(rows["walls"][-1, 4] / push, 1, delta=2e-3)
            self.assertAlmostEqual(rows["walls"][-1, 1], 2 * np.pi * RADIUS * LENGTH, delta=1e-9)
            self.assertAlmostEqual(rows["inlet"][-1, 4] / push, -1, delta=0.05)  # integrated, and singular at the rim
            self.assertAlmostEqual(rows["outlet"][-1, 4] / push, 0, delta=0.05)


PRESTRESSED = """geometry = "axisymmetric"
mesh.error = "3%"
structure.density = 1.1
structure.bulk_modulus = 1e4
structure.layers.media = {material = "neo-hookean", c10 = 60.0}
structure.layers.adventitia = {material = "neo-hookean", c10 = 60.0}
prestress.pressure = 8.0
load.pressure = 8.0
static.load_steps = 2
output.every = 1
output.fields = ["von_mises_stress"]
"""


class Prestressed(FolderTest):
    def test_the_stress_of_a_straight_tube_is_the_same_along_it(self):
        case = self.base / "tube.toml"
        case.write_text(PRESTRESSED)
        stresses, points = fields(run(MONOLITHIC, case, self.base / "tube"), "wall", "von_mises_stress")
        for radius in np.unique(points[:, 0].round(6)):
            there = (np.abs(points[:, 0] - radius) < 1e-5) & (points[:, 2] > 4) & (points[:, 2] < 14)
            found = stresses[-1][there]
            self.assertLess(np.ptp(found), 0.03 * found.mean(), radius)


class Coupled(FolderTest):
    def settings(self, case, element="p2p1", geometry="axisymmetric"):
        return (*scene(self.base, element, geometry), *forms(case), f"time.step={STEP}", *DERIVED)

    def test_both_drivers_say_the_same(self):
        tight = ("newton.tolerance=1e-9", "partitioned.tolerance=1e-9", "time.end=0.75")
        folders = [
            run(program, ARTERY, self.base / Path(program).name, *self.settings(ARTERY), *tight) for program in DRIVERS
        ]
        a, b = (surfaces(folder) for folder in folders)
        self.assertEqual(list(a), ["interface", "inlet", "outlet", "all"])
        for name in a:
            self.assertEqual(a[name].shape, (6, 11))
            np.testing.assert_allclose(a[name], b[name], rtol=0, atol=1e-5 * np.abs(a[name][:, 2:]).max())
        of_errors = (
            *(("fluid", f"{name}_error{mean}") for name in ("velocity", "pressure") for mean in ("", "_mean")),
            *(("wall", f"{name}_error{mean}") for name in ("displacement", "pressure") for mean in ("", "_mean")),
        )
        stresses = (("fluid", "wall_shear_stress"), ("wall", "von_mises_stress"), ("fluid", "tawss"))
        for grid, name in (*stresses, *of_errors):
            x, y = (fields(folder, grid, name)[0][-1] for folder in folders)
            self.assertGreater(np.abs(x).max(), 0)
            np.testing.assert_allclose(x, y, rtol=0, atol=1e-4 * np.abs(x).max())
        for grid, name in of_errors:
            self.assertEqual(
                fields(folders[0], grid, name)[0][-1].shape, arrays(folders[0] / "fields.h5")[f"{grid}/cells"].shape[:1]
            )
        # The artery's wall: media and adventitia, 0.26 and 0.13 mm, at every node, middles of edges among them.
        np.testing.assert_allclose(fields(folders[0], "wall", "thickness")[0][-1], 0.39, rtol=1e-9)
        layers = {entry["layer"]: entry for entry in summary(folders[1])["wall_thickness"]}
        self.assertEqual(list(layers), ["media", "adventitia", "wall"])
        for name, thickness in (("media", 0.26), ("adventitia", 0.13), ("wall", 0.39)):
            self.assertAlmostEqual(layers[name]["smallest"], thickness, delta=1e-9)
            self.assertAlmostEqual(layers[name]["largest"], thickness, delta=1e-9)
        # Equivalent and principal stresses are those of the tensor.
        tensor, principal, mises = (
            fields(folders[0], "wall", name)[0][-1]
            for name in ("cauchy_stress", "principal_stress", "von_mises_stress")
        )
        full = tensor[:, [[0, 1, 2], [1, 3, 4], [2, 4, 5]]]
        layout = fields(folders[0], "wall", "pressure")[0][-1]
        self.assertEqual(len(layout), len(tensor))
        vertices = np.unique(arrays(folders[0] / "fields.h5")["wall/cells"][:, :3])
        values = np.linalg.eigvalsh(full[vertices])[:, ::-1]
        np.testing.assert_allclose(values, principal[vertices], rtol=0, atol=1e-12 * np.abs(principal).max())
        differences = values - np.roll(values, 1, axis=1)
        np.testing.assert_allclose(np.sqrt((differences**2).sum(axis=1) / 2), mises[vertices], rtol=1e-9, atol=1e-12)

    def test_a_restart_within_a_period_goes_on_bit_for_bit(self):
        for program in DRIVERS:
            for scheme in ("euler", "midpoint"):
                with self.subTest(program=Path(program).name, scheme=scheme):
                    settings = (*self.settings(NEO_HOOKEAN, "p1"), f"time.scheme={scheme}")
                    name = f"{Path(program).name}-{scheme}"
                    whole = run(program, NEO_HOOKEAN, self.base / f"{name}-whole", *settings, "time.end=1.375")
                    part = run(program, NEO_HOOKEAN, self.base / f"{name}-part", *settings, "time.end=0.75")
                    restart(program, NEO_HOOKEAN, part, *settings, "time.end=1.375")
                    self.assertEqual((whole / "surfaces.csv").read_bytes(), (part / "surfaces.csv").read_bytes())
                    for field in ("wall_shear_stress", "tawss", "osi", "rrt"):
                        x, y = (fields(folder, "fluid", field)[0] for folder in (whole, part))
                        self.assertEqual([v.tobytes() for v in x], [v.tobytes() for v in y], field)
                    for grid, field in (("fluid", "velocity_error_mean"), ("wall", "pressure_error_mean")):
                        x, y = (fields(folder, grid, field)[0] for folder in (whole, part))
                        self.assertEqual([v.tobytes() for v in x], [v.tobytes() for v in y], field)
                        self.assertGreater(np.abs(x[-1]).max(), 0)
                    kept = [
                        name for name in arrays(whole / "checkpoint.h5") if "statistics" in name or "errors" in name
                    ]
                    self.assertGreater(len(kept), 8)
                    self.assertFalse(set(kept) & set(differing_arrays(whole / "checkpoint.h5", part / "checkpoint.h5")))
                    entries = fields(whole, "fluid", "tawss")[0]
                    self.assertEqual(np.abs(entries[2]).max(), 0)  # no period has ended
                    self.assertGreater(np.abs(entries[-1]).max(), 0)

    def test_a_table_of_another_run_is_refused(self):
        settings = (*self.settings(NEO_HOOKEAN, "p1"), "time.scheme=euler")
        folder = run(MONOLITHIC, NEO_HOOKEAN, self.base / "table", *settings, "time.end=0.5")
        file = folder / "surfaces.csv"
        good = file.read_text()

        def refusal(text):
            file.write_text(text)
            process = attempt(
                MONOLITHIC, NEO_HOOKEAN, "-q", "--restart", folder, folder=folder, settings=(*settings, "time.end=0.75")
            )
            self.assertEqual(process.returncode, 1)
            return process.stderr

        lines = good.splitlines(keepends=True)
        self.assertIn("out of order", refusal("".join(lines[:2] + lines[3:])))
        self.assertIn("no row", refusal(good.replace("inlet", "inlett", 1)))
        self.assertIn("ends before the rows of step", refusal("".join(lines[:-1])))
        self.assertIn("those that the run wrote", refusal(good.replace(lines[3], lines[3].replace("9", "8"), 1)))
        file.unlink()
        process = attempt(
            MONOLITHIC, NEO_HOOKEAN, "-q", "--restart", folder, folder=folder, settings=(*settings, "time.end=0.75")
        )
        self.assertIn("the earlier run wrote none", process.stderr)

    def test_nothing_is_computed_unless_asked_for(self):
        settings = scene(self.base, "p1", "axisymmetric")
        folder = run(PARTITIONED, NEO_HOOKEAN, self.base / "plain", *settings, "time.end=0.25")
        asked = run(PARTITIONED, NEO_HOOKEAN, self.base / "asked", *settings, *DERIVED, "time.end=0.25")
        names = {"wall shear stress", "wall shear stress: setup", "wall stress", "wall stress: setup", "surface forces"}
        names |= {"error indicator", "error indicator: setup"}
        self.assertFalse(names & set(calls(folder)))
        self.assertLessEqual(names, set(calls(asked)))
        self.assertFalse((folder / "surfaces.csv").exists())
        self.assertNotIn("nodes with wall shear stress", summary(folder)["counters"])
        self.assertFalse([n for n in arrays(folder / "fields.h5") if re.search("stress|tawss|error", n)])
        self.assertFalse([n for n in arrays(folder / "checkpoint.h5") if re.search("statistics|errors", n)])
        for file in ("centerline_pressure.csv", "wall_displacement.csv", "flow.csv", "energy.csv"):
            self.assertEqual((folder / file).read_bytes(), (asked / file).read_bytes(), "asking changes no solution")


if __name__ == "__main__":
    unittest.main()
