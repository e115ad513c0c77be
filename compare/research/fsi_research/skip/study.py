"""Kind `skip`: what is saved by not doing what a scene does not need. Each group of runs is a scene in two forms, first
with an economy and then with that economy switched off from outside; several repetitions, of which the median counts.
They also tell the noise of the seconds, and a ratio inside it is marked as such."""

import statistics
from dataclasses import dataclass, replace
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple

from fsi_compare.base.errors import InputError
from fsi_compare.base.suggestions import nearest
from fsi_compare.reporting.column import Column, fixed
from fsi_compare.reporting.layout import Table
from fsi_compare.runs.differences import largest_difference
from ..evidence.cross_check import waves_of
from fsi_compare.study.context import Context
from fsi_compare.study.section import Section
from fsi_compare.study.study_file import Request, Study, show
from ..catalogue.report_section import report_of
from fsi_compare.study.study_run import StudyRun

REPORT_KEYS = ("repeat", "economies")
ECONOMY_KEYS = ("label", "counter", "off", "off_label", "differs")


@dataclass(frozen=True)
class Economy:
    name: str  # of its group of runs
    label: str
    counter: str  # of summary.json: a total, a counter, a phase whose calls are meant, or "PHASE seconds"
    on_label: str
    off_label: str
    on: Sequence[Any]  # requests or runs, its repetitions
    off: Sequence[Any]
    differs: str  # why the two results differ; empty: they are the same


def check(study: Study) -> None:
    economies(study, study.requests, lambda request: request)


def economies(study: Study, items: Sequence[Any], request_of: Callable[[Any], Request]) -> List[Economy]:
    """`items`: requests or runs; `request_of` gives an item's request. Groups that the quick form leaves out are
    skipped."""
    report = report_of(study, REPORT_KEYS)
    repeat = report.text("repeat", "repeat")
    groups: Dict[str, Dict[Tuple, List[Any]]] = {}
    for item in items:
        request: Request = request_of(item)
        form = (request.case, request.method.name, *((k, show(v)) for k, v in request.values.items() if k != repeat))
        groups.setdefault(request.group, {}).setdefault(form, []).append(item)
    named = report.table("economies")
    if not named:
        raise InputError(
            study.path, "report.economies", "is missing", "name each group of runs there, with label and counter"
        )
    found = []
    for name, entry in named.items():
        key = f"report.economies.{name}"
        section = Section(study.path, key, entry, ECONOMY_KEYS)
        for needed in ("label", "counter"):
            section.text(needed)
        for other in ECONOMY_KEYS:
            section.text(other, "")
        if name not in groups:
            if study.quick:
                continue
            raise InputError(study.path, key, "is no group of runs", f"did you mean '{nearest(name, list(groups))}'?")
        found.append(_economy(study, name, entry, groups, repeat, request_of))
    return found


def _economy(
    study: Study,
    name: str,
    entry: Mapping[str, str],
    groups: Mapping[str, Mapping[Tuple, List[Any]]],
    repeat: str,
    request_of: Callable[[Any], Request],
) -> Economy:
    forms = list(groups[name].items())
    if "off" in entry:
        if entry["off"] not in groups:
            problem = f"'{entry['off']}' is no group of runs"
            remedy = f"did you mean '{nearest(entry['off'], list(groups))}'?"
            raise InputError(study.path, f"report.economies.{name}.off", problem, remedy)
        forms += list(groups[entry["off"]].items())
    if len(forms) != 2:
        problem = f"has {len(forms)} forms beside its repetitions"
        raise InputError(study.path, f"runs.{name}", problem, "give two: first with the economy, then without")

    def label(items: Sequence[Any]) -> str:
        request = request_of(items[0])
        return ", ".join(show(v) for k, v in request.values.items() if k != repeat) or request.case

    (_, on), (_, off) = forms
    return Economy(
        name,
        entry["label"],
        entry["counter"],
        label(on),
        entry.get("off_label", label(off)),
        on,
        off,
        entry.get("differs", ""),
    )


@dataclass(frozen=True)
class Measured:
    economy: Economy
    on_s: float  # median seconds of the run, mesh and output included
    off_s: float
    noise: float  # factor by which seconds differ for no reason; see with_common_noise
    on_count: Optional[float]
    off_count: Optional[float]
    difference: Optional[float]  # of the two results: largest over the time levels, relative to each level's largest

    @property
    def request(self) -> Request:
        return self.economy.on[0].request

    @property
    def ratio(self) -> float:
        return self.off_s / self.on_s

    @property
    def in_noise(self) -> bool:
        return max(self.ratio, 1 / self.ratio) <= self.noise


def evaluate(context: Context) -> int:
    report = context.report
    found = economies(context.study, context.runs, lambda run: run.request)
    broken = [run for economy in found for run in (*economy.on, *economy.off) if not run.done]
    measured = with_common_noise([measure(e) for e in found if all(run.done for run in (*e.on, *e.off))])
    report.section("In short")
    if broken:
        report.text(f"**{len(broken)} runs did not come to their end; their economies are left out:**")
        report.list([f"{run.request.label}: {run.status}, {run.message}" for run in broken])
    if not measured:
        return 2
    best = sorted((m for m in measured if not m.in_noise), key=lambda m: -m.ratio)
    silent = [m.economy.label.lower() for m in measured if m.in_noise]
    report.text(
        "Each row is one scene, run as the toolkit does it and with one economy switched off. "
        + ("The largest savings: " if best else "No saving shows in the seconds. ")
        + "; ".join(f"{m.economy.label.lower()}, {m.ratio:.2g} times the seconds without it" for m in best[:3])
        + (". " if best else "")
        + f"Medians of {len(measured[0].economy.on)} runs each. Runs of one and the same form differ too, by a "
        f"factor of up to {max(m.noise for m in measured):.2f}"
        + (f"; inside that noise, so that their seconds say nothing: {', '.join(silent)}." if silent else ".")
    )
    from .pictures import bars_figure

    report.section("With and without")
    report.figure(
        "skip",
        lambda: bars_figure(measured),
        "Seconds of a run and the work that the economy is about, each on its own logarithmic scale. Behind "
        "the bars: without over with." + (" Grey: the seconds differ by no more than their noise." if silent else ""),
    )
    report.table(_table(measured))
    return 2 if broken else 0


def measure(economy: Economy) -> Measured:
    """Noise: the largest over the smallest seconds among the repetitions of one form."""
    seconds = [[run.wall_s for run in runs] for runs in (economy.on, economy.off)]
    one, other = (waves_of(runs[0]) for runs in (economy.on, economy.off))
    difference = None
    if one is not None and other is not None:
        largest = largest_difference(one, other).largest
        difference = largest.max_relative if largest else None
    return Measured(
        economy,
        statistics.median(seconds[0]),
        statistics.median(seconds[1]),
        max(max(s) / min(s) for s in seconds),
        counter(economy.on[0], economy.counter),
        counter(economy.off[0], economy.counter),
        difference,
    )


def with_common_noise(measured: Sequence[Measured]) -> List[Measured]:
    """A few repetitions can agree by chance: no row has less noise than the median row."""
    common = statistics.median(m.noise for m in measured) if measured else 1.0
    return [replace(m, noise=max(m.noise, common)) for m in measured]


def counter(run: StudyRun, name: str) -> Optional[float]:
    """A total, a counter, the calls of a phase or, as "PHASE seconds", its seconds; 0 where the run did not do it."""
    phases = run.summary.get("phases", {})
    if name.endswith(" seconds"):
        return float(phases.get(name.removesuffix(" seconds"), {}).get("seconds", 0.0))
    for values in (run.summary.get("totals", {}), run.summary.get("counters", {})):
        for key in (name, name.replace(" ", "_")):
            if key in values:
                return float(values[key])
    return float(phases.get(name, {}).get("calls", 0))


COLUMNS: Sequence[Column[Measured]] = (
    Column(csv="economy", value=lambda m: m.economy.name),
    Column("economy", "label", lambda m: m.economy.label, left=True),
    Column(
        "with it",
        "with",
        lambda m: m.economy.on_label,
        text=lambda m: f"{m.economy.on_label} ({m.request.method.label})",
        left=True,
    ),
    Column("switched off", "switched_off", lambda m: m.economy.off_label, left=True),
    Column(csv="case", value=lambda m: m.request.case),
    Column(csv="method", value=lambda m: m.request.method.name),
    Column("with", "with", lambda m: m.on_s, ".2f", "s", "seconds"),
    Column("without", "without", lambda m: m.off_s, ".2f", "s", "seconds"),
    Column(
        "ratio",
        "ratio",
        lambda m: m.ratio,
        text=lambda m: f"{m.ratio:.2f} (in the noise)" if m.in_noise else f"{m.ratio:.2f}",
        group="seconds",
    ),
    Column("noise", "noise", lambda m: m.noise, ".2f", group="seconds"),
    Column(csv="in_noise", value=lambda m: m.in_noise),
    Column("counted", "counter", lambda m: m.economy.counter),
    Column("with", "with_count", lambda m: m.on_count, ".4g", group="count"),
    Column("without", "without_count", lambda m: m.off_count, ".4g", group="count"),
    Column(
        "relative difference of the answers",
        "largest_difference",
        lambda m: m.difference,
        text=lambda m: m.economy.differs or fixed(m.difference, ".1e"),
    ),
)


def _table(measured: Sequence[Measured]) -> Table:
    return Table(
        "skip",
        "The same scene with and without each economy",
        COLUMNS,
        measured,
        notes=[
            "Noise: the factor between the slowest and the quickest run of one form, here or in the median "
            "row, whichever is larger; a ratio that is no further from 1 says nothing.",
            "Counted: of `summary.json`; of a phase its calls. Difference: largest over all time "
            "levels, relative to the largest pressure of the level.",
        ],
    )
