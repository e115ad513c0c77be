"""How far seconds of runs can be trusted."""

from typing import Iterable

from fsi_compare.study.study_run import StudyRun
from ..evidence.timings import spread


def timing_words(runs: Iterable[StudyRun]) -> str:
    """How far seconds of these runs can be trusted, in a sentence."""
    done = {run.folder: run for run in runs if run.done}.values()
    spreads = [(len(run.timings), spread(run.timings)) for run in done]
    repeated = [(count, ratio) for count, ratio in spreads if ratio is not None]
    if not repeated:
        return "Seconds are single timings."
    ratios = sorted(ratio for _, ratio in repeated)
    once = len(done) - len(repeated)
    return (
        f"Seconds are medians of {max(count for count, _ in repeated)} timings"
        + (f", those of the {once} longest runs single ones" if once else "")
        + f"; slowest over fastest of the same run: {ratios[len(ratios) // 2]:.2f} in the middle, {ratios[-1]:.2f} "
        "at most. Smaller differences mean nothing."
    )
