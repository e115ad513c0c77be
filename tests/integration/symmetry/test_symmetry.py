"""A sector between planes of symmetry computes what the whole tube does on the mirrored mesh, in any position."""

import csv
import re
import unittest

import numpy as np
from programs import (
    ARTERY,
    DRIVERS,
    MONOLITHIC,
    NEO_HOOKEAN,
    FolderTest,
    difference,
    differing_arrays,
    make_mesh,
    pressure,
    restart,
    run,
    table,
    wall,
)
from scenes import ELEMENTS, LENGTH, TUBE, forms, write_channel

CELLS = (*TUBE, "--axial-cells", 4)
# Degrees, and cells around: the planes of 60 and 45 are not all normal to an axis.
SECTORS = {180: 8, 90: 8, 60: 12, 45: 16}


OBLIQUE = np.array([[2, -2, 1], [1, 2, 2], [-2, -1, 2]]) / 3  # turns every axis of space out of itself
IN_PLANE = np.array([[4, -3, 0], [3, 4, 0], [0, 0, 5]]) / 5


def turned(file, of, rotation):
    """The mesh turned, its planes of symmetry named as ones normal to no axis."""

    def place(node):
        return " ".join([node[1], *(repr(float(x)) for x in rotation @ [float(node[k]) for k in (2, 3, 4)])])

    text = of.read_text().replace("symmetry_x", "symmetry_1").replace("symmetry_y", "symmetry_2")
    file.write_text(re.sub(r"(?m)^(\d+) (\S+) (\S+) (\S+)$", place, text))
    return file


def column_of(folder, name, column):
    """Numbers of a table that has words, too."""
    with (folder / name).open() as file:
        return np.array([float(row[column]) for row in csv.DictReader(file)])


def energies(folder):
    """All energies of a run in uJ, a row a step."""
    return table(folder, "energy.csv")[:, 2:]


class Symmetry(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.meshes = {}
        for order in ELEMENTS.values():
            for sector, around in SECTORS.items():
                for mirrored in ((), ("--mirrored",)):
                    cls.meshes[order, sector, bool(mirrored)] = make_mesh(
                        cls.base / f"{order}-{sector}-{len(mirrored)}.msh",
                        *CELLS,
                        "--format",
                        "2.2",
                        "--around",
                        around,
                        "--order",
                        order,
                        "--sector",
                        sector,
                        *mirrored,
                    )

    def settings(self, case, element, mesh):
        return (
            f"element={element}",
            *forms(case),
            f"mesh.file={mesh}",
            "time.end=0.5",
            "output.every=0",
            "newton.tolerance=1e-11",
            "partitioned.tolerance=1e-11",
        )

    def march(self, program, case, element, mesh, *settings):
        """One run for all who ask for the same."""
        name = "-".join([str(DRIVERS.index(program)), case.stem, element, mesh.stem, *settings]).replace(" ", "")
        if not (self.base / name).exists():
            run(program, case, self.base / name, *self.settings(case, element, mesh), *settings)
        return self.base / name

    def assertSameWave(self, program, case, element, sector, *settings):
        part = self.march(program, case, element, self.meshes[ELEMENTS[element], sector, False], *settings)
        whole = self.march(program, case, element, self.meshes[ELEMENTS[element], sector, True])
        apart = [difference(pressure(part), pressure(whole)).max()]
        apart += [difference(wall(part)[:, :, k], wall(whole)[:, :, k]).max() for k in (2, 3)]
        print(f"{element}, {case.stem}, {sector} degrees: pressure, displacements apart by {apart}")
        self.assertLess(max(apart), 1e-8)
        self.assertGreater(np.abs(wall(part)[:, :, 2]).max(), 1e-2)  # mm
        # Flows are those of the sector, pressures those of the whole.
        one, all_of_it = table(part, "flow.csv"), table(whole, "flow.csv")
        np.testing.assert_allclose(360 / sector * one[:, 1:3], all_of_it[:, 1:3], rtol=0, atol=1e-8 * all_of_it.max())
        np.testing.assert_allclose(one[:, 3:], all_of_it[:, 3:], rtol=0, atol=1e-8 * np.abs(all_of_it[:, 3:]).max())

    def test_quarter(self):
        for element in ELEMENTS:
            for case in (NEO_HOOKEAN, ARTERY):
                with self.subTest(element=element, case=case.stem):
                    self.assertSameWave(MONOLITHIC, case, element, 90)

    def test_half(self):
        for element in ELEMENTS:
            with self.subTest(element=element):
                self.assertSameWave(MONOLITHIC, NEO_HOOKEAN, element, 180)

    def test_quarter_partitioned(self):
        for element in ELEMENTS:
            with self.subTest(element=element):
                self.assertSameWave(DRIVERS[1], NEO_HOOKEAN, element, 90)

    def test_sectors_with_a_plane_normal_to_no_axis(self):
        for element in ELEMENTS:
            for case, sector in ((NEO_HOOKEAN, 45), (ARTERY, 60)):
                with self.subTest(element=element, case=case.stem):
                    self.assertSameWave(MONOLITHIC, case, element, sector)
                    self.assertSameWave(MONOLITHIC, case, element, sector, "linear.direct_below=0")

    def test_sectors_with_a_plane_normal_to_no_axis_partitioned(self):
        for element in ELEMENTS:
            with self.subTest(element=element):
                self.assertSameWave(DRIVERS[1], NEO_HOOKEAN, element, 45)
                self.assertSameWave(DRIVERS[1], NEO_HOOKEAN, element, 45, "linear.direct_below=0")
                self.assertSameWave(DRIVERS[1], NEO_HOOKEAN, element, 45, "partitioned.scheme=iqn-ils")

    def assertSameWhenTurned(self, program, element, straight, rotation, *settings):
        axis = ", ".join(map(str, rotation[:, 2]))
        mesh = turned(straight.with_stem(f"{straight.stem}-turned"), straight, rotation)
        expected = self.march(program, ARTERY, element, straight, *settings)
        found = self.march(program, ARTERY, element, mesh, f"structure.axis_direction=[{axis}]", *settings)
        apart = [difference(pressure(found), pressure(expected)).max()]
        apart.append(np.abs(energies(found) - energies(expected)).max() / energies(expected).max())
        print(f"{element}, driver {DRIVERS.index(program)}, turned: pressure, energies apart by {apart}")
        self.assertLess(max(apart), 1e-9)

    def test_quarter_that_is_turned(self):
        """No plane and no line between planes along an axis of space."""
        for element, order in ELEMENTS.items():
            for program in DRIVERS:
                with self.subTest(element=element, driver=DRIVERS.index(program)):
                    self.assertSameWhenTurned(program, element, self.meshes[order, 90, False], OBLIQUE)

    def test_plane_channel_that_is_turned(self):
        for element, order in ELEMENTS.items():
            channel = write_channel(self.base / f"channel-{order}.msh", order)
            for program in DRIVERS:
                with self.subTest(element=element, driver=DRIVERS.index(program)):
                    self.assertSameWhenTurned(program, element, channel, IN_PLANE, "geometry=plane")

    def test_one_medium(self):
        """The wall alone, under a pressure that follows it, and the fluid alone."""
        text = ARTERY.read_text()
        section = r"(?ms)^\[{}.*?(?=^\[(?!{}\.)|\Z)"
        wall_alone, fluid_alone = self.base / "wall.toml", self.base / "fluid.toml"
        wall_alone.write_text(re.sub(section.format("fluid", "fluid"), "", text).replace("[inlet]", "[load]"))
        fluid_alone.write_text(re.sub(section.format("structure", "structure"), "", text))
        for case in (wall_alone, fluid_alone):
            for element, order in ELEMENTS.items():
                with self.subTest(case=case.stem, element=element):
                    part, whole = (
                        energies(self.march(MONOLITHIC, case, element, self.meshes[order, 60, mirrored]))
                        for mirrored in (False, True)
                    )
                    self.assertGreater(np.abs(whole).max(), 1e-3)  # uJ
                    self.assertLess(np.abs(6 * part - whole).max() / np.abs(whole).max(), 1e-9)

    def test_lines_of_a_sector_are_those_of_the_whole(self):
        """A centre line that is sought in the fluid, and that of half a plane channel, which its plane of symmetry holds."""
        line = 'output.lines.sought={ centerline = ["inlet", "outlet"], points = 9 }'
        part, whole = (self.march(MONOLITHIC, ARTERY, "p1", self.meshes[1, 60, m], line) for m in (False, True))
        for column, error in (("x_mm", 1e-6), ("y_mm", 1e-6), ("z_mm", 1e-6), ("pressure_Pa", 1e-5)):
            found, expected = column_of(part, "lines.csv", column), column_of(whole, "lines.csv", column)
            np.testing.assert_allclose(found, expected, rtol=0, atol=error * max(np.abs(expected).max(), 1))
        channel = write_channel(self.base / "half.msh", 1)
        point = f"output.points.middle=[{LENGTH / 2}, 0.0, 0.0]"
        folder = self.march(MONOLITHIC, ARTERY, "p1", channel, "geometry=plane", point)
        at_point = column_of(folder, "points.csv", "pressure_Pa")
        self.assertGreater(np.abs(at_point).max(), 1)
        np.testing.assert_allclose(pressure(folder)[:, 90], at_point, rtol=0, atol=1e-9 * np.abs(at_point).max())

    def test_restart(self):
        for program in DRIVERS:
            with self.subTest(driver=DRIVERS.index(program)):
                mesh = self.meshes[1, 60, False]
                whole = self.march(program, ARTERY, "p1", mesh)
                half = self.march(program, ARTERY, "p1", mesh, "time.end=0.25")
                restart(program, ARTERY, half, *self.settings(ARTERY, "p1", mesh))
                self.assertEqual(differing_arrays(half / "checkpoint.h5", whole / "checkpoint.h5"), [])


if __name__ == "__main__":
    unittest.main()
