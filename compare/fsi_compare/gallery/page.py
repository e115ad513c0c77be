"""The gallery's page: what each scene is, what is known of it, what both drivers make of it and what that costs."""

from os.path import normpath
from pathlib import Path
from typing import List, Sequence, Tuple

from ..reporting.layout import Table
from ..reporting.report import Report
from ..runs.work_units import NOTE, per_step, shown
from .running import Outcome
from .scene import Number

TITLE = "fsi-duo: gallery"


def write_page(folder: Path, outcomes: Sequence[Outcome], quick: bool, at_once: int) -> Tuple[Report, List[Number]]:
    """Writes the page; also what was measured, of all scenes. A scene of which a run failed says so."""
    report = Report(folder, TITLE + (", short form" if quick else ""))
    report.text(
        "Each scene is a folder of `gallery/` with a case file, what its mesh is made from, and a number that is known. "
        "Both drivers run it from the same case file, with one thread each."
    )
    measured: List[Number] = []
    for outcome in outcomes:
        measured += _scene(report, outcome, quick, at_once)
    report.write()
    return report, measured


def _scene(report: Report, outcome: Outcome, quick: bool, at_once: int) -> List[Number]:
    scene = outcome.scene
    stem = scene.name.replace("-", "_")
    report.section(scene.title)
    report.text(*scene.paragraphs)
    place = f"gallery/{scene.name}"
    words = [normpath(f"{place}/{word}") if word.endswith(".geo") else word for word in scene.mesh_words(quick)]
    commands = [f"fsi-mesh {' '.join(words)} -o {scene.name}.msh"]
    settings = "".join(f" --set {name}={value}" for name, value in (scene.quick if quick else {}).items())
    commands += [
        f"{program} {place}/{scene.name}.toml --set mesh.file={scene.name}.msh{settings} "
        f"-o {scene.name}-{program.removeprefix('fsi-')}"
        for program in scene.drivers
    ]
    report.list([f"`{command}`" for command in commands])
    for program, failure in outcome.failures.items():
        report.text(f"**{program} failed:** {failure}")
    runs = outcome.finished(quick)
    if outcome.failures:
        return []
    report.figure(stem, lambda: scene.module.draw(runs), scene.title + ".")
    numbers = scene.numbers(runs)
    report.table(_numbers_table(stem, numbers))
    report.table(_cost_table(stem, outcome, at_once))
    return numbers


def _numbers_table(stem: str, numbers: Sequence[Number]) -> Table:
    table = Table(
        stem=f"{stem}_numbers",
        title="What is known",
        columns=[("", name) for name in ("quantity", "driver", "known from", "value", "known", "differs by", "may by")],
        csv_columns=("quantity", "unit", "program", "source", "value", "reference", "relative_error", "tolerance"),
        left=3,
    )
    for n in numbers:
        unit = f" [{n.unit}]" if n.unit else ""
        mark = "" if n.holds else " (!)"
        table.rows.append(
            (
                n.what + unit,
                n.program.removeprefix("fsi-"),
                n.source,
                f"{n.value:.5g}",
                f"{n.reference:.5g}",
                f"{100 * n.error:.2g} %{mark}",
                f"{100 * n.tolerance:.2g} %",
            )
        )
        table.csv_rows.append((n.what, n.unit, n.program, n.source, n.value, n.reference, n.error, n.tolerance))
    return table


def _cost_table(stem: str, outcome: Outcome, at_once: int) -> Table:
    programs = {1: "one program", 2: "two programs"}.get(at_once, f"{at_once} programs")
    table = Table(
        stem=f"{stem}_cost",
        title="What it costs",
        columns=[
            ("", name)
            for name in ("driver", "unknowns", "steps", "work units per step", "seconds", "Newton iterations", "passes")
        ],
        csv_columns=("program", "unknowns", "steps", "seconds", "newton_iterations", "passes", "work_units_per_step"),
        notes=[f"Seconds of the whole program with one thread, {programs} at a time."],
    )
    for program, run in outcome.runs.items():
        totals = run.summary.get("totals", {})
        steps, newton = totals.get("steps"), totals.get("newton_iterations")
        passes = totals.get("outer_iterations") if program == "fsi-partitioned" else None
        unknowns = run.summary.get("unknowns", {}).get("coupled")
        work = per_step(run.summary)
        whole = ["-" if c is None else f"{c}" for c in (unknowns, steps, newton, passes)]
        table.rows.append((program.removeprefix("fsi-"), *whole[:2], shown(work), f"{run.seconds:.2f}", *whole[2:]))
        table.csv_rows.append((program, unknowns, steps, run.seconds, newton, passes, work))
    if any(per_step(run.summary) is not None for run in outcome.runs.values()):
        table.notes.append(NOTE)
    return table
