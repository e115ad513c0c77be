"""What methods leave that do not iterate until fluid and wall agree, or not on all that they share: pressure and
displacement against the other driver's with the same step."""

from typing import Any, Dict, List, NamedTuple, Sequence

from fsi_compare.reporting.column import Column, Facts
from fsi_compare.reporting.layout import Table
from fsi_compare.reporting.report import Report
from ..evidence.cross_check import USABLE, Cell, point_of, quantity
from fsi_compare.study.study_file import show
from fsi_compare.study.study_run import DONE
from .settings import Settings


class AtValue(NamedTuple):
    """The methods at a value of what is varied."""

    case: str
    quantity: str
    value: Any
    cells: Dict[str, Cell]  # by method


def splitting(report: Report, found: Sequence[Cell], settings: Settings) -> None:
    own = [cell for cell in found if cell.method in settings.one_pass]
    if not any(cell.off is not None for cell in own):
        return
    report.section("What methods leave that do not iterate")
    report.text(
        f"Against the other driver with the same step, in percent: largest difference of the pressure, relative to the largest pressure "
        "of the run / difference of the wall's displacement, Euclidean norm over levels and points. A star: the run itself says that "
        "its error is not small. " + _in_words(own)
    )
    report.table(splitting_table(own, settings))


def _in_words(own: Sequence[Cell]) -> str:
    lines = []
    for name in dict.fromkeys(cell.method for cell in own):
        ended = [cell for cell in own if cell.method == name and cell.run.done and cell.off is not None]
        if not ended:
            continue
        far = [cell for cell in ended if cell.off is not None and cell.off > USABLE]
        silent = sum(not cell.warns for cell in far)
        lines.append(
            f"`{name}`: {len(far)} of {len(ended)} runs are off by more than {100 * USABLE:g} %"
            + (f", of which {silent} do not say so" if far else "")
        )
    return "; ".join(lines) + "."


def splitting_table(own: Sequence[Cell], settings: Settings) -> Table:
    rows: Dict[Any, AtValue] = {}
    for cell in own:
        case, name, value = point_of(cell.run)
        at = rows.setdefault((cell.run.request.group, case, value), AtValue(case, name, value, {}))
        at.cells[cell.method] = cell
    methods = list(dict.fromkeys(cell.method for cell in own))
    several = len({row.case for row in rows.values()}) > 1
    case_column: Column[AtValue] = Column("case", value=lambda row: row.case, left=True)
    columns: List[Column[AtValue]] = [
        *([case_column] if several else []),
        Column("quantity", value=lambda row: settings.label(row.quantity), left=True),
        Column("value", value=lambda row: show(row.value), left=True),
        *map(_of_method, methods),
    ]
    return Table("splitting", "Pressure / displacement, off by %", columns, list(rows.values()), Facts(CELLS, own))


def _of_method(name: str) -> Column[AtValue]:
    return Column(name, value=lambda row: cell_text(row.cells[name]) if name in row.cells else "")


def cell_text(cell: Cell) -> str:
    if cell.run.status != DONE:
        return cell.run.status
    parts = ["-" if d is None else f"{100 * d:.2g}" for d in (cell.difference, cell.displacement)]
    return " / ".join(parts) + (" *" if cell.warns else "")


CELLS: Sequence[Column[Cell]] = (
    Column(csv="group", value=lambda c: c.run.request.group),
    Column(csv="case", value=lambda c: c.run.request.case),
    Column(csv="quantity", value=lambda c: quantity(c.run)),
    Column(csv="value", value=lambda c: c.run.request.values[quantity(c.run)]),
    Column(csv="method", value=lambda c: c.method),
    Column(csv="outcome", value=lambda c: c.outcome),
    Column(csv="pressure_difference", value=lambda c: c.difference),
    Column(csv="displacement_difference", value=lambda c: c.displacement),
    Column(csv="says_so", value=lambda c: int(c.warns)),
)
