"""Kind `scenes`: scenes of the gallery by both drivers, side by side in one table: what they compute, what is
published, and what that costs."""

from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple

from fsi_compare.base.errors import InputError
from fsi_compare.base.files import read_toml
from fsi_compare.starting.duration import duration
from fsi_compare.gallery.scene import Number, Scene, SceneRun, SceneRuns
from fsi_compare.reporting.column import Column, Facts, fixed
from fsi_compare.reporting.layout import Table
from fsi_compare.runs.columns import ITERATIONS
from fsi_compare.runs.coupling import chosen_scheme, coupling_kind
from fsi_compare.runs.work_units import shown
from fsi_compare.study.context import Context
from fsi_compare.study.study_file import Study
from fsi_compare.study.study_run import StudyRun

SHORT = {"fsi-monolithic": "monolithic", "fsi-partitioned": "partitioned"}
COUNTED = {"fsi-monolithic": "Newton iterations a step", "fsi-partitioned": "passes a step"}


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
    return {run.request.method.program: run for run in context.runs if run.request.case == case}


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


class Row(NamedTuple):
    """A quantity of a scene; what a run cost stands in the first of its scene."""

    measured: Measured
    known: Number
    first: bool

    def number(self, program: str) -> Optional[Number]:
        return self.measured.number(self.known.what, program)

    def run(self, program: str) -> Optional[StudyRun]:
        return self.measured.runs.get(program) if self.first else None

    def off_by(self, program: str) -> str:
        number = self.number(program)
        return "" if number is None else f"{100 * number.error:.2g} %" + ("" if number.holds else " (!)")

    def work_units(self, program: str) -> str:
        run = self.run(program)
        return shown(run.work_units_per_step) if run is not None and run.done else ""

    def seconds(self, program: str) -> str:
        run = self.run(program)
        return "" if run is None else duration(run.seconds) if run.done else run.status

    def kind(self, program: str) -> str:
        """Kind of coupling with its scheme."""
        run = self.run(program)
        known = (coupling_kind(run.summary), chosen_scheme(run.summary)) if run is not None else ()
        return ", ".join(word for word in known if word)

    def passes(self, program: str) -> str:
        run = self.run(program)
        return fixed(run.passes, ".2f") if run is not None and run.done else ""

    def size(self, place: int) -> Any:
        return counts(self.measured)[place] if self.first else None


def _of_driver(program: str) -> List[Column[Row]]:
    def value(row: Row) -> Optional[float]:
        number = row.number(program)
        return None if number is None else number.value

    group = SHORT[program]
    kind: Column[Row] = Column("kind of coupling", value=lambda row: row.kind(program), group=group, left=True)
    return [
        *([kind] if program == "fsi-partitioned" else []),
        Column("computed", value=value, format=".5g", group=group, missing=""),
        Column("off by", value=lambda row: row.off_by(program), group=group),
        Column("work units a step", value=lambda row: row.work_units(program), group=group),
        Column("seconds", value=lambda row: row.seconds(program), group=group),
        Column(COUNTED[program], value=lambda row: row.passes(program), group=group),
    ]


ROWS: Sequence[Column[Row]] = (
    Column("scene", value=lambda row: _title(row.measured.scene) if row.first else "", left=True),
    Column(
        "quantity", value=lambda row: row.known.what + (f" [{row.known.unit}]" if row.known.unit else ""), left=True
    ),
    Column("published", value=lambda row: row.known.reference, format=".6g"),
    Column("codes differ by", value=lambda row: _percent(row.known.spread)),
    Column("may be off by", value=lambda row: _percent(row.known.tolerance)),
    *(column for program in SHORT for column in _of_driver(program)),
    Column("nodes", value=lambda row: row.size(0), missing=""),
    Column("step [{unit}]", unit="ms", value=lambda row: row.size(1), format="g", missing=""),
    Column("steps", value=lambda row: row.size(2), missing=""),
)
NUMBERS: Sequence[Column[Tuple[Measured, Number]]] = (
    Column(csv="scene", value=lambda r: r[0].scene.name),
    Column(csv="quantity", value=lambda r: r[1].what),
    Column(csv="unit", value=lambda r: r[1].unit),
    Column(csv="program", value=lambda r: r[1].program),
    Column(csv="value", value=lambda r: r[1].value),
    Column(csv="published", value=lambda r: r[1].reference),
    Column(csv="relative_error", value=lambda r: r[1].error),
    Column(csv="tolerance", value=lambda r: r[1].tolerance),
    Column(csv="spread_of_codes", value=lambda r: r[1].spread or None),
    Column(csv="source", value=lambda r: r[1].source),
    Column(csv="nodes", value=lambda r: counts(r[0])[0]),
    Column(csv="step", unit="ms", value=lambda r: counts(r[0])[1]),
    Column(csv="steps", value=lambda r: counts(r[0])[2]),
    Column(csv="seconds", value=lambda r: r[0].runs[r[1].program].seconds),
    Column(csv="coupling_kind", value=lambda r: coupling_kind(r[0].runs[r[1].program].summary), behind=True),
    Column(csv="coupling_scheme", value=lambda r: chosen_scheme(r[0].runs[r[1].program].summary), behind=True),
    Column(csv="iterations_per_step", value=lambda r: r[0].runs[r[1].program].passes),
    Column(csv="work_units_per_step", value=lambda r: r[0].runs[r[1].program].work_units_per_step),
)


def scenes_table(measured: Sequence[Measured]) -> Table:
    """A row for each quantity; what a run cost stands in the first of its scene."""
    return Table(
        "scenes",
        "Computed and published",
        ROWS,
        [Row(m, known, i == 0) for m in measured for i, known in enumerate(m.quantities())],
        Facts(NUMBERS, [(m, number) for m in measured for number in m.numbers]),
        [
            "Codes differ by: the spread of published amplitudes, where one is known. Off by: of the value; of a mean, of "
            "the amplitude where that is larger; of the lift of FSI1, of its drag; (!): by more than asked.",
            "Seconds of the whole program with the threads of the study; other runs at the same time lengthen them. Where "
            "there is one medium, nothing is coupled and both programs do the same.",
        ],
    )


def _title(scene: Scene) -> str:
    return scene.title.partition(":")[0]


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %" if share else ""


def counts(m: Measured) -> Tuple[Optional[int], Optional[float], Optional[int]]:
    """Nodes of the mesh, the mean length of the steps in ms where there is time, and their number."""
    run = next((run for run in m.runs.values() if run.done), None)
    if run is None:
        return None, None, None
    ends = run.columns(ITERATIONS)["time_ms"]
    step = None if "static" in read_toml(m.scene.case, "", "") else float(ends[-1]) / len(ends)
    return run.summary["mesh"]["nodes"], step, run.steps
