"""The gallery's page: what each scene is, what is known of it, what both drivers make of it and what that costs."""

from os.path import normpath
from pathlib import Path
from typing import Any, Mapping, Sequence

from ..reporting.column import Column, work_column
from ..reporting.layout import Table
from ..reporting.report import Report
from ..results.run import RunResults
from ..runs.coupling import coupling_kind
from ..runs.work_units import NOTE, per_step
from .mesh_chain import as_typed, with_places
from .running import Outcome
from .scene import Number, Scene, SceneRun, SceneRuns


def write_page(folder: Path, outcomes: Sequence[Outcome], quick: bool, at_once: int) -> tuple[Report, list[Number]]:
    """Writes the page; also what was measured, of all scenes. A scene of which a run failed says so."""
    report = Report(folder, "fsi-duo: gallery" + (", short form" if quick else ""))
    report.text(
        "Each scene is a folder of `gallery/` with a case file, what its mesh is made from, and a number that is known. "
        "Scenes with fluid and wall are run by both drivers from the same case file, others by one; one thread each. "
        '"Differs by" is relative to the known value, or to the scale that the scene gives: phases to 1 rad, leads to '
        "90 degrees, the lift of FSI1 to its drag."
    )
    measured: list[Number] = []
    for outcome in outcomes:
        measured += _scene(report, outcome, quick, at_once)
    report.write()
    return report, measured


def _scene(report: Report, outcome: Outcome, quick: bool, at_once: int) -> list[Number]:
    scene = outcome.scene
    stem = scene.name.replace("-", "_")
    report.section(scene.title)
    report.text(*scene.paragraphs)
    place = scene.place
    commands = _mesh_commands(scene, place, quick)
    settings = "".join(f" --set {name}={value}" for name, value in (scene.quick if quick else {}).items())
    commands += [
        f"{program} {place}/{scene.name}.toml --set mesh.file={scene.name}.msh{settings} "
        f"-o {scene.name}-{program.removeprefix('fsi-')}"
        for program in scene.drivers
    ]
    report.list([f"`{command}`" for command in commands])
    for program, failure in outcome.failures.items():
        report.text(f"**{program} failed:** {failure}")
    runs = SceneRuns({name: outcome.runs[name] for name in scene.drivers if name in outcome.runs}, quick)
    if outcome.failures:
        return []
    add_still(report, f"{stem}_vessel", runs.first.results, getattr(scene.module, "STILL", {}), scene.at_rest)
    report.figure(stem, lambda: scene.module.draw(runs), scene.title + ".")
    numbers = scene.numbers(runs)
    report.table(Table(f"{stem}_numbers", "What is known", NUMBERS, numbers))
    programs = {1: "one program", 2: "two programs"}.get(at_once, f"{at_once} programs")
    notes = [f"Seconds of the whole program with one thread, {programs} at a time."]
    if any(per_step(run.summary) is not None for run in outcome.runs.values()):
        notes.append(NOTE)
    report.table(Table(f"{stem}_cost", "What it costs", COSTS, list(outcome.runs.items()), notes=notes))
    return numbers


def _mesh_commands(scene: Scene, place: str, quick: bool) -> list[str]:
    """The commands as a user would type them in the sources' folder."""
    words = scene.mesh_words(quick)
    pairs = zip(words, with_places(words, scene.folder))
    named = [normpath(f"{place}/{word}") if full != word else word for word, full in pairs]
    return as_typed(named, Path(f"{scene.name}.msh"), place)


def add_still(report: Report, stem: str, run: RunResults, asked: Mapping[str, Any], at_rest: bool = False) -> None:
    """Adds the geometry with a result on it: what the scene asks for in STILL (keywords of RunResults.picture), else
    its first quantity when it is largest, with a visible displacement. Adds nothing for a run without fields. `at_rest`: the
    times are shares of a load."""
    if not run.fields:
        return
    key = asked.get("field", run.scene.first)
    run.scene.check(key)
    words: dict[str, Any] = {"time": run.scene.peak(key), "factor": run.scene.visible_factor(), **asked}
    caption = run.scene.quantity(key).words
    when = f"{100 * words['time']:g} % of the load" if at_rest else f"{words['time']:g} ms"
    report.still(stem, lambda: run.picture(**words), f"{caption[0].upper()}{caption[1:]} at {when}.")


def differs(number: Number) -> str:
    return percent(number.error) + ("" if number.holds else " (!)")


def percent(share: float) -> str:
    return f"{100 * share:.2g} %"


def total(run: SceneRun, name: str) -> Any:
    return run.summary.get("totals", {}).get(name)


NUMBERS: Sequence[Column[Number]] = (
    Column(
        "quantity", "quantity", lambda n: n.what, text=lambda n: f"{n.what} [{n.unit}]" if n.unit else n.what, left=True
    ),
    Column(csv="unit", value=lambda n: n.unit),
    Column("driver", "program", lambda n: n.program, lambda name: name.removeprefix("fsi-"), left=True),
    Column("known from", "source", lambda n: n.source, left=True),
    Column("value", "value", lambda n: n.value, ".5g"),
    Column("known", "reference", lambda n: n.reference, ".5g"),
    Column("differs by", "relative_error", lambda n: n.error, text=differs),
    Column("may by", "tolerance", lambda n: n.tolerance, percent),
)

# Of (program, its run).
COSTS: Sequence[Column[tuple[str, SceneRun]]] = (
    Column("driver", "program", lambda r: r[0], left=True, text=lambda r: r[1].words),
    Column(csv="coupling_kind", value=lambda r: coupling_kind(r[1].summary), behind=True),
    Column("unknowns", "unknowns", lambda r: r[1].summary.get("unknowns", {}).get("coupled")),
    Column("steps", "steps", lambda r: total(r[1], "steps")),
    work_column("work units per step", "work_units_per_step", lambda r: per_step(r[1].summary)),
    Column("seconds", "seconds", lambda r: r[1].seconds, ".2f"),
    Column("Newton iterations", "newton_iterations", lambda r: total(r[1], "newton_iterations")),
    Column("passes", "passes", lambda r: total(r[1], "outer_iterations") if r[0] == "fsi-partitioned" else None),
)
