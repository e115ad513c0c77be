"""A sector between planes of symmetry computes what the whole tube does on the mirrored mesh."""

import unittest

import numpy as np
from programs import (
    ARTERY,
    DRIVERS,
    MONOLITHIC,
    NEO_HOOKEAN,
    FolderTest,
    difference,
    make_mesh,
    pressure,
    run,
    table,
    wall,
)
from scenes import ELEMENTS, TUBE, forms

CELLS = (*TUBE, "--axial-cells", 4, "--around", 8)


class Symmetry(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.meshes = {}
        for order in ELEMENTS.values():
            for sector in (90, 180):
                for mirrored in ((), ("--mirrored",)):
                    cls.meshes[order, sector, bool(mirrored)] = make_mesh(
                        cls.base / f"{order}-{sector}-{len(mirrored)}.msh",
                        *CELLS,
                        "--order",
                        order,
                        "--sector",
                        sector,
                        *mirrored,
                    )

    def march(self, program, case, element, sector, mirrored):
        return run(
            program,
            case,
            self.base / f"{DRIVERS.index(program)}-{case.stem}-{element}-{sector}-{mirrored}",
            f"element={element}",
            *forms(case),
            f"mesh.file={self.meshes[ELEMENTS[element], sector, mirrored]}",
            "time.end=0.5",
            "output.every=0",
            "monolithic.newton_tolerance=1e-11",
            "partitioned.tolerance=1e-11",
        )

    def assertSameWave(self, program, case, element, sector):
        part, whole = (self.march(program, case, element, sector, mirrored) for mirrored in (False, True))
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


if __name__ == "__main__":
    unittest.main()
