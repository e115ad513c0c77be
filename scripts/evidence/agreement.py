"""How far the partitioned driver's answer is from the monolithic one by its interface tolerance, and the crests of three walls.

usage: python3 scripts/evidence/agreement.py BIN WORK    (build/release/bin; WORK keeps runs, so that a stopped one goes on)
The paper's artery, its element, load and steps: docs/data/driver-agreement.csv, docs/data/crest-speeds.csv and the pictures
loose-tolerance and materials-intermediate.
"""

import csv
import json
import shutil
import sys
from pathlib import Path
from typing import Any, Dict, List, NamedTuple, NoReturn, Sequence

from kept_tables import DATA, TOP, write_table
from timed_call import CallError, processor_seconds

PICTURES = TOP / "docs/pictures"
MATERIALS = {"neo-hookean": "neo-Hookean", "mooney-rivlin": "Mooney-Rivlin", "artery": "artery"}
LEVELS = ("coarse", "intermediate")
LOOSE = ("1e-2", "1e-3")  # in the picture

RUN = 'meshes/artery/MATERIAL.toml --set mesh.level="LEVEL" --threads 1'
AGREEMENT_ORIGIN = f"""made by scripts/evidence/agreement.py BIN WORK: coarse mesh, 96 steps, from two runs by fsi-compare pressure
fsi-monolithic and fsi-partitioned {RUN}; of the latter partitioned.scheme, .tolerance and time.predictor
passes a step: outer_iterations of iterations.csv; largest difference: of pressures on the centre line over all points and steps,
relative to the largest pressure of the step"""
CRESTS_ORIGIN = f"""made by scripts/evidence/agreement.py BIN WORK: speed of the crest between 4.5 and 9 ms by fsi-compare pressure, mm/ms
fsi-monolithic {RUN}"""


class Asked(NamedTuple):
    material: str
    scheme: str
    tolerance: str
    predictor: int = 2  # the driver's own

    @property
    def name(self) -> str:
        return f"coarse-{self.material}-{self.scheme}-{self.tolerance}-{self.predictor}"


ROWS = (
    *(Asked(material, "aitken", "1e-9") for material in MATERIALS),
    *(Asked(material, "robin-neumann-inexact", "1e-9") for material in MATERIALS),
    *(
        Asked("neo-hookean", "aitken", tolerance, predictor)
        for tolerance in ("1e-6", "1e-3", "1e-2")
        for predictor in (2, 1)
    ),
)


class Study:
    def __init__(self, programs: Path, work: Path) -> None:
        self.programs = programs
        self.work = work

    def run(self, name: str, program: str, material: str, settings: Sequence[str]) -> Path:
        """The folder of a run, which is made unless it is there."""
        folder = self.work / name
        summary = folder / "summary.json"
        if summary.exists() and json.loads(summary.read_text(encoding="utf-8")).get("status") == "done":
            return folder
        words: List[object] = [self.programs / program, TOP / f"meshes/artery/{material}.toml", "-o", folder]
        words += ["--force", "-q", "--threads", "1", "--set", "output.every=0"]
        for setting in settings:
            words += ["--set", setting]
        call(words)
        return folder

    def monolithic(self, level: str, material: str) -> Path:
        return self.run(f"{level}-{material}", "fsi-monolithic", material, [f'mesh.level="{level}"'])

    def partitioned(self, asked: Asked) -> Path:
        settings = [f'partitioned.scheme="{asked.scheme}"', f"partitioned.tolerance={asked.tolerance}"]
        settings += ['mesh.level="coarse"', f"time.predictor={asked.predictor}"]
        return self.run(asked.name, "fsi-partitioned", asked.material, settings)

    def compared(self, name: str, folders: Sequence[Path], labels: Sequence[str]) -> List[Dict[str, Any]]:
        """What fsi-compare pressure says of each run; its picture lies in `name`."""
        words = [self.programs / "fsi-compare", "pressure", *folders, "-o", self.work / name, "-q"]
        call([*words, "--labels", ",".join(labels)])
        found: List[Dict[str, Any]] = json.loads(
            (self.work / name / "pressure_waves.json").read_text(encoding="utf-8")
        )["runs"]
        return found

    def keep(self, name: str) -> None:
        shutil.copyfile(self.work / name / "pressure_waves.png", PICTURES / f"{name}.png")


def row(study: Study, asked: Asked) -> List[object]:
    folder = study.partitioned(asked)
    folders = [study.monolithic("coarse", asked.material), folder]
    largest = study.compared(f"of-{asked.name}", folders, ("monolithic", "partitioned"))[1]["largest_difference"]
    with (folder / "iterations.csv").open(encoding="utf-8", newline="") as file:
        passes = [int(step["outer_iterations"]) for step in csv.DictReader(file)]
    mean = sum(passes) / len(passes)
    shown = (asked.tolerance, asked.scheme, MATERIALS[asked.material], asked.predictor)
    return [*shown, f"{mean:.1f}", min(passes), max(passes), f"{largest['max_relative']:.1e}"]


def main(words: List[str]) -> int:
    if len(words) != 2 or words[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 1
    study = Study(Path(words[0]).resolve(), Path(words[1]))
    study.work.mkdir(parents=True, exist_ok=True)
    columns = ["interface tolerance", "scheme", "material", "time.predictor"]
    columns += ["passes a step", "least", "most", "largest difference"]
    rows = [row(study, asked) for asked in ROWS]
    loose = [study.partitioned(Asked("neo-hookean", "aitken", tolerance)) for tolerance in LOOSE]
    labels = ("monolithic", *(f"aitken {tolerance}" for tolerance in LOOSE))
    study.compared("loose-tolerance", [study.monolithic("coarse", "neo-hookean"), *loose], labels)
    crests = []
    for level in LEVELS:
        found = study.compared(
            f"materials-{level}",
            [study.monolithic(level, material) for material in MATERIALS],
            list(MATERIALS.values()),
        )
        crests.append([level, *(f"{run['speed_mm_per_ms']:.3f}" for run in found)])
    for name in ("loose-tolerance", "materials-intermediate"):
        study.keep(name)
    write_table(DATA / "driver-agreement.csv", AGREEMENT_ORIGIN, columns, rows)
    write_table(DATA / "crest-speeds.csv", CRESTS_ORIGIN, ("mesh", *MATERIALS.values()), crests)
    return 0


def call(words: Sequence[object]) -> None:
    try:
        processor_seconds(words)
    except CallError as error:
        fail(str(error))


def fail(text: str) -> NoReturn:
    print(f"agreement: error: {text[:1000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
