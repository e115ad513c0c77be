"""Makes the kept tables of errors: what mesh, element and step leave, for how many seconds.

usage: python3 scripts/evidence/error_tables.py BIN WORK [TABLE...]
  BIN     folder of the programs, build/release/bin
  WORK    keeps meshes and runs: a finished run is not made again
  TABLE   of mesh-error-seconds, step-error, adaptive-steps, wave-error, vessel-error-seconds, beat-step-error; all of them unless given
Writes docs/data/TABLE.csv. One thread each. Errors are relative L2 norms in percent; each table says of what, and against what.
"""

import csv
import json
import os
import re
import sys
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, List, NamedTuple, NoReturn, Sequence, Tuple

import numpy as np

from kept_tables import DATA, TOP, write_table
from timed_call import CallError, processor_seconds

AXISYMMETRIC, TUBE = "meshes/artery/axisymmetric/neo-hookean.toml", "meshes/artery/neo-hookean.toml"
REFERENCE = TOP / "compare/research/studies/references/neo-hookean"  # step and mesh extrapolated to zero
SILENT = ("output.every=0", "output.checkpoint_every=0")
LATE = "1.5,3,4.5,6,7.5,9"  # ms
QUADRATIC = ('element="p2p1"', 'structure.layer_pressure="separate"')
LINEAR = ('element="p1"', 'stabilisation="projected"', 'structure.layer_pressure="separate"')
PAPER = ('element="p1"', 'stabilisation="paper"', 'structure.layer_pressure="continuous"')

Rows = List[Tuple[object, ...]]


class Run(NamedTuple):
    folder: Path
    seconds: float  # of the processor, the whole program

    def summary(self) -> Dict:
        return json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))

    def nodes(self) -> int:
        return self.summary()["mesh"]["nodes"]


class Runner:
    """Makes meshes and runs in a folder; what is there already stays."""

    def __init__(self, programs: Path, work: Path):
        self.programs, self.work = programs, work
        work.mkdir(parents=True, exist_ok=True)

    def mesh(self, name: str, words: str) -> Path:
        path = self.work / f"{name}.msh"
        if not path.exists():
            self.call([self.programs / "fsi-mesh", *words.split(), "-o", path], path.with_suffix(".txt"))
        return path

    def told_of(self, name: str) -> str:
        """What fsi-mesh said of a mesh."""
        return (self.work / f"{name}.txt").read_text(encoding="utf-8")

    def run(self, name: str, case: str, settings: Iterable[str], program: str = "fsi-monolithic") -> Run:
        folder = self.work / name
        seconds = folder / "processor_seconds.txt"
        if not seconds.exists():
            words: List[object] = [self.programs / program, TOP / case, "-o", folder, "--force", "-q", "--threads", "1"]
            for setting in (*SILENT, *settings):
                words += ["--set", setting]
            taken = self.call(words)
            seconds.write_text(f"{taken:.4g}\n", encoding="utf-8")
        return Run(folder, float(seconds.read_text(encoding="utf-8")))

    def errors(self, reference: Path, run: Run, times: str) -> List[Dict[str, float]]:
        """By time, relative: pressure, averaged pressure and displacement."""
        into = run.folder / "errors"
        self.call(
            [self.programs / "fsi-compare", "accuracy", reference, run.folder, "-o", into, "--times", times, "-q"]
        )
        with open(into / "accuracy.csv", encoding="utf-8", newline="") as file:
            return [
                {
                    name[: -len("_relative_L2")]: float(cell)
                    for name, cell in row.items()
                    if name.endswith("_relative_L2") and cell
                }
                for row in csv.DictReader(file)
            ]

    def call(self, words: Sequence[object], told: Path = Path(os.devnull)) -> float:
        try:
            return processor_seconds(words, TOP, told)
        except CallError as error:
            fail(str(error))


def digits(value: float, count: int = 2) -> str:
    """Rounded, without an exponent: 0.00771 -> '0.0077', 53.9 -> '54'."""
    return np.format_float_positional(float(f"{value:.{count}g}"), trim="-")


def artery(cells: str, gradings: Tuple[float, float] = (1, 1), element: str = "p2p1", around: int = 0) -> str:
    """Words for fsi-mesh; around: cells around the whole circumference of a mesh in three dimensions."""
    names = ("--lumen-cells", "--media-cells", "--adventitia-cells", "--axial-cells")
    words = ["artery", "--order", "2" if element == "p2p1" else "1"]
    words += [word for pair in zip(names, cells.split("-")) for word in pair]
    words += ["--lumen-grading", f"{gradings[0]:g}", "--axial-grading", f"{gradings[1]:g}"]
    return " ".join(words + (["--around", str(around)] if around else ["--axisymmetric"]))


class Mesh(NamedTuple):
    label: str  # without a comma: pages find rows by it
    element: str
    settings: Tuple[str, ...]
    words: str
    case: str = AXISYMMETRIC


def section(cells: str, gradings: Tuple[float, float], element: str = "p2p1") -> Mesh:
    label = f"axisymmetric {cells} graded {gradings[0]:g} and {gradings[1]:g}"
    return Mesh(label, element, QUADRATIC if element == "p2p1" else LINEAR, artery(cells, gradings, element))


def solid(cells: str, around: int, gradings: Tuple[float, float], whole: bool = False) -> Mesh:
    label = (
        f"{'whole tube' if whole else 'quarter'} {cells} and {around} around graded {gradings[0]:g} and {gradings[1]:g}"
    )
    words = artery(cells, gradings, around=around) + ("" if whole else " --sector 90")
    return Mesh(label, "p2p1", QUADRATIC, words, TUBE)


def level(name: str, settings: Tuple[str, ...], element: str) -> Mesh:
    return Mesh(f"whole tube of level {name}", element, settings, f"artery --level {name}", TUBE)


ONE_PRESSURE = Mesh(
    "axisymmetric 6-2-1-36 with one pressure for both layers",
    "p2p1",
    ('element="p2p1"', 'structure.layer_pressure="continuous"'),
    artery("6-2-1-36", (2, 12)),
)
MESHES = (
    section("4-1-1-24", (2, 8)),
    section("4-1-1-36", (2, 8)),
    section("6-2-1-36", (2, 12)),
    ONE_PRESSURE,
    section("8-3-2-144", (3, 4)),
    section("12-4-4-192", (3, 4)),
    section("12-4-3-144", (2, 4), "p1"),
    section("24-8-6-288", (2, 4), "p1"),
    solid("4-1-1-24", 8, (2, 8)),
    solid("4-1-1-24", 12, (2, 8)),
    solid("4-1-1-36", 12, (2, 8)),
    solid("4-1-1-36", 12, (2, 8), whole=True),
    solid("6-2-1-36", 12, (2, 12)),
    solid("6-2-1-48", 16, (2, 8)),
    *(level(name, LINEAR, "p1 with separate pressures") for name in ("coarse", "intermediate", "fine")),
    *(level(name, PAPER, "p1 as the paper's") for name in ("coarse", "intermediate")),
)


def named(label: str) -> str:
    """A name for a file."""
    return label.replace(" ", "-")


def mesh_error_seconds(runner: Runner) -> None:
    common = ('time.scheme="euler"', "time.step=0.125", "time.end=6", "newton.tolerance=1e-3")

    def run(mesh: Mesh) -> Run:
        name = named(f"{mesh.element} {mesh.label}")
        file = runner.mesh(f"space-{name}", mesh.words)
        return runner.run(f"space-{name}", mesh.case, (f"mesh.file={file}", *mesh.settings, *common))

    finest = run(section("16-5-5-256", (3, 4)))
    rows: Rows = []
    for mesh in MESHES:
        found = run(mesh)
        errors = runner.errors(finest.folder, found, "1.5,3,4.5,6")
        worst = [100 * max(row[name] for row in errors) for name in ("pressure", "radial")]
        rows.append((mesh.label, mesh.element, found.nodes(), digits(found.seconds), *map(digits, worst)))
    keep(
        "mesh-error-seconds",
        "neo-Hookean artery to 6 ms by steps of 1/8 ms, euler, newton.tolerance 1e-3; the largest relative L2 norm along z of 1.5, 3, 4.5\n"
        "and 6 ms, against axisymmetric p2p1 with 16-5-5-256 cells; cells through lumen, media, adventitia and along the axis;\n"
        "gradings of lumen and axis; seconds: of the processor, the whole program",
        ("mesh", "element", "nodes", "seconds", "pressure [%]", "displacement [%]"),
        rows,
    )


def step_error(runner: Runner) -> None:
    common = ("mesh.waves=damped", "time.end=9.375", "newton.tolerance=1e-6")
    best = runner.run("step-reference", AXISYMMETRIC, ('time.scheme="tr-bdf2"', f"time.step={1 / 256}", *common))
    rows: Rows = []
    for scheme in ("euler", "bdf2", "generalised-alpha", "midpoint", "tr-bdf2"):
        for step in (0.125, 0.0625, 0.03125):
            settings = (f'time.scheme="{scheme}"', f"time.step={step}", *common)
            errors = runner.errors(best.folder, runner.run(f"step-{scheme}-{step}", AXISYMMETRIC, settings), LATE)
            cells = []
            for name in ("radial", "averaged_pressure", "pressure"):
                values = [100 * row[name] for row in errors]
                cells += [digits(sum(values) / len(values), 3), digits(max(values), 3)]
            rows.append((scheme, step, *cells))
    quantities = ("displacement, mean [%]", "worst [%]", "averaged pressure, mean [%]", "its worst [%]")
    keep(
        "step-error",
        "axisymmetric neo-Hookean artery, p2p1, mesh of 1,387 nodes, newton.tolerance 1e-6, against tr-bdf2 at 1/256 ms on the same mesh;\n"
        f"relative L2 norms along z, mean and worst of {LATE} ms",
        ("scheme", "step [ms]", *quantities, "pressure, mean [%]", "pressure, worst [%]"),
        rows,
    )


def adaptive_steps(runner: Runner) -> None:
    common = ("mesh.waves=damped", "time.end=9.375", "newton.tolerance=1e-6", 'time.scheme="midpoint"')
    best = runner.run("step-reference", AXISYMMETRIC, ('time.scheme="tr-bdf2"', f"time.step={1 / 256}", *common[:3]))
    rows: Rows = []
    for label, settings in (
        ("1/8 ms", ("time.step=0.125",)),
        ("tolerance 0.04", ('time.step="adaptive"', "time.tolerance=0.04")),
        ("1/16 ms", ("time.step=0.0625",)),
        ("tolerance 0.02", ('time.step="adaptive"', "time.tolerance=0.02")),
        ("tolerance 0.01", ('time.step="adaptive"', "time.tolerance=0.01")),
        ("1/32 ms", ("time.step=0.03125",)),
    ):
        run = runner.run(f"adaptive-{named(label).replace('/', '-')}", AXISYMMETRIC, (*settings, *common))
        errors = runner.errors(best.folder, run, LATE)
        totals = run.summary()["totals"]
        means = [
            100 * sum(row[name] for row in errors) / len(errors) for name in ("radial", "pressure", "averaged_pressure")
        ]
        rejected = totals["rejected_steps"]
        rows.append((label, totals["steps"] + rejected, rejected, *(digits(value, 2) for value in means)))
    keep(
        "adaptive-steps",
        "midpoint, steps of equal length and adaptive ones; case, mesh, reference and norms of step-error.csv, means; steps: those that\n"
        "were solved, the rejected ones with them",
        ("step", "steps", "rejected", "displacement [%]", "pressure [%]", "averaged pressure [%]"),
        rows,
    )


# The largest displacement and pressure of a separate code (other elements, other weak forms), mm and Pa.
PEAKS = {
    1.5: (0.0924, 44.7),
    3.0: (0.0875, 39.2),
    4.5: (0.0790, 39.1),
    6.0: (0.0738, 33.8),
    7.5: (0.0683, 34.8),
    9.0: (0.0616, 30.9),
}
WAVES = (
    (section("6-2-1-36", (2, 12)), 32),
    (section("4-1-1-96", (2, 4)), 32),
    (section("6-2-1-72", (2, 8)), 64),
    (section("6-2-1-96", (2, 6)), 32),
    (section("6-2-2-96", (3, 4)), 32),
    (section("6-2-2-96", (3, 4)), 64),
    (section("6-2-1-144", (2, 4)), 48),
    (section("9-3-3-144", (3, 4)), 64),
    (section("12-4-4-192", (3, 4)), 64),
    (solid("6-2-1-96", 12, (2, 6)), 32),
)


def wave_error(runner: Runner) -> None:
    rows: Rows = []
    for mesh, parts in WAVES:
        name = named(mesh.label)
        file = runner.mesh(f"wave-{name}", mesh.words)
        settings = (
            f"mesh.file={file}",
            *mesh.settings,
            'time.scheme="midpoint"',
            f"time.step={1 / parts!r}",
            "time.end=9.375",
        )
        run = runner.run(f"wave-{name}-{parts}", mesh.case, (*settings, "newton.tolerance=1e-3"))
        errors = runner.errors(REFERENCE, run, LATE)
        worst = [100 * max(row[quantity] for row in errors) for quantity in ("radial", "averaged_pressure", "pressure")]
        peaks = [100 * value for value in peak_errors(run)]
        rows.append((mesh.label, run.nodes(), f"1/{parts}", *map(digits, (*worst, *peaks)), digits(run.seconds)))
    keep(
        "wave-error",
        f"neo-Hookean artery, midpoint, to 9.375 ms, newton.tolerance 1e-3, against {REFERENCE.relative_to(TOP)}; worst relative L2\n"
        f"norm along z of {LATE} ms; peaks: largest displacement and pressure against a separate code's at these times, the worst;\n"
        "seconds: of the processor, the whole program",
        (
            "mesh",
            "nodes",
            "step [ms]",
            "displacement [%]",
            "averaged pressure [%]",
            "pressure [%]",
            "peak of displacement [%]",
            "peak of pressure [%]",
            "seconds",
        ),
        rows,
    )


def peak_errors(run: Run) -> Tuple[float, float]:
    tables = [table_of(run, name) for name in ("wall_displacement", "centerline_pressure")]
    found = []
    for place, (table, column) in enumerate(zip(tables, ("radial_mm", "pressure_Pa"))):
        off = []
        for time, known in PEAKS.items():
            at = table["time_ms"][np.argmin(np.abs(table["time_ms"] - time))]
            off.append(abs(float(np.max(table[column][table["time_ms"] == at])) / known[place] - 1))
        found.append(max(off))
    return found[0], found[1]


def table_of(run: Run, name: str) -> Any:
    """A structured array: columns by their names."""
    return np.genfromtxt(run.folder / f"{name}.csv", delimiter=",", names=True)


class Vessel(NamedTuple):
    name: str
    case: str
    shape: str
    end: float  # ms
    sizes: Dict[str, Tuple[float, ...]]  # mm, by element


VESSELS = (
    Vessel(
        "bend",
        "gallery/bent-tube/bent-tube.toml",
        "gallery/bent-tube/bend.geo",
        6.0,
        {"p1": (0.6, 0.45, 0.35), "p2p1": (1.6, 1.2, 0.9)},
    ),
    Vessel(
        "bifurcation",
        "gallery/bifurcation/bifurcation.toml",
        "gallery/bifurcation/fork.geo",
        8.0,
        {"p1": (0.6, 0.45, 0.35), "p2p1": (1.8, 1.3, 0.9)},
    ),
)
ACROSS = re.compile(r"is ([\d.]+) cells across")
FINEST = 0.6  # mm, p2p1


def vessel_error_seconds(runner: Runner) -> None:
    rows: Rows = []
    for vessel in VESSELS:
        best = openings_of(vessel_run(runner, vessel, "p2p1", FINEST, "fsi-monolithic"))
        for element, sizes in vessel.sizes.items():
            for size in sizes:
                both = [vessel_run(runner, vessel, element, size, one) for one in ("fsi-monolithic", "fsi-partitioned")]
                across = ACROSS.search(runner.told_of(f"{vessel.name}-{element}-{size}"))
                if not across:
                    fail(f"{vessel.name}, {element}, {size} mm: fsi-mesh does not say how many cells lie across")
                found = openings_of(both[0])
                pressure = difference(found["inlet"]["pressure"], best["inlet"]["pressure"])
                flow = max(difference(found[name]["flow"], best[name]["flow"]) for name in found if name != "inlet")
                seconds = [digits(run.seconds) for run in both]
                errors = [digits(100 * error) for error in (pressure, flow)]
                rows.append((vessel.name, element, both[0].nodes(), across[1], *seconds, *errors))
    keep(
        "vessel-error-seconds",
        "gallery/bent-tube to 6 ms and gallery/bifurcation to 8 ms, as they are but for element and size of cells; relative L2 norm over\n"
        f"time of the mean pressure at the inlet and of the flow at the outlets, against p2p1 with edges of {FINEST} mm; cells across the lumen\n"
        "as fsi-mesh geo counts them; seconds: of the processor, the whole program, both drivers by their defaults",
        ("scene", "element", "nodes", "cells across", "monolithic [s]", "partitioned [s]", "pressure [%]", "flow [%]"),
        rows,
    )


def vessel_run(runner: Runner, vessel: Vessel, element: str, size: float, program: str) -> Run:
    name, order = f"{vessel.name}-{element}-{size}", 2 if element == "p2p1" else 1
    file = runner.mesh(name, f"geo {TOP / vessel.shape} --order {order} --set size={size}")
    settings = (f"mesh.file={file}", f'element="{element}"', f"time.end={vessel.end}")
    return runner.run(f"{name}-{program}", vessel.case, settings, program)


def openings_of(run: Run) -> Dict[str, Dict[str, np.ndarray]]:
    """By opening: its pressure and its flow over time."""
    found: Dict[str, Dict[str, List[float]]] = {}
    with open(run.folder / "openings.csv", encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            one = found.setdefault(row["opening"], {"pressure": [], "flow": []})
            one["pressure"].append(float(row["mean_pressure_Pa"]))
            one["flow"].append(float(row["flow_mm3_per_ms"]))
    return {name: {key: np.array(values) for key, values in one.items()} for name, one in found.items()}


def difference(values: np.ndarray, reference: np.ndarray) -> float:
    return float(np.linalg.norm(values - reference) / np.linalg.norm(reference))


BEAT_STEPS, BEAT_END, BEAT_BEST, RISE = (16, 8, 4, 2), 1232, 0.5, 100.0  # ms
HARMONICS = 8  # of the beat's table, whose kinks would be an error of their own


def beat_step_error(runner: Runner) -> None:
    mesh = runner.mesh(
        "beat", "geo gallery/heart-beat/carotid.geo --order 2 --set across=3 --set through=1 --set along=8"
    )
    case = beat_from_rest(runner.work)
    common = (f"mesh.file={mesh}", f"time.end={BEAT_END}", "newton.tolerance=1e-6")

    def pressure(scheme: str, step: float) -> Tuple[np.ndarray, Run]:
        settings = (*common, f'time.scheme="{scheme}"', f"time.step={step}")
        run = runner.run(f"beat-{scheme}-{step}", case, settings)
        return openings_of(run)["inlet"]["pressure"], run

    best, _ = pressure("tr-bdf2", BEAT_BEST)
    rows: Rows = []
    for scheme in ("euler", "midpoint", "generalised-alpha", "bdf2", "tr-bdf2"):
        errors, iterations = [], 0.0
        for step in BEAT_STEPS:
            found, run = pressure(scheme, step)
            parts = round(step / BEAT_BEST)
            same = best[parts - 1 :: parts]  # tables begin at the end of the first step
            errors.append(100 * float(np.sqrt(np.mean((found - same) ** 2)) / np.ptp(best)))
            if step == 4:
                table = table_of(run, "iterations")
                iterations = float(np.mean(table["newton_iterations"]))
        order = np.log2(errors[-2] / errors[-1])
        rows.append((scheme, *(digits(error) for error in errors), f"{order:.1f}", f"{iterations:.1f}"))
    keep(
        "beat-step-error",
        f"gallery/heart-beat on its quick mesh, {HARMONICS} harmonics of its flow with a parabolic profile, times a smooth rise over {RISE:g} ms,\nto {BEAT_END} ms, newton.tolerance 1e-6; error of\n"
        f"the pressure at the inlet: root mean square over time, in % of its range, against tr-bdf2 with {BEAT_BEST} ms",
        ("scheme", *(f"{step} ms [%]" for step in BEAT_STEPS), "order, last", "Newton iterations a step of 4 ms"),
        rows,
    )


def beat_from_rest(work: Path) -> str:
    """A case file. The beat again and again, from rest: its table begins with a jump, which is an error of its own in some schemes."""
    flow, case = work / "beat-from-rest.csv", work / "beat-from-rest.toml"
    text = (TOP / "gallery/heart-beat/heart-beat.toml").read_text(encoding="utf-8")
    text = text.replace("beat.csv", str(flow)).replace(
        "womersley", "parabolic"
    )  # the other is of flows that repeat themselves
    lines = [line for line in text.splitlines() if not line.startswith("period")]
    case.write_text("\n".join(lines) + "\n", encoding="utf-8")
    smooth_flow(flow)
    return str(case)


def smooth_flow(path: Path) -> None:
    beat: Any = np.genfromtxt(TOP / "gallery/heart-beat/beat.csv", delimiter=",", names=True)
    times = np.arange(0, BEAT_END + 801, 0.5)
    waves = np.fft.rfft(beat["flow_mm3_per_ms"][:-1])[: HARMONICS + 1] / (len(beat) - 1)
    phases = 2j * np.pi * np.outer(times / beat["time_ms"][-1], np.arange(HARMONICS + 1))
    flow = np.real(np.exp(phases) @ (waves * np.where(np.arange(HARMONICS + 1) > 0, 2, 1)))
    rise = np.where(times < RISE, (1 - np.cos(np.pi * times / RISE)) / 2, 1.0)
    with open(path, "w", encoding="utf-8") as file:
        file.write("time_ms,flow_mm3_per_ms\n")
        file.writelines(f"{time:g},{value:.8g}\n" for time, value in zip(times, flow * rise))


TABLES: Dict[str, Callable[[Runner], None]] = {
    "mesh-error-seconds": mesh_error_seconds,
    "step-error": step_error,
    "adaptive-steps": adaptive_steps,
    "wave-error": wave_error,
    "vessel-error-seconds": vessel_error_seconds,
    "beat-step-error": beat_step_error,
}


def keep(name: str, origin: str, columns: Sequence[str], rows: Rows) -> None:
    write_table(
        DATA / f"{name}.csv", f"made by scripts/evidence/error_tables.py BIN WORK {name}\n{origin}", columns, rows
    )
    print(DATA / f"{name}.csv", flush=True)


def main(words: List[str]) -> int:
    wanted = words[2:] or list(TABLES)
    if len(words) < 2 or words[0].startswith("-") or not set(wanted) <= set(TABLES):
        print(__doc__, file=sys.stderr)
        return 1
    runner = Runner(Path(words[0]).resolve(), Path(words[1]).resolve())
    for name in wanted:
        TABLES[name](runner)
    return 0


def fail(text: str) -> NoReturn:
    print(f"error_tables: error: {text[:1000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
