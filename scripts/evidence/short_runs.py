"""Six short runs whose results stand for those of the programs. docs/data/short-runs.csv keeps what they gave when tables and
pictures were made. Where the programs give other numbers today, the tables and pictures are of other programs.

usage: python3 scripts/evidence/short_runs.py BIN           exit code 1: the programs of BIN give other results
       python3 scripts/evidence/short_runs.py BIN --keep    writes the table anew

Results are compared to 1e-7 of the largest value of a quantity. Another optimisation of the same sources gave 4e-10.
"""

import csv
import hashlib
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Dict, List, NamedTuple, NoReturn, Tuple

from kept_tables import DATA, TOP, read_table, write_table

TABLE = DATA / "short-runs.csv"
ORIGIN = "made by scripts/evidence/short_runs.py BIN --keep: largest absolute value at the end of each run"
ALLOWED = 1e-7
ARTERY = "meshes/artery"
AXISYMMETRIC = "meshes/artery/axisymmetric"
QUARTER = "artery --for p2p1 --error 5% --sector 90"


class Short(NamedTuple):
    """A run of a fraction of a second to a few seconds. Tolerances are tight: what solving leaves must not be seen."""

    name: str
    program: str
    case: str  # below the top
    mesh: str  # words for fsi-mesh; empty: as the case names it
    settings: Tuple[str, ...]


EXACT = ("newton.tolerance=1e-10", "partitioned.tolerance=1e-9", "output.every=0")
RUNS = (
    Short("linear tetrahedra", "fsi-monolithic", f"{ARTERY}/neo-hookean.toml", "", ("time.end=0.5",)),
    Short("interface", "fsi-partitioned", f"{ARTERY}/mooney-rivlin.toml", "", ("time.end=0.5",)),
    Short("fibres", "fsi-monolithic", f"{AXISYMMETRIC}/artery.toml", "", ("time.end=0.5", 'time.scheme="tr-bdf2"')),
    Short(
        "quadratic tetrahedra",
        "fsi-partitioned",
        f"{ARTERY}/neo-hookean.toml",
        QUARTER,
        ('element="p2p1"', 'structure.layer_pressure="separate"', 'partitioned.scheme="block-newton"', "time.end=0.25"),
    ),
    Short(
        "heart beat",
        "fsi-monolithic",
        "gallery/heart-beat/heart-beat.toml",
        "geo gallery/heart-beat/carotid.geo --order 2 --set across=3 --set through=1 --set along=8",
        ("time.end=32", "time.step=8"),
    ),
    Short("static wall", "fsi-monolithic", "compare/research/studies/static-tube.toml", "", ("static.load_steps=4",)),
)


class Value(NamedTuple):
    run: str
    quantity: str
    value: float


class RunError(Exception):
    """A run that did not come to its end."""


def values_of(programs: Path, work: Path) -> List[Value]:
    """Raises RunError."""
    found = []
    for number, short in enumerate(RUNS):
        folder = work / f"run-{number}"
        words = [str(TOP / short.case), "-o", str(folder), "-q", "--threads", "1"]
        for setting in (*EXACT, *short.settings):
            words += ["--set", setting]
        if short.mesh:
            mesh = work / f"mesh-{number}.msh"
            start(programs / "fsi-mesh", [*short.mesh.split(), "-o", str(mesh)])
            words += ["--set", f"mesh.file={mesh}"]
        start(programs / short.program, words)
        for name in ("centerline_pressure", "wall_displacement"):
            table = folder / f"{name}.csv"
            if table.is_file():
                found += [Value(short.name, quantity, value) for quantity, value in at_the_end(table)]
    return found


def start(program: Path, words: List[str]) -> None:
    try:
        process = subprocess.run([str(program), *words], cwd=TOP, capture_output=True, text=True, check=False)
    except OSError as error:
        raise RunError(f"{program} cannot be started: {error.strerror}; build first, or give another folder") from None
    if process.returncode:
        raise RunError(f"{program.name} {' '.join(words)}: exit code {process.returncode}: {process.stderr.strip()}")


def at_the_end(path: Path) -> List[Tuple[str, float]]:
    """Largest absolute value of each column over the rows of the last time."""
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    first = next(iter(rows[0]))
    last = [row for row in rows if row[first] == rows[-1][first]]
    quantities = [name for name in rows[0] if name not in (first, "z_mm")]
    return [(name, max(abs(float(row[name])) for row in last)) for name in quantities]


def other_results(kept: List[Value], found: List[Value]) -> List[str]:
    """What differs, a line for each."""
    now = {(value.run, value.quantity): value.value for value in found}
    largest: Dict[str, float] = {}
    for value in kept:
        largest[value.quantity] = max(largest.get(value.quantity, 0.0), abs(value.value))
    lines = [f"{run}: {quantity} is new" for run, quantity in now if not any(k[:2] == (run, quantity) for k in kept)]
    for run, quantity, was in kept:
        if (run, quantity) not in now:
            lines.append(f"{run}: there is no {quantity} any more")
        elif not abs(now[run, quantity] - was) <= ALLOWED * largest[quantity]:
            lines.append(f"{run}: {quantity} is {now[run, quantity]:.9g}, kept {was:.9g}")
    return lines


def kept_values() -> List[Value]:
    """Raises OSError and ValueError."""
    return [Value(row["run"], row["quantity"], float(row["value"])) for row in read_table(TABLE)]


def name_of_results() -> str:
    """Eight digits that stand for the kept table. Raises OSError."""
    return hashlib.sha256(TABLE.read_bytes()).hexdigest()[:8]


def main(words: List[str]) -> int:
    keep = words[1:] == ["--keep"]
    if not words or words[0].startswith("-") or (words[1:] and not keep):
        print(__doc__, file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as work:
        try:
            found = values_of(Path(words[0]).resolve(), Path(work))
            if keep:
                write_table(TABLE, ORIGIN, Value._fields, [(*value[:2], f"{value.value:.10g}") for value in found])
                return 0
            lines = other_results(kept_values(), found)
        except (RunError, OSError, ValueError) as error:
            fail(str(error))
    for line in lines:
        print(line, file=sys.stderr)
    if lines:
        fail("tables and pictures are of programs with other results; run scripts/evidence.sh")
    return 0


def fail(text: str) -> NoReturn:
    print(f"short_runs: error: {text[:1000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
