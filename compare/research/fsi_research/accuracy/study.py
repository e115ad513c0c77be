"""Error against seconds for both drivers: what mesh, time step, tolerance, linear solver and coupling scheme buy.

Two errors are kept apart. The total error is against a reference on far finer meshes and steps. The algebraic error is
against the tight solution of the same discrete equations: what stopping early, a loose tolerance, costs."""

from typing import Dict, List, Sequence

from ..catalogue.names import MATERIALS
from fsi_compare.reporting.report import Report
from fsi_compare.study.runs_table import runs_table
from fsi_compare.runs.waves import QUANTITIES, Quantity
from fsi_compare.study.context import Context
from fsi_compare.study.study_file import Study
from . import pictures
from .advice import algebraic_advice, enough, estimate, percent, small_steps, total_advice
from .convergence import SPACE, TIME, Series, series
from .measured import GAIN, JUDGED, Measured, measure
from .plan import Plan, read_plan
from .tables import algebraic_table, frontier_table, orders_table, settings_table
from .timing import timing_words


def check(study: Study) -> None:
    read_plan(study)


def evaluate(context: Context) -> int:
    plan = read_plan(context.study)
    measured = measure(context.runs, plan)
    found = series(measured, plan)
    cases = [case for case in context.study.cases if any(m.run.request.case == case for m in measured)]
    groups = _same_equations(measured, plan)
    report = context.report
    _summary(context, plan, measured, found, cases, groups)
    _method(report, plan, cases, timing_words(m.run for m in measured))
    for case in cases:
        _total(report, case, [m for m in measured if m.run.request.case == case], len(cases) > 1)
    _orders(report, found, cases)
    _algebraic(report, groups, plan)
    report.section("All runs")
    report.table(settings_table(measured))
    failed = [run for run in context.runs if not run.done]
    if failed:
        report.subsection("Runs without a result")
        report.text("They are part of the finding: a setting that does not converge has no place on the frontier.")
        report.table(runs_table(failed, "failed", "Runs that did not end well"))
    return 0 if measured else 2


def _summary(
    context: Context,
    plan: Plan,
    measured: Sequence[Measured],
    found: Sequence[Series],
    cases: Sequence[str],
    groups: Dict[str, dict],
) -> None:
    report = context.report
    report.section("What to use")
    if not measured:
        report.text("No run has ended well; see the table at the end.")
        return
    low, high = plan.window
    report.text(
        f"Error: relative L2 over the length of the tube and t = {low:g} to {high:g} ms; the larger of "
        f"{' and '.join(q.name for q in JUDGED)} counts. The pressure of a moment, which carries the wall's oscillations "
        f"of 0.4 to 0.9 ms, is stated apart. Seconds: of the time steps, {_threads(context)}."
    )
    for case in cases:
        own = [m for m in measured if m.run.request.case == case]
        report.subsection(f"Total error, {MATERIALS.get(case, case)}")
        report.list(total_advice(own, plan, case))
        report.list([line for line in (_balance(found, case, q) for q in QUANTITIES) if line])
    for name, group in groups.items():
        report.subsection(f"Solver's error alone, {name}")
        report.list(algebraic_advice(group["runs"], plan.targets))
        report.text(enough(group["runs"], group["tight"]))
    warning = small_steps(found)
    if warning:
        report.subsection("Do not refine the time step alone")
        report.text(warning)


def _threads(context: Context) -> str:
    threads = context.study.threads
    return "one thread" if threads == 1 else f"{threads} threads"


def _balance(found: Sequence[Series], case: str, quantity: Quantity) -> str:
    """Where the error comes from, by self-convergence alone; empty: the quantity does not converge yet."""
    chosen = estimate(found, case, quantity)
    if not chosen:
        return ""
    parts = []
    for one in chosen:
        left, total = one.last(quantity.column), one.finest.total[quantity.column]
        assert left.order is not None and left.remaining is not None, "chosen for having an order"
        where = (
            f"the elements of the {one.finest.mesh_label} mesh"
            if one.what == SPACE
            else f"the step of {one.finest.step:g} ms"
        )
        part = f"{percent(left.remaining)} from {where} (order {left.order:.2f}; {one.fixed})"
        # A part that exceeds the whole: the sizes are not small enough for C h^p.
        parts.append(
            part
            if left.remaining <= total
            else f"{part}, more than the whole of {percent(total)}: not yet in the range where an order holds"
        )
    return (
        f"Where the error in {quantity.name} comes from, by self-convergence, without the reference: "
        f"{'; '.join(parts)}."
    )


def _method(report: Report, plan: Plan, cases: Sequence[str], timing: str) -> None:
    report.section("How it is measured")
    for case in cases:
        reference = plan.references[case]
        own = ", ".join(f"{percent(reference.own_error[q.column])} in {q.name}" for q in QUANTITIES)
        report.text(
            f"Reference, {MATERIALS.get(case, case)}: {reference.description}. Its own error is estimated as "
            f"{own}; smaller differences between runs mean nothing. It is made by the same program, partly on the grids of "
            "the axisymmetric runs: of mesh and dimension it is independent for tetrahedra alone."
        )
    report.text(
        "**Total error**: against the reference; from mesh, time step and solver together. **Solver's error**: "
        "against the solution of the same discrete equations with tightly converged steps; from tolerances and "
        "schemes alone. The two must not be confused: a tolerance can be changed for nothing, a mesh cannot.",
        "**Frontier**: no other setting is both faster and more accurate; of total errors, a gain of less than "
        f"{percent(GAIN)} of the error does not count. {timing} Neighbours of the frontier are as good as those on it.",
        "**Observed order**: from the differences of three successive solutions, whatever the ratio of their "
        "sizes; it needs no reference. The last column gives the slope against the reference instead.",
    )


def _total(report: Report, case: str, measured: Sequence[Measured], several: bool) -> None:
    name = f", {MATERIALS.get(case, case)}" if several else ""
    stem = f"_{case}" if several else ""
    report.section(f"Total error against seconds{name}")
    title = f"Error against seconds, {MATERIALS.get(case, case)}"
    report.figure(
        f"work_precision{stem}",
        lambda: pictures.work_precision(measured, title),
        f"Each mark is a run{_hollow(measured)}. **Black**: on the frontier, named, and numbered as in the tables; **grey**: "
        "dominated, in the table of all runs.",
    )
    for quantity in QUANTITIES:
        report.table(frontier_table(measured, quantity, name, stem))


def _hollow(measured: Sequence[Measured]) -> str:
    kinds = {m.kind for m in measured}
    words = ["grey inside of the kind `block`"] if "block" in kinds else []
    words += [f"hollow of the kind `{kind}`" for kind in sorted(kinds - {"monolithic", "block"})]
    return "".join(f", {word}" for word in words)


def _orders(report: Report, found: Sequence[Series], cases: Sequence[str]) -> None:
    report.section("Observed orders")
    if not found:
        report.text("No three runs differ in mesh or time step alone.")
        return
    report.text(
        "Left: the estimated error of the finest of each three, C h^p; it takes the error's shape for "
        "unchanged. An order far from that of the method says that the sizes are not yet small beside the pulse, and "
        "that extrapolations are rough. In element size linear elements have 2; quadratic ones 2 in pressure and 3 in "
        "displacement. In time `euler` has 1, the other schemes 2."
    )
    report.table(orders_table(found))
    for what, stem in ((SPACE, "orders_space"), (TIME, "orders_time")):
        own = [one for one in found if one.what == what]
        if own:
            title = f"Difference from the next finer solution against {what}"
            report.figure(
                stem,
                lambda: pictures.orders(own, what, title),
                f"Convergence in {what}: the slopes are the observed orders. The longest three series are named; the others are in the "
                "table.",
            )


def _same_equations(measured: Sequence[Measured], plan: Plan) -> Dict[str, dict]:
    """Runs of the same discrete equations by their name, with the tight one; three settings or more."""
    groups: Dict[tuple, List[Measured]] = {}
    tight: Dict[tuple, Measured] = {}
    for m in measured:
        if m.run.request.method.name == plan.tight:
            tight[m.discretisation] = m
        elif m.algebraic:
            groups.setdefault(m.discretisation, []).append(m)
    several = len({key[0] for key in groups}) > 1
    found: Dict[str, dict] = {}
    for key, group in groups.items():
        if len(group) >= 3:
            name = (f"{key[0]}, " if several else "") + group[0].equations
            found[name] = {"runs": group, "tight": tight[key]}
    return found


def _algebraic(report: Report, groups: Dict[str, dict], plan: Plan) -> None:
    report.section("The solver's error alone")
    if not groups:
        report.text("No tight solution to compare with.")
        return
    runs_by_name = {name: group["runs"] for name, group in groups.items()}
    everyone = [m for runs in runs_by_name.values() for m in runs]
    for quantity in QUANTITIES:
        title = f"Solver's error in {quantity.name} against seconds"
        report.figure(
            f"algebraic_{quantity.file.split('.')[0]}",
            lambda: pictures.algebraic_work_precision(runs_by_name, quantity, title),
            f"A thin line along the tolerances of each method{_hollow(everyone)}. Black, numbered and named: the frontier.",
        )
    for i, (name, group) in enumerate(groups.items(), 1):
        report.table(algebraic_table(i, name, group["runs"]))
