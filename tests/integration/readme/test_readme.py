"""The commands that README prints after the quickstart work in the folder that the quickstart leaves."""

import re
import subprocess
import unittest
from pathlib import Path

from programs import CASES, MONOLITHIC, FolderTest

ROOT = CASES.parent.parent


def blocks(text):
    """The shell commands of a page, block by block, comments and empty lines left out."""
    for block in re.findall(r"^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        lines = [line.split("  #")[0].strip() for line in block.splitlines()]
        yield [line for line in lines if line]


class Readme(FolderTest):
    def setUp(self):
        self.quickstart, self.next = list(blocks((ROOT / "README.md").read_text()))[:2]
        self.script = (ROOT / "scripts" / "quickstart.sh").read_text()

    def variable(self, name):
        return re.search(rf"^{name}=(\S+)", self.script, re.MULTILINE).group(1)

    def stage(self, name):
        """A command of the quickstart, its variables filled in."""
        line = re.search(rf'^stage "{name}" (.*)$', self.script, re.MULTILINE).group(1)
        settings = "\n".join(f"{v}={self.variable(v)}" for v in ("build", "results", "case_file", "mesh"))
        return f"{settings}\n{line}"

    def test_commands_in_their_order(self):
        self.assertEqual([line.split()[0] for line in self.quickstart], ["scripts/quickstart.sh", "scripts/test.sh"])
        self.assertGreaterEqual(len(self.next), 3)
        folder = self.base
        (folder / self.variable("build")).mkdir(parents=True)
        (folder / self.variable("build") / "bin").symlink_to(Path(MONOLITHIC).parent)
        (folder / "meshes" / "artery").mkdir(parents=True)
        for case in CASES.glob("*.toml"):  # a quarter of the steps, up to the times that are compared
            text, count = re.subn(r"^step = \S+", "step = 0.5", case.read_text(), flags=re.MULTILINE)
            self.assertEqual(count, 1, case)
            (folder / "meshes" / "artery" / case.name).write_text(text)
        commands = [
            self.stage("mesh"),
            self.stage("monolithic run"),
            self.stage("partitioned run"),
            self.stage("comparison"),
            *self.next,
        ]
        for command in commands:
            if " study " in command:  # takes minutes, and has tests of its own: is the program there, and the study?
                program, _, study = command.split()[:3]
                self.assertTrue((folder / program).exists(), command)
                self.assertTrue((ROOT / "compare" / "studies" / f"{study}.toml").exists(), command)
                continue
            process = subprocess.run(["bash", "-euc", command], cwd=folder, capture_output=True, text=True, timeout=300)
            with self.subTest(command=command):
                self.assertEqual((process.returncode, process.stderr), (0, ""))
                self.assertNotRegex(process.stdout, r"(?i)warning|differ in mesh|another mesh")


if __name__ == "__main__":
    unittest.main()
