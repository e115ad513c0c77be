"""The paper's Tables 3, 4 and 5 with its numbers beside ours, and that of the sub-problems' solvers alone."""

from dataclasses import dataclass
from typing import List, NamedTuple, Optional, Sequence, Tuple

from ..catalogue import paper
from ..catalogue.names import BLOCK_PRECONDITIONERS, EXACT, MATERIALS, MULTILEVEL
from fsi_compare.study.mesh_levels import MESHES
from fsi_compare.reporting.column import Column, Facts, fixed
from fsi_compare.reporting.layout import Table
from .cost_tables import cost_table
from .counts import Count, Marks, count_columns, order_note
from .grid import Entry, Grid, suffix
from .results import LinearSolvers, SubProblem, System

EXACT_RATIO = 1.3  # most that AMG sub-solves may cost in iterations over exact ones
GROWTH = 3  # most iterations that a multilevel method may need on the fine mesh over the coarse one


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


class Increment(NamedTuple):
    """Norm of an increment in a Newton iteration, ours and the paper's."""

    material: str
    mesh: str
    nodes: Optional[int]
    iteration: int
    ours: Optional[float]
    residual: Optional[float]
    printed: Optional[float]  # in the paper
    failed: bool  # the run


INCREMENTS: Sequence[Column[Increment]] = (
    Column(csv="material", value=lambda i: i.material),
    Column(csv="mesh", value=lambda i: i.mesh),
    Column(csv="nodes", value=lambda i: i.nodes),
    Column(csv="newton_iteration", value=lambda i: i.iteration),
    Column(csv="increment", value=lambda i: i.ours),
    Column(csv="residual", value=lambda i: i.residual),
    Column(csv="paper_increment", value=lambda i: i.printed),
)


def newton_table(grid: Grid) -> Table:
    """Table 3: norms of Newton's increments in the first step."""
    rows = [row for material in grid.materials for row in _newton_rows(grid, material)]
    failures = [
        f"failed: {MATERIALS[material]} {MESHES[mesh]}: {outcome.failure}"
        for material in grid.materials
        for mesh in grid.meshes
        for outcome in [grid.outcome(material, mesh)]
        if outcome and outcome.results is None
    ]
    return Table(
        "table3_newton",
        "Table 3: norms of Newton's increments in the first time step, ours and the paper's",
        [
            Column(
                "material", value=lambda row: MATERIALS[row[0].material] if row[0].iteration == 1 else "", left=True
            ),
            Column("#it", value=lambda row: row[0].iteration),
            *(column for place, mesh in enumerate(grid.meshes) for column in _of_mesh(place, mesh)),
        ],
        rows,
        Facts(INCREMENTS, [i for row in rows for i in row if i.ours is not None or i.printed is not None]),
        [
            "Ours: L2 norm over fluid and wall, of all fields in mm, mm/ms and kPa added up as they are, as in the "
            "paper's algorithm 1. The paper's column is headed relative error, without scaling or units: its first "
            "increment is about 30 times ours on every mesh, so much like an L2 norm in others. Compare the decay, "
            "not the sizes.",
            *failures,
        ],
    )


def _of_mesh(place: int, mesh: str) -> List[Column[Sequence[Increment]]]:
    return [
        Column(
            "ours",
            value=lambda row: "failed" if row[place].failed and row[place].iteration == 1 else row[place].ours,
            format=lambda ours: ours if isinstance(ours, str) else f"{ours:.1e}",
            group=mesh,
        ),
        Column("paper", value=lambda row: row[place].printed, format=".1e", group=mesh),
    ]


def _newton_rows(grid: Grid, material: str) -> List[List[Increment]]:
    """An increment of each mesh, iteration by iteration."""
    meshes = []
    for mesh in grid.meshes:
        outcome = grid.outcome(material, mesh)
        results = outcome.results if outcome else None
        step = next((s for s in (results.newton if results else ()) if s.step == 1), None)
        ours, residuals = (step.increments, step.residuals) if step else ([], [])
        nodes = results.mesh.get("nodes") if results else None
        failed = outcome is not None and results is None
        meshes.append((mesh, nodes, ours, residuals, paper.newton_increments(material, mesh), failed))
    count = max(max(len(ours), len(theirs)) for _, _, ours, _, theirs, _ in meshes)
    return [
        [
            Increment(material, mesh, nodes, i + 1, at(ours, i), at(residuals, i), at(theirs, i), failed)
            for mesh, nodes, ours, residuals, theirs, failed in meshes
        ]
        for i in range(count)
    ]


def at(values: Sequence[float], place: int) -> Optional[float]:
    return values[place] if place < len(values) else None


@dataclass(frozen=True)
class Block:
    """A preconditioner with one AMG cycle for the sub-problems, and with exact solves."""

    label: str
    first: bool  # of its material
    count: Count
    exact: Entry

    @property
    def ratio(self) -> Optional[float]:
        """Ratio of the iterations."""
        one, other = self.count.entry.iterations, self.exact.iterations
        return one / other if one is not None and other else None

    @property
    def wide(self) -> bool:
        return self.ratio is not None and self.ratio > EXACT_RATIO


BLOCKS: Sequence[Column[Block]] = (
    Column(csv="exact_status", value=lambda b: b.exact.status),
    Column(csv="exact_iterations", value=lambda b: b.exact.iterations),
    Column(csv="ratio_to_exact", value=lambda b: b.ratio),
    Column(csv="message", value=lambda b: b.count.entry.message),
    Column(csv="exact_message", value=lambda b: b.exact.message),
)


def block_table(grid: Grid, key: System) -> Table:
    """Table 4: GMRES with block preconditioners, sub-problems by one AMG cycle and, where asked for, exactly."""
    with_exact = any(EXACT[method] in grid.methods for method in BLOCK_PRECONDITIONERS)
    marks = Marks(grid, key)
    rows = []
    for material in grid.materials:
        for i, (method, label) in enumerate(BLOCK_PRECONDITIONERS.items()):
            row = []
            for mesh in grid.meshes:
                count = marks.count(material, mesh, method, label)
                row.append(Block(label, i == 0, count, grid.entry(material, mesh, key, EXACT[method])))
                marks.remember(material, mesh, f"{label} exact", row[-1].exact)
            rows.append(row)
    blocks = [block for row in rows for block in row]
    notes = marks.notes()
    if with_exact:
        wide = sum(block.wide for block in blocks)
        notes.append(f"!: more than {EXACT_RATIO:g} times the count with exact sub-solves: {wide or 'none'}")
    return Table(
        f"table4_block_preconditioners_{suffix(key)}",
        f"Table 4: iterations of GMRES with block preconditioners, {grid.heading(key)}",
        [
            Column("material", value=lambda row: MATERIALS[row[0].count.material] if row[0].first else "", left=True),
            Column("method", value=lambda row: row[0].label, left=True),
            *(c for place, mesh in enumerate(grid.meshes) for c in _block_columns(place, mesh, with_exact)),
        ],
        rows,
        Facts([*(of_count(column) for column in count_columns(key)), *BLOCKS], blocks),
        [*notes, order_note(grid, key)],
    )


def of_count(column: Column[Count]) -> Column[Block]:
    return Column(csv=column.name, value=lambda block: column.value(block.count))


def _block_columns(place: int, mesh: str, with_exact: bool) -> List[Column[Sequence[Block]]]:
    columns: List[Column[Sequence[Block]]] = [
        Column("AMG" if with_exact else "ours", value=lambda row: row[place].count.shown, group=mesh)
    ]
    if with_exact:
        columns += [
            Column("exact", value=lambda row: row[place].exact.short, group=mesh),
            Column(
                "ratio",
                value=lambda row: row[place].ratio,
                text=lambda row: fixed(row[place].ratio, ".2f") + ("!" if row[place].wide else ""),
                group=mesh,
            ),
        ]
    columns.append(Column("paper", value=lambda row: row[place].count.papers, format="d", group=mesh))
    return columns


def multilevel_table(grid: Grid, key: System) -> Table:
    """Table 5: coupled AMG and AMLI, alone and within Krylov methods."""
    marks = Marks(grid, key)
    cells = [(material, mesh) for material in grid.materials for mesh in grid.meshes]
    rows = [
        (label, [marks.count(material, mesh, method, label) for material, mesh in cells])
        for method, label in MULTILEVEL.items()
    ]
    notes = marks.notes()
    if "coarse" in grid.meshes and "fine" in grid.meshes:
        grown = _grown(grid, key)
        notes.append(
            f"more than {GROWTH} iterations above the coarse mesh on the fine one: "
            f"{', '.join(grown) if grown else 'none'}"
        )
    return Table(
        f"table5_multilevel_{suffix(key)}",
        f"Table 5: iterations of coupled multilevel methods, ours (paper's), {grid.heading(key)}",
        [
            Column("method", value=lambda row: row[0], left=True),
            *(_multilevel_column(place, *cell) for place, cell in enumerate(cells)),
        ],
        rows,
        Facts(
            [*count_columns(key), Column(csv="message", value=lambda c: c.entry.message)],
            [count for _, counts in rows for count in counts],
        ),
        notes,
    )


def _multilevel_column(place: int, material: str, mesh: str) -> Column[Tuple[str, List[Count]]]:
    def text(row: Tuple[str, List[Count]]) -> str:
        count = row[1][place]
        return f"{count.shown} ({fixed(count.papers, 'd')})"

    return Column(MESHES[mesh], value=text, group=MATERIALS[material])


def _grown(grid: Grid, key: System) -> List[str]:
    """Methods that take more iterations on the fine mesh."""
    found = []
    for method, label in MULTILEVEL.items():
        for material in grid.materials:
            coarse, fine = (grid.entry(material, mesh, key, method).iterations for mesh in ("coarse", "fine"))
            if coarse is not None and fine is not None and fine > coarse + GROWTH:
                found.append(f"{label} {MATERIALS[material]} ({fine - coarse})")
    return found


class Alone(NamedTuple):
    """The AMG of a sub-problem."""

    material: str
    mesh: str
    results: LinearSolvers
    p: SubProblem

    @property
    def good(self) -> bool:
        return self.p.factor is not None and self.p.factor < 1


SUB_PROBLEMS: Sequence[Column[Alone]] = (
    Column("material", "material", lambda a: a.material, MATERIALS.__getitem__, left=True),
    Column("mesh", "mesh", lambda a: a.mesh, left=True),
    Column(csv="nodes", value=lambda a: a.results.mesh.get("nodes")),
    Column("problem", "problem", lambda a: a.p.problem, left=True),
    Column("coarsening", "coarsening", lambda a: a.p.coarsening, left=True),
    Column("smoother", "smoother", lambda a: a.p.smoother, left=True),
    Column("cycle", "cycle", lambda a: a.p.cycle, left=True),
    Column("levels", "levels", lambda a: a.p.levels),
    Column("factor", "convergence_factor", lambda a: a.p.factor if a.good else None, ".3f", missing="n.c."),
    Column("#it", "iterations", lambda a: a.p.iterations if a.good else None, "d"),
    Column("complexity", "operator_complexity", lambda a: a.p.operator_complexity, ".2f"),
)


def sub_problem_table(grid: Grid) -> Table:
    """The sub-problems' AMG alone."""
    outcomes = [(material, mesh, grid.outcome(material, mesh)) for material in grid.materials for mesh in grid.meshes]
    return Table(
        "sub_problems",
        "AMG of the sub-problems alone",
        SUB_PROBLEMS,
        [
            Alone(material, mesh, outcome.results, p)
            for material, mesh, outcome in outcomes
            if outcome is not None and outcome.results is not None
            for p in outcome.results.sub_problems
        ],
        notes=["factor: mean contraction of the residual per cycle; 1 and more: n.c."],
    )
