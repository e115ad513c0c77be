"""Stand in for fsi-mesh and both drivers in tests of `fsi-compare verify`: answer at once, with errors that are known.

A mesh is a file with the size of its elements, from `--set size=` or `--set cells=` of a script, half of that of the file
that `refine` is given, or that of as many nodes as `adapt` is asked for; `lumen` makes it of its edges, 6 along the diameter or 1 mm for
size 1, and `thicken` takes that of its lumen; behind it stand the nodes as gmsh has them. A run has one point, whose values are

    displacement_x_mm = (1 + A h^3 + B dt^2) sin(t / 4),    pressure_Pa = 100 + 10 h^2,

where the tolerance that a driver stops by adds 1e-3 of itself: the monolithic one by `newton.error_tolerance`, and so the
partitioned one, unless the case names `partitioned.tolerance` or a scheme that ends by the gap. Newton's iterations of a
step are 6 less the tolerance's power of ten. `behaviour.json` beside the programs:
  "end"       {WORD: [exit code, message]}: a run whose command line holds WORD ends so
  "swing"     true: the displacement swings from mesh to mesh
  "grows"     true: the displacement's error grows as the mesh is refined
  "chosen"    the scheme of the partitioned driver where the case names none, robin-neumann-inexact unless given
  "nothing"   true: no samples
  "least"     no mesh has a smaller size
  "seconds"   what a run takes at least
  "ends"      {WORD: ms}: a run whose command line holds WORD ends then, as by time.periods
Each call adds its command line to `calls.txt`.
"""

import json
import math
import sys
import time
import tomllib
from pathlib import Path

import fake_linear_study

BY_ERROR = ("robin-neumann-inexact", "block-newton")  # partitioned schemes that end by the error of a step

A, B, SIZE, STEP = 0.02, 0.01, 1.0, 0.5


def install(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("fsi-mesh", "fsi-monolithic", "fsi-partitioned"):
        fake_linear_study.install(folder, name, "fake_family")
    return folder


def behave(folder, **behaviour):
    (folder / "behaviour.json").write_text(json.dumps(behaviour))


def calls(folder):
    file = folder / "calls.txt"
    return file.read_text().splitlines() if file.exists() else []


def settings(words):
    pairs = [words[i + 1] for i, word in enumerate(words) if word == "--set"]
    return dict(pair.split("=", 1) for pair in pairs)


def main(words):
    program = Path(words[0])
    home = program.parent
    if words[1] == "--version":
        print(f"{program.name} 0.1.0")
        return 0
    file = home / "behaviour.json"
    behaviour = json.loads(file.read_text()) if file.exists() else {}
    line = " ".join(words)
    with open(home / "calls.txt", "a") as log:
        log.write(line + "\n")
    for word, (code, message) in behaviour.get("end", {}).items():
        if word in line:
            print(f"{program.name}: error: {message}", file=sys.stderr)
            return code
    place = Path(words[words.index("-o") + 1])
    if program.name != "fsi-mesh":
        time.sleep(behaviour.get("seconds", 0))
    if program.name == "fsi-mesh":
        write_mesh(place, max(mesh_size(words), behaviour.get("least", 0)))
    else:
        run(words, place, program.name, behaviour)
    return 0


def nodes(size):
    return round(5e3 / size**2)


def write_mesh(path, size):
    path.write_text(
        f"{size!r}\n$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {nodes(size)} 1 {nodes(size)}\n$EndNodes\n"
    )


def size_of(path):
    return float(Path(path).read_text().split()[0])


def mesh_size(words):
    if words[1] == "refine":
        return size_of(words[2]) / 2 ** int(words[words.index("--times") + 1])
    if words[1] == "adapt":
        assert json.loads((Path(words[3]) / "summary.json").read_text())["indicator"], "a run without error_indicator"
        return math.sqrt(5e3 / float(words[words.index("--nodes") + 1]))
    if words[1] == "thicken":
        return size_of(words[2])
    if words[1] == "lumen":
        given = dict(zip(words, words[1:]))
        return (
            6 / float(given["--edges-per-diameter"])
            if "--edges-per-diameter" in given
            else float(given["--edge-length"])
        )
    given = settings(words)
    if "size" in given:
        return float(given["size"])
    return 8 / float(given.get("cells", given.get("media", 4)))  # 4: of the scene ring-in-time


def scheme_of(entries, given, behaviour):
    named = given.get("partitioned.scheme", entries.get("partitioned", {}).get("scheme"))
    return named or behaviour.get("chosen", BY_ERROR[0])


def tolerance_of(name, entries, given, behaviour):
    def entry(section, key, default):
        return given.get(f"{section}.{key}", entries.get(section, {}).get(key, default))

    if name == "fsi-partitioned":
        gap = entry("partitioned", "tolerance", None)
        if gap is not None or scheme_of(entries, given, behaviour) not in BY_ERROR:
            return float(1e-6 if gap is None else gap)
    error, newton = (entry("newton", key, None) for key in ("error_tolerance", "tolerance"))
    if error is None and newton is None:
        return 3e-3
    return float(error or newton or 1e-3)


def run(words, place, name, behaviour):
    case = Path(words[1])
    entries = tomllib.loads(case.read_text())
    given = settings(words)
    h = size_of(case.parent / given.get("mesh.file", entries["mesh"]["file"])) / SIZE
    step = float(given.get("time.step", entries["time"]["step"]))
    end = float(given.get("time.end", entries["time"]["end"]))
    end = next((ms for word, ms in behaviour.get("ends", {}).items() if word in " ".join(words)), end)
    tolerance = tolerance_of(name, entries, given, behaviour)
    sign = (-1) ** round(math.log2(h) * 2) if behaviour.get("swing") else 1
    factor = 1 + sign * A * h ** (-3 if behaviour.get("grows") else 3) + B * (step / STEP) ** 2 + 1e-3 * tolerance
    steps = round(end / step)
    times = [(n + 1) * step for n in range(steps)]
    place.mkdir(parents=True, exist_ok=True)
    if not behaviour.get("nothing"):
        rows = [f"{t!r},tip,0,0,0,{factor * math.sin(t / 4)!r},{100 + 10 * h**2!r}" for t in times]
        head = "time_ms,point,x_mm,y_mm,z_mm,displacement_x_mm,pressure_Pa"
        (place / "points.csv").write_text("\n".join([head, *rows]) + "\n")
    newton = 6 - round(math.log10(tolerance))
    rows = [f"{n + 1},{t!r},1,{newton},9,0.01" for n, t in enumerate(times)]
    head = "step,time_ms,outer_iterations,newton_iterations,linear_iterations,wall_s"
    (place / "iterations.csv").write_text("\n".join([head, *rows]) + "\n")
    cells = round(1e4 / h**2)
    summary = {
        "program": name,
        "version": "0.1.0",
        "title": "A tube",
        "status": "done",
        "case": str(case),
        "case_hash": "0123",
        "indicator": given.get("output.error_indicator") == "true",
        "peak_memory_MiB": 50 + 10 / h**2,
        "mesh": {"name": "mesh", "nodes": cells // 2, "triangles": cells, "hash": f"{h:.6g}"},
        "totals": {"steps": steps, "wall_s": 0.01 * steps},
    }
    if name == "fsi-partitioned":
        summary["choices"] = {"partitioned.scheme": {"value": scheme_of(entries, given, behaviour), "reason": "told"}}
    (place / "summary.json").write_text(json.dumps(summary))
