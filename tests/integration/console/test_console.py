"""What a user sees of the programs, and what they refuse at once."""

import os
import pty
import re
import subprocess
import unittest

from programs import (
    ARTERY,
    DRIVERS,
    MESH,
    MONOLITHIC,
    NEO_HOOKEAN,
    PARTITIONED,
    FolderTest,
    attempt,
    driver_command,
    execute,
    make_small_mesh,
)

VERSION, SAID_VERSION = os.environ["FSI_VERSION"], os.environ["FSI_SAID_VERSION"]
STEPS = 3


class Console(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = make_small_mesh(cls.base / "small.msh")
        cls.settings = (f"mesh.file={mesh}", f"time.end={0.125 * STEPS}", "partitioned.tolerance=1e-3")

    def name(self, program):
        return os.path.basename(program)

    def test_quiet_is_silent(self):
        for program in DRIVERS:
            process = attempt(
                program, NEO_HOOKEAN, "-q", folder=self.base / f"quiet_{self.name(program)}", settings=self.settings
            )
            self.assertEqual((process.returncode, process.stdout, process.stderr), (0, "", ""))
        process = execute(MESH, "artery", "-q", "-o", self.base / "quiet.msh")
        self.assertEqual((process.returncode, process.stdout, process.stderr), (0, "", ""))

    def test_piped_progress_is_a_plain_line_per_step(self):
        for program in DRIVERS:
            process = attempt(
                program, NEO_HOOKEAN, folder=self.base / f"piped_{self.name(program)}", settings=self.settings
            )
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            self.assertFalse(re.search(r"[^\n -~]", process.stdout), "control characters in a pipe")
            first, *steps = process.stdout.splitlines()
            self.assertTrue(first.startswith(f"{self.name(program)} {VERSION}: Rabbit carotid artery"), first)
            self.assertEqual(len(steps), STEPS)
            for k, line in enumerate(steps, start=1):
                self.assertRegex(line, rf"^step {k}/{STEPS}, t = {0.125 * k:g} ms: .*\d+ Newton iterations, .* left$")

    def on_terminal(self, *command, **how):
        """What a run that ends well shows on a terminal."""
        terminal, end = pty.openpty()
        with subprocess.Popen(driver_command(*command, **how), stdout=end) as process:
            os.close(end)
            text, piece = b"", b"-"
            while piece:
                try:
                    piece = os.read(terminal, 4096)
                except OSError:  # the other end is closed
                    piece = b""
                text += piece
        os.close(terminal)
        self.assertEqual(process.returncode, 0)
        return text.decode()

    def test_progress_of_a_prestress_rewrites_a_line_of_its_own(self):
        case = self.base / "prestress.toml"
        pulse = NEO_HOOKEAN.read_text()
        case.write_text(pulse.replace("[inlet]", "[prestress]\npressure = 0.1\n[inlet]"))
        text = self.on_terminal(MONOLITHIC, case, folder=self.base / "prestress", settings=self.settings)
        before, after = text.split("\r\n", 1)
        self.assertGreater(before.count("\r\033[Kprestress: 100 % of 0.1 kPa, iteration "), 1)
        self.assertTrue(after.startswith(f"{self.name(MONOLITHIC)} {VERSION}: "), text)

    def test_terminal_progress_rewrites_its_line(self):
        text = self.on_terminal(MONOLITHIC, NEO_HOOKEAN, folder=self.base / "terminal", settings=self.settings)
        self.assertEqual(text.count(f"\r\033[Kstep {STEPS}/{STEPS}"), 2)  # at work, and done
        self.assertEqual(text.count("\n"), 2)  # the first line's and the last
        self.assertTrue(text.endswith("\n"))

    def test_a_wrong_unit_is_a_warning_and_the_run_goes_on(self):
        warning = (
            "--set: structure.layers.media.alpha: 0.5 looks like a value in radians; " "did you mean 28.6 degrees?"
        )
        for program in DRIVERS:
            folder = self.base / f"unit_{self.name(program)}"
            process = attempt(
                program, ARTERY, "-q", folder=folder, settings=(*self.settings, "structure.layers.media.alpha=0.5")
            )
            self.assertEqual(process.returncode, 0)
            self.assertEqual(process.stderr, f"{self.name(program)}: warning: {warning}\n")
            log = (folder / "run.log").read_text()
            self.assertEqual(log.count(warning), 1)
            self.assertIn("warning", log)

    def test_version_and_help(self):
        for program in (*DRIVERS, MESH):
            process = execute(program, "--version")
            self.assertEqual((process.returncode, process.stdout), (0, f"{self.name(program)} {SAID_VERSION}\n"))
            process = execute(program, "--help")
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            self.assertIn("--version", process.stdout)
        for program in DRIVERS:
            for option in ("--output", "--restart", "--set", "--threads", "--force", "--quiet"):
                self.assertIn(option, execute(program, "--help").stdout)
            keys = execute(program, "--help-keys")
            self.assertEqual(keys.returncode, 0)
            self.assertIn("structure.layers.NAME.c10", keys.stdout)

    def test_wrong_use(self):
        folder = self.base / "wrong"
        case = str(NEO_HOOKEAN)
        for program in DRIVERS:
            for words, shown in (
                (["--treads", "2", case, "-o", folder], "--threads"),
                ([case, "-o", folder, "--threads", "two"], "two"),
                ([case, case, "-o", folder], "one argument too many"),
                ([case, "-o", folder, "--set", "time.end"], "time.end"),
                ([case, "-o", folder, "-x"], "-x"),
                ([case], "-o"),
                (["-o", folder], "no case file"),
                ([], "no case file"),
            ):
                process = execute(program, *words)
                with self.subTest(program=program, words=words):
                    self.assertRefused(process, shown)
                    self.assertFalse(folder.exists())
        for words in (
            ["artery", "--levl", "coarse", "-o", "x.msh"],
            ["artery"],
            [],
            ["vein", "-o", "x.msh"],
            ["artery", "--level", "huge", "-o", "x.msh"],
            ["artery", "-o", "x.vtk"],
            ["artery", "-o", "x"],
            ["artery", "--format", "3", "-o", "x.msh"],
        ):
            process = execute(MESH, *words, cwd=self.base)
            with self.subTest(words=words):
                self.assertRefused(process, "")
                self.assertNotIn("fsi-mesh: error: fsi-mesh: ", process.stderr)
                self.assertFalse([name for name in ("x.msh", "x.vtk", "x") if (self.base / name).exists()])
        self.assertIn(
            "the extension .vtk is unknown; the one that is known is .msh",
            execute(MESH, "artery", "-o", "x.vtk", cwd=self.base).stderr,
        )

    def test_messages_are_one_printable_line(self):
        """Whatever was handed over stands in them escaped and shortened, its end and its beginning to be seen."""
        name = "case\n\x1b[31m" + "x" * 5000 + ".toml"
        for program in DRIVERS:
            process = execute(program, self.base / name, "-o", self.base / "hostile")
            self.assertRefused(process, "x.toml: ")
            process = execute(program, NEO_HOOKEAN, "-o", self.base / "hostile", "--set", "fluid.\x1b\n=" + "7" * 5000)
            self.assertRefused(process, "unknown key")
            process = execute(program, NEO_HOOKEAN, "-o", self.base / "hostile", "--\x1b" + "y" * 5000)
            self.assertRefused(process, "\\x1b")
        for words in (
            ("art\nery",),
            ("artery", "-o", name),
            ("artery", "--siz\ne", "1"),
            ("artery", "--size", "\x1b", "-o", "x.msh"),
        ):
            self.assertRefused(execute(MESH, *words, cwd=self.base), "")

    def test_bad_mesh_gets_a_warning(self):
        good = execute(MESH, "artery", "--length", 4, "-o", self.base / "good.msh")
        self.assertEqual((good.returncode, good.stderr), (0, ""))
        bad = execute(MESH, "artery", "--length", 4, "--adventitia", 0.01, "-o", self.base / "bad.msh")
        self.assertEqual(bad.returncode, 0)
        self.assertRegex(
            bad.stderr,
            r"^fsi-mesh: warning: adventitia: \d+ of \d+ elements are of bad quality .* the "
            r"worst is tetrahedron \d+ near \(.*\) mm, eta 0\.\d+; smallest angle .*; choose",
        )

    def assertRefused(self, process, shown):
        """One line of complaint that says what is meant, and nothing else."""
        self.assertEqual((process.returncode, process.stdout), (1, ""))
        self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
        self.assertTrue(process.stderr[:-1].isprintable() and len(process.stderr) < 3000, process.stderr)
        self.assertTrue(process.stderr.startswith(f"{self.name(process.args[0])}: error: "), process.stderr)
        self.assertIn(shown, process.stderr)

    def test_output_that_cannot_be_written_is_refused_before_computing(self):
        file = self.base / "file"
        file.write_text("mine")
        foreign = self.base / "foreign"
        foreign.mkdir()
        (foreign / "thesis.tex").write_text("mine")
        for program in DRIVERS:
            for folder, shown in ((file, "is a file"), (file / "below", "cannot be created"), (foreign, "thesis.tex")):
                process = attempt(program, NEO_HOOKEAN, folder=folder, settings=("time.end=1",))
                with self.subTest(program=program, folder=folder.name):
                    self.assertRefused(process, shown)
                    self.assertEqual(process.stdout, "")
        self.assertEqual((file.read_text(), (foreign / "thesis.tex").read_text()), ("mine", "mine"))
        self.assertEqual(len(list(foreign.iterdir())), 1)

    def test_finished_run_is_not_overwritten(self):
        folder, other = self.base / "finished", self.base / "other"
        for place in (folder, other):
            self.assertEqual(attempt(MONOLITHIC, NEO_HOOKEAN, "-q", folder=place, settings=self.settings).returncode, 0)
        before = {file.name: file.read_bytes() for file in folder.iterdir()}
        for program, options in ((MONOLITHIC, ()), (PARTITIONED, ()), (MONOLITHIC, ("--restart", other))):
            process = attempt(program, NEO_HOOKEAN, *options, folder=folder, settings=self.settings)
            steps = len(before["iterations.csv"].splitlines()) - 1
            self.assertRefused(
                process,
                f"{folder}: holds a finished run of fsi-monolithic ({steps} steps); "
                "give -o another folder, or replace it with --force",
            )
            self.assertEqual({file.name: file.read_bytes() for file in folder.iterdir()}, before)

    def test_folder_of_a_run_without_a_step_is_free(self):
        folder = self.base / "without"
        settings = (*self.settings, "newton.max_iterations=1")
        for _ in range(2):
            self.assertEqual(attempt(MONOLITHIC, NEO_HOOKEAN, folder=folder, settings=settings).returncode, 2)

    def test_results_of_an_earlier_run_make_way(self):
        folder = self.base / "earlier"
        for settings in (("output.every=1",), ("output.every=0", "output.checkpoint_every=0")):
            process = attempt(
                MONOLITHIC, NEO_HOOKEAN, "-q", "--force", folder=folder, settings=(*self.settings, *settings)
            )
            self.assertEqual(process.returncode, 0)
        unwanted = ("fields.h5", "fields.xdmf", "fluid.xdmf", "checkpoint.h5")
        self.assertFalse([name for name in unwanted if (folder / name).exists()])


if __name__ == "__main__":
    unittest.main()
