"""One finished run as its result folder states it.

The folder is checked before anything is computed from it: a run that was interrupted leaves a folder that looks almost
complete, and a comparison with it would be wrong without a sign.
"""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base.errors import InputError, printable
from ..base.files import exists, is_file, is_folder, read_text
from .columns import LARGEST, number
from .pressure_waves import PressureWaves
from .samples import CENTRE_LINE, LINES, requested_line, waves_along
from .summary import FILE, FINISHED, PROGRAMS, read_summary

PRESSURE_COLUMNS = ("time_ms", "z_mm", "pressure_Pa")


@dataclass(frozen=True)
class Run:
    """A finished run and its pressure along the centre line."""

    folder: Path
    program: str  # "fsi-monolithic" or "fsi-partitioned"
    version: str
    title: str
    summary: dict  # all of summary.json
    pressure: PressureWaves

    @property
    def short_program(self) -> str:
        return PROGRAMS[self.program]


def read_finished(folder: Path) -> dict:
    """`summary.json` of a folder that must be a finished run's. Raises InputError."""
    if not is_folder(folder):
        problem = "is not a folder" if exists(folder) else "no such folder"
        raise InputError(folder, "", problem, "give the folder that a run wrote with -o")
    return read_summary(folder / FILE)


def read_run(folder: Path) -> Run:
    """Reads `summary.json` and `centerline_pressure.csv`, or of a bent tube its centre line in `lines.csv`, arc length
    in place of z. Raises InputError naming file, key and problem unless the run is finished and both files are
    complete."""
    summary = read_finished(folder)
    along_axis = folder / "centerline_pressure.csv"
    found = is_file(folder / LINES) and not exists(along_axis)
    return Run(
        folder=folder,
        program=summary["program"],
        version=printable(summary.get("version", "")),
        title=printable(summary.get("title", "")),
        summary=summary,
        pressure=waves_along(folder / LINES, CENTRE_LINE) if found else read_pressure(along_axis),
    )


def has_pressure(folder: Path) -> bool:
    """Whether there is a line to read the pressure along. Raises InputError."""
    lines = folder / LINES
    return is_file(folder / "centerline_pressure.csv") or (is_file(lines) and requested_line(lines) is not None)


def read_pressure_line(folder: Path) -> PressureWaves:
    """The pressure along the centre line; of a vessel without one along the line of `lines.csv` that stands for it
    (runs/samples.py), its arc length in place of z. Raises InputError."""
    along_axis, lines = folder / "centerline_pressure.csv", folder / LINES
    if exists(along_axis) or not is_file(lines):
        return read_pressure(along_axis)
    name = requested_line(lines)
    return waves_along(lines, CENTRE_LINE if name is None else name)


def read_pressure(path: Path) -> PressureWaves:
    """`centerline_pressure.csv`: one block of lines per time level, the same points in each."""
    text = read_text(path, FINISHED, "run it again")
    if not text.strip():
        raise InputError(path, "", "is empty", "the run wrote no time step; run it again")
    lines = text.splitlines()
    header = [name.strip() for name in lines[0].split(",")]
    for name in PRESSURE_COLUMNS:
        if name not in header:
            raise InputError(
                path, "line 1", f"column '{name}' is missing", f"the first line must read {','.join(PRESSURE_COLUMNS)}"
            )
    if not text.endswith("\n"):
        raise InputError(
            path, f"line {len(lines)}", "is cut off", "the run was interrupted while writing; run it again"
        )
    if len(lines) == 1:
        raise InputError(path, "", "holds no time level", "the run wrote no time step; run it again")

    columns = [header.index(name) for name in PRESSURE_COLUMNS]
    values = np.empty((len(lines) - 1, 3))
    for row, line in enumerate(lines[1:]):
        fields = line.split(",")
        if len(fields) != len(header):
            raise InputError(
                path,
                f"line {row + 2}",
                f"has {len(fields)} values instead of {len(header)}",
                "the run was interrupted while writing; run it again",
            )
        for i, column in enumerate(columns):
            try:
                values[row, i] = number(fields[column])
            except ValueError:
                raise InputError(
                    path, f"line {row + 2}", f"{PRESSURE_COLUMNS[i]} '{fields[column]}' is not a number", "run it again"
                ) from None
            if abs(values[row, i]) > LARGEST and math.isfinite(values[row, i]):
                raise InputError(
                    path, f"line {row + 2}", f"{PRESSURE_COLUMNS[i]} {fields[column]} is too large", "run it again"
                )
            if not math.isfinite(values[row, i]):
                raise InputError(
                    path,
                    f"line {row + 2}",
                    f"{PRESSURE_COLUMNS[i]} is {fields[column].strip()}",
                    "the run went wrong before this time; look at its run.log",
                )
    return _levels(path, *values.T)


def _levels(path: Path, time: np.ndarray, z: np.ndarray, pressure: np.ndarray) -> PressureWaves:
    """The lines cut into time levels, each checked against the first one."""
    starts = np.array([0, *(np.flatnonzero(np.diff(time)) + 1), len(time)])
    points = int(starts[1])
    if points < 2:
        raise InputError(path, "line 2", "the first time level has a single point", "two or more are needed")
    if np.any(np.diff(z[:points]) <= 0):
        line = int(np.flatnonzero(np.diff(z[:points]) <= 0)[0]) + 3
        raise InputError(path, f"line {line}", "z_mm does not increase", "points must be ordered along the centre line")
    for start, stop in zip(starts[1:-1], starts[2:]):
        if time[start] < time[start - 1]:
            raise InputError(
                path,
                f"line {start + 2}",
                f"time_ms goes back from {time[start - 1]:g} to {time[start]:g}",
                "time levels must be ordered; run it again",
            )
        if stop - start != points:
            raise InputError(
                path,
                f"time_ms {time[start]:g}",
                f"has {stop - start} of {points} points",
                "the run was interrupted while writing; run it again",
            )
        if np.any(z[start:stop] != z[:points]):
            line = int(start + np.flatnonzero(z[start:stop] != z[:points])[0]) + 2
            raise InputError(
                path,
                f"line {line}",
                "z_mm differs from the first time level's",
                "all time levels must hold the same points; run it again",
            )
    return PressureWaves(times=time[starts[:-1]], z=z[:points], pressure=pressure.reshape(-1, points))
