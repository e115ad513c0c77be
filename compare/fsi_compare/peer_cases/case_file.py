"""Writes a case: case.toml and its tables. The mesh is written by fsi-mesh, from what geometry.py hands over."""

from pathlib import Path
from typing import Any

from ..base.errors import printable
from ..base.toml import toml_lines
from .model import PeerCase
from .units import rounded

CASE = "case.toml"


def case_text(case: PeerCase) -> str:
    lines = [f"# From {printable(case.file.name)} of {case.program}. What has no counterpart is in import.log."]
    sections = _rounded(case.sections)
    plain = {key: value for key, value in sections.items() if not isinstance(value, (dict, list))}
    lines += toml_lines(plain)
    for name, section in sections.items():
        if isinstance(section, list):
            for entry in section:
                lines += ["", f"[[{name}]]", *toml_lines(entry)]
        elif name not in plain:
            lines += _section(name, section)
    return "\n".join(lines) + "\n"


def _rounded(value: Any) -> Any:
    """The entries with their numbers to 14 digits."""
    if isinstance(value, dict):
        return {key: _rounded(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_rounded(entry) for entry in value]
    return rounded(value) if isinstance(value, float) else value


def _section(name: str, section: dict[str, Any]) -> list[str]:
    """Layers are sections of their own; other tables stand in one line."""
    lines = ["", f"[{name}]", *toml_lines({key: value for key, value in section.items() if key != "layers"})]
    for layer, constants in section.get("layers", {}).items():
        lines += ["", f"[{name}.layers.{layer}]", *toml_lines(constants)]
    return lines


def write_case(case: PeerCase, folder: Path) -> None:
    """Writes all but the mesh into a folder that is there."""
    for name, (header, rows) in case.tables.items():
        lines = "".join(f"{rounded(time)!r},{rounded(value)!r}\n" for time, value in rows)
        (folder / name).write_text(",".join(header) + "\n" + lines, encoding="utf-8")
    (folder / CASE).write_text(case_text(case), encoding="utf-8")
