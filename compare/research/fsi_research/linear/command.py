"""`fsi-compare solvers`: the paper's linear solvers and ours on single Newton systems."""

import argparse
import math
import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import Dict, List, Optional, Sequence, Set, Tuple

from fsi_compare.base.errors import InputError, printable
from fsi_compare.base.files import folder, is_file, is_folder, make_folder, output_folder, replacing, together
from fsi_compare.base.options import Commands, add_command, add_count, add_output
from fsi_compare.base.folder_lock import locked
from ..catalogue.names import MATERIALS, METHODS, pick
from fsi_compare.study.mesh_levels import MESHES
from fsi_compare.reporting.layout import show_tables, write_tables
from fsi_compare.reporting.matplotlib_loader import load_matplotlib
from fsi_compare.starting.programs import Program
from . import stress as stress_study
from .programs import find_linear_study, has_petsc
from .results import System
from .study import Outcome, Request, run_study

CASES = Path(__file__).resolve().parents[4] / "meshes" / "artery"
STRESS_METHODS = "fast,amg_fgmres"
STUDY_OWN = ("mesh.level", "mesh.file")  # chosen by --meshes

DESCRIPTION = """\
Solves single Newton systems of the artery by several methods, one run of fsi-linear-study for each material and mesh.
Prints the paper's Tables 3 (Newton), 4 (block preconditioners) and 5 (coupled AMG and AMLI) with its numbers beside
ours, then what each method costs. Writes to OUTDIR:
  table3_newton.csv, table4_*.csv, table5_*.csv, cost_*.csv, sub_problems.csv    with units in the column names
  solvers.md                                          all tables, for documents
  iterations_*.png, .svg and cost_*.png, .svg         against the number of unknowns
  runs/                                               result folders; runs that are finished are not repeated
With --stress instead: stress.csv and stress.md, iterations with one quantity at a time far from the paper's case.
A finished run is taken up again when version, case, settings and threads are the same and all methods, systems and the
tolerance are there; after a change of the program without a new version, delete runs/.
Exit code 2: something did not converge or failed; the tables say what."""

EXAMPLES = """\
examples:
  fsi-compare solvers -o results/solvers --meshes coarse,intermediate
  fsi-compare solvers --methods amg_fgmres,fast,direct --materials neo-hookean --systems 12:2 --without fine:direct
  fsi-compare solvers --stress -o results/stress
"""


def add_parser(commands: Commands, version: str) -> None:
    command = add_command(
        commands, "solvers", solvers, "iterations and cost of the linear solvers", DESCRIPTION, EXAMPLES
    )
    add_output(command, "results/solvers")
    command.add_argument(
        "--methods", metavar="A,B,...", help=f"of {', '.join(METHODS)} (default: all; with --stress {STRESS_METHODS})"
    )
    command.add_argument(
        "--materials", metavar="A,B,...", help=f"of {', '.join(MATERIALS)} (default: all; with --stress neo-hookean)"
    )
    command.add_argument(
        "--meshes", metavar="A,B,...", help=f"of {', '.join(MESHES)} (default: all; with --stress coarse)"
    )
    command.add_argument(
        "--without",
        metavar="MESH:METHOD,...",
        help="leave a method out on a mesh, e.g. fine:direct where it does not fit into memory",
    )
    command.add_argument(
        "--systems",
        metavar="STEP:IT,...",
        help="time step and Newton iteration of each system (default: 1:1,12:2; with --stress 1:1)",
    )
    command.add_argument(
        "--tolerance",
        metavar="TOL",
        type=float,
        default=1e-9,
        help="of the true relative residual (default: %(default)g)",
    )
    command.add_argument("--sub-problems", action="store_true", help="convergence factors of the sub-problems' AMG too")
    command.add_argument(
        "--stress",
        action="store_true",
        help="densities, time step, bulk modulus, viscosity and element shape far from the paper's",
    )
    command.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        default=[],
        dest="settings",
        help="override an entry of the case files; may be repeated",
    )
    command.add_argument(
        "--case-dir",
        metavar="DIR",
        type=Path,
        default=CASES,
        help="folder with a case file per material, e.g. neo-hookean.toml (default: meshes/artery of the sources)",
    )
    command.add_argument(
        "--program", metavar="PATH", type=Path, help="fsi-linear-study (default: beside this program, else on the path)"
    )
    command.add_argument("--threads", metavar="N", type=int, help="of fsi-linear-study; 0: one per core (its default)")
    add_count(command, "--jobs", "runs at once (default: 1); more than one spoils the seconds", 1)
    command.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")
    command.add_argument("--version", action="version", version=f"fsi-compare {version}")


def solvers(options: argparse.Namespace) -> int:
    """Checks everything before the first run. Returns the exit code."""
    methods = pick("--methods", options.methods or (STRESS_METHODS if options.stress else ",".join(METHODS)), METHODS)
    materials = pick(
        "--materials", options.materials or ("neo-hookean" if options.stress else ",".join(MATERIALS)), list(MATERIALS)
    )
    meshes = pick("--meshes", options.meshes or ("coarse" if options.stress else ",".join(MESHES)), list(MESHES))
    systems = read_systems(options.systems or ("1:1" if options.stress else "1:1,12:2"))
    without = read_without(options.without)
    if not (math.isfinite(options.tolerance) and 0 < options.tolerance < 1):
        raise InputError(
            "", "--tolerance", f"{options.tolerance:g} will not do", "give a number between 0 and 1, e.g. 1e-9"
        )
    if options.threads is not None and options.threads < 0:
        raise InputError("", "--threads", f"{options.threads} is negative", "give 1 or more, or 0 for one per core")
    if options.stress:
        check_stress(options, systems)
    settings = read_settings(options.settings, options.stress)
    for material in materials:
        check_case(options.case_dir, material)
    program = find_linear_study(options.program)
    if "petsc" in methods and not has_petsc(program):
        methods = leave_out_petsc(options, program, methods)
    with output_folder(options.output), locked(options.output):
        check_writable(options.output)
        return solve(options, program, methods, materials, meshes, systems, without, settings)


def leave_out_petsc(options: argparse.Namespace, program: Program, methods: Sequence[str]) -> List[str]:
    """The methods that a program without PETSc has. Raises InputError where petsc is asked for by name."""
    if options.methods:
        raise InputError(
            program.path, "--methods", "petsc is not in this build (FSI_MPI=OFF)", "leave it out, or build with MPI"
        )
    if not options.quiet:
        print(f"{printable(str(program.path))} is without petsc, which is left out", file=sys.stderr)
    return [name for name in methods if name != "petsc"]


def solve(
    options: argparse.Namespace,
    program: Program,
    methods: Sequence[str],
    materials: Sequence[str],
    meshes: Sequence[str],
    systems: Sequence[System],
    without: Set[Tuple[str, str]],
    settings: Tuple[str, ...],
) -> int:
    """Makes the runs that are missing and the tables from all."""
    base = Request(
        name="",
        case=options.case_dir,
        material="",
        mesh="",
        settings=settings,
        solvers=tuple(methods),
        systems=tuple(systems),
        tolerance=options.tolerance,
        threads=options.threads,
        sub_problems=options.sub_problems,
    )
    if options.stress:
        return stress(options, program, base, materials, meshes)

    requests = []
    for mesh in sorted(meshes, key=list(MESHES).index):  # small ones first: they tell the time left
        asked = tuple(name for name in methods if (mesh, name) not in without)
        if not asked:
            raise InputError("", "--without", f"leaves no method on the {mesh} mesh", "leave the mesh out of --meshes")
        for material in materials:
            case, level = options.case_dir / f"{material}.toml", (*settings, f"mesh.level={mesh}")
            name = f"{material}-{mesh}"
            requests.append(
                replace(base, name=name, case=case, material=material, mesh=mesh, settings=level, solvers=asked)
            )
    outcomes = run_study(program, options.output / "runs", requests, options.quiet, options.jobs)

    load_matplotlib()
    from . import grid as grids, solver_pictures, solver_tables  # matplotlib takes a second to load

    grid = grids.Grid(outcomes)
    tables = solver_tables.solver_tables(grid)
    with together(options.output) as place:
        written = write_tables(place, tables, "solvers.md", "Linear solvers")
        written += solver_pictures.write_solver_pictures(place, grid)
    if not options.quiet:
        show_tables(tables, options.output, written)
    return exit_code(outcomes)


def stress(
    options: argparse.Namespace, program: Program, base: Request, materials: Sequence[str], meshes: Sequence[str]
) -> int:
    planned = stress_study.plan(options.output, program, base, materials, meshes, options.case_dir)
    requests = [p.request for p in planned if not p.failure]
    runs = iter(run_study(program, options.output / "runs", requests, options.quiet, options.jobs))
    outcomes = [Outcome(p.request, None, p.failure) if p.failure else next(runs) for p in planned]
    table = stress_study.stress_table(planned, outcomes, base.solvers)
    with together(options.output) as place:
        written = write_tables(place, [table], "stress.md", "Linear solvers under stress")
    if not options.quiet:
        show_tables([table], options.output, written)
    return exit_code(outcomes)


def exit_code(outcomes: List[Outcome]) -> int:
    return 0 if all(outcome.converged for outcome in outcomes) else 2


def read_systems(text: str) -> List[System]:
    systems = []
    for part in text.split(","):
        words = part.strip().split(":")
        if len(words) != 2 or not all(
            word.isascii() and word.isdigit() and len(word) < 10 and int(word) > 0 for word in words
        ):
            remedy = "give STEP:ITERATION, both from 1, separated by commas, e.g. 1:1,12:2"
            raise InputError("", "--systems", f"'{part.strip()}' is not a system", remedy)
        system = (int(words[0]), int(words[1]))
        if system in systems:
            raise InputError("", "--systems", f"{part.strip()} is given twice", "give each system once")
        systems.append(system)
    return sorted(systems)


def read_without(text: Optional[str]) -> Set[Tuple[str, str]]:
    found = set()
    for part in text.split(",") if text is not None else ():
        mesh, colon, method = part.strip().partition(":")
        if not colon:
            raise InputError("", "--without", f"'{part.strip()}' has no ':'", "give MESH:METHOD, e.g. fine:direct")
        pick("--without", mesh, list(MESHES))
        pick("--without", method, METHODS)
        found.add((mesh, method))
    return found


def read_settings(settings: List[str], stressed: bool) -> Tuple[str, ...]:
    seen: Dict[str, str] = {}
    for setting in settings:
        key, equals, _ = setting.partition("=")
        key = key.strip()
        if not equals or not key:
            raise InputError("", "--set", f"'{setting}' is not an entry", "write --set key=value, e.g. time.step=0.25")
        if key in STUDY_OWN:
            raise InputError("", "--set", f"{key} is chosen by --meshes", "leave it out")
        if stressed and key in stress_study.VARIED:
            raise InputError("", "--set", f"{key} is varied by --stress", "leave it out")
        if key in seen:
            raise InputError("", "--set", f"{key} is given twice", "give each key once")
        seen[key] = setting
    return tuple(seen.values())


def check_stress(options: argparse.Namespace, systems: List[System]) -> None:
    if systems != [(1, 1)]:
        raise InputError("", "--systems", "--stress is about the first system", "leave --systems out")
    for given, name in ((options.without, "--without"), (options.sub_problems, "--sub-problems")):
        if given:
            raise InputError("", name, "does not go with --stress", "leave it out")


def check_case(folder: Path, material: str) -> None:
    if not is_folder(folder):
        raise InputError(folder, "--case-dir", "no such folder", "give the folder with the case files")
    case = folder / f"{material}.toml"
    if not is_file(case):
        raise InputError(case, "--case-dir", "no such case file", "give a folder with a case file per material")


def check_writable(folder: Path) -> None:
    """Better now than after an hour of runs."""
    make_folder(folder / "runs")
    probe = folder / ".writable"
    try:
        with replacing(probe):
            pass
        os.unlink(probe)
    except InputError:
        raise InputError(folder, "--output", "cannot be written to", "name another folder") from None
