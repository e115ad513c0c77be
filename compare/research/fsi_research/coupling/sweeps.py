"""The schemes over one quantity at a time, every result compared with the monolithic driver's.

`[report.sweeps]`: `bound`, the largest difference from the monolithic pressure that passes for the same answer;
`one_pass`, schemes that do not iterate, or not on all, whose difference is relative to the largest pressure of the run,
or the displacement's if that is larger."""

from dataclasses import dataclass
from typing import Dict, List, Optional, Sequence

from fsi_compare.reporting.column import Column, Facts
from fsi_compare.reporting.layout import Table
from ..evidence.cross_check import AGREES, BOUND, DEVIATES, FAR, FAULTS, UNCHECKED, WRONG, Cell, cells
from ..evidence.commands import with_name
from fsi_compare.study.study_file import Study
from ..catalogue.report_section import report_of
from fsi_compare.study.study_run import StudyRun
from . import added_mass_runs
from .pictures import Series

KEYS = ("bound", "one_pass")
REPORT_KEYS = ("sweeps", *added_mass_runs.QUANTITIES)
MONOLITHIC = "fsi-monolithic"


@dataclass(frozen=True)
class Settings:
    bound: float
    one_pass: Sequence[str]


def settings_of(study: Study) -> Settings:
    entry = report_of(study, REPORT_KEYS).section("sweeps", KEYS)
    return Settings(
        entry.number("bound", BOUND), entry.names("one_pass", list(study.methods), [], "method of the study")
    )


def checked(runs: Sequence[StudyRun], settings: Settings) -> List[Cell]:
    """The partitioned runs of a sweep, compared with its monolithic ones."""
    references = list(
        dict.fromkeys(run.request.method.name for run in runs if run.request.method.program == MONOLITHIC)
    )
    return [
        cell
        for cell in cells(runs, references, settings.one_pass, settings.bound)
        if cell.run.request.method.program != MONOLITHIC
    ]


def varied(run: StudyRun) -> float:
    """The value of the one quantity that a sweep varies."""
    return float(next(value for name, value in run.request.values.items() if name != "mesh"))


def off(cell: Cell) -> bool:
    """It says done, and its answer is another than the monolithic one."""
    return cell.run.done and cell.outcome in (DEVIATES, FAR, WRONG)


def schemes(found: Sequence[Cell]) -> List[str]:
    return list(dict.fromkeys(cell.method for cell in found))


def series(found: Sequence[Cell]) -> List[Series]:
    lines = []
    for name in schemes(found):
        own = sorted((cell for cell in found if cell.method == name), key=lambda cell: varied(cell.run))
        lines.append(
            Series(
                label=own[0].run.method_label,
                x=[varied(cell.run) for cell in own],
                passes=[cell.run.passes if cell.run.done else None for cell in own],
                off=[off(cell) for cell in own],
            )
        )
    return lines


def in_words(found: Sequence[Cell], settings: Settings) -> str:
    done = [cell for cell in found if cell.run.done]
    alike = [cell.difference for cell in done if cell.outcome == AGREES and cell.difference is not None]
    text = (
        f"Of {len(found)} runs {len(done)} came to their end. The pressure of {len(alike)} is the monolithic one "
        f"at every time level, to {settings.bound:g} of the level's largest"
        + (f" (the furthest {max(alike):.1e})" if alike else "")
    )
    others = [
        (
            sum(off(cell) for cell in done),
            "is off by more than that and marked so",
            "are off by more than that and marked so",
        ),
        (
            sum(cell.outcome == UNCHECKED for cell in done),
            "has no monolithic run to be held against",
            "have no monolithic run to be held against",
        ),
    ]
    for count, one, many in others:
        if count:
            text += f"; {count} {one if count == 1 else many}"
    return text + "."


def _cells(group: str) -> List[Column[Cell]]:
    """Columns of the CSV."""
    return [
        Column(csv="scheme", value=lambda c: c.method),
        Column(csv=group, value=lambda c: varied(c.run)),
        Column(csv="steps", value=lambda c: c.run.steps),
        Column(csv="mean", value=lambda c: c.run.passes if c.run.done else None),
        Column(csv="status", value=lambda c: c.run.status),
        Column(csv="outcome", value=lambda c: c.outcome),
        Column(csv="largest_difference", value=lambda c: c.difference),
        Column(csv="compared_with", value=lambda c: c.against and c.against.request.method.name),
        Column(csv="message", value=lambda c: c.run.message),
        Column(csv="command", value=lambda c: with_name(c.run.command)),
        Column(csv="displacement_difference", value=lambda c: c.displacement),
    ]


Swept = Dict[float, Cell]  # of a scheme, by what is varied, rising


def _of_value(value: float) -> Column[Swept]:
    return Column(f"{value:g}", value=lambda own: cell_text(own[value]) if value in own else "")


def _worst(own: Swept) -> Optional[float]:
    differences = [cell.off for cell in own.values() if cell.run.done and cell.off is not None]
    return max(differences, default=None)


def sweep_table(group: str, label: str, found: Sequence[Cell], settings: Settings) -> Table:
    values = sorted({varied(cell.run) for cell in found})
    own = [{varied(cell.run): cell for cell in found if cell.method == name} for name in schemes(found)]
    rows = [dict(sorted(cells.items())) for cells in own]
    return Table(
        f"coupling_{group}",
        f"Mean coupling iterations per step against the {label}",
        [
            Column("scheme", value=lambda row: next(iter(row.values())).run.method_label, left=True),
            *map(_of_value, values),
            Column("largest difference from monolithic", value=_worst, format=".1e"),
        ],
        rows,
        Facts(_cells(group), [cell for row in rows for cell in row.values()]),
        [
            "Difference: of the pressure of runs that came to their end, the largest of all time levels, "
            "relative to the largest pressure of the level"
            + (
                f"; of {', '.join(settings.one_pass)}, which do not iterate, or not on all of the coupling, of all levels, or that of the displacement if larger."
                if settings.one_pass
                else "."
            )
        ],
    )


def cell_text(cell: Cell) -> str:
    if not cell.run.done:
        return cell.run.status
    shown = f" (off {100 * cell.off:.2g} %)" if cell.off is not None and off(cell) else ""
    return f"{cell.run.passes:.1f}{shown}"


def faults(found: Sequence[Cell]) -> List[Cell]:
    """What no method may do, one that makes one pass no more than others."""
    return [cell for cell in found if cell.outcome in FAULTS]
