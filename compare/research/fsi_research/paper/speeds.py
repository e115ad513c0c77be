"""Speed and height of the pressure wave: theory, and what the runs show on meshes side by side."""

from dataclasses import dataclass, replace
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..catalogue.names import MATERIALS
from fsi_compare.reporting.column import Column, Facts
from fsi_compare.reporting.layout import Table
from fsi_compare.reporting.pictures import PANEL_INCHES, finish
from fsi_compare.runs.pressure_waves import crest_speed
from ..evidence import wave_speed
from ..evidence.tube import Tube, read_tube
from fsi_compare.study.study_run import StudyRun
from .runs import DENSITY, FIBRES, MONOLITHIC, RESOLVED, TIMES, WAVES, PaperRuns, mesh_of
from .waves import peaks

STABILISATION = "structure.stabilisation"
MARKERS = ("o", "s", "D", "^")  # of the levels, coarse first
# Greys for theory: the materials have the colours.
THEORY: Dict[str, Tuple[str, Dict[str, Any]]] = {
    "long": ("thick wall held at its length, long waves", {"color": "#c4c4c4", "linewidth": 5, "linestyle": "-"}),
    "held": ("Moens-Korteweg, held at its length", {"color": "#333333", "linewidth": 1.6, "linestyle": (0, (3, 1))}),
    "free": ("Moens-Korteweg, free to shorten", {"color": "#333333", "linewidth": 1.6, "linestyle": (0, (1, 1))}),
    "dispersed": ("thick wall, wave of kR = 1", {"color": "#777777", "linewidth": 1.6, "linestyle": "-"}),
}
MEANING = (
    "The tube is clamped at both ends, so that long waves find it held at its length; Moens-Korteweg in its usual "
    "form, free to shorten, is shown beside it. The pulse is a few radii long and disperses: its crest belongs to wave "
    "numbers about kR = 1 and above, and is slower than any long wave."
)


@dataclass(frozen=True)
class Measured:
    """On one level of resolution; the errors are the differences to the level before, None on the first."""

    level: str
    speed: Optional[float]  # of the crest, mm/ms
    height: Optional[float]  # mean of the largest pressures from 4.5 to 9 ms, Pa
    speed_error: Optional[float] = None
    height_error: Optional[float] = None

    @property
    def complete(self) -> bool:
        return self.speed is not None and self.height is not None


@dataclass(frozen=True)
class Speeds:
    """Wave speeds of one reading of one material's wall, mm/ms."""

    material: str
    reading: str  # how it departs from the case file; empty: not at all
    free: float  # Moens-Korteweg, free to shorten
    held: float  # the same at constant length
    long: float  # long waves, thick wall at constant length
    dispersed: float  # at kR = 1
    measured: Mapping[str, Measured]  # by level, coarse first

    @property
    def label(self) -> str:
        return MATERIALS[self.material] + (f", {self.reading}" if self.reading else "")

    @property
    def finest(self) -> Optional[Measured]:
        """On the finest level that has both."""
        return next((m for m in reversed(list(self.measured.values())) if m.complete), None)


def level_of(run: StudyRun) -> str:
    """The mesh, and with it the wall's stabilisation where it is not the default."""
    if run.request.group != RESOLVED:
        return mesh_of(run)
    factor = run.request.settings.get(STABILISATION)
    return mesh_of(run) + ("" if factor is None else f", {factor:g}")


def levels_of(runs: PaperRuns) -> List[str]:
    return list(dict.fromkeys([*runs.meshes, *(level_of(run) for run in runs.all(RESOLVED))]))


def speeds(runs: PaperRuns) -> List[Speeds]:
    """Speeds of the three materials as they are, then of the other readings."""
    levels = levels_of(runs)

    def of(material: str, reading: str, tube: Tube, chosen: Sequence[StudyRun]) -> Speeds:
        return Speeds(
            material,
            reading,
            wave_speed.moens_korteweg(tube),
            wave_speed.moens_korteweg(tube, restrained=True),
            wave_speed.long_wave(tube),
            wave_speed.phase_speed(tube, 1 / tube.radius),
            _measured(levels, chosen),
        )

    found = []
    for material in runs.materials:
        chosen = [*runs.all(WAVES, material, method=MONOLITHIC), *runs.all(RESOLVED, material)]
        if chosen:
            found.append(of(material, "", read_tube(chosen[0].request.case_file), chosen))
    for scale in dict.fromkeys(run.request.values["fibres"] for run in runs.all(FIBRES)):
        chosen = [run for run in runs.all(FIBRES) if run.request.values["fibres"] == scale]
        tube = read_tube(chosen[0].request.case_file, fibre_scale=float(scale))
        found.append(of(chosen[0].request.case, f"fibres times {scale:g}", tube, chosen))
    for material in runs.materials:
        chosen = runs.all(DENSITY, material)
        if chosen:
            tube = read_tube(chosen[0].request.case_file)
            density = float(chosen[0].request.settings["structure.density"])
            found.append(
                of(material, f"wall density {1e3 * density:g} kg/m^3", replace(tube, wall_density=density), chosen)
            )
    return found


def _measured(levels: Sequence[str], chosen: Sequence[StudyRun]) -> Dict[str, Measured]:
    by = {level_of(run): run for run in chosen}
    found: Dict[str, Measured] = {}
    before: Optional[Measured] = None
    for level in [level for level in levels if level in by]:
        wave = by[level].pressure
        speed, height = crest_speed(wave), mean_peak(peaks(wave))
        found[level] = Measured(
            level,
            speed,
            height,
            _apart(speed, before.speed if before else None),
            _apart(height, before.height if before else None),
        )
        before = found[level]
    return found


def _apart(one: Optional[float], other: Optional[float]) -> Optional[float]:
    return None if one is None or other is None else abs(one - other)


def finest_common(found: Sequence[Speeds]) -> Optional[str]:
    """The finest level on which all of them have speed and height."""
    if not found:
        return None
    return next(
        (
            level
            for level in reversed(list(found[0].measured))
            if all(level in s.measured and s.measured[level].complete for s in found)
        ),
        None,
    )


def mean_peak(values: Optional[Sequence[Optional[float]]]) -> Optional[float]:
    """Over the paper's times from 4.5 to 9 ms."""
    late = [p for time, p in zip(TIMES, values or ()) if time >= 4.5]
    known = [p for p in late if p is not None]
    return sum(known) / len(known) if known and len(known) == len(late) else None


def with_error(value: float, error: Optional[float], form: str) -> str:
    return format(value, form) + ("" if error is None else f" +- {error:{form}}")


LEVELS: Sequence[Column[Tuple[Speeds, Measured]]] = (
    Column(csv="material", value=lambda r: r[0].material),
    Column(csv="reading", value=lambda r: r[0].reading),
    Column(csv="moens_korteweg", unit="mm/ms", value=lambda r: r[0].free),
    Column(csv="moens_korteweg_held", unit="mm/ms", value=lambda r: r[0].held),
    Column(csv="long_wave", unit="mm/ms", value=lambda r: r[0].long),
    Column(csv="kR_1", unit="mm/ms", value=lambda r: r[0].dispersed),
    Column(csv="level", value=lambda r: r[1].level),
    Column(csv="crest", unit="mm/ms", value=lambda r: r[1].speed),
    Column(csv="crest_difference_to_coarser", unit="mm/ms", value=lambda r: r[1].speed_error),
    Column(csv="mean_peak", unit="Pa", value=lambda r: r[1].height),
    Column(csv="mean_peak_difference_to_coarser", unit="Pa", value=lambda r: r[1].height_error),
)

WALLS: Sequence[Column[Speeds]] = (
    Column("wall", value=lambda s: s.label, left=True),
    Column("free to shorten", value=lambda s: s.free, format=".3f", group="Moens-Korteweg"),
    Column("held at its length", value=lambda s: s.held, format=".3f", group="Moens-Korteweg"),
    Column("long waves", value=lambda s: s.long, format=".3f", group="thick wall, held"),
    Column("kR = 1", value=lambda s: s.dispersed, format=".3f", group="thick wall, held"),
)


def _measured_columns(levels: Sequence[str], name: str, form: str, group: str) -> List[Column[Speeds]]:
    """Columns of the levels, and the error of the finest where there are several."""

    def of_level(level: str) -> Column[Speeds]:
        return Column(
            level,
            value=lambda s: getattr(s.measured[level], name) if level in s.measured else None,
            format=form,
            group=group,
        )

    error: Column[Speeds] = Column(
        "error", value=lambda s: getattr(s.finest, f"{name}_error") if s.finest else None, format=form, group=group
    )
    return [*(of_level(level) for level in levels), *([error] if len(levels) > 1 else [])]


def speed_table(found: Sequence[Speeds], levels: Sequence[str]) -> Table:
    return Table(
        "wave_speed",
        "Speed of the pressure wave in mm/ms (m/s)",
        [
            *WALLS,
            *_measured_columns(levels, "speed", ".3f", "crest, 4.5 to 9 ms"),
            *_measured_columns(levels, "height", ".1f", "mean peak in Pa, 4.5 to 9 ms"),
        ],
        found,
        Facts(LEVELS, [(s, m) for s in found for m in s.measured.values()]),
        [
            "Moens-Korteweg: c^2 = E h / (2 rho R) with the hoop modulus E of both layers together, inner radius R. "
            "Thick wall: c^2 = R/(2 rho) dp/du from the closed-form inflation of the two layers; kR: wave number "
            "times radius, with the fluid's added mass and the wall's mass.",
            "Error: estimated by the difference of the two finest levels of the row." + _resolved_note(levels)
            if len(levels) > 1
            else "The study has one level of resolution, which tells no error of its own: see table `mesh_error`.",
        ],
    )


def _resolved_note(levels: Sequence[str]) -> str:
    if any("," in level for level in levels):
        return (
            " The number behind a mesh is the wall's stabilisation factor, 0.5 otherwise. Rows without that level "
            "have the error of coarse meshes, whose difference says little."
        )
    return " Both are coarse here and share the wall's stabilisation, which stiffens it: the error may be larger."


def speed_figure(found: Sequence[Speeds], tubes: Dict[str, Tube], levels: Sequence[str]) -> Figure:
    """Left the thick wall's dispersion; right a line of marks for each wall, so that their names have room."""
    from ..linear.solver_pictures import MATERIAL_LINES

    figure = Figure(figsize=(9.2, max(PANEL_INCHES[1] + 1.1, 0.9 + 0.36 * len(found))))
    left, right = figure.subplots(1, 2, width_ratios=[1, 1.45])
    handles, labels = [], []
    products = np.linspace(0.02, 3, 60)
    for material, tube in tubes.items():
        style: Dict[str, Any] = {**MATERIAL_LINES[material], "marker": "", "linewidth": 1.8}
        handles += left.plot(products, [wave_speed.phase_speed(tube, x / tube.radius) for x in products], **style)
        labels.append(MATERIALS[material])
    left.axvline(1, **{**THEORY["dispersed"][1], "linewidth": 1.0})
    left.set_xlabel("wave number times radius, kR")
    left.set_ylabel("speed in mm/ms")
    left.set_title("phase speed, thick wall")
    left.set_xlim(0, 3)
    left.set_ylim(0, None)
    for y, s in enumerate(found):
        for name, (_, line) in THEORY.items():
            right.plot([getattr(s, name)] * 2, [y - 0.36, y + 0.36], zorder=2, **line)
        for i, level in enumerate(levels):
            m = s.measured.get(level)
            if m and m.speed is not None:
                right.plot(
                    m.speed,
                    y + 0.14 * (i - (len(levels) - 1) / 2),
                    zorder=3,
                    **_crest(i, MATERIAL_LINES[s.material]["color"]),
                )
        if s.finest and s.finest.speed_error is not None:
            last = levels.index(s.finest.level)
            right.errorbar(
                s.finest.speed,
                y + 0.14 * (last - (len(levels) - 1) / 2),
                xerr=s.finest.speed_error,
                ecolor=MATERIAL_LINES[s.material]["color"],
                elinewidth=1.0,
                capsize=2.5,
                fmt="none",
                zorder=2.5,
            )
    for label, line in THEORY.values():
        handles += right.plot([], [], **line)
        labels.append(label)
    for i, level in enumerate(levels):
        handles += right.plot([], [], **_crest(i, "#000000"))
        labels.append(f"crest in the runs, {level}")
    right.set_yticks(range(len(found)), [s.label.replace(", wall", ",\nwall") for s in found])
    right.set_ylim(len(found) - 0.4, -0.6)
    right.grid(axis="y", visible=False)
    right.set_xlim(left=0)
    right.xaxis.set_major_locator(MaxNLocator(nbins=8, steps=[1, 2, 2.5, 5, 10]))
    right.set_xlabel("speed in mm/ms")
    right.set_title("theory and runs")
    return finish(figure, handles, labels, "Speed of the pressure wave")


def _crest(level: int, color: str) -> dict:
    return {
        "marker": MARKERS[level % len(MARKERS)],
        "color": color,
        "markerfacecolor": "#ffffff",
        "linestyle": "none",
        "markersize": 6,
        "markeredgewidth": 1.5,
    }
