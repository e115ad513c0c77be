"""Measures both drivers side by side for docs/data/drivers.csv: processor seconds, memory and error of every scene of the
gallery that both run, and of the paper's cases.

usage: python3 scripts/measure_drivers.py BIN WORK [--loose] [NAME...]
  BIN    the folder of the programs, build/release/bin
  WORK   keeps meshes and runs
  NAME   scenes and cases to measure; all but the long scenes unless given. Rows of others stay as they are.
  --loose  of scenes with two media the passes of the partitioned driver with a tolerance of 1e-4 in place of the case's

The drivers take turns, one program at a time with one thread. Of runs below 10 s the least of three counts: other work on
the machine can only add to it. Five processor minutes in all; the scenes cfd3, fsi2 and fsi3 take hours.
"""

import datetime
import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any, Dict, Iterable, List, NamedTuple, NoReturn, Optional, Sequence, Tuple

from kept_tables import DATA, TOP, Row, read_table, write_table

sys.path.insert(0, str(TOP / "compare"))

from fsi_compare.base.errors import InputError  # noqa: E402
from fsi_compare.studies.catalogue.names import MATERIALS  # noqa: E402
from fsi_compare.studies.gallery.mesh_chain import make_mesh, with_places  # noqa: E402
from fsi_compare.studies.gallery.scene import (
    BOTH,
    Scene,
    SceneRun,
    SceneRuns,
    find_scenes,
    read_scene_run,
)  # noqa: E402

TABLE = DATA / "drivers.csv"
COLUMNS = (
    "case",
    "title",
    "driver",
    "scheme",
    "unknowns",
    "steps",
    "newton_iterations",
    "passes",
    "processor_s",
    "runs",
    "memory_MiB",
    "error_percent",
    "of",
    "known_from",
    "made",
)
ORIGIN = """made by scripts/measure_drivers.py build/release/bin WORK: both drivers by turns, one thread, one program at a time
fsi-DRIVER gallery/NAME/NAME.toml (or meshes/artery/...) --set mesh.file=MESH -q --threads 1 -o DIR; MESH as in docs/gallery.md
processor_s: user and system time of the whole program, the least of `runs`; memory_MiB: peak of the process (summary.json)
newton_iterations: of the coupled system, or of fluid and wall together; passes: of the partitioned driver, over all steps
"partitioned 0.0001": --loose, with partitioned.tolerance = 1e-4 in place of the case's (1e-6 unless the case says otherwise); without seconds, since not measured by turns with the others
error_percent: the largest beside what is known; of the paper's cases the larger one of displacement and averaged pressure,
relative L2 norms against compare/studies/references, mean of 1.5, 3, 4.5 and 6 ms
made: the date, or the kept page that a row was taken from, with seconds of the wall's clock"""
QUICK_ENOUGH = 10.0  # s
TIMINGS = 3
LOOSE = (
    1e-4  # as little as newton_tolerance = 1e-3, the monolithic driver's default, shows in an error (docs/evidence.md)
)
PAPER = {"coarse": "meshes/artery/{}.toml", "axisymmetric": "meshes/artery/axisymmetric/{}.toml"}
MESHES = {"coarse": ["--level", "coarse"], "axisymmetric": ["--axisymmetric", "--for", "p2p1", "--error", "2%"]}


class Case(NamedTuple):
    name: str
    title: str
    file: Path
    mesh: List[str]  # the words of fsi-mesh
    scene: Optional[Scene] = None
    material: str = ""


def cases(wanted: Sequence[str]) -> List[Case]:
    """In the order of the table. Raises InputError."""
    scenes = [s for s in find_scenes([]) if s.drivers == BOTH]
    found = [Case(s.name, s.title, s.case, _words(s), s) for s in scenes if s.name in wanted or not (wanted or s.long)]
    for kind, pattern in PAPER.items():
        for material in MATERIALS:
            name = f"{material}-{kind}"
            if name in wanted or not wanted:
                title = f"Paper's artery ({kind}, {material})"
                found.append(
                    Case(name, title, TOP / pattern.format(material), ["artery", *MESHES[kind]], None, material)
                )
    unknown = set(wanted) - {case.name for case in found}
    if unknown:
        raise InputError("", "NAME", f"'{min(unknown)}' is not run by both drivers", "see fsi-compare gallery --list")
    return found


def _words(scene: Scene) -> List[str]:
    return with_places(scene.mesh_words(False), scene.folder)


# ---- runs ----


def measured(case: Case, programs: Path, work: Path) -> List[Row]:
    """A row for each driver."""
    folder = work / case.name
    folder.mkdir(parents=True, exist_ok=True)
    mesh = folder / "mesh.msh"
    if not mesh.exists():
        end = make_mesh(case.mesh, mesh, programs / "fsi-mesh", case.name)
        if end.code:
            fail(f"{case.name}: {end.message}")
    seconds: Dict[str, List[float]] = {program: [] for program in BOTH}
    for _ in range(TIMINGS):
        for program, found in seconds.items():
            if not found or found[0] < QUICK_ENOUGH:
                settings = ["--set", f"mesh.file={mesh}", "-q", "--threads", "1", "--force"]
                found.append(_call([programs / program, case.file, *settings, "-o", folder / program]))
    runs = {program: read_scene_run(folder / program, program, min(found)) for program, found in seconds.items()}
    errors = _errors_of_scene(case.scene, runs) if case.scene else _errors_of_wave(case, programs, runs)
    return [_row(case, run, len(seconds[program]), errors[program]) for program, run in runs.items()]


def measured_loose(case: Case, programs: Path, work: Path) -> List[Row]:
    """The row of the partitioned driver, its tolerance that of LOOSE. The mesh and the monolithic run are there."""
    folder = work / case.name
    words = [
        programs / "fsi-partitioned",
        case.file,
        "--set",
        f"mesh.file={folder / 'mesh.msh'}",
        "-q",
        "--threads",
        "1",
    ]
    words += ["--set", f"partitioned.tolerance={LOOSE:g}", "--force", "-o", folder / "loose"]
    seconds = _call(words)
    runs = {
        "fsi-monolithic": read_scene_run(folder / "fsi-monolithic", "fsi-monolithic", 0.0),
        "fsi-partitioned": read_scene_run(folder / "loose", "fsi-partitioned", seconds),
    }
    assert case.scene is not None
    errors = _errors_of_scene(case.scene, runs)
    row = _row(case, runs["fsi-partitioned"], 1, errors["fsi-partitioned"])
    return [{**row, "driver": f"partitioned {LOOSE:g}", "processor_s": ""}]


def _row(case: Case, run: SceneRun, timings: int, error: Tuple[str, str, str]) -> Row:
    summary = json.loads((run.folder / "summary.json").read_text(encoding="utf-8"))
    totals: Dict[str, Any] = summary["totals"]
    partitioned = run.program == "fsi-partitioned"
    values = (
        case.name,
        case.title,
        run.program.removeprefix("fsi-"),
        _coupling_scheme(case, summary) if partitioned else "",
        summary["unknowns"]["coupled"],
        totals["steps"],
        totals["newton_iterations"],
        totals["outer_iterations"] if partitioned else "",
        f"{run.seconds:.3g}",
        timings,
        f"{summary['peak_memory_MiB']:.0f}",
        *error,
        datetime.date.today().isoformat(),
    )
    return dict(zip(COLUMNS, map(str, values)))


def _case_file(case: Case) -> Dict[str, Any]:
    return tomllib.loads(case.file.read_text(encoding="utf-8"))


def _coupling_scheme(case: Case, summary: Dict[str, Any]) -> str:
    """What the case names, else what the program chose; nothing where there is one medium."""
    named = _case_file(case).get("partitioned", {}).get("scheme", "")
    return str(summary.get("choices", {}).get("partitioned.scheme", {}).get("value", named))


def _errors_of_scene(scene: Scene, runs: Dict[str, SceneRun]) -> Dict[str, Tuple[str, str, str]]:
    """Of each driver's numbers the one that is furthest off."""
    numbers = scene.numbers(SceneRuns(runs, False))
    errors = {}
    for program in runs:
        own = [number for number in numbers if number.program == program]
        worst = max(own, key=lambda number: number.error, default=None)
        errors[program] = (f"{100 * worst.error:.2g}", worst.what, worst.source) if worst else ("", "", "")
    return errors


def _errors_of_wave(case: Case, programs: Path, runs: Dict[str, SceneRun]) -> Dict[str, Tuple[str, str, str]]:
    errors = {}
    for program, run in runs.items():
        place = run.folder.parent / f"errors-{program}"
        reference = TOP / "compare/studies/references" / case.material
        _call([programs / "fsi-compare", "accuracy", reference, run.folder, "-o", place, "-q"])
        rows = _plain(place / "accuracy.csv")
        names = {"radial_relative_L2": "displacement", "averaged_pressure_relative_L2": "averaged pressure"}
        means = {what: sum(float(row[name]) for row in rows) / len(rows) for name, what in names.items()}
        worst = max(means, key=means.__getitem__)
        errors[program] = (f"{100 * means[worst]:.2g}", worst, "reference, step and mesh to zero")
    return errors


def _plain(path: Path) -> List[Row]:
    lines = [line.split(",") for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return [dict(zip(lines[0], line)) for line in lines[1:]]


def _call(words: Iterable[object]) -> float:
    """Its processor seconds. A shell of its own starts it: a program counts the memory of the process that it is made from."""
    command = [str(word) for word in words]
    if not Path(command[0]).exists():
        fail(f"{command[0]}: there is no such program; name the folder of the programs, build/release/bin")
    try:
        process = subprocess.Popen(["sh", "-c", '"$@"; exit $?', "sh", *command])
    except OSError as error:
        fail(f"sh: {error.strerror}")
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        fail(f"{' '.join(command)}: exit code {process.returncode}; see its message above")
    return usage.ru_utime + usage.ru_stime


# ---- the table ----


def keep(rows: Sequence[Row]) -> None:
    """In the place of the rows of the same case and driver, or behind the others."""
    kept = {(row["case"], row["driver"]): row for row in (read_table(TABLE) if TABLE.exists() else [])}
    kept.update({(row["case"], row["driver"]): row for row in rows})
    write_table(TABLE, ORIGIN, COLUMNS, [[row[name] for name in COLUMNS] for row in kept.values()])


def main(words: List[str]) -> int:
    if len(words) < 2 or words[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 1
    programs, work = (Path(word).resolve() for word in words[:2])
    loose = "--loose" in words
    try:
        for case in cases([word for word in words[2:] if word != "--loose"]):
            if loose and not (case.scene and {"fluid", "structure"} <= set(_case_file(case))):
                continue
            rows = (measured_loose if loose else measured)(case, programs, work)
            keep(rows)
            print(case.name, " ".join(f"{row['driver']} {row['processor_s'] or '-'} s" for row in rows), flush=True)
    except (InputError, OSError, ValueError, KeyError) as error:
        fail(str(error))
    return 0


def fail(text: str) -> NoReturn:
    line = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)
    print(f"measure_drivers: error: {line[:1000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
