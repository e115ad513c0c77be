"""Runs a fault harness: `run.py NAME [OPTION...]`; `run.py NAME --help` lists its options."""

import runpy
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent

if __name__ == "__main__":
    names = sorted(file.parent.name for file in HERE.glob("*/*.py") if file.stem == file.parent.name)
    if len(sys.argv) < 2 or sys.argv[1] not in names:
        sys.exit(f"usage: run.py NAME [OPTION...], NAME one of {', '.join(names)}")
    folder = HERE / sys.argv[1]
    sys.path[0:1] = [str(folder), str(HERE / "support"), str(HERE.parent / "support")]
    sys.argv[:2] = [str(folder / f"{folder.name}.py")]
    runpy.run_path(sys.argv[0], run_name="__main__")
