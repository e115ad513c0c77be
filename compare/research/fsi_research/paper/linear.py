"""The linear-solver part of the paper's study: the first Newton system of each material and mesh by each solver, made
by the machinery of `fsi-compare solvers` in the folder `linear` beside `runs`. That command's own runs are there as
well and may hold more than the study asks for, so that --fresh leaves the folder alone."""

from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

from fsi_compare.base.errors import InputError
from fsi_compare.base.files import make_folder
from ..catalogue.names import MATERIALS, METHODS
from fsi_compare.study.mesh_levels import MESHES
from fsi_compare.base.suggestions import check_keys, nearest
from ..linear.results import System
from ..linear.grid import Grid
from ..linear.study import Request, finished, run_study
from ..linear.programs import linear_study_beside
from fsi_compare.study.builds import Builds
from fsi_compare.study.context import Context
from fsi_compare.study.runner import Runner, Standing
from fsi_compare.study.study_file import Study

FOLDER = "linear"
FIRST_SYSTEM = (1, 1)
LATER_SYSTEMS = ((1, 2), (1, 3))  # Newton takes four iterations and more in the first step
TOLERANCE = 1e-9  # the paper's
KEYS = ("meshes", "methods", "later_meshes", "jobs", "quick")


def check(study: Study) -> None:
    """`[report.linear]`: meshes and methods, later_meshes where the first step's later Newton systems are solved too
    (default: none), jobs for systems at once (default: as many as runs), and the same for the quick form. Without the
    section there are no such runs."""
    if "linear" not in study.report:
        return
    section = study.report["linear"]
    quick = section.get("quick", {}) if isinstance(section, dict) else {}
    for key, part in (("report.linear", section), ("report.linear.quick", quick)):
        if not isinstance(part, dict):
            raise InputError(study.path, key, "is not a section", "write meshes and methods in it")
        check_keys(study.path, key, part, KEYS)
        for name, known in (("meshes", list(MESHES)), ("methods", list(METHODS))):
            _names(study, f"{key}.{name}", part.get(name, known), known)
        jobs = part.get("jobs", 1)
        if not isinstance(jobs, int) or isinstance(jobs, bool) or jobs < 1:
            raise InputError(study.path, f"{key}.jobs", f"'{jobs}' is not a number of runs", "give 1 or more")
        if "later_meshes" in part:
            _names(study, f"{key}.later_meshes", part["later_meshes"], list(MESHES))
    for case in study.cases:
        if case not in MATERIALS:
            raise InputError(
                study.path, f"cases.{case}", "is none of the paper's materials", f"name it {', '.join(MATERIALS)}"
            )


def _names(study: Study, key: str, names: Any, known: List[str]) -> None:
    if not isinstance(names, list) or not names:
        raise InputError(study.path, key, "is not a list of names", f"choose from {', '.join(known)}")
    for name in names:
        if name not in known:
            raise InputError(study.path, key, f"'{name}' is unknown", f"did you mean '{nearest(str(name), known)}'?")


@dataclass(frozen=True)
class Chosen:
    meshes: List[str]
    methods: List[str]
    later_meshes: List[str]
    jobs: Optional[int]  # None: as many at once as there are runs of the study


def chosen(study: Study) -> Optional[Chosen]:
    """The choice of this form of the study; None: no such runs."""
    section: Optional[Mapping[str, Any]] = study.report.get("linear")
    if section is None or (study.quick and "quick" not in section):
        return None
    merged: Dict[str, Any] = {**section, **({"later_meshes": [], **section["quick"]} if study.quick else {})}
    return Chosen(
        merged.get("meshes", list(MESHES)),
        merged.get("methods", list(METHODS)),
        merged.get("later_meshes", []),
        merged.get("jobs"),
    )


def solve(context: Context) -> Tuple[Optional[Grid], Optional[Grid]]:
    """The first Newton system of each material and mesh, and the later ones of the first step; None: not asked for.
    Those that are finished are taken up, and counted for the runner's warning."""
    wanted = chosen(context.study)
    if wanted is None:
        return None, None
    runner = context.runner
    program = linear_study_beside(runner.programs["fsi-monolithic"])
    folder = runner.folder / FOLDER / "runs"
    make_folder(folder)
    first, later = _requests(context.study, wanted, runner.threads)
    outcomes = run_study(program, folder, [*first, *later], runner.quiet, systems_at_once(context))
    builds = Builds("runs of linear systems", f"removing `{FOLDER}/runs`")
    for outcome in outcomes:
        if outcome.taken_up:
            builds.count(program, outcome.executable)
    runner.builds.append(builds)
    return Grid(outcomes[: len(first)]), Grid(outcomes[len(first) :]) if later else None


def systems_at_once(context: Context) -> int:
    wanted = chosen(context.study)
    return wanted.jobs if wanted is not None and wanted.jobs is not None else context.runner.jobs


def standing(study: Study, runner: Runner) -> Standing:
    """How many of these runs are there, without making any."""
    wanted = chosen(study)
    if wanted is None:
        return Standing(0, 0, 0)
    folder = runner.folder / FOLDER / "runs"
    version = linear_study_beside(runner.programs["fsi-monolithic"]).version
    first, later = _requests(study, wanted, runner.threads)
    there = [finished(folder / request.name, request, version) for request in (*first, *later)]
    return Standing(len(there), sum(one is not None for one in there), 0)


def _requests(study: Study, wanted: Chosen, threads: Optional[int]) -> Tuple[List[Request], List[Request]]:
    """Requests for the first systems, and for the later ones."""

    def of(meshes: Sequence[str], systems: Sequence[System], ending: str) -> List[Request]:
        return [
            Request(
                name=f"{material}-{mesh}{ending}",
                case=case,
                material=material,
                mesh=mesh,
                settings=(f"mesh.level={mesh}",),
                solvers=tuple(wanted.methods),
                systems=tuple(systems),
                tolerance=TOLERANCE,
                threads=threads,
            )
            for mesh in sorted(meshes, key=list(MESHES).index)
            for material, case in study.cases.items()
        ]

    return of(wanted.meshes, (FIRST_SYSTEM,), ""), of(wanted.later_meshes, LATER_SYSTEMS, "-later")
