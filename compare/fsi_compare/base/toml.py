"""Values and names as TOML writes them."""

from datetime import date, time
from typing import Any, Mapping


def toml_value(value: Any) -> str:
    """Tables and lists in one line. Raises TypeError for what TOML cannot express."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float, date, time)):
        return str(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(toml_value, value))}]"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(toml_lines(value)) + " }"
    raise TypeError(type(value).__name__)


def toml_lines(entries: Mapping[str, Any]) -> list[str]:
    """KEY = VALUE of each."""
    return [f"{toml_key(key)} = {toml_value(value)}" for key, value in entries.items()]


def toml_key(name: str) -> str:
    return name if name.replace("-", "").replace("_", "").isalnum() and name.isascii() else _text(name)


def _text(text: str) -> str:
    return '"' + "".join(map(_character, text)) + '"'


def _character(c: str) -> str:
    if c in '"\\':
        return "\\" + c
    if 0xD800 <= ord(c) < 0xE000:  # half a character, or a byte of a file's name that is no UTF-8: TOML has neither
        return "\ufffd"
    return c if c.isprintable() else f"\\U{ord(c):08x}"
