"""A case file with the settings that were found, to be run as it stands from any folder."""

from pathlib import Path
from typing import Any, Mapping

from ..base.case_names import with_file_names
from ..base.files import absolute, write_text
from ..base.toml import toml_key, toml_lines


def write_case(path: Path, entries: Mapping[str, Any], home: Path, comments: list[str]) -> None:
    """`home`: the folder that names of files in `entries` are relative to."""
    full = with_file_names(entries, lambda name: str(absolute(home / name)))
    lines = [f"# {comment}" for comment in comments] + _section("", full)
    write_text(path, "\n".join(lines) + "\n")


def _section(name: str, entries: Mapping[str, Any]) -> list[str]:
    """Values first, then sections, as TOML has it."""
    values = {key: value for key, value in entries.items() if not _is_section(value)}
    lines = [f"[{name}]"] if name and (values or not entries) else []
    lines += toml_lines(values)
    for key, value in entries.items():
        inner = f"{name}.{toml_key(key)}".lstrip(".")
        if isinstance(value, Mapping):
            lines += _section(inner, value)
        elif _is_section(value):
            for one in value:
                lines += [f"[[{inner}]]", *toml_lines(one)]
    return lines


def _is_section(value: Any) -> bool:
    return isinstance(value, Mapping) or (isinstance(value, list) and bool(value) and isinstance(value[0], Mapping))
