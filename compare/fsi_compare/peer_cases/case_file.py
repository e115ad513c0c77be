"""Writes a case: case.toml and its tables. The mesh is written by fsi-mesh, from what geometry.py hands over."""

from pathlib import Path
from typing import Any

from .model import PeerCase
from .units import rounded

CASE, MESH = "case.toml", "mesh.msh"


def value_of(value: Any) -> str:
    """The value as TOML. Raises TypeError for what a case file cannot express."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        number = rounded(float(value)) if isinstance(value, float) else value
        return repr(number)
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(value_of(entry) for entry in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {value_of(entry)}" for key, entry in value.items()) + " }"
    raise TypeError(type(value).__name__)


def case_text(case: PeerCase) -> str:
    lines = [f"# From {case.file.name} of {case.program}. What has no counterpart is in import.log."]
    plain = {key: value for key, value in case.sections.items() if not isinstance(value, (dict, list))}
    lines += [f"{key} = {value_of(value)}" for key, value in plain.items()]
    for name, section in case.sections.items():
        if name in plain:
            continue
        if isinstance(section, list):
            for entry in section:
                lines += ["", f"[[{name}]]"] + _entries(entry)
        else:
            lines += _section(name, section)
    return "\n".join(lines) + "\n"


def _section(name: str, section: dict[str, Any]) -> list[str]:
    """Layers are sections of their own; other tables stand in one line."""
    below = {key: value for key, value in section.items() if key == "layers"}
    lines = ["", f"[{name}]"] + _entries({k: v for k, v in section.items() if k not in below})
    for key, layers in below.items():
        for layer, constants in layers.items():
            lines += ["", f"[{name}.{key}.{layer}]"] + _entries(constants)
    return lines


def _entries(section: dict[str, Any]) -> list[str]:
    return [f"{key} = {value_of(value)}" for key, value in section.items()]


def write_case(case: PeerCase, folder: Path) -> None:
    """Writes all but the mesh into a folder that is there."""
    for name, table in case.tables.items():
        rows = "".join(f"{rounded(time)!r},{rounded(value)!r}\n" for time, value in table.rows)
        (folder / name).write_text(",".join(table.header) + "\n" + rows, encoding="utf-8")
    (folder / CASE).write_text(case_text(case), encoding="utf-8")
