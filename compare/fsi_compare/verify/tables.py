"""The tables of a verification, and its JSON, which `fsi-compare report` reads (runs/verification.py)."""

import json
from pathlib import Path
from typing import Any, Sequence

from ..base.files import write_text
from ..reporting.column import Column
from ..reporting.layout import Table
from ..runs.verification import FILE, identity
from ..starting.duration import duration
from .family import Member
from .results import BarsOfRun, FamilyRuns, Judged
from .verdict import BAR_WIDENED, CONVERGES, NOT_IN_RANGE


def _said(judged: Judged) -> str:
    return judged.bar.verdict + (f": {judged.bar.advice}" if judged.bar.advice else "")


BARS: Sequence[Column[Judged]] = (
    Column("driver", "driver", lambda j: j.driver, left=True),
    Column("quantity", "quantity", lambda j: j.quantity.name, left=True),
    Column("unit", "unit", lambda j: j.quantity.unit, left=True),
    Column("value", "value", lambda j: j.bar.value, ".6g"),
    Column("±", "error", lambda j: j.bar.total if j.bar.given else None, ".2g"),
    Column("± [%]", "error_percent", lambda j: 100 * j.bar.relative if j.bar.given else None, ".2g"),
    Column("mesh", "error_mesh", lambda j: j.bar.mesh.bar if j.bar.given else None, ".1e", group="of this"),
    Column("step", "error_step", lambda j: j.bar.step.bar if j.bar.given else None, ".1e", group="of this"),
    Column("both", "error_both", lambda j: j.bar.together if j.bar.given else None, ".1e", group="of this"),
    Column("solver", "error_solver", lambda j: j.bar.solver if j.bar.given else None, ".1e", group="of this"),
    Column("mesh", "order_mesh", lambda j: j.bar.mesh.order, ".2f", group="order"),
    Column("step", "order_step", lambda j: j.bar.step.order, ".2f", group="order"),
    Column("verdict", "verdict", lambda j: j.bar.verdict, text=_said, left=True),
    Column(csv="advice", value=lambda j: j.bar.advice),
    Column(csv="scale", value=lambda j: j.quantity.scale),
    Column(csv="estimate_of_exact", value=lambda j: j.bar.best if j.bar.given else None),
    Column(csv="estimated_error", value=lambda j: j.bar.off if j.bar.given else None),
)

Row = tuple[str, Member, Any]
MEMBERS: Sequence[Column[Row]] = (
    Column("driver", "driver", lambda r: r[0], left=True),
    Column("member", "member", lambda r: r[1].name, left=True),
    Column("size of elements", "mesh", lambda r: r[1].mesh, ".3g"),
    Column("size of steps", "step", lambda r: r[1].step, ".3g"),
    Column("nodes", "nodes", lambda r: r[2].summary.get("mesh", {}).get("nodes")),
    Column("steps", "steps", lambda r: r[2].steps or None),
    Column("seconds", "wall", lambda r: r[2].seconds, ".1f", "s"),
    Column("memory [MiB]", "memory_MiB", lambda r: r[2].summary.get("peak_memory_MiB"), ".0f"),
    Column("end", "status", lambda r: r[2].status, text=lambda r: r[2].end_words, left=True),
    Column(csv="folder", value=lambda r: r[2].folder.name),
)


def bars_table(judged: Sequence[Judged]) -> Table:
    notes = [
        "±: the run's value and the exact one differ by no more than this. Percent are of the largest value of the curve that "
        "the quantity is of.",
        "curve, line, at any time, anywhere: the error of the curve itself, as root mean square and where it is largest. The value "
        "is the curve's own, which percent are of.",
        "An order is that of the differences between members; a dash: too few, too small or swinging differences.",
    ]
    return Table("bars", "How wrong the results are", BARS, judged, notes=notes)


def members_table(families: Sequence[FamilyRuns]) -> Table:
    rows = [(f.driver, member, run) for f in families for member, run in f.runs.items()]
    notes = ["Sizes are relative to the user's own: 0.5 is half as large. Looser: tolerances ten times as large."]
    return Table("members", "The family", MEMBERS, rows, notes=notes)


def counts(judged: Sequence[Judged]) -> list[str]:
    """How many have which verdict, in sentences."""
    numbers = {of: sum(one.bar.verdict == of for one in judged) for of in (CONVERGES, BAR_WIDENED, NOT_IN_RANGE)}
    return [f"{number} of {len(judged)}: {verdict}." for verdict, number in numbers.items() if number]


def in_short(judged: Sequence[Judged], families: Sequence[FamilyRuns]) -> list[str]:
    """The answer."""
    lines = counts(judged)
    given = [one for one in judged if one.bar.given]
    if given:
        worst = max(given, key=lambda one: one.bar.relative)
        lines.append(f"The widest bar is {100 * worst.bar.relative:.2g} %, of {worst.quantity.name} ({worst.driver}).")
    for family in families:
        driver, own = family.driver, family.own
        for member, run in family.failures.items():
            why = f"{run.status}, {run.message}"
            lines.append(f"The member '{member.name}' of the {driver} driver is missing: {why}.")
        if own is not None:
            whole = duration(sum(run.seconds for run in family.runs.values()))
            lines.append(f"The {driver} run by itself takes {duration(own.seconds)}, its family {whole}.")
    return lines


def write_json(folder: Path, about: dict[str, Any], sets: Sequence[BarsOfRun], families: Sequence[FamilyRuns]) -> Path:
    """`verification.json`: about the case, all bars with what tells the run that they are of, all members."""
    members = [dict(_fields(MEMBERS, row)) for row in members_table(families).records]
    data = {**about, "sets": [_set(one) for one in sets], "members": members}
    write_text(folder / FILE, json.dumps(data, indent=1, ensure_ascii=False) + "\n")
    return folder / FILE


def _set(bars: BarsOfRun) -> dict[str, Any]:
    quantities = [{**dict(_fields(BARS, one)), "values": [vars(value) for value in one.values]} for one in bars.judged]
    run = identity(bars.run.folder, bars.run.summary)
    return {"driver": bars.driver, "folder": bars.run.folder.name, "run": run, "quantities": quantities}


def _fields(columns: Sequence[Column[Any]], record: Any) -> list[tuple[str, Any]]:
    return [(column.name, column.value(record)) for column in columns if column.csv]
