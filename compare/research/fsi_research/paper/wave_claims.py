"""The paper's claims about the waves, its section 5.6."""

from typing import List, Optional, Sequence

from ..catalogue import paper
from ..catalogue.names import MATERIALS
from .claims import Claim, unexamined, verdict
from .runs import PARTITIONED, TIMES
from .speeds import Measured, Speeds, finest_common, with_error
from .waves import Agreement, Stopped

# What each verdict asks for.
SAME = 1e-3  # relative difference that no picture shows
SAME_RULE = f"reproduced: waves apart by less than {SAME:g} of the largest pressure, until 1.5 ms"
SMALLER_RULE = (
    f"reproduced: converged waves apart by more than {SAME:g} over the whole run, the partitioned one "
    "the smaller; in part: apart"
)

SEEN = 0.05  # relative difference that a picture shows
CAUSE_RULE = (
    f"reproduced: stopped after the paper's 50 to 55 passes a step, the wave is off by more than {SEEN:g} "
    f"and its peaks are smaller at all times from {TIMES[2]:g} ms on; in part: stopped at some tolerance it "
    "is off by that much, and the error falls with the tolerance"
)

SIMILAR = 0.15  # relative difference of speeds and peaks that still counts as "quite similar"
SIMILAR_RULE = f"reproduced: crest speed and mean peak differ by less than {100 * SIMILAR:.0f} %"
SLOWER_RULE = (
    "reproduced: slower than both by more than the error estimates together; in part: slower than both; on "
    "the finest level of all three"
)
LOWER_RULE = "as for the speed, of the mean peak from 4.5 to 9 ms"


def wave_claims(agreements: Sequence[Agreement], stopped: Sequence[Stopped], speeds: Sequence[Speeds]) -> List[Claim]:
    return [*_drivers(agreements, stopped), *_materials(speeds)]


def _drivers(agreements: Sequence[Agreement], stopped: Sequence[Stopped]) -> List[Claim]:
    same = "In the first time steps the monolithic and the partitioned wave conform very well"
    smaller = "With time stepping the partitioned wave gets a smaller magnitude than the monolithic one"
    if not agreements:
        return [unexamined("5.6", same, SAME_RULE), unexamined("5.6", smaller, SMALLER_RULE), _cause(stopped)]
    start, all_levels = (max(getattr(a, name) for a in agreements) for name in ("start", "all"))
    lower = all(a.height < 1 for a in agreements)
    apart = all_levels > SAME
    return [
        Claim(
            "5.6",
            same,
            verdict(start < SAME),
            f"largest relative difference until 1.5 ms: {start:.1e}",
            f"both solve the same equations; {PARTITIONED} to 1e-6",
            SAME_RULE,
        ),
        Claim(
            "5.6",
            smaller,
            verdict(apart and lower, partly=apart),
            f"largest relative difference until 12 ms: {all_levels:.1e}",
            ""
            if apart
            else "converged, the two are one wave"
            + ("; stopped early, the partitioned one is off (next line)" if stopped else ""),
            SMALLER_RULE,
        ),
        _cause(stopped),
    ]


def _cause(stopped: Sequence[Stopped]) -> Claim:
    text = "The cause is the error of the fixed-point iteration, which accumulates"
    if not stopped:
        return unexamined("5.6", text, CAUSE_RULE)
    low, high = paper.cost()["fixed_point_iterations"]
    like_paper = next((s for s in stopped if low <= s.passes <= high), None)
    loosest, tightest = max(stopped, key=lambda s: s.difference), min(stopped, key=lambda s: s.difference)
    falls = tightest.difference < 0.2 * loosest.difference and loosest.difference > SEEN
    holds = like_paper is not None and like_paper.difference > SEEN and _lower(like_paper)
    numbers = f"stopped early, the wave is off by {_percent(tightest)} ({tightest.label}) to {_percent(loosest)}"
    if like_paper:
        numbers = (
            f"after {like_paper.passes:.0f} passes a step ({like_paper.label}) the wave is off by "
            f"{_percent(like_paper)}, its peaks are {_range(like_paper.ratios)} of the monolithic ones, smaller "
            f"at {sum(r < 1 for r in like_paper.ratios if r is not None)} of {len(TIMES)} times; {numbers}"
        )
    lower = [s.label for s in stopped if s.difference > SEEN and _lower(s)]
    direction = (
        f"smaller throughout from {TIMES[2]:g} ms: {', '.join(lower)}"
        if lower
        else f"no setting makes it smaller at all times from {TIMES[2]:g} ms on"
    )
    return Claim(
        "5.6",
        text,
        verdict(holds, partly=falls),
        f"{numbers}; all: table stopped_early",
        f"the error is real and falls with the tolerance; {direction}; it is a matter of the tolerance, not "
        "of partitioning",
        CAUSE_RULE,
    )


def _percent(s: Stopped) -> str:
    return f"{100 * s.difference:.2g} %"


def _lower(s: Stopped) -> bool:
    """Whether peaks are lower at all times from 4.5 ms on."""
    return all(r is not None and r < 1 for r in s.ratios[2:])


def _range(values: Sequence[Optional[float]]) -> str:
    known = [v for v in values if v is not None]
    return f"{min(known):.2f} to {max(known):.2f}" if known else "-"


def _materials(speeds: Sequence[Speeds]) -> List[Claim]:
    similar = "neo-Hookean and Mooney-Rivlin waves are quite similar in speed and magnitude"
    slower = "The artery's wave is slower than the other two"
    lower = "The artery's wave has a smaller magnitude than the other two"
    plain = {s.material: s for s in speeds if not s.reading}
    level = finest_common(list(plain.values()))
    if len(plain) < 3 or level is None:
        return [
            unexamined("5.6", similar, SIMILAR_RULE),
            unexamined("5.6", slower, SLOWER_RULE),
            unexamined("5.6", lower, LOWER_RULE),
        ]
    theory = [plain[name].long for name in MATERIALS]
    nh, mr, artery = (plain[name].measured[level] for name in MATERIALS)
    by_speed, by_height = (_of(mr, name) / _of(nh, name) - 1 for name in ("speed", "height"))

    def shown(name: str, form: str) -> str:
        return ", ".join(
            f"{plain[s].label} {with_error(getattr(m, name), getattr(m, f'{name}_error'), form)}"
            for s, m in zip(MATERIALS, (nh, mr, artery))
        )

    def below(name: str) -> str:
        return verdict(
            all(_clearly_below(artery, m, name) for m in (nh, mr)),
            partly=all(_of(artery, name) < _of(m, name) for m in (nh, mr)),
        )

    readings = [
        (_of(s.finest, "speed"), s.reading, s.finest.level) for s in speeds if s.material == "artery" and s.finest
    ]
    speed, reading, where = min(readings)
    others = f"; its slowest other reading: {speed:.2f} ({reading}, {where})" if reading else ""
    return [
        Claim(
            "5.6",
            similar,
            verdict(abs(by_speed) < SIMILAR and abs(by_height) < SIMILAR),
            f"Mooney-Rivlin's crest is {100 * by_speed:+.0f} % faster, its peak {100 * by_height:+.0f} % higher "
            f"({level})",
            f"theory: {100 * (theory[1] / theory[0] - 1):+.1f} % (long waves)",
            SIMILAR_RULE,
        ),
        Claim(
            "5.6",
            slower,
            below("speed"),
            f"crest in mm/ms ({level}): {shown('speed', '.2f')}; theory, long waves: "
            f"{', '.join(format(speed, '.2f') for speed in theory)}{others}; all: table wave_speed",
            ""
            if _of(artery, "speed") < _of(nh, "speed")
            else "c10 is the same as in the neo-Hookean wall, and fibres that act in extension can only stiffen it; no "
            "reading of the printed fibre term makes it slower",
            SLOWER_RULE,
        ),
        Claim(
            "5.6",
            lower,
            below("height"),
            f"mean of the largest pressures from {TIMES[2]:g} to {TIMES[-1]:g} ms in Pa ({level}): "
            f"{shown('height', '.1f')}",
            ""
            if _of(artery, "height") < _of(nh, "height")
            else "a stiffer wall carries the same impulse in a higher and faster wave",
            LOWER_RULE,
        ),
    ]


def _clearly_below(one: Measured, other: Measured, name: str) -> bool:
    errors = sum(getattr(m, f"{name}_error") or 0.0 for m in (one, other))
    return _of(other, name) - _of(one, name) > errors


def _of(measured: Measured, name: str) -> float:
    """Speed or height of a level that has both."""
    value = getattr(measured, name)
    assert value is not None, f"level {measured.level} is not complete"
    return value
