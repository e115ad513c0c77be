"""Which constants of a gmsh script say how fine its mesh is, and the script for a mesh that is finer by a factor.

A constant of `DefineConstant[ name = number, ... ]` is a size where it stands in the fourth place of a Point or in a
Mesh.MeshSize option, and a count where it stands behind `Transfinite ... =` or in `Layers{ }`, where one that something
is divided by is a size, too. Sizes are divided by the factor, counts multiplied. Ratios of neighbouring cells (`Using Progression`) are taken to the power 1/factor, since
twice as many cells of the same ratio would refine one end alone. A size or count that stands anywhere else is refused:
the vessel would change with it."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

from ..base.errors import InputError
from ..base.files import read_text

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
CONSTANTS = re.compile(r"DefineConstant\s*\[(.*?)\]\s*;", re.DOTALL)
CONSTANT = re.compile(r"([A-Za-z_]\w*)\s*=\s*\{?([^,{}]*)")
SIZES = (
    re.compile(r"Point\s*\([^=;]*\)\s*=\s*\{[^{},]*,[^{},]*,[^{},]*,([^{}]*)\}"),
    re.compile(r"Mesh\.(?:MeshSize|CharacteristicLength)(?:Max|Min|Factor)\s*=\s*([^;]*);"),
    re.compile(r"(?:MeshSize|Characteristic Length)\s*\{[^=]*\}\s*=\s*([^;]*);"),
)
COUNTS = (
    re.compile(r"Transfinite\s+(?:Curve|Line)\s*\{[^=]*\}\s*=\s*([^;]*?)(?:Using|;)"),
    re.compile(r"Layers\s*\{\s*([^}]*)\}"),
)
FREE = (  # where a size may stand besides: it changes no vessel
    re.compile(r"Field\s*\[[^=;]*\]\s*\.\s*(?:V(?:In|Out)|F|h\w+|\w*Size\w*|Lc\w+)\s*=\s*([^;]*);"),
    re.compile(r"Printf\s*\(([^;]*)\)\s*;"),
)
WORD = re.compile(r"\b[A-Za-z_]\w*")
DIVISOR = re.compile(r"/\s*(\([^()]*\)|[A-Za-z_]\w*)")
UNREAD = re.compile(r'"[^"\n]*"|//[^\n]*|/\*.*?\*/', re.DOTALL)  # texts and comments
PROGRESSION = re.compile(rf"Using\s+Progression\s+({NUMBER})")
ELSEWHERE = re.compile(r"\b(?:Include|Merge)\b")


@dataclass(frozen=True)
class GeoSizes:
    """Constants of a script with their values."""

    script: Path
    sizes: dict[str, float]
    counts: dict[str, float]
    graded: bool  # has ratios of neighbouring cells

    def settings(self, factor: float, given: dict[str, float]) -> dict[str, float]:
        """Constants for a mesh finer by `factor`; `given`: values other than the script's."""
        found = dict(given)
        for name, value in self.sizes.items():
            found[name] = given.get(name, value) / factor
        for name, value in self.counts.items():
            found[name] = max(1, round(given.get(name, value) * factor))
        return found


def read_sizes(script: Path) -> GeoSizes:
    """Reads a script. Raises InputError where it has no constant that says how fine it is, or one that says more."""
    text = read_text(script, "give a gmsh script that is there", "give a gmsh script")
    text = UNREAD.sub(" ", text)
    constants = {n: value.strip() for block in CONSTANTS.findall(text) for n, value in CONSTANT.findall(block)}
    of_sizes, of_counts = ([one for pattern in of for one in pattern.findall(text)] for of in (SIZES, COUNTS))
    lengths = constants.keys() & _words([name for one in of_counts for name in DIVISOR.findall(one)])  # of cells
    sizes = _numbers(script, constants, lengths | _words(of_sizes))
    counts = _numbers(script, constants, _words([one for one in of_counts if not lengths & _words([one])]))
    both = sorted(set(sizes) & set(counts))
    if both:
        raise InputError(script, both[0], "is both a size and a count of cells", "give each a constant of its own")
    for name in sorted({*sizes, *counts} & _elsewhere(text)):
        problem = "is a size or a count of cells, and stands in other places, too: the vessel would change with it"
        raise InputError(script, name, problem, "give the size a constant of its own: DefineConstant[ size = 0.5 ];")
    if not sizes and not counts:
        problem = "has no constant that says how fine its mesh is"
        remedy = "give it one, DefineConstant[ size = 0.5 ]; with Mesh.MeshSizeMax = size; and let nothing else decide"
        raise InputError(script, "DefineConstant", problem, remedy)
    graded = bool(PROGRESSION.search(text)) and bool(counts)
    if graded and ELSEWHERE.search(text):
        problem = "has ratios of cells and takes in other files"
        raise InputError(script, "Using Progression", problem, "put all of it into one script")
    return GeoSizes(script, sizes, counts, graded)


def _words(expressions: Sequence[str]) -> set[str]:
    return set(WORD.findall(" ".join(expressions)))


def _numbers(script: Path, constants: dict[str, str], words: set[str]) -> dict[str, float]:
    used = {name: value for name, value in constants.items() if name in words}
    for name, value in used.items():
        if not re.fullmatch(NUMBER, value):
            problem = f"'{value}' is an expression, of which no size or count is read"
            raise InputError(script, name, problem, f"give a number: DefineConstant[ {name} = 0.5 ];")
    return {name: float(value) for name, value in used.items()}


def _elsewhere(text: str) -> set[str]:
    """Words outside of sizes and counts."""
    text = CONSTANTS.sub(lambda block: re.sub(r"\w+\s*=", " ", block[1]) + ";", text)
    for pattern in (*SIZES, *COUNTS, *FREE):
        text = pattern.sub(lambda match: match[0][: match.start(1) - match.start()] + ";", text)
    return set(WORD.findall(text))


def graded_text(script: Path, factor: float) -> str:
    """The script with its ratios of neighbouring cells for so many times the cells."""
    text = read_text(script, "give a gmsh script that is there", "give a gmsh script")

    def softer(match: "re.Match[str]") -> str:
        return f"Using Progression {float(match[1]) ** (1 / factor):.12g}"

    return PROGRESSION.sub(softer, text)
