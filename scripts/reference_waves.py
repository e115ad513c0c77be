"""Makes the reference of the accuracy-cost study, compare/studies/references/MATERIAL/: centre-line pressure and wall
displacement of the artery as a body of revolution, extrapolated in time step and element size from several runs of
axisymmetric_wave (cmake --build --preset release --target benchmarks). About ten minutes.

usage: python3 scripts/reference_waves.py BIN_DIR WORK_DIR MATERIAL...
"""

import json
import math
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np

TOP = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TOP / "compare"))

from fsi_compare.studies.evidence.mesh_error import physical  # noqa: E402
from fsi_compare.studies.evidence.waves import QUANTITIES, Waves, extrapolated  # noqa: E402
from fsi_compare.studies.evidence.waves import read_waves, relative_difference  # noqa: E402

STABILISATION = 0.05
REFINEMENT = 4  # cells of 0.125 mm along, 0.09 mm across the fluid, 0.03 mm across the wall
STEPS = (0.00390625, 0.0078125, 0.015625, 0.03125)  # ms, the finest first
SPACE = (8, 4, 2)  # refinements, all with SPACE_STEP
SPACE_STEP = 0.125  # ms
TIMES = [1.5 + 0.5 * i for i in range(16)]  # ms, kept in the files


def runs(programs: Path, work: Path, material: str):
    """(refinement, step) -> quantity's column -> waves; makes what is not there."""
    found = {}
    for refinement, step in [*((REFINEMENT, step) for step in STEPS), *((r, SPACE_STEP) for r in SPACE)]:
        files = [work / f"{material}-{refinement}-{step}{end}.csv" for end in ("", "-wall")]
        done = files[0].with_suffix(".done")
        if not done.exists():
            subprocess.run(
                [
                    programs / "axisymmetric_wave",
                    material,
                    str(refinement),
                    files[0],
                    str(step),
                    str(STABILISATION),
                    files[1],
                ],
                check=True,
            )
            done.touch()
        found[refinement, step] = {q.column: read_waves(file, q.column) for q, file in zip(QUANTITIES, files)}
    return found


def reference(found, column: str):
    """The extrapolated waves and an estimate of their relative error."""
    solutions = [found[REFINEMENT, step][column] for step in STEPS]
    # The scheme is of first order, but the pulse excites frequencies that none of the steps resolves, so that the
    # observed order is lower; removing dt and dt^2 leaves little of what is resolved.
    in_time, earlier = romberg(*solutions[:3]), romberg(*solutions[1:])
    fine, middle, coarse = (found[r, SPACE_STEP][column] for r in SPACE)
    # What refinement 4 lacks, by second order from 8; its dependence on the time step is one order smaller.
    correction = Waves(np.array(TIMES), fine.z, 4 / 3 * (fine.at(TIMES, fine.z) - middle.at(TIMES, fine.z)))
    kept = Waves(correction.times, fine.z, in_time.at(TIMES, fine.z) + correction.values)
    left_in_time = relative_difference(earlier, in_time, TIMES)  # of the extrapolation one step coarser: an upper bound
    # Second order may be 3/2 (1/(1 - 2^-1.5) in place of 4/3), and the correction differ by a quarter at small steps.
    size = relative_difference(fine, middle, TIMES) * 4 / 3
    left_in_space = size * (1 / (1 - 2**-1.5) / (4 / 3) - 1 + 0.25)
    facts = {
        "space_order": order(fine, middle, coarse),
        "time_order": order(*solutions[:3]),
        "left_in_time": left_in_time,
        "left_in_space": left_in_space,
    }
    return kept, left_in_time + left_in_space, facts


def romberg(fine: Waves, middle: Waves, coarse: Waves) -> Waves:
    """Steps k, 2k, 4k: without the terms in k and k^2."""
    return extrapolated(extrapolated(fine, middle, 1), extrapolated(middle, coarse, 1), 1 / 3)


def order(fine: Waves, middle: Waves, coarse: Waves) -> float:
    return math.log2(relative_difference(coarse, middle, TIMES) / relative_difference(middle, fine, TIMES))


def write(folder: Path, material: str, found) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    own_error, facts = {}, {}
    for quantity in QUANTITIES:
        waves, own_error[quantity.column], facts[quantity.column] = reference(found, quantity.column)
        with open(folder / quantity.file, "w", encoding="utf-8") as file:
            file.write(f"time_ms,z_mm,{quantity.column}\n")
            for time, row in zip(waves.times, waves.values):
                file.writelines(f"{time:g},{z:g},{value:.6g}\n" for z, value in zip(waves.z, row))
    description = (
        f"the artery as a body of revolution ({material}), linear triangles, stabilisation {STABILISATION}: "
        f"time steps of 1/256, 1/128 and 1/64 ms extrapolated to zero, "
        f"grids of {36 * SPACE[1]} and {36 * SPACE[0]} cells along the axis extrapolated by second order"
    )
    with open(folder / "reference.json", "w", encoding="utf-8") as file:
        case = tomllib.loads((TOP / "meshes" / "artery" / f"{material}.toml").read_text(encoding="utf-8"))
        data = {"description": description, "case": physical(case), "own_error": own_error, "estimates": facts}
        json.dump(data, file, indent=1)
        file.write("\n")
    print(material, json.dumps(own_error), json.dumps(facts))


def main(words) -> int:
    if len(words) < 3:
        print(__doc__, file=sys.stderr)
        return 1
    programs, work = Path(words[0]), Path(words[1])
    work.mkdir(parents=True, exist_ok=True)
    for material in words[2:]:
        write(TOP / "compare/studies/references" / material, material, runs(programs, work, material))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
