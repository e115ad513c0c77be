"""The kinds of study by name. A kind is a module with `check(study)`, which raises InputError before the first run when
the study lacks something, and `evaluate(context)`, which fills the report and returns the exit code, 0 where it returns
nothing. A kind that runs more than the study lists may have `also_runs(study)`, lines for --list, and
`also_standing(study, runner)`, how many of those are there."""

import importlib
from typing import Any, Tuple

from ..reporting.matplotlib_loader import load_matplotlib

MODULES = {
    "paper": "paper.study",
    "accuracy-cost": "accuracy.study",
    "stability": "stability.study",
    "skip": "skip.study",
    "coupling": "coupling.study",
    "scaling": "scaling.study",
    "calibration": "calibration.study",
    "references": "references.study",
    "scenes": "scenes",
    "runs": "plain_runs",
}
NAMES: Tuple[str, ...] = tuple(MODULES)


def kind(name: str) -> Any:
    """Loaded on demand: the pictures' library takes a second."""
    load_matplotlib()
    return importlib.import_module(f".{MODULES[name]}", __package__)
