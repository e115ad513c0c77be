"""`verify --error`: from the family to settings that reach a demanded error, and the case file that has them."""

import math
import shlex
import shutil
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Mapping, Sequence

from ..base.errors import InputError, printable
from ..gallery.mesh_chain import MARK, as_typed
from ..study.study_file import StudyMesh
from ..study.study_run import StudyRun
from ..starting.duration import duration
from .adapting import Adapted
from .cost import Costs, learn
from .curve_norms import Curve
from .demand import cheapest, direction_of, outside, reached, refinable, shown_by, tolerance_factor, widest
from .doubt import step_within
from .family import INDICATOR, STEP_RATIO, Member, members, with_settings
from .found_case import write_case
from .lean import between, cross, lean
from .making import Maker
from .quantities import curves_of
from .results import BarsOfRun, FamilyRuns, Judged, about, judge, relative, same_size

FOUND, MESH = "found.toml", "found.msh"
MOST_MOVES = 6  # of the family's centre
MOVES_FOR_BARS = 3  # of them for quantities that have no bar; then the others decide
FURTHEST = 2  # powers of a ratio, of settings beyond the family's centre


@dataclass
class Outcome:
    judged: list[Judged]  # of the last run
    reached: bool
    lines: list[str] = field(default_factory=list)  # what to say, in sentences
    final: Member | None = None
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Demand:
    error: float  # relative to the largest of each curve
    budget: float | None  # s
    names: Sequence[str]
    times: Sequence[float]


class Search:
    """One driver's: what it finds holds for the other, which solves the same equations."""

    def __init__(self, maker: Maker, demand: Demand, ratio: float, levels: int, start: Member) -> None:
        self.maker, self.demand, self.ratio, self.levels = maker, demand, ratio, levels
        self.driver = next(iter(maker.families))
        self.centre = start
        self.corner = self._corner(start)  # where the cross has its coarsest mesh and longest step
        self.curves: dict[Member, dict[str, Curve]] = {}  # of the family
        self.sets: dict[Path, BarsOfRun] = {}  # of each run that bars were made for, by its folder

    def go(self) -> Outcome:
        """Searches. Raises InputError where the user's own run fails or nothing is sampled."""
        judged = self._family()
        lines: list[str] = []
        for move in range(MOST_MOVES + 1):
            asked = [one for one in judged if one.bar.given]
            lacking = refinable(judged) and (move < MOVES_FOR_BARS or not asked)
            if not lacking and reached(asked, self.demand.error):
                judged = self._proved(judged)
                asked = [one for one in judged if one.bar.given]
                if reached(asked, self.demand.error):
                    break
            if move == MOST_MOVES:
                lines.append(f"The family has moved {MOST_MOVES} times, which is as often as it may.")
                break
            target = self._for_bars(judged) if lacking or not asked else self._towards(asked)
            if target is None:
                lines.append("No other settings are predicted to do better.")
                break
            if not self._move(target, lines):
                break
            judged = self._family()
        lines += [f"No error can be given of {one.quantity.name}: {one.bar.advice}." for one in outside(judged)]
        asked = [one for one in judged if one.bar.given]
        if not asked:
            return Outcome(judged, False, [*lines, "No quantity has a bar, so that no settings can be found."])
        if not reached(asked, self.demand.error):
            demand, far = 100 * self.demand.error, 100 * widest(asked)
            lines.append(f"{demand:g} % are not reached; the widest bar so far is {far:.2g} %, of {self._words(1, 1)}.")
            return Outcome(judged, False, lines)
        found = self._finish(asked, bool(outside(judged)))
        return replace(found, lines=lines + found.lines, reached=found.reached and not outside(judged))

    @property
    def crosses(self) -> bool:
        """Whether families are crosses, whose centre is not among their members."""
        recipe, facts = self.maker.requests.recipe, self.maker.requests.facts
        return recipe.coarsens and not isinstance(recipe, Adapted) and not facts.static

    def _corner(self, centre: Member) -> Member:
        return self._member(centre.mesh * self.ratio ** (self.levels - 1), centre.step * STEP_RATIO**2)

    def _members(self) -> list[Member]:
        recipe, facts, centre = self.maker.requests.recipe, self.maker.requests.facts, self.centre
        if self.crosses:
            meshes = between(self.corner.mesh, centre.mesh, self.ratio)
            steps = between(self.corner.step, centre.step, STEP_RATIO)
            found = cross([self._size(mesh) for mesh in meshes], [same_size(step) for step in steps])
            return [*found, centre] if centre in self.maker.families[self.driver].runs else found
        coarser = self.levels - 1 if recipe.coarsens else 0
        if isinstance(recipe, Adapted):
            coarser = min(self.levels - 1, recipe.level(centre.mesh))
        if coarser:
            meshes = [self.ratio ** (coarser - k) for k in range(self.levels)]
            relative = lean(meshes, facts.static)
        else:
            relative = members(recipe, facts, self.ratio, self.levels, True)
        return [self._member(m.mesh * centre.mesh, m.step * centre.step, m.looser, m.other) for m in relative]

    def _family(self) -> list[Judged]:
        """Its bars, after its members have run."""
        self.maker.run(self._members())
        self.curves = self._kept().read()
        found = self._judged(self.centre, self.crosses)
        if not found:
            names = " ".join(self.demand.names)
            where = self.maker.requests.facts.path, f"--of {names}".strip()
            raise InputError(*where, "no quantity to judge", "see bars.csv of a call without --error")
        return found

    def _kept(self) -> FamilyRuns:
        """Runs of earlier crosses tell no more of this one's centre: they are coarser."""
        runs = self.maker.families[self.driver].runs
        return FamilyRuns(self.driver, {m: runs[m] for m in self._members()} if self.crosses else runs)

    def _judged(self, centre: Member, additive: bool = False) -> list[Judged]:
        """Bars of any member, from all of the family."""
        family = about(self._kept(), centre)
        curves = {relative(member, centre): of for member, of in self.curves.items()}
        found = judge(family, curves, self.maker.requests.facts, self.demand.times, self.demand.names, additive)
        if (own := family.own) is not None:  # the last family to have a run tells most of it
            self.sets[own.folder] = BarsOfRun(self.driver, own, found)
        return found

    def _proved(self, judged: list[Judged]) -> list[Judged]:
        """Bars by a run of the centre itself, unless a cheaper one that has run is good enough."""
        if all(not one.bar.given for one in judged) or self.centre in self.curves:
            return judged
        if not outside(judged) and self._good_enough():
            return judged
        self.maker.run([self.centre])
        return self._family()

    def _costs(self, centre: Member) -> Costs | None:
        family = about(self.maker.families[self.driver], centre)
        return learn(family.runs, self.maker.dimension, self.maker.requests.facts.element)

    def _for_bars(self, judged: Sequence[Judged]) -> Member:
        """The centre refined by a ratio; where only its step is, at once to what the table of a flow needs."""
        target = self._finer(direction_of(judged))
        needed = step_within(self.maker.requests.facts)
        if target.mesh != self.centre.mesh or needed is None:
            return target
        while target.step > needed * (1 + 1e-9):
            target = Member(target.mesh, same_size(target.step / STEP_RATIO))
        return target

    def _finer(self, what: str) -> Member:
        """The centre moved by one ratio."""
        mesh = self.centre.mesh / self.ratio if what != "step" else self.centre.mesh
        step = self.centre.step / STEP_RATIO if what != "mesh" else self.centre.step
        return self._member(mesh, step)

    def _member(self, mesh: float, step: float, *others: bool) -> Member:
        return Member(self._size(mesh), same_size(step), *others)

    def _size(self, mesh: float) -> float:
        """The power of the ratio that it is but for round-off, so that a mesh has one size whatever way leads to it."""
        return same_size(self.ratio ** round(math.log(mesh) / math.log(self.ratio)))

    def _towards(self, asked: Sequence[Judged]) -> Member | None:
        """The cheapest settings that are predicted to reach the demand, but no further from the centre than FURTHEST
        ratios: the family's orders tell little beyond."""
        costs, facts, recipe = self._costs(self.centre), self.maker.requests.facts, self.maker.requests.recipe
        how = self.demand.error, self.ratio, facts.static, recipe.coarsens
        best = None if costs is None else cheapest(asked, costs, *how)
        if best is None:
            return self._finer("both")
        mesh = max(best.mesh, self.ratio**-FURTHEST)
        step = max(best.step, 2.0**-FURTHEST)
        if mesh >= 1 and step >= 1:
            return None
        self.maker.tell(f"predicted for {self._words(best.mesh, best.step)}: {100 * best.error:.2g} %")
        return self._member(self.centre.mesh * min(mesh, 1.0), self.centre.step * min(step, 1.0))

    def _words(self, mesh: float, step: float) -> str:
        return f"elements of {mesh * self.centre.mesh:.3g} and steps of {step * self.centre.step:.3g} of the case's"

    def _move(self, target: Member, lines: list[str]) -> bool:
        """Moves the family's centre; False where adaptation has stopped before it, or where that does not fit the
        budget."""
        if not self.maker.reaches(target):
            lines.append("Adaptation has stopped: a finer mesh was none the better for what it is adapted to.")
            return False
        costs = self._costs(Member(1.0, 1.0))
        before, self.centre = (self.centre, self.corner), target
        self._follow()
        seconds = self.maker.predicted(dict.fromkeys([*self._members(), target]))
        memory = f", {costs.memory(target.mesh):.0f} MiB" if costs is not None else ""
        words = f"{self._words(1, 1)}: about {duration(seconds)}{memory} for the family"
        left = math.inf if self.demand.budget is None else self.demand.budget - self.maker.seconds
        if seconds <= left:
            self.maker.tell(f"next, {words}")
            return True
        lines.append(f"Out of reach: {words}, and {duration(max(0.0, left))} of the budget are left.")
        self.centre, self.corner = before
        return False

    def _follow(self) -> None:
        """Moves the cross's corner to the new centre, where it would be more than one ratio further than it has to
        be."""
        corner = self._corner(self.centre)
        mesh, step = self.corner.mesh, self.corner.step
        mesh = mesh if mesh <= corner.mesh * self.ratio * (1 + 1e-6) else corner.mesh
        step = step if step <= corner.step * STEP_RATIO * (1 + 1e-6) else corner.step
        self.corner = Member(mesh, step)

    def _finish(self, asked: Sequence[Judged], lacking: bool) -> Outcome:
        """The cheapest run so far that is good enough, with tolerances that suit the demand. `lacking`: quantities
        without a bar remain; then the centre, which shows most of them."""
        final = next(iter([] if lacking else self._good_enough()), self.centre)
        judged = asked if final == self.centre else self._judged(final)
        for factor in dict.fromkeys([tolerance_factor(asked, self.demand.error), 1.0]):
            outcome = self._run(judged, final, factor)
            if outcome.reached:
                break
        return outcome

    def _good_enough(self) -> list[Member]:
        """The cheapest member whose own bars are within the demand; empty: none."""
        for member, _ in sorted(self._kept().done.items(), key=lambda pair: pair[1].seconds):
            if not (member.looser or member.other):
                judged = self._judged(member)
                if judged and reached(judged, self.demand.error):
                    return [member]
        return []

    def _run(self, asked: Sequence[Judged], final: Member, tolerance: float) -> Outcome:
        settings = {} if tolerance == 1 else self.maker.requests.tolerances(f"fsi-{self.driver}", tolerance)
        run = self.maker.single(final, self.driver, settings)
        words = self._words(final.mesh / self.centre.mesh, final.step / self.centre.step)
        if not run.done:
            return Outcome(list(asked), False, [f"The run with {words} is missing: {run.status}, {run.message}."])
        curves = curves_of(run.folder)
        judged = [shown_by(one, curves[one.quantity.curve]) for one in asked if one.quantity.curve in curves]
        self.sets[run.folder] = BarsOfRun(self.driver, run, judged)
        line = f"{words.capitalize()} leave {100 * widest(judged):.2g} %, in {duration(run.seconds)}."
        return Outcome(judged, reached(judged, self.demand.error), [line], final, settings)


def write_found(folder: Path, maker: Maker, outcome: Outcome, seconds: Mapping[str, StudyRun]) -> list[Path]:
    """`found.toml` with its mesh beside it; none where nothing was found."""
    if outcome.final is None:
        return []
    requests = maker.requests
    facts = requests.facts
    settings: dict[str, Any] = dict(requests.of(outcome.final, next(iter(maker.families))).settings)
    settings.pop(INDICATOR, None)  # of a family of adapted meshes; the case's own entry stays
    settings.update(outcome.settings)
    made = requests.mesh(outcome.final)
    mesh = maker.runner.mesh_file(made)
    written = [folder / FOUND]
    entries = with_settings(facts.entries, settings)
    if mesh is not None:
        shutil.copyfile(mesh, folder / MESH)
        entries["mesh"] = {"file": str((requests.folder / MESH).resolve())}
        written.append(folder / MESH)
    comments = [
        f"{printable(str(facts.path))} with the settings that fsi-compare verify has found:",
        *outcome.lines,
        *(map(printable, _as_made(made)) if made is not None else []),
        *(f"fsi-{name}: {duration(run.seconds) if run.done else run.status}" for name, run in seconds.items()),
    ]
    write_case(folder / FOUND, entries, facts.path.parent.resolve(), comments)
    return written


def _as_made(mesh: StudyMesh) -> list[str]:
    """The commands of a mesh, as comments."""
    words = [mesh.command, *mesh.options]
    if MARK not in words:
        return [f"{MESH}: {shlex.join(['fsi-mesh', *words])}"]
    return [f"{MESH}:", *(f"  {line}" for line in as_typed(words, Path(MESH), MESH))]


def by_each_driver(maker: Maker, outcome: Outcome, drivers: Sequence[str]) -> dict[str, StudyRun]:
    """The settings found, as `found.toml` has them, run by each. Where another driver stops by tolerances that are not
    among them a line says so."""
    if outcome.final is None:
        return {}
    own = next(iter(maker.families))
    found = {}
    for driver in dict.fromkeys([own, *drivers]):
        found[driver] = maker.single(outcome.final, driver, outcome.settings)
        kept = [key for key in maker.requests.tolerances(f"fsi-{driver}", 1.0) if key not in outcome.settings]
        if outcome.settings and kept:
            outcome.lines.append(f"fsi-{driver} stops by {' and '.join(kept)}, as in the case.")
    return found
