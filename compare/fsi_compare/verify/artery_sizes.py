"""Which words of `fsi-mesh artery` say how fine its mesh is, and the words for a mesh that is finer by a factor."""

import re
import tempfile
from pathlib import Path
from typing import Any, Mapping, Sequence

from ..base.errors import InputError
from ..base.numbers import is_number
from ..starting.processes import answer
from .chain_sizes import number_in, options_of, without

LEVEL_SIZES = ("--level", "--for", "--error", "--waves")
RECOMMENDED = re.compile(
    r"cells through lumen (\d+)(?: \(graded ([\d.]+) to the wall\))?, media (\d+)(?:, adventitia (\d+))?"
    r"(?:, around (\d+))?, along the axis (\d+)(?: \(graded ([\d.]+) to the inlet\))?"
)
CELLS = ("--lumen-cells", "--media-cells", "--adventitia-cells", "--around", "--axial-cells")
SIZE_OPTIONS = ("--size", "--axial-size")
SHORT_STEP = 0.1  # ms, as common/case/case_reader.cpp has it: second order keeps waves that longer steps let die
# mm across and along, as common/mesher/artery/options.cpp has them: fsi-mesh says them nowhere
LEVELS = {"coarse": (0.75, 0.78), "intermediate": (0.375, 0.34), "fine": (0.1875, 0.168)}


def keeps_short_waves(entries: Mapping[str, Any]) -> bool:
    """Whether the drivers take mesh.error of a case for resolved waves."""
    time = entries.get("time", {})
    if "static" in entries or time.get("scheme") == "euler":  # of first order
        return False
    step = time.get("step", 1.0)
    return bool(step == "adaptive" or (is_number(step) and step <= SHORT_STEP))


def waves_of(entries: Mapping[str, Any]) -> str:
    """Waves that mesh.error of a case is for: "damped" or "resolved"."""
    return str(entries.get("mesh", {}).get("waves") or ("resolved" if keeps_short_waves(entries) else "damped"))


def require_numbers(words: Sequence[str], source: str) -> None:
    """Raises InputError for a size that is no number, or a level that is none."""
    options = options_of(words)
    for name in (*CELLS, *SIZE_OPTIONS):
        if name in options:
            number_in(options[name], f"artery {name}", source)
    level = options.get("--level") or "coarse"
    if level not in LEVELS:
        raise InputError(source, "artery --level", f"'{level}' is no level", f"there are {', '.join(LEVELS)}")


def cells_of(words: Sequence[str]) -> list[float]:
    """Numbers of cells that are given."""
    found = options_of(words)
    return [float(found[name]) for name in CELLS if name in found]


def with_numbers(words: list[str], mesh_maker: Path) -> list[str]:
    """The words with the numbers of cells that fsi-mesh reports in the place of a recommended mesh."""
    options = options_of(words)
    if "--for" not in options:
        return words
    try:
        with tempfile.TemporaryDirectory() as place:
            said = answer([mesh_maker, "artery", *words, "-o", Path(place) / "mesh.msh"], 600)
    except OSError as error:
        raise InputError(mesh_maker, "artery", f"gives no answer: {error}", "build it again") from None
    numbers = RECOMMENDED.search(said)
    if numbers is None:
        remedy = 'give them by --mesh "artery ..."'
        raise InputError(mesh_maker, "artery --for", "does not say its numbers of cells", remedy)
    lumen, wall, media, adventitia, around, axial, inlet = numbers.groups()
    kept = without(words, LEVEL_SIZES)
    kept += ["--lumen-cells", lumen, "--media-cells", media, "--axial-cells", axial]
    optional = {"--adventitia-cells": adventitia, "--around": around, "--lumen-grading": wall, "--axial-grading": inlet}
    for name, value in optional.items():
        kept += [name, value] if value is not None else []
    return kept if "--order" in options else [*kept, "--order", "2"]


def artery_words(words: Sequence[str], factor: float) -> list[str]:
    """Counts times the factor, sizes by it."""
    options = options_of(words)
    changed = {n: str(max(1, round(float(options[n]) * factor))) for n in CELLS if n in options}
    for name in SIZE_OPTIONS:
        if name in options:
            changed[name] = f"{float(options[name]) / factor:.8g}"
    kept = without(words, tuple(changed) or ("--level",))
    if not changed:
        sizes = LEVELS[options.get("--level") or "coarse"]
        changed = {name: f"{size / factor:.8g}" for name, size in zip(SIZE_OPTIONS, sizes)}
    for name, value in changed.items():
        kept += [name, value]
    return kept
