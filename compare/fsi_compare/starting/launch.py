"""Programs started as several processes, by Open MPI's mpirun."""

import os
import shutil
from typing import Sequence

from ..base.errors import InputError


def usable_cores() -> int:
    """Cores that this process may use: fewer than the machine's in a container or a batch job."""
    return len(os.sched_getaffinity(0))


def launched(command: Sequence, processes: int) -> list[str]:
    """The command that starts `command` as so many processes; itself for one. Raises InputError where there is no
    mpirun."""
    words = [str(word) for word in command]
    if processes == 1:
        return words
    mpirun = shutil.which("mpirun")
    if mpirun is None:
        remedy = "install the Debian package openmpi-bin, or run on one process"
        raise InputError("mpirun", "", "is not on the path", remedy)
    # Placing is left to the system: a bound process cannot get out of the way of what else the machine does. Processes
    # that wait give way: on a busy machine a step on two took twenty times as long without.
    # --quiet ends mpirun of Open MPI 5 with an error; without_chatter() takes out what it would have kept back.
    options = ["-n", str(processes), "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1"]
    if os.geteuid() == 0:
        options.append("--allow-run-as-root")
    return [mpirun, *options, *words]


def without_chatter(said: str) -> str:
    """The output of programs without mpirun's own words, which stand between lines of dashes."""
    kept, inside = [], False
    for line in said.splitlines():
        if len(line) >= 40 and not line.strip("-"):
            inside = not inside
        elif not inside:
            kept.append(line)
    return "\n".join(kept)
