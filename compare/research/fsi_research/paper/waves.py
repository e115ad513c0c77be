"""Pressure waves and cut tubes of the paper's study, in tables and pictures."""

from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.base.files import is_file
from ..catalogue.names import MATERIALS
from fsi_compare.study.mesh_levels import MESHES
from fsi_compare.reporting.column import Column, Facts
from fsi_compare.reporting.layout import Table
from fsi_compare.reporting.pictures import pressure_figure
from fsi_compare.reporting.player import Player
from fsi_compare.reporting.report import Report
from fsi_compare.reporting.run_player import panels
from fsi_compare.results.run import RunResults
from fsi_compare.runs.differences import largest_difference
from fsi_compare.runs.pressure_waves import PressureWaves, peak
from ..evidence import fields, tube_pictures
from ..evidence.mesh_error import MeshError, error_table, error_words, mesh_error
from fsi_compare.study.study_run import StudyRun
from .runs import MONOLITHIC, PARTITIONED, PICTURE_TIME, RESOLVED, STOPPED_EARLY, TIMES, PaperRuns, mesh_of, times_of

SEEN_APART = 1e-2  # of the largest pressure: curves nearer than this lie on each other in a picture


def peaks(waves: PressureWaves, times: Sequence[float] = TIMES) -> List[Optional[float]]:
    """Largest pressure along the line in Pa; None beyond the end of the run."""
    return [peak(waves.z, waves.at(time)).pressure if waves.covers(time) else None for time in times]


# ---- figures of the pressure along the centre line


def wave_errors(runs: PaperRuns) -> Dict[Path, MeshError]:
    """Errors by folder, of the runs that show the wave of a wall as it is."""
    return {run.folder: mesh_error(run) for run in shown_waves(runs)}


def shown_waves(runs: PaperRuns) -> List[StudyRun]:
    """One run for each wall and level of resolution: the drivers' waves are one wave where both are there."""
    waves = [runs.wave(material, mesh) for material in runs.materials for mesh in runs.meshes]
    return [run for run in waves if run] + runs.all(RESOLVED)


def three_walls(report: Report, runs: PaperRuns, errors: Mapping[Path, MeshError]) -> None:
    """The picture that the report opens with, and how far its waves are from the reference."""
    mesh = runs.finest
    found = [(material, runs.wave(material, mesh)) for material in runs.materials]
    together = [(material, run) for material, run in found if run]
    times = [time for time in TIMES if all(run.pressure.covers(time) for _, run in together)]
    if together and times:
        names = [MATERIALS[material] for material, _ in together]
        report.figure(
            "pressure_materials",
            lambda: pressure_figure([run.pressure for _, run in together], names, times, f"The walls, {mesh} mesh"),
            f"Pressure along the centre line of the tube, {mesh} mesh, at the times of the paper's figure. "
            + error_words([(name, errors[run.folder]) for name, (_, run) in zip(names, together)]),
        )
    waves = [run for run in shown_waves(runs) if run.folder in errors]
    if waves:
        report.table(error_table(waves, [errors[run.folder] for run in waves]))


def through_time(report: Report, runs: PaperRuns) -> None:
    """The waves of all walls by both drivers, for a reader who moves through them; the pictures are elsewhere."""
    mesh = runs.finest
    found = [
        (f"{MATERIALS[material]}, {name}", run)
        for material in runs.materials
        for name, method in (("monolithic", MONOLITHIC), ("partitioned", PARTITIONED))
        if (run := runs.wave(material, mesh, method)) is not None
    ]
    if found:
        results = [RunResults(run.folder, run.summary) for _, run in found]
        report.player(Player([name for name, _ in found], panels(results)))


def driver_pictures(report: Report, runs: PaperRuns, errors: Mapping[Path, MeshError]) -> None:
    """A picture for each wall whose waves both drivers have; the caption says how far they are apart."""
    mesh = runs.finest
    for material in runs.materials:
        found = [runs.wave(material, mesh, method) for method in (MONOLITHIC, PARTITIONED)]
        pair = [run for run in found if run]
        times = [time for time in times_of(material) if all(run.pressure.covers(time) for run in pair)]
        if len(pair) < 2 or not times:
            continue
        apart = _largest(pair[0].pressure, pair[1].pressure)
        lie = "The curves lie on each other" if apart < SEEN_APART else "The curves are apart"
        distance = f" {lie}: the largest difference is {apart:.1e} of the largest pressure of a time level."
        error = errors.get(pair[0].folder)
        report.figure(
            f"pressure_{material}",
            lambda: pressure_figure(
                [run.pressure for run in pair],
                ["monolithic", "partitioned"],
                times,
                f"{MATERIALS[material]}, {mesh} mesh",
            ),
            f"{MATERIALS[material]}: pressure along the centre line from both drivers, at the times of the paper's "
            "figure." + (distance if np.isfinite(apart) else "") + (f" {error_words([('', error)])}" if error else ""),
        )


# ---- both drivers beside each other


@dataclass(frozen=True)
class Agreement:
    material: str
    mesh: str
    start: float  # largest difference over the line, relative to the largest pressure of the time level, up to 1.5 ms
    all: float  # the same over all levels
    height: float  # largest ratio of the partitioned peak to the monolithic one, at TIMES


def agreements(runs: PaperRuns) -> List[Agreement]:
    found = []
    for material in runs.materials:
        for mesh in runs.meshes:
            one, other = (runs.wave(material, mesh, method) for method in (MONOLITHIC, PARTITIONED))
            if one and other:
                heights = [b / a for a, b in zip(peaks(one.pressure), peaks(other.pressure)) if a and b is not None]
                found.append(
                    Agreement(
                        material,
                        mesh,
                        _largest(one.pressure, other.pressure, 1.5),
                        _largest(one.pressure, other.pressure),
                        max(heights, default=float("nan")),
                    )
                )
    return found


def _largest(reference: PressureWaves, other: PressureWaves, until: float = np.inf) -> float:
    kept = reference.times <= until + reference.time_tolerance
    part = PressureWaves(reference.times[kept], reference.z, reference.pressure[kept])
    found = largest_difference(part, other).largest
    return found.max_relative if found and found.max_relative is not None else float("nan")


AGREEMENTS: Sequence[Column[Agreement]] = (
    Column("material", "material", lambda a: a.material, MATERIALS.__getitem__, left=True),
    Column("mesh", "mesh", lambda a: a.mesh, left=True),
    Column("until 1.5 ms", "max_relative_until_1_5_ms", lambda a: a.start, ".1e"),
    Column("all levels", "max_relative", lambda a: a.all, ".1e"),
)


def agreement_table(found: Sequence[Agreement]) -> Table:
    return Table(
        "agreement",
        "Partitioned against monolithic, largest relative difference of the pressure",
        AGREEMENTS,
        found,
        notes=["Interface tolerance 1e-6. Relative to the largest pressure of the same time level."],
    )


# ---- the interface iteration stopped early


@dataclass(frozen=True)
class Stopped:
    label: str
    passes: float  # coupling iterations a step, mean
    peaks: Sequence[Optional[float]]  # Pa, at TIMES
    ratios: Sequence[Optional[float]]  # to the monolithic peaks
    difference: float  # largest, relative


def stopped_early(runs: PaperRuns) -> Tuple[Optional[StudyRun], List[Stopped]]:
    """The monolithic run, and those that stop at looser tolerances, loosest first as in the study file."""
    loose = runs.all(STOPPED_EARLY)
    if not loose:
        return None, []
    first = loose[0].request
    levels = {mesh_of(run) for run in loose} - {""} or {"coarse"}
    reference = runs.wave(first.case, min(levels, key=list(MESHES).index))
    if reference is None:
        return None, []
    exact = peaks(reference.pressure)
    found = []
    for run in loose:
        own = peaks(run.pressure)
        ratios = [None if a is None or b is None else a / b for a, b in zip(own, exact)]
        found.append(
            Stopped(
                str(run.request.values.get("stop", run.request.label)),
                run.passes,
                own,
                ratios,
                _largest(reference.pressure, run.pressure),
            )
        )
    return reference, found


class Wave(NamedTuple):
    """A run that was stopped early, or the monolithic one, which has neither passes nor difference."""

    label: str
    passes: Optional[float]
    peaks: Sequence[Optional[float]]
    ratios: Sequence[Optional[float]]
    difference: Optional[float]


def _peak(place: int) -> Column[Wave]:
    return Column(f"{TIMES[place]:g}", value=lambda s: s.peaks[place], format=".1f", group="t in ms")


STOPPED: Sequence[Column[Wave]] = (
    Column("stopped at", value=lambda s: s.label, left=True),
    Column("iterations per step", value=lambda s: s.passes, format=".1f", missing=""),
    *map(_peak, range(len(TIMES))),
    Column("largest relative difference", value=lambda s: s.difference, format=".1e", missing=""),
)
PEAKS: Sequence[Column[Tuple[Wave, int]]] = (  # and the place in TIMES
    Column(csv="stop", value=lambda r: r[0].label),
    Column(csv="iterations_per_step", value=lambda r: r[0].passes),
    Column(csv="time", unit="ms", value=lambda r: TIMES[r[1]]),
    Column(csv="peak", unit="Pa", value=lambda r: r[0].peaks[r[1]]),
    Column(csv="peak_over_monolithic", value=lambda r: r[0].ratios[r[1]]),
    Column(csv="max_relative", value=lambda r: r[0].difference),
)


def stopped_table(reference: StudyRun, found: Sequence[Stopped]) -> Table:
    rows = [
        Wave("monolithic", None, peaks(reference.pressure), [1.0] * len(TIMES), None),
        *(Wave(s.label, s.passes, s.peaks, s.ratios, s.difference) for s in found),
    ]
    table = Table(
        "stopped_early",
        "The largest pressure in Pa when the interface iteration is stopped early",
        STOPPED,
        rows,
        Facts(PEAKS, [(row, place) for row in rows for place in range(len(TIMES))]),
        [
            "Largest difference: of the whole wave to the monolithic one, relative to the largest pressure of the "
            f"time level, over all levels. {MATERIALS[reference.request.case]}, {mesh_of(reference)} mesh."
        ],
    )
    if any("from the last step" in s.label for s in found):
        table.notes.append(
            "'From the last step': the iteration starts from the last displacement, otherwise from its extrapolation."
        )
    return table


def stopped_figure(reference: StudyRun, runs: PaperRuns) -> Figure:
    shown = runs.all(STOPPED_EARLY)[:4]
    waves = [reference.pressure, *(run.pressure for run in shown)]
    labels = ["monolithic", *(str(run.request.values.get("stop", run.request.label)) for run in shown)]
    times = [time for time in TIMES if all(wave.covers(time) for wave in waves)]
    return pressure_figure(
        waves,
        labels,
        times,
        f"The interface iteration stopped early, {MATERIALS[reference.request.case]}, {mesh_of(reference)} mesh",
    )


# ---- fields


def tube_picture(report: Report, runs: PaperRuns, errors: Mapping[Path, MeshError]) -> None:
    """A section with the three walls at 8 ms, all with one magnification; none where no run holds fields."""
    media, names, own = [], [], []
    for material in runs.materials:
        run = runs.wave(material, runs.finest)
        if run and is_file(run.folder / fields.FILE):
            media.append(fields.read_fields(run.folder, PICTURE_TIME))
            names.append(MATERIALS[material])
            own.append((MATERIALS[material], errors[run.folder]))
    if not media:
        return
    report.section("Deformed wall and velocity")
    largest = [tube_pictures.largest_displacement(one) for one in media]
    factor = tube_pictures.round_factor(max(largest))
    cuts = [tube_pictures.tube_cut(one, factor) for one in media]
    shown = ", ".join(f"{name} {1e3 * size:.0f} um" for name, size in zip(names, largest))
    report.figure(
        "tube_8ms",
        lambda: tube_pictures.tube_figure(cuts, names, PICTURE_TIME, factor),
        f"Cut along the axis at {PICTURE_TIME:g} ms, {runs.finest} mesh, from `fields.h5` of the "
        f"monolithic runs: deformed wall, displacement magnified {factor:g} times (largest: {shown}), speed "
        f"of the fluid by shade, its velocity by arrows, their scale above the first panel. {error_words(own)}",
    )
