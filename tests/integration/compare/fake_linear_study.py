"""Stands in for fsi-linear-study in tests of `fsi-compare solvers`: answers at once, with numbers known beforehand.

`behaviour.json` beside the program says where it departs from them:
  "version"      its version (0.1.0)
  "iterations"   [[material, mesh, system, solver, count], ...]; null in place of a count: not converged
  "residual"     true residual of the solvers named
  "end"          {"MATERIAL MESH": [exit code, message]}: ends so, without a result
  "omit"         solvers that are missing in the result
  "cut"          true: the result is half a file
  "sleep"        seconds that each run takes; it writes its process number to `pid`
  "help"         what --help prints
Each run adds its command line to `calls.txt`.
"""

import json
import os
import stat
import sys
import time
from pathlib import Path

NODES = {"coarse": 1032, "intermediate": 7182, "fine": 54540}
UNKNOWNS = {"coarse": 4662, "intermediate": 34000, "fine": 265000}
PAPER = {  # neo-Hookean column, the others fall back on it
    "diagonal": (51, 111, 217),
    "lower": (28, 58, 109),
    "upper": (28, 59, 114),
    "ssor": (27, 54, 104),
    "ilu": (27, 54, 104),
    "amg": (7, 8, 12),
    "amg_gmres": (7, 7, 8),
    "amg_fgmres": (6, 7, 8),
    "amli": (7, 8, 12),
    "amli_gmres": (7, 7, 8),
    "amli_fgmres": (6, 7, 8),
    "fast": (9, 10, 11),
    "petsc": (9, 10, 11),
    "direct": (1, 1, 1),
}


def make_executable(path, text):
    path.write_text(text)
    path.chmod(path.stat().st_mode | stat.S_IXUSR)


def install(folder, name="fsi-linear-study", module="fake_linear_study"):
    """Makes the program, which is `main` of the module; returns its path."""
    program = Path(folder) / name
    make_executable(
        program,
        f"#!{sys.executable} -EB\nimport sys\n"
        f"sys.path.insert(0, {str(Path(__file__).parent)!r})\n"
        f"from {module} import main\nsys.exit(main(sys.argv))\n",
    )
    return program


def behave(program, **behaviour):
    (program.parent / "behaviour.json").write_text(json.dumps(behaviour))


def calls(program):
    file = program.parent / "calls.txt"
    return file.read_text().splitlines() if file.exists() else []


def main(words):
    home = Path(words[0]).parent
    file = home / "behaviour.json"
    behaviour = json.loads(file.read_text()) if file.exists() else {}
    version = behaviour.get("version", "0.1.0")
    if words[1] == "--version":
        print(f"fsi-linear-study {version}")
        return 0
    if words[1] == "--help":
        print(behaviour.get("help", "  --systems STEP:IT,..."))
        return 0
    with open(home / "calls.txt", "a") as log:
        log.write(" ".join(words[1:]) + "\n")

    if "sleep" in behaviour:
        (home / "pid").write_text(str(os.getpid()))
        time.sleep(behaviour["sleep"])
    options, settings, rest = {}, {}, words[2:]
    while rest:
        word = rest.pop(0)
        if word == "--set":
            key, _, value = rest.pop(0).partition("=")
            settings[key] = value
        else:
            options[word] = True if word in ("-q", "--sub-problems") else rest.pop(0)
    material, mesh = Path(words[1]).stem, settings.get("mesh.level", "coarse")
    if f"{material} {mesh}" in behaviour.get("end", {}):
        code, message = behaviour["end"][f"{material} {mesh}"]
        print(f"fsi-linear-study: error: {message}", file=sys.stderr)
        return code

    tolerance = float(options["--tolerance"])
    systems = [tuple(map(int, system.split(":"))) for system in options["--systems"].split(",")]
    solvers = [name for name in options["--solvers"].split(",") if name not in behaviour.get("omit", [])]

    def solver(name, step, iteration):
        count = PAPER[name.replace("_exact", "")][list(NODES).index(mesh)]
        for m, h, s, n, other in behaviour.get("iterations", []):
            if (m, h, s, n) == (material, mesh, f"{step}:{iteration}", name):
                count = other
        good = count is not None
        seconds = 1e-6 * UNKNOWNS[mesh] * (count or 500)
        return {
            "name": name,
            "converged": good,
            "iterations": count or 500,
            "relative_residual": behaviour.get("residual", {}).get(name, 0.5 * tolerance) if good else 0.25,
            "set_up_seconds": 0.125,
            "solve_seconds": seconds,
            "work_units": seconds / 1e-3,
            "cycles": None
            if name == "direct"
            else {"mesh": count, "flow": count, "wall": 2 * (count or 0)}
            if good
            else None,
            "operator_complexity": None if name == "direct" else 1.25,
            "levels": None if name == "direct" else 3,
            "memory_MiB": 12.5,
            "difference": None if name == "direct" else 1e-10,
            "message": "" if good else "no convergence in 500 iterations",
        }

    result = {
        "program": "fsi-linear-study",
        "version": version,
        "title": "A tube",
        "case_hash": "0123456789abcdef",
        "threads": int(options.get("--threads", 2)),
        "mesh": {"name": f"level {mesh}", "nodes": NODES[mesh], "tetrahedra": 5 * NODES[mesh]},
        "tolerance": tolerance,
        "newton": [
            {
                "step": step,
                "time_ms": 0.125 * step,
                "increments": [2.2, 1.7e-2, 6.4e-6, 4.9e-13],
                "residuals": [1.0, 1e-2, 1e-5, 1e-12],
                "iterations": 4,
            }
            for step in sorted({s for s, _ in systems})
        ],
        "systems": [
            {
                "step": step,
                "newton_iteration": iteration,
                "time_ms": 0.125 * step,
                "unknowns": {"mesh": 462, "flow": 960, "wall": 3240, "total": UNKNOWNS[mesh]},
                "product_seconds": 1e-3,
                "right_hand_side": 1.0,
                "solvers": [solver(name, step, iteration) for name in solvers],
            }
            for step, iteration in systems
        ],
    }
    if "--sub-problems" in options:
        result["sub_problems"] = [
            {
                "problem": problem,
                "coarsening": "kickinger",
                "smoother": "gauss-seidel",
                "cycle": "V",
                "levels": levels,
                "factor": factor,
                "iterations": 11,
                "operator_complexity": 1.3,
            }
            for problem, levels, factor in (("mesh", 2, 0.12), ("mesh", 3, 0.15), ("wall", 3, 1.5))
        ]
    folder = Path(options["-o"])
    folder.mkdir(parents=True, exist_ok=True)
    text = json.dumps(result)
    (folder / "linear_solvers.json").write_text(text[: len(text) // 2] if behaviour.get("cut") else text)
    failed = any(not s["converged"] for system in result["systems"] for s in system["solvers"])
    return 2 if failed else 0
