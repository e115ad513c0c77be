"""The kinds of study by name. A kind is a module with `check(study)`, which raises InputError before the first run when
the study lacks something, and `evaluate(context)`, which fills the report and returns the exit code, 0 where it returns
nothing. A kind that runs more than the study lists may have `also_runs(study)`, lines for --list, and
`also_standing(study, runner)`, how many of those are there."""

import importlib
from typing import Any, Tuple

from ..reporting.matplotlib_loader import load_matplotlib

MODULES = {
    "runs": "fsi_compare.study.plain_runs",
    "paper": "fsi_compare.studies.paper.study",
    "accuracy-cost": "fsi_compare.studies.accuracy.study",
    "stability": "fsi_compare.studies.stability.study",
    "skip": "fsi_compare.studies.skip.study",
    "coupling": "fsi_compare.studies.coupling.study",
    "scaling": "fsi_compare.studies.scaling.study",
    "calibration": "fsi_compare.studies.calibration.study",
    "references": "fsi_compare.studies.references.study",
    "scenes": "fsi_compare.studies.scenes",
}
NAMES: Tuple[str, ...] = tuple(MODULES)


def kind(name: str) -> Any:
    """Loaded on demand: the pictures' library takes a second."""
    load_matplotlib()
    return importlib.import_module(MODULES[name])
