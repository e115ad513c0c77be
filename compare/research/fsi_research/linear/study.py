"""Runs of fsi-linear-study that solve single Newton systems by several methods, each in a folder of its own. A study
can be stopped at any moment and called again: what is finished stays."""

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Iterator, List, Optional, Sequence, Tuple

from fsi_compare.base.errors import InputError, ProgramError
from fsi_compare.base.files import exists, make_folder, read_bytes, read_object, remove_tree, replacing, sweep
from fsi_compare.study.mesh_levels import MESH_NODES
from fsi_compare.starting.case_digest import case_digest
from fsi_compare.starting.processes import End, Job, run_jobs
from fsi_compare.starting.programs import Program
from .progress import Progress
from .results import FILE, LinearSolvers, System, read_linear_solvers

REQUEST = "request.json"


@dataclass(frozen=True)
class Request:
    """What one run is asked for."""

    name: str  # of its folder
    case: Path
    material: str
    mesh: str
    settings: Tuple[str, ...]  # key=value over the case file, the mesh among them
    solvers: Tuple[str, ...]
    systems: Tuple[System, ...]
    tolerance: float
    threads: Optional[int]
    sub_problems: bool = False
    files: Tuple[Path, ...] = ()  # beside the case file

    def command(self, program: Program, folder: Path) -> List[str]:
        words = [
            str(program.path),
            str(self.case),
            "-o",
            str(folder),
            "-q",
            "--systems",
            ",".join(f"{step}:{iteration}" for step, iteration in self.systems),
            "--solvers",
            ",".join(self.solvers),
            "--tolerance",
            repr(self.tolerance),
        ]
        if self.sub_problems:
            words.append("--sub-problems")
        if self.threads is not None:
            words += ["--threads", str(self.threads)]
        for setting in self.settings:
            words += ["--set", setting]
        return words

    def weight(self) -> float:
        """Expected work, for the time left."""
        return MESH_NODES.get(self.mesh, 1e3) * len(self.solvers) * len(self.systems)

    def fingerprint(self) -> dict:
        """What decides the result, and is not in it."""
        digest = hashlib.sha256(case_digest(self.case, "fsi-monolithic").encode())
        for file in self.files:
            digest.update(read_bytes(file, "", ""))
        return {"inputs": digest.hexdigest(), "settings": list(self.settings), "threads": self.threads}


@dataclass(frozen=True)
class Outcome:
    """Results, or why there are none."""

    request: Request
    results: Optional[LinearSolvers]
    failure: str = ""
    refused: bool = False  # as wrong use or bad input
    taken_up: bool = False  # made by an earlier call
    executable: str = ""  # digest of the program that made it; empty: not recorded

    @property
    def converged(self) -> bool:
        return self.results is not None and all(
            self.results.systems[system].solves[name].converged
            for system in self.request.systems
            for name in self.request.solvers
        )


def run_study(program: Program, folder: Path, requests: Sequence[Request], quiet: bool, jobs: int = 1) -> List[Outcome]:
    """Every run that is not in `folder` yet, `jobs` at once; more than one spoils the seconds. A failure is reported
    and the study goes on; only when nothing but refusals came back is the mistake in what was asked for: InputError."""
    progress = Progress([(request.name, request.mesh, request.weight()) for request in requests], quiet, jobs)
    outcomes: Dict[int, Outcome] = {}
    for index, request in enumerate(requests):
        found = finished(folder / request.name, request, program.version)
        if found:
            results, seconds, executable = found
            progress.known(request.name, seconds)
            outcomes[index] = Outcome(request, results, taken_up=True, executable=executable)

    def commands() -> Iterator[Job]:
        for index, request in enumerate(requests):
            if index not in outcomes:
                _prepare(folder / request.name)
                yield Job(index, request.command(program, folder / request.name))

    def ended(index: int, end: End) -> None:
        outcomes[index] = _judge(program, folder / requests[index].name, requests[index], end)
        progress.end(requests[index].name, outcomes[index].failure, outcomes[index].refused, end.seconds)

    run_jobs(commands(), jobs, ended, lambda running: progress.tick([requests[index].name for index in running]))
    if outcomes and all(outcome.refused for outcome in outcomes.values()):
        raise ProgramError("", "", outcomes[0].failure)
    return [outcomes[index] for index in range(len(requests))]


def finished(place: Path, request: Request, version: str) -> Optional[Tuple[LinearSolvers, float, str]]:
    """Results, seconds and the program's digest of an earlier run in this folder that holds all that is asked for."""
    try:
        results = read_linear_solvers(place / FILE)
        memory = read_object(place / REQUEST, "", "")
        wanted = {**request.fingerprint(), "case_hash": results.case_hash}
        if results.version != version or any(memory.get(key) != value for key, value in wanted.items()):
            return None
        _require(results, request)
        return results, float(memory["seconds"]), str(memory.get("executable", ""))
    except (InputError, OSError, ValueError, OverflowError, KeyError, TypeError):
        return None


def _require(results: LinearSolvers, request: Request) -> None:
    """Raises InputError naming what is missing."""
    if abs(results.tolerance - request.tolerance) > 1e-12 * request.tolerance:
        raise InputError(FILE, "tolerance", f"is {results.tolerance:g}, not {request.tolerance:g}")
    for step, iteration in request.systems:
        system = results.systems.get((step, iteration))
        if system is None:
            raise InputError(FILE, "systems", f"holds no system {step}:{iteration}")
        for name in request.solvers:
            if name not in system.solves:
                raise InputError(FILE, f"systems {step}:{iteration}", f"holds no solver {name}")
    if request.sub_problems and not results.sub_problems:
        raise InputError(FILE, "sub_problems", "is empty")


def _prepare(place: Path) -> None:
    make_folder(place)
    sweep(place)
    for name in (FILE, REQUEST):  # an old result must not pass for that of a run that fails
        remove_tree(place / name)


def _judge(program: Program, place: Path, request: Request, end: End) -> Outcome:
    outcome = _outcome(place, request, end, program.version)
    if outcome.results is not None:
        memory = {
            **request.fingerprint(),
            "case_hash": outcome.results.case_hash,
            "seconds": round(end.seconds, 3),
            "executable": program.digest,
        }
        with replacing(place / REQUEST) as temporary:
            temporary.write_text(json.dumps(memory, indent=2) + "\n", encoding="utf-8")
    return outcome


def _outcome(place: Path, request: Request, ended: End, version: str) -> Outcome:
    # Code 2 says that something did not converge; what did is in the file all the same.
    if ended.code not in (0, 2) or (ended.code == 2 and not exists(place / FILE)):
        return Outcome(request, None, ended.message, refused=ended.code == 1)
    try:
        results = read_linear_solvers(place / FILE)
        if results.version != version:
            raise InputError(place / FILE, "version", f"is {results.version}, the program's {version}")
        _require(results, request)
    except InputError as error:
        return Outcome(request, None, str(error))
    return Outcome(request, results)
