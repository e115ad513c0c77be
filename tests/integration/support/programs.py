"""Runs the programs as a user would and reads the folders that they leave."""

import itertools
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from result_data import arrays, differing_arrays, without_seconds  # noqa: F401

MESH, MONOLITHIC, PARTITIONED = (os.environ[name] for name in ("FSI_MESH", "FSI_MONOLITHIC", "FSI_PARTITIONED"))
DRIVERS = (MONOLITHIC, PARTITIONED)
LINEAR_STUDY = str(Path(MONOLITHIC).with_name("fsi-linear-study"))
CASES = Path(os.environ["FSI_CASES"])
NEO_HOOKEAN, MOONEY_RIVLIN, ARTERY = (CASES / f"{name}.toml" for name in ("neo-hookean", "mooney-rivlin", "artery"))

MPIRUN = Path(__file__).resolve().parents[2] / "support" / "mpirun.sh"
# All combinations of what a test takes in turn: `scripts/test.sh --long`.
LONG = bool(os.environ.get("FSI_LONG_TESTS"))
SECONDS_OF_PROCESSES = 100  # that a run on several may take, on a machine that is busy with other tests

POINTS = 181  # along the centre line and the wall
TABLES = ("centerline_pressure.csv", "wall_displacement.csv", "flow.csv", "energy.csv")


def by_turns(*choices):
    """Combinations of one item of each of the choices: all in the long form, else so many that each item occurs, each
    combination of the second and later choices too, and what goes together shifts from round to round."""
    if LONG:
        return list(itertools.product(*choices))
    first, rest = choices[0], list(itertools.product(*choices[1:]))
    count = max(len(first), len(rest))
    if len(first) >= len(rest):
        pairs = [(first[k], rest[(k + k // len(rest)) % len(rest)]) for k in range(count)]
    else:
        pairs = [(first[(k + k // len(first)) % len(first)], rest[k]) for k in range(count)]
    return [(item, *others) for item, others in pairs]


def execute(*command, **options):
    """Runs a command to its end and returns the finished process, its output as text."""
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=500, **options)


def driver_command(program, case, *options, folder=None, settings=(), threads=1, processes=None):
    """The command line of a run; `settings` are `key=value`. `processes`: that mpirun starts; None: without mpirun."""
    launcher = [] if processes is None else [MPIRUN, processes, SECONDS_OF_PROCESSES]
    command = [*launcher, program, case, "--threads", threads, *options]
    if folder is not None:
        command += ["-o", folder]
    for setting in settings:
        command += ["--set", setting]
    return [str(word) for word in command]


def attempt(program, case, *options, **how):
    """A run that may fail; `how` as of driver_command."""
    return execute(*driver_command(program, case, *options, **how))


def run(program, case, folder, *settings, options=(), **how):
    """A quiet run that must end well, whatever the folder held; returns the folder."""
    process = attempt(program, case, "-q", "--force", *options, folder=folder, settings=settings, **how)
    if process.returncode != 0:
        raise AssertionError(f"{' '.join(process.args)}\nends with {process.returncode}: {process.stderr}")
    return Path(folder)


def restart(program, case, folder, *settings, into=None, **how):
    """Continues the run in `folder`, in place or into another folder; must end well."""
    return run(program, case, into or folder, *settings, options=("--restart", folder), **how)


def make_mesh(file, *options):
    """An artery mesh by fsi-mesh."""
    process = execute(MESH, "artery", "-q", "-o", file, *options)
    if process.returncode != 0:
        raise AssertionError(f"{' '.join(process.args)}: {process.stderr}")
    return Path(file)


def make_small_mesh(file):
    """A third of the coarse artery, for tests that need many runs of any coupled scene."""
    return make_mesh(file, "--level", "coarse", "--length", 6)


def summary(folder):
    return json.loads((Path(folder) / "summary.json").read_text())


def calls(folder):
    """How often each phase was entered."""
    return {name: phase["calls"] for name, phase in summary(folder)["phases"].items()}


def table(folder, name):
    """All rows of a CSV file as an array of shape (rows, columns)."""
    return np.loadtxt(Path(folder) / name, delimiter=",", skiprows=1, ndmin=2)


def energy(folder):
    """energy.csv by column: {name without _uJ: values per step}."""
    names = (Path(folder) / "energy.csv").read_text().split("\n", 1)[0].split(",")
    return {name.removesuffix("_uJ"): column for name, column in zip(names, table(folder, "energy.csv").T)}


def pressure(folder):
    """Centre-line pressure in Pa, shape (steps, POINTS)."""
    return table(folder, "centerline_pressure.csv")[:, 2].reshape(-1, POINTS)


def wall(folder):
    """Inner wall, shape (steps, POINTS, 4): time, z, radial and axial displacement."""
    return table(folder, "wall_displacement.csv").reshape(-1, POINTS, 4)


def difference(a, b):
    """Largest difference relative to the largest value of b, for each row (time level)."""
    return np.abs(a - b).max(axis=1) / np.abs(b).max(axis=1)


def times(folder):
    """time_ms of the finished steps, as text."""
    lines = (Path(folder) / "iterations.csv").read_text().splitlines()[1:]
    return [line.split(",")[1] for line in lines]


def iterations_without_seconds(folder):
    return without_seconds(Path(folder) / "iterations.csv")


NEWTON = re.compile(r"newton +\d+  increment (\S+)  residual (\S+)(?:  step (\S+))?(  new jacobian)?$")


def newton_history(folder):
    """Per step of run.log the list of (increment, residual, step length, new Jacobian)."""
    steps = []
    for line in (Path(folder) / "run.log").read_text().splitlines():
        if re.search(r" step \d+  t = ", line):
            steps.append([])
        found = NEWTON.search(line)
        if found:
            increment, residual, length, renewed = found.groups()
            steps[-1].append((float(increment), float(residual), float(length or 1), renewed is not None))
    return steps


class FolderTest(unittest.TestCase):
    """Tests of a class share self.base, a folder that goes with them."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.base = Path(temporary.name)

    def assertSameResults(self, folder, other):
        """Tables, iterations, checkpoint and fields of two runs agree bit for bit."""
        self.assertSameTables(folder, other)
        self.assertEqual(differing_arrays(folder / "checkpoint.h5", other / "checkpoint.h5"), [])
        self.assertEqual((folder / "fields.h5").exists(), (other / "fields.h5").exists())
        if (folder / "fields.h5").exists():
            self.assertEqual(differing_arrays(folder / "fields.h5", other / "fields.h5"), [])
            for name in ("fields.xdmf", "fluid.xdmf", "wall.xdmf"):
                self.assertEqual((folder / name).exists(), (other / name).exists(), name)
                if (folder / name).exists():
                    self.assertEqual((folder / name).read_text(), (other / name).read_text(), name)

    def assertSameTables(self, folder, other):
        for name in TABLES:
            self.assertEqual((folder / name).exists(), (other / name).exists(), name)
            if (folder / name).exists():
                same = (folder / name).read_bytes() == (other / name).read_bytes()
                self.assertTrue(same, f"{name} differs")
        self.assertEqual(iterations_without_seconds(folder), iterations_without_seconds(other))

    def assertNoNan(self, folder):
        for file in folder.iterdir():
            if file.suffix == ".csv":
                self.assertTrue(np.isfinite(table(folder, file.name)).all(), file.name)
            elif file.suffix == ".h5":
                for name, values in arrays(file).items():
                    self.assertTrue(np.isfinite(values).all(), f"{file.name}: {name}")
            elif file.suffix in (".json", ".log", ".xdmf"):
                self.assertNotRegex(file.read_text(), r"(?i)\b-?(nan|inf)\b", file.name)
