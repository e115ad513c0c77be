"""The kinds of study of this project, and its ready studies, with those of fsi_compare."""

from pathlib import Path

from fsi_compare.study.catalogue import OWN, Catalogue

FOLDER = Path(__file__).resolve().parents[1] / "studies"
KINDS = {
    "paper": "fsi_research.paper.study",
    "accuracy-cost": "fsi_research.accuracy.study",
    "stability": "fsi_research.stability.study",
    "skip": "fsi_research.skip.study",
    "coupling": "fsi_research.coupling.study",
    "scaling": "fsi_research.scaling.study",
    "calibration": "fsi_research.calibration.study",
    "references": "fsi_research.references.study",
    "scenes": "fsi_research.scenes.study",
}
CATALOGUE = Catalogue({**OWN.modules, **KINDS}, (*OWN.folders, FOLDER))
