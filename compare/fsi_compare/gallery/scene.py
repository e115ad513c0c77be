"""What a scene of the gallery is: a folder `gallery/NAME/` with a case `NAME.toml`, a module `scene.py` and what the
mesh is made from.

`scene.py` holds
  its docstring   the scene's page: a title, an empty line, paragraphs of Markdown
  MESH            the words of the fsi-mesh command that makes its mesh, without -o; or several commands (mesh_chain.py)
  numbers(runs)   what is measured, beside what is known: a list of Number
  draw(runs)      a matplotlib Figure
and may hold
  DRIVERS         the drivers that run it, both unless said otherwise: a static wall knows one
  QUICK           entries of the case that make a run of the scene's test, a second or two
  QUICK_MESH      the same for that run's mesh
  STILL           words of RunResults.picture: which field, time, view its picture shows
  known_curve(name, times)   values at times in ms of a curve that is known exactly, by its name in `fsi-compare verify`
                  ("inner wall: radial") and in its unit; of a line that has the same value everywhere. None: it is not known
  LONG            True: takes minutes, run when it is named or all are asked for by --long
"""

import shlex
import sys
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any, Mapping, Sequence

from ..base.errors import InputError
from ..base.files import exists, is_file, is_folder, listed, read_text, read_toml
from ..base.suggestions import nearest
from ..results.run import RunResults, open_run
from ..results.table import Table
from ..runs.coupling import coupling_words

BOTH = ("fsi-monolithic", "fsi-partitioned")
READY = Path(__file__).resolve().parents[3] / "gallery"
PEERS = "peers"  # folder of READY with the scenes that are cases of other programs


@dataclass(frozen=True)
class Number:
    """`value` in a run of `program` beside the `reference`, from which it may differ by `tolerance` of it."""

    what: str
    unit: str
    program: str
    value: float
    reference: float
    tolerance: float  # relative to `scale`
    source: str  # of the reference: a formula, a publication
    scale: float = 0.0  # what the tolerance counts in; 0: the reference
    spread: float = 0.0  # by which published values of others differ among each other, relative; 0: not known
    model: float = 0.0  # relative error of the reference's model, where it is another one; 0: it is this one
    reason: str = ""  # why the value should differ from the reference, for people

    @property
    def error(self) -> float:
        return abs(self.value - self.reference) / (self.scale or abs(self.reference))

    @property
    def holds(self) -> bool:
        return self.error <= self.tolerance  # a NaN does not


@dataclass(frozen=True)
class SceneRun:
    """A finished run of a scene."""

    folder: Path
    program: str
    summary: dict[str, Any]
    seconds: float

    @property
    def words(self) -> str:
        """A name for legends: `monolithic`, `partitioned (interface, iqn-ils)`."""
        return coupling_words(self.program, self.summary)

    @property
    def results(self) -> RunResults:
        """The folder as arrays with units (docs/guide/reports.md#python)."""
        return open_run(self.folder)

    def table(self, name: str) -> Table:
        """A table of the folder, `flow.csv` for one."""
        return self.results.table(name)


@dataclass(frozen=True)
class SceneRuns:
    """What `numbers` and `draw` are given: runs by program, in the order of the scene's drivers."""

    runs: Mapping[str, SceneRun]
    quick: bool

    def __iter__(self) -> Any:
        return iter(self.runs.values())

    @property
    def first(self) -> SceneRun:
        return next(iter(self.runs.values()))


@dataclass(frozen=True)
class Scene:
    folder: Path
    name: str
    title: str
    paragraphs: tuple[str, ...]
    mesh: str
    drivers: tuple[str, ...]
    module: ModuleType = field(repr=False)
    quick_mesh: str = ""
    long: bool = False
    quick: Mapping[str, Any] = field(default_factory=dict)

    @property
    def case(self) -> Path:
        return self.folder / f"{self.name}.toml"

    @property
    def at_rest(self) -> bool:
        """Whether its steps are those of a load that is raised, and its times shares of that load."""
        return "static" in read_toml(self.case, "name the case after the folder", "mend the case")

    @property
    def place(self) -> str:
        """The folder as a user of the sources would type it."""
        above = f"{PEERS}/" if self.folder.parent.name == PEERS else ""
        return f"gallery/{above}{self.name}"

    def mesh_words(self, quick: bool) -> list[str]:
        return shlex.split((quick and self.quick_mesh) or self.mesh)

    def numbers(self, runs: SceneRuns) -> list[Number]:
        return list(self.module.numbers(runs))

    def known_curve(self, name: str, times: Any) -> Any:
        """Exact values at times in ms, (times,); None: they are not known."""
        known = getattr(self.module, "known_curve", None)
        return None if known is None else known(name, times)


def scene_names(folder: Path = READY) -> list[str]:
    return [name for name in listed(folder) if is_file(folder / name / "scene.py")]


def ready_scenes() -> list[str]:
    """Names of all scenes that come with the program, from its gallery's folder on: `womersley`, `peers/mok-flap`."""
    return [*scene_names(), *(f"{PEERS}/{name}" for name in scene_names(READY / PEERS))]


def find_scenes(wanted: Sequence[str], folder: Path = READY) -> list[Scene]:
    """The scenes named, all when none is. Raises InputError for a name that is no scene's."""
    names = scene_names(folder)
    if not names:
        raise InputError(folder, "", "holds no scene", "take it from the sources of fsi-duo")
    for name in wanted:
        if name not in names:
            raise InputError("", "", f"'{name}' is no scene", f"did you mean {nearest(name, names)}?")
    return [read_scene(folder / name) for name in wanted or names]


def read_scene(folder: Path) -> Scene:
    """Reads a scene's folder. Raises InputError."""
    if str(READY) not in sys.path:
        sys.path.append(str(READY))  # scenes import from known_solutions
    path = folder / "scene.py"
    if not is_folder(folder) or not exists(path):
        raise InputError(path, "", "no such file", "a scene is a folder with scene.py and a case")
    module = ModuleType(f"scene_{folder.name.replace('-', '_')}")
    text = read_text(path, "give a folder of the gallery", "mend the scene")
    try:
        exec(compile(text, str(path), "exec"), module.__dict__)  # and not imported, which would leave a file beside it
        title, _, page = (module.__doc__ or "").strip().partition("\n\n")
        scene = Scene(
            folder=folder,
            name=folder.name,
            title=title,
            paragraphs=tuple(" ".join(part.split()) for part in page.split("\n\n") if part.strip()),
            mesh=module.MESH,
            drivers=tuple(getattr(module, "DRIVERS", BOTH)),
            module=module,
            quick_mesh=getattr(module, "QUICK_MESH", ""),
            long=bool(getattr(module, "LONG", False)),
            quick=dict(getattr(module, "QUICK", {})),
        )
    except Exception as error:  # whatever the scene's text does
        raise InputError(path, "", f"cannot be loaded: {type(error).__name__}: {error}", "mend the scene") from None
    for needed in ("numbers", "draw"):
        if not hasattr(module, needed):
            raise InputError(path, needed, "is missing", "see fsi_compare/gallery/scene.py")
    if not is_file(scene.case):
        raise InputError(scene.case, "", "no such file", "a scene's case is named after its folder")
    return scene
