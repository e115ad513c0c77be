"""The check of what no test's build compiles must be able to fail."""

import os
import tempfile
import unittest
from pathlib import Path

from compiles import FIRST_ELEMENT, main, naming_sources


class Compiles(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        for name in (*FIRST_ELEMENT, "benchmarks/assembly.cpp"):
            self.write(name, "int main() {}\n")

    def write(self, name, text):
        (self.root / name).parent.mkdir(parents=True, exist_ok=True)
        (self.root / name).write_text(text)

    def run_check(self):
        return main(self.root, os.environ["CXX"], ["-w"])

    def test_what_compiles_passes(self):
        self.assertEqual(self.run_check(), 0)

    def test_a_benchmark_that_does_not_compile(self):
        self.write("benchmarks/assembly.cpp", "int main() { return missing; }\n")
        self.assertEqual(self.run_check(), 1)

    def test_a_source_that_does_not_compile_for_the_first_element(self):
        self.write(FIRST_ELEMENT[0], "#ifdef FSI_FIRST_ELEMENT\n#error\n#endif\n")
        self.assertEqual(self.run_check(), 1)

    def test_a_source_that_names_an_element(self):
        self.write("common/fem/elements.hpp", "P1Tetrahedron\n")
        self.write("common/run/load_scene.cpp", "using P1Tetrahedron = int;\n")
        self.assertEqual(naming_sources(self.root), [])
        self.write("partitioned/driver.cpp", "using P2P1Tetrahedron = int;\n")
        self.assertEqual(naming_sources(self.root), ["partitioned/driver.cpp"])
        self.assertEqual(self.run_check(), 1)


if __name__ == "__main__":
    unittest.main()
