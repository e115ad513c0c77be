"""Options that several commands have, each said once."""

import argparse
from pathlib import Path
from typing import Any, Callable, TypeAlias

from .errors import PROGRAM, InputError
from .files import folder
from .numbers import parsed

Commands: TypeAlias = "argparse._SubParsersAction[Any]"  # of the program's parser
DRIVERS = ("monolithic", "partitioned")
Run: TypeAlias = Callable[[argparse.Namespace], int]  # a command, which returns the exit code


def positive(option: str) -> Callable[[str], int]:
    """The type of an option that takes 1 or more. Raises InputError for less."""

    def count(text: str) -> int:
        value = int(text)
        if value < 1:
            raise InputError("", option, f"{value} is not positive", "give 1 or more")
        return value

    count.__name__ = "int"  # which argparse names for what is no number
    return count


def positive_number(option: str, what: str, remedy: str) -> Callable[[str], float]:
    """The type of an option that takes a number above 0. Raises InputError for another one, which is no `what`."""

    def number(text: str) -> float:
        value = float(text)
        if not 0 < value < float("inf"):
            raise InputError("", option, f"{value:g} {what}", remedy)
        return value

    number.__name__ = "float"
    return number


def share(option: str) -> Callable[[str], float]:
    """The type of an option that takes a part of a value: 0.02 for 2% and for 0.02. Raises InputError for another."""

    def part(text: str) -> float:
        value = parsed(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
        if not 0 < value < 1:
            raise InputError("", option, f"{text} is no part of a value", "give a percentage, like 1%")
        return value

    return part


def add_command(
    commands: Commands, name: str, run: Run, help: str, description: str, examples: str | None = None
) -> argparse.ArgumentParser:
    """Description and examples are printed as they stand."""
    form = argparse.RawDescriptionHelpFormatter
    made: argparse.ArgumentParser = commands.add_parser(
        name, allow_abbrev=False, formatter_class=form, help=help, description=description, epilog=examples
    )
    made.set_defaults(run=run)
    return made


def add_folders(command: argparse.ArgumentParser) -> None:
    command.add_argument("folders", nargs="+", metavar="DIR", type=Path, help="result folder of a finished run")


def add_output(command: argparse.ArgumentParser, default: str) -> None:
    text = "folder for the files written (default: %(default)s)"
    command.add_argument("-o", "--output", metavar="OUTDIR", type=folder, default=Path(default), help=text)


def add_case(command: argparse.ArgumentParser, name: str) -> None:
    """A case, and the folder for what the command `name` makes of it."""
    command.add_argument("case", metavar="CASE.toml", type=Path, help="case file")
    command.add_argument("-o", "--output", metavar="OUTDIR", type=folder, help=f"default: results/{name}/CASE")


def add_time_limit(command: argparse.ArgumentParser, of: str) -> None:
    limit = positive_number("--time-limit", "s is no time", "give a positive number of seconds")
    text = f"of each {of} (default: %(default)s)"
    command.add_argument("--time-limit", metavar="S", type=limit, default=3600.0, help=text)


def add_labels(command: argparse.ArgumentParser, default: str = "their folders") -> None:
    command.add_argument("--labels", metavar="A,B,...", help=f"names of the runs (default: {default})")


def add_title(command: argparse.ArgumentParser, default: str) -> None:
    command.add_argument("--title", default=default, help="heading of the table (default: %(default)s)")


def add_count(command: argparse.ArgumentParser, option: str, text: str, default: int | None = None) -> None:
    """An option that takes 1 or more."""
    command.add_argument(option, metavar="N", type=positive(option), default=default, help=text)


def add_times(command: argparse.ArgumentParser, default: str) -> None:
    text = "times in ms; linear between time steps (default: %(default)s)"
    command.add_argument("--times", metavar="T,T,...", default=default, help=text)


def add_usual(command: argparse.ArgumentParser, version: str, threads: str) -> None:
    """Adds the options that all commands end with; `threads` says what the number is of."""
    add_count(command, "--threads", threads)
    command.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")
    command.add_argument("--version", action="version", version=f"{PROGRAM} {version}")


def add_drivers(command: argparse.ArgumentParser) -> None:
    for name in DRIVERS:
        command.add_argument(f"--{name}", metavar="PATH", type=Path, help=f"fsi-{name} (default: beside this program)")
