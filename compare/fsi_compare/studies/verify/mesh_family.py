"""Meshes of a family: how the user's own mesh is made, and the words that make one finer or coarser by a factor.

| own mesh | of a family by |
|---|---|
| `geo SCRIPT` | constants of the script that are sizes or counts (geo_sizes.py) |
| `artery ...` | its sizes and numbers of cells; `--for`, `--level` and `--error` by the numbers that they come to |
| a mesh file | `fsi-mesh refine`, finer only |
"""

import math
import re
import shlex
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

from ...base.errors import InputError
from ...base.files import is_file, replacing
from ..gallery.mesh_chain import MARK
from ..gallery.scene import Scene, read_scene
from ..running.study_file import StudyMesh
from ..starting.processes import answer
from .geo_sizes import GeoSizes, graded_text, read_sizes

HALVES = 2.0  # all that fsi-mesh refine makes
RATIOS = (1.5, 2.0, 1.4, 1.6, 1.75)  # between members
LEVEL_SIZES = ("--level", "--for", "--error", "--waves")
RECOMMENDED = re.compile(
    r"cells through lumen (\d+)(?: \(graded ([\d.]+) to the wall\))?, media (\d+)(?:, adventitia (\d+))?"
    r"(?:, around (\d+))?, along the axis (\d+)(?: \(graded ([\d.]+) to the inlet\))?"
)
CELLS = ("--lumen-cells", "--media-cells", "--adventitia-cells", "--around", "--axial-cells")
SIZE_OPTIONS = ("--size", "--axial-size")
# mm across and along, as common/mesh/artery/options.cpp has them: fsi-mesh says them nowhere
LEVELS = {"coarse": (0.75, 0.78), "intermediate": (0.375, 0.34), "fine": (0.1875, 0.168)}


@dataclass(frozen=True)
class Recipe:
    """How a mesh is made, with the counts that must stay whole."""

    command: str
    words: Tuple[str, ...]  # behind the command; a .geo by its full path
    geo: Optional[GeoSizes] = None
    given: Mapping[str, float] = None  # type: ignore[assignment]  # of --set
    file: Optional[Path] = None  # of command "refine"

    @property
    def coarsens(self) -> bool:
        return self.command != "refine"

    @property
    def adapts(self) -> bool:
        """Whether meshes are made from runs on others (adapting.py)."""
        return False

    def ratio(self, levels: Sequence[int]) -> float:
        """Between meshes at `levels`, powers of it."""
        return ratio_for(self.counts, levels) if self.coarsens else HALVES

    @property
    def counts(self) -> List[float]:
        if self.geo is not None:
            return [self.given.get(name, value) for name, value in self.geo.counts.items()]
        found = _options(self.words)
        return [float(found[name]) for name in CELLS if name in found]

    def mesh(self, factor: float, folder: Path, case: str) -> Optional[StudyMesh]:
        """Of the mesh finer by `factor`; None: the case's own file as it stands."""
        name = f"{case[:40]}-x{factor:.4g}"
        if self.command == "geo":
            return StudyMesh(name, f"{factor:.3g} times as fine", tuple(self._geo_words(factor, folder)), "geo")
        if self.command == "refine":
            words = (str(self.file), "--times", str(round(math.log2(factor))))  # halves
            return None if factor == 1 else StudyMesh(name, f"{factor:.3g} times as fine", words, "refine")
        return StudyMesh(name, f"{factor:.3g} times as fine", tuple(_artery_words(self.words, factor)), "artery")

    def _geo_words(self, factor: float, folder: Path) -> List[str]:
        assert self.geo is not None
        script = self.geo.script
        if self.geo.graded and factor != 1:
            text, _ = graded_text(script, factor)
            script = folder / "meshes" / f"{self.geo.script.stem}-x{factor:.4g}.geo"
            script.parent.mkdir(parents=True, exist_ok=True)
            with replacing(script) as temporary:
                temporary.write_text(text, encoding="utf-8")
        words = [str(script), *_without_set(self.words)]
        for name, value in self.geo.settings(factor, dict(self.given)).items():
            words += ["--set", f"{name}={value:.10g}"]
        return words


def ratio_for(counts: Sequence[float], levels: Sequence[int]) -> float:
    """Between meshes: the first of RATIOS that leaves whole numbers of cells whole at `levels`, powers of the ratio; where
    none does, that which rounds them least. Rounded counts make meshes that are no multiples of each other."""

    def rounding(ratio: float) -> float:
        wanted = [c * ratio**k for c in counts for k in levels]
        return max((abs(max(1, round(w)) / w - 1) for w in wanted), default=0.0)

    return min(RATIOS, key=lambda ratio: (round(rounding(ratio), 2), RATIOS.index(ratio)))


def find_recipe(case: Path, entries: Mapping[str, Any], named: Optional[str], mesh_maker: Path) -> Recipe:
    """By --mesh, the scene of the gallery, the case's level or error, or its mesh file. Raises InputError."""
    element, geometry = str(entries.get("element", "p2p1")), str(entries.get("geometry", "3d"))
    section = entries.get("mesh", {})
    if named is not None:
        return _recipe(shlex.split(named), Path("."), "--mesh", mesh_maker)
    if is_file(case.parent / "scene.py") and case.parent.name == case.stem:
        return recipe_of_scene(read_scene(case.parent), mesh_maker)
    if "level" in section or "error" in section:
        words = ["artery", *(["--axisymmetric"] if geometry == "axisymmetric" else [])]
        if "error" in section:
            words += ["--for", element, "--error", str(section["error"])]
            words += ["--waves", str(section["waves"])] if "waves" in section else []
        else:
            words += ["--level", str(section["level"]), *(["--order", "2"] if element == "p2p1" else [])]
        return _recipe(words, case.parent, str(case), mesh_maker)
    file = case.parent / str(section.get("file", ""))
    script = file.with_suffix(".geo")
    if is_file(script):
        return _recipe(
            ["geo", script.name, *(["--order", "2"] if element == "p2p1" else [])], case.parent, "", mesh_maker
        )
    if not is_file(file):
        remedy = 'make it, or say how it is made: --mesh "geo SCRIPT.geo", --mesh "artery --level coarse"'
        raise InputError(case, "mesh.file", f"there is no file {file}", remedy)
    return Recipe("refine", (), file=file)


def recipe_of_scene(scene: Scene, mesh_maker: Path, quick: bool = False) -> Recipe:
    """Of the mesh that a scene of the gallery names."""
    return _recipe(scene.mesh_words(quick), scene.folder, str(scene.folder / "scene.py"), mesh_maker)


def _recipe(words: Sequence[str], folder: Path, source: str, mesh_maker: Path) -> Recipe:
    if MARK in words:
        remedy = "make its mesh, and name it by mesh.file in a copy of the case: its cells are halved then"
        raise InputError(source, "", "a mesh of several commands makes no family of meshes", remedy)
    if not words or words[0] not in ("geo", "artery"):
        what = words[0] if words else ""
        problem = f"'{what}' makes no family of meshes"
        raise InputError(source, "", problem, "give the words of fsi-mesh geo or fsi-mesh artery, without -o")
    if words[0] == "geo":
        place = next((i for i, word in enumerate(words) if word.endswith(".geo")), None)
        if place is None:
            raise InputError(source, "", "names no script .geo", 'write "geo SCRIPT.geo"')
        script = (folder / words[place]).resolve()
        others = [word for i, word in enumerate(words) if i not in (0, place)]
        return Recipe("geo", tuple(others), read_sizes(script), _given(others))
    return Recipe("artery", tuple(_with_numbers(list(words[1:]), mesh_maker)), given={})


def _given(words: Sequence[str]) -> Dict[str, float]:
    """name=number of each --set."""
    found = {}
    for i, word in enumerate(words):
        text = word[len("--set=") :] if word.startswith("--set=") else words[i + 1] if word == "--set" else ""
        name, mark, value = text.partition("=")
        if mark:
            found[name] = float(value)
    return found


def _without_set(words: Sequence[str]) -> List[str]:
    kept, skip = [], False
    for word in words:
        if not skip and word != "--set" and not word.startswith("--set="):
            kept.append(word)
        skip = word == "--set"
    return kept


def _options(words: Sequence[str]) -> Dict[str, str]:
    """Of --name value and --name=value; a flag has an empty value."""
    found: Dict[str, str] = {}
    for i, word in enumerate(words):
        if word.startswith("--"):
            name, mark, value = word.partition("=")
            following = words[i + 1] if i + 1 < len(words) and not words[i + 1].startswith("--") else ""
            found[name] = value if mark else following
    return found


def _with_numbers(words: List[str], mesh_maker: Path) -> List[str]:
    """In the place of a recommended mesh the numbers of cells that fsi-mesh says it has."""
    options = _options(words)
    if "--for" not in options:
        return words
    try:
        with tempfile.TemporaryDirectory() as place:
            said = answer([mesh_maker, "artery", *words, "-o", Path(place) / "mesh.msh"], 600)
    except OSError as error:
        raise InputError(mesh_maker, "artery", f"gives no answer: {error}", "build it again") from None
    numbers = RECOMMENDED.search(said)
    if numbers is None:
        raise InputError(
            mesh_maker, "artery --for", "does not say its numbers of cells", 'give them by --mesh "artery ..."'
        )
    lumen, wall, media, adventitia, around, axial, inlet = numbers.groups()
    kept = _without(words, LEVEL_SIZES)
    kept += ["--lumen-cells", lumen, "--media-cells", media, "--axial-cells", axial]
    for name, value in (("--adventitia-cells", adventitia), ("--around", around)):
        kept += [name, value] if value is not None else []
    for name, value in (("--lumen-grading", wall), ("--axial-grading", inlet)):
        kept += [name, value] if value is not None else []
    return kept if "--order" in options else [*kept, "--order", "2"]


def _without(words: Sequence[str], names: Sequence[str]) -> List[str]:
    kept, skip = [], False
    for word in words:
        name = word.partition("=")[0]
        if skip and not word.startswith("--"):
            skip = False
            continue
        skip = name in names and "=" not in word
        if name not in names:
            kept.append(word)
    return kept


def _artery_words(words: Sequence[str], factor: float) -> List[str]:
    """Counts times the factor, sizes by it."""
    options = _options(words)
    changed: Dict[str, str] = {}
    for name in CELLS:
        if name in options:
            changed[name] = str(max(1, round(float(options[name]) * factor)))
    for name in SIZE_OPTIONS:
        if name in options:
            changed[name] = f"{float(options[name]) / factor:.8g}"
    kept = _without(words, tuple(changed))
    for name, value in changed.items():
        kept += [name, value]
    if not changed:
        size, along = LEVELS[options.get("--level") or "coarse"]
        kept = _without(kept, ("--level",))
        kept += ["--size", f"{size / factor:.8g}", "--axial-size", f"{along / factor:.8g}"]
    return kept
