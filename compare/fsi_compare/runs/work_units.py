"""Seconds of runs that were made on different machines, read together: work units, and word of the machines.

A work unit is the seconds of one product with the coupled matrix, which each run measures itself
(docs/guide/solvers.md, "Work units").
"""

from typing import Any, Mapping, Sequence

from ..base.errors import printable

Summary = Mapping[str, Any]  # summary.json as read_summary returns it

NOTE = (
    "Work units: seconds of a step over those of one product with the coupled matrix, measured in the same run; empty "
    "for runs that did not measure it."
)

NOTE_IN_ALL = f"Work units of all steps together. {NOTE}"


def per_step(summary: Summary) -> float | None:
    """Work units per step of the program that wrote the summary, without output; None: it did not measure the unit."""
    value = summary.get("totals", {}).get("work_units_per_step")
    return None if value is None else float(value)


def in_all(summary: Summary) -> float | None:
    """Work units of all steps together; None as in per_step()."""
    each, steps = per_step(summary), summary.get("totals", {}).get("steps")
    return None if each is None or steps is None else each * (steps - summary.get("restarted_from_step", 0))


def shown(work: float | None) -> str:
    """Text for tables: three digits, without exponent."""
    if work is None:
        return ""
    return f"{work:,.0f}" if work >= 100 else f"{work:.3g}"


def notes_on_work(summaries: Sequence[Summary], whole: bool = False) -> list[str]:
    """Notes for a table of runs: on their machines, and on work units, of a step or of the `whole` run."""
    machines, of = about_machines(summaries), in_all if whole else per_step
    measured = any(of(summary) is not None for summary in summaries)
    return ([f"{machines}."] if machines else []) + ([NOTE_IN_ALL if whole else NOTE] if measured else [])


def about_machines(summaries: Sequence[Summary]) -> str:
    """A sentence without full stop where the runs were made on machines with several processors, or by several builds
    of the programs; else empty. A run that does not name its build counts as another build beside one that does."""
    processors = _distinct([printable(s.get("machine", {}).get("processor", "")) for s in summaries])
    builds = _distinct([_build(s) for s in summaries])
    if any("build" in s for s in summaries) and not all("build" in s for s in summaries):
        builds.append("one that does not name itself")
    found = (("processors", processors), ("builds", builds))
    parts = [f"{len(names)} {kind}: {', '.join(names)}" for kind, names in found if len(names) > 1]
    return f"These runs are of {'; and of '.join(parts)}; compare work units, not seconds" if parts else ""


def _distinct(names: Sequence[str]) -> list[str]:
    """The names in the order in which they come, each once, without unknown ones."""
    return list(dict.fromkeys(name for name in names if name))


def _build(summary: Summary) -> str:
    """Name of the build; empty where the summary does not tell."""
    build = summary.get("build", {})
    words = [build.get("compiler", ""), build.get("instruction_set", "")]
    return printable(" ".join([summary.get("version", ""), *words]).strip()) if any(words) else ""
