"""XML of other programs, as entries that know their line and whether anybody read them.

A document type is refused: entities, outside files and expansions without end come by it, and no case has one."""

import math
import xml.parsers.expat as expat
from dataclasses import dataclass, field
from pathlib import Path
from typing import Iterator

from ..base.errors import InputError
from ..base.files import DEEPEST, LARGEST, read_bytes
from ..base.numbers import parsed


@dataclass
class Entry:
    """An element. `taken` says that a reader looked at it."""

    file: Path
    name: str
    attributes: dict[str, str]
    line: int
    parent: "Entry | None" = None
    text: str = ""
    children: list["Entry"] = field(default_factory=list)
    taken: bool = False

    @property
    def key(self) -> str:
        """Its place, for messages: Add_equation FSI/Add_BC inlet/Value."""
        known = [self.attributes[key] for key in ("type", "name", "id", "model") if key in self.attributes]
        own = " ".join([self.name, *known])
        return own if self.parent is None or self.parent.parent is None else f"{self.parent.key}/{own}"

    def refuse(self, problem: str, remedy: str) -> InputError:
        return InputError(self.file, f"line {self.line}: {self.key}", problem, remedy)

    def all(self, name: str) -> list["Entry"]:
        found = [child for child in self.children if child.name == name]
        for child in found:
            child.taken = True
        return found

    def find(self, name: str) -> "Entry | None":
        """The last of this name, as programs that read one after the other have it."""
        found = self.all(name)
        return found[-1] if found else None

    def need(self, name: str) -> "Entry":
        found = self.find(name)
        if found is None:
            raise self.refuse(f"has no {name}", f"give {name}")
        return found

    def attribute(self, name: str) -> str:
        value = self.attributes.get(name, "").strip()
        if not value:
            raise self.refuse(f"has no attribute {name}", f'write {self.name} {name}="..."')
        return value

    def word(self, name: str, default: str = "") -> str:
        found = self.find(name)
        return found.text if found else default

    def number(self, name: str, default: float | None = None) -> float:
        """The number in the entry of this name. Raises InputError where it is missing without a default, or not
        finite."""
        found = self.find(name)
        return default if found is None and default is not None else (found or self.need(name)).as_number()

    def as_number(self) -> float:
        self.taken = True
        value = parsed(self.text)
        if not math.isfinite(value):
            raise self.refuse(f"'{self.text}' is no finite number", "give a number")
        return value

    def positive(self, name: str = "") -> float:
        """The number of this entry, or of the one of this name in it. Raises InputError unless it is above 0."""
        entry = self.need(name) if name else self
        value = entry.as_number()
        if value <= 0:
            raise entry.refuse(f"{entry.text} is not positive", "give one above 0")
        return value

    def yes(self, name: str, default: bool) -> bool:
        found = self.find(name)
        if found is None:
            return default
        known = {"1": True, "true": True, "0": False, "false": False}
        if found.text.lower() not in known:
            raise found.refuse(f"'{found.text}' is neither true nor false", "write true or false")
        return known[found.text.lower()]

    def take_all(self) -> None:
        """Marks what is below it as read."""
        for entry in self.every():
            entry.taken = True

    def every(self) -> Iterator["Entry"]:
        """The entries below, in the file's order."""
        for child in self.children:
            yield child
            yield from child.every()


def read_xml(path: Path) -> Entry:
    """The root. Raises InputError."""
    data = read_bytes(path, "give the file of the case", "give the .xml file of a case", LARGEST)
    parser = expat.ParserCreate(namespace_separator=None)
    open_entries: list[Entry] = []
    roots: list[Entry] = []

    def start(name: str, attributes: dict[str, str]) -> None:
        if len(open_entries) >= DEEPEST:
            raise InputError(path, f"line {parser.CurrentLineNumber}", f"has more than {DEEPEST} levels", "mend it")
        parent = open_entries[-1] if open_entries else None
        entry = Entry(path, name, dict(attributes), parser.CurrentLineNumber, parent)
        (parent.children if parent else roots).append(entry)
        open_entries.append(entry)

    def end(_: str) -> None:
        entry = open_entries.pop()
        entry.text = " ".join(entry.text.split())

    def characters(text: str) -> None:
        if open_entries:
            open_entries[-1].text += text

    def doctype(name: str, *_: object) -> None:
        line, problem = f"line {parser.CurrentLineNumber}", f"has a document type ({name})"
        raise InputError(path, line, problem, "cases need none: take it out")

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.CharacterDataHandler, parser.StartDoctypeDeclHandler = characters, doctype
    parser.buffer_text = True
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        what = expat.errors.messages.get(error.code, "damaged") if isinstance(error.code, int) else "damaged"
        raise InputError(path, f"line {error.lineno}", f"is no XML: {what}", "mend that line") from None
    except (ValueError, LookupError) as error:
        raise InputError(path, "", f"is no XML: {error}", "write it in UTF-8") from None
    return roots[0]
