"""Several processes: they speak, write and end as one."""

import os
import re
import signal
import subprocess
import time
import unittest
from pathlib import Path

import numpy as np
from programs import (
    ARTERY,
    DRIVERS,
    MONOLITHIC,
    NEO_HOOKEAN,
    FolderTest,
    arrays,
    driver_command,
    execute,
    summary,
    table,
)
from scenes import forms, write_channel

MPIRUN = Path(__file__).parents[2] / "support" / "mpirun.sh"
LIMIT = Path(__file__).parents[1] / "exit_codes" / "beyond_the_limit.toml"
SECONDS = 100
STEP = 0.125  # ms


def together(processes, *command):
    return [str(MPIRUN), str(processes), str(SECONDS), *map(str, command)]


def errors_of(text):
    """The program's own messages, without warnings and what the launcher says."""
    # Open MPI 5 lets a message follow an unfinished line of progress without a new line.
    lines = re.sub(r"\x1b\[K[^\n]*?(?=fsi-\w+: )", "\n", text).splitlines()
    return [line for line in lines if line.startswith("fsi-") and ": warning: " not in line]


def children(process):
    """Processes that the launcher has started."""
    found = execute("ps", "-o", "pid=,comm=", "--ppid", process).stdout.split("\n")
    return [int(line.split()[0]) for line in found if "fsi-" in line]


def is_running(pid):
    """Neither gone nor ended and not yet asked for its exit code."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


class ProcessTest(FolderTest):
    case, order = NEO_HOOKEAN, 1

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        mesh = cls.base / "channel.msh"
        write_channel(mesh, cls.order)
        cls.settings = (f"mesh.file={mesh}", "geometry=plane", "newton.tolerance=1e-10")

    def command(self, folder, *options, steps=4, settings=(), program=MONOLITHIC):
        settings = (*self.settings, f"time.end={STEP * steps:g}", *settings)
        return driver_command(program, self.case, *options, folder=folder, settings=settings)

    def run_together(self, processes, folder, *options, **asked):
        finished = execute(*together(processes, *self.command(folder, "-q", *options, **asked)))
        self.assertEqual((finished.returncode, errors_of(finished.stderr)), (0, []), finished.stderr)
        return folder

    def start(self, processes, folder, steps=4000):
        command = together(processes, *self.command(folder, steps=steps, settings=["output.every=0"]))
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def wait_for_checkpoint(self, process, folder):
        deadline = time.monotonic() + SECONDS
        while process.poll() is None and time.monotonic() < deadline:
            if (folder / "checkpoint.h5").exists():
                return
            time.sleep(0.01)
        self.fail(f"no checkpoint: {process.communicate()}")


class Endings(ProcessTest):
    def test_help_is_printed_once(self):
        finished = execute(*together(2, MONOLITHIC, "--help"))
        self.assertEqual(finished.returncode, 0, finished.stderr)
        self.assertEqual(finished.stdout.count("--restart"), 1)

    def test_what_all_find_wrong_is_said_once(self):
        finished = execute(*together(2, *self.command(self.base / "none", settings=["fluid.densty=1"])))
        self.assertEqual(finished.returncode, 1)
        self.assertEqual(len(errors_of(finished.stderr)), 1, finished.stderr)
        self.assertIn("densty", finished.stderr)
        self.assertFalse((self.base / "none").exists())

    def test_what_the_first_finds_is_said_once(self):
        folder = self.base / "foreign"
        folder.mkdir()
        (folder / "letter.txt").write_text("mine")
        finished = execute(*together(2, *self.command(folder)))
        self.assertEqual(finished.returncode, 1)
        self.assertEqual(len(errors_of(finished.stderr)), 1, finished.stderr)
        self.assertIn("letter.txt", finished.stderr)
        self.assertEqual([file.name for file in folder.iterdir()], ["letter.txt"])

    def test_what_one_finds_wrong_ends_all(self):
        other = self.base / "missing.toml"
        program, case, *rest = self.command(self.base / "one")
        # Not two programs on one command line of mpirun, which Open MPI 5.0.7 does not survive.
        choice = 'case=$1; [ "$OMPI_COMM_WORLD_RANK" != 1 ] || case=$2; shift 2; exec "$0" "$case" "$@"'
        finished = execute(*together(2, "sh", "-c", choice, program, case, other, *rest))
        self.assertEqual(finished.returncode, 1)
        self.assertEqual(len(errors_of(finished.stderr)), 1, finished.stderr)
        self.assertIn("error (process 2 of 2): ", finished.stderr)
        self.assertIn("missing.toml", finished.stderr)

    def test_more_processes_than_nodes_are_refused(self):
        mesh = self.base / "two.msh"
        mesh.write_text(
            '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n2 1 "fluid"\n1 2 "inlet"\n1 3 "outlet"\n'
            '1 4 "symmetry_y"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n'
            "$Elements\n5\n1 1 2 2 2 4 1\n2 1 2 3 3 2 3\n3 1 2 4 4 1 2\n4 2 2 1 1 1 2 3\n5 2 2 1 1 1 3 4\n$EndElements\n"
        )
        case = self.base / "two.toml"
        case.write_text(
            'geometry = "plane"\nelement = "p1"\n[mesh]\nfile = "two.msh"\n[fluid]\ndensity = 1.0\nviscosity = 0.0035\n'
            "[inlet]\npressure = 1.0\nuntil = 0.125\n[time]\nstep = 0.125\nend = 0.25\n"
        )
        finished = execute(*together(5, MONOLITHIC, case, "-o", self.base / "two", "--threads", 1))
        self.assertEqual(finished.returncode, 1)
        self.assertEqual(len(errors_of(finished.stderr)), 1, finished.stderr)
        self.assertIn("has 4 nodes for 5 processes", finished.stderr)
        self.assertFalse((self.base / "two").exists())

    def test_no_solution_saves_the_state_and_says_so_once(self):
        folder = self.base / "limit"
        finished = execute(*together(2, MONOLITHIC, LIMIT, "-q", "-o", folder, "--threads", 1))
        self.assertEqual(finished.returncode, 2, finished.stderr)
        self.assertEqual(len(errors_of(finished.stderr)), 1, finished.stderr)
        self.assertRegex(finished.stderr, r"error: load step \d+ \(to ")
        self.assertIn("continue by: mpirun -n 2 ", finished.stderr)
        done = summary(folder)["totals"]["steps"]
        self.assertGreater(done, 0)
        self.assertEqual(summary(folder)["status"], "not converged")
        self.assertEqual(arrays(folder / "checkpoint.h5")["step"][0], done)

    def test_a_signal_to_one_stops_all_after_the_same_step(self):
        folder = self.base / "stopped"
        with self.start(2, folder) as process:
            self.wait_for_checkpoint(process, folder)
            os.kill(children(process.pid)[1], signal.SIGTERM)
            errors = process.communicate(timeout=SECONDS)[1]
        self.assertEqual(process.returncode, 143, errors)
        self.assertEqual(len(errors_of(errors)), 1, errors)
        self.assertIn(": interrupted after step ", errors)
        done = summary(folder)["totals"]["steps"]
        self.assertEqual(summary(folder)["status"], "interrupted")
        self.assertEqual(arrays(folder / "checkpoint.h5")["step"][0], done)
        self.assertFalse((folder / "run.lock").exists())
        self.run_together(1, folder, "--restart", folder, steps=done + 1, settings=["output.every=0"])
        self.assertEqual(len(table(folder, "iterations.csv")), done + 1)

    def test_one_that_is_killed_ends_all_and_leaves_a_checkpoint(self):
        for victim in (0, 1):
            folder = self.base / f"killed {victim}"
            with self.subTest(victim=victim), self.start(2, folder) as process:
                self.wait_for_checkpoint(process, folder)
                started = children(process.pid)
                os.kill(started[victim], signal.SIGKILL)
                errors = process.communicate(timeout=SECONDS)[1]
                self.assertNotEqual(process.returncode, 0)
                self.assertIn("signal 9", errors)
                latest = time.monotonic() + SECONDS
                while any(is_running(pid) for pid in started) and time.monotonic() < latest:
                    time.sleep(0.05)
                self.assertFalse([pid for pid in started if is_running(pid)])
                done = int(arrays(folder / "checkpoint.h5")["step"][0])
                self.run_together(1, folder, "--restart", folder, steps=done + 2, settings=["output.every=0"])
                self.assertEqual(summary(folder)["restarted_from_step"], done)


FIELDS = (
    "displacement velocity pressure wall_shear_stress cauchy_stress von_mises_stress fibre_stress thickness".split()
)


class Files(ProcessTest):
    """Quadratic elements, whose layers have vertices of their own, and fibres."""

    case, order = ARTERY, 2

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.settings += ("element=p2p1", *forms(ARTERY), f"output.fields={FIELDS}", "output.statistics=true")
        cls.settings += ("output.period=0.25", "output.error_indicator=true", "partitioned.tolerance=1e-10")

    def test_are_those_of_one_process(self):
        alone, both = (self.run_together(processes, self.base / f"by {processes}") for processes in (1, 2))
        one, two = (arrays(folder / "fields.h5") for folder in (alone, both))
        self.assertEqual(one.keys(), two.keys())
        self.assertIn("wall/cauchy_stress/00000004", one)
        self.assertIn("fluid/osi/00000004", one)
        self.assertIn("wall/thickness/00000004", one)
        self.assertIn("wall/displacement_error_mean/00000004", one)
        self.assertClose(one, two)
        for name in ("fields.xdmf", "fluid.xdmf", "wall.xdmf"):
            self.assertEqual((alone / name).read_text(), (both / name).read_text(), name)
        one, two = (arrays(folder / "checkpoint.h5") for folder in (alone, both))
        self.assertEqual(one.keys(), two.keys())
        self.assertEqual(
            {name: array.shape for name, array in one.items()}, {name: array.shape for name, array in two.items()}
        )
        self.assertEqual(sorted(file.name for file in alone.iterdir()), sorted(file.name for file in both.iterdir()))
        self.assertEqual(summary(alone)["unknowns"], summary(both)["unknowns"])
        self.assertEqual(summary(alone)["mesh"], summary(both)["mesh"])
        self.assertEqual((summary(alone)["processes"], summary(both)["processes"]), (1, 2))
        self.assertEqual(*(summary(folder)["work_unit"]["entries"] for folder in (alone, both)))
        self.assertGreater(summary(both)["totals"]["work_units_per_step"], 0)
        of_each = summary(both)["per_process"]
        self.assertNotIn("per_process", summary(alone))
        nodes = summary(both)["mesh"]["fluid_nodes"] + summary(both)["mesh"]["wall_nodes"]
        self.assertEqual(2 * of_each["owned_nodes"]["mean"], nodes)
        for name in (
            "halo_nodes",
            "halo_unknowns",
            "neighbours",
            "messages_per_step",
            "bytes_per_step",
            "step_seconds",
        ):
            self.assertGreater(of_each[name]["minimum"], 0, name)
            self.assertLessEqual(of_each[name]["minimum"], of_each[name]["maximum"], name)
        self.assertIn(" 2 processes, 1 threads each, ", (both / "run.log").read_text())

    def test_are_gone_on_with_by_any_number_of_processes(self):
        for program in DRIVERS:
            with self.subTest(program=program):
                part = self.base / f"part {program[-8:]}"
                whole = self.run_together(1, self.base / f"whole {program[-8:]}", steps=4, program=program)
                self.run_together(3, part, steps=2, program=program)
                self.run_together(2, part, "--restart", part, steps=3, program=program)
                self.run_together(1, part, "--restart", part, steps=4, program=program)
                for name in ("centerline_pressure.csv", "flow.csv"):
                    one, other = table(whole, name), table(part, name)
                    self.assertEqual(one.shape, other.shape)
                    self.assertLessEqual(np.abs(one - other).max(), 1e-8 * np.abs(one).max(), name)
                one, other = (arrays(run / "checkpoint.h5") for run in (whole, part))
                chosen = {
                    name: array
                    for name, array in one.items()
                    if name.startswith(("arrays/level", "arrays/stat", "arrays/errors"))
                }
                self.assertGreater(len(chosen), 13)
                self.assertClose(chosen, other)

    def test_a_checkpoint_that_is_read_is_written_again_as_it_was(self):
        for program in DRIVERS:
            with self.subTest(program=program):
                folder, again = (self.base / f"{name} {program[-8:]}" for name in ("first", "again"))
                self.run_together(3, folder, steps=2, program=program)
                self.run_together(2, again, "--restart", folder, steps=2, program=program)
                one, other = (arrays(run / "checkpoint.h5") for run in (folder, again))
                self.assertEqual([name for name in one if not np.array_equal(one[name], other.get(name))], [])

    def assertClose(self, one, other):
        for name, values in one.items():
            if np.issubdtype(values.dtype, np.integer) or re.search("points|steps", name):
                self.assertTrue(np.array_equal(values, other[name]), name)
            else:
                self.assertLessEqual(np.abs(values - other[name]).max(), 1e-8 * max(np.abs(values).max(), 1e-12), name)


if __name__ == "__main__":
    unittest.main()
