"""A study file (TOML): cases, methods, meshes, what is varied, and what the report is about."""

import itertools
import math
import re
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Iterable, Mapping, Sequence

from ..base.case_names import short_name
from ..base.errors import InputError
from ..base.files import absolute, exists, is_file, read_toml
from ..base.suggestions import hint
from ..gallery.mesh_chain import with_places
from ..gallery.scene import READY, Scene, read_scene, ready_scenes
from ..starting.launch import usable_cores
from . import source_tree
from .mesh_levels import MESHES
from .section import LARGEST_COUNT, LARGEST_NUMBER, Section

PROGRAMS = ("fsi-monolithic", "fsi-partitioned")
MESH = "mesh"  # among what is varied: a level or a section of [meshes]
PROCESSES = "processes"  # among what is varied: numbers, or
CORES = "cores"  # for 1, 2, 4, ... up to the cores that may be used, the last number included

Entries = Mapping[str, Any]  # of a case, by full keys, or of a section
LONGEST_NAME = 200  # characters of a key
MOST_RUNS = 100_000
FILE_NAME = re.compile(r"[^/.][^/]{0,59}")

TOP_KEYS = ("title", "kind", "threads", "processes", "jobs", "time_limit", "repeats", "repeat_below", "set")
TOP_TABLES = ("cases", "methods", "meshes", "runs", "report")
METHOD_KEYS = ("program", "label", "set")
CASE_KEYS = ("file", "scene", "set")
MESH_KEYS = ("options", "label")
GROUP_KEYS = ("cases", "methods", "set", "vary", "quick")
VALUE_KEYS = ("label", "set", "mesh", "processes")


@dataclass(frozen=True)
class Method:
    name: str
    label: str
    program: str
    settings: Entries


@dataclass(frozen=True)
class StudyMesh:
    name: str
    label: str
    options: tuple[str, ...]  # of fsi-mesh's command; empty: a level of the same name, made by the driver on demand
    command: str = "artery"  # others may follow among the options (gallery/mesh_chain.py)


@dataclass(frozen=True)
class Request:
    """One run that a study asks for, by what it is and where it stands in the study."""

    group: str
    case: str
    method: Method
    values: Entries  # label or value of each quantity that the group varies, by its name
    case_file: Path
    mesh: StudyMesh | None  # None: the case file's own
    settings: Entries  # entries over the case file's, without the mesh
    time_limit: float  # s
    processes: int | None = None  # None: as many as the study's other runs

    @property
    def label(self) -> str:
        values = [f"{short_name(key)} {show(value)}" for key, value in self.values.items()]
        return ", ".join(part for part in [self.case, self.method.name, *values] if part)


@dataclass(frozen=True)
class Study:
    path: Path
    title: str
    kind: str
    threads: int
    jobs: int
    time_limit: float  # s
    cases: Mapping[str, Path]
    methods: Mapping[str, Method]
    meshes: Mapping[str, StudyMesh]
    requests: Sequence[Request]
    report: Entries  # settings of the report, checked by its kind
    quick: bool
    repeats: int = 1  # of each run that takes less than `repeat_below` s, in full: its seconds are then their median
    repeat_below: float = 60.0
    settings: Entries = field(default_factory=dict)  # of all runs
    case_settings: Mapping[str, Entries] = field(default_factory=dict)  # of all runs of a case
    processes: int = 1  # of each run whose group does not say
    scenes: Mapping[str, Scene] = field(default_factory=dict)  # of the cases that are scenes of the gallery


def method_of(driver: str) -> Method:
    """A driver as it is: `monolithic` or `partitioned`."""
    return Method(driver, driver, f"fsi-{driver}", {})


def study_of_case(
    path: Path, kind: str, name: str, case: Path, methods: Mapping[str, Method], threads: int, time_limit: float
) -> Study:
    """The study of a command that decides on its runs itself, one at a time; `path`: the user's case."""
    return Study(path, name, kind, threads, 1, time_limit, {name: case}, methods, {}, (), {}, False)


def mesh_of_scene(scene: Scene | None, quick: bool) -> StudyMesh | None:
    """Its files named by their full paths; None where a case is no scene."""
    if scene is None:
        return None
    command, *options = with_places(scene.mesh_words(quick), scene.folder)
    return StudyMesh(scene.name + ("-quick" if quick else ""), "", tuple(options), command)


def show(value: Any) -> str:
    return format(value, "g") if isinstance(value, float) else str(value)


def read_study(path: Path, kinds: Sequence[str], quick: bool = False) -> Study:
    """Reads a study file. Raises InputError naming the key unless the study can be run. `quick`: each group in its
    quick form; groups without one are left out."""
    if not exists(path):
        raise InputError(path, "", "no such study", "give a study file, or the name of a ready one")
    data = read_toml(path, "give a study file, or the name of a ready one", "give a study file")
    _require_shown(path, "", data)
    return _Reader(path, quick).study(data, kinds)


def _require_shown(path: Path, key: str, entry: Any) -> None:
    """Names and texts end in tables, reports and names of files: they must be such that people can read them."""
    if isinstance(entry, dict):
        for name, value in entry.items():
            full = f"{key}.{name}".lstrip(".")
            if not name.isprintable():
                raise InputError(path, full, "holds a control character", "choose another name")
            if len(name) > LONGEST_NAME:
                raise InputError(path, full, f"has more than {LONGEST_NAME} characters", "choose another name")
            _require_shown(path, full, value)
    elif isinstance(entry, list):
        for value in entry:
            _require_shown(path, key, value)
    elif isinstance(entry, str) and not " ".join(entry.split()).isprintable():
        raise InputError(path, key, "holds a control character", "leave it out")


@dataclass(frozen=True)
class _Value:
    """A value of a quantity that a group varies."""

    shown: Any
    settings: Entries = field(default_factory=dict)
    mesh: StudyMesh | None = None
    processes: int | None = None


class _Reader:
    def __init__(self, path: Path, quick: bool):
        self.path, self.quick = path, quick
        self.scenes: dict[str, Scene] = {}  # of the cases that are scenes

    def wrong(self, key: str, problem: str, remedy: str) -> InputError:
        return InputError(self.path, key, problem, remedy)

    def study(self, data: dict[str, Any], kinds: Sequence[str]) -> Study:
        top = self.section("", data, (*TOP_KEYS, *TOP_TABLES))
        kind = top.text("kind")
        if kind not in kinds and kind in source_tree.KINDS:
            raise source_tree.refusal(self.path, "kind", f"the kind '{kind}'")
        kind = self.one_of("kind", kind, kinds)
        entries = top.table("cases", True)
        cases = {name: self.case(name, entry) for name, entry in entries.items()}
        short = {name: scene.quick for name, scene in self.scenes.items()} if self.quick else {}
        of_case = {
            name: {**short.get(name, {}), **self.section(f"cases.{name}", entry, CASE_KEYS).settings("set")}
            for name, entry in entries.items()
            if isinstance(entry, dict)
        }
        methods = {name: self.method(name, entry) for name, entry in top.table("methods", True).items()}
        meshes = {level: StudyMesh(level, level, ()) for level in MESHES}
        for name, entry in top.table("meshes").items():
            meshes[name] = self.mesh(name, entry)
        repeats, settings = top.count("repeats", 1), top.settings("set")
        study = Study(
            path=self.path,
            title=top.text("title"),
            kind=kind,
            threads=top.count("threads", 1),
            processes=top.count("processes", 1),
            jobs=top.count("jobs", 1),
            time_limit=top.number("time_limit", 3600.0),
            repeats=1 if self.quick else repeats,
            repeat_below=top.number("repeat_below", 60.0),
            cases=cases,
            methods=methods,
            meshes=meshes,
            requests=(),
            report=top.table("report"),
            quick=self.quick,
            settings=settings,
            case_settings=of_case,
            scenes=self.scenes,
        )
        groups = [self.group(name, group, study) for name, group in top.table("runs").items()]
        return replace(study, requests=[request for group in groups for request in group])

    def case(self, name: str, entry: Any) -> Path:
        """A file name, or a section with `set` and either `file` or `scene`, the name of a scene of the gallery."""
        file = entry
        if isinstance(entry, dict):
            self.section(f"cases.{name}", entry, CASE_KEYS)
            if "scene" in entry:
                return self.scene(name, entry)
            file = entry.get("file")
        if not isinstance(file, str):
            raise self.wrong(f"cases.{name}", "is not a file name", "give the case file, relative to the study")
        path = absolute(self.path.parent / file)
        if not is_file(path):
            raise self.wrong(f"cases.{name}", f"no such case file: {path}", "give it relative to the study file")
        return path

    def scene(self, name: str, entry: dict[str, Any]) -> Path:
        key = f"cases.{name}.scene"
        if "file" in entry:
            raise self.wrong(key, "has a file beside it", "give one of the two")
        self.scenes[name] = read_scene(READY / self.one_of(key, entry["scene"], ready_scenes()))
        return self.scenes[name].case

    def method(self, name: str, entry: Any) -> Method:
        section = self.section(f"methods.{name}", entry, METHOD_KEYS)
        program = self.one_of(section.key_of("program"), section.text("program"), PROGRAMS)
        return Method(name, section.text("label", name), program, section.settings("set"))

    def mesh(self, name: str, entry: Any) -> StudyMesh:
        key = f"meshes.{name}"
        section = self.section(key, entry, MESH_KEYS)
        if name in MESHES:
            raise self.wrong(key, "is a level's name already", "choose another name")
        options = entry.get("options")
        if not isinstance(options, list) or not options or not all(isinstance(word, str) for word in options):
            remedy = 'give options of fsi-mesh artery, e.g. ["--size", "0.5"]'
            raise self.wrong(f"{key}.options", "is not a list of words", remedy)
        if not FILE_NAME.fullmatch(name):
            raise self.wrong(key, "is no name for a file", "choose a short one without '/'")
        return StudyMesh(name, section.text("label", name), tuple(options))

    def group(self, name: str, group: Any, study: Study) -> list[Request]:
        key = f"runs.{name}"
        self.section(key, group, GROUP_KEYS)
        quick = group.get("quick", False)
        if not isinstance(quick, bool):
            self.section(f"{key}.quick", quick, GROUP_KEYS[:-1])
        if self.quick:
            if quick is False:
                return []
            if quick is not True:
                group = {**group, **quick}
        names = self.names(group, "cases", study.cases, key)
        chosen = [study.methods[method] for method in self.names(group, "methods", study.methods, key)]
        section = self.section(key, group, GROUP_KEYS)
        own, vary = section.settings("set"), section.table("vary")
        axes = [self.axis(f"{key}.vary.{quantity}", quantity, vary[quantity], study.meshes) for quantity in vary]
        if len(names) * len(chosen) * math.prod(len(axis) for axis in axes) > MOST_RUNS:
            raise self.wrong(key, f"asks for more than {MOST_RUNS} runs", "vary less in one group")
        requests = []
        for case, method, point in itertools.product(names, chosen, itertools.product(*axes)):
            scene = self.scenes.get(case)
            if scene is not None and method.program not in scene.drivers:
                continue
            merged = {**study.settings, **study.case_settings.get(case, {}), **method.settings, **own}
            values, mesh, processes = {}, mesh_of_scene(scene, self.quick), None
            for quantity, value in point:
                values[quantity] = value.shown
                merged.update(value.settings)
                mesh = value.mesh or mesh
                processes = value.processes or processes
            file, limit = study.cases[case], study.time_limit
            requests.append(Request(name, case, method, values, file, mesh, merged, limit, processes))
        return requests

    def axis(self, key: str, quantity: str, values: Any, meshes: Mapping[str, StudyMesh]) -> list[tuple[str, _Value]]:
        """The quantity with each of its values, or with those that "cores" stands for."""
        if quantity == PROCESSES and values == CORES:
            most = usable_cores()
            values = [*(2**power for power in range(most.bit_length()) if 2**power < most), most]
        if not isinstance(values, list) or not values:
            raise self.wrong(key, "is not a list of values", "write [a, b, ...]")
        return [(quantity, self.value(key, quantity, value, meshes)) for value in values]

    def value(self, key: str, quantity: str, value: Any, meshes: Mapping[str, StudyMesh]) -> _Value:
        """One value on an axis."""
        if quantity == MESH:
            return _Value(value, mesh=meshes[self.one_of(key, value, meshes)])
        if quantity == PROCESSES:
            return _Value(value, processes=self.processes(key, value))
        if isinstance(value, dict):
            section = self.section(key, value, VALUE_KEYS)
            if "label" not in value:
                raise self.wrong(key, "a value with settings has no label", 'write { label = "...", set = { ... } }')
            self.scalar(f"{key}.label", value["label"])
            mesh = meshes[self.one_of(f"{key}.mesh", value["mesh"], meshes)] if "mesh" in value else None
            processes = self.processes(f"{key}.processes", value["processes"]) if "processes" in value else None
            return _Value(value["label"], section.settings("set"), mesh, processes)
        self.scalar(key, value)
        if "." not in quantity:
            problem = "is neither 'mesh', 'processes' nor a key of the case file"
            raise self.wrong(key, problem, 'give a key such as "time.step", or values { label, set }')
        return _Value(value, {quantity: value})

    def processes(self, key: str, value: Any) -> int:
        if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= LARGEST_COUNT:
            remedy = f'give whole numbers from 1 to {LARGEST_COUNT}, or "{CORES}" in place of the list'
            raise self.wrong(key, f"{show(value)} is no number of processes", remedy)
        return value

    def section(self, key: str, entry: Any, keys: Sequence[str]) -> Section:
        return Section(self.path, key, entry, keys)

    def one_of(self, key: str, name: Any, names: Iterable[str]) -> str:
        if not isinstance(name, str) or name not in names:
            raise self.wrong(key, f"'{name}' is unknown", hint(str(name), names, "There are"))
        return name

    def names(self, group: dict[str, Any], name: str, known: Entries, section: str) -> list[str]:
        """Cases or methods: those that a group names, or all."""
        given = group.get(name, list(known))
        if not isinstance(given, list):
            raise self.wrong(f"{section}.{name}", "is not a list of names", "write [a, b, ...]")
        return list(dict.fromkeys([self.one_of(f"{section}.{name}", entry, known) for entry in given]))

    def scalar(self, key: str, value: Any) -> None:
        if not isinstance(value, (str, int, float)) or (isinstance(value, int) and abs(value) > LARGEST_NUMBER):
            remedy = "write { label = ..., set = { ... } } for others"
            raise self.wrong(key, f"{show(value)} is no number or text", remedy)
