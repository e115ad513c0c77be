"""The paper's Tables 3, 4 and 5 with its numbers beside ours, and what it lacks: seconds, cycles, work, memory."""

from dataclasses import dataclass
from typing import Callable, Iterable, List, Optional, Sequence, Tuple

from ..base import paper
from ..base.names import BLOCK_PRECONDITIONERS, EXACT, MATERIALS, MESHES, METHODS, MULTILEVEL
from ..reporting.layout import Table, fixed
from .results import NewtonSystem, Solve, System
from .study import Outcome

EXACT_RATIO = 1.3  # most that AMG sub-solves may cost in iterations over exact ones
GROWTH = 3  # most iterations that a multilevel method may need on the fine mesh over the coarse one
SAME_SOLUTION = 1e-7  # relative difference to the direct solver's


@dataclass(frozen=True)
class Entry:
    """What there is to say about one method on one system: `status` is converged, not converged, failed (the whole
    run), or not run; the solve is there for the first only, so that no number of a failure gets into a table."""

    status: str
    solve: Optional[Solve] = None
    message: str = ""

    @property
    def iterations(self) -> Optional[int]:
        return self.solve.iterations if self.solve else None

    @property
    def short(self) -> str:
        words = {"converged": str(self.iterations), "not converged": "n.c.", "failed": "failed", "not run": "-"}
        return words[self.status]


class Grid:
    """All runs of a study by material and mesh."""

    def __init__(self, outcomes: Sequence[Outcome]):
        self._outcomes = {(o.request.material, o.request.mesh): o for o in outcomes}
        self.materials = _ordered((o.request.material for o in outcomes), MATERIALS)
        self.meshes = _ordered((o.request.mesh for o in outcomes), MESHES)
        self.systems: List[System] = sorted({s for o in outcomes for s in o.request.systems})
        self.sub_problems = any(o.request.sub_problems for o in outcomes)
        self.tolerances = sorted({o.request.tolerance for o in outcomes})
        self.methods = _ordered((name for o in outcomes for name in o.request.solvers), METHODS)

    def outcome(self, material: str, mesh: str) -> Optional[Outcome]:
        return self._outcomes.get((material, mesh))

    def system(self, material: str, mesh: str, key: System) -> Optional[NewtonSystem]:
        outcome = self.outcome(material, mesh)
        return outcome.results.systems[key] if outcome and outcome.results else None

    def entry(self, material: str, mesh: str, key: System, method: str) -> Entry:
        outcome = self.outcome(material, mesh)
        if outcome is None or method not in outcome.request.solvers:
            return Entry("not run")
        if outcome.results is None:
            return Entry("failed", message=outcome.failure)
        solve = outcome.results.systems[key].solves[method]
        return Entry("converged", solve) if solve.converged else Entry("not converged", message=solve.message)

    def time_ms(self, key: System) -> Optional[float]:
        return next(
            (
                system.time_ms
                for material in self.materials
                for mesh in self.meshes
                for system in [self.system(material, mesh, key)]
                if system
            ),
            None,
        )

    def heading(self, key: System) -> str:
        time = self.time_ms(key)
        return f"Newton system {key[1]} of step {key[0]}" + ("" if time is None else f" (t = {time:g} ms)")


def _ordered(names: Iterable[str], known: Iterable[str]) -> List[str]:
    present = set(names)
    return [name for name in known if name in present]


def solver_tables(grid: Grid) -> List[Table]:
    """Every table that the runs have something for."""
    tables = [newton_table(grid)] if any(step == 1 for step, _ in grid.systems) else []
    for key in grid.systems:
        if any(method in grid.methods for method in (*BLOCK_PRECONDITIONERS, *EXACT.values())):
            tables.append(block_table(grid, key))
        if any(method in grid.methods for method in MULTILEVEL):
            tables.append(multilevel_table(grid, key))
        tables.append(cost_table(grid, key))
    if grid.sub_problems:
        tables.append(sub_problem_table(grid))
    return tables


def newton_table(grid: Grid) -> Table:
    """Table 3: norms of Newton's increments in the first step."""
    table = Table(
        "table3_newton",
        "Table 3: norms of Newton's increments in the first time step, ours and the paper's",
        [("", "material"), ("", "#it"), *((mesh, who) for mesh in grid.meshes for who in ("ours", "paper"))],
        ("material", "mesh", "nodes", "newton_iteration", "increment", "residual", "paper_increment"),
        left=1,
        notes=[
            "Ours: L2 norm over fluid and wall, of all fields in mm, mm/ms and kPa added up as they are, as in the "
            "paper's algorithm 1. The paper's column is headed relative error, without scaling or units: its first "
            "increment is about 30 times ours on every mesh, so much like an L2 norm in others. Compare the decay, "
            "not the sizes."
        ],
    )
    for material in grid.materials:
        columns = []
        for mesh in grid.meshes:
            outcome = grid.outcome(material, mesh)
            steps = outcome.results.newton if outcome and outcome.results else ()
            step = next((s for s in steps if s.step == 1), None)
            columns.append((mesh, outcome, step, paper.newton_increments(material, mesh)))
            if outcome and outcome.results is None:
                table.notes.append(f"failed: {MATERIALS[material]} {MESHES[mesh]}: {outcome.failure}")
        for i in range(max(max(len(step.increments) if step else 0, len(theirs)) for _, _, step, theirs in columns)):
            row = [MATERIALS[material] if i == 0 else "", str(i + 1)]
            for mesh, outcome, step, theirs in columns:
                ours = step.increments[i] if step and i < len(step.increments) else None
                residual = step.residuals[i] if step and i < len(step.residuals) else None
                printed = theirs[i] if i < len(theirs) else None
                failed = outcome is not None and outcome.results is None
                row += ["failed" if failed and i == 0 else fixed(ours, ".1e"), fixed(printed, ".1e")]
                if ours is not None or printed is not None:
                    nodes = outcome.results.mesh.get("nodes") if outcome and outcome.results else None
                    table.csv_rows.append((material, mesh, nodes, i + 1, ours, residual, printed))
            table.rows.append(row)
    return table


COUNT_COLUMNS = (
    "step",
    "newton_iteration",
    "time_ms",
    "material",
    "mesh",
    "unknowns",
    "method",
    "status",
    "iterations",
    "paper_iterations",
    "limit_iterations",
    "above_limit",
)


def block_table(grid: Grid, key: System) -> Table:
    """Table 4: GMRES with block preconditioners, sub-problems by one AMG cycle and, where asked for, exactly."""
    with_exact = any(EXACT[method] in grid.methods for method in BLOCK_PRECONDITIONERS)
    shown = ("AMG", "exact", "ratio", "paper") if with_exact else ("ours", "paper")
    table = Table(
        f"table4_block_preconditioners_{suffix(key)}",
        f"Table 4: iterations of GMRES with block preconditioners, {grid.heading(key)}",
        [("", "material"), ("", "method"), *((mesh, what) for mesh in grid.meshes for what in shown)],
        (*COUNT_COLUMNS, "exact_status", "exact_iterations", "ratio_to_exact", "message", "exact_message"),
        left=2,
    )
    marks = _Marks(grid, key)
    wide = 0
    for material in grid.materials:
        for i, (method, label) in enumerate(BLOCK_PRECONDITIONERS.items()):
            row = [MATERIALS[material] if i == 0 else "", label]
            for mesh in grid.meshes:
                entry = grid.entry(material, mesh, key, method)
                exact = grid.entry(material, mesh, key, EXACT[method])
                ratio = _ratio(entry.iterations, exact.iterations)
                above_ratio = ratio is not None and ratio > EXACT_RATIO
                wide += above_ratio
                row.append(marks.count(material, mesh, method, label, entry))
                if with_exact:
                    row += [exact.short, fixed(ratio, ".2f") + ("!" if above_ratio else "")]
                row.append(fixed(paper.iterations(method, material, mesh), "d"))
                marks.remember(material, mesh, f"{label} exact", exact)
                table.csv_rows.append(
                    (
                        *marks.csv(material, mesh, method, entry),
                        exact.status,
                        exact.iterations,
                        ratio,
                        entry.message,
                        exact.message,
                    )
                )
            table.rows.append(row)
    table.notes = marks.notes()
    if with_exact:
        table.notes.append(
            f"!: more than {EXACT_RATIO:g} times the count with exact sub-solves: {wide if wide else 'none'}"
        )
    table.notes.append(_order_note(grid, key))
    return table


def _ratio(one: Optional[int], other: Optional[int]) -> Optional[float]:
    return one / other if one is not None and other else None


def multilevel_table(grid: Grid, key: System) -> Table:
    """Table 5: coupled AMG and AMLI, alone and within Krylov methods."""
    table = Table(
        f"table5_multilevel_{suffix(key)}",
        f"Table 5: iterations of coupled multilevel methods, ours (paper's), {grid.heading(key)}",
        [("", "method"), *((MATERIALS[material], MESHES[mesh]) for material in grid.materials for mesh in grid.meshes)],
        (*COUNT_COLUMNS, "message"),
    )
    marks = _Marks(grid, key)
    grown = []
    for method, label in MULTILEVEL.items():
        row = [label]
        for material in grid.materials:
            for mesh in grid.meshes:
                entry = grid.entry(material, mesh, key, method)
                row.append(
                    f"{marks.count(material, mesh, method, label, entry)} "
                    f"({fixed(paper.iterations(method, material, mesh), 'd')})"
                )
                table.csv_rows.append((*marks.csv(material, mesh, method, entry), entry.message))
            coarse, fine = (grid.entry(material, mesh, key, method).iterations for mesh in ("coarse", "fine"))
            if coarse is not None and fine is not None and fine > coarse + GROWTH:
                grown.append(f"{label} {MATERIALS[material]} ({fine - coarse})")
        table.rows.append(row)
    table.notes = marks.notes()
    if "coarse" in grid.meshes and "fine" in grid.meshes:
        table.notes.append(
            f"more than {GROWTH} iterations above the coarse mesh on the fine one: "
            f"{', '.join(grown) if grown else 'none'}"
        )
    return table


class _Marks:
    """Counts with their mark, and the notes that a table of counts ends with."""

    def __init__(self, grid: Grid, key: System):
        self._grid, self._key = grid, key
        self._cells = self._above = 0
        self._failures: List[Tuple[str, str, str]] = []  # status, where, message

    def _limit(self, material: str, mesh: str, method: str) -> Optional[int]:
        return paper.limit(method, material, mesh, at_rest=self._key == (1, 1))

    def count(self, material: str, mesh: str, method: str, label: str, entry: Entry) -> str:
        limit = self._limit(material, mesh, method)
        self.remember(material, mesh, label, entry)
        if entry.iterations is None or limit is None:
            return entry.short
        self._cells += 1
        self._above += entry.iterations > limit
        return entry.short + ("*" if entry.iterations > limit else "")

    def remember(self, material: str, mesh: str, label: str, entry: Entry) -> None:
        if entry.status == "not converged":
            self._failures.append(("n.c.", f"{label}, {MATERIALS[material]} {MESHES[mesh]}", entry.message))
        elif entry.status == "failed":
            self._failures.append(("failed", f"{MATERIALS[material]} {MESHES[mesh]}", entry.message))

    def csv(self, material: str, mesh: str, method: str, entry: Entry) -> tuple:
        limit = self._limit(material, mesh, method)
        system = self._grid.system(material, mesh, self._key)
        above = None if entry.iterations is None or limit is None else "yes" if entry.iterations > limit else "no"
        time_ms, unknowns = (system.time_ms, system.unknowns["total"]) if system else (None, None)
        return (
            *self._key,
            time_ms,
            material,
            mesh,
            unknowns,
            method,
            entry.status,
            entry.iterations,
            paper.iterations(method, material, mesh),
            limit,
            above,
        )

    def notes(self) -> List[str]:
        notes = [f"*: above the paper's count: {self._above if self._above else 'none'} of {self._cells} cells"]
        if self._key == (1, 1) and "artery" in self._grid.materials:
            notes.append("At rest the fibres do nothing: the artery is held to the paper's neo-Hookean column.")
        elif self._key != (1, 1):
            notes.append("The paper's numbers are those of its first Newton system.")
        if any(tolerance != paper.tolerance() for tolerance in self._grid.tolerances):
            notes.append(
                f"Solved to {', '.join(format(t, 'g') for t in self._grid.tolerances)}, in the paper to "
                f"{paper.tolerance():g}."
            )
        if any(status == "n.c." for status, _, _ in self._failures):
            notes.append("n.c.: not converged")
        return notes + [f"{status}: {where}: {message}" for status, where, message in dict.fromkeys(self._failures)]


def _order_note(grid: Grid, key: System) -> str:
    """Whether no preconditioner is better than one that the paper finds better."""
    swapped, compared = [], 0
    names = list(BLOCK_PRECONDITIONERS)
    for material in grid.materials:
        for mesh in grid.meshes:
            for worse in names:
                for better in names:
                    limits = [paper.limit(name, material, mesh, key == (1, 1)) for name in (worse, better)]
                    counts = [grid.entry(material, mesh, key, name).iterations for name in (worse, better)]
                    theirs = [count for count in limits if count is not None]
                    ours = [count for count in counts if count is not None]
                    if len(theirs) < 2 or len(ours) < 2 or theirs[0] <= theirs[1]:
                        continue
                    compared += 1
                    if ours[0] < ours[1]:
                        swapped.append(
                            f"{BLOCK_PRECONDITIONERS[worse]} {ours[0]} < {BLOCK_PRECONDITIONERS[better]} "
                            f"{ours[1]} ({MATERIALS[material]} {MESHES[mesh]})"
                        )
    if not compared:
        return "order of the preconditioners as in the paper: n/a"
    return f"order of the preconditioners as in the paper: {'no: ' + ', '.join(swapped) if swapped else 'yes'}"


# CSV name, group and name in the printed table, format, value
COSTS: Sequence[Tuple[str, str, str, str, Callable[[Solve], object]]] = (
    ("iterations", "", "#it", "d", lambda s: s.iterations),
    ("set_up_seconds", "seconds", "set-up", ".3g", lambda s: s.set_up_seconds),
    ("solve_seconds", "seconds", "solve", ".3g", lambda s: s.solve_seconds),
    ("work_units", "", "work units", ".1f", lambda s: s.work_units),
    ("mesh_cycles", "cycles", "mesh", "d", lambda s: s.cycles.get("mesh")),
    ("flow_cycles", "cycles", "flow", "d", lambda s: s.cycles.get("flow")),
    ("wall_cycles", "cycles", "wall", "d", lambda s: s.cycles.get("wall")),
    ("levels", "", "levels", "d", lambda s: s.levels),
    ("operator_complexity", "operator", "complexity", ".2f", lambda s: s.operator_complexity),
    ("memory_MiB", "memory", "MiB", ".1f", lambda s: s.memory_MiB),
    ("relative_residual", "true relative", "residual", ".1e", lambda s: s.relative_residual),
    ("difference_to_direct", "relative difference", "to direct", ".1e", lambda s: s.difference),
)


def cost_table(grid: Grid, key: System) -> Table:
    """What each method costs, all materials and meshes below each other. The difference to the direct solver's solution
    is shown where that was asked for."""
    shown_costs = COSTS if "direct" in grid.methods else COSTS[:-1]
    table = Table(
        f"cost_{suffix(key)}",
        f"Cost of the methods, {grid.heading(key)}",
        [
            ("", "material"),
            ("", "mesh"),
            ("", "unknowns"),
            ("", "method"),
            *((group, name) for _, group, name, _, _ in shown_costs),
        ],
        (
            "step",
            "newton_iteration",
            "time_ms",
            "material",
            "mesh",
            "unknowns",
            "mesh_unknowns",
            "flow_unknowns",
            "wall_unknowns",
            "threads",
            "product_seconds",
            "method",
            "status",
            *(name for name, *_ in COSTS),
            "message",
        ),
        left=4,
    )
    apart, messages = 0, []
    for material in grid.materials:
        for mesh in grid.meshes:
            outcome, system = grid.outcome(material, mesh), grid.system(material, mesh, key)
            unknowns = system.unknowns if system else {}
            first = True
            for method in grid.methods:
                entry = grid.entry(material, mesh, key, method)
                if entry.status == "not run":
                    continue
                values = [value(entry.solve) if entry.solve else None for *_, value in COSTS]
                shown = [fixed(value, form) for value, (_, _, _, form, _) in zip(values, shown_costs)]
                if entry.solve is None:
                    shown[0] = entry.short
                    cell = f"{MATERIALS[material]} {MESHES[mesh]}"
                    messages.append(
                        f"{entry.short}: {cell}: {entry.message}"
                        if entry.status == "failed"
                        else f"{entry.short}: {method}, {cell}: {entry.message}"
                    )
                elif (
                    "direct" in grid.methods
                    and entry.solve.difference is not None
                    and entry.solve.difference > SAME_SOLUTION
                ):
                    apart += 1
                    shown[-1] += "!"
                where = (MATERIALS[material], mesh, fixed(unknowns.get("total"), ",d")) if first else ("", "", "")
                table.rows.append([*where, method, *shown])
                table.csv_rows.append(
                    (
                        *key,
                        system.time_ms if system else None,
                        material,
                        mesh,
                        *(unknowns.get(name) for name in ("total", "mesh", "flow", "wall")),
                        outcome.results.threads if outcome and outcome.results else None,
                        system.product_seconds if system else None,
                        method,
                        entry.status,
                        *values,
                        entry.message,
                    )
                )
                first = False
    table.notes = [
        "work units: solve seconds / seconds of one product with the coupled matrix; cycles: of the sub-problems' AMG"
    ]
    if "direct" in grid.methods:
        table.notes.append(
            f"!: relative difference to the direct solver's solution above {SAME_SOLUTION:g}: {apart or 'none'}"
        )
    table.notes += list(dict.fromkeys(messages))
    return table


def sub_problem_table(grid: Grid) -> Table:
    """The sub-problems' AMG alone."""
    table = Table(
        "sub_problems",
        "AMG of the sub-problems alone",
        [
            ("", name)
            for name in (
                "material",
                "mesh",
                "problem",
                "coarsening",
                "smoother",
                "cycle",
                "levels",
                "factor",
                "#it",
                "complexity",
            )
        ],
        (
            "material",
            "mesh",
            "nodes",
            "problem",
            "coarsening",
            "smoother",
            "cycle",
            "levels",
            "convergence_factor",
            "iterations",
            "operator_complexity",
        ),
        left=6,
        notes=["factor: mean contraction of the residual per cycle; 1 and more: n.c."],
    )
    for material in grid.materials:
        for mesh in grid.meshes:
            outcome = grid.outcome(material, mesh)
            if outcome is None or outcome.results is None:
                continue
            for p in outcome.results.sub_problems:
                good = p.factor is not None and p.factor < 1
                table.rows.append(
                    [
                        MATERIALS[material],
                        mesh,
                        p.problem,
                        p.coarsening,
                        p.smoother,
                        p.cycle,
                        str(p.levels),
                        f"{p.factor:.3f}" if good else "n.c.",
                        fixed(p.iterations if good else None, "d"),
                        fixed(p.operator_complexity, ".2f"),
                    ]
                )
                table.csv_rows.append(
                    (
                        material,
                        mesh,
                        outcome.results.mesh.get("nodes"),
                        p.problem,
                        p.coarsening,
                        p.smoother,
                        p.cycle,
                        p.levels,
                        p.factor if good else None,
                        p.iterations if good else None,
                        p.operator_complexity,
                    )
                )
    return table


def suffix(key: System) -> str:
    return f"step{key[0]}_newton{key[1]}"
