"""What the paper's study found, in five lines: drivers, wave, accuracy, cost, and what failed. Each is made from the
runs, or says what is missing."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Mapping, Optional, Sequence

from ..catalogue.names import MATERIALS
from fsi_compare.runs.work_units import shown
from ..evidence.mesh_error import MeshError, percent
from .claims import NOT_REPRODUCED, Claim, tally
from .cost import FAST_MONOLITHIC, NOISE, PAPER_MONOLITHIC, PAPER_PARTITIONED, RIVALS, StepCost
from .runs import TIMES, PaperRuns, mesh_of
from .speeds import Speeds, finest_common, level_of
from .wave_claims import SAME
from .waves import Agreement, shown_waves

ROUGH = 0.1  # beyond this error a wave tells methods apart, but not what an artery does


@dataclass(frozen=True)
class Found:
    """All that the lines are made from."""

    runs: PaperRuns
    claims: Sequence[Claim]
    agreements: Sequence[Agreement]
    speeds: Sequence[Speeds]
    errors: Mapping[Path, MeshError]  # by a run's folder
    costs: Sequence[StepCost]
    missing: Sequence[str]  # what did not come to its end


def answer(found: Found) -> List[str]:
    return [
        drivers(found.agreements),
        wave(found.speeds),
        accuracy(found.runs, found.errors),
        cost(found.costs),
        failures(found.claims, len(found.runs.asked), found.missing),
    ]


def drivers(agreements: Sequence[Agreement]) -> str:
    known = [a for a in agreements if math.isfinite(a.all)]
    if not known:
        return "**Drivers:** not compared; no wall has a finished wave of both."
    worst = max(a.all for a in known)
    walls = len({a.material for a in known})
    where = f"{walls} {'wall' if walls == 1 else 'walls'}, {_listed([a.mesh for a in known])} mesh"
    found = (
        "find the same wave. They differ by at most" if worst < SAME else "find different waves. They differ by up to"
    )
    return f"**Drivers:** the monolithic and the partitioned one {found} {worst:.1e} of the largest pressure ({where})."


def wave(speeds: Sequence[Speeds]) -> str:
    plain = [s for s in speeds if not s.reading]
    level = finest_common(plain)
    if level is None:
        return "**Wave:** its crest cannot be followed in every wall; the runs are too short, or some are missing."
    crests, words = [], []
    for s in plain:
        measured = s.measured[level]
        if measured.speed is not None and measured.height is not None:
            crests.append((measured.speed, s.label))
            words.append(f"{measured.speed:.2f} mm/ms and {measured.height:.0f} Pa in the {s.label} wall")
    ordered = sorted(crests, reverse=True)
    clear = len(ordered) > 1 and f"{ordered[0][0]:.2f}" != f"{ordered[1][0]:.2f}"
    fastest = f" It is fastest in the {ordered[0][1]} wall." if clear else ""
    return (
        f"**Wave:** speed of its crest and mean peak from {TIMES[2]:g} to {TIMES[-1]:g} ms are {', '.join(words)} "
        f"({_mesh(level)}).{fastest}"
    )


def accuracy(runs: PaperRuns, errors: Mapping[Path, MeshError]) -> str:
    by_level: Dict[str, List[MeshError]] = {}
    unknown: Dict[str, List[str]] = {}  # waves by the reason
    for run in shown_waves(runs):
        error = errors.get(run.folder)
        if error is None:
            continue
        if error.pressure is None:
            name = MATERIALS.get(run.request.case, run.request.case)
            unknown.setdefault(error.unknown, []).append(f"{name}, {_mesh(level_of(run))}")
        else:
            by_level.setdefault(level_of(run), []).append(error)
    why = "; ".join(f"{' and '.join(waves)}: {reason}" for reason, waves in unknown.items())
    if not by_level:
        if len(unknown) == 1:
            why = next(iter(unknown))
        return f"**Accuracy:** the error of mesh and time step is unknown ({why or 'no wave is there'})."
    parts, least = [], float("inf")
    for level, found in by_level.items():
        pressure = [e.pressure for e in found if e.pressure is not None]
        displacement = [e.displacement for e in found if e.displacement is not None]
        least = min(least, max(pressure + displacement))
        parts.append(f"{_range(pressure)} in pressure and {_range(displacement)} in displacement on the {_mesh(level)}")
    own = [value for e in errors.values() for value in (e.own_pressure, e.own_displacement) if value is not None]
    meaning = "" if least < ROUGH else " Such waves tell methods apart, but not what an artery does."
    return (
        f"**Accuracy:** mesh and time step put the waves off the reference by {'; by '.join(parts)}. The reference's own "
        f"error is estimated as {_range(own)}.{meaning}" + (f" Unknown for {why}." if why else "")
    )


def cost(costs: Sequence[StepCost]) -> str:
    if not costs:
        return "**Cost:** not measured; the runs for it are missing."
    mesh = mesh_of(costs[-1].run)  # coarse first
    here = {c.method: c for c in costs if mesh_of(c.run) == mesh}
    fast = here.get(FAST_MONOLITHIC)
    rival = min((here[name] for name in RIVALS if name in here), key=lambda c: c.seconds, default=None)
    parts = []
    if fast:
        parts.append(f"{_seconds(fast)} with our monolithic solver")
    if rival:
        label = f"{rival.run.method_label}{_times(rival, fast)}"
        parts.append(f"{_seconds(rival)} with the quickest partitioned scheme ({label})")
    for name, words in ((PAPER_MONOLITHIC, "the paper's monolithic solver"), (PAPER_PARTITIONED, "its fixed point")):
        if name in here and here[name] is not rival:
            parts.append(f"{_seconds(here[name])} with {words}")
    if not parts:
        return f"**Cost:** no run of either approach was timed on the {mesh} mesh."
    return f"**Cost:** a time step takes {'; '.join(parts)} ({mesh} mesh)."


def failures(claims: Sequence[Claim], runs: int, missing: Sequence[str]) -> str:
    failed = [claim.claim for claim in claims if claim.verdict == NOT_REPRODUCED]
    bad = len(missing)
    ended = (
        f"{bad} {'run' if bad == 1 else 'runs'} did not end well: see Missing."
        if bad
        else f"All {runs} runs ended well."
    )
    return f"**Claims:** {tally(claims)[0].lower()}{tally(claims)[1:]} {ended}" + (
        f" Not reproduced: {'; '.join(failed)}." if failed else ""
    )


def _seconds(one: StepCost) -> str:
    work = one.run.work_units_per_step
    return f"{one.seconds:.3g} s" if work is None else f"{shown(work)} work units ({one.seconds:.3g} s)"


def _times(one: StepCost, other: Optional[StepCost]) -> str:
    """How much longer one takes than the other, behind its seconds."""
    if other is None or not other.seconds > 0:
        return ""
    ratio = one.seconds / other.seconds
    if 1 / NOISE < ratio < NOISE:
        return ", which timing does not tell apart"
    return f", {ratio:.1f} times as long" if ratio > 1 else f", {1 / ratio:.1f} times as fast"


def _range(values: Sequence[float]) -> str:
    low, high = percent(min(values)), percent(max(values))
    return low if low == high else f"{low.removesuffix(' %')} to {high}"


def _mesh(level: str) -> str:
    """'fine mesh', or 'fine mesh with stabilisation 0.05' for a level that names its stabilisation."""
    mesh, comma, factor = level.partition(", ")
    return f"{mesh} mesh" + (f" with stabilisation {factor}" if comma else "")


def _listed(names: Sequence[str]) -> str:
    return " and ".join(dict.fromkeys(names))
