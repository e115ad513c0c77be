"""From the first moment to the exit code: streams, signals, and one line for whatever went wrong."""

import os
import sys
import traceback
from typing import Callable, NoReturn, Sequence, TypeAlias

from .base import interruption
from .base.errors import PROBLEM_LIMIT, PROGRAM, InputError, loaded, say_error, shortened
from .base.streams import ReaderLeft, guarded

Run: TypeAlias = Callable[[Sequence[str], str], int]  # the command line: arguments and version to exit code

TRACEBACK = "FSI_COMPARE_TRACEBACK"  # set in the environment: where an unexpected exception comes from is shown


def program(version: str = "unknown") -> NoReturn:
    """The whole of the program."""
    sys.exit(main(sys.argv[1:], version, to_the_end=True))


def main(
    arguments: Sequence[str], version: str = "unknown", to_the_end: bool = False, load: Callable[[], Run] | None = None
) -> int:
    """Exit code: 0 done, 1 wrong use or bad input, 2 done but something did not converge; 128 + n ended by signal n.
    `load`: imports the command line, which takes a while; None: that of cli.py."""
    with interruption.watched(to_the_end), guarded():
        return _guarded_main(arguments, version, load or _own)


def _guarded_main(arguments: Sequence[str], version: str, load: Callable[[], Run]) -> int:
    try:
        if not _has_working_folder():
            raise InputError(".", "", "the working folder has been removed", "change to another one")
        run = loaded(load)  # takes a while: signals are watched by now
        interruption.check()
        code = run(arguments, version)
        sys.stdout.flush()
        return code
    except InputError as error:
        say_error(str(error))
        return 1
    except interruption.Interrupted as signal:
        goes_on = arguments[:1] in (["study"], ["solvers"], ["verify"], ["tune"])
        kept = "; finished runs are kept, the same command goes on" if goes_on else ""
        print(f"{PROGRAM}: interrupted by {signal}{kept}", file=sys.stderr)
        return signal.code
    except MemoryError:
        less = LESS.get(arguments[0] if arguments else "", "compare fewer or smaller runs")
        say_error(f"out of memory; {less}, or take a larger machine")
        return 1
    except ReaderLeft:
        return 0  # the reader, e.g. `head`, has seen enough
    except ImportError as error:
        say_error(str(InputError(error.name or "Python", "", f"cannot be loaded: {error}", "install it again")))
        return 1
    except Exception as error:
        # Nothing ought to come here: the harness tests/faults/study counts it as wrong.
        if os.environ.get(TRACEBACK):
            traceback.print_exc()
        text = shortened(f"{type(error).__name__}: {' '.join(str(error).split())}", PROBLEM_LIMIT)
        say_error(f"unexpected: {text}; {TRACEBACK}=1 shows where")
        return 1


def _own() -> Run:
    from .cli import run

    return run


LESS = {  # advice for a command that ran out of memory: what to give it less of; others compare runs
    "report": "give fewer runs, or fewer times by --frames",
    "picture": "take a run with fewer nodes",
    "watch": "leave --page out",
    "export": "give fewer --fields",
    "convert-mesh": "give a mesh with fewer cells",
    "convert-case": "give a case with fewer cells",
    "study": "leave the largest runs out of the study file; finished ones are kept",
    "solvers": "give fewer or smaller levels; finished runs are kept",
    "gallery": "name fewer scenes, or give --quick",
    "verify": "give --coarser, sample fewer points, or take a coarser case; finished runs are kept",
    "tune": "take a coarser case; finished runs are kept",
}


def _has_working_folder() -> bool:
    try:
        return bool(os.getcwd())
    except OSError:
        return False
