"""Runs what a study asks for and is not there yet. A study can be killed at any moment and called again."""

import json
import math
import os
import re
import shlex
import time
from dataclasses import replace
from pathlib import Path
from typing import Any, Mapping, NamedTuple, Sequence

from ..base import interruption
from ..base.errors import InputError, ProgramError
from ..base.files import TEMPORARY, absolute, is_file, listed, make_folder, read_bytes, read_json, read_object
from ..base.files import remove_tree, write_text
from ..base.toml import toml_value
from ..starting.launch import launched
from ..gallery.mesh_chain import contents, make_mesh
from ..starting.processes import End, Job, run_jobs
from ..starting.programs import Program, no_mesh_maker
from ..runs.summary import FILE, read_summary
from ..runs.work_units import about_machines
from . import repeats
from .builds import Builds
from .fingerprint import fingerprint
from .study_file import Request, Study, StudyMesh
from .study_progress import StudyProgress
from .study_run import CRASHED, DONE, NOT_CONVERGED, OUT_OF_TIME, REFUSED, WRONG, StudyRun

AGAIN = "make the run again with --fresh"
PARTS = "parts"  # of `meshes`: what one command of a mesh has made for the next one
RECORD = "study_run.json"  # written last: a folder without it is not finished
LONGEST_NAME = 100  # characters; the digest behind it tells runs apart
OWN_PLACE = re.compile(r".+-[0-9a-f]{12}(-\d+)?")  # of a run in `runs`, or of a repetition of it
NOT_A_NUMBER = re.compile(r"(?:^|,)\s*[-+]?(?:nan|inf(?:inity)?)\s*(?=$|,)", re.IGNORECASE | re.MULTILINE)


class Standing(NamedTuple):
    """Number of runs that a study lists, and of those that are there."""

    asked: int
    finished: int  # the failed ones too: they are not made again
    failed: int


class Runner:
    """`folder` holds `runs/`, a folder per run, and `meshes/`."""

    def __init__(
        self,
        study: Study,
        folder: Path,
        programs: dict[str, Program],
        mesh_maker: Path | None,
        threads: int | None = None,
        jobs: int | None = None,
        quiet: bool = False,
        processes: int | None = None,
    ):
        self.study, self.folder, self.programs, self.mesh_maker = study, folder, programs, mesh_maker
        self.threads = study.threads if threads is None else threads
        self.processes = study.processes if processes is None else processes  # of runs whose group does not say
        self.jobs = study.jobs if jobs is None else jobs
        self.quiet = quiet
        self._known: dict[str, StudyRun] = {}  # by fingerprint
        self.seconds = 0.0  # of all runs asked for, whenever they were made
        self._taken_up = Builds("finished runs", "`--fresh`")
        self.builds = [self._taken_up]  # and of what a kind takes up by other means

    def run(self, requests: Sequence[Request]) -> list[StudyRun]:
        """Makes runs, and returns them in the order of the requests. The same run asked for twice is made once."""
        make_folder(self.folder / "runs")
        keys = list(map(self._fingerprint, requests))
        progress = StudyProgress(self.quiet, self.jobs)
        jobs: list[Job] = []
        wanted: dict[str, Request] = {}
        for key, request in zip(keys, requests):
            if key in self._known or key in wanted:
                continue
            known = self._finished(key, request)
            if known:
                self._take(key, known)
                progress.known(request, known)
            else:
                wanted[key] = request
        # Small ones first: they tell the time left.
        order = sorted(wanted.items(), key=lambda item: progress.weight(item[1]))
        progress.plan([request for _, request in order])
        for i, (key, request) in enumerate(order):
            folder = self._place(key, request)
            remove_tree(folder)
            jobs.append(Job(i, self._command(request, folder), request.time_limit))

        def ended(i: int, end: End) -> None:
            key, request = order[i]
            run = self._judge(key, request, end)
            self._take(key, run)
            progress.end(request, run)

        run_jobs(jobs, self.jobs, ended, lambda running: progress.tick([order[i][1] for i in running]))
        self._repeat(dict(zip(keys, requests)), progress)
        # What is known may have been asked for under another name: the run is the same, its place in the study is not.
        return [replace(self._known[key], request=request) for key, request in zip(keys, requests)]

    def _repeat(self, requests: Mapping[str, Request], progress: StudyProgress) -> None:
        """Times the short runs again, one round after the other, so that a disturbance does not meet all of a run's."""
        study = self.study

        def is_short(run: StudyRun) -> bool:
            return run.done and run.seconds < study.repeat_below and len(run.timings) < study.repeats

        short = {k: request for k, request in requests.items() if study.repeats > 1 and is_short(self._known[k])}
        rounds = range(2, study.repeats + 1)
        again = [(k, r, self._place(k, r, f"-{n}")) for n in rounds for k, r in short.items()]
        places: dict[str, list[Path]] = {key: [] for key in short}
        progress.repeat([request for _, request, _ in again])
        for _, _, place in again:
            remove_tree(place)

        def ended(i: int, end: End) -> None:
            key, request, place = again[i]
            self.seconds += end.seconds
            status, message = judge(place, end)
            progress.end(request, StudyRun(request, place, status, message, end.seconds, ""))
            places[key].append(place)
            if len(places[key]) == study.repeats - 1:
                self._settle(key, request, places[key])

        jobs = [Job(i, self._command(r, place), r.time_limit) for i, (_, r, place) in enumerate(again)]
        run_jobs(jobs, self.jobs, ended, lambda running: progress.tick([again[i][1] for i in running]))

    def _settle(self, key: str, request: Request, places: Sequence[Path]) -> None:
        """Keeps the median of all repetitions, if they had the same results."""
        run, folder = self._known[key], self._place(key, request)
        record = read_object(folder / RECORD, AGAIN, AGAIN)
        if repeats.same_results([folder, *places]):
            record["timings"] = repeats.keep_median(folder, places)
        else:
            record.update(status=CRASHED, message=repeats.NOT_THE_SAME)
        write_record(folder, record)
        told = {name: record[name] for name in ("status", "message")}
        self._known[key] = replace(run, **told, timings=tuple(record.get("timings", ())))

    @property
    def machines(self) -> str:
        """A sentence about machines and builds of the finished runs; empty: they are all of one."""
        return about_machines([run.summary for run in self._known.values() if run.done])

    @property
    def warning(self) -> str:
        """A sentence about runs of other builds; empty: there are none."""
        return "; ".join(builds.warning for builds in self.builds if builds.warning)

    def _take(self, key: str, run: StudyRun) -> None:
        self._known[key] = run
        self.seconds += max(run.seconds, sum(run.timings))

    def _fingerprint(self, request: Request) -> str:
        mesh = self.mesh_file(request.mesh)
        return fingerprint(request, self._program(request), mesh, self.threads, self.processes_of(request))

    def processes_of(self, request: Request) -> int:
        return request.processes or self.processes

    def _program(self, request: Request) -> Program:
        return self.programs[request.method.program]

    def mesh_file(self, mesh: StudyMesh | None) -> Path | None:
        """The mesh made for the study; None: the driver makes it, or the case names it."""
        if mesh is None or not mesh.options:
            return None
        path = self._mesh_path(mesh)
        if self._mesh_is_made(mesh):
            return path
        if self.mesh_maker is None:
            raise no_mesh_maker()
        make_folder(path.parent)
        unfinished = path.with_name(f".{path.stem}{TEMPORARY}.msh")
        place = f"{self.study.path}: meshes.{mesh.name}"
        end = make_mesh([mesh.command, *mesh.options], unfinished, self.mesh_maker, place, path.parent / PARTS)
        if end.code:
            raise ProgramError(self.study.path, f"meshes.{mesh.name}", end.message, "change its options")
        os.replace(unfinished, path)
        write_text(path.with_suffix(".options.json"), json.dumps(recipe(mesh)))
        return path

    def _mesh_path(self, mesh: StudyMesh) -> Path:
        return self.folder / "meshes" / f"{mesh.name}.msh"

    def _mesh_is_made(self, mesh: StudyMesh) -> bool:
        path = self._mesh_path(mesh)
        try:
            made = read_json(path.with_suffix(".options.json"), AGAIN, AGAIN)
        except InputError:
            return False
        return is_file(path) and made == recipe(mesh)

    def standing(self, requests: Sequence[Request]) -> "Standing":
        """How many of the runs are there, without making any. The same run asked for twice counts once."""
        found: dict[str, StudyRun | None] = {}
        for request in requests:
            mesh = request.mesh
            if mesh is not None and mesh.options and not self._mesh_is_made(mesh):
                words = [str(request.case_file), request.method.name, mesh.name, *map(str, request.settings.items())]
                found["; ".join(words)] = None
            else:
                key = self._fingerprint(request)
                found[key] = self._finished(key, request)
        there = [run for run in found.values() if run is not None]
        return Standing(len(found), len(there), sum(not run.done for run in there))

    def _place(self, key: str, request: Request, repetition: str = "") -> Path:
        """The run's folder; `repetition`: -2, -3, ... of one that is timed again."""
        name = re.sub(r"[^A-Za-z0-9.+-]+", "-", f"{request.case}-{request.method.name}").strip("-")[:LONGEST_NAME]
        return self.folder / "runs" / f"{name}-{key[:12]}{repetition}"

    def _command(self, request: Request, folder: Path) -> list[str]:
        words = [str(self._program(request).path), str(request.case_file), "-o", str(folder), "-q"]
        words += ["--threads", str(self.threads)]
        mesh = self.mesh_file(request.mesh)
        settings = dict(request.settings)
        if mesh is not None:
            settings["mesh.file"] = str(absolute(mesh))
        elif request.mesh is not None:
            settings["mesh.level"] = request.mesh.name
        for name, value in settings.items():
            # A text by itself stands without quotation marks.
            words += ["--set", f"{name}={value if isinstance(value, str) else toml_value(value)}"]
        return launched(words, self.processes_of(request))

    def _finished(self, key: str, request: Request) -> StudyRun | None:
        folder = self._place(key, request)
        try:
            record = read_object(folder / RECORD, AGAIN, AGAIN)
            stopped_early = record["status"] == OUT_OF_TIME and record["seconds"] < request.time_limit
            if record["fingerprint"] != key or stopped_early or record.get("interrupted"):
                return None
            if record["status"] == DONE:
                read_summary(folder / FILE)
            told = record["status"], record["message"], float(record["seconds"]), record["command"]
            run = StudyRun(request, folder, *told, tuple(record.get("timings", ())))
            self._taken_up.count(self._program(request), record.get("executable", ""))
            return run
        except (OSError, ValueError, OverflowError, KeyError, TypeError, InputError):
            return None

    def _judge(self, key: str, request: Request, end: End) -> StudyRun:
        folder = self._place(key, request)
        status, message = judge(folder, end)
        command = shlex.join(self._command(request, folder))
        make_folder(folder)
        record = {"fingerprint": key, "status": status, "message": message, "seconds": end.seconds, "command": command}
        record |= {"run": request.label, "ended": time.strftime("%Y-%m-%d %H:%M:%S")}
        record |= {"executable": self._program(request).digest}
        # Ended from outside: that says nothing about the run, so that the next call makes it anew.
        interrupted = any(end.code in (-number, 128 + number) for number in interruption.WATCHED)
        write_record(folder, {**record, "interrupted": interrupted and not end.out_of_time})
        return StudyRun(request, folder, status, message, end.seconds, command)


def recipe(mesh: StudyMesh) -> list[str]:
    """What decides a mesh: its options, and the contents of the scripts and meshes that they name."""
    return [*mesh.options, *contents([mesh.command, *mesh.options])]


def write_record(folder: Path, record: dict[str, Any]) -> None:
    write_text(folder / RECORD, json.dumps(record, indent=1) + "\n")


def remove_runs(folder: Path) -> None:
    """Removes all runs that a study keeps in `folder`, unfinished ones too, but nothing of other commands."""
    for name in listed(folder / "runs"):
        if OWN_PLACE.fullmatch(name):
            remove_tree(folder / "runs" / name)


def sweep_study(folder: Path) -> None:
    """Removes the temporary files of calls that were killed. The folder must be locked: whose are they else?"""
    runs, meshes = folder / "runs", folder / "meshes"
    for place in (folder, runs, meshes, meshes / PARTS, *(runs / run for run in listed(runs))):
        for name in listed(place):
            if name.startswith(".") and TEMPORARY in name:
                remove_tree(place / name)


def judge(folder: Path, end: End) -> tuple[str, str]:
    """(status, message) of a run that has ended."""
    if end.out_of_time:
        return OUT_OF_TIME, end.message
    bad = first_not_finite(folder)
    if bad:
        return WRONG, bad
    if end.code:
        return {1: REFUSED, 2: NOT_CONVERGED}.get(end.code, CRASHED), end.message
    try:
        read_summary(folder / FILE)
    except InputError as error:
        return CRASHED, f"exit code 0, but {error}"
    return DONE, ""


def first_not_finite(folder: Path) -> str:
    """Names the first result file that holds NaN or infinity; empty: none does. A message may speak of them."""
    for name in sorted(name for name in listed(folder) if name.endswith(".csv") and is_file(folder / name)):
        if NOT_A_NUMBER.search(read_bytes(folder / name, AGAIN, AGAIN).decode("utf-8", "replace")):
            return f"{name} holds a value that is not a finite number"
    try:
        summary = read_object(folder / FILE, AGAIN, AGAIN)
    except InputError:
        return ""
    return "" if _finite(summary) else "summary.json holds a value that is not a finite number"


def _finite(value: Any) -> bool:
    if isinstance(value, (dict, list)):
        return all(map(_finite, value.values() if isinstance(value, dict) else value))
    return not isinstance(value, float) or math.isfinite(value)
