"""Makes the references that fsi-compare judges waves by, from runs of fsi-monolithic on the artery as an axisymmetric
scene (meshes/artery/axisymmetric), quadratic elements, a wall pressure that may jump between the layers:

  compare/research/studies/references/MATERIAL         step and mesh to 0: the error of mesh and step
  compare/research/studies/references/MATERIAL-space   time step 0.125 ms, as the paper's cases: the error of the mesh alone

usage: python3 scripts/evidence/reference_waves.py [--jobs N] BIN_DIR WORK_DIR MATERIAL...

WORK_DIR keeps the runs; those that are there are not made again. Three to five minutes of one idle core a material,
the neo-Hookean one first.
"""

import json
import os
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Dict, NamedTuple, Sequence

import numpy as np

TOP = Path(__file__).resolve().parents[2]
REFERENCES = TOP / "compare/research/studies/references"
sys.path[:0] = [str(TOP / "compare"), str(TOP / "compare/research")]

from fsi_compare.base.errors import InputError, printable  # noqa: E402
from fsi_research.catalogue.names import MATERIALS  # noqa: E402
from fsi_research.accuracy.observed_order import self_convergence  # noqa: E402
from fsi_research.evidence.mesh_error import physical  # noqa: E402
from fsi_compare.runs.waves import QUANTITIES, Waves, norm, read_run  # noqa: E402


def extrapolated(fine: Waves, coarse: Waves, factor: float) -> Waves:
    """fine + factor (fine - coarse), point by point, at the times of the coarse waves that both have; factor 1 removes
    a first-order error between a step and its half, 1/3 a second-order one."""
    times = np.array([t for t in coarse.times if np.min(np.abs(fine.times - t)) <= 1e-6])
    values = fine.at(times, fine.z)
    return Waves(times, fine.z, values + factor * (values - coarse.at(times, fine.z)))


class Run(NamedTuple):
    grid: str
    scheme: str
    step: float  # ms


# Cells through lumen, media, adventitia, and along the axis: each grid halves the cells of the one before.
GRIDS = {"coarse": (3, 1, 1, 48), "middle": (6, 2, 2, 96), "fine": (12, 4, 4, 192)}
SIZES = (1, 2, 4)  # of the cells of the grids, the finest first
GRADINGS = ("--lumen-grading", "3", "--axial-grading", "4")  # one grading: the grids are refinements of each other
SCHEME = "midpoint"
STEPS = (1 / 128, 1 / 64, 1 / 32)  # ms: the middle grid
SPACE_STEP = 1 / 64  # ms: all grids
CHECKED = "neo-hookean"  # the material, made first, with which is seen how much grids' differences depend on the step:
CHECK_STEPS = (1 / 32, SPACE_STEP)  # ms: middle and fine grid
CASE = ("euler", 0.125)  # the paper's scheme and step: for the error of the mesh alone
ORDERS = (1.0, 4.0)  # observed orders that are taken for an extrapolation
LOWEST = 0.5  # order by which the error is estimated of solutions that hardly converge
TIMES = [1.5 + 0.5 * i for i in range(16)]  # ms, kept in the files
END = 9.375  # ms: half of the averaged pressure's window after the last of them
SETTINGS = (f"time.end={END}", "newton.tolerance=1e-4", "output.every=0", "output.checkpoint_every=0")


def mesh(programs: Path, work: Path, grid: str) -> Path:
    file = work / f"{grid}.msh"
    if not file.exists():
        counts = ("--lumen-cells", "--media-cells", "--adventitia-cells", "--axial-cells")
        numbers = [word for pair in zip(counts, map(str, GRIDS[grid])) for word in pair]
        command = [str(programs / "fsi-mesh"), "artery", "--axisymmetric", "--order", "2", *numbers, *GRADINGS, "-q"]
        subprocess.run([*command, "-o", str(file)], check=True)
    return file


def run(programs: Path, work: Path, material: str, one: Run) -> Path:
    """The result folder; made if it is not there."""
    folder = work / f"{material}-{one.grid}-{one.scheme}-{one.step:g}"
    if not (folder / "done").exists():
        scheme = (f'time.scheme="{one.scheme}"', f"time.step={one.step}")
        settings = (*SETTINGS, *scheme, f"mesh.file={mesh(programs, work, one.grid)}")
        words = [word for setting in settings for word in ("--set", setting)]
        case = TOP / "meshes" / "artery" / "axisymmetric" / f"{material}.toml"
        subprocess.run(
            [programs / "fsi-monolithic", case, "-o", folder, "--force", "-q", "--threads", "1", *words], check=True
        )
        (folder / "done").touch()
    return folder


def in_space(scheme: str, step: float):
    """The runs on all grids, the finest first."""
    return [Run(grid, scheme, step) for grid in reversed(GRIDS)]


def in_time():
    """The runs with all steps, the finest first."""
    return [Run("middle", SCHEME, step) for step in STEPS]


def check(material: str):
    """Fine and middle grid at both steps."""
    return [Run(grid, SCHEME, step) for grid in ("fine", "middle") for step in CHECK_STEPS if material == CHECKED]


def needed(material: str):
    """All runs, the longest first."""
    return list(dict.fromkeys([*in_space(SCHEME, SPACE_STEP), *in_time(), *check(material), *in_space(*CASE)]))


def runs(programs: Path, work: Path, material: str, jobs: int):
    """Run -> quantity's column -> waves."""
    for grid in GRIDS:
        mesh(programs, work, grid)
    with ThreadPoolExecutor(jobs) as pool:
        folders = list(pool.map(lambda one: run(programs, work, material, one), needed(material)))
    return {one: read_run(folder, TIMES) for one, folder in zip(needed(material), folders)}


def apart(one: Waves, other: Waves, unit: Waves) -> float:
    """L2 over z and the times kept, in units of the last waves' norm."""
    values = [waves.at(TIMES, unit.z) for waves in (one, other, unit)]
    return norm(unit.z, values[0] - values[1]) / norm(unit.z, values[2])


def kept_levels(waves: Waves) -> Waves:
    return Waves(np.array(TIMES), waves.z, waves.at(TIMES, waves.z))


def converged(finest_first: Sequence[Waves], sizes: Sequence[float]):
    """Extrapolation of three solutions by the order that they show, and the facts behind it. What is left is at most
    about what the extrapolation added."""
    fine, middle, coarse = (kept_levels(waves) for waves in finest_first)
    distances = [apart(coarse, middle, fine), apart(middle, fine, fine)]
    order = self_convergence(sizes[::-1], distances).order
    facts: Dict[str, Any] = {"differences": distances, "order": order, "extrapolated": True}
    if order is None or not ORDERS[0] <= order <= ORDERS[1]:  # nothing to go by
        facts["extrapolated"] = False
        facts["left"] = distances[1] / ((sizes[1] / sizes[0]) ** max(order or 0.0, LOWEST) - 1)
        return fine, facts
    best = extrapolated(fine, middle, 1 / ((sizes[1] / sizes[0]) ** order - 1))
    facts["left"] = apart(best, fine, best)
    return best, facts


def reference(material: str, found, column: str):
    """The waves with step and grid to zero, an estimate of their relative error, and the facts behind it."""
    time, time_facts = converged([found[one][column] for one in in_time()], STEPS)
    on_grids = [found[one][column] for one in in_space(SCHEME, SPACE_STEP)]
    space, space_facts = converged(on_grids, SIZES)
    middle = on_grids[1]
    z = space.z
    kept = Waves(np.array(TIMES), z, time.at(TIMES, z) + space.values - middle.at(TIMES, z))
    change = change_with_step(material, found, column, kept)
    # The correction for the grid was found at a step that is not zero. Of second order, it lacks a third of its change
    # from the step twice as long.
    left = {"left_in_time": time_facts["left"], "left_in_space": space_facts["left"], "left_of_both": change / 3}
    return kept, sum(left.values()), {"time": time_facts, "space": space_facts, "change_with_step": change, **left}


def change_with_step(material: str, found, column: str, kept: Waves) -> float:
    """Of the difference between fine and middle grid, relative to the waves; other materials take the checked one's."""
    if material != CHECKED:
        path = REFERENCES / CHECKED / "reference.json"
        return float(json.loads(path.read_text(encoding="utf-8"))["estimates"][column]["change_with_step"])
    one, other = (
        found[Run("fine", SCHEME, step)][column].at(TIMES, kept.z)
        - found[Run("middle", SCHEME, step)][column].at(TIMES, kept.z)
        for step in CHECK_STEPS
    )
    return norm(kept.z, one - other) / norm(kept.z, kept.values)


def space_reference(_: str, found, column: str):
    """The finest grid's waves at the step of the space study, and the error that its order tells."""
    solutions = [found[one][column] for one in in_space(*CASE)]
    _, facts = converged(solutions, SIZES)
    return kept_levels(solutions[0]), facts["left"], facts


def write(name: str, material: str, found, make, description: str, **more) -> None:
    folder = REFERENCES / name
    folder.mkdir(parents=True, exist_ok=True)
    own_error, facts = {}, {}
    for quantity in QUANTITIES:
        waves, own_error[quantity.column], facts[quantity.column] = make(material, found, quantity.column)
        with open(folder / quantity.file, "w", encoding="utf-8") as file:
            file.write(f"time_ms,z_mm,{quantity.column}\n")
            for time, row in zip(waves.times, waves.values):
                file.writelines(f"{time:g},{z:g},{value:.6g}\n" for z, value in zip(waves.z, row))
    with open(folder / "reference.json", "w", encoding="utf-8") as file:
        case = tomllib.loads((TOP / "meshes" / "artery" / f"{material}.toml").read_text(encoding="utf-8"))
        data = {"description": description, "case": physical(case), "own_error": own_error, "estimates": facts, **more}
        json.dump(data, file, indent=1)
        file.write("\n")
    print(name, json.dumps(own_error), json.dumps(facts))


def write_both(material: str, found) -> None:
    what = f"the artery as an axisymmetric scene ({material}), p2p1, wall pressure separate in each layer"
    cells = {name: "-".join(map(str, counts)) for name, counts in GRIDS.items()}
    steps = ", ".join(f"1/{round(1 / step)}" for step in reversed(STEPS))
    grids = f"cells through lumen, media, adventitia and along the axis {', '.join(cells.values())}"
    write(
        material,
        material,
        found,
        reference,
        f"{what}: midpoint rule, steps of {steps} ms on {cells['middle']} cells extrapolated to zero by the observed "
        f"order, and what the grid lacks, extrapolated by the observed order from {grids} at 1/{round(1 / SPACE_STEP)} ms",
    )
    write(
        f"{material}-space",
        material,
        found,
        space_reference,
        f"{what}: the finest of {grids}, at {CASE[1]} ms by backward Euler",
        step_ms=CASE[1],
    )


def main(words) -> int:
    jobs = 1
    if words[:1] == ["--jobs"] and len(words) > 1:
        if not words[1].isdecimal() or not 0 < int(words[1]) < 1000:
            return fail(f"--jobs: {words[1]} is no number of runs at once; give 1 or more")
        jobs, words = int(words[1]), words[2:]
    if len(words) < 3:
        print(__doc__, file=sys.stderr)
        return 1
    programs, work = Path(words[0]), Path(os.path.realpath(words[1]))
    for name in ("fsi-mesh", "fsi-monolithic"):
        if not os.access(programs / name, os.X_OK):
            return fail(f"{programs}: there is no {name} in it; give the folder of the programs")
    for material in words[2:]:
        if material not in MATERIALS:
            return fail(f"MATERIAL: '{material}' is unknown; give some of {', '.join(MATERIALS)}")
    try:
        work.mkdir(parents=True, exist_ok=True)
        for material in words[2:]:
            write_both(material, runs(programs, work, material, jobs))
    except InputError as error:
        return fail(str(error))
    except OSError as error:
        return fail(f"{error.filename}: {error.strerror}; name another folder, or mend its permissions")
    except subprocess.CalledProcessError as error:
        return fail(f"{error.cmd[0]}: ended with code {error.returncode}; see its message")
    except KeyboardInterrupt:
        print("reference_waves: interrupted; finished runs are kept", file=sys.stderr)
        return 130
    return 0


def fail(text: str) -> int:
    print(f"reference_waves: error: {printable(text)}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
