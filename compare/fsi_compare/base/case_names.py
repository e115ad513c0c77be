"""Keys of case files: those that earlier versions named otherwise, as common/case/renamed_keys.cpp has them, and those
that name files."""

from typing import Any, Callable, Mapping

_NEWTON = ("mode", "error_tolerance", "residual_tolerance", "max_iterations")
RENAMED = {f"monolithic.{name}": f"newton.{name}" for name in _NEWTON} | {"monolithic.krylov_restart": "linear.restart"}
RENAMED |= {f"monolithic.{name}_tolerance": f"{name}.tolerance" for name in ("newton", "linear")}
RENAMED |= {f"{section}.direct_below": "linear.direct_below" for section in ("monolithic", "partitioned")}
RENAMED["monolithic.max_linear_iterations"] = "linear.max_iterations"


def short_name(key: str) -> str:
    """A key in labels: its last part, and the section where that alone would be ambiguous."""
    section, _, name = key.rpartition(".")
    return f"{section}_{name}" if section in ("newton", "linear") else name


def with_present_names(entries: Mapping[str, Any]) -> dict[str, Any]:
    """The entries of a case with their present names. Where both are given the drivers refuse the case."""
    found = dict(entries)
    for former, present in RENAMED.items():
        section, name = former.split(".")
        place, key = present.split(".")
        if isinstance(found.get(section), dict) and name in found[section] and isinstance(found.get(place, {}), dict):
            found[section] = {other: value for other, value in found[section].items() if other != name}
            found[place] = {key: entries[section][name], **found.get(place, {})}
            if not found[section]:
                del found[section]
    return found


def with_file_names(entry: Any, change: Callable[[str], str]) -> Any:
    """The entry with what `change` makes of each `file = "..."`, the key by which a case names a file. Keys may be
    dotted."""

    def changed(key: str, value: Any) -> Any:
        is_name = isinstance(value, str) and key.rpartition(".")[2] == "file"
        return change(value) if is_name else with_file_names(value, change)

    if isinstance(entry, Mapping):
        return {key: changed(key, value) for key, value in entry.items()}
    return [with_file_names(value, change) for value in entry] if isinstance(entry, list) else entry
