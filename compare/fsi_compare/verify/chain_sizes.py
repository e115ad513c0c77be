"""Which words of a mesh's commands make it finer by a factor, where each command takes the file of its predecessor
(gallery/mesh_chain.py):

| command | divided by the factor | multiplied by it |
|---|---|---|
| `geo` | sizes of the script | its counts (geo_sizes.py) |
| `lumen` | `--edge-length`, `--shortest-edge` | `--edges-per-diameter`, `--edges-per-curvature`, `--layers` |
| `thicken` | - | elements of each layer |
| a script in Python, `refine` | - | - |

All else says what the vessel is, and stays: its surface, openings, cuts and extensions, the thickness of its wall, that
of all layers of thin cells together. Passes of smoothing stay, too: what they change vanishes with the elements."""

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Mapping, Sequence

from ..base.errors import InputError

LAYER = re.compile(r"([^=:]+)=([^:]+?)(?::(\d+))?")  # of thicken: NAME=THICKNESS[:ELEMENTS]
GROWTH = 1.2  # of lumen's layers, the default of meshes/lumen_command.cpp, against which a test holds it
MULTIPLIED = ("--edges-per-diameter", "--edges-per-curvature")
DIVIDED = ("--edge-length", "--shortest-edge")


@dataclass(frozen=True)
class Command:
    """One of a chain, with its words. This one has no sizes."""

    words: tuple[str, ...]

    @property
    def counts(self) -> list[float]:
        """Numbers of elements, which must stay whole and can become fewer."""
        return []

    @property
    def elements(self) -> dict[str, int]:
        """Through each layer of a wall that it grows, by the layer's name."""
        return {}

    def finer(self, factor: float, folder: Path) -> list[str]:
        """Its words for a mesh finer by the factor. `folder`: for scripts that have to be changed."""
        return list(self.words)


@dataclass(frozen=True)
class Lumen(Command):
    @property
    def counts(self) -> list[float]:
        layers = value_of(self.words, "--layers")
        return [] if layers is None else [float(layers)]

    def finer(self, factor: float, folder: Path) -> list[str]:
        if factor == 1:
            return list(self.words)
        changed = self._layers(factor)
        for names, by in ((MULTIPLIED, factor), (DIVIDED, 1 / factor)):
            for name in names:
                value = value_of(self.words, name)
                if value is not None:
                    changed[name] = f"{float(value) * by:.8g}"
        return with_values(self.words, changed)

    def _layers(self, factor: float) -> dict[str, str]:
        """n layers, the first t thick and each g times its neighbour: t (g^n - 1)/(g - 1) in all. That and g^n stay."""
        given = value_of(self.words, "--layers")
        if given is None:
            return {}
        layers, growth = int(given), float(value_of(self.words, "--growth") or GROWTH)
        more = max(1, round(layers * factor))
        softer = growth ** (layers / more)
        found = {"--layers": str(more), "--growth": f"{softer:.10g}"}
        first = value_of(self.words, "--first-thickness")  # without it --womersley says how thick they are together
        if first is not None:
            found["--first-thickness"] = f"{float(first) * _sum(growth, layers) / _sum(softer, more):.8g}"
        return found


def _sum(growth: float, layers: int) -> float:
    """1 + g + ... + g^(n - 1)."""
    return sum(growth**k for k in range(layers))


@dataclass(frozen=True)
class Thicken(Command):
    @property
    def counts(self) -> list[float]:
        return [float(number) for number in self.elements.values() if number > 1]

    @property
    def elements(self) -> dict[str, int]:
        layers = [LAYER.fullmatch(self.words[place]) for place in layer_places(self.words)]
        return {layer[1]: int(layer[3] or 1) for layer in layers if layer is not None}

    def finer(self, factor: float, folder: Path) -> list[str]:
        words = list(self.words)
        for place in layer_places(words):
            layer = LAYER.fullmatch(words[place])
            assert layer is not None  # checked when the words were read
            number = int(layer[3] or 1)
            if times(number, factor) != number:
                words[place] = f"{layer[1]}={layer[2]}:{times(number, factor)}"
        return words


def times(number: int, factor: float) -> int:
    """Elements through a layer; the half is rounded down, so that one element stays one at a ratio of 1.5."""
    return max(1, math.ceil(number * factor - 0.5 - 1e-9))


def sized(words: Sequence[str], source: str) -> Command:
    """A command other than `geo`; `source` of its words. Raises InputError where it decides sizes but has none."""
    name = words[0]
    if name == "lumen":
        return _lumen(words, source)
    if name == "thicken":
        for place in layer_places(words):
            if LAYER.fullmatch(words[place]) is None:
                remedy = "write NAME=MM:ELEMENTS, or NAME=SHARE%:ELEMENTS of a wall that varies"
                raise InputError(source, f"thicken --layer {words[place]}", "is no layer", remedy)
        return Thicken(tuple(words))
    return Command(tuple(words))


def _lumen(words: Sequence[str], source: str) -> Lumen:
    numbers = {name: value_of(words, name) for name in (*MULTIPLIED, *DIVIDED, "--layers", "--growth")}
    numbers["--first-thickness"] = value_of(words, "--first-thickness")
    for name, value in numbers.items():
        if value is not None and not _is_positive(value, name == "--layers"):
            raise InputError(source, f"lumen {name}", f"'{value}' is no positive number", "give one")
    if numbers["--edge-length"] is None and numbers["--edges-per-diameter"] is None:
        problem = "its edges are as long as those of the surface, which is no size that can be changed"
        raise InputError(source, "lumen", problem, "give --edges-per-diameter N, or --edge-length MM")
    if numbers["--edges-per-curvature"] is not None and numbers["--shortest-edge"] is None:
        problem = "its shortest edges are half as long as those of the surface, which is no size that can be changed"
        raise InputError(source, "lumen --edges-per-curvature", problem, "give --shortest-edge MM beside it")
    return Lumen(tuple(words))


def _is_positive(text: str, whole: bool) -> bool:
    try:
        return (int(text) if whole else float(text)) > 0
    except ValueError:
        return False


# ---- words ----


def number_in(text: str, key: str, source: str) -> float:
    """Reads a number above 0 of a mesh's commands. Raises InputError."""
    try:
        number = float(text)
    except ValueError:
        raise InputError(source, key, f"'{text}' is no number", "give one") from None
    if not 0 < number < float("inf"):
        raise InputError(source, key, f"'{text}' is no size", "give a number above 0")
    return number


def options_of(words: Sequence[str]) -> dict[str, str]:
    """Options by name, of --name value and --name=value; a flag has an empty value."""
    found: dict[str, str] = {}
    for word, following in zip(words, [*words[1:], ""]):
        if word.startswith("--"):
            name, mark, value = word.partition("=")
            found[name] = value if mark else "" if following.startswith("--") else following
    return found


def without(words: Sequence[str], names: Sequence[str]) -> list[str]:
    """The words without these options and their values."""
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


def apart(words: Sequence[str]) -> list[str]:
    """--name=value as two words; a value may hold more of the signs."""
    found: list[str] = []
    for word in words:
        name, mark, value = word.partition("=")
        found += [name, value] if mark and word.startswith("--") else [word]
    return found


def value_of(words: Sequence[str], name: str) -> str | None:
    """An option's value; None: it is not given."""
    return next((value for word, value in zip(words, [*words[1:], ""]) if word == name), None)


def with_values(words: Sequence[str], values: Mapping[str, str]) -> list[str]:
    """The words with these values in the place of given ones, others behind."""
    found = list(words)
    for name, value in values.items():
        if name in found:
            found[found.index(name) + 1] = value
        else:
            found += [name, value]
    return found


def layer_places(words: Sequence[str]) -> list[int]:
    """Places of the values of --layer, which takes several."""
    found, inside = [], False
    for place, word in enumerate(words):
        if word.startswith("--"):
            inside = word == "--layer"
        elif inside:
            found.append(place)
    return found
