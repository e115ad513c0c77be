"""The command line of fsi-compare."""

import argparse
import os
import sys
from typing import NoReturn, Sequence

from .base.errors import InputError
from .linear.command import add_parser as add_solvers, solvers
from .reporting.cost import add_parser as add_cost, cost
from .reporting.pressure import add_parser as add_pressure, pressure
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
    add_cost(commands, version)
    add_accuracy(commands, version)
    add_solvers(commands, "results/solvers", version)
    add_study(commands, version)
    return top


def main(arguments: Sequence[str], version: str = "unknown") -> int:
    """Exit code: 0 done, 1 wrong use or bad input, 2 done but something did not converge."""
    code = 0
    try:
        top = parser(version)
        options = top.parse_args(list(arguments))
        if options.command is None:
            top.error("no command")
        run = {"pressure": pressure, "cost": cost, "accuracy": accuracy, "solvers": solvers, "study": study}
        code = run[options.command](options)
        sys.stdout.flush()
    except InputError as error:
        print(f"fsi-compare: error: {error}", file=sys.stderr)
        return 1
    except BrokenPipeError:
        # The reader, e.g. `head`, has seen enough; nothing may be flushed into the closed pipe at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except KeyboardInterrupt:
        print("fsi-compare: interrupted", file=sys.stderr)
        return 130
    return code
