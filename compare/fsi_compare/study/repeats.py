"""Runs that are short are timed several times: the one of median seconds stays, and how far the others were off."""

import filecmp
from pathlib import Path
from typing import Sequence

from ..base.errors import InputError
from ..base.files import is_file, remove_tree
from ..runs.summary import FILE, read_summary

# The same bits whenever the same run is made.
RESULTS = ("centerline_pressure.csv", "wall_displacement.csv", "lines.csv")
NOT_THE_SAME = "its results were not the same when it was repeated"


def step_seconds(folder: Path) -> float:
    """Seconds of the time steps, from summary.json; NaN when there is none."""
    try:
        return float(read_summary(folder / FILE)["totals"]["wall_s"])
    except (InputError, KeyError):
        return float("nan")


def same_results(folders: Sequence[Path]) -> bool:
    """Whether the files of all repetitions equal the first one's, bit by bit; one that failed may have fewer."""
    first, *others = folders
    pairs = [(first / file, other / file) for other in others for file in RESULTS if is_file(first / file)]
    return all(is_file(there) and filecmp.cmp(here, there, shallow=False) for here, there in pairs)


def keep_median(folder: Path, repetitions: Sequence[Path]) -> list[float]:
    """Leaves the repetition of median seconds (of two middle ones the faster) in `folder` and removes the others;
    the seconds of all, sorted. Where the process is killed in between, the run is made anew."""
    seconds = {place: step_seconds(place) for place in [folder, *repetitions]}
    order = sorted(seconds, key=lambda place: seconds[place])
    middle = order[(len(order) - 1) // 2]
    if middle != folder:
        remove_tree(folder)
        middle.rename(folder)
    for place in repetitions:
        remove_tree(place)
    return sorted(seconds.values())
