"""What disturbs fsi-compare from without: environment, streams, disk, signals, kills, and other calls at the same time.
The program is started as a user starts it, with drivers that answer at once (tests/integration/compare)."""

import json
import os
import random
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

from harness import execute, is_one_message

import mutations
from stand import PLAIN, fake_drivers, write_run

PARTS = ("environments", "streams", "disks", "signals", "locks", "kills")
REFUSED, UNHARMED, INTERRUPTED, ENDED = "refused with one message", "unharmed", "interrupted with one message", "ended"
MARK = "FSI_FAULTS_MARK"  # in the environment: finds processes that are left
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class Place:
    """A folder with two runs, a study, and stand-ins for the drivers; `out` is where fsi-compare is told to write."""

    def __init__(self, harness, name):
        self.base = harness.base / name
        self.base.mkdir()
        self.program = harness.program("fsi-compare")
        self.out = self.base / "out"
        self.temporary = self.base / "tmp"
        self.temporary.mkdir()
        self.one, self.two = (
            write_run(self.base / run, program) for run, program in zip(("one", "two"), fake_drivers.DRIVERS)
        )
        self.drivers = fake_drivers.install(self.base / "bin")
        for case in ("tube", "pipe"):
            (self.base / f"{case}.toml").write_text('title = "A tube"\n')
        self.study = self.base / "study.toml"
        tree = {**PLAIN, "repeats": 1, "meshes": {}, "runs": {"all": {**PLAIN["runs"]["all"], "vary": {}}}}
        self.study.write_text(mutations.toml_text(tree))
        times = ("--times", "0.5,1.5", "-o", self.out)
        self.commands = {
            "version": ("--version",),
            "help": ("study", "--help"),
            "pressure": ("pressure", self.one, self.two, *times),
            "cost": ("cost", self.one, self.two, "-o", self.out),
            "accuracy": ("accuracy", self.one, self.two, *times),
            "study": self.study_words("-q"),
        }

    def study_words(self, *more):
        names = (("--monolithic", "fsi-monolithic"), ("--partitioned", "fsi-partitioned"))
        options = [word for option, name in names for word in (option, self.drivers / name)]
        return ("study", self.study, "-o", self.out, *options, *more)

    def environment(self, **changes):
        """Changed variables; None: without it."""
        changed = {**os.environ, "TMPDIR": str(self.temporary), MARK: str(self.base), **changes}
        return {name: value for name, value in changed.items() if value is not None}

    def call(self, command, **options):
        words = self.commands[command] if isinstance(command, str) else command
        options.setdefault("env", self.environment())
        try:
            return execute(self.program, *words, timeout=120, **options)
        except subprocess.TimeoutExpired:
            return None

    def start(self, words, **options):
        words = [self.program, *map(str, words)]
        options.setdefault("env", self.environment())
        return subprocess.Popen(words, text=True, **options)

    def processes(self, seconds=5.0):
        """Those that still run `seconds` after a call, its drivers among them."""
        mark = f"{MARK}={self.base}".encode()
        latest = time.monotonic() + seconds
        while True:
            found = [pid for pid in os.listdir("/proc") if pid.isdigit() and mark in _environment(pid)]
            if not found or time.monotonic() > latest:
                return found
            time.sleep(0.05)

    def leftovers(self):
        """Temporary files, locks, empty folders made for nothing."""
        found = [str(path) for path in self.temporary.iterdir()]
        if self.out.is_dir():
            names = [path for path in self.out.rglob("*") if path.name.startswith(".") or path.name == "run.lock"]
            found += [str(path.relative_to(self.out)) for path in names]
            found += ["the empty folder"] if not any(self.out.iterdir()) else []
        return found[:3]

    def clear(self):
        mutations.remove(self.out)
        shutil.rmtree(self.temporary, ignore_errors=True)
        self.temporary.mkdir()
        for name in ("calls.txt", "behaviour.json"):
            (self.drivers / name).unlink(missing_ok=True)


def _environment(pid):
    try:
        if Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z":
            return b""
        return Path(f"/proc/{pid}/environ").read_bytes()
    except OSError:
        return b""


def judge(harness, place, what, done, codes=(0,), said=True):
    """`codes`: with which it may end when it is not refused; `said`: whether a refusal's message can be seen."""
    problem = ""
    if done is None:
        problem = "did not end"
    elif "Traceback" in done.stderr or "unexpected" in done.stderr or "Exception ignored" in done.stderr:
        problem = "traceback or unexpected exception"
    elif place.processes():
        problem = f"processes left: {place.processes(0)}"
    elif place.leftovers():
        problem = f"left {place.leftovers()}"
    elif done.returncode in codes:
        harness.count(UNHARMED, what)
    elif done.returncode == 1 and (is_one_message(done.stderr, "fsi-compare") or not said):
        harness.count(REFUSED, what)
    else:
        problem = f"exit code {done.returncode}"
    if problem:
        harness.count(problem, f"{what}: {done.stderr.strip()[-300:] if done else ''}")
    place.clear()


def environments(harness):
    place = Place(harness, "environments")
    file = place.base / "a file"
    file.write_text("nonsense: [\n")
    locked = place.base / "locked"
    locked.mkdir(mode=0o500)
    unwritable = "/proc/nothing"  # for root too
    changes = [
        {"MPLBACKEND": "nonsense"},
        {"MPLCONFIGDIR": unwritable},
        {"MPLCONFIGDIR": str(file)},
        {"MPLCONFIGDIR": str(locked)},
        {"MPLCONFIGDIR": "relative", "HOME": None},
        {"MATPLOTLIBRC": str(file)},
        {"MPLCONFIGDIR": unwritable, "TMPDIR": unwritable, "HOME": unwritable},
        {"HOME": None},
        {"HOME": unwritable, "XDG_CACHE_HOME": unwritable, "XDG_CONFIG_HOME": unwritable},
        {"PYTHONPATH": str(place.base), "PYTHONHOME": "/nothing", "PYTHONSTARTUP": str(file), "PYTHONIOENCODING": "x"},
        {"LANG": "C", "LC_ALL": "C"},
        {"LC_ALL": "POSIX", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
        {"LC_ALL": "de_DE.ISO-8859-1"},
        {"COLUMNS": "0", "LINES": "-1"},
        {"COLUMNS": "1", "TERM": "nonsense"},
        {"COLUMNS": "x"},
        {"TMPDIR": unwritable, "TMP": unwritable, "TEMP": unwritable},
        {"TMPDIR": str(file)},
        {"OMP_NUM_THREADS": "x", "OPENBLAS_NUM_THREADS": "-1"},
        {"PATH": ""},
        {"PATH": None, "USER": None, "LOGNAME": None},
        {"TZ": "nonsense/nowhere"},
        {"HDF5_USE_FILE_LOCKING": "x", "HDF5_PLUGIN_PATH": unwritable},
        {"a": "b" * 100_000},
    ]
    numpy = place.base / "numpy.py"
    numpy.write_text("raise SystemError\n")
    commands = [name for name in place.commands if harness.full or name in ("pressure", "study")]
    for change in changes if harness.full else changes[:7:3]:
        for command in commands if harness.full else ("pressure",):
            judge(
                harness,
                place,
                f"{command} with {change!s:.80}",
                place.call(command, cwd=place.base, env=place.environment(**change)),
            )
    (place.base / "matplotlibrc").write_bytes(b"backend: nonsense\n\xff\xfe: [\n")
    judge(harness, place, "settings in the working folder", place.call("pressure", cwd=place.base))
    gone = place.base / "gone"
    gone.mkdir()
    script = 'cd "$1" && rmdir "$1" && shift && exec "$@"'
    words = [str(word) for word in place.commands["pressure"]]
    done = execute("sh", "-c", script, "sh", gone, place.program, *words, env=place.environment())
    done.stderr = "".join(line for line in done.stderr.splitlines(True) if "getcwd() failed" not in line)  # the shell's
    judge(harness, place, "a working folder that is gone", done)
    names = ("x" * 5000, "a\nb", "\x1b[1mred", b"\xff\xfe".decode("utf-8", "surrogateescape"), "-", " ", "a" * 256)
    for name in names if harness.full else names[:2]:
        for words in (
            ("pressure", place.one, "--times", "1", "-q", "-o", place.base / "named" / name),
            ("cost", place.base / name, "-o", place.out),
            ("cost", place.one, "--labels", f"{name}", "-o", place.out),
            ("pressure", place.one, "--times", "1", "--title", f"{name}", "--labels", f"{name}", "-o", place.out),
            ("study", name),
            (name,),
        )[:: 1 if harness.full else 3]:
            judge(harness, place, f"{words[0][:20]} with the name {ascii(name):.20}", place.call(words))
            shutil.rmtree(place.base / "named", ignore_errors=True)


def streams(harness):
    place = Place(harness, "streams")
    ends = {
        "input closed": "<&-",
        "output closed": ">&-",
        "errors closed": "2>&-",
        "all closed": "<&- >&- 2>&-",
        "output full": ">/dev/full",
        "errors full": "2>/dev/full",
        "both full": ">/dev/full 2>&1",
        "output read by nobody": "| true",
        "errors read by nobody": "2>&1 >/dev/null | true",
        "one line read": "| head -n 1",
    }
    for name, redirection in ends.items():
        for command in place.commands if harness.full else ("cost",):
            words = [str(word) for word in place.commands[command]]
            script = f'set -o pipefail; "$@" {redirection}'
            done = execute("bash", "-c", script, "bash", place.program, *words, env=place.environment())
            seen = "errors" not in name and "both" not in name and "all" not in name
            judge(harness, place, f"{command}, {name}", done, said=seen)
    # A command that fails must say so even where its output is closed.
    for redirection in (">&-", ">/dev/full", "<&-")[: 3 if harness.full else 1]:
        words = ("cost", str(place.base / "nothing"))
        done = execute("bash", "-c", f'"$@" {redirection}', "bash", place.program, *words, env=place.environment())
        judge(harness, place, f"a refusal, {redirection}", done, codes=())


def disks(harness):
    place = Place(harness, "disks")
    (place.base / "file").write_text("x")
    (place.base / "loop").symlink_to("loop")
    outputs = ("/dev/null", "/dev/full", "/proc/x", "/proc/self/x", place.base / "file", place.base / "file/x", "/sys")
    outputs += (place.base / "loop", "", "a" * 300, place.base / ("b/" * 2500))
    for output in outputs if harness.full else outputs[::3]:
        for command in ("pressure", "cost", "accuracy", "study") if harness.full else ("cost",):
            words = list(place.commands[command])
            words[words.index("-o") + 1] = output
            done = place.call(words, cwd=place.base)
            for made in (place.base / "cost.csv", place.base / "cost.md"):
                made.unlink(missing_ok=True)
            judge(harness, place, f"{command} -o {str(output)[:40]}", done, codes=())
    sizes = (0, 1, 100, 1000, 4000, 10_000, 30_000, 100_000, 300_000) if harness.full else (4000,)
    for size in sizes:
        for command in ("pressure", "cost", "accuracy", "study") if harness.full else ("pressure",):
            script = f'ulimit -f {size // 1000 if size >= 1000 else 0}; exec "$@"'
            if size < 1000 and size > 0:
                script = f'exec prlimit --fsize={size} "$@"'
            words = [str(word) for word in place.commands[command]]
            done = execute("bash", "-c", script, "bash", place.program, *words, env=place.environment())
            judge(harness, place, f"{command}, files of at most {size} bytes", done)
    # What was there stays whole when the second call fails.
    place.call("pressure")
    before = {path.name: path.read_bytes() for path in place.out.iterdir()}
    words = [str(word) for word in place.commands["pressure"]]
    words[words.index("0.5,1.5")] = "1,2"
    done = execute("prlimit", "--fsize=20000", place.program, *words, env=place.environment())
    after = {path.name: path.read_bytes() for path in place.out.iterdir()}
    if done.returncode == 1 and before != after:
        harness.count("half written", f"files of two calls: {sorted(after)}")
    judge(harness, place, "files of an earlier call", done, codes=())


def signals(harness):
    place = Place(harness, "signals")
    chance = random.Random(harness.options.seed)
    for attempt in range(150 if harness.full else 4):
        command = ("pressure", "study", "cost", "accuracy")[attempt % 4]
        number = SIGNALS[attempt % 3]
        if command == "study":
            fake_drivers.behave(place.drivers, sleep=0.3)
        process = place.start(place.commands[command], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(chance.choice((0.0, 0.02, 0.1)) + chance.uniform(0, 0.15 if attempt % 2 else 2.5))
        process.send_signal(number)
        twice = attempt % 5 == 4
        if twice:
            time.sleep(chance.uniform(0, 0.1))
            process.send_signal(number)
        _judge_interrupted(harness, place, process, number, f"{command}, {number.name}{' twice' * twice}", twice)
    # A driver that does not heed the signal is killed with the second one.
    fake_drivers.behave(place.drivers, sleep=60, deaf=True)
    process = place.start(place.study_words("--jobs", "2"), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    _wait_for(lambda: (place.drivers / "pid").exists())
    for _ in range(2):
        process.send_signal(signal.SIGTERM)
        time.sleep(0.02)
    _judge_interrupted(harness, place, process, signal.SIGTERM, "two drivers at work", True)


def _judge_interrupted(harness, place, process, number, what, twice):
    try:
        out, err = process.communicate(timeout=60)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        harness.count("did not end", what)
        return place.clear()
    code = process.returncode
    lines = [line for line in err.splitlines() if not line.startswith("[")]  # of a study's progress
    ends = f"fsi-compare: interrupted by {number.name}"
    left = place.processes()
    if left:
        harness.count("processes left", f"{what}: {left}")
    elif code == 128 + number and (twice or len(lines) == 1 and lines[0].startswith(ends)):
        bad = [] if twice else place.leftovers()
        harness.count(INTERRUPTED if not bad else "left files", f"{what}: {bad}")
    elif code == -number and not err:
        harness.count(ENDED, what)  # before the first line of the program: the shell that starts it
    elif code == 0 and not lines:
        harness.count(UNHARMED, what)  # it was done by then
    else:
        harness.count(f"exit code {code}", f"{what}: {err.strip()[-300:]}")
    place.clear()


def locks(harness):
    place = Place(harness, "locks")
    fake_drivers.behave(place.drivers, wait=str(place.base / "go on"))
    first = place.start(place.study_words("-q"), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    _wait_for(lambda: fake_drivers.calls(place.drivers))
    second = place.call(place.study_words("-q", "--fresh"))
    ok = second.returncode == 1 and is_one_message(second.stderr, "fsi-compare") and str(first.pid) in second.stderr
    harness.count(REFUSED if ok else "two studies in one folder", f"a second study: {second.stderr}")
    (place.base / "go on").write_text("")
    _, err = first.communicate(timeout=60)
    harness.count(UNHARMED if (first.returncode, err) == (0, "") else "disturbed", f"the first study: {err}")
    judge(harness, place, "the same again", place.call("study"))
    host = os.uname().nodename
    left = (
        ("of a process that has ended", f"x, process 4194000 on host {host}\n", (0,)),
        ("of a process number given anew", f"x, process {os.getpid()} on host {host}\n", (0,)),
        ("of another host", "x, process 1 on host elsewhere\n", ()),
        ("that is empty", "", (0,)),
        ("that is nonsense", "\0\xff x y\n\n", ()),
    )
    for what, text, codes in left if harness.full else left[::2]:
        place.out.mkdir()
        (place.out / "run.lock").write_text(text)
        done = place.call(place.study_words("-q"))
        if not codes:
            (place.out / "run.lock").unlink()
            place.out.rmdir()
        judge(harness, place, f"a lock {what}", done, codes)
    for name in ("run.lock", ".summary.json-x.tmp"):  # beside finished results
        (place.one / name).write_text("x, process 1 on host elsewhere\n")
    for command in ("pressure", "cost", "accuracy") if harness.full else ("cost",):
        judge(harness, place, f"{command} of a run with a lock", place.call(command))


def kills(harness):
    """A study that is killed and started again 20 times makes the report of one that was left alone."""
    place = Place(harness, "kills")
    tree = {**PLAIN, "repeats": 1, "meshes": {}, "jobs": 2}
    runs = {**PLAIN["runs"]["all"], "vary": {"time.step": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]}}
    place.study.write_text(mutations.toml_text({**tree, "runs": {"all": runs}}))
    times = 20 if harness.full else 3
    done = place.call("study")
    expected = report_of(place.out)
    place.clear()
    chance = random.Random(harness.options.seed)
    fake_drivers.behave(place.drivers, sleep=0.4)
    for attempt in range(times):
        number = (signal.SIGKILL, signal.SIGTERM)[attempt % 2]
        process = place.start(place.study_words("-q"), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        _wait_for(lambda: (place.out / "run.lock").exists(), 20)
        time.sleep(chance.uniform(0, 1.5))
        process.send_signal(number)
        process.communicate(timeout=60)
        left = place.processes()
        harness.count(ENDED if not left else "processes left", f"{number.name} {attempt + 1}: {left}")
    fake_drivers.behave(place.drivers)
    done = place.call(place.study_words("-q"))
    notes = [line for line in done.stderr.splitlines() if not line.startswith("fsi-compare: note: ")]
    same = done.returncode == 0 and not notes and report_of(place.out) == expected and not place.leftovers()
    harness.count(UNHARMED if same else "another report", f"after {times} kills: {done.stderr} {place.leftovers()}")
    before = fake_drivers.calls(place.drivers)
    done = place.call(place.study_words("-q"))
    harness.count(UNHARMED if fake_drivers.calls(place.drivers) == before else "made again", done.stderr)


def report_of(out):
    """Names of what is in the folder, and the texts of the report without seconds and dates."""
    if not out.is_dir():
        return None
    text = (out / "report.md").read_text() if (out / "report.md").is_file() else ""
    text = re.sub(r"\d+(\.\d+)? (s|min)\b|\d{4}-\d\d-\d\d|^\|.*$", "", text, flags=re.MULTILINE)
    rows = []
    for file in sorted(out.glob("*.csv")):
        lines = [line.split(",") for line in file.read_text().splitlines()]
        kept = [i for i, name in enumerate(lines[0]) if not name.endswith(("_s", "seconds", "command"))]
        rows.append((file.name, [[line[i] for i in kept] for line in lines]))
    names = sorted(str(path.relative_to(out)) for path in out.rglob("*"))
    records = [json.loads(path.read_text())["status"] for path in sorted(out.glob("runs/*/study_run.json"))]
    return names, text, rows, records


def _wait_for(happens, seconds=30):
    latest = time.monotonic() + seconds
    while not happens() and time.monotonic() < latest:
        time.sleep(0.01)
