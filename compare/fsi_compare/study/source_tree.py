"""Names of what the source tree alone has: the studies of this project, compare/research, which are not installed."""

from pathlib import Path

from ..base.errors import InputError

OF_ONE_NAME = ("accuracy-cost", "calibration", "coupling", "paper", "references", "scaling", "skip", "stability")
STUDIES = tuple(sorted((*OF_ONE_NAME, "peers", "space", "turek-hron")))
KINDS = tuple(sorted((*OF_ONE_NAME, "scenes")))
COMMANDS = ("solvers",)


def refusal(path: str | Path, key: str, what: str) -> InputError:
    problem = f"{what} belongs to this project's own research, which is not installed"
    remedy = "build in the source tree and call build/release/bin/fsi-compare there (compare/research)"
    return InputError(path, key, problem, remedy)
