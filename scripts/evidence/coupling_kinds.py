"""Measures what each kind of coupling costs (docs/guide/coupling.md) at equal error of the solver: the monolithic driver, `block-newton` and
interface iterations by turns, on scenes of several kinds.

usage: python3 scripts/evidence/coupling_kinds.py BIN WORK [--turns N] [--scenes NAME,...] [-o FILE]
  BIN    folder of the programs, build/release/bin
  WORK   keeps meshes and runs
  --turns   runs of each, by turns; medians count (3)
  --scenes  only these; rows of others stay as they are
Writes docs/data/coupling-kinds.csv. One thread each; hours on an idle machine. Scenes: the paper's artery in several forms, and those
of the gallery with fluid and wall; of FSI2 and FSI3 40 steps, and not flap-in-merging-jets, which takes many minutes by each driver.

The monolithic driver runs as the case says. What that leaves against a run at 1e-10 is the error that all others are held to. Each of
them runs at tolerances a factor of ten apart, until the errors of two neighbours enclose the monolithic run's. Between these two, what
a run takes is read off by a straight line through the logarithms. Nothing is extrapolated.
"""

import argparse
import csv
import hashlib
import json
import math
import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy as np

TOP = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "compare"))

from fsi_compare.gallery.mesh_chain import make_mesh, with_places  # noqa: E402
from fsi_compare.gallery.scene import read_scene  # noqa: E402

TABLE = TOP / "docs/data/coupling-kinds.csv"
ARTERY = TOP / "meshes/artery/axisymmetric"
GALLERY = TOP / "gallery"
MATERIALS = ("neo-hookean", "mooney-rivlin", "artery")
PULSE = ("time.step=0.03125", 'time.scheme="midpoint"', "output.fields=[]")
BY_ERROR = ("newton.tolerance=1e-3", "newton.error_tolerance=3e-3")  # the drivers' own, in fixed steps
# What solving leaves where nothing but the solver's tolerance differs.
TIGHT = ("newton.tolerance=1e-10", "newton.error_tolerance=0")
STEP = 10.0  # between neighbouring tolerances
MOST = 6  # tolerances of a method on the way to the monolithic run's error
LOOSEST = 0.5  # above it a tolerance demands nothing
ALIKE = 1.5  # factor within which two errors count as equal
TABLES = ("centerline_pressure.csv", "wall_displacement.csv", "openings.csv", "points.csv")
ORIGIN = """# made by scripts/evidence/coupling_kinds.py BIN WORK, programs of version {version}, {processor}, one thread
# seconds: processor seconds of the whole program, median of {turns} by turns; error: the largest relative Euclidean norm, over tables
# and times, of what a run differs by from the monolithic driver with newton.tolerance = 1e-10. Two tolerances with their seconds and
# errors are those whose errors enclose the monolithic run's; all behind them is read off between the two, memory: the larger one
"""


class Method(NamedTuple):
    """A way to couple. `scheme`: of the partitioned driver; None: what it chooses by the scene."""

    kind: str
    program: str
    scheme: Optional[str] = None
    tolerance: float = (
        3e-3  # partitioned.tolerance that is tried first: of steps that end by their error the drivers' default
    )

    @property
    def name(self) -> str:
        return self.scheme or ("default" if self.program == "partitioned" else self.program)

    def settings(self, tolerance: Optional[float]) -> Tuple[str, ...]:
        named = (f'partitioned.scheme="{self.scheme}"',) if self.scheme else ()
        return named if tolerance is None else (*named, f"partitioned.tolerance={tolerance:g}")


MONOLITHIC = Method("monolithic", "monolithic")
METHODS = (Method("block", "partitioned", "block-newton"), Method("interface", "partitioned"))
OTHER = Method(
    "interface", "partitioned", "iqn-imvj", 1e-4
)  # the fastest of the schemes that solve each medium to the end


class Scene(NamedTuple):
    name: str
    title: str
    case: Path
    mesh: Optional[Tuple[str, ...]]  # arguments of fsi-mesh; None: the gallery's
    settings: Tuple[str, ...]
    with_other: bool = True  # whether OTHER is measured, too

    @property
    def methods(self) -> Tuple[Method, ...]:
        return (*METHODS, OTHER) if self.with_other else METHODS


def coarse_artery(material: str) -> Scene:
    """The paper's own step, element and mesh."""
    cells = ("artery", "--level", "coarse")
    title = f"Artery, the paper's coarse mesh, {material}"
    return Scene(f"coarse-{material}", title, TOP / f"meshes/artery/{material}.toml", cells, BY_ERROR, False)


def artery(material: str) -> Scene:
    cells = ("artery", "--axisymmetric", "--for", "p2p1", "--error", "3%", "--waves", "resolved")
    settings = (*PULSE, *BY_ERROR, "time.end=3")
    return Scene(
        f"axisymmetric-{material}", f"Artery, axisymmetric, {material}", ARTERY / f"{material}.toml", cells, settings
    )


def gallery(name: str, title: str, *settings: str, mesh: Optional[Tuple[str, ...]] = None) -> Scene:
    return Scene(name, title, GALLERY / name / f"{name}.toml", mesh, settings)


QUARTER = Scene(
    "quarter",
    "Artery, quarter in space, neo-hookean",
    ARTERY / "neo-hookean.toml",
    ("artery", "--sector", "90", "--order", "2", "--lumen-cells", "6", "--media-cells", "2", "--adventitia-cells", "1")
    + ("--axial-cells", "96", "--around", "12"),
    (*PULSE, *BY_ERROR, 'geometry="3d"', "time.end=0.5"),
)
TUBE = gallery(
    "elastic-tube",
    "Elastic tube, quarter in space",
    'geometry="3d"',
    "time.end=1.5625",
    mesh=("geo", str(TOP / "scripts/elastic-tube-quarter.geo"), "--order", "2"),
)._replace(name="elastic-tube-quarter")
SCENES = (
    QUARTER,
    *(artery(material) for material in MATERIALS),
    TUBE,
    gallery("elastic-tube", "Elastic tube, axisymmetric", "time.end=3.125"),
    gallery("heart-beat", "Heart beat", "time.end=1000"),
    gallery("bent-tube", "Bent tube"),
    gallery("bifurcation", "Bifurcation", "time.end=10"),
    gallery("turek-hron-fsi1", "FSI1"),
    gallery("turek-hron-fsi2", "FSI2, the first 40 steps", "time.end=200"),
    gallery("turek-hron-fsi3", "FSI3, the first 40 steps", "time.end=80"),
    *(coarse_artery(material) for material in MATERIALS),
    *(
        gallery(name, title, *settings)._replace(with_other=False)
        for name, title, *settings in (
            ("aneurysm", "Aneurysm"),
            ("artery-pulse", "Artery pulse"),
            ("beam-in-cross-flow", "Beam in cross flow"),
            ("carotid-from-stl", "Carotid from a noisy surface, 40 steps", "time.end=320"),
            ("coronary-heart", "Coronary artery, 200 steps", "time.end=800"),
            ("oscillating-pipe", "Oscillating pipe"),
            ("pulsating-ring", "Pulsating ring"),
            ("ring-in-annulus", "Ring in an annulus of liquid, 200 steps", "time.end=4000"),
            ("thin-dome-aneurysm", "Thin-dome aneurysm"),
            ("viscoelastic-tube", "Viscoelastic tube"),
            ("womersley-elastic", "Womersley flow in an elastic tube, 200 steps", "time.end=100000"),
        )
    ),
)


class Run:
    """One method at one tolerance: the same in each turn but for its seconds."""

    def __init__(self, method: Method, tolerance: Optional[float], folder: Path, error: float) -> None:
        self.method, self.tolerance, self.error = method, tolerance, error
        self.summary = json.loads((folder / "summary.json").read_text())
        self.times: List[float] = []

    @property
    def taken(self) -> Dict[str, float]:
        """What is read off at equal error."""
        totals = self.summary["totals"]
        steps = totals["steps"]
        return {
            "seconds": statistics.median(self.times),
            "passes": totals["outer_iterations"] / steps,
            "newton": totals["newton_iterations"] / steps,
            "work": totals["work_units_per_step"],
        }

    @property
    def memory(self) -> float:
        return float(self.summary["peak_memory_MiB"])

    @property
    def scheme(self) -> str:
        """Also where the case names none."""
        return str(self.summary.get("choices", {}).get("partitioned.scheme", {}).get("value", self.method.name))


class Bench:
    """A scene with its mesh and its reference."""

    def __init__(self, scene: Scene, programs: Path, work: Path) -> None:
        self.scene, self.programs, self.work = scene, programs, work
        self.mesh = mesh_of(scene, programs, work)
        self.reference = work / f"{scene.name}-reference"
        self._seconds(MONOLITHIC, TIGHT, self.reference)

    def first(self, method: Method, tolerance: Optional[float]) -> Optional[Run]:
        """None: it does not converge."""
        folder = self._folder(method, tolerance)
        seconds = self._seconds(method, method.settings(tolerance), folder)
        if seconds is None:
            return None
        run = Run(method, tolerance, folder, error(folder, self.reference))
        run.times.append(seconds)
        return run

    def again(self, run: Run) -> None:
        seconds = self._seconds(run.method, run.method.settings(run.tolerance), self._folder(run.method, run.tolerance))
        run.times += [seconds] if seconds is not None else []

    def _folder(self, method: Method, tolerance: Optional[float]) -> Path:
        name = method.name if tolerance is None else f"{method.name}-{tolerance:g}"
        return self.work / f"{self.scene.name}-{name}"

    def _seconds(self, method: Method, settings: Tuple[str, ...], folder: Path) -> Optional[float]:
        """Processor seconds; None: it does not converge, which the run at 1e-10 must."""
        words: List[str] = []
        for setting in (f'mesh.file="{self.mesh}"', *self.scene.settings, *settings):
            words += ["--set", setting]
        program = self.programs / f"fsi-{method.program}"
        refusable = method != MONOLITHIC
        return execute(
            program, self.scene.case, "-o", folder, "--threads", "1", "--force", "-q", *words, may_fail=refusable
        )


def processor() -> str:
    names = [
        line.split(":")[1].strip() for line in open("/proc/cpuinfo", encoding="utf-8") if line.startswith("model name")
    ]
    return names[0] if names else "unknown processor"


def execute(*command: Any, may_fail: bool = False) -> Optional[float]:
    """Processor seconds of a command; None: it did not converge, where it may. Any other failure ends the program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if may_fail and done.returncode == 2:
        return None
    if done.returncode != 0:
        fail(f"{' '.join(map(str, command))}: {done.stderr.strip()}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def fail(text: str) -> None:
    sys.exit(f"coupling_kinds.py: error: {text}")


def mesh_of(scene: Scene, programs: Path, work: Path) -> Path:
    path = work / f"{'axisymmetric' if scene.name.startswith('axisymmetric') else scene.name}.msh"  # of all materials
    if path.exists():
        return path
    if scene.mesh:
        execute(programs / "fsi-mesh", *scene.mesh, "-o", path, "-q")
        return path
    ready = read_scene(scene.case.parent)
    end = make_mesh(with_places(ready.mesh_words(False), ready.folder), path, programs / "fsi-mesh", scene.name)
    if end.code:
        fail(f"{scene.name}: {end.message}")
    return path


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
    for name in TABLES:
        if not (folder / name).exists() or not (reference / name).exists():
            continue
        ours, known = numbers(folder / name), numbers(reference / name)
        if ours.shape != known.shape or ours.shape[1] < 2:
            fail(f"{folder / name} and {reference / name} have other rows")
        start = 2 if name in TABLES[:2] else 1
        size = np.linalg.norm(known[:, start:])
        if size > 0:
            largest = max(largest, float(np.linalg.norm(ours[:, start:] - known[:, start:]) / size))
    return largest


def ladder(bench: Bench, method: Method, target: float) -> List[Run]:
    """Runs from loose to tight, until two neighbours enclose `target` or the tolerances end."""
    start = bench.first(method, method.tolerance)
    runs = [start] if start else []
    factor = 1 / STEP if start is None or start.error > target else STEP
    tolerance = method.tolerance
    while len(runs) < MOST and enclosing(runs, target) is None:
        tolerance *= factor
        run = bench.first(method, tolerance) if tolerance <= LOOSEST else None
        if run is None:
            break
        runs.append(run)
    return sorted(runs, key=lambda run: -(run.tolerance or 0))


def enclosing(runs: List[Run], target: float) -> Optional[Tuple[Run, Run]]:
    """The neighbours whose errors have `target` between them: the looser one first."""
    ordered = sorted(runs, key=lambda run: -(run.tolerance or 0))
    for loose, tight in zip(ordered, ordered[1:]):
        if loose.error >= target >= tight.error:
            return loose, tight
    return None


def between(loose: Run, tight: Run, target: float) -> Dict[str, float]:
    """What is taken at the error `target`, by a straight line through logarithms."""
    whole = math.log(loose.error / tight.error)
    weight = math.log(loose.error / target) / whole if whole > 0 else 0.0
    ends = zip(loose.taken.items(), tight.taken.values())
    return {name: math.exp((1 - weight) * math.log(a) + weight * math.log(b)) for (name, a), b in ends}


def used(runs: List[Run], target: float) -> Tuple[Run, ...]:
    """Those that the row is made of: two that enclose the error, else the one nearest to it."""
    return enclosing(runs, target) or (min(runs, key=lambda run: abs(math.log(run.error / target))),)


def row(scene: Scene, method: Method, runs: Tuple[Run, ...], base: Run) -> Dict[str, Any]:
    """`runs`: one, or two that enclose the error of `base`. Empty where no run has converged."""
    target = base.error
    if len(runs) == 2:
        taken, equal = between(runs[0], runs[1], target), "yes"
    elif runs:
        taken = runs[0].taken
        alike = max(runs[0].error / target, target / runs[0].error) <= ALIKE
        equal = "yes" if alike else f"no, {runs[0].error / target:.2g} times the error"
    else:
        taken, equal = {}, "no run converges"
    ratio = taken["seconds"] / base.taken["seconds"] if taken else None
    totals, mesh = base.summary["totals"], base.summary["mesh"]

    def number(value: Optional[float], form: str) -> str:
        return "" if value is None else format(value, form)

    return {
        "scene": scene.title,
        "nodes": mesh["nodes"],
        "steps": totals["steps"],
        "kind": method.kind,
        "method": runs[0].scheme if runs else method.name,
        "tolerance": " / ".join(f"{run.tolerance:g}" for run in runs if run.tolerance) or "the case's",
        "seconds": " / ".join(f"{run.taken['seconds']:.2f}" for run in runs),
        "error": " / ".join(f"{run.error:.1e}" for run in runs),
        "seconds at equal error": number(taken.get("seconds"), ".2f"),
        "over monolithic": number(ratio, ".2f"),
        "passes a step": number(taken.get("passes") if method != MONOLITHIC else None, ".1f"),
        "newton iterations a step": number(taken.get("newton"), ".1f"),
        "work units a step": number(taken.get("work"), ".0f"),
        "MiB": number(max((run.memory for run in runs), default=None), ".0f"),
        "equal error": equal,
    }


def measure(scene: Scene, programs: Path, work: Path, turns: int) -> List[Dict[str, Any]]:
    """The first turn finds the tolerances, the others repeat what the rows are made of."""
    bench = Bench(scene, programs, work)
    base = bench.first(MONOLITHIC, None)
    assert base is not None and base.error > 0
    found = {method: ladder(bench, method, base.error) for method in scene.methods}
    kept = {method: used(runs, base.error) if runs else () for method, runs in found.items()}
    for _ in range(turns - 1):
        bench.again(base)
        for runs in kept.values():
            for run in runs:
                bench.again(run)
    rows = [
        row(scene, MONOLITHIC, (base,), base),
        *(row(scene, method, kept[method], base) for method in scene.methods),
    ]
    for one in rows:
        print(" | ".join(str(value) for value in one.values()), flush=True)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", metavar="BIN", type=lambda text: Path(text).resolve())
    parser.add_argument("work", metavar="WORK", type=lambda text: Path(text).resolve())
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--scenes", default=",".join(scene.name for scene in SCENES))
    parser.add_argument("-o", "--output", type=lambda text: Path(text).resolve(), default=TABLE)
    options = parser.parse_args()
    wanted = options.scenes.split(",")
    for name in wanted:
        if name not in {scene.name for scene in SCENES}:
            fail(f"--scenes: '{name}' is unknown; choose of {', '.join(scene.name for scene in SCENES)}")
    options.work.mkdir(parents=True, exist_ok=True)
    os.chdir(options.work)
    kept = rows_by_scene(options.output)
    version = subprocess.run(
        [options.programs / "fsi-partitioned", "--version"], capture_output=True, text=True, check=True
    ).stdout.split()[-1]
    origin = ORIGIN.format(turns=options.turns, version=version, processor=processor())
    for scene in (scene for scene in SCENES if scene.name in wanted):
        measured = options.work / f"{scene.name}.json"
        of = identity(scene, options.programs, options.turns)
        before = json.loads(measured.read_text(encoding="utf-8")) if measured.exists() else {}
        if before.get("of") != of:
            before = {"of": of, "rows": measure(scene, options.programs, options.work, options.turns)}
            part = measured.with_suffix(".part")
            part.write_text(json.dumps(before), encoding="utf-8")
            part.replace(measured)
        kept[scene.title] = before["rows"]
        keep(options.output, origin, kept)


def identity(scene: Scene, programs: Path, turns: int) -> str:
    """Of what is measured and by what: the same is not measured again."""
    files = [programs / "fsi-monolithic", programs / "fsi-partitioned", scene.case, Path(__file__)]
    digest = hashlib.sha256(b"".join(file.read_bytes() for file in files))
    return f"{digest.hexdigest()}, {scene}, {turns} turns"


def rows_by_scene(table: Path) -> Dict[str, List[Dict[str, Any]]]:
    """What was measured before."""
    kept: Dict[str, List[Dict[str, Any]]] = {}
    if table.exists():
        with open(table, encoding="utf-8", newline="") as file:
            for one in csv.DictReader(line for line in file if not line.startswith("#")):
                kept.setdefault(one["scene"], []).append(one)
    return kept


def keep(table: Path, origin: str, kept: Dict[str, List[Dict[str, Any]]]) -> None:
    """In the order of SCENES; scenes that are no more leave."""
    rows = [one for scene in SCENES for one in kept.get(scene.title, [])]
    with open(table, "w", encoding="utf-8", newline="") as file:
        file.write(origin)
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
