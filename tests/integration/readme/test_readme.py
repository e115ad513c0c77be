"""README: its first screen, its table of programs, presets and targets of the page on installing against what there is, its case file, and the
commands that it prints after the quickstart, in the folder that the quickstart leaves."""

import csv
import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

from programs import CASES, DRIVERS, MONOLITHIC, FolderTest, attempt, execute, make_mesh

ROOT = CASES.parent.parent
TEXT = (ROOT / "README.md").read_text()
DATA = ROOT / "docs" / "data"
GUIDE = ROOT / "docs" / "guide"


def blocks(text):
    """The shell commands of a page, block by block, comments and empty lines left out."""
    for block in re.findall(r"^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        lines = [line.split("  #")[0].strip() for line in block.splitlines()]
        yield [line for line in lines if line]


def rows(*header, text=TEXT):
    """The cells of a page's table with this header, row by row."""
    lines = text.split(f"| {' | '.join(header)} |\n", 1)[1].split("\n\n")[0].splitlines()[1:]
    return [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines]


def code(text):
    return re.findall(r"`([^`]+)`", text)


class FirstScreen(FolderTest):
    def test_one_picture_for_whom_and_no_badge(self):
        first = TEXT.split("\n## ")[0]
        self.assertLess(first.count("\n"), 30)
        self.assertEqual(re.findall(r"!\[[^\]]+\]\(([^)]+)\)", first), ["docs/pictures/artery-both-drivers.png"])
        self.assertIn("**For whom:** ", first)
        for badge in ("[![", "shields.io", "/badge", "<img"):
            self.assertNotIn(badge, TEXT)

    def test_the_picture_is_drawn_from_the_kept_numbers(self):
        picture = self.base / "picture.png"
        process = execute(sys.executable, "-B", ROOT / "scripts" / "evidence" / "readme_picture.py", "-o", picture)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        kept = (ROOT / "docs" / "pictures" / "artery-both-drivers.png").read_bytes()
        self.assertEqual(picture.read_bytes()[:24], kept[:24])  # a PNG file of the same width and height

    def test_what_is_said_of_the_kept_numbers(self):
        def table(name):
            with open(DATA / name) as file:
                return list(csv.DictReader(line for line in file if not line.startswith("#")))

        kinds = ("monolithic", "interface", "block")
        waves = [[float(row[f"{kind}_Pa"]) for kind in kinds] for row in table("artery-wave.csv")]
        said = float(re.search(r"differ by (\S+) of the largest pressure", TEXT).group(1))
        found = max(max(wave) - min(wave) for wave in waves) / max(map(max, waves))
        self.assertTrue(0.7 * said < found < 1.4 * said, found)


class Tables(FolderTest):
    def test_programs_and_their_options(self):
        bin_folder = Path(MONOLITHIC).parent
        named = [code(cell)[0].split() for cell, _ in rows("program", "job")]
        self.assertGreater(len(named), 12)
        commands = {tuple(words[: 1 if words[0][4:] in ("monolithic", "partitioned") else 2]) for words in named}
        for words in named:
            command = [word for word in words[:2] if re.fullmatch(r"[a-z-]+", word)]
            process = execute(bin_folder / command[0], *command[1:], "--help")
            self.assertEqual(process.returncode, 0, words)
            for option in (word for word in words if word.startswith("-")):
                self.assertRegex(process.stdout, rf"(?m)(^|[\s,]){option}\b", words)
            self.assertIn("--threads", process.stdout, words)
        helped = execute(bin_folder / "fsi-compare", "--help").stdout
        there = set(re.findall(r"(?m)^    ([a-z-]+)(?:  |$)", helped))
        there -= {"convert-mesh", "convert-case"}  # fsi-mesh calls those
        self.assertEqual({c[1] for c in commands if c[0] == "fsi-compare"}, there)
        of_drivers = re.search(r"All take (.*?)\n\n", TEXT, re.DOTALL).group(1)
        for driver in DRIVERS:
            helped = execute(driver, "--help").stdout
            for words in code(of_drivers):
                self.assertRegex(helped, rf"(?m)(^|[\s,]){words.split()[0]}\b")

    def test_presets_and_targets(self):
        text = GUIDE.joinpath("install.md").read_text()
        presets = json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]
        shown = {code(cell)[0] for cell, _ in rows("preset", "for", text=text)}
        self.assertLessEqual(shown, {preset["name"] for preset in presets if not preset.get("hidden")})
        files = [*(ROOT / "cmake").glob("*.cmake"), *ROOT.glob("*/CMakeLists.txt")]
        made = set(re.findall(r"add_custom_target\((\w+)", "\n".join(file.read_text() for file in files)))
        targets = set(re.findall(r"--target (\w+)", text))
        self.assertGreaterEqual(len(targets), 3)
        self.assertLessEqual(targets, made)

    def test_studies_and_scenes(self):
        sentence = re.search(
            r"The studies of this project lie in\s+`compare/research/studies/`(.*?)(?:\n\n|\Z)",
            GUIDE.joinpath("running.md").read_text(),
            re.DOTALL,
        ).group(1)
        studies = re.findall(r"`([a-z-]+)` \(", sentence)
        self.assertGreater(len(studies), 6)
        for study in studies:
            self.assertTrue((ROOT / "compare" / "research" / "studies" / f"{study}.toml").is_file(), study)
        self.assertIn(f"{len(list(ROOT.glob('gallery/*/scene.py')))} scenes to start from", TEXT)

    def test_the_case_file_is_accepted_as_it_is_printed(self):
        case = self.base / "case.toml"
        case.write_text(re.search(r"^```toml\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL).group(1))
        make_mesh(self.base / "artery.msh", "--level", "coarse")
        for driver in DRIVERS:
            process = attempt(driver, case, "--check")
            self.assertEqual((process.returncode, process.stderr), (0, ""))


class Readme(FolderTest):
    def setUp(self):
        self.quickstart, self.next = list(blocks(TEXT))[:2]
        self.script = (ROOT / "scripts" / "quickstart.sh").read_text()

    def variable(self, name):
        return re.search(rf"^{name}=(\S+)", self.script, re.MULTILINE).group(1)

    def stage(self, name):
        """A command of the quickstart, its variables filled in."""
        line = re.search(rf'^stage "{name}" (.*)$', self.script, re.MULTILINE).group(1)
        settings = "\n".join(f"{v}={self.variable(v)}" for v in ("build", "results", "case_file"))
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
            self.stage("monolithic run"),
            self.stage("report"),
            self.stage("partitioned run"),
            self.stage("comparison"),
            *self.next,
        ]
        for command in commands:
            if " study " in command:  # takes minutes, and has tests of its own: is the program there, and the study?
                program, _, study = command.split()[:3]
                self.assertTrue((folder / program).exists(), command)
                self.assertTrue((ROOT / "compare" / "research" / "studies" / f"{study}.toml").exists(), command)
                continue
            process = subprocess.run(["bash", "-euc", command], cwd=folder, capture_output=True, text=True, timeout=300)
            with self.subTest(command=command):
                self.assertEqual((process.returncode, process.stderr), (0, ""))
                self.assertNotRegex(process.stdout, r"(?i)warning|differ in mesh|another mesh")


if __name__ == "__main__":
    unittest.main()
