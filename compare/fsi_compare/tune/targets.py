"""What is asked for: pressures and mean flows at openings."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Sequence

from ..base.errors import InputError
from ..base.files import read_toml
from ..base.suggestions import check_keys

DIASTOLIC, SYSTOLIC, MEAN = "diastolic pressure", "systolic pressure", "mean pressure"
SPLIT, FLOW = "share of the flow", "mean flow"
PRESSURES = (DIASTOLIC, SYSTOLIC, MEAN)
KPA = {"kPa": 1.0, "mmHg": 0.133322387415}
FLOWS = {"ml/s": 1.0, "mm3/ms": 1.0, "ml/min": 1 / 60, "l/min": 1000 / 60}
HIGHEST = 40.0  # kPa, 300 mmHg: no artery has more
SPLITS_MISS = 0.005  # by which shares may miss the whole: they are given with few digits
NUMBER = r"[-+]?[0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]+)?"
OPTIONS = {"pressure": "--pressure", "mean_pressure": "--mean-pressure", "split": "--split", "flow": "--flow"}
EXAMPLES = dict(zip(OPTIONS, ("inlet=80/120mmHg", "inlet=93mmHg", "left=60%", "left=1.2ml/s")))
TABLE = 'give sections [pressure], [mean_pressure], [split], [flow] with NAME = "VALUE"'


@dataclass(frozen=True)
class Target:
    opening: str
    kind: str
    value: float  # kPa, mm^3/ms, or a share of 1

    @property
    def unit(self) -> str:
        return {SPLIT: "1", FLOW: "mm^3/ms"}.get(self.kind, "kPa")

    @property
    def about(self) -> dict[str, Any]:
        return {"opening": self.opening, "quantity": self.kind, "unit": self.unit, "asked": self.value}

    @property
    def is_pressure(self) -> bool:
        return self.kind in PRESSURES


@dataclass(frozen=True)
class _Word:
    """One of the command line or of a table of targets."""

    place: str  # file, or empty
    key: str  # option, or key in the file
    section: str
    opening: str
    text: str

    def refuse(self, problem: str, remedy: str = "") -> InputError:
        return InputError(self.place, self.key, problem, remedy or f"give one like {EXAMPLES[self.section]}")


def read_targets(options: Mapping[str, Sequence[str]], table: "Path | None") -> list[Target]:
    """`options`: texts NAME=VALUE by section. Raises InputError."""
    words = []
    for section, texts in options.items():
        for text in texts:
            opening, mark, value = text.partition("=")
            word = _Word("", OPTIONS[section], section, opening.strip(), value.strip())
            if not mark or not word.opening:
                raise word.refuse(f"'{text}' names no opening and value")
            words.append(word)
    words += _words_of(table) if table is not None else []
    targets: dict[Any, Target] = {}
    for word in words:
        for target in _targets(word):
            if (target.opening, target.kind) in targets:
                raise word.refuse(f"the {target.kind} of '{target.opening}' is given twice", "leave one out")
            targets[target.opening, target.kind] = target
    found = list(targets.values())
    if not any(target.is_pressure or target.kind == FLOW for target in found):
        raise no_pressure()
    _require_one_kind(found)
    return found


def no_pressure() -> InputError:
    return InputError("", "--pressure", "is missing", f"give one like {EXAMPLES['pressure']}")


def _words_of(path: Path) -> list[_Word]:
    sections = read_toml(path, "give a TOML file of targets", TABLE)
    check_keys(path, "", sections, list(OPTIONS))
    words = []
    for section, entries in sections.items():
        if not isinstance(entries, dict):
            raise InputError(path, section, "is no section", TABLE)
        for opening, value in entries.items():
            word = _Word(str(path), f"{section}.{opening}", section, opening, str(value))
            if not isinstance(value, str):
                raise word.refuse("is not a text", f"give one like \"{EXAMPLES[section].partition('=')[2]}\"")
            words.append(word)
    return words


def _targets(word: _Word) -> list[Target]:
    if word.section == "pressure":
        match = re.fullmatch(rf"({NUMBER})\s*/\s*({NUMBER})\s*([A-Za-z]*)", word.text)
        if match is None:
            raise word.refuse(f"'{word.text}' is no diastolic and systolic pressure")
        low, high = (_kpa(word, number, match[3]) for number in (match[1], match[2]))
        if not low < high:
            raise word.refuse(f"the diastolic pressure {match[1]} is not below the systolic one {match[2]}")
        return [Target(word.opening, DIASTOLIC, low), Target(word.opening, SYSTOLIC, high)]
    if word.section == "mean_pressure":
        match = re.fullmatch(rf"({NUMBER})\s*([A-Za-z]*)", word.text)
        if match is None:
            raise word.refuse(f"'{word.text}' is no pressure")
        return [Target(word.opening, MEAN, _kpa(word, match[1], match[2]))]
    if word.section == "split":
        match = re.fullmatch(rf"({NUMBER})\s*(%?)", word.text)
        share = float(match[1]) / (100 if match[2] else 1) if match is not None else 0.0
        if not 0 < share < 1:
            raise word.refuse(f"'{word.text}' is no part of the flow")
        return [Target(word.opening, SPLIT, share)]
    match = re.fullmatch(rf"({NUMBER})\s*([A-Za-z0-9^/]*)", word.text)
    unit = match[2].replace("^", "") if match is not None else ""
    if match is None or unit not in FLOWS or not float(match[1]) > 0:
        raise word.refuse(f"'{word.text}' is no flow outwards", f"give a positive one in {', '.join(FLOWS)}")
    return [Target(word.opening, FLOW, float(match[1]) * FLOWS[unit])]


def _kpa(word: _Word, number: str, unit: str) -> float:
    if unit not in KPA:
        problem = f"'{word.text}' has no unit" if not unit else f"'{unit}' is no unit of pressure here"
        raise word.refuse(problem, f"give kPa or mmHg, like {EXAMPLES[word.section]}")
    value = float(number) * KPA[unit]
    if not value > 0:
        raise word.refuse(f"a pressure of {number} {unit} is not positive")
    if value > HIGHEST:
        problem = f"{number} {unit} is {value / KPA['mmHg']:.0f} mmHg, more than any artery has"
        remedy = "was it mmHg?" if unit == "kPa" else f"give at most {HIGHEST / KPA['mmHg']:.0f} mmHg"
        raise word.refuse(problem, remedy)
    return value


def _require_one_kind(targets: Sequence[Target]) -> None:
    """Refuses shares beside flows, and pressures other than a mean one or a diastolic with a systolic one."""
    if any(t.kind == SPLIT for t in targets) and any(t.kind == FLOW for t in targets):
        raise InputError("", "--split, --flow", "both are given", "give shares or flows, not both")
    pressures = sorted(t.kind for t in targets if t.is_pressure)
    if pressures not in ([DIASTOLIC, SYSTOLIC], [MEAN], []):
        problem = f"{len(pressures)} pressures are given where one opening's are found"
        remedy = "give the diastolic and systolic pressure of one opening, or a mean one"
        raise InputError("", "--pressure", problem, remedy)
