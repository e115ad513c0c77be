"""Runs the tests of one module or class in the working directory: `run_tests.py MODULE[.CLASS]`."""

import os
import sys
import unittest
from pathlib import Path

os.environ["PYTHONDONTWRITEBYTECODE"] = "1"  # of programs that tests start: nothing is left in the sources
sys.path.insert(0, os.getcwd())  # this folder, with the helpers, is on the path already
sys.path.append(str(Path(__file__).resolve().parents[2] / "support"))  # helpers of all kinds of tests

if __name__ == "__main__":
    tests = unittest.defaultTestLoader.loadTestsFromName(sys.argv[1])
    result = unittest.TextTestRunner(verbosity=2, stream=sys.stdout).run(tests)
    if result.testsRun == 0:
        sys.exit(f"{sys.argv[1]} holds no tests")
    sys.exit(not result.wasSuccessful())
