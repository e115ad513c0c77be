"""The HTML report of a verification: answer, bars, waves with bands, the bar against the sizes, the family."""

import re
from pathlib import Path
from typing import Sequence

import numpy as np
from matplotlib.figure import Figure

from ..reporting.report import Report
from .results import Band, FamilyRuns, Judged
from .tables import bars_table, in_short, members_table
from .verdict import NOT_IN_RANGE

MOST_WAVES = 12  # pictures
ON_A_PICTURE = 6  # curves
HOW = (
    "A family of runs around the case was made: steps twice and half as long, meshes coarser and finer, one with both, one "
    "with looser tolerances. The differences of their results show how far the case's own are from those of infinitely small "
    "elements and steps. The bar is what is known to be wrong, the distance from the finest member, and two to three times "
    "what its members say is left beyond it. It says nothing of the model: geometry, materials and conditions."
)


def write_page(
    folder: Path,
    title: str,
    notes: Sequence[str],
    judged: Sequence[Judged],
    waves: Sequence[Band],
    families: Sequence[FamilyRuns],
) -> Report:
    report = Report(folder, f"How wrong are the results: {title}")
    report.answer(in_short(judged, families))
    report.text(HOW)
    report.list(notes)
    report.section("Error bars")
    report.table(bars_table(judged))
    if any(one.bar.verdict == NOT_IN_RANGE for one in judged):
        report.text(
            "No error can be given of quantities whose values do not come nearer to each other as mesh and step are refined, or "
            "which swing. What to refine stands beside them."
        )
    if waves:
        report.section("Curves and lines with their bands")
        for number, group in enumerate(_groups(waves), 1):
            stem = f"waves_{number}"
            names = "; ".join(f"{band.name} ({band.driver})" for band in group)
            caption = f"{names}. The band is what the curve may be off by at each place."
            report.figure(stem, lambda group=group: waves_figure(group), caption)  # type: ignore[misc]
    report.section("Where the error comes from")
    caption = "The parts of the widest bars, relative to the largest of their curve."
    report.figure("parts", lambda: parts_figure(judged), caption)
    report.section("The family")
    report.table(members_table(families))
    report.write()
    return report


def _groups(waves: Sequence[Band]) -> list[list[Band]]:
    """Curves of one column share a picture."""
    groups: dict = {}
    for band in waves:
        kind = re.sub(r" [xyz]$", "", band.name.rpartition(": ")[2])
        groups.setdefault((kind, band.unit, band.driver, band.along), []).append(band)
    split = [group[i : i + ON_A_PICTURE] for group in groups.values() for i in range(0, len(group), ON_A_PICTURE)]
    return split[:MOST_WAVES]


def waves_figure(group: Sequence[Band]) -> Figure:
    figure = Figure(figsize=(7.0, 3.4), layout="constrained")
    axes = figure.add_subplot()
    for band in group:
        (line,) = axes.plot(band.x, band.values, label=band.name, linewidth=1)
        low, high = band.values - band.half_width, band.values + band.half_width
        axes.fill_between(band.x, low, high, color=line.get_color(), alpha=0.25, linewidth=0)
    axes.set_xlabel("along the line in mm" if group[0].along else "time in ms")
    axes.set_ylabel(f"{group[0].name.rpartition(': ')[2].partition(',')[0]} in {group[0].unit}".removesuffix(" in "))
    axes.legend(fontsize="small")
    return figure


def parts_figure(judged: Sequence[Judged]) -> Figure:
    shown = sorted((one for one in judged if one.bar.given), key=lambda one: -one.bar.relative)[:15][::-1]
    figure = Figure(figsize=(7.0, 1.2 + 0.28 * max(len(shown), 1)), layout="constrained")
    axes = figure.add_subplot()
    left, rows = np.zeros(len(shown)), np.arange(len(shown))
    for name, color in (("mesh", "tab:blue"), ("step", "tab:orange"), ("both", "tab:green"), ("solver", "tab:gray")):
        widths = np.array([100 * one.bar.parts[name] / one.bar.scale for one in shown])
        axes.barh(rows, widths, left=left, color=color, label=name)
        left = left + widths
    axes.set_yticks(rows, [f"{one.quantity.name} ({one.driver})" for one in shown], fontsize="x-small")
    axes.set_xlabel("part of the bar in %")
    axes.legend(fontsize="small")
    return figure
