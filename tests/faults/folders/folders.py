"""One run, one folder: simultaneous starts, folders of runs that go on or have ended, locks that are left behind, names
and kinds of files that no result can take.

What is refused is refused with one message, before anything is computed, and leaves everything as it was.
"""

import os
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

from harness import DRIVERS, EVERY, NEO_HOOKEAN, Harness, execute, is_one_message, summary, tiny_mesh
from results import contents, differences

STEPS = 3
LONG = 3000  # more than are made before a signal
MONOLITHIC = DRIVERS[0]
LINEAR_STUDY = "fsi-linear-study"
NOBODY = 65534  # the user without rights
RESULT_FILES = (
    "centerline_pressure.csv",
    "wall_displacement.csv",
    "flow.csv",
    "iterations.csv",
    "energy.csv",
    "summary.json",
    "fields.h5",
    "fields.xdmf",
    "fluid.xdmf",
    "wall.xdmf",
    "checkpoint.h5",
    "run.log",
    "checkpoint.h5.tmp",
    "run.lock",
)


def lock_of(process, host=None):
    """Contents of a lock file."""
    return f"fsi-monolithic, process {process} on host {host or socket.gethostname()}\n"


def pipe(path):
    os.mkfifo(path)


def link_to_device(path):
    path.symlink_to("/dev/full")


def link_to_file(path):
    target = path.parent.parent / "target of a link"
    target.write_text("mine")
    path.symlink_to(target)


def bound_socket(path):
    short = os.path.relpath(path)  # a socket's path has about a hundred characters
    with socket.socket(socket.AF_UNIX) as bound:
        bound.bind(short if len(short) < len(str(path)) else str(path))


NO_FILES = (Path.mkdir, pipe, link_to_device, link_to_file, bound_socket)


def wait_for_step(folder):
    """Until a run has finished a step there; what was there before has STEPS of them."""
    limit = time.monotonic() + 60
    while time.monotonic() < limit:
        table = folder / "iterations.csv"
        if table.is_file() and table.read_bytes().count(b"\n") > STEPS + 1:
            return
        time.sleep(0.02)


class Folders:
    def __init__(self, harness):
        self.harness, self.base = harness, harness.base
        self.mesh = tiny_mesh(harness)
        self.number = 0
        self.reference = self.base / "reference"
        self.wait(self.start(MONOLITHIC, self.reference))

    def fresh(self):
        """A folder that does not exist."""
        self.number += 1
        return self.base / f"folder {self.number}"

    def command(self, program, folder, *options, steps=STEPS, settings=()):
        words = [self.harness.program(program), NEO_HOOKEAN, "-q", "--threads", 1]
        words += [*options] if folder is None else ["-o", folder, *options]
        for setting in (
            f"mesh.file={self.mesh}",
            f"time.end={0.125 * steps}",
            "partitioned.tolerance=1e-2",
            EVERY,
            *settings,
        ):
            words += ["--set", setting]
        return [str(word) for word in words]

    def start(self, program, folder, *options, user=None, **keywords):
        """`user`: as whom, where this is root."""
        command = self.command(program, folder, *options, **keywords)
        return subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=self.base,
            user=user if os.geteuid() == 0 else None,
        )

    def wait(self, process):
        output, errors = process.communicate(timeout=300)
        return process.returncode, output, errors

    def run(self, program, folder, *options, **keywords):
        return self.wait(self.start(program, folder, *options, **keywords))

    def finished(self):
        folder = self.fresh()
        shutil.copytree(self.reference, folder)
        return folder

    def refused(self, what, program, folder, *options, says=(), watched=None, **keywords):
        """The run must end with one message and change nothing in `watched`, by default its folder."""
        watched = folder if watched is None else watched
        there, before = os.path.lexists(folder) if folder else True, contents(watched)
        code, output, errors = self.run(program, folder, *options, **keywords)
        good = code == 1 and output == "" and is_one_message(errors, program) and len(errors) < 3000
        good &= all(word in errors for word in says)
        good &= contents(watched) == before and (os.path.lexists(folder) if folder else True) == there
        self.harness.count("refused" if good else "not refused", f"{what}: exit {code}, {errors!r}")

    def done(self, what, program, folder, *options, says="", reference=None, **keywords):
        """The run must end well, with this word and no other."""
        code, _, errors = self.run(program, folder, *options, **keywords)
        good = code == 0 and summary(folder).get("status") == "done" and not (folder / "run.lock").exists()
        good &= says in errors and errors.count("\n") == (1 if says else 0)
        good &= not says or says in (folder / "run.log").read_text()
        good &= reference is None or not differences(folder, reference)
        self.harness.count("done" if good else "not done", f"{what}: exit {code}, {errors!r}")

    # ---- runs at the same time

    def simultaneous_starts(self, starts, rounds):
        for round_ in range(rounds):
            folder = self.fresh() if round_ % 2 == 0 else self.finished()
            if round_ % 4 == 3:
                (folder / "run.lock").write_text(lock_of(1))  # left behind by a process that is another one now
            options = () if round_ % 2 == 0 else ("--force",)
            # The winner goes on until all others have ended, and is ended then: none can start behind its end.
            runs = [self.start(MONOLITHIC, folder, *options, steps=100_000) for _ in range(starts)]
            limit = time.monotonic() + 100
            while sum(run.poll() is None for run in runs) > 1 and time.monotonic() < limit:
                time.sleep(0.02)
            going = [run for run in runs if run.poll() is None]
            for run in going:
                wait_for_step(folder)
                run.terminate()
            ended = [self.wait(run) for run in runs]
            losers = [
                is_one_message(errors, MONOLITHIC) and ("a run works in it" in errors or "holds a finished" in errors)
                for code, _, errors in ended
                if code == 1
            ]
            good = len(going) == 1 and going[0].returncode == 128 + signal.SIGTERM
            good &= len(losers) == starts - 1 and all(losers) and not (folder / "run.lock").exists()
            good &= summary(folder)["status"] == "interrupted"
            self.harness.count("one winner" if good else "no single winner", f"round {round_}: {ended}")

    def running_folder(self, program):
        """Nobody may start in, replace, continue or restart from the folder of a run."""
        folder, other = self.fresh(), self.fresh()
        process = self.start(program, folder, steps=LONG)
        deadline = time.monotonic() + 100
        while "status" not in summary(folder) or not (folder / "checkpoint.h5").exists():
            if time.monotonic() > deadline:
                raise SystemExit("the run does not begin")
            time.sleep(0.01)
        process.send_signal(signal.SIGSTOP)
        says = (f"process {process.pid} on host {socket.gethostname()}", "a run works in it")
        for another in DRIVERS:
            self.refused("start in a running folder", another, folder, says=says)
            self.refused("start by force in a running folder", another, folder, "--force", says=says)
        self.refused("restart of a running folder", program, None, "--restart", folder, says=says, watched=folder)
        self.refused("restart from a running folder", program, other, "--restart", folder, says=says, watched=folder)
        link = self.fresh()
        link.symlink_to(folder)
        self.refused("start in a running folder by a link", program, link, "--force", says=says)
        process.kill()
        self.wait(process)
        self.done(
            "after a kill", program, folder, "--force", says=f"took over the lock of {program}, process {process.pid}"
        )

    def lock_that_vanishes(self):
        for remove in (lambda folder: (folder / "run.lock").unlink(), shutil.rmtree):
            folder = self.fresh()
            process = self.start(MONOLITHIC, folder, steps=LONG)
            while not (folder / "checkpoint.h5").exists():
                time.sleep(0.01)
            process.send_signal(signal.SIGSTOP)
            remove(folder)
            process.send_signal(signal.SIGCONT)
            code, _, errors = self.wait(process)
            good = code == 1 and is_one_message(errors, MONOLITHIC)
            self.harness.count("refused" if good else "not refused", f"lock removed: exit {code}, {errors!r}")

    # ---- locks that are there before

    def left_locks(self):
        ended = subprocess.Popen(["true"])
        ended.wait()
        for what, lock in (
            ("of a process that is gone", lock_of(ended.pid)),
            ("of a process whose number is used again", lock_of(os.getpid())),
        ):
            folder = self.fresh()
            folder.mkdir()
            (folder / "run.lock").write_text(lock)
            says = f"took over the lock of {MONOLITHIC}, process "
            self.done(f"lock {what}", MONOLITHIC, folder, says=says, reference=self.reference)
        folder = self.fresh()
        folder.mkdir()
        (folder / "run.lock").write_text("")
        self.done("empty lock", MONOLITHIC, folder, reference=self.reference)
        for what, lock, says in (
            ("of another host", lock_of(7, "elsewhere"), "process 7 on host elsewhere"),
            ("that says nothing", "mine\n", "does not say by whom"),
            ("of zeros", "\0" * 100, "does not say by whom"),
        ):
            folder = self.finished()
            (folder / "run.lock").write_text(lock)
            self.refused(f"lock {what}", MONOLITHIC, folder, says=(says,))
            self.refused(f"lock {what}, by force", MONOLITHIC, folder, "--force", says=(says,))
            self.refused(f"restart, lock {what}", MONOLITHIC, None, "--restart", folder, says=(says,), watched=folder)
            other = self.fresh()
            self.refused(f"from, lock {what}", MONOLITHIC, other, "--restart", folder, says=(says,), watched=folder)
            (folder / "run.lock").unlink()
            self.done(f"lock {what} removed", MONOLITHIC, folder, "--force", reference=self.reference)

    # ---- folders that hold something

    def earlier_results(self):
        for what, change in (
            ("finished", lambda folder: None),
            ("no summary", lambda folder: (folder / "summary.json").unlink()),
            ("damaged summary", lambda folder: (folder / "summary.json").write_text("{cut")),
            ("summary of another kind", lambda folder: (folder / "summary.json").write_text("[[[1]]]")),
            ("no iterations", lambda folder: (folder / "iterations.csv").unlink()),
            ("empty iterations", lambda folder: (folder / "iterations.csv").write_text("")),
            ("damaged iterations", lambda folder: (folder / "iterations.csv").write_bytes(b"\xff\0\n")),
            ("checkpoint alone", lambda folder: keep(folder, "checkpoint.h5")),
            ("table alone", lambda folder: keep(folder, "flow.csv")),
            ("fields alone", lambda folder: keep(folder, "fields.h5")),
            ("iterations alone", lambda folder: keep(folder, "iterations.csv")),
            ("foreign file", lambda folder: (folder / "thesis.tex").write_text("mine")),
            ("foreign folder", lambda folder: (folder / "more").mkdir()),
        ):
            for program in DRIVERS:
                folder = self.finished()
                change(folder)
                self.refused(what, program, folder)
                self.refused(f"{what}, restart into it", program, folder, "--restart", self.reference)

    def names(self):
        file = self.fresh()
        file.write_text("mine")
        long = "x" * 5000
        for what, folder, says in (
            ("a file", file, "is a file"),
            ("below a file", file / "below", "cannot be created"),
            ("5,000 characters", self.base / long, "File name too long"),
            ("a path of 5,000 characters", self.base / "/".join(["y" * 100] * 50), "File name too long"),
            ("the root", Path("/"), "no result file"),
            ("the folder of the process table", Path("/proc/fsi"), "cannot be created"),
            ("a folder with other files", Path("."), "no result file"),
            ("above", Path(".."), ""),
        ):
            for options in ((), ("--force",)):
                self.refused(what, MONOLITHIC, folder, *options, says=(says,), watched=self.base)
        for name in ("line\nbreak", "\x1b[31mred", "\udcff", "ünï", "a 'quote'", " ", "-q"):
            folder = self.fresh() / name
            self.done(f"name {name!r}", MONOLITHIC, folder, reference=self.reference)
            self.refused(f"name {name!r} again", MONOLITHIC, folder)
        target, link = self.fresh(), self.fresh()
        target.mkdir()
        link.symlink_to(target)
        self.done("a link to a folder", MONOLITHIC, link, reference=self.reference)
        self.refused("a link to a folder again", MONOLITHIC, link, says=("finished run",))
        dangling = self.fresh()
        dangling.symlink_to(self.base / "nowhere")
        self.refused("a link to nothing", MONOLITHIC, dangling)

    def folders_of_others(self):
        """What may be read and not written: it cannot take results, but a run can be continued from there."""
        os.chmod(self.base, 0o755)
        try:
            self.wait(self.start(MONOLITHIC, self.fresh(), "--version", user=NOBODY))
        except PermissionError:
            return  # the programs lie where only root may look
        empty, held, taken = self.fresh(), self.finished(), self.finished()
        empty.mkdir()
        (taken / "run.lock").write_text("")
        for folder in (empty, held, taken):
            os.chmod(folder, 0o555)
        for folder in (empty, held, taken, empty / "below"):
            says = "cannot be created" if folder.name == "below" else "cannot be written"
            self.refused("a folder of others", MONOLITHIC, folder, "--force", says=(says,), user=NOBODY)
        own = self.fresh()
        own.mkdir()
        os.chmod(own, 0o777)
        self.done("restart from a folder of others", MONOLITHIC, own, "--restart", held, user=NOBODY, steps=STEPS + 1)

    def refusals_leave_nothing(self):
        top = self.fresh()
        for what, settings in (("mesh", ("mesh.file=none.msh",)), ("mesh of another kind", ("geometry=axisymmetric",))):
            self.refused(what, MONOLITHIC, top / "a" / "b", settings=settings)
            good = not top.exists()
            self.harness.count("refused" if good else "leaves a folder", what)
        self.refused("restart of nothing", MONOLITHIC, None, "--restart", top / "none", watched=self.base)
        self.harness.count("refused" if not top.exists() else "leaves a folder", "restart of nothing")

    def members(self, names):
        """Names of results that stand for something else."""
        for name in names:
            for make in NO_FILES:
                folder = self.fresh()
                folder.mkdir()
                make(folder / name)
                before = os.lstat(folder / name)
                for options in ((), ("--force",), ("--restart", self.reference)):
                    self.refused(f"{name} by {make.__name__}", MONOLITHIC, folder, *options, says=(name,))
                if name != "run.lock":
                    source = self.finished()
                    (source / name).unlink(missing_ok=True)
                    make(source / name)
                    self.refused(
                        f"restart in place, {name}", MONOLITHIC, None, "--restart", source, says=(name,), watched=source
                    )
                same = os.lstat(folder / name).st_ino == before.st_ino
                self.harness.count("refused" if same else "replaced", f"{name} by {make.__name__}")
                shutil.rmtree(folder)

    # ---- other outputs

    def meshes(self):
        short = ("artery", "--size", 2, "--axial-size", 1, "--length", 2)
        makers = list(NO_FILES)
        makers.remove(link_to_file)
        if os.geteuid() == 0:
            makers.append(lambda path: os.mknod(path, 0o020666, os.makedev(1, 3)))
        for make in makers:
            folder = self.fresh()
            folder.mkdir()
            file = folder / "made.msh"
            try:
                make(file)
            except PermissionError:
                continue  # no devices in this container
            before = os.lstat(file)
            for name in (file, folder / "." / "made.msh"):
                ended = execute(self.harness.program("fsi-mesh"), *short, "-o", name, timeout=60)
                good = ended.returncode == 1 and is_one_message(ended.stderr, "fsi-mesh") and ended.stdout == ""
                good &= os.lstat(file).st_ino == before.st_ino and os.listdir(folder) == ["made.msh"]
                self.harness.count("refused" if good else "replaced", f"mesh: {ended}")
        folder = self.fresh()
        folder.mkdir()
        target, link = folder / "target.msh", folder / "link.msh"
        target.write_text("old")
        link.symlink_to("target.msh")
        ended = execute(self.harness.program("fsi-mesh"), *short, "-q", "-o", link)
        good = ended.returncode == 0 and link.is_symlink() and target.read_bytes() == self.mesh.read_bytes()
        self.harness.count("done" if good else "replaced", f"mesh by a link: {ended}")
        for name in (
            "/dev/null",
            "/dev/full",
            "/dev/stdout",
            ".msh",
            "",
            "none/made.msh",
            f"{'x' * 300}.msh",
            "/proc/made.msh",
        ):
            before = os.stat("/dev/null")
            ended = execute(self.harness.program("fsi-mesh"), *short, "-o", name, cwd=folder)
            good = os.stat("/dev/null").st_ino == before.st_ino and sorted(os.listdir(folder)) == [
                "link.msh",
                "target.msh",
            ]
            good &= ended.returncode == 1 and is_one_message(ended.stderr, "fsi-mesh") and ended.stdout == ""
            self.harness.count("refused" if good else "not refused", f"mesh {name[:30]}: {ended}")

    def linear_systems(self):
        options = ("--systems", "1:1", "--solvers", "fast")
        for make in NO_FILES:
            folder = self.fresh()
            folder.mkdir()
            make(folder / "linear_solvers.json")
            self.refused(
                f"linear systems by {make.__name__}", LINEAR_STUDY, folder, *options, says=("linear_solvers.json",)
            )
        file = self.fresh()
        file.write_text("mine")
        self.refused("linear systems into a file", LINEAR_STUDY, file, *options)
        folder = self.fresh()
        code, _, errors = self.run(LINEAR_STUDY, folder, *options)
        good = code == 0 and errors == "" and os.listdir(folder) == ["linear_solvers.json"]
        self.harness.count("done" if good else "not done", f"linear systems: exit {code}, {errors!r}")


def keep(folder, name):
    """Removes all else."""
    for file in folder.iterdir():
        if file.name != name:
            file.unlink()


def main():
    harness = Harness("folders", __doc__, good=("refused", "done", "one winner"))
    folders = Folders(harness)
    full = harness.full
    folders.simultaneous_starts(starts=16 if full else 6, rounds=40 if full else 4)
    for program in DRIVERS if full else DRIVERS[:1]:
        folders.running_folder(program)
    folders.lock_that_vanishes()
    folders.left_locks()
    folders.earlier_results()
    folders.names()
    folders.folders_of_others()
    folders.refusals_leave_nothing()
    folders.members(RESULT_FILES if full else RESULT_FILES[3:4] + RESULT_FILES[-4:])
    folders.meshes()
    folders.linear_systems()
    harness.finish()


if __name__ == "__main__":
    main()
