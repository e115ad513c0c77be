"""`summary.json` of a run: what of it fsi-compare uses, each entry of the kind that the drivers write."""

import math
import shlex
from pathlib import Path
from typing import Any, Callable, Mapping

from ..base.errors import InputError
from ..base.files import read_object

FILE = "summary.json"
PROGRAMS = {"fsi-monolithic": "monolithic", "fsi-partitioned": "partitioned"}
FINISHED = "give the result folder of a finished run"
AGAIN = "the run was interrupted while writing; run it again"
SPREAD = ("minimum", "mean", "maximum")  # of what each process of a run has
PER_PROCESS: tuple[str, ...] = ("threads", "step_seconds", "peak_memory_MiB", "reading_memory_MiB")
PER_PROCESS += ("owned_nodes", "halo_nodes", "halo_unknowns", "neighbours")
PER_PROCESS += ("messages_per_step", "bytes_per_step", "reductions_per_step")
MOST = 1 << 53  # counts up to here are exact as floating-point numbers too


def _text(value: Any) -> str | None:
    return None if isinstance(value, str) else "is not a text"


def _number(value: Any) -> str | None:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return "is not a number"
    if isinstance(value, float) and not math.isfinite(value):
        return f"is {value}"
    return None if 0 <= value < 1e100 else "is negative" if value < 0 else "is too large"


def _count(value: Any) -> str | None:
    if isinstance(value, bool) or not isinstance(value, int):
        return "is not a whole number"
    return None if 0 <= value <= MOST else "is negative" if value < 0 else "is too large"


def _spread(value: Any) -> str | None:
    """A number that is the same on all processes, or the least, the mean and the largest of theirs."""
    if not isinstance(value, dict):
        return _number(value)
    for name in SPREAD:
        if name not in value:
            return f"lacks {name}"
        problem = _number(value[name])
        if problem:
            return f"{name} {problem}"
    return None


class _Each(dict):
    """Entries of any name, all of one shape."""


Shape = Callable[[Any], str | None] | Mapping[str, Any]
SHAPE: Mapping[str, Shape] = {
    **dict.fromkeys(("title", "version", "case", "element", "geometry", "coupling_kind", "coupling_pass"), _text),
    **dict.fromkeys(("threads", "processes", "restarted_from_step"), _count),
    "per_process": {**{name: _spread for name in PER_PROCESS}, "phases": _Each(entry=_spread)},
    "peak_memory_MiB": _number,
    "mesh": {"name": _text, "nodes": _count, "hash": _text},
    "unknowns": {"coupled": _count},
    "phases": _Each(entry={"calls": _count, "seconds": _number}),
    "totals": _Each(entry=_number),
    "counters": _Each(entry=_number),
    "work_unit": {"seconds": _number, "products": _count, "entries": _count, "measuring_s": _number},
    "machine": {"processor": _text},
    "build": {"compiler": _text, "instruction_set": _text, "doubles_per_pack": _count},
}


def read_summary(path: Path) -> dict[str, Any]:
    """Reads the summary of a run that reached its end. Only `program` and `status` are demanded; an entry that is null
    counts as missing. Raises InputError naming the key."""
    summary = read_object(path, FINISHED, AGAIN)
    _require_driver(path, summary.get("program"))
    _require_done(path, summary)
    return checked(path, summary)


def checked(path: Path, value: Any, key: str = "", shape: Shape = SHAPE) -> Any:
    """The entries without nulls. Raises InputError, which names the key, for an entry of another kind than `shape`."""
    if not isinstance(shape, Mapping):
        problem = shape(value)
        if problem:
            raise InputError(path, key, problem, "run it again")
        return value
    if not isinstance(value, dict):
        raise InputError(path, key, "is not a JSON object", "run it again")
    kept = {}
    for name, entry in value.items():
        part = shape["entry"] if isinstance(shape, _Each) else shape.get(name)
        if entry is not None:
            kept[name] = entry if part is None else checked(path, entry, f"{key}.{name}".lstrip("."), part)
    return kept


def _require_driver(path: Path, program: Any) -> None:
    if program is None:
        raise InputError(path, "program", "is missing", "give the result folder of a driver")
    if not isinstance(program, str) or program not in PROGRAMS:
        raise InputError(path, "program", f"'{program}' is unknown", f"it must be {' or '.join(PROGRAMS)}")


def _require_done(path: Path, summary: Mapping[str, Any]) -> None:
    program, status, case = (summary.get(key) for key in ("program", "status", "case"))
    words = [str(program), *([case] if isinstance(case, str) else []), "--restart", str(path.parent)]
    resume = shlex.join(words)  # to be copied as it stands
    if status == "done":
        return
    log = path.parent / "run.log"
    change = f"see {log}, change the solver's settings and run it again"
    known: dict[Any, tuple[str, str]] = {
        None: ("is missing", "run it again"),
        "running": ("the run is not finished", f"wait for its end or resume it with {resume}"),
        "interrupted": ("the run was interrupted", f"resume it with {resume}, or run it again"),
        "not converged": ("the run stopped without converging", change),
        "failed": ("the run failed", f"see {log}"),
    }
    problem = known.get(status) if isinstance(status, (str, type(None))) else None
    raise InputError(path, "status", *(problem or (f"'{status}' is unknown", "it must be 'done'")))
