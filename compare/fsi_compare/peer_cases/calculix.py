"""What a deck of CalculiX says beside its mesh: material, density, time. It has no units; preCICE's cases are in SI.

With NLGEOM its *ELASTIC is St. Venant and Kirchhoff's law, without it the linear one."""

import math
from pathlib import Path

from ..base.errors import InputError
from ..base.files import LARGEST, read_text
from ..base.numbers import parsed
from .units import SYSTEMS

SI = SYSTEMS["si"]
Card = tuple[int, str, list[str]]  # line, keyword line, and lines of data


def deck_beside(folder: Path) -> Path | None:
    """The only .inp in the folder or one below it that has a material; None where there are none or several."""
    small = [p for p in [*folder.glob("*.inp"), *folder.glob("*/*.inp")] if p.is_file() and p.stat().st_size <= LARGEST]
    found = [path for path in small if "*MATERIAL" in path.read_text("latin-1").upper()]
    return found[0] if len(found) == 1 else None


def read_deck(path: Path) -> list[str]:
    """What a deck says, in our keys and units, if it is in SI. Raises InputError."""
    by_name: dict[str, list[Card]] = {}
    for card in _cards(path):
        by_name.setdefault(card[1].split(",")[0].strip().upper(), []).append(card)
    materials = by_name.get("*MATERIAL", [])
    if len(materials) != 1:
        raise InputError(path, "*MATERIAL", f"is there {len(materials)} times", "read is a deck with one")
    steps = [card for name in ("*STEP", "*DYNAMIC", "*STATIC") for card in by_name.get(name, [])]
    large = any("NLGEOM" in card[1].upper() for card in steps)
    words = []
    if "*ELASTIC" in by_name:
        young, poisson = _numbers(path, by_name["*ELASTIC"][0], 2)
        law = "saint-venant-kirchhoff" if large else "linear-elastic"
        words.append(f'material = "{law}", young = {young * SI.pressure:g}, poisson = {poisson:g}')
    else:
        words.append("no *ELASTIC: give the material by hand")
    if "*DENSITY" in by_name:
        words.append(f"density = {_numbers(path, by_name['*DENSITY'][0], 1)[0] * SI.density:g}")
    if "*DYNAMIC" in by_name:
        step, end = _numbers(path, by_name["*DYNAMIC"][0], 2)
        words.append(f"time.step = {step * SI.time:g}, time.end = {end * SI.time:g}")
    return words


def _cards(path: Path) -> list[Card]:
    cards: list[Card] = []
    for number, line in enumerate(read_text(path, "give the deck", "write the deck as text", LARGEST).splitlines(), 1):
        line = line.strip()
        if line.startswith("**") or not line:
            continue
        if line.startswith("*"):
            cards.append((number, line, []))
        elif cards:
            cards[-1][2].append(line)
    return cards


def _numbers(path: Path, card: Card, count: int) -> list[float]:
    line, keyword, data = card
    numbers = list(map(parsed, data[0].split(",")[:count] if data else []))
    if len(numbers) != count or any(map(math.isnan, numbers)):
        raise InputError(path, f"line {line}: {keyword}", f"has not {count} numbers behind it", "mend the deck")
    return numbers
