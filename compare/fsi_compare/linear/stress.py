"""How far the methods carry: the first Newton system of the paper's case with one quantity at a time far from it."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import List, Optional, Sequence, Tuple

from ..base.files import TEMPORARY, absolute, exists, make_folder
from ..base.names import MATERIALS
from ..reporting.layout import Table, fixed
from ..runs.processes import execute
from ..runs.programs import Program, find_mesh_maker
from .results import Solve
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
                planned.append(
                    Planned(
                        row,
                        Request(
                            name=f"stress-{material}-{mesh}-{row.folder}",
                            case=cases / f"{material}.toml",
                            material=material,
                            mesh=mesh,
                            settings=(*template.settings, *row.settings, *settings),
                            solvers=template.solvers,
                            systems=(SYSTEM,),
                            tolerance=template.tolerance,
                            threads=template.threads,
                            files=files,
                        ),
                        failure,
                    )
                )
    return planned


def make_stretched_mesh(program: Program, file: Path, mesh: str, stretch: float) -> str:
    """The artery with the level's cross-section and number of stations, but so long or short that its elements are
    stretched. Returns what went wrong, nothing if all is well."""
    maker = find_mesh_maker(program)
    if maker is None:
        return "fsi-mesh is neither beside fsi-monolithic nor on the path"
    if exists(file):
        return ""
    make_folder(file.parent)
    axial = stretch * CROSS_SIZE[mesh]
    unfinished = file.with_name(f".{file.stem}{TEMPORARY}.msh")
    ended = execute(
        (
            maker,
            "artery",
            "--size",
            CROSS_SIZE[mesh],
            "--axial-size",
            axial,
            "--length",
            axial * STATIONS[mesh],
            "--format",
            "2.2",
            "-q",
            "-o",
            unfinished,
        )
    )
    if ended.code != 0:
        return f"fsi-mesh: {ended.message}"
    os.replace(unfinished, file)
    return ""


def stress_table(planned: Sequence[Planned], outcomes: Sequence[Outcome], methods: Sequence[str]) -> Table:
    """Iterations and seconds (set-up and solve) of each method, line by line."""
    table = Table(
        "stress",
        "Stress: first Newton system, one quantity at a time far from the paper's case",
        [
            ("", "material"),
            ("", "mesh"),
            ("", "quantity"),
            ("", "value"),
            ("", "unit"),
            *((method, name) for method in methods for name in ("#it", "seconds", "converged")),
        ],
        (
            "material",
            "mesh",
            "nodes",
            "unknowns",
            "quantity",
            "value",
            "unit",
            "method",
            "status",
            "iterations",
            "set_up_seconds",
            "solve_seconds",
            "work_units",
            "relative_residual",
            "message",
        ),
        left=3,
    )
    failures = []
    for plan_, outcome in zip(planned, outcomes):
        row, request = plan_.row, plan_.request
        system = outcome.results.systems[SYSTEM] if outcome.results else None
        line = [
            MATERIALS[request.material],
            request.mesh,
            row.quantity,
            f"{row.value:g}" if row.quantity != "as in the paper" else "",
            row.unit,
        ]
        for method in methods:
            solve: Optional[Solve] = system.solves[method] if system else None
            good = solve if solve is not None and solve.converged else None
            status = "converged" if good else "not converged" if solve else "failed"
            message = "" if good else solve.message if solve else outcome.failure
            if good:
                line += [str(good.iterations), fixed(good.total_seconds, ".3g"), "yes"]
            else:
                line += ["n.c." if solve else "failed", "-", "no"]
                where = f"{row.quantity} {row.value:g}".strip()
                failures.append(f"n.c.: {method}, {where}: {message}" if solve else f"failed: {where}: {message}")
            numbers = (
                (good.iterations, good.set_up_seconds, good.solve_seconds, good.work_units, good.relative_residual)
                if good
                else (None,) * 5
            )
            table.csv_rows.append(
                (
                    request.material,
                    request.mesh,
                    outcome.results.mesh.get("nodes") if outcome.results else None,
                    system.unknowns["total"] if system else None,
                    row.quantity,
                    row.value,
                    row.unit,
                    method,
                    status,
                    *numbers,
                    message,
                )
            )
        table.rows.append(line)
    table.notes = ["seconds: set-up and solve", *dict.fromkeys(failures)]
    return table
