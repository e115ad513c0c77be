"""Makes the references that fsi-compare judges waves by, from runs of fsi-monolithic on the artery as an axisymmetric
scene (meshes/artery/axisymmetric), quadratic elements, a wall pressure that may jump between the layers:

  compare/studies/references/MATERIAL         time step to 0: the error of mesh and step
  compare/studies/references/MATERIAL-space   time step 0.125 ms, as the paper's cases: the error of the mesh alone

usage: python3 scripts/reference_waves.py [--jobs N] BIN_DIR WORK_DIR MATERIAL...

WORK_DIR keeps the runs; those that are there are not made again. About three minutes of one idle core a material.
"""

import json
import math
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Dict, List

import numpy as np

TOP = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TOP / "compare"))

from fsi_compare.studies.accuracy.observed_order import self_convergence  # noqa: E402
from fsi_compare.studies.evidence.mesh_error import physical  # noqa: E402
from fsi_compare.studies.evidence.waves import QUANTITIES, Waves, extrapolated  # noqa: E402
from fsi_compare.studies.evidence.waves import norm, read_waves, relative_difference  # noqa: E402

# Cells through lumen, media, adventitia, and along the axis: each grid halves the cells of the one before.
GRIDS = {"coarse": (3, 1, 1, 48), "middle": (6, 2, 2, 96), "fine": (12, 4, 4, 192)}
GRADINGS = ("--lumen-grading", "3", "--axial-grading", "4")  # one grading: the grids are refinements of each other
SPACE_STEP = 0.125  # ms: all grids
STEPS = (1 / 256, 1 / 128, 1 / 64, 1 / 32)  # ms: the middle grid
BANDS = (0, 4, 8, 12, 16, 20, 25, 30, 40, 60)  # first wave numbers: half waves in the tube's length
TRUSTED = (0.6, 1.5)  # observed orders in time that are near enough to the scheme's, 1, for an extrapolation
LOWEST = 0.3  # order by which the error of a band is estimated whose solutions hardly converge
TIMES = [1.5 + 0.5 * i for i in range(16)]  # ms, kept in the files
SETTINGS = (f"time.end={TIMES[-1]}", "monolithic.newton_tolerance=1e-6", "output.every=0", "output.checkpoint_every=0")


def mesh(programs: Path, work: Path, grid: str) -> Path:
    file = work / f"{grid}.msh"
    if not file.exists():
        counts = ("--lumen-cells", "--media-cells", "--adventitia-cells", "--axial-cells")
        numbers = [word for pair in zip(counts, map(str, GRIDS[grid])) for word in pair]
        command = [str(programs / "fsi-mesh"), "artery", "--axisymmetric", "--order", "2", *numbers, *GRADINGS, "-q"]
        subprocess.run([*command, "-o", str(file)], check=True)
    return file


def run(programs: Path, work: Path, material: str, grid: str, step: float) -> Path:
    """The result folder; made if it is not there."""
    folder = work / f"{material}-{grid}-{step:g}"
    if not (folder / "done").exists():
        settings = (*SETTINGS, f"time.step={step}", f"mesh.file={mesh(programs, work, grid)}")
        words = [word for setting in settings for word in ("--set", setting)]
        case = TOP / "meshes" / "artery" / "axisymmetric" / f"{material}.toml"
        subprocess.run(
            [programs / "fsi-monolithic", case, "-o", folder, "--force", "-q", "--threads", "1", *words], check=True
        )
        (folder / "done").touch()
    return folder


def needed():
    """(grid, step) of all runs, the longest first."""
    return [*(("middle", step) for step in STEPS), *((grid, SPACE_STEP) for grid in reversed(GRIDS))]


def runs(programs: Path, work: Path, material: str, jobs: int):
    """(grid, step) -> quantity's column -> waves."""
    for grid in GRIDS:
        mesh(programs, work, grid)
    with ThreadPoolExecutor(jobs) as pool:
        folders = list(pool.map(lambda one: run(programs, work, material, *one), needed()))
    return {
        one: {q.column: read_waves(folder / q.file, q.column) for q in QUANTITIES}
        for one, folder in zip(needed(), folders)
    }


def apart(one: Waves, other: Waves, unit: Waves) -> float:
    """L2 over z and the times kept, in units of the last waves' norm."""
    values = [waves.at(TIMES, unit.z) for waves in (one, other, unit)]
    return norm(unit.z, values[0] - values[1]) / norm(unit.z, values[2])


def converged(finest_first):
    """Extrapolation of three solutions whose sizes halve, by the order that they show, and the facts behind it."""
    fine, middle, coarse = finest_first
    distances = [apart(coarse, middle, fine), apart(middle, fine, fine)]
    found = self_convergence((4, 2, 1), distances)
    left = distances[1] if found.remaining is None else found.remaining
    facts: Dict[str, Any] = {"differences": distances, "order": found.order, "left": left}
    if found.order is None or found.order < LOWEST:  # nothing to go by
        return fine, facts
    return extrapolated(fine, middle, 1 / (2**found.order - 1)), facts


def spectrum(waves: Waves) -> np.ndarray:
    """(times, wave number) of the waves continued evenly beyond both ends of the tube."""
    values = waves.at(TIMES, waves.z)
    return np.fft.rfft(np.concatenate([values, values[:, -2:0:-1]], axis=1), axis=1)


def size(spectra: np.ndarray) -> float:
    return float(np.sqrt(np.sum(np.abs(spectra) ** 2)))


def converged_in_time(solutions):
    """Four solutions, the finest step first, extrapolated band of wavelengths by band, with an estimate of the relative
    error and the facts behind it. The pulse excites short waves that none of the steps resolves: they keep the order of
    the whole below the scheme's, while the long ones show it. A band whose order is not near the scheme's is left as it
    is; what it lacks is estimated by its own order."""
    length = solutions[0].z[-1] - solutions[0].z[0]
    fine, middle, coarse, coarsest = (spectrum(waves) for waves in solutions)
    kept, unit, left = fine.copy(), size(fine), 0.0
    bands: List[Dict[str, Any]] = []
    for first, end in zip(BANDS, (*BANDS[1:], fine.shape[1])):
        f, m, c, cc = (one[:, first:end] for one in (fine, middle, coarse, coarsest))
        differences = [size(c - m) / unit, size(m - f) / unit]
        found = self_convergence((4, 2, 1), differences)
        order = found.order or 0.0
        trusted = TRUSTED[0] <= order <= TRUSTED[1]
        if trusted:
            earlier = self_convergence((4, 2, 1), [size(cc - c), size(c - m)]).order or 0.0
            before = m + (m - c) / (2 ** (earlier if earlier >= TRUSTED[0] else order) - 1)  # the same, a step coarser
            kept[:, first:end] = f + (f - m) / (2**order - 1)
            own = size(kept[:, first:end] - before) / unit
        else:
            own = differences[1] / (2 ** max(order, LOWEST) - 1)
        left += own**2
        wavelength = [2 * length / k if k else None for k in (first, end)]
        known = {"wavelengths_mm": wavelength, "differences": differences, "order": found.order, "left": own}
        bands.append({**known, "extrapolated": trusted})
    z = solutions[0].z
    values = np.fft.irfft(kept, n=2 * (len(z) - 1), axis=1)[:, : len(z)]
    return Waves(np.array(TIMES), z, values), math.sqrt(left), bands


def reference(found, column: str):
    """The waves with step and grid to zero, an estimate of their relative error, and the facts behind it."""
    in_time, left_in_time, bands = converged_in_time([found["middle", step][column] for step in STEPS])
    space, space_facts = converged([found[grid, SPACE_STEP][column] for grid in reversed(GRIDS)])
    # What the middle grid lacks, at a larger step.
    lacking = found["middle", SPACE_STEP][column]
    correction = space.at(TIMES, space.z) - lacking.at(TIMES, space.z)
    kept = Waves(np.array(TIMES), space.z, in_time.at(TIMES, space.z) + correction)
    # What the extrapolation added to the finest grid, and half of the correction for its having been found at a larger
    # step, where waves are longer.
    left_in_space = space_facts["left"] + 0.5 * relative_difference(lacking, space, TIMES)
    facts = {"time": bands, "space": space_facts, "left_in_time": left_in_time, "left_in_space": left_in_space}
    return kept, left_in_time + left_in_space, facts


def space_reference(found, column: str):
    """The finest grid's waves at the step of the space study, and the error that its order tells."""
    _, facts = converged([found[grid, SPACE_STEP][column] for grid in reversed(GRIDS)])
    fine = found["fine", SPACE_STEP][column]
    return Waves(np.array(TIMES), fine.z, fine.at(TIMES, fine.z)), facts["left"], facts


def write(name: str, material: str, found, make, description: str, **more) -> None:
    folder = TOP / "compare/studies/references" / name
    folder.mkdir(parents=True, exist_ok=True)
    own_error, facts = {}, {}
    for quantity in QUANTITIES:
        waves, own_error[quantity.column], facts[quantity.column] = make(found, quantity.column)
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
    in_time = ", ".join(f"1/{round(1 / step)}" for step in reversed(STEPS[:3]))
    in_space = f"cells through lumen, media, adventitia and along the axis {', '.join(cells.values())}"
    write(
        material,
        material,
        found,
        reference,
        f"{what}: time steps of {in_time} ms on {cells['middle']} cells extrapolated to zero by the "
        f"observed order of each band of wavelengths that shows the scheme's, and "
        f"what the grid lacks, from {in_space} at {SPACE_STEP} ms",
    )
    write(
        f"{material}-space",
        material,
        found,
        space_reference,
        f"{what}: the finest of {in_space}, at {SPACE_STEP} ms",
        step_ms=SPACE_STEP,
    )


def main(words) -> int:
    jobs = 1
    if words[:1] == ["--jobs"] and len(words) > 1:
        jobs, words = int(words[1]), words[2:]
    if len(words) < 3:
        print(__doc__, file=sys.stderr)
        return 1
    programs, work = Path(words[0]), Path(words[1]).resolve()
    work.mkdir(parents=True, exist_ok=True)
    for material in words[2:]:
        write_both(material, runs(programs, work, material, jobs))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
