"""What the runs make of loads that the wall cannot bear at rest: pictures, and a table without repetitions."""

from dataclasses import dataclass
from typing import Dict, List, NamedTuple, Optional, Sequence, Tuple

from fsi_compare.reporting.column import Column, Facts, fixed
from fsi_compare.reporting.layout import Table
from fsi_compare.reporting.report import Report
from ..evidence.cross_check import Cell, quantity
from fsi_compare.study.study_file import show
from .limit_load import Curve, Inflation, Wall, inflation, pulse_figure, static_figure
from .messages import without_folder
from .settings import Settings

CURVES = 6  # of a picture, at most


@dataclass(frozen=True)
class Inflated:
    """A run and how far it came."""

    cell: Cell
    at_rest: bool
    load: float  # kPa, the whole; of a pulse its length in ms
    levels: Optional[Inflation]
    wall: Wall

    @property
    def label(self) -> str:
        if not self.at_rest:
            return f"pulse of {show(self.load)} ms"
        return f"{show(self.load)} kPa at rest" + (f" in {self.levels.steps} steps" if self.levels else "")

    @property
    def mesh(self) -> str:
        """Its nodes."""
        nodes = self.cell.run.summary.get("mesh", {}).get("nodes")
        return "-" if nodes is None else f"{nodes:,}"

    @property
    def reached(self) -> Optional[float]:
        """ms, or the fraction of the load."""
        return None if self.levels is None else float(self.levels.times[-1])

    @property
    def pressure(self) -> float:
        """kPa, the highest at rest."""
        return (self.reached or 0) * self.load

    @property
    def widenings(self) -> List[Optional[float]]:
        """The largest, half-way along the tube, and of a long tube at the same pressure."""
        if self.levels is None:
            return [None, None, None]
        largest, middle = (
            1 + float(values[-1]) / self.wall.radius for values in (self.levels.largest, self.levels.middle)
        )
        return [largest, middle, self.wall.widening(self.pressure) if self.at_rest else None]

    @property
    def shown(self) -> List[str]:
        reached = (
            "-" if self.reached is None else (f"{self.pressure:.3f} kPa" if self.at_rest else f"{self.reached:g} ms")
        )
        return [self.cell.outcome, reached, *(fixed(widening, ".3f") for widening in self.widenings)]


def beyond_limit_load(report: Report, found: Sequence[Cell], settings: Settings) -> None:
    if settings.wall is None:
        return
    wall: Wall = settings.wall
    runs = [_inflated(cell, True, wall) for cell in found if settings.at_rest(cell.run)]
    runs += [_inflated(cell, False, wall) for cell in found if settings.pulse and quantity(cell.run) == settings.pulse]
    if not runs:
        return
    report.section("Beyond the limit load")
    report.text(*_in_words(runs, wall))
    own = [run for run in runs if run.levels is not None and run.cell.method in settings.references]
    furthest = _furthest(own)
    if furthest:
        curves = [
            Curve(f"run on {run.mesh} nodes, to {run.pressure:.3f} kPa", run.load, run.cell.run.done, run.levels)
            for run in furthest
            if run.levels is not None
        ]
        report.figure(
            "limit_load",
            lambda: static_figure(curves[:CURVES], wall),
            "The wall alone under a static pressure, raised in equal steps: the run of each mesh that came "
            "furthest. A curve ends where no further solution was found.",
        )
    waves = [
        Curve(run.label, run.load, run.cell.run.done, run.levels)
        for run in own
        if run.levels is not None and not run.at_rest and run.cell.method == settings.references[0]
    ]
    shown = waves[:CURVES]
    if shown:
        report.figure(
            "long_pulses",
            lambda: pulse_figure(shown, "Inflation by pulses of different length"),
            "Largest radial displacement of the inner face."
            + (
                " A dot: the run reached its end, which is later for longer pulses."
                if any(w.done for w in shown)
                else ""
            )
            + (
                " A cross: it ended with a message, for want of a solution of the next step."
                if not all(w.done for w in shown)
                else ""
            )
            + (" Curves of longer pulses coincide until the shorter one ends." if len(shown) > 1 else ""),
        )
    report.table(limit_load_table(runs, settings))


def _inflated(cell: Cell, at_rest: bool, wall: Wall) -> Inflated:
    value = next(iter(cell.run.request.values.values()))
    load = cell.run.request.settings.get("load.pressure", value) if at_rest else value
    return Inflated(cell, at_rest, float(load), inflation(cell.run), wall)


def _furthest(runs: Sequence[Inflated]) -> List[Inflated]:
    """The furthest run at rest on each mesh; the coarsest mesh first."""
    best: Dict[str, Inflated] = {}
    for run in runs:
        if run.at_rest and (run.mesh not in best or run.pressure > best[run.mesh].pressure):
            best[run.mesh] = run
    return list(best.values())


def _in_words(runs: Sequence[Inflated], wall: Wall) -> List[str]:
    text = [
        f"A long tube of these layers that widens evenly bears less than {wall.limit:.3f} kPa at rest, at unit "
        "axial stretch and whatever its radius. A longer pulse above that has no rest to tend to: only inertia "
        "holds the wall, and the wall widens until the run can no longer follow it."
    ]
    if wall.bulge:
        text[0] += (
            f" It bears less still, for it need not widen evenly: at {wall.bulge:.2f} times its radius, under "
            f"{wall.pressure(wall.bulge):.3f} kPa, a bulge sets in, which grows under falling pressure."
        )
    if any(run.at_rest for run in runs):
        text.append(
            "The runs at rest end below these loads, all with a bulge half-way along the tube. Two things are "
            "not the long tube's. The ends are clamped, so that the middle lengthens at the cost of the ends. "
            "And the wall is softer on a coarse mesh: it widens further under the same pressure, less so on a "
            "finer one. Load steps are not cut back: a run ends at the first step without a solution, so that "
            "the load it reached falls short of its limit by up to one load step."
        )
        reached = [f"{run.pressure:.3f} kPa on {run.mesh} nodes" for run in _furthest(runs)]
        text.append(f"Highest static pressure with a solution: {', '.join(reached)}." + _same_steps(runs))
    return text


def _same_steps(runs: Sequence[Inflated]) -> str:
    """Whether the mesh decides how far a run comes, by runs on different meshes with the same load steps."""
    ends: Dict[Tuple[float, int], Dict[str, float]] = {}
    for run in runs:
        if run.at_rest and run.levels is not None and not run.cell.run.done:
            ends.setdefault((run.load, run.levels.steps), {})[run.mesh] = run.pressure
    shared = [list(there.values()) for there in ends.values() if len(there) > 1]
    if not shared:
        return ""
    alike = sum(max(pressures) - min(pressures) < 1e-9 for pressures in shared)
    said = f" Of {len(shared)} loads too high for two meshes, applied in the same steps, {alike} end at the same step"
    return said + (": on a finer mesh the wall widens less, but does not bear more." if alike == len(shared) else ".")


WIDENINGS = (("largest", "largest_widening"), ("half-way", "middle_widening"), ("long tube", "closed_form_widening"))


def _widening(place: int, csv: str) -> Column[Inflated]:
    return Column(csv=csv, value=lambda run: run.widenings[place])


LOADS: Sequence[Column[Inflated]] = (
    Column(csv="group", value=lambda run: run.cell.run.request.group),
    Column(csv="value", value=lambda run: next(iter(run.cell.run.request.values.values()))),
    Column(csv="load_kPa_or_pulse_ms", value=lambda run: run.load),
    Column(csv="nodes", value=lambda run: run.cell.run.summary.get("mesh", {}).get("nodes")),
    Column(csv="method", value=lambda run: run.cell.method),
    Column(csv="outcome", value=lambda run: run.cell.outcome),
    Column(csv="reached_time_ms_or_load_fraction", value=lambda run: run.reached),
    *(_widening(place, csv) for place, (_, csv) in enumerate(WIDENINGS)),
    Column(csv="message", value=lambda run: without_folder(run.cell.run.message)),
)


class Alike(NamedTuple):
    """Methods that came equally far."""

    load: str
    mesh: str
    methods: str
    shown: Sequence[str]  # of all of them: see Inflated.shown


def _shown_widening(place: int, head: str) -> Column[Alike]:
    return Column(head, value=lambda row: row.shown[2 + place], group="inner radius over that at rest")


ALIKE: Sequence[Column[Alike]] = (
    Column("load", value=lambda row: row.load, left=True),
    Column("nodes", value=lambda row: row.mesh, left=True),
    Column("method", value=lambda row: row.methods, left=True),
    Column("outcome", value=lambda row: row.shown[0], left=True),
    Column("reached", value=lambda row: row.shown[1]),
    *(_shown_widening(place, head) for place, (head, _) in enumerate(WIDENINGS)),
)


def limit_load_table(runs: Sequence[Inflated], settings: Settings) -> Table:
    """Methods that came equally far share a row. Those that do not iterate say nothing about the wall."""
    loads: Dict[Tuple[str, str], List[Inflated]] = {}
    for run in runs:
        if run.cell.method not in settings.one_pass:
            loads.setdefault((run.label, run.mesh), []).append(run)
    return Table(
        "limit_load",
        "How far the wall is inflated",
        ALIKE,
        [row for (label, mesh), there in loads.items() for row in _alike(label, mesh, there)],
        Facts(LOADS, runs),
        [
            "Methods that differ in nothing shown share a row. Long tube: closed form, widening evenly."
            + (
                f" Without {', '.join(settings.one_pass)}, whose own error is in what they reach."
                if settings.one_pass
                else ""
            )
        ],
    )


def _alike(label: str, mesh: str, there: Sequence[Inflated]) -> List[Alike]:
    alike: Dict[Tuple[str, ...], List[str]] = {}
    for run in there:
        alike.setdefault(tuple(run.shown), []).append(run.cell.run.method_label)
    return [
        Alike(label, mesh, _methods(list(dict.fromkeys(labels)), len(alike)), shown) for shown, labels in alike.items()
    ]


def _methods(names: Sequence[str], rows: int) -> str:
    if len(names) <= 3:
        return "; ".join(names)
    return f"all {len(names)} methods" if rows == 1 else f"{names[0]}; {len(names) - 1} others alike"
