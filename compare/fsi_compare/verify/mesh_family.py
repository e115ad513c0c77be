"""Meshes of a family: how the user's own mesh is made, and the words that make one finer or coarser by a factor.

| own mesh | of a family by |
|---|---|
| `geo SCRIPT` | constants of the script that are sizes or counts (geo_sizes.py) |
| `artery ...` | its sizes and numbers of cells (artery_sizes.py); `--for`, `--level` and `--error` by the numbers that they come to |
| several commands, `geo ... | thicken ...` | what each of them has of sizes (chain_sizes.py) |
| a mesh file | `fsi-mesh refine`, finer only |
"""

import math
import shlex
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Sequence

from ..base.errors import InputError
from ..base.files import is_file, write_text
from ..gallery.mesh_chain import MARK, READ, SCRIPT, commands_of, links, with_places
from ..gallery.scene import Scene, read_scene
from ..study.study_file import StudyMesh
from .artery_sizes import artery_words, cells_of, require_numbers, waves_of, with_numbers
from .chain_sizes import Command, apart, number_in, sized, without
from .geo_sizes import GeoSizes, graded_text, read_sizes

HALVES = 2.0  # all that fsi-mesh refine makes
RATIOS = (1.5, 2.0, 1.4, 1.6, 1.75)  # between members
MADE_OF = ("lumen", "thicken", "refine")  # commands that take the file of their predecessor


@dataclass(frozen=True)
class Recipe:
    """How a mesh is made, with the counts that must stay whole."""

    command: str
    words: tuple[str, ...]  # behind the command; a .geo by its full path
    geo: GeoSizes | None = None
    given: Mapping[str, float] = None  # type: ignore[assignment]  # of --set
    file: Path | None = None  # of command "refine"
    chain: tuple[Command, ...] = ()  # of command "chain"

    @property
    def coarsens(self) -> bool:
        return self.command != "refine"

    @property
    def adapts(self) -> bool:
        """Whether meshes are made from runs on others (adapting.py)."""
        return False

    def ratio(self, levels: Sequence[int]) -> float:
        """Ratio between meshes at `levels`, powers of it."""
        return ratio_for(self.counts, levels) if self.coarsens else HALVES

    @property
    def counts(self) -> list[float]:
        if self.geo is not None:
            return [self.given.get(name, value) for name, value in self.geo.counts.items()]
        return [count for command in self.chain for count in command.counts] if self.chain else cells_of(self.words)

    def mesh(self, factor: float, folder: Path, case: str) -> StudyMesh | None:
        """The mesh finer by `factor`; None: the case's own file as it stands."""
        if self.chain:
            marked = [word for one in self.chain for word in (MARK, *one.finer(factor, folder))]
            _, command, *words = marked
        elif self.command == "geo":
            command, words = "geo", self.geo_words(factor, folder)
        elif self.command == "refine" and factor == 1:
            return None
        elif self.command == "refine":
            command, words = "refine", [str(self.file), "--times", str(round(math.log2(factor)))]
        else:
            command, words = "artery", artery_words(self.words, factor)
        return StudyMesh(f"{case[:40]}-x{factor:.4g}", f"{factor:.3g} times as fine", tuple(words), command)

    def unrefined(self, sizes: Sequence[float], folder: Path) -> dict[str, int]:
        """Layers of a wall with as many elements in meshes of all these sizes, relative to the case's, by name."""
        layers = [sized(command.finer(1 / size, folder), "").elements for command in self.chain for size in sizes]
        own = {name: number for command in self.chain for name, number in command.elements.items()}
        return {name: n for name, n in own.items() if all(one.get(name, n) == n for one in layers)}

    def geo_words(self, factor: float, folder: Path) -> list[str]:
        assert self.geo is not None
        script = self.geo.script
        if self.geo.graded and factor != 1:
            text = graded_text(script, factor)
            script = folder / "meshes" / f"{self.geo.script.stem}-x{factor:.4g}.geo"
            script.parent.mkdir(parents=True, exist_ok=True)
            write_text(script, text)
        settings = self.geo.settings(factor, dict(self.given)).items()
        words = [word for name, value in settings for word in ("--set", f"{name}={value:.10g}")]
        return [str(script), *without(self.words, ("--set",)), *words]


@dataclass(frozen=True)
class Script(Command):
    """`geo` as one command of a chain."""

    recipe: Recipe

    @property
    def counts(self) -> list[float]:
        return self.recipe.counts

    def finer(self, factor: float, folder: Path) -> list[str]:
        return ["geo", *self.recipe.geo_words(factor, folder)]


def ratio_for(counts: Sequence[float], levels: Sequence[int]) -> float:
    """The ratio between meshes: the first of RATIOS that leaves whole numbers of cells whole at `levels`, powers of the
    ratio; else the one that rounds least. Rounded counts make meshes that are no multiples of each other."""

    def rounding(ratio: float) -> float:
        wanted = [c * ratio**k for c in counts for k in levels]
        return max((abs(max(1, round(w)) / w - 1) for w in wanted), default=0.0)

    return min(RATIOS, key=lambda ratio: (round(rounding(ratio), 2), RATIOS.index(ratio)))


def find_recipe(case: Path, entries: Mapping[str, Any], named: str | None, mesh_maker: Path) -> Recipe:
    """The recipe by --mesh, the gallery's scene, the case's level or error, or its mesh file. Raises InputError."""
    element, geometry = str(entries.get("element", "p2p1")), str(entries.get("geometry", "3d"))
    section = entries.get("mesh", {})
    if not isinstance(section, dict):
        raise InputError(case, "mesh", "is no section", 'write [mesh] with file = "NAME.msh"')
    if named is not None:
        return _recipe(_split(named), Path("."), "--mesh", mesh_maker)
    if is_file(case.parent / "scene.py") and case.parent.name == case.stem:
        return recipe_of_scene(read_scene(case.parent), mesh_maker)
    if "level" in section or "error" in section:
        words = ["artery", *(["--axisymmetric"] if geometry == "axisymmetric" else [])]
        if "error" in section:
            words += ["--for", element, "--error", str(section["error"]), "--waves", waves_of(entries)]
        else:
            words += ["--level", str(section["level"]), *(["--order", "2"] if element == "p2p1" else [])]
        return _recipe(words, case.parent, str(case), mesh_maker)
    beside = words_beside(case, entries)
    if beside:
        return _recipe(beside, case.parent, "", mesh_maker)
    file = mesh_file_of(case, entries)
    if not is_file(file):
        remedy = 'make it, or say how it is made: --mesh "geo SCRIPT.geo", --mesh "lumen SURFACE.stl ... | thicken ..."'
        raise InputError(case, "mesh.file", f"there is no file {file}", remedy)
    return Recipe("refine", (), file=file)


def mesh_file_of(case: Path, entries: Mapping[str, Any]) -> Path:
    """The mesh file that a case names; its folder where it names none."""
    section = entries.get("mesh", {})
    return case.parent / str(section.get("file", "") if isinstance(section, dict) else "")


def words_beside(case: Path, entries: Mapping[str, Any]) -> list[str]:
    """Words of a mesh by the script .geo beside its file, with the script's own constants; none: there is no script."""
    file = mesh_file_of(case, entries)
    script = file.with_suffix(".geo") if file.name else file  # a case without a mesh file in the folder "."
    order = ["--order", "2"] if entries.get("element", "p2p1") == "p2p1" else []
    return ["geo", script.name, *order] if is_file(script) else []


def _split(text: str) -> list[str]:
    try:
        return shlex.split(text)
    except ValueError as error:
        raise InputError("", "--mesh", f"cannot be read: {error}", "close all quotation marks") from None


def recipe_of_scene(scene: Scene, mesh_maker: Path, quick: bool = False) -> Recipe:
    """The recipe for the mesh of a scene of the gallery."""
    return _recipe(scene.mesh_words(quick), scene.folder, str(scene.folder / "scene.py"), mesh_maker)


def _recipe(words: Sequence[str], folder: Path, source: str, mesh_maker: Path) -> Recipe:
    if MARK in words or (words and words[0] in ("lumen", "thicken")):
        return _chain(words, folder, source)
    if not words or words[0] not in ("geo", "artery"):
        problem = f"'{words[0] if words else ''}' makes no family of meshes"
        raise InputError(source, "", problem, "give the words of fsi-mesh geo or fsi-mesh artery, without -o")
    if words[0] == "geo":
        return _geo(words, folder, source)
    require_numbers(words, source)
    return Recipe("artery", tuple(with_numbers(list(words[1:]), mesh_maker)), given={})


def _chain(words: Sequence[str], folder: Path, source: str) -> Recipe:
    links(words, Path("mesh.msh"), source)  # raises where the order is wrong
    named = [apart(command) for command in commands_of(words)]
    found: list[Command] = []
    for number, command in enumerate(named):
        for word in command:
            if word in ("-o", "--output"):
                raise InputError(source, f"{command[0]} {word}", "names a file", "leave it out: each mesh gets its own")
            if word.endswith(READ) and not is_file(folder / word):
                raise InputError(source, f"{command[0]} {word}", "there is no such file", "give one that is there")
        full = with_places(command, folder.resolve())
        if command[0] == "geo":
            found.append(Script(tuple(full), _geo(command, folder, source)))
        elif command[0] in MADE_OF if number else command[0] == "lumen" or command[0].endswith(SCRIPT):
            found.append(sized(full, source))
        else:
            raise _without_sizes(command, folder, source)
    if not any(command[0] in ("geo", "lumen") for command in named):
        raise _without_sizes(named[-1], folder, source)
    return Recipe("chain", tuple(words), given={}, chain=tuple(found))


def _without_sizes(command: Sequence[str], folder: Path, source: str) -> InputError:
    """A command that makes no meshes of several sizes where it stands."""
    remedy = 'write "geo SCRIPT.geo | thicken ..." or "lumen SURFACE.stl --edges-per-diameter N | thicken ..."'
    if command[0] != "thicken":
        return InputError(source, "", f"'{command[0]}' makes no family of meshes", remedy)
    lumen = next((word for word in command if word.endswith(".msh")), None)
    if lumen is None:
        problem = "the lumen is filled from a surface whose triangles stay, so that it has no size that can be changed"
        return InputError(source, "thicken", problem, remedy)
    script = Path(lumen).with_suffix(".geo")
    if is_file(folder / script):
        remedy = f'write "geo {script} | thicken ...", without {lumen}'
    return InputError(source, "thicken", "the lumen is a mesh, which has no size that can be changed", remedy)


def _geo(words: Sequence[str], folder: Path, source: str) -> Recipe:
    place = next((i for i, word in enumerate(words) if word.endswith(".geo")), None)
    if place is None:
        raise InputError(source, "", "names no script .geo", 'write "geo SCRIPT.geo"')
    script = (folder / words[place]).resolve()
    others = [word for i, word in enumerate(words) if i not in (0, place)]
    return Recipe("geo", tuple(others), read_sizes(script), _given(others, source))


def _given(words: Sequence[str], source: str) -> dict[str, float]:
    """name=number of each --set."""
    found = {}
    for i, word in enumerate(words):
        text = word[len("--set=") :] if word.startswith("--set=") else words[i + 1] if word == "--set" else ""
        name, mark, value = text.partition("=")
        if mark:
            found[name] = number_in(value, f"--set {name}", source)
    return found
