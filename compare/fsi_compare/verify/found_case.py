"""A case file with the settings that were found, to be run as it stands from any folder."""

from pathlib import Path
from typing import Any, Mapping

from ..base.files import absolute, replacing


def write_case(path: Path, entries: Mapping[str, Any], home: Path, comments: list[str]) -> None:
    """`home`: the folder that names of files in `entries` are relative to."""
    lines = [f"# {comment}" for comment in comments] + _section("", _with_full_names(entries, home))
    with replacing(path) as temporary:
        temporary.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _with_full_names(entry: Any, home: Path) -> Any:
    """The entry with full paths in all `file = "..."`."""
    if isinstance(entry, Mapping):
        return {
            key: str(absolute(home / value))
            if key == "file" and isinstance(value, str)
            else _with_full_names(value, home)
            for key, value in entry.items()
        }
    return [_with_full_names(value, home) for value in entry] if isinstance(entry, list) else entry


def _section(name: str, entries: Mapping[str, Any]) -> list[str]:
    """Values first, then sections, as TOML has it."""
    values = {key: value for key, value in entries.items() if not _is_section(value)}
    lines = [f"[{name}]"] if name and (values or not entries) else []
    lines += [f"{_key(key)} = {_value(value)}" for key, value in values.items()]
    for key, value in entries.items():
        inner = f"{name}.{_key(key)}".lstrip(".")
        if isinstance(value, Mapping):
            lines += _section(inner, value)
        elif _is_section(value):
            for one in value:
                lines += [f"[[{inner}]]", *(f"{_key(k)} = {_value(v)}" for k, v in one.items())]
    return lines


def _is_section(value: Any) -> bool:
    return isinstance(value, Mapping) or (isinstance(value, list) and bool(value) and isinstance(value[0], Mapping))


def _key(name: str) -> str:
    return name if name.replace("-", "").replace("_", "").isalnum() and name.isascii() else _text(name)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }"
    return repr(value)


def _text(text: str) -> str:
    escaped = "".join(c if c.isprintable() and c not in '"\\' else f"\\u{ord(c):04x}" for c in text)
    return f'"{escaped}"'
