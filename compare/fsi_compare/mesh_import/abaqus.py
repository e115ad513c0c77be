"""Reads meshes of Abaqus and CalculiX decks (.inp).

meshio 5.0.0 reads an included file as a mesh of its own, so that nodes and elements in two files do not meet, leaves
out its sets of cells, knows no *SURFACE, *PART or *INSTANCE, takes C3D4H for a kind of its own, `tetra4`, and ends with
"'NoneType' object is not subscriptable" at what it does not know. Numbers of nodes and faces: Abaqus, Elements Guide,
sections on triangular and on tetrahedral solid elements."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Iterable, Iterator, Mapping, NamedTuple, NoReturn, Sequence

import numpy as np

from ..base.errors import InputError
from ..base.files import read_bytes
from .raw_mesh import RawMesh, sides_in_order

FACES = sides_in_order((3, 2, 0, 1))  # S1, S2, ...
# Types of elements begin with one of these, by dimension; the number of nodes follows, then letters of the formulation.
FAMILIES = {
    3: ("DC3D", "AC3D", "C3D"),
    2: ("CPS", "CPE", "CPEG", "CAX", "CGAX", "DCAX", "DC2D", "AC2D", "STRI", "M3D", "SFM3D", "DS", "S", "R3D"),
    1: ("T3D", "T2D"),
}
OF_COUNT = {
    3: {4: "tetra", 10: "tetra10", 5: "pyramid", 6: "wedge", 15: "wedge15", 8: "hexahedron", 20: "hexahedron20"},
    2: {3: "triangle", 6: "triangle6", 4: "quad", 8: "quad8", 9: "quad9"},
    1: {2: "line", 3: "line3"},
}
# Those whose number says something else.
OTHER_TYPES = {"STRI65": (2, 6), "B21": (1, 2), "B31": (1, 2), "B22": (1, 3), "B32": (1, 3)}
MOVING = ("SYSTEM", "NGEN", "NFILL", "NCOPY", "ELGEN", "ELCOPY", "NMAP")
DEEPEST = 20  # of includes within includes
REMEDY = "mend that line"


class Line(NamedTuple):
    """A line of a deck or of a file that it includes."""

    file: Path
    number: int
    text: str


@dataclass
class Part:
    """A part, whose nodes and elements have numbers of their own. What is outside of parts has an empty name."""

    name: str
    nodes: dict[int, int] = field(default_factory=dict)  # number -> place among all points
    elements: dict[int, tuple[str, int]] = field(default_factory=dict)  # number -> block, place in it
    node_sets: dict[tuple[str, str], list[int]] = field(default_factory=dict)  # scope and name in upper case -> numbers
    element_sets: dict[tuple[str, str], list[int]] = field(default_factory=dict)


def read_abaqus(path: Path) -> RawMesh:
    """Sets of elements and nodes, and surfaces, by their names: `NAME:surface` for a surface that shares it with a set,
    `PART/NAME` for one whose name other parts, or the assembly, have, too. Raises InputError with the line."""
    return _Deck(path).mesh()


def _lines(path: Path, depth: int = 0, asked: Line | None = None) -> Iterator[Line]:
    """Lines without comments and empty ones; those of included files in their place."""
    missing = "give the deck with all that it includes"
    try:
        data = read_bytes(path, missing, "write the deck anew")
    except InputError as error:
        if asked is None:
            raise
        raise InputError(asked.file, f"line {asked.number}", f"{asked.text}: {error}") from None
    if b"\0" in data[:4096]:
        raise InputError(path, "", "is no text, as decks are", "write the mesh as .inp, or as .vtu")
    begun: Line | None = None  # a keyword that goes on in the next line
    for number, raw in enumerate(data.decode("utf-8", "replace").splitlines(), 1):
        text = raw.strip()
        if not text or text.startswith("**"):
            continue
        line = Line(path, number, text)
        if begun is not None:
            line, begun = begun._replace(text=f"{begun.text} {text}"), None
        if line.text.startswith("*") and line.text.endswith(","):
            begun = line
            continue
        text = line.text
        word, options = _keyword(text) if text.startswith("*") else ("", {})
        if word != "INCLUDE":
            yield line
            continue
        if not options.get("INPUT"):
            _refuse(line, "*INCLUDE names no INPUT=FILE")
        if depth >= DEEPEST:
            _refuse(line, f"has more than {DEEPEST} levels of *INCLUDE")
        yield from _lines(path.parent / options["INPUT"], depth + 1, line)


def _keyword(text: str) -> tuple[str, dict[str, str]]:
    """NODE and {NSET: name} of "*Node, nset=name"; options without a value have an empty one."""
    head, *rest = [part.strip() for part in text[1:].split(",")]
    options = {}
    for entry in rest:
        key, _, value = entry.partition("=")
        options[key.strip().upper()] = value.strip().strip('"')
    return " ".join(head.upper().split()), options


def _refuse(line: Line, problem: str, remedy: str = REMEDY) -> NoReturn:
    raise InputError(line.file, f"line {line.number}", problem, remedy)


def _wanted(key: Line, options: dict[str, str], name: str) -> str:
    value = options.get(name, "")
    if not value:
        _refuse(key, f"{key.text.split(',')[0]} has no {name}=")
    return value


def _shape(said: str) -> tuple[int, int]:
    """Dimension and nodes of a type of elements: 3 and 10 of C3D10MH; 0 for one that is not known."""
    for name, found in OTHER_TYPES.items():
        if said.startswith(name):
            return found
    for dimension, families in FAMILIES.items():
        for family in families:
            rest = said[len(family) :]
            digits = rest[: len(rest) - len(rest.lstrip("0123456789"))]
            if said.startswith(family) and digits and int(digits) in OF_COUNT[dimension]:
                return dimension, int(digits)
    return 0, 0


class _Deck:
    def __init__(self, path: Path) -> None:
        self.path = path
        self.points: list[tuple[float, ...]] = []
        self.blocks: dict[str, list[list[int]]] = {}  # kind -> nodes of each element
        self.facets: dict[str, list[np.ndarray]] = {}  # kind -> nodes of those of surfaces
        self.parts: dict[str, Part] = {"": Part("")}
        self.current = self.parts[""]
        self.instances: dict[str, Part] = {}  # by name in upper case
        # By scope, the part or nothing, and the first spelling of a name, since decks do not tell cases apart: block,
        # places.
        self.sets: dict[tuple[str, str], list[tuple[str, list[int]]]] = {}
        self.surfaces: dict[tuple[str, str], list[tuple[str, list[int]]]] = {}
        self.point_sets: dict[tuple[str, str], list[int]] = {}
        self.spelling: dict[str, str] = {}
        self.passed_over: dict[str, None] = {}
        key: Line | None = None
        data: list[Line] = []
        for line in _lines(path):
            if line.text.startswith("*"):
                self._section(key, data)
                key, data = line, []
            elif key is None:
                _refuse(line, f"'{line.text[:40]}' stands before any keyword")
            else:
                data.append(line)
        self._section(key, data)

    def mesh(self) -> RawMesh:
        if not self.points:
            raise InputError(self.path, "", "holds no *NODE", "give the deck that has the mesh")
        blocks = [(kind, np.array(rows, dtype=np.int64)) for kind, rows in self.blocks.items() if rows]
        order = {kind: i for i, (kind, _) in enumerate(blocks)}
        order |= {f"facets {kind}": len(blocks) + i for i, kind in enumerate(self.facets)}
        blocks += [(kind, np.concatenate(rows)) for kind, rows in self.facets.items()]
        sets = {}
        for table, word in ((self.sets, ""), (self.surfaces, ":surface")):
            for key, entries in table.items():
                places: list[list[int]] = [[] for _ in blocks]
                for block, there in entries:
                    places[order[block]] += there
                name = _shown(key, table)
                sets[name + (word if name in sets else "")] = list(map(_places, places))
        at = {_shown(key, self.point_sets): _places(places) for key, places in self.point_sets.items()}
        return RawMesh(np.array(self.points), blocks, cell_sets=sets, point_sets=at, passed_over=list(self.passed_over))

    def _section(self, key: Line | None, data: list[Line]) -> None:
        """A keyword and the lines behind it. Those that say no mesh are left."""
        if key is None:
            return
        word, options = _keyword(key.text)
        if options.get("INPUT") and word in ("NODE", "ELEMENT", "NSET", "ELSET"):
            data = data + list(_lines(key.file.parent / options["INPUT"], 1, key))
        if word == "PART":
            name = _wanted(key, options, "NAME").upper()
            self.current = self.parts.setdefault(name, Part(name))
        elif word in ("END PART", "ASSEMBLY", "END ASSEMBLY"):
            self.current = self.parts[""]
        elif word in self._TAKING:
            self._TAKING[word](self, key, options, data)
        elif word in MOVING:
            _refuse(key, f"*{word} makes or moves nodes or elements, which is not read", "write the mesh itself out")

    def _instance(self, key: Line, options: dict[str, str], data: list[Line]) -> None:
        part = self.parts.get(_wanted(key, options, "PART").upper())
        if part is None:
            _refuse(key, f"there is no part {options['PART']}")
        if data:
            _refuse(data[0], "an instance that is moved or turned is not read", "write the mesh in its place")
        if any(other is part for other in self.instances.values()):
            _refuse(key, f"a second instance of the part {options['PART']} is not read", "write the mesh in its place")
        self.instances[_wanted(key, options, "NAME").upper()] = part

    def _nodes(self, key: Line, options: dict[str, str], data: list[Line]) -> None:
        if options.get("SYSTEM", "R").upper() != "R":
            _refuse(key, f"coordinates of the system {options['SYSTEM']} are not read", "write x, y and z")
        numbers = []
        for line in data:
            words = line.text.split(",")
            try:
                number = int(words[0])
                place = tuple(float(word) if word.strip() else 0.0 for word in words[1:4])  # a blank is a zero
            except ValueError:
                _refuse(line, f"'{line.text[:60]}' is no node")
            if len(place) < 2:
                _refuse(line, f"node {number} has {len(place)} coordinates")
            if number in self.current.nodes:
                _refuse(line, f"node {number} is there twice")
            self.current.nodes[number] = len(self.points)
            self.points.append(place if len(place) == 3 else (*place, 0.0))
            numbers.append(number)
        if options.get("NSET"):
            self._take_nodes(self.current, options["NSET"], numbers)

    def _elements(self, key: Line, options: dict[str, str], data: list[Line]) -> None:
        said = _wanted(key, options, "TYPE").upper()
        dimension, count = _shape(said)
        if not dimension:
            _refuse(key, f"elements of the type {said} are not known", "leave them out of the deck")
        kind = OF_COUNT[dimension][count]
        rows = self.blocks.setdefault(kind, [])
        found = self._element_rows(data, said, count)
        self.current.elements.update((number, (kind, place)) for place, number in enumerate(found, len(rows)))
        rows += found.values()
        if options.get("ELSET"):
            self._take_elements(self.current, options["ELSET"], list(found))

    def _element_rows(self, data: list[Line], said: str, count: int) -> dict[int, list[int]]:
        """Nodes of elements by their numbers; one may go on in the next line."""
        known, taken = self.current.nodes, self.current.elements
        found: dict[int, list[int]] = {}
        words: list[str] = []
        for line in data:
            words += line.text.rstrip(",").split(",")
            if len(words) <= count:
                continue
            if len(words) > count + 1:
                _refuse(line, f"element {words[0]} has {len(words) - 1} nodes, its type {said} {count}")
            try:
                number = int(words[0])
                nodes = [known[int(word)] for word in words[1:]]
            except ValueError:
                _refuse(line, f"'{line.text[:60]}' is no element")
            except KeyError as error:
                _refuse(line, f"element {words[0]} has the node {error.args[0]}, which is not there")
            if number in taken or number in found:
                _refuse(line, f"element {number} is there twice")
            found[number] = nodes
            words = []
        if words:
            _refuse(data[-1], f"element {words[0]} has {len(words) - 1} nodes, its type {said} {count}")
        return found

    def _owner(self, key: Line, options: dict[str, str]) -> Part:
        """The part whose numbers a set has."""
        if not options.get("INSTANCE"):
            return self.current
        part = self.instances.get(options["INSTANCE"].upper())
        if part is None:
            _refuse(key, f"there is no instance {options['INSTANCE']}")
        return part

    def _node_set(self, key: Line, options: dict[str, str], data: list[Line]) -> None:
        name, part = _wanted(key, options, "NSET"), self._owner(key, options)
        known = self._known(part, part.node_sets)
        numbers = _set_numbers(options, data, part.nodes, known, f"the set {name} has the node")
        if options.get("ELSET"):  # the nodes of a set of elements
            elements = self._known(part, part.element_sets).get(options["ELSET"].upper())
            if elements is None:
                _refuse(key, f"there is no set {options['ELSET']}")
            number_of = {place: number for number, place in part.nodes.items()}
            places = {p for n in elements for p in self.blocks[part.elements[n][0]][part.elements[n][1]]}
            numbers += sorted(number_of[place] for place in places)
        self._take_nodes(part, name, numbers)

    def _element_set(self, key: Line, options: dict[str, str], data: list[Line]) -> None:
        name, part = _wanted(key, options, "ELSET"), self._owner(key, options)
        known = self._known(part, part.element_sets)
        numbers = _set_numbers(options, data, part.elements, known, f"the set {name} has the element")
        # Sets that Abaqus/CAE makes for surfaces are marked so.
        self._take_elements(part, name, numbers, "INTERNAL" not in options)

    def _key(self, name: str) -> tuple[str, str]:
        """Scope and name of a set or surface of the current part or assembly; another part may use the same name."""
        return self.current.name, self.spelling.setdefault(name.upper(), name)

    def _known(self, part: Part, sets: dict[tuple[str, str], list[int]]) -> dict[str, list[int]]:
        """A part's sets by the names that hold here: its own, overridden by those that the assembly made of it."""
        return _of_scope(part.name, sets) | _of_scope(self.current.name, sets)

    def _take_nodes(self, part: Part, name: str, numbers: list[int]) -> None:
        part.node_sets.setdefault((self.current.name, name.upper()), []).extend(numbers)
        self.point_sets.setdefault(self._key(name), []).extend(part.nodes[n] for n in numbers)

    def _take_elements(self, part: Part, name: str, numbers: list[int], shown: bool = True) -> None:
        part.element_sets.setdefault((self.current.name, name.upper()), []).extend(numbers)
        if shown:
            self.sets.setdefault(self._key(name), []).extend(_by_block(part, numbers))

    def _surface(self, key: Line, options: dict[str, str], data: list[Line]) -> None:
        name, kind = _wanted(key, options, "NAME"), options.get("TYPE", "ELEMENT").upper()
        if kind not in ("ELEMENT", "NODE"):
            self.passed_over[f"{name} (a surface of the type {kind})"] = None
            return
        entries = self.surfaces.setdefault(self._key(name), [])
        for line in data:
            words = [word.strip() for word in line.text.split(",")]
            if kind == "NODE":
                part, numbers = self._named(line, words[0], nodes=True)
                self.point_sets.setdefault(self._key(name), []).extend(part.nodes[n] for n in numbers)
                continue
            part, numbers = self._named(line, words[0], nodes=False)
            for block, places in _by_block(part, numbers):
                entries.append(self._faces(line, block, places, words[1].upper() if len(words) > 1 else ""))
        if not entries:
            del self.surfaces[self._key(name)]

    def _faces(self, line: Line, block: str, places: list[int], side: str) -> tuple[str, list[int]]:
        """Block and places of the facets that a line of a surface names; of shells these are the elements."""
        if side in ("", "SPOS", "SNEG"):
            if block.startswith("tetra"):
                _refuse(line, "names no face of its cells", "write S1 to S4 behind the set")
            return block, places
        number = int(side[1:]) if side[0] == "S" and side[1:].isdigit() else 0
        if block not in FACES or not 1 <= number <= len(FACES[block][1]):
            _refuse(line, f"{side} is no face of a {block}")
        facet, corners = FACES[block]
        rows = np.array([self.blocks[block][p] for p in places], dtype=np.int64)[:, list(corners[number - 1])]
        known = self.facets.setdefault(facet, [])
        start = sum(len(f) for f in known)
        known.append(rows)
        return f"facets {facet}", list(range(start, start + len(rows)))

    def _named(self, line: Line, entry: str, nodes: bool) -> tuple[Part, list[int]]:
        """Part and numbers of "SET", "INSTANCE.SET" or of one number. Sets that an assembly names are of their part."""
        instance, dot, rest = entry.partition(".")
        parts: Iterable[Part] = [self.current] if self.current.name else self.parts.values()
        whole = bool(dot) and instance.upper() in self.instances
        if whole:
            parts, entry = [self.instances[instance.upper()]], rest
        for part in parts:
            sets = part.node_sets if nodes else part.element_sets
            # INSTANCE.SET is the part's own.
            known = _of_scope(part.name, sets) if whole else self._known(part, sets)
            there = part.nodes.keys() if nodes else part.elements.keys()
            if entry.upper() in known:
                return part, known[entry.upper()]
            if entry.isdigit() and int(entry) in there:
                return part, [int(entry)]
        _refuse(line, f"there is no set of {'nodes' if nodes else 'elements'} {entry}")

    _TAKING = {"INSTANCE": _instance, "NODE": _nodes, "ELEMENT": _elements}  # by keyword
    _TAKING |= {"NSET": _node_set, "ELSET": _element_set, "SURFACE": _surface}


def _of_scope(scope: str, sets: Mapping[tuple[str, str], list[int]]) -> dict[str, list[int]]:
    return {name: numbers for (of, name), numbers in sets.items() if of == scope}


def _places(places: Sequence[int]) -> np.ndarray:
    return np.unique(np.array(places, dtype=np.int64))


def _set_numbers(
    options: dict[str, str], data: list[Line], there: Mapping[int, object], known: dict[str, list[int]], words: str
) -> list[int]:
    """Numbers of a set, which may name other sets. `words` begin the message for one that is not there."""
    numbers: list[int] = []
    for line in data:
        entries, found = [word.strip() for word in line.text.split(",") if word.strip()], []
        if "GENERATE" in options:
            try:
                first, last = int(entries[0]), int(entries[1])
                found = list(range(first, last + 1, int(entries[2]) if len(entries) > 2 else 1))
            except (ValueError, IndexError):
                _refuse(line, f"'{line.text[:60]}' is no FIRST, LAST, STEP")
        else:
            for entry in entries:
                if entry.isdigit():
                    found.append(int(entry))
                elif entry.upper() in known:
                    found += known[entry.upper()]
                else:
                    _refuse(line, f"there is no set {entry}")
        missing = next((n for n in found if n not in there), None)
        if missing is not None:
            _refuse(line, f"{words} {missing}, which is not there")
        numbers += found
    return numbers


def _shown(key: tuple[str, str], table: Mapping[tuple[str, str], object]) -> str:
    """A name, with its part before it where others have the same."""
    scope, name = key
    return f"{scope}/{name}" if scope and sum(other == name for _, other in table) > 1 else name


def _by_block(part: Part, numbers: Sequence[int]) -> list[tuple[str, list[int]]]:
    found: dict[str, list[int]] = {}
    for number in numbers:
        block, place = part.elements[number]
        found.setdefault(block, []).append(place)
    return list(found.items())
