"""Measures what each kind of coupling costs (docs/which.md): the monolithic driver, `block-newton` and interface iterations by
turns on scenes of several kinds, each beside what its solver left.

usage: python3 scripts/coupling_kinds.py BIN WORK [--turns N] [--scenes NAME,...]
  BIN    folder of the programs, build/release/bin
  WORK   keeps meshes and runs
  --turns   runs of each, by turns; medians count (3)
  --scenes  only these; the table then has no others
Writes docs/data/coupling-kinds.csv. One thread each; half an hour on an idle machine.
"""

import argparse
import csv
import json
import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy as np

TOP = Path(__file__).resolve().parents[1]
TABLE = TOP / "docs/data/coupling-kinds.csv"
ARTERY = TOP / "meshes/artery/axisymmetric"
MATERIALS = ("neo-hookean", "mooney-rivlin", "artery")
PULSE = ("partitioned.tolerance=3e-3", "time.step=0.03125", 'time.scheme="midpoint"', "output.fields=[]")
# What solving leaves where nothing but the solver's tolerance differs.
TIGHT = ("monolithic.newton_tolerance=1e-10",)
METHODS: Tuple[Tuple[str, str, str, Tuple[str, ...]], ...] = (
    ("monolithic", "monolithic", "monolithic", ()),
    ("block", "block-newton", "partitioned", ('partitioned.scheme="block-newton"',)),
    ("interface", "robin-neumann-inexact", "partitioned", ('partitioned.scheme="robin-neumann-inexact"',)),
    ("interface", "iqn-imvj", "partitioned", ('partitioned.scheme="iqn-imvj"', "partitioned.tolerance=1e-4")),
)
ORIGIN = """# made by scripts/coupling_kinds.py BIN WORK, programs of version {version}, {processor}, one thread
# seconds: processor seconds of the whole program, median of {turns} by turns; error: the largest relative Euclidean norm, over tables
# and times, of what a run differs by from the monolithic driver with newton_tolerance = 1e-10
"""
FIELDS = ("centerline_pressure.csv", "wall_displacement.csv", "openings.csv", "points.csv")


class Scene(NamedTuple):
    name: str
    title: str
    case: Path
    mesh: Optional[Tuple[str, ...]]  # arguments of fsi-mesh artery; empty: the gallery's
    settings: Tuple[str, ...]


def artery(material: str) -> Scene:
    cells = ("--axisymmetric", "--for", "p2p1", "--error", "3%", "--waves", "resolved")
    settings = (*PULSE, "time.end=3", "monolithic.newton_tolerance=1e-3", "monolithic.error_tolerance=3e-3")
    return Scene(
        f"axisymmetric-{material}", f"Artery, axisymmetric, {material}", ARTERY / f"{material}.toml", cells, settings
    )


def gallery(name: str, title: str, *settings: str) -> Scene:
    return Scene(name, title, TOP / "gallery" / name / f"{name}.toml", None, settings)


QUARTER = Scene(
    "quarter",
    "Artery, quarter in space, neo-hookean",
    ARTERY / "neo-hookean.toml",
    ("--sector", "90", "--order", "2", "--lumen-cells", "6", "--media-cells", "2", "--adventitia-cells", "1")
    + ("--axial-cells", "96", "--around", "12"),
    (*PULSE, 'geometry="3d"', "time.end=0.5", "monolithic.newton_tolerance=1e-3", "monolithic.error_tolerance=3e-3"),
)
SCENES = (
    QUARTER,
    *(artery(material) for material in MATERIALS),
    gallery("elastic-tube", "Elastic tube", "time.end=3.125"),
    gallery("heart-beat", "Heart beat", "time.end=1000"),
    gallery("bent-tube", "Bent tube"),
    gallery("bifurcation", "Bifurcation", "time.end=10"),
    gallery("turek-hron-fsi1", "FSI1"),
)


def processor() -> str:
    names = [
        line.split(":")[1].strip() for line in open("/proc/cpuinfo", encoding="utf-8") if line.startswith("model name")
    ]
    return names[0] if names else "unknown processor"


def execute(*command: Any) -> float:
    """Processor seconds of a command. Raises where it fails."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"coupling_kinds.py: error: {' '.join(map(str, command))}: {done.stderr.strip()}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def mesh_of(scene: Scene, programs: Path, work: Path) -> Path:
    if scene.mesh is None:
        path = work / "gallery" / scene.name / f"{scene.name}.msh"
        if not path.exists():
            execute(programs / "fsi-compare", "gallery", scene.name, "-o", work / "gallery", "--jobs", "1")
        return path
    cells = "quarter" if scene.name == "quarter" else "axisymmetric"
    path = work / f"{cells}.msh"
    if not path.exists():
        execute(programs / "fsi-mesh", "artery", *scene.mesh, "-o", path, "-q")
    return path


def run(scene: Scene, programs: Path, mesh: Path, folder: Path, program: str, settings: Tuple[str, ...]) -> float:
    words: List[str] = []
    for setting in (f'mesh.file="{mesh}"', *scene.settings, *settings):
        words += ["--set", setting]
    return execute(programs / f"fsi-{program}", scene.case, "-o", folder, "--threads", "1", "--force", "-q", *words)


def numbers(path: Path) -> "np.ndarray[Any, Any]":
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]

    def number(text: str) -> float:
        try:
            return float(text)
        except ValueError:
            return 0.0

    return np.array([[number(text) for text in row] for row in rows])


def error(folder: Path, reference: Path) -> float:
    """The largest of the relative Euclidean norms of what both runs have in tables, over all times."""
    largest = 0.0
    for name in FIELDS:
        if not (folder / name).exists() or not (reference / name).exists():
            continue
        ours, known = numbers(folder / name), numbers(reference / name)
        if ours.shape != known.shape or ours.shape[1] < 2:
            sys.exit(f"coupling_kinds.py: error: {folder / name} and {reference / name} have other rows")
        start = 2 if name in FIELDS[:2] else 1
        size = np.linalg.norm(known[:, start:])
        if size > 0:
            largest = max(largest, float(np.linalg.norm(ours[:, start:] - known[:, start:]) / size))
    return largest


def measure(scene: Scene, programs: Path, work: Path, turns: int) -> List[Dict[str, Any]]:
    mesh = mesh_of(scene, programs, work)
    reference = work / f"{scene.name}-reference"
    run(scene, programs, mesh, reference, "monolithic", (*TIGHT, "monolithic.error_tolerance=0"))
    seconds: Dict[str, List[float]] = {scheme: [] for _, scheme, _, _ in METHODS}
    for _ in range(turns):
        for _, scheme, program, settings in METHODS:
            seconds[scheme].append(run(scene, programs, mesh, work / f"{scene.name}-{scheme}", program, settings))
    rows = []
    base = statistics.median(seconds["monolithic"])
    for kind, scheme, program, _ in METHODS:
        folder = work / f"{scene.name}-{scheme}"
        summary = json.loads((folder / "summary.json").read_text())
        totals, steps = summary["totals"], summary["totals"]["steps"]
        passes = totals["outer_iterations"] / steps if program == "partitioned" else ""
        taken = statistics.median(seconds[scheme])
        rows.append(
            {
                "scene": scene.title,
                "nodes": summary["mesh"]["nodes"],
                "steps": steps,
                "kind": kind,
                "scheme": scheme,
                "seconds": f"{taken:.2f}",
                "over monolithic": f"{taken / base:.2f}",
                "passes a step": f"{passes:.1f}" if passes != "" else "",
                "work units a step": f"{totals['work_units_per_step']:.0f}",
                "MiB": f"{summary['peak_memory_MiB']:.0f}",
                "error of the solver": f"{error(folder, reference):.1e}",
            }
        )
        print(" | ".join(str(value) for value in rows[-1].values()), flush=True)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", metavar="BIN", type=lambda text: Path(text).resolve())
    parser.add_argument("work", metavar="WORK", type=lambda text: Path(text).resolve())
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--scenes", default=",".join(scene.name for scene in SCENES))
    parser.add_argument("-o", "--output", type=Path, default=TABLE)
    options = parser.parse_args()
    wanted = options.scenes.split(",")
    options.work.mkdir(parents=True, exist_ok=True)
    os.chdir(options.work)
    rows = [
        row
        for scene in SCENES
        if scene.name in wanted
        for row in measure(scene, options.programs, options.work, options.turns)
    ]
    version = subprocess.run(
        [options.programs / "fsi-partitioned", "--version"], capture_output=True, text=True, check=True
    ).stdout.split()[-1]
    with open(options.output, "w", encoding="utf-8", newline="") as file:
        file.write(ORIGIN.format(turns=options.turns, version=version, processor=processor()))
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
