"""All tables and fields of a run on several processes have the numbers of a run on one."""

import csv
import unittest
from pathlib import Path

import numpy as np
from programs import ARTERY, MONOLITHIC, FolderTest, arrays, driver_command, execute, run
from scenes import forms, scene

MPIRUN = Path(__file__).parents[2] / "support" / "mpirun.sh"
STRESSES = "cauchy_stress principal_stress von_mises_stress fibre_stress".split()
SHEAR = ["wall_shear_stress"]
SETTINGS = (
    "output.planes.middle.origin=[0.2, 0, 1.4]",
    "output.planes.middle.normal=[0.1, 0, 1]",
    "output.planes.end.origin=[0, 0, 3]",
    "output.planes.end.normal=[0, 0, 1]",
    "output.surfaces=['interface','inlet','outlet']",
    "output.forces.all.surfaces=['walls']",
    "output.energy=true",
    f"output.fields={['displacement', 'velocity', 'pressure', *SHEAR, *STRESSES]}",
    "output.statistics=true",
    "output.period=0.25",
    "output.every=1",
    "time.end=0.375",
)
SOLVED = ("monolithic.linear_solver=direct", "newton.tolerance=1e-11")
NEAR = 1e-9  # of the largest number of a column


def columns(file):
    """The columns of a table: numbers, or text where it has any."""
    with file.open() as lines:
        rows = list(csv.reader(lines))
    found = {}
    for name, cells in zip(rows[0], zip(*rows[1:])):
        try:
            found[name] = [float(cell) if cell else None for cell in cells]
        except ValueError:
            found[name] = list(cells)
    return found


def everything(geometry):
    """Settings that ask for all that a run of this geometry can show."""
    if geometry == "plane":
        return tuple(setting for setting in SETTINGS if "planes" not in setting)
    y = 0.1 if geometry == "3d" else 0.0
    return (
        *SETTINGS,
        f"output.points.lumen=[0.2, {y}, 1.1]",
        f"output.points.wall=[1.6, {y}, 1.4]",
        f"output.lines.across.from=[0.05, {y}, 1.3]",
        f"output.lines.across.to=[1.7, {y}, 1.7]",
        "output.lines.across.points=11",
    )


class Observed(FolderTest):
    def run_on(self, processes, folder, settings):
        command = driver_command(MONOLITHIC, ARTERY, "-q", "--force", folder=folder, settings=settings)
        process = execute(MPIRUN, processes, 240, *command)
        self.assertEqual(process.returncode, 0, process.stderr)
        return Path(folder)

    def check(self, element, geometry, processes):
        settings = (*scene(self.base, element, geometry), *forms(ARTERY), *SOLVED, *everything(geometry))
        alone = run(MONOLITHIC, ARTERY, self.base / f"{element}-{geometry}-1", *settings)
        shared = self.run_on(processes, self.base / f"{element}-{geometry}-{processes}", settings)
        tables = [file.name for file in alone.glob("*.csv") if file.name != "iterations.csv"]
        self.assertGreaterEqual(len(tables), 4)
        for table in tables:
            one, other = (columns(folder / table) for folder in (alone, shared))
            self.assertEqual(list(one), list(other))
            for name, known in one.items():
                if not all(isinstance(value, (float, type(None))) for value in known):
                    self.assertEqual(other[name], known)
                    continue
                self.assertEqual([value is None for value in known], [value is None for value in other[name]])
                pairs = [(a, b) for a, b in zip(known, other[name]) if a is not None]
                size = max((abs(a) for a, _ in pairs), default=0)
                apart = max((abs(a - b) for a, b in pairs), default=0)
                self.assertLessEqual(apart, NEAR * size + 1e-11, f"{table}: {name}")
        one, other = (arrays(folder / "fields.h5") for folder in (alone, shared))
        self.assertEqual(sorted(one), sorted(other))
        for name, known in one.items():
            np.testing.assert_allclose(
                other[name], known, rtol=0, atol=NEAR * np.abs(known).max() + 1e-11, err_msg=name
            )

    def test_quarter_of_a_tube(self):
        self.check("p1", "3d", 3)

    def test_quadratic_section(self):
        self.check("p2p1", "axisymmetric", 2)

    def test_quadratic_channel(self):
        """So small that a process has no node of the wall."""
        self.check("p2p1", "plane", 4)


if __name__ == "__main__":
    unittest.main()
