"""The command line of fsi-compare."""

import argparse
from typing import Any, NoReturn, Sequence

from .base.errors import InputError
from .mesh_import import command as mesh_import
from .mesh_import import surface_command
from .peer_cases import command as peer_cases
from .reporting import accuracy, cost, export, picture_command, pressure, run_report, watch
from .study import command as study, source_tree
from .study.catalogue import OWN, Catalogue
from .gallery import command as gallery
from .tune import command as tune
from .verify import command as verify

OF_RESULTS = (pressure, run_report, picture_command, watch, cost, export, accuracy)
OF_RUNS = (gallery, verify, tune)
OF_IMPORT = (mesh_import, surface_command, peer_cases)


class _Parser(argparse.ArgumentParser):
    """Wrong use is reported in one line with exit code 1, as by the other programs."""

    def error(self, message: str) -> NoReturn:
        raise InputError("", "", message, f"see {self.prog} --help")


def parser(version: str, catalogue: Catalogue = OWN, more: Sequence[Any] = ()) -> argparse.ArgumentParser:
    """`more`: commands that the source tree adds."""
    about = "Compares finished runs, and makes runs to judge a case by: studies, error bars, tuned openings."
    top = _Parser(prog="fsi-compare", description=about, allow_abbrev=False)
    top.add_argument("--version", action="version", version=f"fsi-compare {version}")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)
    for command in (*OF_RESULTS, *more):
        command.add_parser(commands, version)
    study.add_parser(commands, version, catalogue)
    for command in (*OF_RUNS, *OF_IMPORT):
        command.add_parser(commands, version)
    return top


def run(arguments: Sequence[str], version: str, catalogue: Catalogue = OWN, more: Sequence[Any] = ()) -> int:
    """The exit code. Raises InputError for wrong use and bad input."""
    if not more and arguments and arguments[0] in source_tree.COMMANDS:
        raise source_tree.refusal("", "", f"the command {arguments[0]}")
    top = parser(version, catalogue, more)
    try:
        options = top.parse_args(list(arguments))
    except SystemExit as end:  # of --help and --version
        return int(end.code or 0)
    if options.command is None:
        top.error("no command")
    return int(options.run(options))
