"""Pressure waves, wave speeds and cut tubes of the paper's study, in tables and pictures."""

from dataclasses import dataclass
from typing import Dict, List, Optional, Sequence, Tuple

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ...differences import largest_difference
from ...layout import Table, fixed
from ...names import MATERIALS, MESHES
from ...pictures import PANEL_INCHES, finish, pressure_figure
from ...pressure_waves import PressureWaves, crest_speed, peak
from ..evidence import fields, tube_pictures, wave_speed
from .runs import (DENSITY, FIBRES, MONOLITHIC, PARTITIONED, PICTURE_TIME, STOPPED_EARLY, TIMES, WAVES, PaperRuns,
                         mesh_of, times_of)
from ..study_run import StudyRun
from ..evidence.wave_speed import Tube

MARKERS = {"coarse": "o", "intermediate": "s", "fine": "D"}


def peaks(waves: PressureWaves, times: Sequence[float] = TIMES) -> List[Optional[float]]:
    """Largest pressure along the line in Pa; None beyond the end of the run."""
    return [peak(waves.z, waves.at(time)).pressure if waves.covers(time) else None for time in times]


# ---- figures of the pressure along the centre line

def wave_pictures(report, runs: PaperRuns) -> None:
    mesh = runs.finest
    for material in runs.materials:
        pair = [runs.wave(material, mesh, method) for method in (MONOLITHIC, PARTITIONED)]
        if None in pair:
            continue
        times = [time for time in times_of(material) if all(run.pressure.covers(time) for run in pair)]
        report.figure(
            f"pressure_{material}",
            lambda: pressure_figure([run.pressure for run in pair], ["monolithic", "partitioned"], times,
                                    f"{MATERIALS[material]}, {mesh} mesh"),
            f"{MATERIALS[material]}: pressure along the centre line from both drivers, at the times of the paper's "
            "figure. The curves lie on each other.")
    together = [(material, runs.wave(material, mesh)) for material in runs.materials]
    together = [(material, run) for material, run in together if run]
    if len(together) > 1:
        times = [time for time in TIMES if all(run.pressure.covers(time) for _, run in together)]
        report.figure(
            "pressure_materials",
            lambda: pressure_figure([run.pressure for _, run in together],
                                    [MATERIALS[material] for material, _ in together], times,
                                    f"The three walls, {mesh} mesh"),
            "Pressure along the centre line in the three walls, at the times of the paper's figure.")


# ---- both drivers beside each other

@dataclass(frozen=True)
class Agreement:
    material: str
    mesh: str
    start: float  # largest difference over the line, relative to the largest pressure of the time level, up to 1.5 ms
    all: float  # the same over all levels


def agreements(runs: PaperRuns) -> List[Agreement]:
    found = []
    for material in runs.materials:
        for mesh in runs.meshes:
            one, other = (runs.wave(material, mesh, method) for method in (MONOLITHIC, PARTITIONED))
            if one and other:
                found.append(Agreement(material, mesh, _largest(one.pressure, other.pressure, 1.5),
                                       _largest(one.pressure, other.pressure)))
    return found


def _largest(reference: PressureWaves, other: PressureWaves, until: float = np.inf) -> float:
    kept = reference.times <= until + reference.time_tolerance
    part = PressureWaves(reference.times[kept], reference.z, reference.pressure[kept])
    found = largest_difference(part, other).largest
    return found.max_relative if found and found.max_relative is not None else float("nan")


def agreement_table(found: Sequence[Agreement]) -> Table:
    table = Table(stem="agreement", title="Partitioned against monolithic, largest relative difference of the "
                                          "pressure", left=2,
                  columns=[("", "material"), ("", "mesh"), ("", "until 1.5 ms"), ("", "all levels")],
                  csv_columns=["material", "mesh", "max_relative_until_1_5_ms", "max_relative"],
                  notes=["Interface tolerance 1e-6. Relative to the largest pressure of the same time level."])
    for a in found:
        table.rows.append([MATERIALS[a.material], a.mesh, f"{a.start:.1e}", f"{a.all:.1e}"])
        table.csv_rows.append([a.material, a.mesh, a.start, a.all])
    return table


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
        found.append(Stopped(str(run.request.values.get("stop", run.request.label)), run.passes, own, ratios,
                             _largest(reference.pressure, run.pressure)))
    return reference, found


def stopped_table(reference: StudyRun, found: Sequence[Stopped]) -> Table:
    table = Table(
        stem="stopped_early",
        title="The largest pressure in Pa when the interface iteration is stopped early",
        columns=[("", "stopped at"), ("", "iterations per step"), *(("t in ms", f"{time:g}") for time in TIMES),
                 ("", "largest difference")],
        csv_columns=["stop", "iterations_per_step", "time_ms", "peak_Pa", "peak_over_monolithic", "max_relative"],
        notes=[
            "Largest difference: of the whole wave to the monolithic one, relative to the largest pressure of the "
            f"time level, over all levels. {MATERIALS[reference.request.case]}, coarse mesh. 'From the last step': "
            "the iteration starts from the last displacement, otherwise from its extrapolation."
        ])
    exact = peaks(reference.pressure)
    table.rows.append(["monolithic", "", *(fixed(p, ".1f") for p in exact), ""])
    table.csv_rows += [["monolithic", None, time, p, 1.0, None] for time, p in zip(TIMES, exact)]
    for s in found:
        table.rows.append([s.label, f"{s.passes:.1f}", *(fixed(p, ".1f") for p in s.peaks), f"{s.difference:.1e}"])
        table.csv_rows += [[s.label, s.passes, time, p, ratio, s.difference]
                           for time, p, ratio in zip(TIMES, s.peaks, s.ratios)]
    return table


def stopped_figure(reference: StudyRun, runs: PaperRuns) -> Figure:
    shown = runs.all(STOPPED_EARLY)[:3]
    waves = [reference.pressure, *(run.pressure for run in shown)]
    labels = ["monolithic", *(str(run.request.values.get("stop", run.request.label)) for run in shown)]
    times = [time for time in TIMES if all(wave.covers(time) for wave in waves)]
    return pressure_figure(waves, labels, times, "The interface iteration stopped early, "
                                                 f"{MATERIALS[reference.request.case]}, coarse mesh")


# ---- speeds

@dataclass(frozen=True)
class Speeds:
    """Of one reading of one material's wall, mm/ms."""

    material: str
    reading: str  # how it departs from the case file; empty: not at all
    thin: float  # Moens-Korteweg
    held: float  # the same at constant length
    thick: float  # long waves, thick wall at constant length
    dispersed: float  # at kR = 1
    measured: Dict[str, Optional[float]]  # crest, by mesh
    peaks: Dict[str, Sequence[Optional[float]]]  # Pa at TIMES, by mesh

    @property
    def label(self) -> str:
        return MATERIALS[self.material] + (f", {self.reading}" if self.reading else "")


def speeds(runs: PaperRuns) -> List[Speeds]:
    """Of the three materials as they are, then of the other readings."""
    found = [
        _speeds(material, "", wave_speed.read_tube(runs.all(WAVES, material)[0].request.case_file),
                runs.all(WAVES, material, method=MONOLITHIC)) for material in runs.materials
        if runs.all(WAVES, material)
    ]
    scales = dict.fromkeys(run.request.values["fibres"] for run in runs.all(FIBRES))
    for scale in scales:
        chosen = [run for run in runs.all(FIBRES) if run.request.values["fibres"] == scale]
        tube = wave_speed.read_tube(chosen[0].request.case_file, fibre_scale=float(scale))
        found.append(_speeds(chosen[0].request.case, f"fibres times {scale:g}", tube, chosen))
    for material in runs.materials:
        chosen = runs.all(DENSITY, material)
        if chosen:
            tube = wave_speed.read_tube(chosen[0].request.case_file)
            density = float(chosen[0].request.settings["structure.density"])
            found.append(
                _speeds(material, f"wall density {1e3 * density:g} kg/m^3",
                        Tube(tube.layers, tube.fluid_density, density), chosen))
    return found


def _speeds(material: str, reading: str, tube: Tube, chosen: Sequence[StudyRun]) -> Speeds:
    return Speeds(material, reading, wave_speed.moens_korteweg(tube), wave_speed.moens_korteweg(tube, restrained=True),
                  wave_speed.long_wave(tube), wave_speed.phase_speed(tube, 1 / tube.radius),
                  {mesh_of(run): crest_speed(run.pressure) for run in chosen},
                  {mesh_of(run): peaks(run.pressure) for run in chosen})


def speed_table(found: Sequence[Speeds], meshes: Sequence[str]) -> Table:
    table = Table(
        stem="wave_speed",
        title="Speed of the pressure wave in mm/ms (m/s)",
        columns=[("", "wall"), ("Moens-Korteweg", "free to shorten"), ("Moens-Korteweg", "held at its length"),
                 ("thick wall, held", "long waves"), ("thick wall, held", "kR = 1"),
                 *(("crest, 4.5 to 9 ms", mesh) for mesh in meshes),
                 *(("mean peak in Pa, 4.5 to 9 ms", mesh) for mesh in meshes)],
        csv_columns=[
            "material", "reading", "moens_korteweg_mm_per_ms", "moens_korteweg_held_mm_per_ms", "long_wave_mm_per_ms",
            "kR_1_mm_per_ms", "mesh", "crest_mm_per_ms", "mean_peak_Pa"
        ],
        notes=[
            "Moens-Korteweg: c^2 = E h / (2 rho R) with the hoop modulus E of both layers together, inner radius R. "
            "Thick wall: c^2 = R/(2 rho) dp/du from the closed-form inflation of the two layers; kR: wave number "
            "times radius, with the fluid's added mass and the wall's mass. A short pulse disperses, and its crest "
            "is slower than the long waves."
        ])
    for s in found:
        table.rows.append([s.label, *(f"{v:.3f}" for v in (s.thin, s.held, s.thick, s.dispersed)),
                           *(fixed(s.measured.get(mesh), ".3f") for mesh in meshes),
                           *(fixed(mean_peak(s.peaks.get(mesh)), ".1f") for mesh in meshes)])
        for mesh in meshes:
            if mesh in s.measured:
                table.csv_rows.append([
                    s.material, s.reading, s.thin, s.held, s.thick, s.dispersed, mesh, s.measured[mesh],
                    mean_peak(s.peaks[mesh])
                ])
    return table


def mean_peak(values: Optional[Sequence[Optional[float]]]) -> Optional[float]:
    """Over the paper's times from 4.5 to 9 ms."""
    late = [p for time, p in zip(TIMES, values or ()) if time >= 4.5]
    return None if not late or None in late else sum(late) / len(late)


def speed_figure(found: Sequence[Speeds], tubes: Dict[str, Tube], meshes: Sequence[str]) -> Figure:
    """Left the thick wall's dispersion, right theory and measurement side by side."""
    from ...solver_pictures import MATERIAL_LINES

    width, height = 8.4, PANEL_INCHES[1] + 1.1
    figure = Figure(figsize=(width, height))
    canvas = FigureCanvasAgg(figure)
    left, right = figure.subplots(1, 2, sharey=True, width_ratios=[1, 1.25])
    handles, labels = [], []
    products = np.linspace(0.02, 3, 60)
    for material, tube in tubes.items():
        style = {**MATERIAL_LINES[material], "marker": "", "linewidth": 1.8}
        handles += left.plot(products, [wave_speed.phase_speed(tube, x / tube.radius) for x in products], **style)
        labels.append(MATERIALS[material])
    left.set_xlabel("wave number times radius, kR")
    left.set_ylabel("speed in mm/ms")
    left.set_title("phase speed, thick wall")
    left.set_xlim(0, 3)
    left.set_ylim(0, None)
    for x, s in enumerate(found):
        handle = right.plot([x - 0.34, x + 0.34], [s.thin] * 2,
                            color="#2c6fbb",
                            linewidth=1.6,
                            linestyle=(0, (1.5, 0.8)),
                            zorder=3)
        other = right.plot([x - 0.34, x + 0.34], [s.thick] * 2, color="#b5b5b5", linewidth=4)
        if x == 0:
            handles += [*handle, *other]
            labels += ["Moens-Korteweg", "thick wall, long waves"]
        for i, mesh in enumerate(meshes):
            if s.measured.get(mesh) is not None:
                right.plot(x + 0.16 * (i - (len(meshes) - 1) / 2),
                           s.measured[mesh],
                           marker=MARKERS[mesh],
                           color="#b02a5b",
                           fillstyle="none",
                           linestyle="none",
                           markersize=7,
                           markeredgewidth=1.6)
    for mesh in meshes:
        handles += right.plot([], [],
                              marker=MARKERS[mesh],
                              color="#b02a5b",
                              fillstyle="none",
                              linestyle="none",
                              markersize=7,
                              markeredgewidth=1.6)
        labels.append(f"crest measured, {mesh}")
    many = len(found) > 4
    right.set_xticks(range(len(found)), [s.label.replace(", ", ",\n", 1) for s in found],
                     fontsize=6.5 if many else 8, rotation=40 if many else 0, ha="right" if many else "center",
                     rotation_mode="anchor")
    right.set_xlim(-0.6, len(found) - 0.4)
    right.set_ylim(0, 1.05 * max(max(s.thick, s.thin, *(v for v in s.measured.values() if v)) for s in found))
    right.grid(axis="x", visible=False)
    right.set_title("theory and runs")
    finish(figure, canvas, handles, labels, "Speed of the pressure wave", (width, height))
    return figure


# ---- fields

def tube_picture(report, runs: PaperRuns) -> None:
    """The three walls at 8 ms, all with one magnification."""
    media, names = [], []
    for material in runs.materials:
        run = runs.wave(material, runs.finest)
        if run and run.has(fields.FILE):
            media.append(fields.read_fields(run.folder, PICTURE_TIME))
            names.append(MATERIALS[material])
    if not media:
        return
    largest = [tube_pictures.largest_displacement(one) for one in media]
    factor = tube_pictures.round_factor(max(largest))
    cuts = [tube_pictures.tube_cut(one, factor) for one in media]
    shown = ", ".join(f"{name} {1e3 * size:.0f} um" for name, size in zip(names, largest))
    report.figure("tube_8ms", lambda: tube_pictures.tube_figure(cuts, names, PICTURE_TIME, factor),
                  f"Cut along the axis at {PICTURE_TIME:g} ms, {runs.finest} mesh, from `fields.xdmf` of the "
                  f"monolithic runs: deformed wall, displacement magnified {factor:g} times (largest: {shown}), speed "
                  "of the fluid by shade, its velocity by arrows.")
