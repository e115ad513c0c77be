"""Allocations that fail: one, all from one on, large ones, random ones, and all that a limit of addresses (ulimit -v)
refuses. A run must end with one message and exit code 1, its last checkpoint fit to go on from, or be unharmed: exit
code 0 and the bytes of an undisturbed run.

The sparse meshes of 3 GB are refused by their headers: the bytes that a program reads of all its files are counted.
"""

import dataclasses
import os
import random
import resource
import shutil
import struct
import subprocess
import tempfile
import time
from pathlib import Path

from harness import NEO_HOOKEAN, Harness, is_one_message, tiny_mesh

GOOD = ("refused", "unharmed", "not loaded")
TABLES = ("centerline_pressure.csv", "wall_displacement.csv", "flow.csv", "energy.csv")
MIB = 1 << 20
MOST_OF_A_HEADER = 32 * MIB  # that a program reads, its libraries included, before it refuses a mesh by its header


def options(parser):
    parser.add_argument(
        "--preload", type=Path, help="the library of failing allocations; by default beside the programs"
    )
    parser.add_argument(
        "--part", action="append", choices=("calls", "sizes", "limits", "meshes"), help="this part only"
    )


@dataclasses.dataclass
class Job:
    """A program with its arguments; `threads` is none for fsi-mesh."""

    program: str
    arguments: tuple
    threads: int = 0
    bytes: dict = dataclasses.field(default_factory=dict)
    calls: int = 0

    @property
    def name(self):
        return " ".join([self.program, *map(str, self.arguments[:0]), *self.label])

    @property
    def label(self):
        words = [word for word in map(str, self.arguments) if "solver=" in word or "scheme=" in word]
        return words + ([f"{self.threads} threads"] if self.threads else [])


def bytes_read(pid):
    """By a process that has ended, or has not, and whose exit code nobody has fetched."""
    return int(Path(f"/proc/{pid}/io").read_text().split("rchar:")[1].split()[0])


class Memory(Harness):
    def __init__(self):
        super().__init__("memory", __doc__.splitlines()[0], GOOD, options)
        self.preload = self.options.preload or self.options.programs.parent / "lib" / "libfsi_fail_allocations.so"
        if not self.preload.exists():
            raise SystemExit(f"memory: there is no {self.preload}")
        self.random = random.Random(self.options.seed)
        self.seconds = 0.0  # of the slowest undisturbed run
        self.bytes_read = 0  # by the last run, from files and pipes

    def jobs(self):
        mesh = tiny_mesh(self)
        settings = (f"mesh.file={mesh}", "time.end=0.5", "output.checkpoint_every=1")
        case = (NEO_HOOKEAN, "-q", *(word for setting in settings for word in ("--set", setting)))

        def driver(program, threads, *more):
            words = [word for setting in more for word in ("--set", setting)]
            return Job(program, (*case, *words, "--threads", threads), threads)

        jobs = [
            driver("fsi-monolithic", 1),
            driver("fsi-monolithic", 8, "monolithic.linear_solver=direct"),
            driver("fsi-partitioned", 8),
            Job("fsi-mesh", ("artery", "-q", "--size", 2, "--axial-size", 1, "--length", 2)),
        ]
        if self.full:
            jobs += [
                driver("fsi-monolithic", 8),
                driver("fsi-monolithic", 1, "monolithic.linear_solver=direct"),
                driver("fsi-monolithic", 8, "monolithic.linear_solver=ssor"),
                driver("fsi-monolithic", 1, "monolithic.linear_solver=amg"),
                driver("fsi-partitioned", 1),
                driver("fsi-partitioned", 1, "partitioned.scheme=iqn-ils"),
                driver("fsi-partitioned", 8, "partitioned.scheme=robin-neumann"),
            ]
        for job in jobs:
            self.undisturbed(job)
        return jobs

    def start(self, job, folder, fault=None, limit=None, more=(), count=None):
        """(exit code or "hang", standard error) of a disturbed run in an empty folder."""
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        environment = dict(os.environ)
        for name in ("OPENBLAS_NUM_THREADS", "GOMP_SPINCOUNT"):
            environment.pop(name, None)
        if fault or count:
            environment["LD_PRELOAD"] = str(self.preload)
            environment["MEMORY_FAULT"] = fault or ""
            environment["MEMORY_SEED"] = str(self.options.seed)
        if count:
            environment["MEMORY_COUNT"] = str(count)

        def limits():
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            if limit:
                resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

        out = folder / ("tube.msh" if job.program == "fsi-mesh" else "out")
        command = [self.program(job.program), *map(str, job.arguments), *map(str, more), "-o", str(out)]
        with tempfile.TemporaryFile() as said:
            process = subprocess.Popen(
                command, stdout=subprocess.DEVNULL, stderr=said, env=environment, preexec_fn=limits
            )
            ended = self.wait_for_end(process, 60 + 100 * self.seconds)
            self.bytes_read = bytes_read(process.pid)
            if not ended:
                process.kill()
            code = process.wait()
            said.seek(0)
            return (code, said.read().decode(errors="replace")) if ended else ("hang", "")

    @staticmethod
    def wait_for_end(process, patience):
        """Of a process that hangs: false. Its exit code is not fetched, so that /proc still tells what it has read."""
        latest = time.monotonic() + patience
        while not os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT | os.WNOHANG):
            if time.monotonic() > latest:
                return False
            time.sleep(0.002)
        return True

    @staticmethod
    def results(folder):
        if (folder / "tube.msh").exists():
            return {"tube.msh": (folder / "tube.msh").read_bytes()}
        return {name: (folder / "out" / name).read_bytes() for name in TABLES if (folder / "out" / name).exists()}

    def undisturbed(self, job):
        folder, count = self.base / "right", self.base / "count"
        begin = time.monotonic()
        code, said = self.start(job, folder, count=count)
        self.seconds = max(self.seconds, time.monotonic() - begin)
        if code != 0:
            raise SystemExit(f"memory: {job.name} fails undisturbed: {said}")
        job.bytes, job.calls = self.results(folder), int(count.read_text())
        print(f"{job.name}: {job.calls} allocations", flush=True)

    def judge(self, job, what, restart=False, **disturbance):
        folder = self.base / "run"
        code, said = self.start(job, folder, **disturbance)
        what = f"{job.name}, {what}: exit code {code}, {said.strip()[:300]!r}"
        if code == "hang":
            self.count("hang", what)
        elif code == 0:
            self.count("unharmed" if self.results(folder) == job.bytes else "wrong bytes", what)
        elif code == 127 and said.count("\n") == 1:
            self.count("not loaded", what)  # the dynamic loader's message: no text of the program has run
        elif code != 1:
            self.count("signal" if code < 0 else f"exit code {code}", what)
        elif not is_one_message(said, job.program):
            self.count("not one message", what)
        elif restart and (folder / "out" / "checkpoint.h5").exists():
            kept = self.base / "kept"
            shutil.rmtree(kept, ignore_errors=True)
            shutil.move(folder / "out", kept)
            code, said = self.start(job, folder, more=("--restart", kept))
            good = code == 0 and self.results(folder) == job.bytes
            self.count("refused" if good else "checkpoint lost", f"{what}; restart: exit code {code}, {said[:300]!r}")
        else:
            self.count("refused", what)

    def spread(self, last, count):
        """Numbers up to `last`: half of them evenly spread, half so that early ones are frequent."""
        even = [self.random.randint(1, last) for _ in range(count // 2)]
        early = [round(last ** self.random.random()) for _ in range(count - count // 2)]
        return sorted({max(1, n) for n in even + early})

    def calls(self, jobs):
        for job in jobs:
            for kind, count in (("once", 40 if self.full else 3), ("from", 20 if self.full else 2)):
                for n in self.spread(job.calls, count):
                    self.judge(job, f"{kind}:{n}", restart=self.full, fault=f"{kind}:{n}")
            for one_in in (10, 1000, job.calls) if self.full else ():
                self.judge(job, f"random:{one_in}", restart=True, fault=f"random:{one_in}")

    def sizes(self, jobs):
        for job in jobs:
            for size in [1 << k for k in range(4, 28)] if self.full else (1 << 8, 1 << 16, 1 << 20):
                self.judge(job, f"above:{size}", restart=True, fault=f"above:{size}")

    def limits(self, jobs):
        steps = (*range(60, 260, 8), *range(260, 600, 40), 1000, 1500, 2000) if self.full else (60, 90, 140, 200, 250)
        for job in jobs:
            for limit in steps:
                self.judge(job, f"ulimit -v {limit} MiB", limit=limit * MIB)

    def meshes(self):
        """Files of 3 GB, almost all of it holes."""
        header = {
            kind: b"$MeshFormat\n%s 8\n%s$EndMeshFormat\n"
            % (kind.encode(), b"\x01\0\0\0\n" if kind[-1] == "1" else b"")
            for kind in ("4.1 0", "4.1 1", "2.2 0", "2.2 1")
        }
        nodes = {
            "4.1 0": b"$Nodes\n1 %d 1 9\n",
            "4.1 1": b"$Nodes\n",
            "2.2 0": b"$Nodes\n%d\n",
            "2.2 1": b"$Nodes\n%d\n",
        }
        job = Job("fsi-monolithic", (NEO_HOOKEAN, "-q", "--threads", 1))
        file = self.base / "sparse.msh"
        texts = {"zeros alone": b"", "no mesh": b"solid\n"}
        for kind, text in header.items():
            for count in (10**18, 10**9, 2**63 - 1, 4):
                rest = (
                    nodes[kind] % count
                    if b"%d" in nodes[kind]
                    else nodes[kind] + struct.pack("<4q", 1, count, 1, count)
                )
                texts[f"{kind} with {count} nodes"] = text + rest
        for name, text in texts.items():
            with open(file, "wb") as stream:
                stream.write(text)
                stream.truncate(3 << 30)
            more = ("--set", f"mesh.file={file}")
            for limit in (None, 512 * MIB):
                job.bytes = {"no results": b""}  # a run that ends with exit code 0 is wrong
                self.judge(job, f"mesh of 3 GB, {name}, limit {limit}", limit=limit, more=more)
                if self.bytes_read > MOST_OF_A_HEADER:
                    self.count("read on", f"mesh of 3 GB, {name}: {self.bytes_read} bytes")
        file.unlink()


def main():
    harness = Memory()
    parts = harness.options.part or ("calls", "sizes", "limits", "meshes")
    jobs = harness.jobs() if set(parts) - {"meshes"} else []
    for part in ("calls", "sizes", "limits"):
        if part in parts:
            getattr(harness, part)(jobs)
    if "meshes" in parts:
        harness.meshes()
    harness.finish()


if __name__ == "__main__":
    main()
