"""A program started by a script, and the processor seconds that it took."""

import os
import subprocess
from pathlib import Path
from typing import Optional, Sequence


class CallError(Exception):
    """A program that cannot be started or that ended with another exit code than 0; its message went to the standard error."""


def processor_seconds(words: Sequence[object], folder: Optional[Path] = None, told: Optional[Path] = None) -> float:
    """Of the whole program: on a machine that is busy with other work they are nearer to an idle machine's seconds.
    told: the file for its standard output, which otherwise is this script's. Raises CallError and OSError of that file.
    """
    command = [str(word) for word in words]
    output = open(told, "w", encoding="utf-8") if told else None
    try:
        process = subprocess.Popen(command, cwd=folder, stdout=output)
    except OSError as error:
        raise CallError(f"{command[0]}: {error.strerror}; name the folder of the programs, build/release/bin") from None
    finally:
        if output:
            output.close()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise CallError(f"{' '.join(command)}: exit code {process.returncode}; see its message above")
    return usage.ru_utime + usage.ru_stime
