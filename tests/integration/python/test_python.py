"""docs/guide/reports.md#python runs as it stands: its pieces of code are one session on runs of both drivers, and print what it says."""

import json
import os
import re
import unittest
from pathlib import Path

import numpy as np
from programs import (
    CASES,
    DRIVERS,
    MONOLITHIC,
    NEO_HOOKEAN,
    FolderTest,
    arrays,
    execute,
    make_mesh,
    make_small_mesh,
    run,
    table,
)

ROOT = CASES.parent.parent
PYTHON = Path(MONOLITHIC).parent / "fsi-python"


class Page(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_small_mesh(cls.base / "small.msh")
        for program, name in zip(DRIVERS, ("monolithic", "partitioned")):
            run(program, NEO_HOOKEAN, cls.base / name, f"mesh.file={mesh}", "time.end=1", "output.every=2")

    def python(self, script):
        environment = {**os.environ, "MPLBACKEND": "agg", "PYTHONDONTWRITEBYTECODE": "1"}
        return execute(PYTHON, "-c", script, cwd=self.base, env=environment)

    def test_the_page_prints_what_it_says(self):
        page = (ROOT / "docs" / "guide" / "reports.md").read_text()
        pieces = re.findall(r"^```python\n(.*?)^```\n(?:```output\n(.*?)^```)?", page, re.MULTILINE | re.DOTALL)
        self.assertEqual(len(pieces), page.count("```python"))
        self.assertGreaterEqual(len(pieces), 7)
        script = "".join(f"{code}\nprint('---- {i}')\n" for i, (code, _) in enumerate(pieces))
        process = self.python(script)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(process.stderr, "")
        expected = "".join(f"{output}---- {i}\n" for i, (_, output) in enumerate(pieces))
        self.assertEqual(process.stdout, expected)
        self.assertEqual((self.base / "both.png").read_bytes()[:4], b"\x89PNG")

    def test_commands_of_the_page(self):
        page = (ROOT / "docs" / "guide" / "reports.md").read_text()
        commands = re.search(r"^```sh\n(.*?)^```", page, re.MULTILINE | re.DOTALL).group(1).splitlines()
        self.assertEqual(len(commands), 3)
        for command in commands:  # the options exist; the runs themselves are made above
            program = command.split()[0]
            shown = execute(
                Path(MONOLITHIC).parent / program, *(["artery"] if "mesh" in program else []), "--help"
            ).stdout
            for option in re.findall(r"(?<= )--?[a-z]+", command):
                self.assertIn(option, shown, command)

    def test_openings_by_name(self):
        """A Windkessel behind the outlet: openings.csv and flow.csv say the same flows, outwards and along the tube."""
        case = ROOT / "tests" / "integration" / "openings" / "openings.toml"
        mesh = make_mesh(self.base / "section.msh", "--axisymmetric", "--level", "coarse", "--length", 6)
        folder = run(MONOLITHIC, case, self.base / "openings", f"mesh.file={mesh}", "time.end=0.5")
        process = self.python(
            "import fsi_compare, json\n"
            "o = fsi_compare.open_run('openings').openings\n"
            "print(json.dumps({n: [p.time.tolist(), p.flow.tolist(), p.mean_pressure.tolist(),\n"
            "  None if p.windkessel_pressure is None else p.windkessel_pressure.tolist()] for n, p in o.items()}))\n"
        )
        self.assertEqual(process.returncode, 0, process.stderr)
        found, flow = json.loads(process.stdout), table(folder, "flow.csv")
        self.assertEqual(sorted(found), ["inlet", "outlet"])
        for name, sign, column in (("inlet", -1, 1), ("outlet", 1, 2)):
            np.testing.assert_array_equal(found[name][0], flow[:, 0])
            np.testing.assert_allclose(found[name][1], sign * flow[:, column], rtol=1e-12)
            np.testing.assert_allclose(found[name][2], flow[:, column + 2], rtol=1e-9)
        self.assertIsNone(found["inlet"][3])
        self.assertTrue(all(0 < p < 100 for p in found["outlet"][3]))  # it empties from 0.1 kPa

    def test_values_are_those_of_the_files(self):
        script = (
            "import fsi_compare, numpy, sys\n"
            "run = fsi_compare.open_run('monolithic')\n"
            "o = run.openings\n"
            "numpy.savez('found.npz', time=run.time, pressure=run.centre_line['pressure'], s=run.centre_line.s,\n"
            "  radial=run.wall_line['radial'], inlet=o['inlet'].flow, outlet=o['outlet'].flow,\n"
            "  mean=o['inlet'].mean_pressure, velocity=run.fields['fluid'].at(1.0, 'velocity'),\n"
            "  between=run.fields['fluid'].at(0.875, 'velocity'), layers=run.fields['wall'].layers,\n"
            "  energy=run.energy['inlet_work'])\n"
        )
        process = self.python(script)
        self.assertEqual(process.returncode, 0, process.stderr)
        folder = self.base / "monolithic"
        with np.load(self.base / "found.npz") as found:
            pressure, wall = table(folder, "centerline_pressure.csv"), table(folder, "wall_displacement.csv")
            flow, h5 = table(folder, "flow.csv"), arrays(folder / "fields.h5")
            for name, expected in {
                "time": table(folder, "iterations.csv")[:, 1],
                "pressure": pressure[:, 2].reshape(8, -1),
                "s": pressure[:181, 1],
                "radial": wall[:, 2].reshape(8, -1),
                "inlet": -flow[:, 1],  # outwards
                "outlet": flow[:, 2],
                "mean": flow[:, 3],
                "velocity": h5["fluid/velocity/00000008"],
                "between": 0.5 * h5["fluid/velocity/00000006"] + 0.5 * h5["fluid/velocity/00000008"],
                "layers": h5["wall/layer"],
                "energy": table(folder, "energy.csv")[:, 6],
            }.items():
                np.testing.assert_array_equal(found[name], expected, name)
        # At the start the pulse flows in.
        self.assertLess(-flow[0, 1], 0)


if __name__ == "__main__":
    unittest.main()
