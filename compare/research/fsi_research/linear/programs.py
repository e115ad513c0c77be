"""fsi-linear-study, which solves single Newton systems."""

from pathlib import Path
from typing import Optional

from fsi_compare.base.files import find_beside
from fsi_compare.starting.programs import Program, answer_to, find_program

NAME = "fsi-linear-study"


def find_linear_study(named: Optional[Path]) -> Program:
    """The program named, else the one beside fsi-compare, else the one on the path. It must answer."""
    return find_program(NAME, named)


def linear_study_beside(monolithic: Program) -> Program:
    """The one beside fsi-monolithic, else the one on the path. It must answer."""
    return find_program(NAME, find_beside(monolithic.path, NAME))


def has_petsc(program: Program) -> bool:
    """Whether the program was built with PETSc: it says where not."""
    return "petsc is not in this build" not in answer_to(program.path, "--help")
