"""One known number in a family of runs of a scene: its value with a bar, and how far that is from what is known."""

from dataclasses import dataclass
from typing import Dict, List, Mapping, Optional, Sequence, Tuple

from fsi_compare.gallery.scene import Number, Scene, SceneRun, SceneRuns
from fsi_compare.study.study_run import StudyRun
from fsi_compare.verify.family import CaseFacts, Member
from fsi_compare.verify.results import sizes
from fsi_compare.verify.verdict import Bar, Value, bar_of

# Units of what is made of gradients and pressures, whose order in space is one less.
# Sources of references that are no more than what the other driver gives.
OTHER_DRIVER = ("the other driver", "the monolithic driver", "the partitioned driver")
OF_GRADIENTS = ("Pa", "kPa", "mmHg", "N", "N/m", "mN")

Runs = Mapping[str, Mapping[Member, StudyRun]]  # by program, those that are done


@dataclass(frozen=True)
class Record:
    scene: str
    number: Number  # of the scene's own run
    bar: Bar
    seconds: float  # of the time steps of the scene's own run

    @property
    def off(self) -> float:
        """What the value and the known one differ by."""
        return abs(self.number.value - self.number.reference)

    @property
    def in_bars(self) -> Optional[float]:
        """Difference over the bar; None: there is no bar."""
        return self.off / self.bar.total if self.bar.given and self.bar.total > 0 else None

    @property
    def beyond(self) -> Optional[float]:
        """Difference over bar, spread of published values and error of the reference's model together."""
        room = self.bar.total + (self.number.spread + self.number.model) * abs(self.number.reference)
        return self.off / room if self.bar.given and room > 0 else None

    @property
    def holds(self) -> bool:
        return self.beyond is not None and self.beyond <= 1

    def relative(self, difference: float) -> float:
        """Relative to the known value, or to the scale that the scene gives for its errors."""
        return difference / (self.number.scale or abs(self.number.reference))


def numbers_of(scene: Scene, runs: Runs) -> Dict[Tuple[str, str], Dict[Member, Number]]:
    """What the scene measures in each member, by (what it is, program). A scene may compare its drivers, so that both
    runs of a member are read together."""
    found: Dict[Tuple[str, str], Dict[Member, Number]] = {}
    for member in dict.fromkeys(member for of in runs.values() for member in of):
        here = {
            program: SceneRun(of[member].folder, program, of[member].summary, of[member].wall_s)
            for program, of in runs.items()
            if member in of
        }
        if len(here) < len(runs):
            continue
        for number in scene.numbers(SceneRuns(here, False)):
            found.setdefault((number.what, number.program), {})[member] = number
    return found


def records(scene: Scene, facts: CaseFacts, runs: Runs) -> List[Record]:
    """Records of all numbers of the scene that are known otherwise than by its other driver."""
    found: List[Record] = []
    for (_, program), of in numbers_of(scene, runs).items():
        own = next((number for member, number in of.items() if member.is_own), None)
        if own is None or own.source in OTHER_DRIVER:
            continue
        real = sizes(runs[program])
        values = [Value(real.get(m.mesh, m.mesh), m.step, n.value, m.looser, m.other) for m, n in of.items()]
        order = facts.space_order(own.unit in OF_GRADIENTS)
        bar = bar_of(values, own.scale or abs(own.reference), order, facts.time_order, facts.element)
        if bar is not None:
            seconds = next(run.wall_s for member, run in runs[program].items() if member.is_own)
            found.append(Record(scene.name, own, bar, seconds))
    return found


@dataclass(frozen=True)
class Score:
    records: Sequence[Record]

    @property
    def given(self) -> List[Record]:
        return [one for one in self.records if one.bar.given]

    @property
    def held(self) -> List[Record]:
        return [one for one in self.given if one.holds]
