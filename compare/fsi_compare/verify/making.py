"""Makes the runs of a family, whatever becomes of single members."""

import shlex
from dataclasses import replace
from typing import Any, Iterable, Mapping, Sequence

from ..base.errors import InputError, ProgramError, say_note, say_warning
from ..base.files import absolute
from ..runs.coupling import chosen_scheme
from ..study.runner import Runner
from ..study.study_run import REFUSED, StudyRun
from .adapting import Adapted, adapting_member, nodes_of
from .cost import learn
from .family import Member, Requests
from .paying import about_unpaid, unpaid
from .quantities import curves_of
from .results import FamilyRuns


class Maker:
    """Keeps the outcome of each member, by driver. `names`: quantities that decide whether adaptation has paid; empty:
    all."""

    def __init__(self, runner: Runner, requests: Requests, dimension: int, quiet: bool, names: Sequence[str] = ()):
        self.runner, self.requests, self.dimension, self.quiet = runner, requests, dimension, quiet
        self.names = names
        self.last: int | None = None  # level of the adapted mesh that was none the better for it: there is no finer one
        self.families = {driver: FamilyRuns(driver, {}) for driver in requests.methods}
        self.others: dict[str, StudyRun] = {}
        self.notes: list[str] = []
        self._meshes: dict[float, str] = {}  # why one cannot be made, by size; empty: it can

    @property
    def seconds(self) -> float:
        runs = [run for family in self.families.values() for run in family.runs.values()]
        return sum(run.seconds for run in [*runs, *self.others.values()])

    def run(self, members: Sequence[Member]) -> None:
        """Runs the members that are not there yet. Raises InputError where the user's own cannot run."""
        recipe = self.requests.recipe
        if not isinstance(recipe, Adapted):
            self._together([pair for pair in self._wanted(members) if self._has_mesh(*pair)])
            return
        moved: list[Member] = []
        wanted = {member.mesh for member, _ in self._wanted(members)}
        for mesh in sorted(wanted, reverse=True):  # each from its predecessor
            level, here, plain = recipe.level(mesh), [m for m in members if m.mesh == mesh], Member(mesh, 1.0)
            for below in range(level):
                self._climb(recipe, below)
            if plain in here and self.reaches(plain):  # before its others: it says whether there are any
                self._together([pair for pair in self._wanted([plain])[:1] if self._has_mesh(*pair)])
                self._climb(recipe, level)
            if self.last is not None and level >= self.last:
                runs = next(iter(self.families.values())).runs
                before = adapting_member(recipe, runs, self.last - 1).mesh
                moved += [replace(m, mesh=before) for m in here if m.step < 1]
                here = [m for m in here if m.step >= 1 and level == self.last]
            self._together([pair for pair in self._wanted(here) if self._has_mesh(*pair)])
        self._together([pair for pair in self._wanted(moved) if self._has_mesh(*pair)])

    def reaches(self, member: Member) -> bool:
        """Whether adaptation goes as far as the member's mesh."""
        recipe = self.requests.recipe
        return not isinstance(recipe, Adapted) or self.last is None or recipe.level(member.mesh) <= self.last

    def _wanted(self, members: Iterable[Member]) -> list[tuple[Member, str]]:
        """Requests that are not there yet, each once."""
        pairs = [(m, driver) for m in dict.fromkeys(members) for driver in self.families]
        return [(m, driver) for m, driver in pairs if m not in self.families[driver].runs]

    def _climb(self, recipe: Adapted, level: int) -> None:
        """The run whose indicator makes the mesh of the next level: that of the first driver by the case's own step."""
        if level in recipe.parents or self.last is not None:
            return
        driver, family = next(iter(self.families.items()))
        parent = adapting_member(recipe, family.runs, level)
        if parent not in family.runs and self._has_mesh(parent, driver):
            self._together([(parent, driver)])
        run = family.runs[parent]
        if run.done:
            mesh = self.runner.mesh_file(self.requests.mesh(parent)) or recipe.file
            assert mesh is not None  # a case without a mesh file has one made
            recipe.parents[level] = absolute(mesh), absolute(run.folder)
            self._judge_adaptation(recipe, level)

    def _judge_adaptation(self, recipe: Adapted, level: int) -> None:
        """Ends the family at this level where its mesh has brought a kind of quantity no nearer."""
        if level < 2:
            return
        curves = [curves_of(recipe.parents[n][1]) for n in range(level - 2, level + 1)]
        found = unpaid(curves, self.requests.facts, self.names)
        if found:
            self.last = level
            self.note(about_unpaid(level, found))

    def _together(self, wanted: Sequence[tuple[Member, str]]) -> None:
        """Runs with looser tolerances last, where another run has yet to tell which tolerances count."""
        late = [(member, driver) for member, driver in wanted if member.looser and self.requests.awaits_scheme(driver)]
        self._run([pair for pair in wanted if pair not in late])
        self._run(late)

    def _run(self, wanted: Sequence[tuple[Member, str]]) -> None:
        runs = self.runner.run([self.requests.of(member, driver) for member, driver in wanted])
        for (member, driver), run in zip(wanted, runs):
            self.families[driver].runs[member] = run
            self._learn_scheme(driver, run)
        for (member, driver), run in zip(wanted, runs):
            if member.is_own and not run.done:
                key = f"{driver}, as the case says"
                raise ProgramError(self.requests.facts.path, key, run.message or run.status, "mend the case first")

    def _learn_scheme(self, driver: str, run: StudyRun) -> None:
        if self.requests.awaits_scheme(driver):
            self.requests.scheme = chosen_scheme(run.summary)

    def single(self, member: Member, driver: str, settings: Mapping[str, Any]) -> StudyRun:
        """A run that is no member: with settings of its own."""
        request = self.requests.of(member, driver)
        run = self.runner.run([replace(request, settings={**request.settings, **settings})])[0]
        self.others[shlex.join([driver, str(run.folder)])] = run
        self._learn_scheme(driver, run)
        return run

    def _has_mesh(self, member: Member, driver: str) -> bool:
        if member.mesh not in self._meshes:
            self._meshes[member.mesh] = ""
            try:
                self.runner.mesh_file(self.requests.mesh(member))
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

    def nodes(self, size: float) -> int | None:
        """Number of nodes of the mesh of a size relative to the case's; None: there is none."""
        try:
            mesh = self.runner.mesh_file(self.requests.mesh(Member(round(size, 9), 1.0)))
            return None if mesh is None else nodes_of(mesh)
        except InputError:
            return None

    def begin_again(self, settings: Mapping[str, Any]) -> None:
        """Forgets all runs; the next ones have these entries over the case's."""
        self.requests.settings.update(settings)
        for family in self.families.values():
            family.runs.clear()
        self._meshes.clear()
        if isinstance(self.requests.recipe, Adapted):
            self.requests.recipe.parents.clear()
            self.last = None

    def predicted(self, members: Iterable[Member]) -> float:
        """Seconds of those that are not there yet, by all drivers, from those that are."""
        found = 0.0
        for driver, family in self.families.items():
            costs = learn(family.runs, self.dimension, self.requests.facts.element)
            if costs is not None:
                found += sum(costs.seconds(m.mesh, m.step) for m in members if m not in family.runs)
        return found

    def note(self, text: str) -> None:
        self.notes.append(text)
        if not self.quiet:
            say_warning(text)

    def tell(self, text: str) -> None:
        if not self.quiet:
            say_note(text)
