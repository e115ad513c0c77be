"""Keeps how many of 100 random scenes each kind of coupling solves, and how many answers are wrong: docs/data/random-scenes.csv.

usage: python3 scripts/evidence/random_scenes.py BIN WORK
The scenes are those of tests/faults/scenes: six steps each, drawn far beyond vessels, no step halved.
"""

import re
import subprocess
import sys
from pathlib import Path
from typing import Dict, List, NoReturn

from kept_tables import DATA, TOP, write_table

SEED, SCENES = 11, 100
KINDS: Dict[str, List[str]] = {"interface": [], "block": ["--scheme", "block-newton"]}
ORIGIN = f"""made by scripts/evidence/random_scenes.py BIN WORK: tests/faults/run.py scenes --seed {SEED} --scenes {SCENES}
six steps of scenes drawn at random, no step halved; solved: all steps, and the displacements of the drivers agree to 1e-4"""
UNSOLVED = re.compile(r"(?m)^(fsi-[a-z]+): (\d+) of \d+ scenes unsolved$")
WITHOUT = re.compile(r"\b(\d+) without solution\b")
WRONG = re.compile(r"(\d+) ([a-z][a-z ]*) \(WRONG\)")


def solved_by(told: str) -> Dict[str, int]:
    """By program, what the harness says: neither unsolved nor without a solution."""
    none = WITHOUT.search(told)
    without = int(none[1]) if none else 0
    return {program: SCENES - without - int(number) for program, number in UNSOLVED.findall(told)}


def wrong_of(told: str) -> int:
    """Verdicts that are not as promised, without those that count others."""
    return sum(int(number) for number, verdict in WRONG.findall(told) if not verdict.startswith("too many"))


def main(words: List[str]) -> int:
    if len(words) != 2 or words[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 1
    work = Path(words[1])
    work.mkdir(parents=True, exist_ok=True)
    rows = []
    for kind, options in KINDS.items():
        told = work / f"{kind}.txt"
        if not told.exists():
            harness = [sys.executable, "-B", str(TOP / "tests/faults/run.py"), "scenes"]
            harness += ["--programs", words[0], "--seed", str(SEED), "--scenes", str(SCENES), *options]
            process = subprocess.run(harness, capture_output=True, text=True, check=False)  # 1: some verdict is bad
            if " runs: " not in process.stdout:
                fail(f"{' '.join(harness)}: exit code {process.returncode}: {process.stderr.strip()[-500:]}")
            told.write_text(process.stdout, encoding="utf-8")
        text = told.read_text(encoding="utf-8")
        solved = solved_by(text)
        rows.append((kind, solved["fsi-partitioned"], SCENES, wrong_of(text)))
        monolithic = ("monolithic", solved["fsi-monolithic"], SCENES, wrong_of(text))
        print(text, end="")
    rows.append(monolithic)
    write_table(DATA / "random-scenes.csv", ORIGIN, ("kind", "solved", "of", "wrong"), rows)
    return 0


def fail(text: str) -> NoReturn:
    print(f"random_scenes: error: {text[:1000]}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
