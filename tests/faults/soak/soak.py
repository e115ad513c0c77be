"""A job of many runs, and one of many steps.

Many runs: a tree of folders, one for each hour, filled by several processes at once with runs of both drivers. Most are
left alone; some have a mistake in their input, some are continued in another folder, some are killed and continued in
their own. What is finished holds the results of an undisturbed run, a mistake leaves no results, and in the end there is
no file that does not belong there and no process.

Many steps: one run on a tiny mesh. Memory, descriptors, bytes and calls of writing per step, and the checkpoint's size
are the same at its end as near its start; what does not depend on time is compared, so that a busy machine gives the same
answer. While it is written, the list of its fields is read again and again.
"""

import os
import random
import re
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py

from finished_results import difference
from harness import DRIVERS, EVERY, NEO_HOOKEAN, Harness, execute, is_one_message, summary, tiny_mesh

STEP = 0.125
STEPS = 12
GOOD = (
    "done",
    "refused with one message",
    "continued elsewhere with the same results",
    "killed and continued with the same results",
    "flat",
)
MISTAKES = (
    ("fluid.density=-1", 1),
    ("fluid.densty=1", 1),
    ("mesh.file=missing.msh", 1),
    ("time.step=0", 1),
    ("output.fields=['colour']", 1),
)
FILES = re.compile(
    r"(fields(-\d{4,})?\.h5|(fields|fluid|wall)\.xdmf|checkpoint\.h5|summary\.json|run\.log|[a-z_]+\.csv)"
)


def options(parser):
    parser.add_argument("--runs", type=int, help="in the tree of folders")
    parser.add_argument("--at-once", type=int, default=4, help="processes")
    parser.add_argument("--steps", type=int, help="of the long run")


def command(harness, program, folder, mesh, *settings):
    words = [harness.program(program), NEO_HOOKEAN, "-o", folder, "-q", "--threads", 1]
    for setting in (f"mesh.file={mesh}", "output.every=1", EVERY, *settings):
        words += ["--set", setting]
    return [str(word) for word in words]


def unreadable(folder):
    """What is wrong with the fields of a run that may have been killed: the list is whole, and so is what it lists."""
    lists = [folder / f"{name}.xdmf" for name in ("fields", "fluid", "wall")]
    try:
        media = [entries for file in lists if file.exists() for entries in temporal_lists(file)]
        for grids in media:
            for grid in grids[-1:]:
                for item in grid.iter("DataItem"):
                    file, _, name = item.text.partition(":")
                    with h5py.File(folder / file, "r") as opened:
                        if opened[name][()].shape != tuple(int(n) for n in item.get("Dimensions").split()):
                            return f"{item.text} has another shape"
    except (OSError, KeyError, ElementTree.ParseError) as error:
        return f"{type(error).__name__}: {error}"
    return ""


def temporal_lists(file):
    """The entries of each medium."""
    root = ElementTree.parse(file).getroot()
    return [grid.findall("Grid") for grid in root.iter("Grid") if grid.get("CollectionType") == "Temporal"]


# --- many runs


def one_run(harness, mesh, reference, number, kind, chance):
    """(verdict, what was run)"""
    program = DRIVERS[number % 2]
    folder = harness.base / "tree" / f"{number % 24:02}" / f"{number:04}-{kind}"
    folder.parent.mkdir(parents=True, exist_ok=True)
    what = f"{folder.relative_to(harness.base)} ({program})"
    whole = f"time.end={STEP * STEPS}"
    start = command(harness, program, folder, mesh, whole)
    if kind == "mistake":
        setting, code = MISTAKES[number % len(MISTAKES)]
        ended = execute(*start, "--set", setting)
        if ended.returncode != code or not is_one_message(ended.stderr, program):
            return f"exit {ended.returncode}: {ended.stderr!r}", what
        if folder.exists() and any(folder.iterdir()):
            return "left files behind", what
        return "refused with one message", what
    if kind == "continued":
        ended = execute(*command(harness, program, folder, mesh, f"time.end={STEP * chance.randint(1, STEPS - 1)}"))
        if ended.returncode != 0:
            return f"exit {ended.returncode}: {ended.stderr!r}", what
        further = folder.with_name(folder.name + "-further")
        ended = execute(*command(harness, program, further, mesh, whole), "--restart", folder)
        return judged(ended, further, reference[program], "continued elsewhere with the same results"), what
    if kind == "killed":
        process = subprocess.Popen(start, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None and not (folder / "checkpoint.h5").exists():
            time.sleep(0.002)
        time.sleep(chance.random() * 0.3)
        process.kill()
        process.wait()
        if wrong := unreadable(folder):
            return f"unreadable after the kill: {wrong}", what
        ended = execute(*start, "--restart", folder)
        return judged(ended, folder, reference[program], "killed and continued with the same results"), what
    return judged(execute(*start), folder, reference[program], "done"), what


def judged(ended, folder, reference, verdict):
    if ended.returncode != 0:
        return f"exit {ended.returncode}: {ended.stderr!r}"
    wrong = difference(folder, reference)
    return f"other results: {wrong}" if wrong else verdict


def many_runs(harness, count):
    mesh = tiny_mesh(harness)
    reference = {}
    for program in DRIVERS:
        reference[program] = harness.base / "reference" / program
        reference[program].parent.mkdir(exist_ok=True)
        ended = execute(*command(harness, program, reference[program], mesh, f"time.end={STEP * STEPS}"))
        if ended.returncode != 0:
            raise SystemExit(f"soak: the undisturbed run of {program} fails: {ended.stderr}")
    chance = random.Random(harness.options.seed)
    kinds = ["plain", "plain", "mistake", "continued", "killed"]
    jobs = [(number, kinds[number // 2 % 5], random.Random(chance.random())) for number in range(count)]
    with ThreadPoolExecutor(harness.options.at_once) as pool:
        for verdict, what in pool.map(lambda job: one_run(harness, mesh, reference, *job), jobs):
            harness.count(verdict, what)
    for file in sorted((harness.base / "tree").rglob("*")):
        if file.is_file() and not FILES.fullmatch(file.name):
            harness.count("file left over", file.relative_to(harness.base))


# --- many steps


class Watch:
    """What a process has used when it had done a number of steps."""

    def __init__(self, process, folder):
        self.process, self.folder = process, folder
        self.samples = []  # (step, KiB of memory, descriptors, bytes written, calls of writing)

    def step(self):
        """The last step in iterations.csv."""
        with open(self.folder / "iterations.csv", "rb") as stream:
            stream.seek(0, 2)
            stream.seek(max(0, stream.tell() - 400))
            lines = stream.read().split(b"\n")
        return int(lines[-2].split(b",")[0]) if len(lines) > 2 else 0

    def take(self):
        """Adds a sample; nothing once the process has ended."""
        here = Path("/proc") / str(self.process.pid)
        try:
            step = self.step()
            counts = dict(line.split(": ") for line in (here / "io").read_text().splitlines())
            memory = re.search(r"VmRSS:\s+(\d+)", (here / "status").read_text())
            descriptors = len(list((here / "fd").iterdir()))
        except (OSError, ValueError):
            return
        if memory:
            used = int(memory[1]), descriptors, int(counts["wchar"]), int(counts["syscw"])
            self.samples.append((step, *used))

    def part(self, begin, end):
        """Largest memory, fewest descriptors, bytes and calls per step between two steps."""
        inside = [sample for sample in self.samples if begin <= sample[0] <= end]
        if len(inside) < 2 or inside[-1][0] == inside[0][0]:
            raise SystemExit(f"soak: too few samples between the steps {begin} and {end}")
        first, last = inside[0], inside[-1]
        steps = last[0] - first[0]
        return (
            max(sample[1] for sample in inside),
            min(sample[2] for sample in inside),
            (last[3] - first[3]) / steps,
            (last[4] - first[4]) / steps,
        )


def start_long_run(harness, folder, steps, every, **environment):
    settings = (f"time.step={0.01}", f"time.end={0.01 * steps:.6g}", f"output.every={every}")
    mesh = tiny_mesh(harness)
    words = command(harness, DRIVERS[0], folder, mesh, *settings, f"output.checkpoint_every={steps // 10}")
    return subprocess.Popen(
        words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env={**os.environ, **environment}
    )


def require(harness, verdicts, condition, said):
    """Notes what a long run was judged by."""
    print(f"  {said}", flush=True)
    if not condition:
        verdicts.append(said)


def many_steps(harness, steps, every):
    folder, verdicts, readings, sizes = harness.base / "long", [], 0, []
    process = start_long_run(harness, folder, steps, every)
    watch = Watch(process, folder)
    next_reading = 0.0
    while process.poll() is None:
        watch.take()
        if (folder / "checkpoint.h5").exists():
            sizes.append((folder / "checkpoint.h5").stat().st_size)
        now = time.monotonic()
        if now > next_reading and (folder / "fields.xdmf").exists():
            if wrong := unreadable(folder):
                verdicts.append(f"the list cannot be read while it is written: {wrong}")
            readings += 1
            next_reading = now + 20 * (time.monotonic() - now)  # the reader leaves the run most of the time
        time.sleep(0.02 if steps < 10000 else 0.2)
    _, said = process.communicate()
    require(harness, verdicts, process.returncode == 0, f"{steps} steps, exit code {process.returncode} {said}".strip())
    if process.returncode == 0:
        near, far = watch.part(0.1 * steps, 0.3 * steps), watch.part(0.8 * steps, steps)
        require(harness, verdicts, far[0] <= near[0] + 1024, f"memory {near[0]} KiB, then {far[0]} KiB")
        require(harness, verdicts, far[1] <= near[1], f"open descriptors {near[1]}, then {far[1]}")
        require(harness, verdicts, far[2] <= 1.05 * near[2], f"{near[2]:.0f} bytes written a step, then {far[2]:.0f}")
        require(harness, verdicts, far[3] <= 1.05 * near[3], f"{near[3]:.2f} calls a step, then {far[3]:.2f}")
        require(harness, verdicts, len(set(sizes)) == 1, f"checkpoints of {sorted(set(sizes))} bytes")
        done = summary(folder)["totals"]["steps"]
        entries = [1 + done // every + (1 if done % every else 0)] * 2
        found = [len(grids) for grids in temporal_lists(folder / "fields.xdmf")]
        require(harness, verdicts, found == entries, f"entries listed {found}, read {readings} times while written")
        require(harness, verdicts, written(folder) == entries[0], f"entries in HDF5 files {written(folder)}")
        rows = (folder / "iterations.csv").read_bytes().count(b"\n")
        require(harness, verdicts, rows == done + 1, f"rows of iterations.csv {rows}")
    harness.count("; ".join(verdicts) or "flat", f"{steps} steps")


def written(folder):
    """Entries all of whose fields are marked as written, in all files of a run's fields; -1 when times do not ascend."""
    count, last = 0, -1.0
    for file in sorted(folder.glob("fields*.h5"), key=lambda path: (len(path.name), path.name)):
        with h5py.File(file, "r") as opened:
            flags = [values[()] for values in opened["steps/written"].values()]
            times = opened["steps/time"][()]
            if times[0] <= last or any(times[1:] <= times[:-1]):
                return -1
            last = times[-1]
            count += sum(all(of_entry) for of_entry in zip(*flags))
    return count


def own_memory(process):
    """KiB of a process that are no file's; 0 once it has ended."""
    try:
        found = re.search(r"RssAnon:\s+(\d+)", Path(f"/proc/{process.pid}/status").read_text())
    except OSError:
        return 0
    return int(found[1]) if found else 0


def start_of_many_steps(harness):
    """In its first steps a run that plans a million entries writes and holds what one with a thousand does.

    Pages of 2 MiB are left out, which drivers ask for unless GLIBC_TUNABLES is set: the heap ends at one of them, and where
    it begins is random. After forty steps what a step takes for a while is there, too.
    """
    used = []
    for steps in (1000, 1000000):
        folder = harness.base / f"planned-{steps}"
        process = start_long_run(harness, folder, steps, 1, GLIBC_TUNABLES="glibc.malloc.trim_threshold=268435456")
        watch, memory = Watch(process, folder), 0
        while process.poll() is None and not (watch.samples and watch.samples[-1][0] >= 40):
            watch.take()
            memory = own_memory(process) or memory
            time.sleep(0.002)
        process.kill()
        process.communicate()
        used.append(((folder / "fields.h5").stat().st_size + (folder / "fields.xdmf").stat().st_size, memory))
    few, many = used
    print(f"  1000 planned: {few[0]} bytes of fields at the start, {few[1]} KiB; 1000000: {many[0]}, {many[1]} KiB")
    flat = 0 < many[0] <= 1.01 * few[0] and 0 < few[1] and 0 < many[1] <= few[1] + 512
    harness.count("flat" if flat else "the start grows with the planned steps", "start of a million steps")


def main():
    harness = Harness("soak", __doc__.splitlines()[0], GOOD, options)
    tiny_mesh(harness)
    chosen = harness.options
    # At about step 1,100 memory grows once, by some 1 MiB, and stays to step 8,000 at least: the first look is behind it.
    steps = chosen.steps or (100000 if harness.full else 4000)
    runs = chosen.runs or (200 if harness.full else 10)
    with ThreadPoolExecutor(1) as beside:
        long_run = beside.submit(many_steps, harness, steps, 8 if harness.full else 4)
        many_runs(harness, runs)
        start_of_many_steps(harness)
        long_run.result()
    left = execute("ps", "-eo", "args").stdout
    if str(harness.base) in left.replace(" ".join(sys.argv), ""):
        harness.count("process left over", [line for line in left.splitlines() if str(harness.base) in line])
    harness.finish()


if __name__ == "__main__":
    main()
