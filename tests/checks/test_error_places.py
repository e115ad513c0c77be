"""error_places.py finds errors without file, and only those."""

import tempfile
import unittest
from pathlib import Path

from error_places import nameless, problems


class ErrorPlaces(unittest.TestCase):
    def test_lines_are_found(self):
        self.assertEqual(nameless('throw InputError("", "key", "problem", "remedy");'), [1])
        self.assertEqual(nameless('\nthrow InputError(\n    "", "key",'), [2])
        self.assertEqual(nameless('throw InputError(std::string(), "key",'), [1])

    def test_errors_with_file_are_fine(self):
        self.assertEqual(nameless('throw InputError(file, "", "is a folder", "");'), [])
        self.assertEqual(nameless("InputError::InputError(const std::string& file,"), [])

    def test_a_tree(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for room in ("mesh", "sampling"):
                (root / "common" / room).mkdir(parents=True)
            (root / "common/sampling/point_sampling.cpp").write_text(
                'throw InputError("", "inner wall", "no surface", "");\n'
            )
            (root / "common/mesh/axis.cpp").write_text('throw InputError("", "structure.axis_direction", "", "");\n')
            self.assertEqual(problems(root), ["common/sampling/point_sampling.cpp:1: an InputError without file"])


if __name__ == "__main__":
    unittest.main()
