"""A case file with the settings that were found, to be run as it stands from any folder."""

from pathlib import Path
from typing import Any, Mapping

from ..base.files import absolute, write_text
from ..base.toml import toml_key, toml_lines


def write_case(path: Path, entries: Mapping[str, Any], home: Path, comments: list[str]) -> None:
    """`home`: the folder that names of files in `entries` are relative to."""
    lines = [f"# {comment}" for comment in comments] + _section("", _with_full_names(entries, home))
    write_text(path, "\n".join(lines) + "\n")


def _with_full_names(entry: Any, home: Path) -> Any:
    """The entry with full paths in all `file = "..."`."""
    if isinstance(entry, Mapping):
        full = {key: _with_full_names(value, home) for key, value in entry.items()}
        return full | ({"file": str(absolute(home / entry["file"]))} if isinstance(entry.get("file"), str) else {})
    return [_with_full_names(value, home) for value in entry] if isinstance(entry, list) else entry


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
