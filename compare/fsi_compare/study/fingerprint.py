"""What decides the outcome of a run: a digest of case, mesh and other files, settings, processes, threads and program
version."""

import hashlib
import json
from pathlib import Path
from typing import Any

from ..base.errors import InputError
from ..base.files import is_file, read_bytes, read_toml
from ..starting.case_digest import UNREADABLE, case_digest, files_digest
from ..starting.programs import Program
from .study_file import Request

HEADINGS = ("title",)  # in the results; nothing is solved differently


def fingerprint(request: Request, program: Program, mesh_file: Path | None, threads: int, processes: int) -> str:
    digest = hashlib.sha256(case_digest(request.case_file, request.method.program, HEADINGS).encode())
    mesh = mesh_file or _own_mesh(request)
    if mesh is not None and is_file(mesh):
        digest.update(read_bytes(mesh, UNREADABLE, UNREADABLE))
    # As the drivers find files that --set names.
    digest.update(files_digest(request.settings, [Path(), request.case_file.parent]).encode())
    level = request.mesh.name if request.mesh and not request.mesh.options else None
    what: list[Any] = [program.path.name, program.version, level, dict(request.settings), threads]
    if processes > 1:  # a run on one process is what it was before there were others
        what.append({"processes": processes})
    digest.update(json.dumps(what, sort_keys=True, default=str).encode())
    return digest.hexdigest()


def _own_mesh(request: Request) -> Path | None:
    """The mesh file that the case file names, unless the study gives another."""
    if request.mesh is not None:
        return None
    try:
        section = read_toml(request.case_file, UNREADABLE, UNREADABLE).get("mesh")
    except InputError:
        return None  # the driver will say what is wrong with it
    name = section.get("file") if isinstance(section, dict) else None
    return request.case_file.parent / name if isinstance(name, str) else None
