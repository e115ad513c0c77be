"""The tutorial: every command that it shows works, in its order, and what it says of the results is true."""

import re
import subprocess
import unittest
from pathlib import Path

from programs import MONOLITHIC, FolderTest

TOP = Path(__file__).resolve().parents[3]
PAGE = (TOP / "docs" / "guide" / "tutorial.md").read_text(encoding="utf-8")


def said(pattern):
    """A number that the page states."""
    return float(re.search(pattern, PAGE).group(1))


class Tutorial(FolderTest):
    def test_commands_in_their_order(self):
        blocks = re.findall(r"^```sh\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 9)
        (self.base / "build" / "release").mkdir(parents=True)
        (self.base / "build" / "release" / "bin").symlink_to(Path(MONOLITHIC).parent)
        (self.base / "gallery").symlink_to(TOP / "gallery")
        # One shell for all, as a reader has it; what is printed by each block is kept apart.
        text = "set -eu\n" + "\necho '=== next'\n".join(blocks)
        process = subprocess.run(["bash", "-c", text], cwd=self.base, capture_output=True, text=True, timeout=500)
        self.assertEqual(process.returncode, 0, process.stderr[-2000:])
        # Of all commands one is meant to be refused.
        errors = process.stderr.splitlines()
        self.assertEqual(len(errors), 1, errors)
        self.assertIn("did you mean fluid.viscosity?", errors[0])
        printed = process.stdout.split("=== next\n")
        self.assertEqual(len(printed), len(blocks))

        flow = [text for text in printed if "inlet_flow" in text][0].splitlines()
        last = dict(zip(flow[0].split(","), map(float, flow[-1].split(","))))
        self.assertAlmostEqual(last["outlet_flow_mm3_per_ms"], said(r"At 60 ms the flow is\s+([\d.]+),"), delta=1e-4)
        results = self.base / "results" / "tutorial"
        self.assertTrue((results / "tube-pressure" / "pressure_waves.png").is_file())
        times = [
            float(line.split(",")[1])
            for line in (results / "tube-monolithic" / "iterations.csv").open().readlines()[1:]
        ]
        self.assertEqual((len(times), times[-1]), (48, 12))


if __name__ == "__main__":
    unittest.main()
