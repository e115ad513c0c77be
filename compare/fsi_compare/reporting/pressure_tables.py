"""What a comparison found, as text for people and as files for scripts."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Sequence

from ..base.errors import printable
from ..base.files import write_text
from ..runs.conditions import Conditions, conditions, departures
from ..runs.differences import Difference, OverTime, differences_at, largest_difference
from ..runs.pressure_waves import SPEED_WINDOW_MS, Crest, crest_speed, peak
from ..runs.run_folder import Run
from .column import Column
from .layout import Table


@dataclass(frozen=True)
class Comparison:
    """All numbers of `fsi-compare pressure`. The first run is the reference."""

    labels: Sequence[str]
    times: Sequence[float]  # ms
    at_times: list[list[Difference]]  # [run after the first][time]
    over_time: list[OverTime]  # [run after the first]
    peaks: list[list[Crest]]  # [run][time]
    speeds: list[float | None]  # [run], mm/ms
    conditions: list[Conditions]  # [run]
    warnings: list[str]  # in what the runs' meshes, steps and lengths differ


def compare_pressure(runs: Sequence[Run], labels: Sequence[str], times: Sequence[float]) -> Comparison:
    """Differences from the first run, peaks and speeds. All times must be covered by all runs, and the first run's
    centre line by the others'."""
    reference = runs[0].pressure
    found = [conditions(run) for run in runs]
    return Comparison(
        labels=labels,
        times=times,
        at_times=[differences_at(reference, run.pressure, times) for run in runs[1:]],
        over_time=[largest_difference(reference, run.pressure) for run in runs[1:]],
        peaks=[[peak(run.pressure.z, run.pressure.at(time)) for time in times] for run in runs],
        speeds=[crest_speed(run.pressure) for run in runs],
        conditions=found,
        warnings=departures(found, labels),
    )


def text(runs: Sequence[Run], comparison: Comparison) -> str:
    """The tables that the program prints."""
    lines = ["Runs"]
    width = max(len(label) for label in comparison.labels)
    for label, run, made in zip(comparison.labels, runs, comparison.conditions):
        waves = run.pressure
        program = f"{run.program} {run.version}".strip()
        mesh = f"mesh {made.mesh}, " if made.mesh else ""
        lines.append(
            f"  {label:<{width}}  {printable(str(run.folder))}: {program}, {mesh}{made.step_words}, {len(waves.times)} time levels "
            f"from {waves.times[0]:g} to {waves.times[-1]:g} ms, {len(waves.z)} points"
        )
    lines += [f"  Note: {warning}." for warning in comparison.warnings]

    for label, at_times, over_time in zip(comparison.labels[1:], comparison.at_times, comparison.over_time):
        lines += [
            "",
            f"Pressure of {label} against {comparison.labels[0]} (reference)",
            "       t in ms   max norm in Pa   relative   L2 norm in Pa mm^1/2   relative",
        ]
        for time, difference in zip(comparison.times, at_times):
            lines.append(_difference_row(f"{time:g}", difference))
        if over_time.largest is None:
            lines.append("    no time level is common to both")
        else:
            lines.append(_difference_row(f"all {over_time.levels}", over_time.largest))
    if comparison.at_times:
        last_row = "maximum of each column over all common time levels."
        lines += ["", f"relative: to the reference's norm at the same time. Last row: {last_row}"]

    low, high = SPEED_WINDOW_MS
    for label, peaks, speed in zip(comparison.labels, comparison.peaks, comparison.speeds):
        lines += ["", f"Peak of {label}", "       t in ms   pressure in Pa   at z in mm"]
        for time, crest in zip(comparison.times, peaks):
            lines.append(f"  {time:>12g}   {crest.pressure:>14.4f}   {crest.z:>10.3f}")
        lines.append(f"  speed between {low:g} and {high:g} ms: " + ("n/a" if speed is None else f"{speed:.4f} mm/ms"))
    return "\n".join(lines) + "\n"


def _difference_row(name: str, d: Difference) -> str:
    of_max, of_l2 = ("n/a" if value is None else f"{value:.2e}" for value in (d.max_relative, d.l2_relative))
    return f"  {name:>12}   {d.max_norm:>14.4e}   {of_max:>8}   {d.l2_norm:>20.4e}   {of_l2:>8}"


# Of (run's label, time, place, pressure).
WAVES: Sequence[Column[tuple[str, float, float, float]]] = (
    Column(csv="run", value=lambda w: w[0]),
    Column(csv="time", unit="ms", value=lambda w: float(w[1])),
    Column(csv="z", unit="mm", value=lambda w: float(w[2])),
    Column(csv="pressure", unit="Pa", value=lambda w: float(w[3])),
)


def waves_table(runs: Sequence[Run], labels: Sequence[str], times: Sequence[float]) -> Table:
    """All runs at the selected times, each at its own points."""
    waves = [(label, run.pressure, time) for label, run in zip(labels, runs) for time in times]
    records = [(label, t, z, p) for label, pressure, t in waves for z, p in zip(pressure.z, pressure.at(t))]
    return Table("pressure_waves", "Pressure along the centre line", WAVES, records)


def write_json(path: Path, comparison: Comparison) -> None:
    """The printed numbers in full precision; null where the table says n/a."""
    runs = []
    for i, (label, made) in enumerate(zip(comparison.labels, comparison.conditions)):
        peaks = zip(comparison.times, comparison.peaks[i])
        run: dict[str, Any] = {"run": label, "mesh": made.mesh or None}
        run |= {"step_ms": [made.smallest_step, made.largest_step], "end_ms": made.end}
        run["speed_mm_per_ms"] = comparison.speeds[i]
        run["peaks"] = [{"time_ms": time, "pressure_Pa": crest.pressure, "z_mm": crest.z} for time, crest in peaks]
        if i > 0:
            over_time = comparison.over_time[i - 1]
            at_times = zip(comparison.times, comparison.at_times[i - 1])
            run["differences"] = [{"time_ms": time, **_named(difference)} for time, difference in at_times]
            largest = _named(over_time.largest) if over_time.largest else {}
            run["largest_difference"] = {"common_levels": over_time.levels, **largest}
        runs.append(run)
    data = {"reference": comparison.labels[0], "speed_window_ms": SPEED_WINDOW_MS, "warnings": comparison.warnings}
    data["runs"] = runs
    write_text(path, json.dumps(data, indent=2, ensure_ascii=False) + "\n")


def _named(difference: Difference) -> dict:
    units = {"max_norm": "max_norm_Pa", "l2_norm": "l2_norm_Pa_sqrt_mm"}
    return {units.get(name, name): value for name, value in asdict(difference).items()}
