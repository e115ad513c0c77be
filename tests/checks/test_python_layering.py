"""The layering check of the Python modules must be able to fail: each mistake planted in a small tree."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from python_layering import FLOORS, OF_LIBRARY, PACKAGES, cycles, main, wrong_imports

FOLDER = PACKAGES["fsi_compare"]
RESEARCH = PACKAGES["fsi_research"]
CLEAN = {
    "__init__.py": "def __getattr__(name):\n    from . import library\n\n    return getattr(library, name)\n",
    "library.py": "from .runs.columns import np\n",
    "__main__.py": "import sys\n\nfrom .cli import main\n",
    "cli.py": "from .base.errors import InputError\nfrom .study.command import study\n",
    "base/__init__.py": "",
    "base/errors.py": "from pathlib import Path\n",
    "runs/__init__.py": "",
    "runs/columns.py": "import numpy as np\n\nfrom ..base.errors import InputError\n",
    "reporting/__init__.py": "",
    "reporting/pictures.py": "from matplotlib.figure import Figure\n\nfrom ..base import errors\n",
    "study/__init__.py": "",
    "study/command.py": "from . import catalogue\n",
    "study/catalogue.py": "import importlib\n\n\ndef kind(name):\n    return importlib.import_module(name)\n",
}
OF_RESEARCH = {
    "__init__.py": "",
    "evidence/__init__.py": "LIMIT = 1\n",
    "evidence/waves.py": "from fsi_compare.runs.columns import read_columns\n",
    "paper/__init__.py": "",
    "paper/study.py": "from ..evidence import LIMIT, waves\nfrom fsi_compare.reporting import pictures\n",
    "skip/__init__.py": "",
    "skip/study.py": "",
}


class PythonLayering(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        for path, text in CLEAN.items():
            self.write(path, text)
        for path, text in OF_RESEARCH.items():
            self.write(path, text, RESEARCH)

    def write(self, path, text, folder=FOLDER):
        file = self.root / folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def assert_problem(self, *expected):
        messages = list(wrong_imports(self.root)) + cycles(self.root)
        self.assertEqual(len(messages), 1, messages)
        for part in expected:
            self.assertIn(part, messages[0])
        self.assertEqual(self.exit_code(), 1)

    def exit_code(self):
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            return main([str(self.root)])

    def test_clean_tree(self):
        self.assertEqual(list(wrong_imports(self.root)), [])
        self.assertEqual(cycles(self.root), [])
        self.assertEqual(self.exit_code(), 0)

    def test_upwards(self):
        self.write("runs/columns.py", "import math\n\nfrom ..reporting.pictures import draw\n")
        self.assert_problem(
            "runs/columns.py:3: from ..reporting.pictures import draw", "allowed: fsi_compare.base, fsi_compare.runs"
        )

    def test_upwards_by_a_package(self):
        self.write("runs/columns.py", "from ..reporting import pictures\n")
        self.assert_problem("runs/columns.py:1")

    def test_upwards_to_the_command_line(self):
        self.write("reporting/cost.py", "from ..cli import read_labels\n")
        self.assert_problem("reporting/cost.py:1")

    def test_upwards_by_the_full_name(self):
        self.write("runs/columns.py", "import fsi_compare.reporting.pictures\n")
        self.assert_problem("runs/columns.py:1")

    def test_upwards_within_a_function(self):
        self.write("runs/columns.py", "def read():\n    from ..reporting.pictures import draw\n")
        self.assert_problem("runs/columns.py:2")

    def test_upwards_by_what_a_package_defines(self):
        self.write("runs/columns.py", "from ..study import catalogue\n")
        self.assert_problem("runs/columns.py:1")

    def test_sideways(self):
        self.write("skip/study.py", "from ..paper.study import evaluate\n", RESEARCH)
        self.assert_problem('skip/study.py:1: from ..paper.study import evaluate from "fsi_research.skip"')

    def test_research_from_the_product(self):
        self.write("study/command.py", "def late():\n    from fsi_research.evidence import LIMIT\n")
        self.assert_problem("study/command.py:2: from fsi_research.evidence import LIMIT")

    def test_research_from_the_command_line_of_the_product(self):
        self.write("cli.py", "import fsi_research.paper.study\n")
        self.assert_problem("cli.py:1: import fsi_research.paper.study")

    def test_what_users_import_is_below_all_else(self):
        packages = [package for floor in FLOORS for package in floor]
        self.assertEqual(packages[: len(OF_LIBRARY)], list(OF_LIBRARY))

    def test_library_from_the_commands_that_start_programs(self):
        self.write("library.py", "from .study.command import study\n")
        self.assert_problem("library.py:1: from .study.command import study")

    def test_library_from_the_command_line(self):
        self.write("library.py", "def late():\n    from .cli import study\n")
        self.assert_problem("library.py:2: from .cli import study")

    def test_package_itself_from_the_studies(self):
        self.write("__init__.py", "from .study.catalogue import kind\n")
        self.assert_problem("__init__.py:1: from .study.catalogue import kind")

    def test_unknown_package(self):
        self.write("attic/old.py", "")
        self.assert_problem('attic/old.py:1: package "fsi_compare.attic" is on no floor')

    def test_unknown_module(self):
        self.write("runs/columns.py", "from ..base.mistakes import InputError\n")
        self.assert_problem("runs/columns.py:1", "neither a module of fsi_compare")

    def test_above_the_package(self):
        self.write("runs/columns.py", "from ...scripts import help\n")
        self.assert_problem("runs/columns.py:1")

    def test_other_library(self):
        self.write("runs/columns.py", "import pandas\n")
        self.assert_problem("runs/columns.py:1: import pandas")

    def test_computed_name(self):
        self.write("runs/columns.py", 'from importlib import import_module\n\nimport_module("fsi_compare.cli")\n')
        self.assert_problem("runs/columns.py:3: import_module(...)")

    def test_circle_of_two(self):
        self.write("runs/a.py", "from .b import two\n")
        self.write("runs/b.py", "from . import a\n")
        self.assert_problem("import cycle", f"{FOLDER}/runs/a.py -> {FOLDER}/runs/b.py -> {FOLDER}/runs/a.py")

    def test_circle_closed_within_a_function(self):
        self.write("runs/a.py", "from .b import two\n")
        self.write("runs/b.py", "def late():\n    from .a import one\n")
        self.assert_problem("runs/b.py:2: import cycle")

    def test_module_that_imports_itself(self):
        self.write("runs/a.py", "from . import a\n")
        self.assert_problem("import cycle")

    def test_empty_tree_is_an_error(self):
        for path in (self.root / FOLDER).rglob("*.py"):
            path.unlink()
        self.assertEqual(self.exit_code(), 1)


if __name__ == "__main__":
    unittest.main()
