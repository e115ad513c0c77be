"""How far the methods carry: the first Newton system of the paper's case with one quantity at a time far from it."""

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Callable, List, NamedTuple, Optional, Sequence, Tuple

from fsi_compare.base.files import TEMPORARY, absolute, exists, make_folder
from ..catalogue.names import MATERIALS
from fsi_compare.reporting.column import Column, Facts
from fsi_compare.reporting.layout import Table
from fsi_compare.starting.processes import execute
from fsi_compare.starting.programs import Program, find_mesh_maker
from .results import NewtonSystem, Solve
from .study import Outcome, Request

FLUID_DENSITY = 1.0  # mg/mm^3, of the paper's case
ASPECT_RATIO = 20
SYSTEM = (1, 1)

# Edge length across, stations along the axis: those of the levels of fsi-mesh.
CROSS_SIZE = {"coarse": 0.75, "intermediate": 0.375, "fine": 0.1875}  # mm
STATIONS = {"coarse": 23, "intermediate": 53, "fine": 107}


@dataclass(frozen=True)
class Row:
    """One line of the table: the quantity, its value, and the settings that make it so, whatever the case file says."""

    quantity: str
    unit: str
    value: float
    settings: Tuple[str, ...] = ()
    axial_stretch: Optional[float] = None  # edge length along the axis / across; the mesh is made for it

    @property
    def is_papers(self) -> bool:
        return self.quantity == "as in the paper"

    @property
    def folder(self) -> str:
        return f"{self.quantity} {self.value:g}".replace(" ", "-").replace("/", "-to-").strip("-")


def rows() -> List[Row]:
    found = [Row("as in the paper", "", 1)]
    for exponent in range(-3, 4):
        ratio = 10.0**exponent
        found.append(
            Row(
                "density wall/fluid",
                "",
                ratio,
                (f"fluid.density={FLUID_DENSITY!r}", f"structure.density={ratio * FLUID_DENSITY!r}"),
            )
        )
    for step in (0.0125, 1.25):  # the paper's 0.125 ms times 1/10 and 10; the inlet's pulse keeps its length
        found.append(Row("time step", "ms", step, (f"time.step={step!r}", f"time.end={step!r}")))
    for exponent in range(2, 8):
        found.append(Row("bulk modulus", "kPa", 10.0**exponent, (f"structure.bulk_modulus={10.0 ** exponent!r}",)))
    for viscosity in (3.5e-5, 0.35):  # the paper's 3.5e-3 kPa ms times 1/100 and 100
        found.append(Row("viscosity", "kPa ms", viscosity, (f"fluid.viscosity={viscosity!r}",)))
    for stretch in (ASPECT_RATIO, 1 / ASPECT_RATIO):
        found.append(Row("edge along/across axis", "", stretch, axial_stretch=stretch))
    return found


VARIED = ("fluid.density", "structure.density", "time.step", "time.end", "structure.bulk_modulus", "fluid.viscosity")


@dataclass(frozen=True)
class Planned:
    row: Row
    request: Request
    failure: str = ""  # the mesh could not be made


def plan(
    folder: Path, program: Program, template: Request, materials: Sequence[str], meshes: Sequence[str], cases: Path
) -> List[Planned]:
    """One run for each row, material and mesh; makes the stretched meshes. `template` holds what all runs share."""
    planned = []
    for material in materials:
        for mesh in meshes:
            for row in rows():
                settings, failure = (f"mesh.level={mesh}",), ""
                files: Tuple[Path, ...] = ()
                if row.axial_stretch is not None:
                    file = folder / "runs" / "meshes" / f"{mesh}-{row.axial_stretch:g}.msh"
                    failure = make_stretched_mesh(program, file, mesh, row.axial_stretch)
                    settings, files = (f"mesh.file={absolute(file)}",), () if failure else (file,)
                request = replace(
                    template,
                    name=f"stress-{material}-{mesh}-{row.folder}",
                    case=cases / f"{material}.toml",
                    material=material,
                    mesh=mesh,
                    settings=(*template.settings, *row.settings, *settings),
                    systems=(SYSTEM,),
                    files=files,
                )
                planned.append(Planned(row, request, failure))
    return planned


def make_stretched_mesh(program: Program, file: Path, mesh: str, stretch: float) -> str:
    """The artery with the level's cross-section and number of stations, but so long or short that its elements are
    stretched. Returns what went wrong, nothing if all is well."""
    maker = find_mesh_maker(program)
    if maker is None:
        return "fsi-mesh is neither beside fsi-linear-study nor on the path"
    if exists(file):
        return ""
    make_folder(file.parent)
    axial = stretch * CROSS_SIZE[mesh]
    unfinished = file.with_name(f".{file.stem}{TEMPORARY}.msh")
    size = ("--size", CROSS_SIZE[mesh], "--axial-size", axial, "--length", axial * STATIONS[mesh])
    ended = execute((maker, "artery", *size, "--format", "2.2", "-q", "-o", unfinished))
    if ended.code != 0:
        return f"fsi-mesh: {ended.message}"
    os.replace(unfinished, file)
    return ""


class Cell(NamedTuple):
    """One method in one line of the table."""

    line: Planned
    outcome: Outcome
    method: str

    @property
    def system(self) -> Optional[NewtonSystem]:
        return self.outcome.results.systems[SYSTEM] if self.outcome.results else None

    @property
    def solve(self) -> Optional[Solve]:
        return self.system.solves[self.method] if self.system else None

    @property
    def good(self) -> Optional[Solve]:
        return self.solve if self.solve is not None and self.solve.converged else None

    @property
    def status(self) -> str:
        return "converged" if self.good else "not converged" if self.solve else "failed"

    @property
    def message(self) -> str:
        return "" if self.good else self.solve.message if self.solve else self.outcome.failure

    @property
    def iterations(self) -> str:
        """For people."""
        return str(self.good.iterations) if self.good else "n.c." if self.solve else "failed"

    @property
    def failure(self) -> str:
        """Text for the notes."""
        where = f"{self.line.row.quantity} {self.line.row.value:g}".strip()
        return f"n.c.: {self.method}, {where}: {self.message}" if self.solve else f"failed: {where}: {self.message}"


Line = Sequence[Cell]  # of all methods


def _of_method(place: int, method: str) -> List[Column[Line]]:
    return [
        Column(
            "#it",
            value=lambda line: _of_good("iterations")(line[place]),
            text=lambda line: line[place].iterations,
            group=method,
        ),
        Column("seconds", value=lambda line: _of_good("total_seconds")(line[place]), format=".3g", group=method),
        Column("converged", value=lambda line: "yes" if line[place].good else "no", group=method),
    ]


def _of_good(name: str) -> Callable[[Cell], Any]:
    return lambda cell: getattr(cell.good, name) if cell.good else None


CELLS: Sequence[Column[Cell]] = (
    Column(csv="material", value=lambda c: c.line.request.material),
    Column(csv="mesh", value=lambda c: c.line.request.mesh),
    Column(csv="nodes", value=lambda c: c.outcome.results.mesh.get("nodes") if c.outcome.results else None),
    Column(csv="unknowns", value=lambda c: c.system.unknowns["total"] if c.system else None),
    Column(csv="quantity", value=lambda c: c.line.row.quantity),
    Column(csv="value", value=lambda c: c.line.row.value),
    Column(csv="unit", value=lambda c: c.line.row.unit),
    Column(csv="method", value=lambda c: c.method),
    Column(csv="status", value=lambda c: c.status),
    Column(csv="iterations", value=_of_good("iterations")),
    Column(csv="set_up_seconds", value=_of_good("set_up_seconds")),
    Column(csv="solve_seconds", value=_of_good("solve_seconds")),
    Column(csv="work_units", value=_of_good("work_units")),
    Column(csv="relative_residual", value=_of_good("relative_residual")),
    Column(csv="message", value=lambda c: c.message),
)

LINES: Sequence[Column[Line]] = (
    Column("material", value=lambda line: MATERIALS[line[0].line.request.material], left=True),
    Column("mesh", value=lambda line: line[0].line.request.mesh, left=True),
    Column("quantity", value=lambda line: line[0].line.row.quantity, left=True),
    Column("value", value=lambda line: "" if line[0].line.row.is_papers else f"{line[0].line.row.value:g}"),
    Column("unit", value=lambda line: line[0].line.row.unit),
)


def stress_table(planned: Sequence[Planned], outcomes: Sequence[Outcome], methods: Sequence[str]) -> Table:
    """Iterations and seconds (set-up and solve) of each method, line by line."""
    lines = [[Cell(one, outcome, method) for method in methods] for one, outcome in zip(planned, outcomes)]
    cells = [cell for line in lines for cell in line]
    return Table(
        "stress",
        "Stress: first Newton system, one quantity at a time far from the paper's case",
        [*LINES, *(column for place, method in enumerate(methods) for column in _of_method(place, method))],
        lines,
        Facts(CELLS, cells),
        ["seconds: set-up and solve", *dict.fromkeys(cell.failure for cell in cells if not cell.good)],
    )
