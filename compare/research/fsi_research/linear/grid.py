"""The runs of a study of linear solvers by material and mesh, and what there is to say of a method on a system."""

from dataclasses import dataclass
from typing import Iterable, List, Optional, Sequence

from ..catalogue.names import MATERIALS, METHODS
from fsi_compare.study.mesh_levels import MESHES
from .results import NewtonSystem, Solve, System
from .study import Outcome


@dataclass(frozen=True)
class Entry:
    """What there is to say about one method on one system: `status` is converged, not converged, failed (the whole
    run), or not run; the solve is there for the first only, so that no number of a failure gets into a table."""

    status: str
    solve: Optional[Solve] = None
    message: str = ""

    @property
    def iterations(self) -> Optional[int]:
        return self.solve.iterations if self.solve else None

    @property
    def short(self) -> str:
        words = {"converged": str(self.iterations), "not converged": "n.c.", "failed": "failed", "not run": "-"}
        return words[self.status]


class Grid:
    """All runs of a study by material and mesh."""

    def __init__(self, outcomes: Sequence[Outcome]):
        self._outcomes = {(o.request.material, o.request.mesh): o for o in outcomes}
        self.materials = _ordered((o.request.material for o in outcomes), MATERIALS)
        self.meshes = _ordered((o.request.mesh for o in outcomes), MESHES)
        self.systems: List[System] = sorted({s for o in outcomes for s in o.request.systems})
        self.sub_problems = any(o.request.sub_problems for o in outcomes)
        self.tolerances = sorted({o.request.tolerance for o in outcomes})
        self.methods = _ordered((name for o in outcomes for name in o.request.solvers), METHODS)

    def outcome(self, material: str, mesh: str) -> Optional[Outcome]:
        return self._outcomes.get((material, mesh))

    def system(self, material: str, mesh: str, key: System) -> Optional[NewtonSystem]:
        outcome = self.outcome(material, mesh)
        return outcome.results.systems[key] if outcome and outcome.results else None

    def entry(self, material: str, mesh: str, key: System, method: str) -> Entry:
        outcome = self.outcome(material, mesh)
        if outcome is None or method not in outcome.request.solvers:
            return Entry("not run")
        if outcome.results is None:
            return Entry("failed", message=outcome.failure)
        solve = outcome.results.systems[key].solves[method]
        return Entry("converged", solve) if solve.converged else Entry("not converged", message=solve.message)

    def time_ms(self, key: System) -> Optional[float]:
        return next(
            (
                system.time_ms
                for material in self.materials
                for mesh in self.meshes
                for system in [self.system(material, mesh, key)]
                if system
            ),
            None,
        )

    def heading(self, key: System) -> str:
        time = self.time_ms(key)
        return f"Newton system {key[1]} of step {key[0]}" + ("" if time is None else f" (t = {time:g} ms)")


def _ordered(names: Iterable[str], known: Iterable[str]) -> List[str]:
    present = set(names)
    return [name for name in known if name in present]


def suffix(key: System) -> str:
    return f"step{key[0]}_newton{key[1]}"
