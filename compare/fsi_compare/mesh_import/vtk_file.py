"""Files of VTK's XML formats (.vtu, .vtp): what they hold, as `fsi-mesh` reads them."""

import json
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..base.errors import InputError
from ..base.files import exists, find_beside

POLYGON = 7


@dataclass
class VtkFile:
    """All pieces, one after the other; fields of one number a place."""

    path: Path
    points: np.ndarray  # (points, 3), the file's unit
    ends: np.ndarray  # of the cells in `corners`
    kinds: np.ndarray  # VTK's number of each cell's kind
    corners: np.ndarray  # nodes of the cells, from 0
    is_surface: bool = False  # .vtp: its polygons
    others: int = 0  # vertices, lines and strips of a surface
    point_fields: dict[str, np.ndarray] = field(default_factory=dict)
    cell_fields: dict[str, np.ndarray] = field(default_factory=dict)
    left_out: list[str] = field(default_factory=list)  # fields of another kind, for messages


def read_vtk(path: Path) -> VtkFile:
    """Raises InputError, of damages too."""
    if not exists(path):
        raise InputError(path, "", "no such file", "give a mesh, .vtu, or a surface, .vtp")
    program = find_beside(Path(sys.argv[0]), "fsi-mesh")
    if program is None:
        raise InputError("fsi-mesh", "", "is neither beside fsi-compare nor on the path", "install both together")
    done = subprocess.run([program, "vtk-arrays", "--", path], stdin=subprocess.DEVNULL, capture_output=True)
    if done.returncode != 0:
        said = done.stderr.decode(errors="replace").strip().removeprefix("fsi-mesh: error: ")
        raise InputError(path, "", said.removeprefix(f"{path}: ") or f"fsi-mesh ended with {done.returncode}", "")
    head, _, rest = done.stdout.partition(b"\n")
    return _file(path, json.loads(head), rest)


def _file(path: Path, head: dict, rest: bytes) -> VtkFile:
    at = 0

    def numbers(count: int, kind: str) -> np.ndarray:
        nonlocal at
        at += 8 * count
        return np.frombuffer(rest, kind, count, at - 8 * count)

    points = numbers(3 * head["points"], "f8").reshape(-1, 3)
    ends, kinds = numbers(head["cells"], "i8"), numbers(head["cells"], "i8")
    file = VtkFile(path, points, ends, kinds, numbers(head["corners"], "i8"), head["surface"])
    file.others, file.left_out = head["lines"] + head["strips"], head["left_out"]
    for entry in head["fields"]:
        fields = file.cell_fields if entry["of_cells"] else file.point_fields
        fields[entry["name"]] = numbers(entry["numbers"], "f8")
    return file
