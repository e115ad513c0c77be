"""Stand in for both drivers in tests of `fsi-compare study`: answer at once, with a travelling wave.

`behaviour.json` beside the programs says where they depart from it:
  "version"   their version (0.1.0)
  "end"       {WORD: [exit code, message]}: a run whose command line holds WORD ends so
  "nan"       {WORD: FILE}: such a run says done, but the CSV file holds a NaN
  "signal"    {WORD: number}: such a run ends by this signal
  "seconds"   list: what the first, second, ... call says its time steps took, again from the start after the last
  "drifts"    true: each call has results of its own
  "deaf"      true: SIGTERM is not heeded
  "wait"      FILE: each run goes on when it exists
  "meet"      number: each run goes on when so many have begun
  "sleep"     seconds that each run takes; it writes its process number to `pid`
Each run adds its command line to `calls.txt`. Behind the `mpirun` of install_mpirun() it says that it was several
processes, as fast as that many. Single linear systems are left to fake_linear_study.
"""

import json
import os
import signal
import sys
import time
from pathlib import Path

import fake_linear_study

DRIVERS = ("fsi-monolithic", "fsi-partitioned")
LINEAR_STUDY = "fsi-linear-study"


def install(folder):
    """Makes both programs and fsi-linear-study; returns their folder."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for name in (*DRIVERS, LINEAR_STUDY):
        fake_linear_study.install(folder, name, "fake_drivers")
    return folder


def install_mpirun(folder):
    """A program of this name that starts the command behind its options once; returns its folder, for the path."""
    folder.mkdir(parents=True, exist_ok=True)
    fake_linear_study.make_executable(
        folder / "mpirun",
        f"#!{sys.executable} -EB\nimport os, sys\n"
        "words = sys.argv\n"
        "first = next(i for i, word in enumerate(words) if 'fsi-' in word)\n"
        "os.environ['FAKE_PROCESSES'] = words[words.index('-n') + 1]\n"
        "os.execv(words[first], words[first:])\n",
    )
    return folder


def behave(folder, **behaviour):
    (folder / "behaviour.json").write_text(json.dumps(behaviour))


def build_anew(folder, *names):
    """Other executables that do and say the same."""
    for name in names:
        with open(folder / name, "a") as program:
            program.write("# built anew\n")


def calls(folder):
    file = folder / "calls.txt"
    return file.read_text().splitlines() if file.exists() else []


def main(words):
    program = Path(words[0])
    home = program.parent
    file = home / "behaviour.json"
    behaviour = json.loads(file.read_text()) if file.exists() else {}
    if words[1] == "--version":
        print(f"{program.name} {behaviour.get('version', '0.1.0')}")
        return 0
    if program.name == LINEAR_STUDY:
        return fake_linear_study.main(words)
    line = " ".join(words)
    with open(home / "calls.txt", "a") as log:
        log.write(line + "\n")

    def named(key):
        return next((value for word, value in behaviour.get(key, {}).items() if word in line), None)

    folder = Path(words[words.index("-o") + 1])
    folder.mkdir(parents=True, exist_ok=True)
    if behaviour.get("deaf"):
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
    while "wait" in behaviour and not Path(behaviour["wait"]).exists():
        time.sleep(0.02)
    while len(calls(home)) < behaviour.get("meet", 0):
        time.sleep(0.02)
    if "sleep" in behaviour:
        with open(home / "pid", "a") as log:
            log.write(f"{os.getpid()}\n")
        (folder / "centerline_pressure.csv").write_text("time_ms,z_mm,pre")  # what a killed run leaves behind
        time.sleep(behaviour["sleep"])
    if named("signal"):
        os.kill(os.getpid(), named("signal"))
    if named("end"):
        code, message = named("end")
        print(f"{program.name}: error: {message}", file=sys.stderr)
        return code
    call = len(calls(home)) - 1
    seconds = behaviour.get("seconds", [1.0])
    processes = int(os.environ.get("FAKE_PROCESSES", "1"))
    write_results(folder, program.name, wall_s=seconds[call % len(seconds)] / processes, processes=processes)
    if behaviour.get("drifts"):
        with open(folder / "centerline_pressure.csv", "a") as file:
            file.write(f"99,0,{call}\n")
    if named("nan"):
        path = folder / named("nan")
        text = path.read_text()
        path.write_text(text + "nan," * text.splitlines()[0].count(",") + "1\n")
    return 0


def per_process(processes, nodes=1032):
    """Of a tube cut across: the halo of an inner part is two layers of 57 nodes."""

    def spread(mean):
        return {"minimum": 0.9 * mean, "mean": mean, "maximum": 1.1 * mean}

    neighbours = 2.0 - 2.0 / processes
    return {
        "owned_nodes": spread(nodes / processes),
        "halo_nodes": spread(57.0 * neighbours),
        "neighbours": spread(neighbours),
        "messages_per_step": spread(30.0 * neighbours),
        "bytes_per_step": spread(30.0 * 57.0 * neighbours * 32),
        "reductions_per_step": 40.0,
        "peak_memory_MiB": spread(20.0 + 50.0 / processes),
        "reading_memory_MiB": spread(30.0),
    }


def write_results(folder, program, steps=96, step=0.125, wall_s=1.0, processes=1):
    """A small crest that travels at 0.7 mm/ms."""
    partitioned = program == "fsi-partitioned"
    passes = 5 if partitioned else 1
    rows = ["time_ms,z_mm,pressure_Pa"]
    for n in range(1, steps + 1):
        t = n * step
        rows += [f"{t!r},{0.2 * i!r},{max(0.0, 50 * (1 - ((0.2 * i - 1 - 0.7 * t) / 2) ** 2))!r}" for i in range(91)]
    (folder / "centerline_pressure.csv").write_text("\n".join(rows) + "\n")
    (folder / "iterations.csv").write_text(
        "step,time_ms,outer_iterations,newton_iterations,linear_iterations,wall_s\n"
        + "".join(f"{n},{n * step!r},{passes},{3 * passes},{9 * passes},0.01\n" for n in range(1, steps + 1))
    )
    systems = ("fluid", "wall") if partitioned else ("coupled",)
    phases = {
        f"{kind}: {system}": {"calls": 3 * steps, "seconds": 0.1}
        for kind in ("assembly", "set-up", "solve")
        for system in systems
    }
    (folder / "summary.json").write_text(
        json.dumps(
            {
                "program": program,
                "version": "0.1.0",
                "title": "A tube",
                "status": "done",
                "threads": 1,
                "processes": processes,
                **({"per_process": per_process(processes)} if processes > 1 else {}),
                "peak_memory_MiB": 70.0,
                "unknowns": {"coupled": 4662},
                "mesh": {"name": "level coarse", "nodes": 1032, "tetrahedra": 4968},
                "phases": phases,
                "totals": {
                    "steps": steps,
                    "outer_iterations": passes * steps,
                    "newton_iterations": 3 * passes * steps,
                    "linear_iterations": 9 * passes * steps,
                    "wall_s": wall_s,
                },
            }
        )
    )
