"""Makes a scene's mesh and its runs."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Mapping, Sequence

from ..base.errors import InputError, ProgramError
from ..base.files import absolute, make_folder, remove_tree
from ..runs.run_folder import read_finished
from ..starting.launch import launched
from ..starting.processes import End, Job, run_jobs
from ..starting.programs import Program
from .mesh_chain import make_mesh, with_places
from .scene import Scene, SceneRun


@dataclass
class Outcome:
    """The finished runs of a scene, and why others are missing."""

    scene: Scene
    runs: dict[str, SceneRun] = field(default_factory=dict)
    failures: dict[str, str] = field(default_factory=dict)  # by program


def make_runs(
    scenes: Sequence[Scene],
    folder: Path,
    mesh_maker: Path,
    drivers: Mapping[str, Program],
    quick: bool,
    at_once: int,
    processes: int,
    said: Callable[[str], None],
) -> list[Outcome]:
    """Runs each scene with its drivers, each on `processes` of one thread, `at_once` at a time:
    `folder/NAME/monolithic` and so on."""
    outcomes = [Outcome(scene) for scene in scenes]
    jobs: list[Job] = []
    places = []
    for outcome in outcomes:
        scene = outcome.scene
        mesh = _make_mesh(scene, folder / scene.name, mesh_maker, quick)
        for program in scene.drivers:
            place = folder / scene.name / program.removeprefix("fsi-")
            remove_tree(place)
            command = launched(_command(scene, drivers[program], mesh, place, quick), processes)
            jobs.append(Job(len(jobs), command))
            places.append((outcome, program, place))

    def ended(key: int, end: End) -> None:
        outcome, program, place = places[key]
        if end.code:
            outcome.failures[program] = end.message
            said(f"{outcome.scene.name}, {program}: failed: {end.message}")
            return
        outcome.runs[program] = SceneRun(place, program, read_finished(place), end.seconds)
        said(f"{outcome.scene.name}, {program}: {end.seconds:.1f} s")

    run_jobs(jobs, at_once, ended)
    return outcomes


def _make_mesh(scene: Scene, place: Path, mesh_maker: Path, quick: bool) -> Path:
    make_folder(place)
    mesh = place / f"{scene.name}.msh"
    words = scene.mesh_words(quick)
    if not words:
        raise InputError(scene.folder / "scene.py", "MESH", "is empty", "give the words of an fsi-mesh command")
    end = make_mesh(with_places(words, scene.folder), mesh, mesh_maker, f"{scene.folder / 'scene.py'}: MESH")
    if end.code:
        raise ProgramError(scene.folder / "scene.py", "MESH", end.message, "mend the scene's mesh")
    return mesh


def _command(scene: Scene, program: Program, mesh: Path, place: Path, quick: bool) -> list[Any]:
    settings = {**(scene.quick if quick else {}), "mesh.file": str(absolute(mesh))}
    words: list[Any] = [program.path, scene.case, "-o", place, "-q", "--threads", "1"]
    for name, value in settings.items():
        words += ["--set", f"{name}={value}"]
    return words
