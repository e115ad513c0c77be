"""What other programs read of our files: VTK as ParaView brings it, and meshio, where an interpreter has them."""

import os
import unittest

from programs import execute


def read_by_others(script, *words):
    """What a script prints that reads by VTK or meshio. Skips the test where no interpreter can import them."""
    interpreter = os.environ.get("FSI_VTK_PYTHON")
    if not interpreter:
        raise unittest.SkipTest("needs the Debian packages python3-paraview and python3-meshio")
    process = execute(interpreter, "-E", "-B", script, *words)
    if process.returncode != 0:
        raise AssertionError(process.stderr)
    return process.stdout
