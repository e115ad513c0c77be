"""fsi-compare of a build in the source tree: fsi_compare with the studies and commands of this project."""

import functools
import sys
from typing import NoReturn, Sequence

from fsi_compare import start


def program(version: str = "unknown") -> NoReturn:
    """The whole of the program."""
    sys.exit(main(sys.argv[1:], version, to_the_end=True))


def main(arguments: Sequence[str], version: str = "unknown", to_the_end: bool = False) -> int:
    """As fsi_compare.start.main."""
    return start.main(arguments, version, to_the_end, _load)


def _load() -> start.Run:
    from fsi_compare import cli

    from .studies import CATALOGUE

    return functools.partial(cli.run, catalogue=CATALOGUE, more={"solvers": "fsi_research.linear.command"})
