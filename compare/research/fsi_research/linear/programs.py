"""fsi-monolithic as a solver of single Newton systems."""

from pathlib import Path
from typing import Optional

from fsi_compare.base.errors import InputError
from fsi_compare.starting.programs import Program, answer_to, find_program


def find_monolithic(named: Optional[Path]) -> Program:
    """The program named, else the one beside fsi-compare, else the one on the path. It must answer, and know how to
    solve single systems."""
    program = find_program("fsi-monolithic", named)
    require_linear_systems(program)
    return program


def require_linear_systems(program: Program) -> None:
    """Raises InputError unless fsi-monolithic knows how to solve single systems."""
    if "--linear-systems" not in answer_to(program.path, "--help"):
        remedy = "take the program built from the same sources as fsi-compare"
        raise InputError(program.path, "--program", f"version {program.version} does not know --linear-systems", remedy)


def has_petsc(program: Program) -> bool:
    """Whether fsi-monolithic was built with PETSc: it says where not."""
    return "petsc is not in this build" not in answer_to(program.path, "--help")
