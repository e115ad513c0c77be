"""Draws the picture on README's first screen: the pressure wave of the artery by each kind of coupling, beside the seconds that each
takes at equal error of the solver (scripts/evidence/coupling_kinds.py). The numbers lie in docs/data.

usage: python3 scripts/evidence/readme_picture.py [-o FILE.png]
       python3 scripts/evidence/readme_picture.py --measure BIN WORK
  -o FILE.png          where the picture goes; docs/pictures/artery-both-drivers.png unless given
  --measure BIN WORK   makes the numbers of the wave anew, and the error that a run leaves for its seconds by mesh and step
                       (docs/guide/accuracy.md), with the programs of BIN (build/release/bin); WORK keeps meshes and runs. Minutes.
"""

import csv
import sys
from pathlib import Path
from typing import Any, Dict, Iterator, List, NamedTuple, NoReturn, Tuple

from coupling_kinds import BY_ERROR, METHODS
from kept_blocks import BlockError, kinds
from kept_tables import read_table
from timed_call import CallError, processor_seconds

TOP = Path(__file__).resolve().parents[2]
DATA = TOP / "docs/data"
WAVE, ERRORS = DATA / "artery-wave.csv", DATA / "artery-error-seconds.csv"
SECONDS = DATA / "coupling-kinds.csv"
COLORS = {"monolithic": "#222222", "interface": "#e08a1e", "block": "#4a90c8"}
PICTURE = TOP / "docs/pictures/artery-both-drivers.png"
CASE = "meshes/artery/axisymmetric/neo-hookean.toml"
REFERENCE = "compare/research/studies/references/neo-hookean"  # step and mesh extrapolated to zero
KINDS = {  # the driver, and what a case names
    "monolithic": ("fsi-monolithic", ()),
    "interface": ("fsi-partitioned", ()),
    "block": ("fsi-partitioned", ('partitioned.scheme="block-newton"',)),
}
WAVE_TIMES = (1.5, 3.0, 6.0)  # ms
WAVE_MESH, WAVE_STEP = "p2p1-6-2-2-96", 1 / 32
END = 6.375  # ms: the last of the times, and half of the averaged pressure's window
QUICK_ENOUGH = 10.0  # s: shorter runs are made three times, and the least seconds count
TIMINGS = 3


class Rung(NamedTuple):
    """A mesh and the step that goes with it: both are refined together."""

    element: str
    cells: str  # through lumen, media and adventitia, and along the axis
    gradings: Tuple[str, str]  # of lumen and axis
    step: float  # ms


LADDERS = (
    Rung("p1", "6-2-2-72", ("2", "4"), 1 / 16),
    Rung("p1", "12-4-3-144", ("2", "4"), 1 / 32),
    Rung("p1", "24-8-6-288", ("2", "4"), 1 / 64),
    Rung("p2p1", "4-1-1-96", ("2", "4"), 1 / 16),
    Rung("p2p1", "6-2-2-96", ("3", "4"), 1 / 32),
    Rung("p2p1", "9-3-3-144", ("3", "4"), 1 / 64),
)
# What drivers take by themselves in fixed steps. What solving leaves is then alike (docs/guide/coupling.md), and far below what mesh and step leave.
TOLERANCES = {"fsi-monolithic": BY_ERROR, "fsi-partitioned": (f"partitioned.tolerance={METHODS[0].tolerance:g}",)}

RUN = f"PROGRAM {CASE} --threads 1 --set mesh.file=MESH --set 'time.scheme=\"midpoint\"' --set time.end={END}"
BLOCK = "kind `block`: --set 'partitioned.scheme=\"block-newton\"'; `interface`: what fsi-partitioned chooses"
WAVE_ORIGIN = f"""made by scripts/evidence/readme_picture.py --measure: centre-line pressure by each kind, tolerances of the case file
{RUN} --set time.step={WAVE_STEP}
{BLOCK}
MESH: the axisymmetric p2p1 mesh of 6-2-2-96 cells of artery-error-seconds.csv"""
ERRORS_ORIGIN = f"""made by scripts/evidence/readme_picture.py --measure: error of wall displacement or averaged pressure, the larger one
{RUN} --set 'element="ELEMENT"' --set time.step=STEP
  and --set {' --set '.join(TOLERANCES['fsi-monolithic'])}, or --set {TOLERANCES['fsi-partitioned'][0]}
{BLOCK}
fsi-compare accuracy {REFERENCE} DIR: mean of the relative L2 norms at 1.5, 3, 4.5 and 6 ms
MESH: fsi-mesh artery --axisymmetric --order 1 (p1) or 2 (p2p1), cells through lumen, media, adventitia and along the axis
processor_s: user and system time; of runs shorter than {QUICK_ENOUGH:g} s the least of {TIMINGS}"""


# ---- the numbers ----


def measure(programs: Path, work: Path) -> None:
    work.mkdir(parents=True, exist_ok=True)
    rows = []
    for rung in LADDERS:
        for found in _errors_and_seconds(programs, work, rung):
            rows.append(found)
            print(" ".join(found), flush=True)
    header = ("element", "kind", "cells", "nodes", "step_ms", "error_percent", "processor_s")
    _write(ERRORS, ERRORS_ORIGIN, header, rows)
    _write(WAVE, WAVE_ORIGIN, ("time_ms", "z_mm", *(f"{kind}_Pa" for kind in KINDS)), _wave(programs, work))


def _errors_and_seconds(programs: Path, work: Path, rung: Rung) -> Iterator[Tuple[str, ...]]:
    """By each kind, which take turns: the larger one of the errors of wall displacement and averaged pressure, relative L2 norms
    along the tube, each the mean over the times that fsi-compare accuracy takes; and user and system time of the run.
    """
    seconds: Dict[str, List[float]] = {kind: [] for kind in KINDS}
    for _ in range(TIMINGS):
        for kind, taken in seconds.items():
            if not taken or taken[0] < QUICK_ENOUGH:
                settings = [f'element="{rung.element}"', f"time.step={rung.step}", *TOLERANCES[KINDS[kind][0]]]
                taken.append(_run(programs, work, rung, kind, settings, _folder(work, rung, kind)))
    for kind, taken in seconds.items():
        folder = _folder(work, rung, kind)
        _call([programs / "fsi-compare", "accuracy", TOP / REFERENCE, folder, "-o", folder / "errors", "-q"])
        found = _read(folder / "errors/accuracy.csv")
        largest = max(
            sum(float(row[column]) for row in found) / len(found)
            for column in ("radial_relative_L2", "averaged_pressure_relative_L2")
        )
        nodes = found[0]["nodes"]
        yield (rung.element, kind, rung.cells, nodes, f"{rung.step:g}", f"{100 * largest:.3g}", f"{min(taken):.3g}")


def _folder(work: Path, rung: Rung, kind: str) -> Path:
    return work / f"{rung.element}-{rung.cells}-{kind}"


def _wave(programs: Path, work: Path) -> List[Tuple[str, ...]]:
    """The centre-line pressure with the tolerances of the case file, at which the kinds agree to solver tolerance."""
    rung = next(rung for rung in LADDERS if f"{rung.element}-{rung.cells}" == WAVE_MESH)
    waves: List[Dict[Tuple[float, str], str]] = []
    for kind in KINDS:
        folder = work / f"wave-{kind}"
        _run(programs, work, rung, kind, [f"time.step={WAVE_STEP}"], folder)
        rows = _read(folder / "centerline_pressure.csv")
        waves.append({(float(r["time_ms"]), r["z_mm"]): r["pressure_Pa"] for r in rows})
    return [
        (f"{time:g}", z, *(f"{float(wave[time, z]):.6g}" for wave in waves))
        for time, z in waves[0]
        if time in WAVE_TIMES
    ]


def _run(programs: Path, work: Path, rung: Rung, kind: str, settings: List[str], folder: Path) -> float:
    mesh = work / f"{rung.element}-{rung.cells}.msh"
    if not mesh.exists():
        names = ("--lumen-cells", "--media-cells", "--adventitia-cells", "--axial-cells")
        counts = [word for pair in zip(names, rung.cells.split("-")) for word in pair]
        gradings = ["--lumen-grading", rung.gradings[0], "--axial-grading", rung.gradings[1]]
        order = "2" if rung.element == "p2p1" else "1"
        _call(
            [programs / "fsi-mesh", "artery", "--axisymmetric", "--order", order, *counts, *gradings, "-q", "-o", mesh]
        )
    common = [f'mesh.file="{mesh.resolve()}"', 'time.scheme="midpoint"', f"time.end={END}"]
    silent = ["output.every=0", "output.checkpoint_every=0"]
    program, named = KINDS[kind]
    words: List[object] = [programs / program, TOP / CASE, "-o", folder, "--force", "-q", "--threads", "1"]
    for setting in [*common, *silent, *settings, *named]:
        words += ["--set", setting]
    return _call(words)


def _call(words: List[object]) -> float:
    try:
        return processor_seconds(words)
    except CallError as error:
        fail(str(error))


# ---- the picture ----


def draw(picture: Path) -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib.figure import Figure

    style: Dict[str, Any] = {
        "font.family": ["DejaVu Sans"],
        "font.size": 12,
        "axes.titlesize": 13,
        "legend.frameon": False,
    }
    frame: Dict[str, Any] = {
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "grid.color": "#dddddd",
    }
    with matplotlib.rc_context({**style, **frame, "axes.axisbelow": True, "legend.handlelength": 3.0}):
        figure = Figure(figsize=(12, 5), layout="constrained")
        left, right = figure.subplots(1, 2)
        _draw_wave(left)
        _draw_seconds(right)
        figure.savefig(picture, dpi=150, metadata={"Software": None})
    print(picture)


def _draw_wave(axes) -> None:
    """Thick below thin, so that three waves on one line are seen."""
    rows = _read(WAVE)
    looks: Dict[str, Dict[str, Any]] = {
        "monolithic": {"color": COLORS["monolithic"], "linewidth": 5},
        "interface": {"color": COLORS["interface"], "linewidth": 2.2},
        "block": {"color": COLORS["block"], "linewidth": 2.2, "linestyle": (0, (2, 3))},
    }
    for time in WAVE_TIMES:
        wave = [row for row in rows if float(row["time_ms"]) == time]
        z = [float(row["z_mm"]) for row in wave]
        for kind, look in looks.items():
            pressure = [float(row[f"{kind}_Pa"]) for row in wave]
            axes.plot(z, pressure, label=kind if time == WAVE_TIMES[0] else None, **look)
        top = max(range(len(z)), key=pressure.__getitem__)
        axes.annotate(f"{time:g} ms", (z[top], pressure[top]), (7, 3), textcoords="offset points")
    axes.set(title="A pressure wave, by three kinds of coupling", xlabel="z along the artery, mm")
    axes.set(ylabel="pressure on the centre line, Pa", xlim=(0, 18))
    axes.margins(y=0.08)
    axes.legend(loc="upper right")


def _draw_seconds(axes) -> None:
    """A pair of bars for each scene at equal error, over the monolithic driver's seconds."""
    try:
        scenes = [scene for scene in kinds(read_table(SECONDS)) if scene.at_equal_error("interface")]
    except (OSError, ValueError, BlockError) as error:
        fail(f"{error}; scripts/evidence/coupling_kinds.py makes the table")
    column = "seconds at equal error"
    scenes.sort(key=lambda scene: -scene.ratio("interface", column))
    for offset, kind in ((0.2, "interface"), (-0.2, "block")):
        equal = [(place, scene) for place, scene in enumerate(scenes) if scene.at_equal_error(kind)]
        places = [place + offset for place, _ in equal]
        ratios = [scene.ratio(kind, column) for _, scene in equal]
        axes.barh(places, ratios, 0.4, color=COLORS[kind], label=kind)
    axes.axvline(1, color=COLORS["monolithic"], linewidth=2.5, label="monolithic")
    axes.set_yticks(range(len(scenes)), [scene.title for scene in scenes], fontsize=8.5)
    axes.set(title="Seconds at equal error of the solver", xlabel="over those of the monolithic driver")
    axes.grid(axis="y", visible=False)
    axes.legend(loc="center right", bbox_to_anchor=(1, 0.68))


# ---- files ----


def _read(path: Path) -> List[Dict[str, str]]:
    try:
        with path.open(encoding="utf-8", newline="") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))
    except OSError as error:
        fail(f"{path}: {error.strerror}; --measure makes it")


def _write(path: Path, origin: str, header: Tuple[str, ...], rows: List[Tuple[str, ...]]) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {line}\n" for line in origin.split("\n"))
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
    print(path)


def main(words: List[str]) -> int:
    if len(words) == 3 and words[0] == "--measure":
        measure(Path(words[1]).resolve(), Path(words[2]).resolve())
    elif not words or (len(words) == 2 and words[0] == "-o"):
        draw(Path(words[1]) if words else PICTURE)
    else:
        print(__doc__, file=sys.stderr)
        return 1
    return 0


def fail(text: str) -> NoReturn:
    line = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)
    print(f"readme_picture: error: {line[:1000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
