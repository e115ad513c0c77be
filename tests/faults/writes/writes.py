"""Writes that fail: every call that changes a result file fails once, and disks of many sizes are full.

A run must end with exit code 1, one message, and a state from which it goes on to the bytes of an undisturbed run
("refused"), or with exit code 0 and these bytes ("unharmed").
"""

import concurrent.futures
import errno
import os
import random
import resource
import shutil
import subprocess
from pathlib import Path

from harness import DRIVERS, Harness, tiny_mesh
from scenario import Scenario

STEP = 0.125  # ms, of the case
SIZES = [round(60e3 * (4e6 / 60e3) ** (k / 29)) for k in range(30)]  # of disks, bytes
MEMORY = Path("/dev/shm")  # a disk for the short runs, where there is one
VICTIMS = (
    "iterations.csv",
    "centerline_pressure.csv",
    "energy.csv",
    "run.log",
    "checkpoint.h5",
    "summary.json",
    "fields.h5",
    "fields.xdmf",
    "fluid.xdmf",
    "wall.xdmf",
)


def options(parser):
    parser.add_argument("--workers", type=int, default=2, help="runs at the same time")
    parser.add_argument("--only", default="", help="only scenarios with this in their name")


class Writes:
    """All scenarios of both drivers; jobs are collected and run at the end."""

    def __init__(self, harness):
        self.harness, self.jobs = harness, []
        self.random = random.Random(harness.options.seed)
        self.mesh = tiny_mesh(harness)

    def settings(self, steps, *more):
        return (
            f"mesh.file={self.mesh}",
            f"time.end={steps * STEP}",
            "output.every=1",
            "output.checkpoint_every=1",
            *more,
        )

    def scenario(self, program, name, *arguments, **options_):
        """None if it is not wanted."""
        if self.harness.options.only not in f"{program} {name}":
            return None
        return Scenario(self.harness, program, name, *arguments, **options_)

    def add(self, scenario, what, *arguments, **options_):
        self.jobs.append((scenario, what, arguments, options_))

    def sample(self, items, count):
        """All in full, else a sample that is spread over the items."""
        if self.harness.full or len(items) <= count:
            return list(items)
        width = len(items) / count
        chosen = {int((k + self.random.random()) * width) for k in range(count)}
        return [items[k] for k in sorted(chosen)]

    def fail_every_call(self, scenario, count, thorough=False):
        """Each call fails once; from each call on all fail; each write takes half of its bytes. Unless thorough, the last
        two are tried with a sample of the calls."""
        calls = scenario.calls()
        for call in self.sample(calls, count):
            number = errno.EIO if call.kind in ("fsync", "close", "rename") else errno.ENOSPC
            self.add(scenario, f"{call} fails once", {"AT": call.number, "ERRNO": number})
        for call in self.sample(calls if thorough else calls[::5], count // 2):
            self.add(scenario, f"{call} and all later fail", {"AT": call.number, "ERRNO": errno.ENOSPC, "LASTING": 1})
        writes = [call for call in calls if "write" in call.kind]
        for call in self.sample(writes if thorough else writes[::5], count // 4):
            self.add(scenario, f"{call} is short", {"AT": call.number, "SHORT": 1})

    def restarts(self, program):
        """The same while a run is continued: in place, and in another folder."""
        earlier = self.scenario(program, "restart source", self.settings(2))
        if earlier is None:
            return
        source = earlier.reference

        def copy(folder):
            shutil.copytree(source, folder)

        for name, prepare, from_folder in (("in place", copy, None), ("elsewhere", None, source)):
            scenario = Restarted(self.harness, program, f"restart {name}", self.settings(4), from_folder, prepare)
            self.fail_every_call(scenario, 6)

    def small_disks(self, scenario):
        """Disks that take so many bytes, by the preloaded library, and files that may have so many."""
        for size in self.sample(SIZES, 4):
            self.add(scenario, f"disk of {size} bytes", {"BUDGET": size})

        def limit(size):
            return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))

        for size in self.sample([1000, 3000, 10000, 30000, 50000, 80000, 200000], 1):
            self.add(scenario, f"files up to {size} bytes", preexec_fn=limit(size))
        if self.harness.full and can_mount(self.harness.base / "mount"):
            for size in SIZES:
                self.add(scenario, f"mounted disk of {size} bytes", before=mounted(size), after=made_large)

    def lost_files(self, program):
        """Files are deleted or emptied under a running program."""
        scenario = self.scenario(program, "lost files", self.settings(4), only_message=True)
        if scenario is None:
            return
        calls = scenario.calls()
        second = [call.number for call in calls if call.name == "checkpoint.h5" and call.kind == "rename"][1]
        for victim in VICTIMS:
            for deed in ("DELETED", "EMPTIED"):
                self.add(scenario, f"{victim} {deed.lower()}", {"AT": second + 1, deed: victim})

    def no_convergence(self, program):
        """Step 3 finds no solution; whatever fails then, the message says so."""
        loads = "inlet.pressure=[[0.0, 1.332], [0.25, 1.332], [0.26, 1e9], [9.0, 1e9]]"
        scenario = self.scenario(program, "no convergence", self.settings(4, loads, "time.retries=0"))
        if scenario is None:
            return
        if scenario.undisturbed.returncode != 2:
            raise SystemExit(f"{scenario.name} does not fail: {scenario.undisturbed}")
        self.fail_every_call(scenario, 4)

    def run(self):
        def one(job):
            scenario, what, arguments, options_ = job
            scenario.judge(what, *arguments, **options_)

        with concurrent.futures.ThreadPoolExecutor(self.harness.options.workers) as pool:
            for done in concurrent.futures.as_completed([pool.submit(one, job) for job in self.jobs]):
                done.result()


class Restarted(Scenario):
    """A run that goes on from `source`; None: from what its own folder holds."""

    def __init__(self, harness, program, name, settings, source, prepare):
        self.source = source
        super().__init__(harness, program, name, settings, prepare=prepare)

    def options(self, folder):
        return ("--restart", self.source or folder, "-o", folder)


def can_mount(folder):
    """Whether this user may mount a disk in memory."""
    if os.geteuid() != 0:
        return False
    folder.mkdir(exist_ok=True)
    mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", folder], capture_output=True, check=False)
    if mount.returncode == 0:
        subprocess.run(["umount", folder], check=True)
    return mount.returncode == 0


def mounted(size):
    """Gives a folder a disk of its own."""

    def before(folder):
        folder.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder], check=True)

    return before


def made_large(folder, gone=False):
    """Makes room on a mounted disk, or takes it away."""
    command = ["umount", folder] if gone else ["mount", "-o", "remount,size=64m", folder]
    subprocess.run(command, check=True)


def main():
    if "TMPDIR" not in os.environ and os.access(MEMORY, os.W_OK):
        os.environ["TMPDIR"] = str(MEMORY)  # thousands of synchronised files
    harness = Harness("writes", __doc__, ["refused", "unharmed"], prepare=options)
    writes = Writes(harness)
    for program in DRIVERS:
        short = writes.scenario(program, "calls", writes.settings(3))
        if short:
            writes.fail_every_call(short, 16, thorough=True)
        long = writes.scenario(program, "disks", writes.settings(12))
        if long:
            writes.small_disks(long)
        writes.restarts(program)
        writes.lost_files(program)
        writes.no_convergence(program)
    writes.run()
    harness.finish()


if __name__ == "__main__":
    main()
