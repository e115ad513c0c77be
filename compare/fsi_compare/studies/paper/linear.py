"""The linear-solver part of the paper's study: the first Newton system of each material and mesh by each solver, made
by the machinery of `fsi-compare solvers` in the folder `linear` beside `runs`."""

from typing import Any, Dict, List, Mapping, Optional, Tuple

from ...errors import InputError
from ...files import make_folder
from ...names import MATERIALS, MESHES, METHODS
from ...programs import find_monolithic
from ...solver_tables import Grid
from ...linear_study import Request, run_study
from ..context import Context
from ..study_file import Study
from ..suggestions import nearest

FOLDER = "linear"
FIRST_SYSTEM = (1, 1)
TOLERANCE = 1e-9  # the paper's
KEYS = ("meshes", "methods", "quick")


def check(study: Study) -> None:
    """`[report.linear]`: meshes, methods, and both for the quick form. Without the section there are no such runs."""
    if "linear" not in study.report:
        return
    section = study.report["linear"]
    quick = section.get("quick", {}) if isinstance(section, dict) else {}
    for key, part in (("report.linear", section), ("report.linear.quick", quick)):
        if not isinstance(part, dict):
            raise InputError(study.path, key, "is not a section", "write meshes and methods in it")
        for name in part:
            if name not in KEYS:
                raise InputError(study.path, f"{key}.{name}", "is unknown", f"did you mean '{nearest(name, KEYS)}'?")
        for name, known in (("meshes", list(MESHES)), ("methods", list(METHODS))):
            _names(study, f"{key}.{name}", part.get(name, known), known)
    for case in study.cases:
        if case not in MATERIALS:
            raise InputError(study.path, f"cases.{case}", "is none of the paper's materials",
                             f"name it {', '.join(MATERIALS)}")


def _names(study: Study, key: str, names: Any, known: List[str]) -> None:
    if not isinstance(names, list) or not names:
        raise InputError(study.path, key, "is not a list of names", f"choose from {', '.join(known)}")
    for name in names:
        if name not in known:
            raise InputError(study.path, key, f"'{name}' is unknown", f"did you mean '{nearest(str(name), known)}'?")


def chosen(study: Study) -> Optional[Tuple[List[str], List[str]]]:
    """Meshes and methods of this form of the study; None: no such runs."""
    section: Optional[Mapping[str, Any]] = study.report.get("linear")
    if section is None or (study.quick and "quick" not in section):
        return None
    merged: Dict[str, Any] = {**section, **(section["quick"] if study.quick else {})}
    return merged.get("meshes", list(MESHES)), merged.get("methods", list(METHODS))


def solve(context: Context) -> Optional[Grid]:
    """All of them; those that are finished are taken up."""
    wanted = chosen(context.study)
    if wanted is None:
        return None
    meshes, methods = wanted
    runner = context.runner
    program = find_monolithic(runner.programs["fsi-monolithic"].path)
    folder = runner.folder / FOLDER / "runs"
    make_folder(folder)
    requests = [
        Request(name=f"{material}-{mesh}", case=case, material=material, mesh=mesh, settings=(f"mesh.level={mesh}",),
                solvers=tuple(methods), systems=(FIRST_SYSTEM,), tolerance=TOLERANCE, threads=runner.threads)
        for mesh in sorted(meshes, key=list(MESHES).index)
        for material, case in context.study.cases.items()]
    return Grid(run_study(program, folder, requests, runner.quiet))
