"""Kind `scenes`: scenes of the gallery by both drivers, side by side in one table: what they compute, what is published,
and what that costs."""

from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

from ..base.errors import InputError
from ..base.files import read_toml
from ..base.progress import duration
from ..gallery.scene import Number, Scene, SceneRun, SceneRuns
from ..reporting.layout import Table, fixed
from ..runs.columns import ITERATIONS
from ..runs.work_units import shown
from .running.context import Context
from .running.study_file import Study
from .running.study_run import StudyRun

SHORT = {"fsi-monolithic": "monolithic", "fsi-partitioned": "partitioned"}
COUNTED = {"fsi-monolithic": "Newton iterations a step", "fsi-partitioned": "passes a step"}
OF_A_DRIVER = ("computed", "off by", "work units a step", "seconds")


@dataclass(frozen=True)
class Measured:
    """A scene with its runs by program, and the numbers of those that came to their end."""

    scene: Scene
    runs: Mapping[str, StudyRun]
    numbers: Sequence[Number]

    def quantities(self) -> List[Number]:
        """One of each, whatever the program."""
        return list({number.what: number for number in self.numbers}.values())

    def number(self, what: str, program: str) -> Optional[Number]:
        return next((n for n in self.numbers if n.what == what and n.program == program), None)


def check(study: Study) -> None:
    met = set()
    for request in study.requests:
        if request.case not in study.scenes:
            raise InputError(
                study.path, f"cases.{request.case}", "is no scene", 'name a scene of the gallery: { scene = "NAME" }'
            )
        place = (request.case, request.method.program)
        if place in met:
            raise InputError(
                study.path, f"runs.{request.group}", f"has two runs of {', '.join(place)}", "list each pair once"
            )
        met.add(place)


def evaluate(context: Context) -> int:
    report, quick = context.report, context.study.quick
    measured = [_measure(scene, _runs_of(context, case), quick) for case, scene in context.study.scenes.items()]
    measured = [m for m in measured if m.runs]
    numbers = [number for m in measured for number in m.numbers]
    wrong = [number for number in numbers if not number.holds]
    broken = [run for m in measured for run in m.runs.values() if not run.done]

    report.section("In short")
    report.text(
        f"{len(measured)} scenes, each by the drivers that run it, from one case file and on one mesh. "
        f"{len(numbers) - len(wrong)} of {len(numbers)} numbers are as near to what is published as they are asked to be."
        + (" Those that are not are marked (!)." if wrong else "")
    )
    report.text("Pages of the short scenes are in the gallery, those of the long ones below.")
    report.list([f"**{run.request.label}**: {run.status}, {run.message}" for run in broken])
    table = scenes_table(measured)
    report.table(table)
    if not context.runner.quiet:
        print(table.text())
    for m in measured:
        if m.scene.long:
            _section(context, m)
    return 2 if broken or wrong else 0


def _runs_of(context: Context, case: str) -> Dict[str, StudyRun]:
    return {run.request.method.program: run for run in context.select(case=case)}


def _measure(scene: Scene, runs: Mapping[str, StudyRun], quick: bool) -> Measured:
    shown = _finished(runs, quick)
    return Measured(scene, runs, scene.numbers(shown) if shown.runs else [])


def _finished(runs: Mapping[str, StudyRun], quick: bool) -> SceneRuns:
    done = {name: SceneRun(run.folder, name, run.summary, run.seconds) for name, run in runs.items() if run.done}
    return SceneRuns(done, quick)


def _section(context: Context, measured: Measured) -> None:
    context.report.section(measured.scene.title)
    context.report.text(*measured.scene.paragraphs)
    runs = _finished(measured.runs, context.study.quick)
    if runs.runs:
        stem = measured.scene.name.replace("-", "_")
        context.report.figure(stem, lambda: measured.scene.module.draw(runs), measured.scene.title + ".")


def scenes_table(measured: Sequence[Measured]) -> Table:
    """A row for each quantity; what a run cost stands in the first of its scene."""
    table = Table(
        stem="scenes",
        title="Computed and published",
        left=2,
        columns=[
            ("", "scene"),
            ("", "quantity"),
            ("", "published"),
            ("", "codes differ by"),
            ("", "may be off by"),
            *((SHORT[program], name) for program in SHORT for name in (*OF_A_DRIVER, COUNTED[program])),
            ("", "nodes"),
            ("", "step [ms]"),
            ("", "steps"),
        ],
        csv_columns=[
            *("scene", "quantity", "unit", "program", "value", "published", "relative_error", "tolerance"),
            *("spread_of_codes", "source", "nodes", "step_ms", "steps", "seconds", "iterations_per_step"),
            "work_units_per_step",
        ],
        notes=[
            "Codes differ by: the spread of published amplitudes, where one is known. Off by: of the value; of a mean, of "
            "the amplitude where that is larger; (!): by more than asked.",
            "Seconds of the whole program with the threads of the study; other runs at the same time lengthen them. Where "
            "there is one medium, nothing is coupled and both programs do the same.",
        ],
    )
    for m in measured:
        for row, known in enumerate(m.quantities()):
            cells = [_title(m.scene) if row == 0 else "", known.what + (f" [{known.unit}]" if known.unit else "")]
            cells += [f"{known.reference:.6g}", _percent(known.spread), _percent(known.tolerance)]
            for program in SHORT:
                cells += _driver_cells(m, known.what, program, row == 0)
            cells += _size(m) if row == 0 else ["", "", ""]
            table.rows.append(cells)
        table.csv_rows += [_facts(m, number) for number in m.numbers]
    return table


def _title(scene: Scene) -> str:
    return scene.title.partition(":")[0]


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %" if share else ""


def _driver_cells(m: Measured, what: str, program: str, first: bool) -> List[str]:
    number, run = m.number(what, program), m.runs.get(program)
    cost = ["", "", ""]
    if first and run is not None:
        work = shown(run.work_units_per_step)
        cost = [work, duration(run.seconds), fixed(run.passes, ".2f")] if run.done else ["", run.status, ""]
    if number is None:
        return ["", "", *cost]
    return [f"{number.value:.5g}", f"{100 * number.error:.2g} %" + ("" if number.holds else " (!)"), *cost]


def _size(m: Measured) -> List[str]:
    nodes, step, steps = _counts(m)
    return [
        "" if nodes is None else str(nodes),
        "" if step is None else f"{step:g}",
        "" if steps is None else str(steps),
    ]


def _counts(m: Measured) -> Tuple[Optional[int], Optional[float], Optional[int]]:
    """Nodes of the mesh, the mean length of the steps in ms where there is time, and their number."""
    run = next((run for run in m.runs.values() if run.done), None)
    if run is None:
        return None, None, None
    ends = run.columns(ITERATIONS)["time_ms"]
    step = None if "static" in read_toml(m.scene.case, "", "") else float(ends[-1]) / len(ends)
    return run.summary["mesh"]["nodes"], step, run.steps


def _facts(m: Measured, number: Number) -> List[Any]:
    run = m.runs[number.program]
    nodes, step, steps = _counts(m)
    known = (number.what, number.unit, number.program, number.value, number.reference, number.error, number.tolerance)
    source, cost = (number.spread or None, number.source), (run.seconds, run.passes, run.work_units_per_step)
    return [m.scene.name, *known, *source, nodes, step, steps, *cost]
