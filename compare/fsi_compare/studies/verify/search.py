"""`verify --error`: from the family to settings that reach a demanded error, and the case file that has them."""

import shutil
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Sequence

from ...base.errors import InputError, printable
from ..running.study_run import StudyRun
from ..starting.progress import duration
from .cost import learn
from .demand import Settings, cheapest, direction_of, outside, reached, shown_by, tolerance_factor, widest
from .family import Member, members, with_settings
from .found_case import write_case
from .making import Maker
from .quantities import curves_of
from .results import Judged, about, judge

FOUND, MESH = "found.toml", "found.msh"
MOST_MOVES = 4  # of the family's centre
FURTHEST = 2  # powers of a ratio, of settings beyond the family's centre
MOST_ROUNDS = 4


@dataclass
class Outcome:
    judged: List[Judged]  # of the last run
    reached: bool
    lines: List[str] = field(default_factory=list)  # what to say, in sentences
    final: Optional[Member] = None
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Demand:
    error: float  # relative to the largest of each curve
    budget: Optional[float]  # s
    names: Sequence[str]
    times: Sequence[float]


class Search:
    """One driver's: what it finds holds for the other, which solves the same equations."""

    def __init__(self, maker: Maker, demand: Demand, ratio: float, levels: int) -> None:
        self.maker, self.demand, self.ratio, self.levels = maker, demand, ratio, levels
        self.driver = next(iter(maker.families))
        self.centre = Member(1.0, 1.0)

    def go(self) -> Outcome:
        """Raises InputError where the user's own run fails or nothing is sampled."""
        judged = self._family()
        for _ in range(MOST_MOVES):
            where = direction_of(judged) if outside(judged) else self._far(judged)
            if not where or not self._move(where):
                break
            judged = self._family()
        lines = [f"No error can be given of {one.quantity.name}: {one.bar.advice}." for one in outside(judged)]
        asked = [one for one in judged if one.bar.given]
        if not asked:
            return Outcome(
                judged, False, [*lines, "No quantity asked for has a bar, so that no settings can be found."]
            )
        found = self._rounds(asked)
        return replace(found, lines=lines + found.lines, reached=found.reached and not lines)

    def _members(self, finer: bool = False) -> List[Member]:
        requests = self.maker.requests
        relative = members(
            requests.recipe, requests.facts, self.ratio, self.levels, finer or not requests.recipe.coarsens
        )
        centre = self.centre
        return [Member(_round(m.mesh * centre.mesh), _round(m.step * centre.step), m.looser) for m in relative]

    def _family(self) -> List[Judged]:
        self.maker.run(self._members())
        family = about(self.maker.families[self.driver], self.centre)
        found = judge(family, family.read(), self.maker.requests.facts, self.demand.times, self.demand.names)
        if not found:
            names = " ".join(self.demand.names)
            raise InputError(
                self.maker.requests.facts.path,
                f"--of {names}".strip(),
                "no quantity to judge",
                "see bars.csv of a call without --error",
            )
        return found

    def _best(self, judged: Sequence[Judged], demand: float) -> Optional[Settings]:
        family = about(self.maker.families[self.driver], self.centre)
        costs = learn(family.runs, self.maker.dimension)
        requests = self.maker.requests
        if costs is None:
            return None
        return cheapest(judged, costs, demand, self.ratio, requests.facts.static, requests.recipe.coarsens)

    def _far(self, judged: Sequence[Judged]) -> str:
        """In which direction the settings lie further from the family than its own members do from each other; empty: in
        none. There the family goes first: so far its orders tell little."""
        best = self._best(judged, self.demand.error)
        mesh = best is None or best.mesh < 0.99 * self.ratio**-FURTHEST
        step = best is None or best.step < 0.99 * 2.0**-FURTHEST
        return "both" if mesh and step else "mesh" if mesh else "step" if step else ""

    def _move(self, what: str) -> bool:
        """The centre to finer sizes; False where that does not fit the budget."""
        before = self.centre
        mesh = before.mesh / self.ratio if what != "step" else before.mesh
        step = before.step / 2 if what != "mesh" else before.step
        self.centre = Member(_round(mesh), _round(step))
        if self._fits(self.maker.predicted(self._members())):
            self.maker.tell(f"the family moves to {self.centre.name}")
            return True
        self.centre = before
        return False

    def _fits(self, seconds: float) -> bool:
        budget = self.demand.budget
        return budget is None or self.maker.seconds + seconds <= budget

    def _rounds(self, asked: Sequence[Judged]) -> Outcome:
        demand = self.demand.error
        outcome = Outcome(list(asked), reached(asked, demand))
        for _ in range(MOST_ROUNDS):
            best = self._best(asked, demand)
            if best is None:
                outcome.lines.append(f"{100 * self.demand.error:g} % are out of reach of what the family predicts.")
                return outcome
            self._announce(best)
            if not self._fits(best.seconds):
                left = max(0.0, (self.demand.budget or 0.0) - self.maker.seconds)
                outcome.lines.append(
                    f"{100 * self.demand.error:g} % are out of reach: the run would take about {duration(best.seconds)}, and "
                    f"{duration(left)} of the budget are left. The bar so far is {100 * widest(outcome.judged):.2g} %."
                )
                return outcome
            outcome = self._run(asked, best)
            if outcome.reached or outcome.final is None:
                return outcome
            demand *= 0.8 * self.demand.error / max(widest(outcome.judged), self.demand.error)
        outcome.lines.append(
            f"Not reached in {MOST_ROUNDS} runs; the bar so far is {100 * widest(outcome.judged):.2g} %."
        )
        return outcome

    def _announce(self, best: Settings) -> None:
        centre = self.centre
        self.maker.tell(
            f"next: elements of {best.mesh * centre.mesh:.3g}, steps of {best.step * centre.step:.3g} of the case's; predicted are "
            f"{duration(best.seconds)}, {best.memory:.0f} MiB and {100 * best.error:.2g} %"
        )

    def _run(self, asked: Sequence[Judged], best: Settings) -> Outcome:
        tolerance = tolerance_factor(asked, self.demand.error)
        final = Member(_round(best.mesh * self.centre.mesh), _round(best.step * self.centre.step))
        settings = self.maker.requests.tolerances(f"fsi-{self.driver}", tolerance)
        run = self.maker.single(final, self.driver, settings)
        if not run.done:
            return Outcome(
                list(asked), False, [f"The run with the settings found is missing: {run.status}, {run.message}."]
            )
        curves = curves_of(run.folder)
        judged = [
            shown_by(one, one.quantity.of(curves[one.quantity.curve]), best.mesh, best.step, tolerance)
            for one in asked
            if one.quantity.curve in curves
        ]
        took = f"It took {duration(run.seconds)}; {duration(best.seconds)} were predicted."
        lines = [
            f"Elements of {final.mesh:.3g} and steps of {final.step:.3g} of the case's leave {100 * widest(judged):.2g} %. {took}"
        ]
        return Outcome(judged, reached(judged, self.demand.error), lines, final, settings)


def _round(size: float) -> float:
    return 1.0 if abs(size - 1) < 1e-9 else round(size, 9)


def write_found(folder: Path, maker: Maker, outcome: Outcome, seconds: Mapping[str, StudyRun]) -> List[Path]:
    """`found.toml` with its mesh beside it; none where nothing was found."""
    if outcome.final is None:
        return []
    requests = maker.requests
    facts = requests.facts
    settings: Dict[str, Any] = dict(requests.of(outcome.final, next(iter(maker.families))).settings)
    settings.update(outcome.settings)
    mesh = maker.runner.mesh_file(requests.mesh(outcome.final))
    written = [folder / FOUND]
    entries = with_settings(facts.entries, settings)
    if mesh is not None:
        shutil.copyfile(mesh, folder / MESH)
        entries["mesh"] = {"file": str((requests.folder / MESH).resolve())}
        written.append(folder / MESH)
    comments = [
        f"{printable(str(facts.path))} with the settings that fsi-compare verify has found:",
        *outcome.lines,
        *(f"fsi-{name}: {duration(run.seconds) if run.done else run.status}" for name, run in seconds.items()),
    ]
    write_case(folder / FOUND, entries, facts.path.parent.resolve(), comments)
    return written


def by_each_driver(maker: Maker, outcome: Outcome, drivers: Sequence[str]) -> Dict[str, StudyRun]:
    """The settings found, run by each."""
    if outcome.final is None:
        return {}
    own = next(iter(maker.families))
    found = {}
    for driver in dict.fromkeys([own, *drivers]):
        settings = outcome.settings if driver == own else {}
        found[driver] = maker.single(outcome.final, driver, settings)
    return found
