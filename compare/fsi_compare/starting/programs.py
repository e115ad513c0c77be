"""The programs of the project: where they are, and which version."""

import argparse
import hashlib
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Iterable

from ..base.errors import InputError
from ..base.files import absolute, exists, find_beside, is_file, is_folder, read_bytes
from .processes import answer

BUILD = "build it with cmake --build --preset release, or name it with --program"
LEVELS = Path("..", "lib", "fsi-duo")  # from the folder of a package's programs: their builds, one folder a level
VERSION = re.compile(r"(?P<name>\S+) (?P<version>\S+)(?: \((?P<level>[\w.-]+)\))?")  # fsi-mesh 0.1.0 (x86-64-v3)


@dataclass(frozen=True)
class Program:
    path: Path
    version: str
    digest: str = ""  # SHA-256 of the executable: a program built anew may keep its version


def find_program(name: str, named: Path | None = None, option: str = "--program") -> Program:
    """The program `named`, else the one of this name beside fsi-compare, else the one on the path. It must answer."""
    path = named if named is not None else find_beside(Path(sys.argv[0]), name)
    if path is None:
        raise InputError(name, option, "is neither beside fsi-compare nor on the path", BUILD)
    if not exists(path):
        raise InputError(path, option, "no such program", BUILD)
    if is_folder(path) or not os.access(path, os.X_OK):
        raise InputError(path, option, "is not a program", BUILD)
    path = absolute(path)
    said = VERSION.fullmatch(answer_to(path, "--version").strip())
    if said is None or said["name"] != name:
        raise InputError(path, option, f"is not {name}", BUILD)
    executable = read_bytes(_executable(path, said["level"]), BUILD, BUILD)
    return Program(path, said["version"], hashlib.sha256(executable).hexdigest())


def find_drivers(options: argparse.Namespace, names: Iterable[str]) -> dict[str, Program]:
    """The drivers of these names, each beside fsi-compare or where its option says. Raises InputError."""
    short = {name: name.removeprefix("fsi-") for name in names}
    return {name: find_program(name, getattr(options, option), f"--{option}") for name, option in short.items()}


def _executable(path: Path, level: str | None) -> Path:
    """The executable behind `path`: in a package with builds for several x86-64 levels, that of the level it reports
    (packages/start_level.c)."""
    own = Path(os.path.realpath(path))
    build = own.parent / LEVELS / level / own.name if level else own
    return build if is_file(build) else path


def find_mesh_maker(monolithic: Program) -> Path | None:
    return find_beside(monolithic.path, "fsi-mesh")


def need_mesh_maker(driver: Program) -> Path:
    """Raises InputError where it is not there."""
    found = find_mesh_maker(driver)
    if found is None:
        raise no_mesh_maker()
    return found


def no_mesh_maker() -> InputError:
    return InputError("fsi-mesh", "", "is not beside the drivers", "build it with cmake --build --preset release")


def answer_to(path: Path, option: str) -> str:
    """A program's output for an option. Raises InputError where it cannot be started."""
    try:
        return answer([path, option], time_limit=60)
    except (OSError, ValueError, subprocess.SubprocessError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(path, "--program", f"cannot be started: {reason}", BUILD) from None
