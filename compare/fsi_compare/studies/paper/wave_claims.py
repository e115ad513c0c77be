"""The paper's claims about the waves, its section 5.6."""

from typing import List, Optional, Sequence

from ...names import MATERIALS
from .claims import Claim, unexamined, verdict
from .runs import PARTITIONED, TIMES, PaperRuns
from .waves import Agreement, Speeds, Stopped, mean_peak

SAME = 1e-3  # relative difference that no picture shows
SIMILAR = 0.15  # relative difference of speeds and peaks that still counts as "quite similar"


def wave_claims(runs: PaperRuns, agreements: Sequence[Agreement], stopped: Sequence[Stopped],
                speeds: Sequence[Speeds]) -> List[Claim]:
    return [*_drivers(agreements, stopped), *_materials(runs, speeds)]


def _drivers(agreements: Sequence[Agreement], stopped: Sequence[Stopped]) -> List[Claim]:
    same = "In the first time steps the monolithic and the partitioned wave conform very well"
    smaller = "With time stepping the partitioned wave gets a smaller magnitude than the monolithic one"
    cause = "The cause is the error of the fixed-point iteration, which accumulates"
    if not agreements:
        return [unexamined("5.6", text) for text in (same, smaller, cause)]
    start, all_levels = (max(getattr(a, name) for a in agreements) for name in ("start", "all"))
    claims = [
        Claim("5.6", same, verdict(start < SAME), f"largest relative difference until 1.5 ms: {start:.1e}",
              f"both solve the same equations; {PARTITIONED} to 1e-6"),
        Claim("5.6", smaller, verdict(all_levels > SAME), f"largest relative difference until 12 ms: {all_levels:.1e}",
              "converged, the two are one wave" +
              ("; stopped early, the partitioned one is off, but in both directions (next line)" if stopped else "")),
    ]
    if not stopped:
        return [*claims, unexamined("5.6", cause)]
    numbers = "; ".join(f"{s.label}: {s.passes:.0f} iterations a step, peaks {_range(s.ratios)} of the monolithic "
                        f"ones, wave off by up to {100 * s.difference:.2g} %" for s in stopped)
    loosest, tightest = max(stopped, key=lambda s: s.difference), min(stopped, key=lambda s: s.difference)
    falls = tightest.difference < 0.2 * loosest.difference and loosest.difference > SAME
    lower = [s.label for s in stopped if s.difference > 0.05 and all(r is not None and r < 1 for r in s.ratios[2:])]
    direction = (f"smaller throughout only: {', '.join(lower)}" if lower else
                 "it makes the wave larger at one time and smaller at another, never smaller throughout")
    claims.append(Claim("5.6", cause, verdict(False, partly=falls), numbers,
                        "the error of an iteration stopped early is real and falls with the tolerance; "
                        f"{direction}; it is a matter of the tolerance, not of partitioning"))
    return claims


def _range(values: Sequence[Optional[float]]) -> str:
    known = [v for v in values if v is not None]
    return f"{min(known):.2f} to {max(known):.2f}" if known else "-"


def _materials(runs: PaperRuns, speeds: Sequence[Speeds]) -> List[Claim]:
    similar = "neo-Hookean and Mooney-Rivlin waves are quite similar in speed and magnitude"
    slower = "The artery's wave is slower than the other two"
    lower = "The artery's wave has a smaller magnitude than the other two"
    plain = {s.material: s for s in speeds if not s.reading}
    mesh = runs.finest
    if len(plain) < 3 or any(
            s.measured.get(mesh) is None or mean_peak(s.peaks.get(mesh)) is None for s in plain.values()):
        return [unexamined("5.6", text) for text in (similar, slower, lower)]
    nh, mr, artery = (plain[name] for name in MATERIALS)
    speed = {s.material: s.measured[mesh] for s in (nh, mr, artery)}
    height = {s.material: mean_peak(s.peaks[mesh]) for s in (nh, mr, artery)}
    by_speed = speed["mooney-rivlin"] / speed["neo-hookean"] - 1
    by_height = height["mooney-rivlin"] / height["neo-hookean"] - 1
    others = max(speed["neo-hookean"], speed["mooney-rivlin"])
    claims = [
        Claim("5.6", similar, verdict(abs(by_speed) < SIMILAR and abs(by_height) < SIMILAR),
              f"Mooney-Rivlin's crest is {100 * by_speed:+.0f} % faster, its peak {100 * by_height:+.0f} % higher "
              f"({mesh} mesh)",
              f"theory: {100 * (mr.thick / nh.thick - 1):+.1f} % (long waves)"),
        Claim("5.6", slower, verdict(speed["artery"] < min(speed.values()) * (1 + 1e-9) and speed["artery"] < others),
              f"crest in mm/ms: artery {speed['artery']:.2f}, neo-Hookean {speed['neo-hookean']:.2f}, Mooney-Rivlin "
              f"{speed['mooney-rivlin']:.2f}; theory (long waves): {artery.thick:.2f}, {nh.thick:.2f}, "
              f"{mr.thick:.2f}{_readings(speeds, mesh)}",
              "c10 is the same as in the neo-Hookean wall, and fibres that act in extension can only stiffen it; no "
              "reading of the printed fibre term makes it slower"),
        Claim("5.6", lower, verdict(height["artery"] < min(height["neo-hookean"], height["mooney-rivlin"])),
              f"mean of the largest pressures from {TIMES[2]:g} to {TIMES[-1]:g} ms: artery {height['artery']:.0f} "
              f"Pa, neo-Hookean {height['neo-hookean']:.0f} Pa, Mooney-Rivlin {height['mooney-rivlin']:.0f} Pa",
              "" if height["artery"] < height["neo-hookean"] else "a stiffer wall carries the same impulse in a "
                                                                  "higher and faster wave"),
    ]
    return claims


def _readings(speeds: Sequence[Speeds], mesh: str) -> str:
    """Other readings of the artery, measured."""
    found = []
    for s in speeds:
        value = s.measured.get(mesh) or next((v for v in s.measured.values() if v), None)
        if s.reading and value is not None:
            found.append(f"{s.label} {value:.2f}")
    return f"; other readings: {', '.join(found)}" if found else ""
