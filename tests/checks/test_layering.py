"""The layering check must be able to fail: each mistake that it is there for, planted in a small tree."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from layering import cycles, main, wrong_includes

CLEAN = {
    "common/base/error.hpp": "#pragma once\n#include <string>\n",
    "common/base/version.hpp.in": "",
    "common/mesh/mesh.hpp": '#include "base/error.hpp"\n',
    "common/mesh/gmsh/reader.cpp": '#include "mesh/mesh.hpp"\n#include "gmsh.h"\n',
    "common/fluid/fluid.hpp": '#include "mesh/mesh.hpp"\n',
    "common/wall/wall.hpp": '#include "mesh/mesh.hpp"\n',
    "common/scene/case.hpp": '#include "mesh/mesh.hpp"\n#include "fluid/fluid.hpp"\n',
    "common/io/case_file.cpp": '#include "case/case.hpp"\n#include "base/version.hpp"\n',
    "monolithic/main.cpp": '#include "case/case.hpp"\n#include "monolithic/newton.hpp"\n',
    "monolithic/newton.hpp": '#include "base/error.hpp"\n',
    "partitioned/main.cpp": '#include "io/report.hpp"\n',
    "tests/unit/base/test.cpp": '#include "monolithic/newton.hpp"\n#include "common/mesh/mesh.hpp"\n',
}


class Layering(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        for path, text in CLEAN.items():
            self.write(path, text)

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)

    def assert_problem(self, *expected):
        messages = list(wrong_includes(self.root)) + cycles(self.root)
        self.assertEqual(len(messages), 1, messages)
        for part in expected:
            self.assertIn(part, messages[0])
        self.assertEqual(self.exit_code(), 1)

    def exit_code(self):
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            return main([str(self.root)])

    def test_clean_tree(self):
        self.assertEqual(list(wrong_includes(self.root)), [])
        self.assertEqual(cycles(self.root), [])
        self.assertEqual(self.exit_code(), 0)

    def test_upwards(self):
        self.write("common/mesh/mesh.hpp", '#include "base/error.hpp"\n\n#include "fluid/field.hpp"\n')
        self.assert_problem(
            'common/mesh/mesh.hpp:3: #include "fluid/field.hpp" from common/mesh',
            "allowed: common/base, common/host, common/math, common/parallel, common/mesh",
        )

    def test_upwards_through_the_root(self):
        self.write("common/mesh/other.hpp", '#include "common/scene/case.hpp"\n')
        self.assert_problem("common/mesh/other.hpp:1")

    def test_upwards_by_dots(self):
        self.write("common/mesh/other.hpp", '#include "../scene/case.hpp"\n')
        self.assert_problem("common/mesh/other.hpp:1")

    def test_upwards_with_odd_spaces(self):
        self.write("common/mesh/other.hpp", '  #  include"io/report.hpp"\n')
        self.assert_problem("common/mesh/other.hpp:1")

    def test_sideways(self):
        self.write("common/fluid/fluid.cpp", '#include "wall/wall.hpp"\n')
        self.assert_problem("common/fluid/fluid.cpp:1", "from common/fluid; allowed:")

    def test_drivers_do_not_know_each_other(self):
        self.write("partitioned/main.cpp", '#include "monolithic/newton.hpp"\n')
        self.assert_problem("partitioned/main.cpp:1")

    def test_library_does_not_know_the_tests(self):
        self.write("common/io/other.hpp", '#include "tests/unit/help.hpp"\n')
        self.assert_problem("common/io/other.hpp:1")

    def test_unknown_folder(self):
        self.write("common/attic/old.hpp", "")
        self.assert_problem('common/attic/old.hpp:1: folder "common/attic" is on no floor')

    def test_include_of_unknown_folder(self):
        self.write("common/attic/readme.txt", "")
        self.write("monolithic/main.cpp", '#include "attic/old.hpp"\n')
        self.assert_problem("monolithic/main.cpp:1")

    def test_file_on_no_floor(self):
        self.write("common/everything.hpp", "")
        self.assert_problem("common/everything.hpp:1", "on no floor")

    def test_comments_do_not_count(self):
        self.write("common/mesh/other.hpp", '// #include "io/a.hpp"\n/*\n#include "io/b.hpp"\n*/\n')
        self.assertEqual(self.exit_code(), 0)

    def test_cycle_of_two(self):
        self.write("common/mesh/a.hpp", '#include "mesh/b.hpp"\n')
        self.write("common/mesh/b.hpp", '\n#include "a.hpp"\n')
        self.assert_problem(
            "common/mesh/b.hpp:2: include cycle: common/mesh/a.hpp -> common/mesh/b.hpp -> common/mesh/a.hpp"
        )

    def test_cycle_of_three(self):
        for one, two in (("a", "b"), ("b", "c"), ("c", "a")):
            self.write(f"common/mesh/{one}.hpp", f'#include "mesh/{two}.hpp"\n')
        self.assert_problem("include cycle", "common/mesh/c.hpp -> common/mesh/a.hpp")

    def test_file_that_includes_itself(self):
        self.write("common/mesh/a.hpp", '#include "mesh/a.hpp"\n')
        self.assert_problem("common/mesh/a.hpp -> common/mesh/a.hpp")

    def test_empty_tree_is_an_error(self):
        for path in self.root.rglob("*.?pp"):
            path.unlink()
        self.assertEqual(self.exit_code(), 1)


if __name__ == "__main__":
    unittest.main()
