"""What a reader of a report is told first: what was computed, whether it can be trusted, flows and pressures of the
openings, what it cost."""

from typing import Any, Callable, Mapping, NamedTuple, Sequence

import numpy as np

from ..base.errors import printable
from ..base.numbers import is_number, number_of
from ..results.openings import Opening
from ..results.run import RunResults
from ..results.units import PER_KPA, time_words
from ..runs.steadiness import cycle_change, period_of, sawtooth
from .column import Column
from .layout import Table

SUPPLIED = ("inlet_work", "load_work", "inlet_kinetic_inflow", "support_work")  # columns of energy.csv
Labelled = tuple[str, RunResults]


def case_lines(runs: Sequence[RunResults], labels: Sequence[str]) -> list[str]:
    """The case in words, one fact a line; a fact that differs between runs is said of each."""
    facts = {
        "case": [run.title for run in runs],
        "program": [run.program for run in runs],
        "element": [word_of(run.summary, "element") for run in runs],
        "geometry": [word_of(run.summary, "geometry") for run in runs],
        "mesh": [_mesh(run) for run in runs],
        "unknowns": [_count(run.summary.get("unknowns", {}), "coupled") for run in runs],
        "steps": [_steps(run) for run in runs],
        "openings": [", ".join(run.openings) for run in runs],
        "chosen by the program": [_choices(run) for run in runs],
    }
    lines = []
    for name, values in facts.items():
        each = "; ".join(f"{label}: {value or 'none'}" for label, value in zip(labels, values))
        said = values[0] if len(set(values)) == 1 else each
        lines += [f"**{name}**: {said}"] if said else []
    return lines


def _count(entries: Mapping[str, Any], name: str, unit: str = "") -> str:
    number = entries.get(name)
    return f"{number:,}{unit}" if isinstance(number, int) else ""


def _mesh(run: RunResults) -> str:
    mesh = run.summary.get("mesh", {})
    cells = _count(mesh, "tetrahedra", " tetrahedra") or _count(mesh, "triangles", " triangles")
    return ", ".join(part for part in (word_of(mesh, "name"), _count(mesh, "nodes", " nodes"), cells) if part)


def _steps(run: RunResults) -> str:
    if "iterations.csv" not in run.tables:
        return ""
    time = run.time
    if not len(time):
        return "none"
    sizes = np.diff(np.concatenate([[0.0], time]))
    size = f"{sizes[0]:g}" if np.ptp(sizes) < 1e-6 * sizes.mean() else f"{sizes.min():.3g} to {sizes.max():.3g}"
    size, end = (time_words(words, run.static) for words in (size, f"{time[-1]:g}"))
    return f"{len(time):,} of {size}, to {end}"


def _choices(run: RunResults) -> str:
    found = run.summary.get("choices", {})
    choices = found.items() if isinstance(found, dict) else ()
    return ", ".join(f"{printable(name)} = {word_of(one, 'value')}" for name, one in choices if isinstance(one, dict))


def _total(run: RunResults, name: str) -> float | None:
    return number_of(run.summary.get("totals", {}), name)


def _share_of_supply(run: RunResults, column: str) -> float | None:
    """Sum of |values| of a column of the energy balance over that of all that was supplied."""
    energy = run.energy
    if energy is None or column not in energy:
        return None
    supply = sum(float(np.abs(energy[name]).sum()) for name in SUPPLIED if name in energy)
    return float(np.abs(energy[column]).sum()) / supply if supply > 0 else None


def _ringing(run: RunResults) -> float | None:
    """Largest sawtooth of a mean pressure, relative to the largest range of one."""
    curves = [opening.mean_pressure for opening in run.openings.values()]
    span = max((float(np.ptp(curve)) for curve in curves), default=0.0)
    return max(sawtooth(curve) for curve in curves) / span if span > 0 else None


def interface_shares(run: RunResults) -> tuple[float | None, float | None]:
    """Largest gap between fluid and wall over the interface's largest displacement, and the mean imbalance of tractions
    over the fluid's, of the steps looked at. None: the run did not watch it, or nothing moved."""
    found = run.summary.get("interface")
    entries = found if isinstance(found, dict) else {}

    def number(name: str) -> float:
        return number_of(entries, name) or 0.0

    gap = max(number("largest_slip_mm"), number("largest_separation_mm"))
    moved, load = number("largest_displacement_mm"), number("largest_traction_kPa")
    lasting = number("lasting_unbalanced_traction_kPa")
    return (gap / moved if moved > 0 else None), (lasting / load if load > 0 else None)


def _total_column(head: str, name: str, form: str, group: str) -> Column[Labelled]:
    return Column(head, name, lambda r: _total(r[1], name), form, group=group)


def _supply_column(head: str, name: str) -> Column[Labelled]:
    return Column(head, f"{name}_of_supply", lambda r: _share_of_supply(r[1], name), ".1e", group="energy over supply")


def _interface_column(head: str, csv: str, place: int) -> Column[Labelled]:
    return Column(head, csv, lambda r: interface_shares(r[1])[place], ".1e", group="interface")


TRUST: Sequence[Column[Labelled]] = (
    Column("run", "run", lambda r: r[0], left=True),
    Column("steps", "steps", lambda r: _total(r[1], "steps"), "g"),
    _total_column("above tolerance", "steps_above_tolerance", "g", "of them"),
    _total_column("failed, halved", "failed_steps", "g", "of them"),
    _total_column("rejected", "rejected_steps", "g", "of them"),
    _total_column("solver", "largest_solver_error", ".1e", "largest error"),
    _supply_column("left over", "remainder"),
    _supply_column("numerical dissipation", "numerical_dissipation"),
    Column("ringing", "sawtooth_of_range", lambda r: _ringing(r[1]), ".1e"),
    _interface_column("apart, of its motion", "gap_of_motion", 0),
    _interface_column("unbalanced, of its load", "imbalance_of_load", 1),
)


def periodic_end(run: RunResults) -> str:
    """How `time.periods` of the case ended the run; empty for a run that does not end by it."""
    found = run.summary.get("periodicity")
    if not isinstance(found, dict):
        return ""
    try:
        last, asked = found["changes"][-1], float(found["asked"])
        change = max(float(last[name]) for name in ("pressure", "flow", "displacement"))
        periods = round(float(last["end_ms"]) / float(found["period_ms"]))
    except (KeyError, IndexError, TypeError, ValueError, ZeroDivisionError):
        return "no two periods were compared"
    reached = f"periodic within {100 * asked:g} %"
    if found.get("limited_by_steps"):
        reached += " but for its steps, which meet the kinks of the tables elsewhere in each period,"
    elif not found.get("reached", change <= asked):
        reached = "not " + reached
    said = f"{reached} after {periods} periods, the last of which changed by {100 * change:.2g} %"
    distance = number_of(last, "distance")
    if distance is not None:
        said += f"; the mean is about {100 * distance:.2g} % from the periodic state"
    return said


def trust_table(runs: Sequence[RunResults], labels: Sequence[str]) -> Table:
    notes = [
        "`left over`: what the energy balance does not explain, the solver's error. `ringing`: the largest part of an opening's mean "
        "pressure that changes its sign from step to step, over the largest range of one. `interface`: how far fluid and wall have "
        "come apart over the run, over the interface's largest displacement, and the mean of what they leave unbalanced in the steps looked at, "
        "over the largest traction."
    ]
    notes += [f"{label}: {said}." for run, label in zip(runs, labels) if (said := periodic_end(run))]
    return Table("trust", "Whether it can be trusted", TRUST, list(zip(labels, runs)), notes=notes)


Entry = tuple[str, dict[str, Any]]  # a run's label, and an entry of a list in its summary


def _words_column(name: str) -> Column[Entry]:
    return Column(name, name, lambda e: word_of(e[1], name), left=True)


def _number_column(head: str, name: str, unit: str = "", group: str = "") -> Column[Entry]:
    return Column(head, name, lambda e: number_of(e[1], name), ".4g", unit, group)


def _place_column(name: str) -> Column[Entry]:
    def shown(entry: Entry) -> str:
        return ", ".join(f"{x:.4g}" for x in _list(entry[1], name) if is_number(x))

    return Column("there, {unit}", name, shown, unit="mm", left=True)


CONSTANTS: Sequence[Column[Entry]] = (
    Column("run", "run", lambda e: e[0], left=True),
    _words_column("layer"),
    _words_column("constant"),
    *(_number_column(name, name, group="over the layer") for name in ("smallest", "mean", "largest")),
    _words_column("unit"),
    Column("from", "sources", lambda e: ", ".join(printable(str(name)) for name in _list(e[1], "sources")), left=True),
)


def constants_table(runs: Sequence[RunResults], labels: Sequence[str]) -> Table:
    """Constants of the wall that vary within a layer; empty where none does."""
    records = _entries(runs, labels, "varying_constants")
    note = "Over the layer's quadrature points; the mean is that over its volume."
    return Table("constants", "Constants of the wall that vary", CONSTANTS, records, notes=[note])


THICKNESS: Sequence[Column[Entry]] = (
    Column("run", "run", lambda e: e[0], left=True),
    _words_column("layer"),
    _number_column("smallest, {unit}", "smallest", "mm"),
    _place_column("smallest_at"),
    _number_column("largest, {unit}", "largest", "mm"),
    _place_column("largest_at"),
)


def thickness_table(runs: Sequence[RunResults], labels: Sequence[str]) -> Table:
    """Thickness of the walls; empty where no run has a wall with an inner and an outer face."""
    records = _entries(runs, labels, "wall_thickness")
    note = "Of the mesh: distances of the outer face's vertices from the inner face, in mm."
    return Table("thickness", "Thickness of the wall", THICKNESS, records, notes=[note])


def _entries(runs: Sequence[RunResults], labels: Sequence[str], name: str) -> list[Entry]:
    """Those of a list in the runs' summaries."""
    pairs = [(label, entry) for run, label in zip(runs, labels) for entry in _list(run.summary, name)]
    return [(label, entry) for label, entry in pairs if isinstance(entry, dict)]


def _list(entries: Mapping[str, Any], name: str) -> list[Any]:
    found = entries.get(name)
    return found if isinstance(found, list) else []


def word_of(entry: Mapping[str, Any], name: str) -> str:
    """An entry as text; empty where it is missing."""
    return printable(str(entry.get(name, "")))


class OfOpening(NamedTuple):
    run: str
    opening: Opening
    share: float | None  # of what flows out, over the last cycle or the run
    window: np.ndarray  # levels that count


def _pressure(kind: str, unit: str) -> Column[OfOpening]:
    def value(record: OfOpening) -> float:
        levels = record.opening.mean_pressure[record.window] / PER_KPA["Pa"]
        return PER_KPA[unit] * float({"minimum": levels.min, "mean": levels.mean, "maximum": levels.max}[kind]())

    form, group = ".3f" if unit == "kPa" else ".2f", "mean pressure over the opening, {unit}"
    return Column(kind, f"{kind}_pressure", value, form, unit, group)


def _flow(head: str, of: Callable[[np.ndarray], Any]) -> Column[OfOpening]:
    group = "flow outwards, {unit}"
    return Column(head, f"{head}_flow", lambda r: float(of(r.opening.flow[r.window])), ".4g", "mm^3/ms", group)


OPENINGS: Sequence[Column[OfOpening]] = (
    Column("run", "run", lambda r: r.run, left=True),
    Column("opening", "opening", lambda r: r.opening.name, left=True),
    Column("share of outflow", "share_of_outflow", lambda r: r.share, ".1%"),
    _flow("mean", lambda flow: flow.mean()),
    _flow("largest", lambda flow: np.abs(flow).max()),
    *(_pressure(kind, unit) for unit in ("kPa", "mmHg") for kind in ("minimum", "mean", "maximum")),
)


def openings_table(runs: Sequence[RunResults], labels: Sequence[str]) -> Table:
    """Flows and pressures over the last cycle of runs that repeat, else over all times."""
    records = []
    cycles: dict[str, float] = {}
    for run, label in zip(runs, labels):
        period = _period(run)
        if period:
            cycles[label] = period
        windows = {
            name: opening.time > opening.time[-1] - period * (1 - 1e-9) if period else opening.time >= 0
            for name, opening in run.openings.items()
        }
        outflow = {name: max(float(run.openings[name].flow[at].mean()), 0.0) for name, at in windows.items()}
        total = sum(outflow.values())
        for name, opening in run.openings.items():
            share = outflow[name] / total if total > 0 and outflow[name] > 0 else None
            records.append(OfOpening(label, opening, share, windows[name]))
    of = "; ".join(f"of the last cycle of {period:g} ms of {label}" for label, period in cycles.items())
    note = f"Values are {of}, else of all steps." if of else "Values are of all steps: no flow repeats."
    notes = [note, "Means weigh all steps alike."]
    return Table("openings", "Flow split and pressures", OPENINGS, records, notes=notes)


def _period(run: RunResults) -> float | None:
    openings = list(run.openings.values())
    return period_of(openings[0].time, {o.name: o.flow for o in openings}) if openings else None


class Change(NamedTuple):
    run: str
    opening: str
    period: float
    flow: float
    pressure: float


CHANGES: Sequence[Column[Change]] = (
    Column("run", "run", lambda r: r.run, left=True),
    Column("opening", "opening", lambda r: r.opening, left=True),
    Column("cycle, {unit}", "cycle", lambda r: r.period, "g", "ms"),
    Column("flow", "flow_change", lambda r: r.flow, ".1e", group="change"),
    Column("mean pressure", "mean_pressure_change", lambda r: r.pressure, ".1e", group="change"),
)


def cycles_table(runs: Sequence[RunResults], labels: Sequence[str]) -> Table:
    """Changes from cycle to cycle; empty where no flow repeats."""
    records = []
    for run, label in zip(runs, labels):
        period = _period(run)
        for name, o in run.openings.items() if period else ():
            changes = (cycle_change(o.time, values, float(period or 0)) for values in (o.flow, o.mean_pressure))
            records.append(Change(label, name, float(period or 0), *changes))
    note = "The largest difference of the last cycle from the one before, over the range of the last."
    return Table("cycles", "From cycle to cycle", CHANGES, records, notes=[note])


def _each_step(run: RunResults, name: str) -> float | None:
    total, steps = _total(run, name), _total(run, "steps")
    return total / steps if total is not None and steps else None


def _passes(run: RunResults) -> float | None:
    return _each_step(run, "outer_iterations") if run.program == "fsi-partitioned" else None


COST: Sequence[Column[Labelled]] = (
    Column("run", "run", lambda r: r[0], left=True),
    Column("program", "program", lambda r: r[1].program, left=True),
    Column("kind of coupling", "coupling_kind", lambda r: r[1].summary.get("coupling_kind"), left=True),
    Column("seconds", "wall", lambda r: _total(r[1], "wall_s"), ".1f", "s"),
    Column("coupling passes", "passes_per_step", lambda r: _passes(r[1]), ".1f", group="per step"),
    Column(
        "Newton iterations", "newton_per_step", lambda r: _each_step(r[1], "newton_iterations"), ".1f", group="per step"
    ),
    Column("memory, {unit}", "peak_memory", lambda r: r[1].summary.get("peak_memory_MiB"), ".0f", "MiB"),
)


def cost_table(runs: Sequence[RunResults], labels: Sequence[str]) -> Table:
    # Results of earlier versions do not say how they coupled fluid and wall.
    told = [run.summary for run in runs if {"coupling_kind", "coupling_pass"} <= run.summary.keys()]
    does = {str(summary["coupling_kind"]): str(summary["coupling_pass"]) for summary in told}
    notes = [f"`{kind}`: {text}." for kind, text in does.items()] + ["`fsi-compare cost` says more."]
    return Table("seconds", "What it cost", COST, list(zip(labels, runs)), notes=notes)
