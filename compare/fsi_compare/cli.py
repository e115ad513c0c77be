"""The command line of fsi-compare. A command is imported when it is called, since all of them take longer than most run."""

import argparse
from functools import partial
from importlib import import_module
from typing import Mapping, NoReturn, Sequence

from .base import interruption
from .base.errors import InputError, loaded
from .study import source_tree
from .study.catalogue import OWN, Catalogue

# The module of each, which has a function add_parser.
OF_RESULTS = {
    "pressure": "fsi_compare.reporting.pressure",
    "report": "fsi_compare.reporting.run_report",
    "picture": "fsi_compare.reporting.picture_command",
    "watch": "fsi_compare.reporting.watch",
    "cost": "fsi_compare.reporting.cost",
    "export": "fsi_compare.reporting.export",
    "accuracy": "fsi_compare.reporting.accuracy",
}
OF_RUNS = {
    "study": "fsi_compare.study.command",
    "gallery": "fsi_compare.gallery.command",
    "verify": "fsi_compare.verify.command",
    "tune": "fsi_compare.tune.command",
}
OF_IMPORT = {"convert-mesh": "fsi_compare.mesh_import.command", "convert-case": "fsi_compare.peer_cases.command"}


class _Parser(argparse.ArgumentParser):
    """Wrong use is reported in one line with exit code 1, as by the other programs."""

    def error(self, message: str) -> NoReturn:
        raise InputError("", "", message, f"see {self.prog} --help")


def parser(version: str, modules: Mapping[str, str], catalogue: Catalogue = OWN) -> argparse.ArgumentParser:
    """Of commands by name and module."""
    about = "Compares finished runs, and makes runs to judge a case by: studies, error bars, tuned openings."
    top = _Parser(prog="fsi-compare", description=about, allow_abbrev=False)
    top.add_argument("--version", action="version", version=f"fsi-compare {version}")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)
    for name, module in modules.items():
        catalogues = (catalogue,) if name == "study" else ()
        loaded(partial(import_module, module)).add_parser(commands, version, *catalogues)
    return top


def run(arguments: Sequence[str], version: str, catalogue: Catalogue = OWN, more: Mapping[str, str] = {}) -> int:
    """The exit code. `more`: commands that the source tree adds. Raises InputError for wrong use and bad input."""
    called = arguments[0] if arguments else ""
    if not more and called in source_tree.COMMANDS:
        raise source_tree.refusal("", "", f"the command {called}")
    modules = {**OF_RESULTS, **more, **OF_RUNS, **OF_IMPORT}
    if called in modules or called == "--version":
        modules = {name: module for name, module in modules.items() if name == called}
    top = parser(version, modules, catalogue)
    try:
        options = top.parse_args(list(arguments))
    except SystemExit as end:  # of --help and --version
        return int(end.code or 0)
    if options.command is None:
        top.error("no command")
    interruption.check()  # imports take a while
    return int(options.run(options))
