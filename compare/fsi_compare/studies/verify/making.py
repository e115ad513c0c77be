"""Makes the runs of a family, whatever becomes of single members."""

from typing import Dict, List, Optional, Sequence

from ...base.errors import InputError, ProgramError, say_note, say_warning
from ..running.runner import Runner
from ..running.study_run import REFUSED, StudyRun
from ..starting.progress import duration
from .cost import learn
from .family import Member, Requests
from .results import FamilyRuns


class Maker:
    """`budget`: s that all runs of this family may take, whenever they were made; None: as long as it takes."""

    def __init__(
        self, runner: Runner, requests: Requests, dimension: int, budget: Optional[float], quiet: bool
    ) -> None:
        self.runner, self.requests, self.dimension = runner, requests, dimension
        self.budget, self.quiet = budget, quiet
        self.families = {driver: FamilyRuns(driver, {}) for driver in requests.methods}
        self.notes: List[str] = []
        self._meshes: Dict[float, str] = {}  # why one cannot be made, by size; empty: it can

    @property
    def seconds(self) -> float:
        return sum(run.seconds for family in self.families.values() for run in family.runs.values())

    def run(self, members: Sequence[Member]) -> None:
        """Those that are not there yet; from cheap to dear where there is a budget. Raises InputError where the user's own
        cannot run."""
        wanted = [(m, driver) for m in members for driver in self.families if m not in self.families[driver].runs]
        wanted = [pair for pair in wanted if self._has_mesh(pair[0], pair[1])]
        if self.budget is None:
            self._together(wanted)
            return
        for member, driver in wanted:
            if self._affordable(member, driver):
                self._together([(member, driver)])

    def _together(self, wanted: Sequence["tuple[Member, str]"]) -> None:
        runs = self.runner.run([self.requests.of(member, driver) for member, driver in wanted])
        for (member, driver), run in zip(wanted, runs):
            self.families[driver].runs[member] = run
        for (member, driver), run in zip(wanted, runs):
            if member.is_own and not run.done:
                key = f"{driver}, as the case says"
                raise ProgramError(self.requests.facts.path, key, run.message or run.status, "mend the case first")

    def _has_mesh(self, member: Member, driver: str) -> bool:
        if member.mesh not in self._meshes:
            self._meshes[member.mesh] = ""
            mesh = self.requests.mesh(member)
            try:
                self.runner.mesh_file(mesh)
            except InputError as error:
                if member.mesh == 1:
                    raise
                self._meshes[member.mesh] = str(error)
                self.note(f"the mesh of size {member.mesh:.3g} cannot be made: {error}")
        problem = self._meshes[member.mesh]
        if problem:
            request = self.requests.of(Member(1.0, member.step, member.looser), driver)
            place = self.requests.folder / "runs" / "none"
            self.families[driver].runs[member] = StudyRun(request, place, REFUSED, problem, 0.0, "")
        return not problem

    def _affordable(self, member: Member, driver: str) -> bool:
        predicted = self.predicted(member, driver)
        if predicted is None or self.budget is None or self.seconds + predicted <= self.budget:
            return True
        self.note(
            f"the member '{member.name}' of the {driver} driver is left out: it would take about {duration(predicted)}, and "
            f"{duration(max(0.0, self.budget - self.seconds))} of the budget are left"
        )
        return False

    def predicted(self, member: Member, driver: str) -> Optional[float]:
        """s; None: no member has run that would tell."""
        costs = learn(self.families[driver].runs, self.dimension)
        return None if costs is None else costs.seconds(member.mesh, member.step)

    def note(self, text: str) -> None:
        self.notes.append(text)
        if not self.quiet:
            say_warning(text)

    def tell(self, text: str) -> None:
        if not self.quiet:
            say_note(text)
