"""One finished run as its result folder states it.

The folder is checked before anything is computed from it: a run that was interrupted leaves a folder that looks almost
complete, and a comparison with it would be wrong without a sign.
"""

from dataclasses import dataclass
from pathlib import Path

from ..base.errors import InputError, printable
from ..base.files import exists, is_file, is_folder
from .levels import read_levels
from .pressure_waves import PressureWaves
from .samples import CENTRE_LINE, LINES, waves_along
from .summary import FILE, read_summary

ALONG_AXIS = "centerline_pressure.csv"


@dataclass(frozen=True)
class Run:
    """A finished run and its pressure along the centre line."""

    folder: Path
    program: str  # "fsi-monolithic" or "fsi-partitioned"
    version: str
    title: str
    summary: dict  # all of summary.json
    pressure: PressureWaves


def require_folder(folder: Path) -> None:
    if not is_folder(folder):
        problem = "is not a folder" if exists(folder) else "no such folder"
        raise InputError(folder, "", problem, "give the folder that a run wrote with -o")


def read_finished(folder: Path) -> dict:
    """`summary.json` of a folder that must be a finished run's. Raises InputError."""
    require_folder(folder)
    return read_summary(folder / FILE)


def read_run(folder: Path) -> Run:
    """Reads `summary.json` and `centerline_pressure.csv`, or of a bent tube its centre line in `lines.csv`, arc length
    in place of z. Raises InputError naming file, key and problem unless the run is finished and both files are
    complete."""
    summary, file = read_finished(folder), pressure_file(folder)
    return Run(
        folder=folder,
        program=summary["program"],
        version=printable(summary.get("version", "")),
        title=printable(summary.get("title", "")),
        summary=summary,
        pressure=read_pressure(file) if file.name == ALONG_AXIS else waves_along(file, CENTRE_LINE),
    )


def pressure_file(folder: Path) -> Path:
    """The table with the pressure along the centre line; where there is none, that which ought to be there."""
    found = is_file(folder / LINES) and not exists(folder / ALONG_AXIS)
    return folder / (LINES if found else ALONG_AXIS)


def read_pressure(path: Path) -> PressureWaves:
    """`centerline_pressure.csv`. Raises InputError."""
    return PressureWaves(*read_levels(path, "pressure_Pa"))
