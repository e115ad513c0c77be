"""Of the unit tests with sanitizers, none that a change can have changed may be left out."""

import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from sanitized_tests import touched

LIST = """cmake_minimum_required(VERSION 3.25)
project(tree CXX)
set(CMAKE_UNITY_BUILD ON)
enable_testing()
include_directories(common tests)
foreach(room mesh fluid)
  file(GLOB sources common/${room}/*.cpp)
  add_library(fsi_${room} ${sources})
endforeach()
target_link_libraries(fsi_fluid fsi_mesh)
add_subdirectory(tests/unit/mesh)
add_subdirectory(tests/unit/fluid)
"""
TEST = """add_executable(test_{room} test_{room}.cpp)
target_link_libraries(test_{room} fsi_{room})
add_test(NAME "{room}: test_{room}" COMMAND test_{room})
set_tests_properties("{room}: test_{room}" PROPERTIES LABELS "unit;quick")
"""
FILES = {
    "CMakeLists.txt": LIST,
    "CMakePresets.json": "{}",
    "README.md": "text",
    "gallery/tube.toml": "a = 1",
    "common/mesh/nodes.hpp": "#pragma once\n#include <vector>\n",
    "common/mesh/nodes.cpp": '#include "mesh/nodes.hpp"\n',
    "common/mesh/cells.cpp": '#include "mesh/nodes.hpp"\n',
    "common/fluid/flow.hpp": '#include "mesh/nodes.hpp"\n',
    "common/fluid/flow.cpp": '#include "fluid/flow.hpp"\n',
    "common/fluid/CMakeLists.txt": "",
    "tests/support/pi.hpp": "// 3.14\n",
    "tests/unit/mesh/CMakeLists.txt": TEST.format(room="mesh"),
    "tests/unit/mesh/test_mesh.cpp": '#include "mesh/nodes.hpp"\n#include "own.hpp"\nint main() {}\n',
    "tests/unit/mesh/own.hpp": "\n",
    "tests/unit/mesh/points.csv": "1\n",
    "tests/unit/fluid/CMakeLists.txt": TEST.format(room="fluid")
    + "target_compile_definitions(test_fluid PRIVATE TOP=${PROJECT_SOURCE_DIR})\n",
    "tests/unit/fluid/test_fluid.cpp": '#include "fluid/flow.hpp"\n#include "support/pi.hpp"\nint main() {}\n',
}


class SanitizedTests(unittest.TestCase):
    root: Path
    build: Path

    @classmethod
    def setUpClass(cls) -> None:
        cls.root = Path(tempfile.mkdtemp()).resolve()
        cls.addClassCleanup(shutil.rmtree, cls.root)
        for name, text in FILES.items():
            (cls.root / name).parent.mkdir(parents=True, exist_ok=True)
            (cls.root / name).write_text(text)
        cls.build = cls.root / "build"
        words = ["cmake", "-G", "Ninja", "-S", str(cls.root), "-B", str(cls.build)]
        subprocess.run(words, check=True, stdout=subprocess.PIPE)

    def programs(self, *changed: str) -> list[str]:
        return touched(self.root, self.build, {self.root / name for name in changed})

    def test_a_library_touches_those_that_link_it(self) -> None:
        self.assertEqual(self.programs("common/fluid/flow.cpp"), ["test_fluid"])
        self.assertEqual(self.programs("common/mesh/cells.cpp"), ["test_fluid", "test_mesh"])

    def test_a_header_touches_those_that_reach_it(self) -> None:
        self.assertEqual(self.programs("common/mesh/nodes.hpp"), ["test_fluid", "test_mesh"])
        self.assertEqual(self.programs("common/fluid/flow.hpp"), ["test_fluid"])
        self.assertEqual(self.programs("tests/support/pi.hpp"), ["test_fluid"])
        self.assertEqual(self.programs("tests/unit/mesh/own.hpp"), ["test_mesh"])

    def test_files_that_are_no_code_touch_those_beside_them(self) -> None:
        self.assertEqual(self.programs("tests/unit/mesh/points.csv"), ["test_mesh"])
        self.assertEqual(self.programs("tests/unit/mesh/data/points.csv"), ["test_mesh"])
        self.assertEqual(self.programs("common/fluid/CMakeLists.txt"), ["test_fluid"])
        self.assertEqual(self.programs("common/fluid/version.hpp.in"), ["test_fluid"])
        self.assertEqual(self.programs("CMakeLists.txt"), ["test_fluid", "test_mesh"])
        self.assertEqual(self.programs("gallery/tube.toml"), ["test_fluid"])  # which is told where the sources lie

    def test_documents_touch_nothing(self) -> None:
        self.assertEqual(self.programs("README.md"), [])
        self.assertEqual(self.programs(), [])

    def test_what_sets_the_compiler_touches_everything(self) -> None:
        self.assertEqual(self.programs("CMakePresets.json"), ["test_fluid", "test_mesh"])
        self.assertEqual(self.programs("cmake/Unity.cmake"), ["test_fluid", "test_mesh"])
        self.assertEqual(touched(self.root, self.build, None), ["test_fluid", "test_mesh"])


if __name__ == "__main__":
    unittest.main()
