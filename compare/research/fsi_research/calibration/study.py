"""Kind `calibration`: scenes of the gallery, families about their normal size and a coarser one, bars against the
truth."""

from dataclasses import dataclass
from typing import Dict, List, Mapping, Sequence, Tuple

from matplotlib.figure import Figure

from fsi_compare.base.errors import InputError
from fsi_compare.reporting.column import Column
from fsi_compare.reporting.layout import Table
from ..drawing.log_axes import log_axes
from fsi_compare.study.context import Context
from fsi_compare.study.study_file import Study
from ..catalogue.report_section import ReportSection, report_of
from fsi_compare.study.study_run import StudyRun
from fsi_compare.verify.family import STEP_RATIO, CaseFacts, Member, members
from fsi_compare.verify.mesh_family import Recipe, ratio_for
from ..evidence.scene_family import require_scenes, scene_family
from fsi_compare.verify.verdict import BAR_WIDENED, CONVERGES, NOT_IN_RANGE
from .record import Record, Score, records

SCENE_KEYS = ("reference", "trap", "skipped", "levels")
SIZES = ("normal", "coarse")
HELD, WIDTH = 0.95, 4.0  # what is asked of the bars: share that holds, median of bar over true error
LEVELS = 3
# Told apart by shape and, in grey, by lightness.
VERDICT_MARKS = {
    CONVERGES: {"marker": "o", "color": "black", "markersize": 4},
    BAR_WIDENED: {"marker": "o", "color": "#2c6fbb", "markerfacecolor": "none", "markersize": 5},
    NOT_IN_RANGE: {"marker": "x", "color": "0.65", "markersize": 4},
}


@dataclass(frozen=True)
class Plan:
    """How much finer a scene's reference is in mesh and step, and which difficulty the scene tests."""

    case: str
    reference: Tuple[float, float]
    trap: str
    skipped: Tuple[str, ...]
    levels: int


def check(study: Study) -> None:
    plans(study)


def plans(study: Study) -> List[Plan]:
    """Raises InputError naming the key."""
    section = report_of(study, ("scenes",)).table("scenes", True)
    require_scenes(study)
    found = []
    for case in study.cases:
        if case not in section:
            raise InputError(study.path, f"report.scenes.{case}", "is missing", "say reference = [MESH, STEP] there")
        entry = ReportSection(study.path, f"report.scenes.{case}", section[case], SCENE_KEYS)
        sizes = entry.numbers("reference")
        if len(sizes) != 2 or not all(0 < size <= 0.5 for size in sizes):
            remedy = "give two parts of the scene's own sizes, of elements and steps, of at most 0.5"
            raise entry.wrong("reference", "is no pair of sizes", remedy)
        skipped = tuple(str(word) for word in section[case].get("skipped", []))
        found.append(Plan(case, (sizes[0], sizes[1]), entry.text("trap", ""), skipped, entry.count("levels", LEVELS)))
    return found


@dataclass(frozen=True)
class Family:
    """Members about a centre, by their sizes relative to the scene's own."""

    size: str
    centre: Member
    members: Sequence[Member]


def families(recipe: Recipe, facts: CaseFacts, levels: int) -> List[Family]:
    """The family of normal size, and a coarser one whose finest member is the scene as it stands."""
    ratio = ratio_for(recipe.counts, [1, -1])
    found = []
    for size, power in zip(SIZES, (0, 1)):
        centre = Member(ratio**power, 1.0 if facts.static else STEP_RATIO**power)
        about = members(recipe, facts, ratio, levels, True)
        own = [Member(_same(m.mesh * centre.mesh), _same(m.step * centre.step), m.looser, m.other) for m in about]
        found.append(Family(size, centre, own))
    return found


def _same(size: float) -> float:
    """1 where it is 1 but for round-off, so that the scene's own run is one of them."""
    return 1.0 if abs(size - 1) < 1e-9 else round(size, 9)


def evaluate(context: Context) -> int:
    found: List[Record] = []
    missing: List[str] = []
    traps: Dict[str, str] = {}
    for plan in plans(context.study):
        traps[plan.case] = plan.trap
        of_scene, lacks = _scene(context, plan)
        found += of_scene
        missing += lacks
    _report(context, found, traps, missing)
    return 2 if missing else 0


def _scene(context: Context, plan: Plan) -> Tuple[List[Record], List[str]]:
    of_scene = scene_family(context, plan.case, ["monolithic"])
    facts, requests = of_scene.facts, of_scene.requests
    about = families(of_scene.recipe, facts, plan.levels)
    reference = Member(plan.reference[0], 1.0 if facts.static else plan.reference[1])
    wanted = list(dict.fromkeys([m for family in about for m in family.members] + [reference]))
    runs: Mapping[Member, StudyRun] = dict(
        zip(wanted, context.runner.run([requests.of(m, "monolithic") for m in wanted]))
    )
    lacks = [f"{plan.case}, {member.name}: {run.status}, {run.message}" for member, run in runs.items() if not run.done]
    if not runs[reference].done:
        return [], lacks
    known = of_scene.scene.known_curve
    found: List[Record] = []
    for family in about:
        of_family = {member: runs[member] for member in family.members}
        found += records(plan.case, family.size, facts, family.centre, of_family, runs[reference], plan.skipped, known)
    return found, lacks


RECORDS: Sequence[Column[Record]] = (
    Column("scene", "scene", lambda r: r.scene, left=True),
    Column("family", "family", lambda r: r.size, left=True),
    Column("quantity", "quantity", lambda r: r.quantity, left=True),
    Column("unit", "unit", lambda r: r.unit, left=True),
    Column("value", "value", lambda r: r.bar.value, ".6g"),
    Column("truth", "truth", lambda r: r.truth, ".6g"),
    Column("truth from", "truth_from", lambda r: "exact" if r.exact else "finer run", left=True),
    Column("true error", "true_error", lambda r: r.error, ".2e"),
    Column("bar", "bar", lambda r: r.bar.total if r.bar.given else None, ".2e"),
    Column("bar / error", "bar_by_error", lambda r: r.ratio if r.bar.given else None, ".2f"),
    Column("verdict", "verdict", lambda r: r.bar.verdict, left=True),
    Column(csv="scale", value=lambda r: r.bar.scale),
)


def _scores(traps: Mapping[str, str]) -> Sequence[Column[Score]]:
    return (
        Column("scene, family", "scene_family", lambda s: s.name, left=True),
        Column("quantities", "quantities", lambda s: len(s.records)),
        Column("with a bar", "given", lambda s: len(s.given)),
        Column("of these counted", "counted", lambda s: len(s.counted)),
        Column("held [%]", "held_percent", lambda s: None if s.held is None else 100 * s.held, ".1f"),
        Column("bar / error, median", "median", lambda s: s.median, ".2f"),
        Column("said to converge, off by more than two bars", "misled", lambda s: s.misled),
        Column("trap", "trap", lambda s: traps.get(s.name.partition(",")[0], ""), left=True),
    )


def _report(context: Context, found: Sequence[Record], traps: Mapping[str, str], missing: Sequence[str]) -> None:
    report = context.report
    whole = Score("all", found)
    report.answer(_answer(whole))
    report.section("Bars and true errors")
    report.list([f"**missing**: {one}" for one in missing])
    report.text(
        "Each family is judged as `fsi-compare verify` does. The truth is a run whose elements and steps are a fraction of the "
        "finest member's, which is no member, or the exact curve where the scene knows it. A bar holds where the run's value and the truth differ by no more than it."
    )
    report.figure(
        "calibration",
        lambda: scatter(found),
        "Bar against true error, both relative to the largest of the curve. Errors of at most 1e-4 % stand at the left edge: the "
        "truth is not known better, and these are not counted.",
    )
    keys = dict.fromkeys((r.scene, r.size) for r in found)
    rows = [Score(f"{s}, {z}", [r for r in found if (r.scene, r.size) == (s, z)]) for s, z in keys]
    table = Table("scores", "By scene", _scores(traps), [*rows, whole])
    report.table(table)
    report.section("All quantities")
    report.folded("All quantities", [Table("records", "All quantities", RECORDS, found)])
    if not context.runner.quiet:
        print(table.text())


def _answer(whole: Score) -> List[str]:
    if whole.held is None or whole.median is None:
        return ["No bar was given."]
    return [
        f"Of {len(whole.records)} quantities {len(whole.given)} have a bar. Of {len(whole.counted)} the true error can be seen; "
        f"the bar holds {100 * whole.held:.1f} % of these. Asked for are {100 * HELD:.0f} %.",
        f"In the median the bar is {whole.median:.2f} times the true error. At most {WIDTH:g} is asked for.",
        f"{whole.misled} of those that are said to converge are off by more than twice their bar.",
    ]


def scatter(found: Sequence[Record]) -> Figure:
    figure = Figure(figsize=(6.4, 5.2), layout="constrained")
    axes = figure.add_subplot()
    for verdict, mark in reversed(VERDICT_MARKS.items()):
        shown = [r for r in found if r.bar.verdict == verdict]
        x = [100 * r.known / r.bar.scale for r in shown]
        y = [100 * max(r.bar.total / r.bar.scale, 1e-7) for r in shown]
        axes.loglog(x, y, linestyle="none", label=verdict if shown else None, **mark)
    ends = [1e-4, 1e3]
    axes.loglog(ends, ends, color="black", linewidth=1, label="bar = error")
    axes.loglog(ends, [WIDTH * e for e in ends], color="black", linewidth=1, linestyle=":", label=f"{WIDTH:g} times")
    axes.set_xlabel("true error")
    axes.set_ylabel("error bar")
    log_axes(axes, "%", "%")
    axes.legend(fontsize="small")
    return figure
