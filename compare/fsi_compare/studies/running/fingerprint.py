"""What decides the outcome of a run: a digest of case, mesh, settings, threads and program version."""

import hashlib
import json
import tomllib
from pathlib import Path
from typing import Optional

from ...runs.case_digest import case_digest
from ...runs.programs import Program
from .study_file import Request

HEADINGS = ("title",)  # in the results; nothing is solved differently


def fingerprint(request: Request, program: Program, mesh_file: Optional[Path], threads: int) -> str:
    digest = hashlib.sha256(case_digest(request.case_file, request.method.program, HEADINGS).encode())
    mesh = mesh_file or _own_mesh(request)
    if mesh is not None and mesh.is_file():
        digest.update(mesh.read_bytes())
    level = request.mesh.name if request.mesh and not request.mesh.options else None
    digest.update(
        json.dumps(
            [program.path.name, program.version, level, dict(request.settings), threads], sort_keys=True, default=str
        ).encode()
    )
    return digest.hexdigest()


def _own_mesh(request: Request) -> Optional[Path]:
    """The mesh file that the case file names, unless the study gives another."""
    if request.mesh is not None:
        return None
    try:
        name = tomllib.loads(request.case_file.read_text(encoding="utf-8")).get("mesh", {}).get("file")
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, AttributeError):
        return None  # the driver will say what is wrong with it
    return request.case_file.parent / name if isinstance(name, str) else None
