"""The runs of the paper's study by what they are for."""

from typing import List, Optional, Sequence

from ..catalogue.names import MATERIALS
from fsi_compare.study.mesh_levels import MESHES
from fsi_compare.study.study_run import StudyRun

MONOLITHIC, PARTITIONED = "monolithic", "robin-neumann-iqn"
WAVES, RESOLVED, NEWTON, FIXED_POINT, COST = "waves", "resolved", "newton", "fixed-point", "cost"
STOPPED_EARLY, FIBRES, DENSITY = "stopped-early", "fibres", "printed-density"
GROUPS = (WAVES, RESOLVED, NEWTON, FIXED_POINT, COST, STOPPED_EARLY, FIBRES, DENSITY)

# The times of the paper's figures, ms: of each material's, and of the one that compares the three.
TIMES = (1.5, 3.0, 4.5, 6.0, 7.5, 9.0)
ARTERY_TIMES = (1.75, 3.5, 5.25, 7.0, 8.75, 10.5)
PICTURE_TIME = 8.0  # of the deformed walls


class PaperRuns:
    """The finished runs; `asked`: all."""

    def __init__(self, runs: Sequence[StudyRun]):
        self.asked = list(runs)
        self._runs = [run for run in runs if run.done]
        present = {run.request.case for run in self._runs}
        self.materials = [material for material in MATERIALS if material in present]
        levels = {mesh_of(run) for run in self.all(WAVES)}
        self.meshes = [level for level in MESHES if level in levels]  # of the waves, coarse first

    @property
    def finest(self) -> str:
        return self.meshes[-1] if self.meshes else ""

    def all(self, group: str, case: str = "", mesh: str = "", method: str = "") -> List[StudyRun]:
        return [
            run
            for run in self._runs
            if run.request.group == group
            and (not case or run.request.case == case)
            and (not mesh or mesh_of(run) == mesh)
            and (not method or run.request.method.name == method)
        ]

    def one(self, group: str, case: str, mesh: str, method: str = "") -> Optional[StudyRun]:
        found = self.all(group, case, mesh, method)
        return found[0] if found else None

    def wave(self, case: str, mesh: str, method: str = MONOLITHIC) -> Optional[StudyRun]:
        return self.one(WAVES, case, mesh, method)


def mesh_of(run: StudyRun) -> str:
    return run.request.mesh.name if run.request.mesh else ""


def times_of(material: str) -> Sequence[float]:
    return ARTERY_TIMES if material == "artery" else TIMES
