"""The command line of fsi-compare."""

import argparse
from typing import NoReturn, Sequence

from .base.errors import InputError
from .gallery.command import add_parser as add_gallery, gallery
from .linear.command import add_parser as add_solvers, solvers
from .mesh_import.command import add_parser as add_convert_mesh, convert_mesh
from .reporting.cost import add_parser as add_cost, cost
from .reporting.export import add_parser as add_export, export
from .reporting.pressure import add_parser as add_pressure, pressure
from .reporting.run_report import add_parser as add_report, report
from .studies.accuracy_of_runs import accuracy, add_parser as add_accuracy
from .studies.command import add_parser as add_study, study


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
    add_pressure(commands, version)
    add_report(commands, version)
    add_cost(commands, version)
    add_export(commands, version)
    add_accuracy(commands, version)
    add_solvers(commands, "results/solvers", version)
    add_study(commands, version)
    add_gallery(commands, version)
    add_convert_mesh(commands, version)
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
    command = {
        "pressure": pressure,
        "report": report,
        "cost": cost,
        "export": export,
        "accuracy": accuracy,
        "solvers": solvers,
        "study": study,
        "gallery": gallery,
        "convert-mesh": convert_mesh,
    }
    return command[options.command](options)
