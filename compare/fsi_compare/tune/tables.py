"""What was asked for and found, beat by beat: tables for people and scripts."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Sequence

from ..base.errors import printable
from ..base.files import absolute, write_text
from ..reporting.column import Column
from ..reporting.layout import Table, write_tables
from .scene import Scene
from .targets import KPA, Target
from .tuning import Beat, Demand, Outcome


@dataclass(frozen=True)
class Found:
    """A target in one beat."""

    beat: int
    target: Target
    got: float
    foreseen: float | None

    @property
    def percent(self) -> float:
        return 100 * (self.got / self.target.value - 1)


OfBeat = tuple[Beat, str]  # with an opening


def _shown(found: Found, value: float) -> str:
    if found.target.unit == "1":
        return f"{100 * value:.2f} %"
    if found.target.is_pressure:
        return f"{value:.3f} kPa, {value / KPA['mmHg']:.1f} mmHg"
    return f"{value:.4g} {found.target.unit}"


TARGETS: Sequence[Column[Found]] = (
    Column("beat", "beat", lambda f: f.beat),
    Column("opening", "opening", lambda f: f.target.opening, left=True),
    Column("quantity", "quantity", lambda f: f.target.kind, left=True),
    Column(csv="unit", value=lambda f: f.target.unit),
    Column("asked for", "asked", lambda f: f.target.value, text=lambda f: _shown(f, f.target.value)),
    Column("found", "found", lambda f: f.got, text=lambda f: _shown(f, f.got)),
    Column("difference [%]", "difference_percent", lambda f: f.percent, "+.2f"),
    Column(csv="foreseen", value=lambda f: f.foreseen),
)
VALUES: Sequence[Column[OfBeat]] = (
    Column("beat", "beat", lambda v: v[0].number),
    Column("outlet", "outlet", lambda v: v[1], left=True),
    Column("proximal [{unit}]", "proximal", lambda v: v[0].values[v[1]].proximal, ".4g", unit="kPa ms/mm^3"),
    Column("compliance [{unit}]", "compliance", lambda v: v[0].values[v[1]].compliance, ".4g", unit="mm^3/kPa"),
    Column("distal [{unit}]", "distal", lambda v: v[0].values[v[1]].distal, ".4g", unit="kPa ms/mm^3"),
    Column("starts from [{unit}]", "start", lambda v: v[0].repeats[v[1]].begin, ".4g", unit="kPa"),
    Column("ends with [{unit}]", "end", lambda v: v[0].repeats[v[1]].end, ".4g", unit="kPa"),
    Column("periodic [{unit}]", "periodic", lambda v: v[0].repeats[v[1]].periodic, ".4g", unit="kPa"),
)
VESSEL: Sequence[Column[OfBeat]] = (
    Column("beat", "beat", lambda v: v[0].number),
    Column("opening", "opening", lambda v: v[1], left=True),
    Column("resistance [{unit}]", "resistance", lambda v: v[0].vessel.resistance[v[1]], ".4g", unit="kPa ms/mm^3"),
    Column("inertance [{unit}]", "inertance", lambda v: v[0].vessel.inertance[v[1]], ".4g", unit="kPa ms^2/mm^3"),
    Column("compliance [{unit}]", "compliance", lambda v: v[0].vessel.compliance, ".4g", unit="mm^3/kPa"),
    Column(
        "left of pressures [%]", "left_of_pressures_percent", lambda v: 100 * v[0].vessel.unexplained_pressure, ".1f"
    ),
    Column("left of volume [%]", "left_of_volume_percent", lambda v: 100 * v[0].vessel.unexplained_volume, ".1f"),
)


def tables_of(demand: Demand, outcome: Outcome) -> list[Table]:
    found = []
    for beat in outcome.beats:
        foreseen = [None] * len(demand.targets) if beat.foreseen is None else map(float, beat.foreseen)
        found += [Found(beat.number, *one) for one in zip(demand.targets, map(float, beat.got), foreseen)]
    values = [(beat, name) for beat in outcome.beats for name in beat.values]
    vessels = [(beat, name) for beat in outcome.beats for name in beat.vessel.resistance]
    return [
        Table("targets", "What is asked for, and what each beat shows", TARGETS, found),
        Table("values", "Windkessels of each beat", VALUES, values),
        Table("vessel", "The vessel, fitted to each beat", VESSEL, vessels),
    ]


def write_results(
    folder: Path, scene: Scene, demand: Demand, outcome: Outcome, program: str
) -> tuple[list[Table], list[Path]]:
    tables = tables_of(demand, outcome)
    written = write_tables(folder, tables, "tune.md", f"Tuning of {printable(scene.path.stem)}")
    last = outcome.beats[-1]
    begins = {name: one.begin for name, one in last.repeats.items()}
    said: dict[str, Any] = {"case": str(absolute(scene.path)), "program": program, "period_ms": scene.period}
    said |= {"proximal": demand.rule.words, "tolerance": demand.tolerance}
    said |= {
        "reached": outcome.reached,
        "notes": outcome.lines,
        "targets": [{**target.about, "found": float(got)} for target, got in zip(demand.targets, last.got)],
        "windkessels": {n: {**law.values, "initial_pressure": begins[n]} for n, law in last.values.items()},
        "beats": [one.about for one in outcome.beats],
    }
    path = folder / "tune.json"
    write_text(path, json.dumps(said, indent=1) + "\n")
    return tables, [*written, path]
