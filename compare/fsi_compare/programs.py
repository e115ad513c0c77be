"""The programs of the project as processes: where they are, which version, and what they say when they fail."""

import os
import shutil
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Optional, Sequence

from .errors import InputError

BUILD = "build it with cmake --build --preset release, or name it with --program"


@dataclass(frozen=True)
class Program:
    path: Path
    version: str


@dataclass(frozen=True)
class Ended:
    code: int
    message: str  # the last line of the error output, or what else is known about a bad end


def find_monolithic(named: Optional[Path]) -> Program:
    """The program named, else the one beside fsi-compare, else the one on the path. It must answer, and know how to
    solve single systems."""
    program = find_program("fsi-monolithic", named)
    if "--linear-systems" not in _answer(program.path, "--help"):
        raise InputError(program.path, "--program", f"version {program.version} does not know --linear-systems",
                         "take the program built from the same sources as fsi-compare")
    return program


def find_program(name: str, named: Optional[Path] = None, option: str = "--program") -> Program:
    """The program `named`, else the one of this name beside fsi-compare, else the one on the path. It must answer."""
    path = named if named is not None else _beside(Path(sys.argv[0]), name)
    if path is None:
        raise InputError(name, option, "is neither beside fsi-compare nor on the path", BUILD)
    if not path.exists():
        raise InputError(path, option, "no such program", BUILD)
    if path.is_dir() or not os.access(path, os.X_OK):
        raise InputError(path, option, "is not a program", BUILD)
    path = path.resolve()
    words = _answer(path, "--version").split()
    if len(words) != 2 or words[0] != name:
        raise InputError(path, option, f"is not {name}", BUILD)
    return Program(path, words[1])


def find_mesh_maker(monolithic: Program) -> Optional[Path]:
    return _beside(monolithic.path, "fsi-mesh")


def _beside(program: Path, name: str) -> Optional[Path]:
    for folder in (program.parent, program.resolve().parent):
        if (folder / name).is_file():
            return folder / name
    found = shutil.which(name)
    return Path(found) if found else None


def _answer(path: Path, option: str) -> str:
    try:
        return subprocess.run([str(path), option], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              errors="replace", timeout=60).stdout
    except (OSError, subprocess.TimeoutExpired) as error:
        reason = error.strerror if isinstance(error, OSError) else "no answer in 60 s"
        raise InputError(path, "--program", f"cannot be started: {reason}", BUILD) from None


def execute(command: Sequence, tick: Callable[[], None] = lambda: None) -> Ended:
    """Runs a program to its end, calling `tick` every second. It does not outlive fsi-compare when that is interrupted
    or asked to end."""
    def stop(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, stop)
    try:
        return _execute(command, tick)
    finally:
        signal.signal(signal.SIGTERM, before)


def _execute(command: Sequence, tick: Callable[[], None]) -> Ended:
    try:
        process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True, errors="replace")
    except OSError as error:
        return Ended(1, f"{command[0]} cannot be started: {error.strerror}")
    try:
        while True:
            try:
                _, said = process.communicate(timeout=1)
                break
            except subprocess.TimeoutExpired:
                tick()
    finally:
        if process.poll() is None:
            process.terminate()
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
    return Ended(process.returncode, message_of(process.returncode, said))


def message_of(code: int, said: str) -> str:
    lines = [line.strip() for line in said.splitlines() if line.strip()]
    if code < 0:
        try:
            name = signal.Signals(-code).name
        except ValueError:
            name = str(-code)
        return f"ended by signal {name}" + (", perhaps for want of memory" if name == "SIGKILL" else "")
    if not lines:
        return f"ended with code {code} without a message" if code else ""
    head, mark, rest = lines[-1].partition(": error: ")
    return rest if mark and " " not in head else lines[-1]
