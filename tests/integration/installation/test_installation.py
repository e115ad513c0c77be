"""`cmake --install` into an empty folder: the programs start there, and a project of others finds the libraries. The tree
is moved first, since nothing in it may depend on where it was put."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

CMAKE = os.environ["CMAKE_COMMAND"]
BUILD = Path(os.environ["FSI_BUILD"])
VERSION, SAID_VERSION = os.environ["FSI_VERSION"], os.environ["FSI_SAID_VERSION"]
CONSUMER = Path(__file__).parent / "consumer"


def execute(*command, **options):
    """Output of a command that must end well."""
    process = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=500, **options)
    if process.returncode != 0:
        raise AssertionError(
            f"{' '.join(map(str, command))}\nends with {process.returncode}:\n" f"{process.stdout}{process.stderr}"
        )
    return process.stdout


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.scratch)
        execute(CMAKE, "--install", BUILD, "--prefix", cls.scratch / "first")
        cls.prefix = (cls.scratch / "first").rename(cls.scratch / "moved here")

    def program(self, name, *options):
        return execute(self.prefix / "bin" / name, *options, cwd=self.scratch)

    def test_programs_say_their_version(self):
        self.assertEqual(self.program("fsi-compare", "--version"), f"fsi-compare {VERSION}\n")
        for name in ("fsi-mesh", "fsi-monolithic", "fsi-partitioned"):
            with self.subTest(name):
                self.assertEqual(self.program(name, "--version"), f"{name} {SAID_VERSION}\n")

    def test_compare_is_the_installed_one(self):
        self.assertIn("usage: fsi-compare", self.program("fsi-compare", "--help"))
        # Called by a link, it still finds its package beside the file that the link names.
        link = self.scratch / "fsi-compare"
        link.symlink_to(self.prefix / "bin" / "fsi-compare")
        self.assertEqual(execute(link, "--version"), f"fsi-compare {VERSION}\n")
        package = self.prefix / "share" / "fsi-duo" / "compare" / "fsi_compare"
        package.rename(package.with_name("elsewhere"))
        try:
            with self.assertRaisesRegex(AssertionError, "No module named 'fsi_compare'"):
                self.program("fsi-compare", "--version")
        finally:
            package.with_name("elsewhere").rename(package)

    def test_library(self):
        """`import fsi_compare` by fsi-python, and by a Python that reads the installed folder of packages."""
        script = "import fsi_compare, sys; print(fsi_compare.open_run.__name__, fsi_compare.__file__, *sys.argv[1:])"
        package = self.prefix / "share" / "fsi-duo" / "compare" / "fsi_compare"
        expected = f"open_run {package / '__init__.py'} a b\n"
        self.assertEqual(self.program("fsi-python", "-B", "-c", script, "a", "b"), expected)
        self.assertTrue((package / "py.typed").is_file())
        packages = self.prefix / "lib" / "python3" / "dist-packages"
        script = f"import site; site.addsitedir({str(packages)!r}); {script}"
        found = execute(os.environ["FSI_PYTHON"], "-E", "-B", "-c", script, "a", "b", cwd=self.scratch)
        self.assertEqual(found, expected)

    def test_ready_study_runs_installed_programs(self):
        """The plan of a ready study, with the ready cases, from the installed files alone."""
        output = self.scratch / "plan"
        plan = self.program("fsi-compare", "study", "refinement", "--quick", "--list", "-o", output)
        self.assertIn("tube, partitioned", plan)
        self.assertFalse(output.exists())

    def test_research_is_not_installed(self):
        self.assertEqual([path for path in self.prefix.rglob("*") if "research" in path.name], [])
        for words in (("study", "paper"), ("solvers",)):
            with self.assertRaisesRegex(AssertionError, "this project's own research, which is not installed"):
                self.program("fsi-compare", *words)

    def test_ready_case_runs(self):
        case = self.prefix / "share" / "fsi-duo" / "meshes" / "artery" / "neo-hookean.toml"
        folder = self.scratch / "run"
        self.program("fsi-monolithic", case, "-q", "--threads", "1", "--set", "time.end=0.25", "-o", folder)
        self.assertIn('"status": "done"', (folder / "summary.json").read_text())

    def test_documents(self):
        documents = self.prefix / "share" / "doc" / "fsi-duo"
        self.assertIn("MIT License", (documents / "copyright").read_text())
        self.assertTrue((documents / "README.md").is_file())
        self.assertTrue((documents / "docs" / "architecture.md").is_file())

    def test_nothing_of_this_machine(self):
        """No text file names the folders of the sources or of the build."""
        for path in self.prefix.rglob("*"):
            if path.suffix in (".cmake", ".hpp", ".py", ".toml") or path.name == "fsi-compare":
                text = path.read_text(encoding="utf-8")
                self.assertNotIn(str(BUILD), text, path)
                self.assertNotIn(str(Path(__file__).parents[3]) + "/", text, path)

    def test_another_project_finds_the_libraries(self):
        build = self.scratch / "consumer"
        compiler = os.environ["CMAKE_CXX_COMPILER"]
        execute(
            CMAKE,
            "-S",
            CONSUMER,
            "-B",
            build,
            f"-DCMAKE_PREFIX_PATH={self.prefix}",
            f"-DCMAKE_CXX_COMPILER={compiler}",
            "-DCMAKE_BUILD_TYPE=Release",
        )
        execute(CMAKE, "--build", build)
        case = self.prefix / "share" / "fsi-duo" / "meshes" / "artery" / "artery.toml"
        words = execute(build / "consumer", case).split()
        self.assertEqual(words[0], VERSION)
        self.assertEqual(words[-1], "0")


if __name__ == "__main__":
    unittest.main()
