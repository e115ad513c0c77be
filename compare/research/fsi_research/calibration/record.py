"""One bar against the truth."""

from dataclasses import dataclass, replace
from typing import Any, Callable, List, Mapping, Optional, Sequence

import numpy as np

from fsi_compare.study.study_run import StudyRun
from fsi_compare.verify.doubt import on_common_points
from fsi_compare.verify.family import CaseFacts, Member
from fsi_compare.verify.quantities import curves_of
from fsi_compare.verify.results import FamilyRuns, about, judge
from fsi_compare.verify.verdict import CONVERGES, Bar

EXACT_TO = 1e-6  # relative: below it the truth is not known
Known = Callable[[str, np.ndarray], Any]  # exact values of a curve at times, or None


@dataclass(frozen=True)
class Record:
    scene: str
    size: str  # of the family
    quantity: str
    unit: str
    bar: Bar
    truth: float
    error: float  # of a curve the norm of its difference from the truth
    exact: bool = False  # the truth is the scene's, not a finer run's

    @property
    def known(self) -> float:
        """The true error, or the smallest that can be seen."""
        return max(self.error, EXACT_TO * self.bar.scale)

    @property
    def ratio(self) -> float:
        """Bar over true error."""
        return self.bar.total / self.known

    @property
    def holds(self) -> bool:
        return self.error <= self.bar.total

    @property
    def misleads(self) -> bool:
        """Said to converge, and off by more than twice the bar."""
        return self.bar.verdict == CONVERGES and self.error > 2 * self.bar.total + EXACT_TO * self.bar.scale


def records(
    scene: str,
    size: str,
    facts: CaseFacts,
    centre: Member,
    runs: Mapping[Member, StudyRun],
    reference: StudyRun,
    skipped: Sequence[str],
    known: Known = lambda name, times: None,
) -> List[Record]:
    """Records of all quantities of the family about `centre`, whose members are given by sizes relative to the case.
    The truth is the reference, or the exact curve where it is known, at the reference's times."""
    family = about(FamilyRuns("monolithic", {m: run for m, run in runs.items() if run.done}), centre)
    if family.own is None:
        return []
    far = Member(0.0, 0.0)  # stands for the reference
    together = on_common_points({**family.read(), far: curves_of(reference.folder)})
    truth = together.pop(far)
    exact = {name: of for name, of in ((name, known(name, of.times)) for name, of in truth.items()) if of is not None}
    for name, values in exact.items():
        everywhere = np.ones((1, truth[name].values.shape[1]))
        truth[name] = replace(truth[name], values=np.asarray(values, dtype=float)[:, None] * everywhere)
    found = []
    for one in judge(family, together, facts, (), ()):
        quantity = one.quantity
        if quantity.curve not in truth or any(word in quantity.name for word in skipped):
            continue
        curve = truth[quantity.curve]
        value, error = quantity.of(curve), one.apart(curve)
        found.append(Record(scene, size, quantity.name, quantity.unit, one.bar, value, error, quantity.curve in exact))
    return found


@dataclass(frozen=True)
class Score:
    """Score of all bars, or of a scene's."""

    name: str
    records: Sequence[Record]

    @property
    def given(self) -> List[Record]:
        return [one for one in self.records if one.bar.given]

    @property
    def counted(self) -> List[Record]:
        """Records whose true error can be seen: a prescribed flow has none, and any bar holds it."""
        return [one for one in self.given if one.error > EXACT_TO * one.bar.scale]

    @property
    def held(self) -> Optional[float]:
        """Share of the bars that hold the true error."""
        return sum(one.holds for one in self.counted) / len(self.counted) if self.counted else None

    @property
    def median(self) -> Optional[float]:
        """Median of bar over true error."""
        ratios = sorted(one.ratio for one in self.counted)
        return ratios[len(ratios) // 2] if ratios else None

    @property
    def misled(self) -> int:
        return sum(one.misleads for one in self.records)
