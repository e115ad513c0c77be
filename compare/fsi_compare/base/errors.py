"""Mistakes in what the user handed over."""

from pathlib import Path
from typing import Union


class InputError(Exception):
    """A mistake in a result folder or on the command line; the program prints it in one line and exits with 1.

    The message reads `FILE: KEY: PROBLEM; REMEDY`; empty parts are left out.
    """

    def __init__(self, file: Union[str, Path], key: str, problem: str, remedy: str = "") -> None:
        text = ": ".join(part for part in (str(file), key, problem) if part)
        super().__init__(" ".join((f"{text}; {remedy}" if remedy else text).split()))
