"""The command line of fsi-compare."""

import argparse
from typing import NoReturn, Sequence

from .base.errors import InputError
from .mesh_import import command as mesh_import
from .mesh_import import surface_command
from .peer_cases import command as peer_cases
from .reporting import accuracy, cost, export, picture_command, pressure, run_report, watch
from .study import command as study
from .gallery import command as gallery
from .studies.linear import command as linear
from .tune import command as tune
from .verify import command as verify

COMMANDS = (
    pressure,
    run_report,
    picture_command,
    watch,
    cost,
    export,
    accuracy,
    linear,
    study,
    gallery,
    verify,
    tune,
    mesh_import,
    surface_command,
    peer_cases,
)


class _Parser(argparse.ArgumentParser):
    """Wrong use is reported in one line with exit code 1, as by the other programs."""

    def error(self, message: str) -> NoReturn:
        raise InputError("", "", message, f"see {self.prog} --help")


def parser(version: str) -> argparse.ArgumentParser:
    top = _Parser(
        prog="fsi-compare",
        description="Compares finished runs and the linear solvers, and drives whole studies.",
        allow_abbrev=False,
    )
    top.add_argument("--version", action="version", version=f"fsi-compare {version}")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)
    for command in COMMANDS:
        command.add_parser(commands, version)
    return top


def run(arguments: Sequence[str], version: str) -> int:
    """The exit code. Raises InputError for wrong use and bad input."""
    top = parser(version)
    try:
        options = top.parse_args(list(arguments))
    except SystemExit as end:  # of --help and --version
        return int(end.code or 0)
    if options.command is None:
        top.error("no command")
    return int(options.run(options))
