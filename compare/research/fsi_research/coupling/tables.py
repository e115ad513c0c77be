"""Tables of the study of coupling."""

from typing import Dict, List, NamedTuple, Optional, Sequence, Tuple

from ..catalogue.names import MATERIALS
from fsi_compare.reporting.column import Column, Facts, fixed
from fsi_compare.reporting.layout import Table
from fsi_compare.reporting.cost import Cost
from fsi_compare.runs.differences import largest_difference
from fsi_compare.study.study_file import show
from fsi_compare.study.study_run import StudyRun
from .sweeps import MONOLITHIC

Place = Tuple[str, str]  # mesh and case: what a column is of


def mesh_name(run: StudyRun) -> str:
    return run.request.mesh.name if run.request.mesh else ""


def place_of(run: StudyRun) -> Place:
    return mesh_name(run), run.request.case


def places(runs: Sequence[StudyRun]) -> List[Place]:
    return list(dict.fromkeys(map(place_of, runs)))


def by_scheme(runs: Sequence[StudyRun]) -> List[Tuple[str, Dict[Place, StudyRun]]]:
    """(name, its runs), in the order of the study."""
    found: Dict[str, Dict[Place, StudyRun]] = {}
    for run in runs:
        found.setdefault(run.request.method.name, {}).setdefault(place_of(run), run)
    return list(found.items())


class Passes(NamedTuple):
    """Coupling iterations of a run's steps; None: it has not ended."""

    run: StudyRun
    mean: Optional[float]
    least: Optional[int]
    most: Optional[int]
    steps: int

    @property
    def shown(self) -> str:
        return f"{self.mean:.1f} ({self.least}-{self.most})" if self.run.done else self.run.status


def passes_of(run: StudyRun) -> Passes:
    if not run.done:
        return Passes(run, None, None, None, run.steps)
    outer = run.columns("iterations.csv")["outer_iterations"]
    return Passes(run, float(outer.mean()), int(outer.min()), int(outer.max()), len(outer))


PASSES: Sequence[Column[Passes]] = (
    Column(csv="scheme", value=lambda p: p.run.request.method.name),
    Column(csv="mesh", value=lambda p: mesh_name(p.run)),
    Column(csv="case", value=lambda p: p.run.request.case),
    Column(csv="tolerance", value=lambda p: p.run.request.settings.get("partitioned.tolerance")),
    Column(csv="steps", value=lambda p: p.steps),
    Column(csv="mean", value=lambda p: p.mean),
    Column(csv="least", value=lambda p: p.least),
    Column(csv="most", value=lambda p: p.most),
    Column(csv="status", value=lambda p: p.run.status),
)


def passes_table(runs: Sequence[StudyRun]) -> Table:
    """A line per scheme, a column per mesh and material."""

    def column(place: Place) -> Column[Dict[Place, Passes]]:
        steps = max(run.steps for run in runs if mesh_name(run) == place[0])
        return Column(
            MATERIALS.get(place[1], place[1]),
            value=lambda row: row[place].shown if place in row else "",
            group=f"{place[0]}, {steps} steps",
        )

    shown = places(runs)
    rows = [{p: passes_of(own[p]) for p in shown if p in own} for _, own in by_scheme(runs)]
    return Table(
        "coupling_passes",
        "Coupling iterations per step, mean (range)",
        [Column("scheme", value=lambda row: next(iter(row.values())).run.method_label, left=True), *map(column, shown)],
        rows,
        Facts(PASSES, [passes for row in rows for passes in row.values()]),
    )


class Growth(NamedTuple):
    """Growth of the passes from the coarsest mesh to another, mean over the steps that both runs have."""

    run: StudyRun
    steps: int
    coarsest: float
    mean: float


def growth_table(runs: Sequence[StudyRun]) -> Table:
    """Mean over the steps that both runs have, on the finer mesh over the coarsest: the first steps take the most
    passes, so that only equal numbers of steps compare."""
    done = [run for run in runs if run.done]
    coarsest = mesh_name(done[0]) if done else ""
    columns: List[Column[Growth]] = [
        Column("scheme", "scheme", lambda g: g.run.request.method.name, text=lambda g: g.run.method_label, left=True),
        Column("material", "case", lambda g: g.run.request.case, lambda case: MATERIALS.get(case, case), left=True),
        Column("mesh", "mesh", lambda g: mesh_name(g.run), left=True),
        Column("steps", "steps", lambda g: g.steps),
        Column(f"mean, {coarsest}", "mean_coarsest", lambda g: g.coarsest, ".1f"),
        Column("mean here", "mean", lambda g: g.mean, ".1f"),
        Column("ratio", "ratio", lambda g: g.mean / g.coarsest, ".2f"),
    ]
    of_coarsest = {(r.request.method.name, r.request.case): r for r in reversed(done) if mesh_name(r) == coarsest}
    found = []
    for run in done:
        reference = of_coarsest.get((run.request.method.name, run.request.case))
        if mesh_name(run) != coarsest and reference is not None:
            passes = [r.columns("iterations.csv")["outer_iterations"] for r in (reference, run)]
            count = min(len(p) for p in passes)
            found.append(Growth(run, count, *(float(p[:count].mean()) for p in passes)))
    return Table("coupling_growth", "Coupling iterations against the mesh, over the same steps", columns, found)


class Agreement(NamedTuple):
    """Difference of a scheme's run from the longest monolithic one of its mesh and case."""

    run: StudyRun
    levels: int  # time levels in common
    difference: Optional[float]  # largest relative difference of the pressure

    @property
    def shown(self) -> str:
        return f"{fixed(self.difference, '.1e')} ({self.run.passes:.1f})" if self.run.done else self.run.status


def agreements(runs: Sequence[StudyRun]) -> List[Agreement]:
    """Agreement of the schemes with the monolithic runs, scheme by scheme."""
    schemes = [run for run in runs if run.request.method.program != MONOLITHIC]
    shown = places(schemes)
    return [_agreement(own[p], runs) for _, own in by_scheme(schemes) for p in shown if p in own]


def _agreement(run: StudyRun, runs: Sequence[StudyRun]) -> Agreement:
    whole = [m for m in runs if m.request.method.program == MONOLITHIC and place_of(m) == place_of(run) and m.done]
    if not whole or not run.done:
        return Agreement(run, 0, None)
    over_time = largest_difference(max(whole, key=lambda m: m.steps).pressure, run.pressure)
    return Agreement(run, over_time.levels, over_time.largest.max_relative if over_time.largest else None)


AGREEMENTS: Sequence[Column[Agreement]] = (
    Column(csv="scheme", value=lambda a: a.run.request.method.name),
    Column(csv="mesh", value=lambda a: mesh_name(a.run)),
    Column(csv="case", value=lambda a: a.run.request.case),
    Column(csv="tolerance", value=lambda a: a.run.request.settings.get("partitioned.tolerance")),
    Column(csv="common_levels", value=lambda a: a.levels),
    Column(csv="iterations_per_step", value=lambda a: a.run.passes if a.run.done else None),
    Column(csv="largest_relative_difference", value=lambda a: a.difference),
    Column(csv="status", value=lambda a: a.run.status),
)


def agreement_table(runs: Sequence[StudyRun]) -> Table:
    """A line per scheme, a column per mesh and material: difference (iterations per step)."""

    def column(place: Place) -> Column[Dict[Place, Agreement]]:
        return Column(
            MATERIALS.get(place[1], place[1]),
            value=lambda row: row[place].shown if place in row else "",
            group=place[0],
        )

    schemes = [run for run in runs if run.request.method.program != MONOLITHIC]
    tolerances = sorted({show(run.request.settings.get("partitioned.tolerance", "?")) for run in schemes})
    found, shown = agreements(runs), places(schemes)
    rows: Dict[str, Dict[Place, Agreement]] = {}
    for a in found:
        rows.setdefault(a.run.request.method.name, {})[place_of(a.run)] = a
    return Table(
        "coupling_agreement",
        f"Relative difference to the monolithic pressure at tolerance {', '.join(tolerances)} (iterations per step)",
        [Column("scheme", value=lambda row: next(iter(row.values())).run.method_label, left=True), *map(column, shown)],
        list(rows.values()),
        Facts(AGREEMENTS, found),
        [
            f"{mesh}: time levels compared {', '.join(map(str, _levels(found, mesh)))}."
            for mesh in dict.fromkeys(mesh for mesh, _ in shown)
        ],
    )


def _levels(found: Sequence[Agreement], mesh: str) -> List[int]:
    return sorted({a.levels for a in found if mesh_name(a.run) == mesh and a.levels})


class Saving(NamedTuple):
    """Part that a monolithic run saves of another, per step: 1 - monolithic/partitioned."""

    whole: Cost
    cost: Cost

    @property
    def seconds(self) -> Optional[float]:
        return share(self.whole.seconds_per_step, self.cost.seconds_per_step)

    @property
    def solves(self) -> Optional[float]:
        return share(*(sum(cost.solves.values()) / cost.steps for cost in self))

    @property
    def linear(self) -> Optional[float]:
        return share(*(cost.linear / cost.steps for cost in self))


def share(whole: float, parts: float) -> Optional[float]:
    return 1 - whole / parts if parts else None


def percent(value: float) -> str:
    return f"{100 * value:.0f}"


SAVED = "saved by the monolithic driver, %"
SAVINGS: Sequence[Column[Saving]] = (
    Column("scheme", "scheme", lambda s: s.cost.label, left=True),
    Column("seconds", "seconds_saved", lambda s: s.seconds, percent, group=SAVED),
    Column("linear solves", "linear_solves_saved", lambda s: s.solves, percent, group=SAVED),
    Column("linear iterations", "linear_iterations_saved", lambda s: s.linear, percent, group=SAVED),
)


def saving_table(runs: Sequence[StudyRun], costs: Sequence[Cost], stem: str, title: str) -> Optional[Table]:
    """What the cheapest monolithic run saves of each partitioned one. The paper counts "almost 50 %"."""
    whole = [cost for run, cost in zip(runs, costs) if run.request.method.program == MONOLITHIC]
    if not whole:
        return None
    best = min(whole, key=lambda cost: cost.seconds_per_step)
    return Table(
        stem,
        title,
        SAVINGS,
        [Saving(best, cost) for run, cost in zip(runs, costs) if run.request.method.program != MONOLITHIC],
        notes=[
            "Negative: the monolithic driver takes more. A linear solve of the whole system counts as one, "
            "like one of the fluid, the wall or the mesh motion."
        ],
    )
