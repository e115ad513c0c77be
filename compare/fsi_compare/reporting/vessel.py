"""The section of a report that shows the vessel: which runs and fields, stills of them, and what is left out."""

import functools
from typing import Callable, NamedTuple, Sequence

from matplotlib.figure import Figure

from ..results.picture import Scene, picture
from ..results.run import RunResults
from ..results.surfaces import ASK
from ..results.units import time_words
from .layout import Table
from .places import apart_table, places_table
from .report import Report
from .scene import ReportScene
from .vessel_library import MISSING, library

MOST_RUNS = 4  # in one page
STILLS = 4
STILL_FIELDS = ("wall_shear_stress", "displacement", "von_mises_stress", "velocity", "pressure", "tawss", "osi")
Still = tuple[str, Callable[[], Figure], str]


class Vessel(NamedTuple):
    """Runs that have fields: names, and what is shown of them."""

    names: list[str]
    scenes: list[Scene]


def vessel_of(runs: Sequence[RunResults], labels: Sequence[str]) -> Vessel:
    """Reads the meshes of the first few runs that have fields. Raises InputError for files that cannot be read."""
    places = [i for i, run in enumerate(runs) if run.fields][:MOST_RUNS]
    return Vessel([labels[i] for i in places], [runs[i].scene for i in places])


def add_vessel(
    report: Report, runs: Sequence[RunResults], labels: Sequence[str], vessel: Vessel, frames: int | None = None
) -> Table | None:
    """The table of differences of the runs' fields; None where no run has fields."""
    for run, label in zip(runs, labels):
        if not run.fields:
            report.text(f"{label} has no fields, so that its vessel is not shown: {ASK}.")
    left_out = sum(1 for run in runs if run.fields) - len(vessel.scenes)
    if left_out > 0:
        report.text(f"The first {MOST_RUNS} runs with fields are shown; {left_out} more would make the page too large.")
    if not vessel.scenes:
        return None
    if library() is None:
        report.text(f"{MISSING[0].upper()}{MISSING[1:]}.")
    scene = ReportScene(vessel.names, vessel.scenes, frames)
    report.scene(scene, stills_of(vessel))
    table, looks = places_table(scene)
    report.places(table, looks)
    return apart_table(scene)


def stills_of(vessel: Vessel) -> list[Still]:
    """Stills of the first run, each at the time at which the field is largest."""
    scene, name = vessel.scenes[0], vessel.names[0]
    keys = [key for key in STILL_FIELDS if key in scene.quantities][:STILLS] or [scene.first]
    found: list[Still] = []
    for key in keys:
        time = scene.peak(key)
        words = scene.quantity(key).words
        draw = functools.partial(picture, scene, key, time, title=name)
        clock = time_words(f"{time:g}", scene.static)
        caption = f"{words[0].upper()}{words[1:]} of {name} at {clock}, where it is largest."
        found.append((f"vessel_{key}", draw, caption))
    return found
