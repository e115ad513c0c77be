"""Options that several commands have, each said once."""

import argparse
from pathlib import Path
from typing import Any, Callable, TypeAlias

from .errors import PROGRAM, InputError
from .files import folder

Commands: TypeAlias = "argparse._SubParsersAction[Any]"  # of the program's parser


def positive(option: str) -> Callable[[str], int]:
    """The type of an option that takes 1 or more. Raises InputError for less."""

    def count(text: str) -> int:
        value = int(text)
        if value < 1:
            raise InputError("", option, f"{value} is not positive", "give 1 or more")
        return value

    count.__name__ = "int"  # which argparse names for what is no number
    return count


def add_command(
    commands: Commands,
    name: str,
    run: Callable[[argparse.Namespace], int],
    help: str,
    description: str,
    examples: str | None = None,
) -> argparse.ArgumentParser:
    """`run` returns the exit code. Description and examples are printed as they stand."""
    made: argparse.ArgumentParser = commands.add_parser(
        name,
        allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        help=help,
        description=description,
        epilog=examples,
    )
    made.set_defaults(run=run)
    return made


def add_folders(command: argparse.ArgumentParser) -> None:
    command.add_argument("folders", nargs="+", metavar="DIR", type=Path, help="result folder of a finished run")


def add_output(command: argparse.ArgumentParser, default: str) -> None:
    text = "folder for the files written (default: %(default)s)"
    command.add_argument("-o", "--output", metavar="OUTDIR", type=folder, default=Path(default), help=text)


def add_times(command: argparse.ArgumentParser, default: str) -> None:
    text = "times in ms; linear between time steps (default: %(default)s)"
    command.add_argument("--times", metavar="T,T,...", default=default, help=text)


def add_usual(command: argparse.ArgumentParser, version: str, threads: str) -> None:
    """Adds the options that all commands end with; `threads` says what the number is of."""
    command.add_argument("--threads", metavar="N", type=positive("--threads"), help=threads)
    command.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")
    command.add_argument("--version", action="version", version=f"{PROGRAM} {version}")


def add_drivers(command: argparse.ArgumentParser) -> None:
    for name in ("monolithic", "partitioned"):
        text = f"fsi-{name} (default: beside this program)"
        command.add_argument(f"--{name}", metavar="PATH", type=Path, help=text)
