"""Kind `references`: scenes of the gallery whose numbers are known, exactly or from publications. A family of runs
about each scene, as that of `fsi-compare verify`, gives the numbers their error bars, by each driver."""

from dataclasses import dataclass
from typing import Dict, List, Sequence, Tuple

from matplotlib.figure import Figure

from fsi_compare.base.errors import InputError
from fsi_compare.reporting.column import Column
from fsi_compare.reporting.layout import Table
from ..drawing.log_axes import plain_log_axis
from fsi_compare.study.context import Context
from fsi_compare.study.section import Section
from fsi_compare.study.study_file import Study
from ..catalogue.report_section import report_of
from fsi_compare.study.study_run import StudyRun
from fsi_compare.verify.family import Member, members, mesh_ratio
from ..evidence.scene_family import require_scenes, scene_family
from .record import Record, Score, records

SCENE_KEYS = ("levels", "finer")
LEVELS = 3


@dataclass(frozen=True)
class Plan:
    """How many meshes a scene's family has, and whether one is finer than the scene's own."""

    case: str
    levels: int
    finer: bool


def check(study: Study) -> None:
    plans(study)


def plans(study: Study) -> List[Plan]:
    """Raises InputError naming the key."""
    section = report_of(study, ("scenes",)).table("scenes")
    require_scenes(study)
    for name in section:
        if name not in study.cases:
            raise InputError(study.path, f"report.scenes.{name}", "is no case", "name one of [cases], or leave it out")
    found = []
    for case in study.cases:
        entry = Section(study.path, f"report.scenes.{case}", section.get(case, {}), SCENE_KEYS)
        finer = entry.entries.get("finer", False)
        if not isinstance(finer, bool):
            raise entry.wrong("finer", f"{finer} is neither true nor false", "leave it out for false")
        found.append(Plan(case, entry.count("levels", LEVELS), finer))
    return found


def evaluate(context: Context) -> int:
    found: List[Record] = []
    missing: List[str] = []
    for plan in plans(context.study):
        of_scene, lacks = _scene(context, plan)
        found += of_scene
        missing += lacks
    _report(context, found, missing)
    return 2 if missing else 0


def _scene(context: Context, plan: Plan) -> Tuple[List[Record], List[str]]:
    family = scene_family(context, plan.case)
    recipe, requests = family.recipe, family.requests
    ratio = mesh_ratio(recipe, plan.levels, plan.finer)
    wanted = members(recipe, family.facts, ratio, plan.levels, plan.finer)
    done: Dict[str, Dict[Member, StudyRun]] = {}
    lacks: List[str] = []
    for name in requests.methods:
        runs = dict(zip(wanted, context.runner.run([requests.of(member, name) for member in wanted])))
        lacks += [f"{plan.case}, {name}, {m.name}: {r.status}, {r.message}" for m, r in runs.items() if not r.done]
        done[requests.methods[name].program] = {member: run for member, run in runs.items() if run.done}
    try:
        return records(family.scene, family.facts, done), lacks
    except Exception as error:  # whatever the scene's text does with a coarse run
        return [], [*lacks, f"{plan.case}: its numbers cannot be read: {type(error).__name__}: {error}"]


RECORDS: Sequence[Column[Record]] = (
    Column("scene", "scene", lambda r: r.scene, left=True),
    Column("number", "number", lambda r: r.number.what, left=True),
    Column("unit", "unit", lambda r: r.number.unit, left=True),
    Column("driver", "driver", lambda r: r.number.program[len("fsi-") :], left=True),
    Column("value", "value", lambda r: r.number.value, ".6g"),
    Column("bar", "bar", lambda r: r.bar.total if r.bar.given else None, ".1e"),
    Column("order in the mesh", "order_mesh", lambda r: r.bar.mesh.order, ".2f"),
    Column("in the step", "order_step", lambda r: r.bar.step.order, ".2f"),
    Column("known", "known", lambda r: r.number.reference, ".6g"),
    Column("differs by", "off", lambda r: r.off, ".1e"),
    Column("in bars", "in_bars", lambda r: r.in_bars, ".2f"),
    Column("published values differ by [%]", "spread", lambda r: 100 * r.number.spread or None, ".2g"),
    Column("another model is worth [%]", "model", lambda r: 100 * r.number.model or None, ".2g"),
    Column("verdict", "verdict", lambda r: r.bar.verdict, left=True),
    Column("known from", "source", lambda r: r.number.source, left=True),
    Column("seconds", "seconds", lambda r: r.seconds, ".2g"),
    Column("why it differs", "reason", lambda r: r.number.reason, left=True),
)


def _report(context: Context, found: Sequence[Record], missing: Sequence[str]) -> None:
    report = context.report
    report.answer(_answer(Score(found)))
    report.section("Known numbers")
    report.list([f"**missing**: {one}" for one in missing])
    report.text(
        "Each number is that of the scene's own case and mesh. Its bar is made by `fsi-compare verify`'s rules from coarser and, "
        "where the study says so, finer runs of the same driver. Orders are observed; a dash: none was, since differences are "
        "below what can be seen, or swing. `in bars` is the difference from the known value over the bar; at most 1 is asked. "
        "Seconds are of the time steps of the scene's own run."
    )
    if found:
        report.figure(
            "references",
            lambda: picture(found),
            "Difference from the known value (mark) and bar (line), larger of the drivers. A square lies beyond its line: it is off "
            "by more than its bar.",
        )
    table = Table("references", "Known numbers", RECORDS, found)
    report.table(table)
    if not context.runner.quiet:
        print(table.text())


def _answer(score: Score) -> List[str]:
    if not score.given:
        return ["No number has a bar."]
    exact = [one for one in score.given if not one.number.spread and not one.number.model]
    lines = [
        f"Of {len(score.records)} known numbers, each by each driver that knows the scene, {len(score.given)} have a bar.",
        f"{len(score.held)} of these differ from what is known by no more than it, with the spread of published values and "
        "what their model is worth where it is another one.",
    ]
    if exact:
        held = sum(one.holds for one in exact)
        lines.append(f"Where nothing says that the known value is uncertain, {held} of {len(exact)} do.")
    beyond = [one for one in score.given if not one.holds]
    for one in sorted(beyond, key=lambda r: -(r.beyond or 0))[:5]:
        lines.append(
            f"Furthest off: {one.scene}, {one.number.what}, {one.number.program}: {one.in_bars:.1f} bars, "
            f"{100 * one.relative(one.off):.2g} %."
        )
    return lines


def picture(found: Sequence[Record]) -> Figure:
    """The larger difference of both drivers."""
    worst: Dict[Tuple[str, str], Record] = {}
    for one in found:
        key = (one.scene, one.number.what)
        if one.bar.given and (key not in worst or one.off > worst[key].off):
            worst[key] = one
    rows = list(worst.values())[::-1]
    figure = Figure(figsize=(7.2, 1.2 + 0.19 * len(rows)), layout="constrained")
    axes = figure.add_subplot()
    least = 1e-4  # %
    for y, one in enumerate(rows):
        axes.plot([least, max(least, 100 * one.relative(one.bar.total))], [y, y], color="0.65", linewidth=4)
        inside = one.holds
        face = "black" if inside else "white"
        axes.plot(max(least, 100 * one.relative(one.off)), y, "o" if inside else "s", color="black", mfc=face, ms=4)
    axes.set_xscale("log")
    axes.set_yticks(range(len(rows)), [f"{one.scene}: {one.number.what}" for one in rows], fontsize=7)
    axes.set_ylim(-1, len(rows))
    axes.set_xlabel("relative to the known value")
    plain_log_axis(axes.xaxis, "%")
    return figure
