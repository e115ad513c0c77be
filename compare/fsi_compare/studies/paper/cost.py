"""The cost statement at the end of the paper's section 5.6, recomputed: what the monolithic approach saves."""

from dataclasses import dataclass
from typing import Dict, List, Optional, Sequence

from ... import paper
from ...cost import COUPLED, FLUID, WALL, calls
from ...layout import Table, fixed
from ...names import MESHES
from ...solver_tables import Grid
from .claims import Claim, unexamined, verdict
from .linear import FIRST_SYSTEM
from .runs import COST, FIXED_POINT, NEWTON, PaperRuns, mesh_of
from ..study_run import StudyRun

PAPER_MONOLITHIC, FAST_MONOLITHIC, PAPER_PARTITIONED = "paper-monolithic", "monolithic", "fixed-point"
RIVALS = (PAPER_PARTITIONED, "iqn-ils", "robin-neumann-iqn")
ENOUGH = 0.4  # saved: what we take for "almost 50 %"


@dataclass(frozen=True)
class StepCost:
    """Means over the time steps."""

    run: StudyRun
    passes: Optional[float]  # coupling iterations; None: monolithic
    newton: float  # of the whole system, or of fluid and wall together
    rounds: float  # as the paper counts: coupled linear iterations, or Newton iterations of one sub-problem
    solves: float  # uses of a sub-problem's solver: cycles in the coupled iterations, or iterations of its own
    systems: float  # linear systems solved, whole ones or those of fluid and wall
    linear: float  # iterations in them
    seconds: float  # without output

    @property
    def method(self) -> str:
        return self.run.request.method.name


def step_cost(run: StudyRun, cycles: Optional[float] = None) -> StepCost:
    """`cycles`: of a sub-problem in an iteration of the coupled multigrid method."""
    steps = run.columns("iterations.csv")
    count = len(steps["wall_s"])
    newton, linear = (float(steps[name].sum()) / count for name in ("newton_iterations", "linear_iterations"))
    solved = calls(run.summary.get("phases", {}), ("solve",))
    systems = sum(solved.get(name, 0) for name in (COUPLED, FLUID, WALL)) / count
    partitioned = run.request.method.program == "fsi-partitioned"
    # A sub-problem that is factorised takes one use of its solver a system.
    per_iteration = cycles if cycles and run.request.method.name == PAPER_MONOLITHIC else 1
    solves = max(linear, systems) / 2 if partitioned else linear * per_iteration
    return StepCost(run,
                    float(steps["outer_iterations"].sum()) / count if partitioned else None, newton,
                    newton / 2 if partitioned else linear, solves, systems, linear,
                    float(steps["wall_s"].sum()) / count)


def costs(runs: PaperRuns, grid: Optional[Grid] = None) -> List[StepCost]:
    return [
        step_cost(run, cycles_per_iteration(grid, mesh_of(run)))
        for run in sorted(runs.all(COST), key=lambda run: list(MESHES).index(mesh_of(run)))
    ]


def paper_rounds() -> Dict[str, float]:
    """The paper's own numbers: rounds of sub-problem work per step, and what "almost 50 %" makes of them."""
    p = paper.cost()
    middle = {name: sum(value) / len(value) for name, value in p.items() if isinstance(value, list)}
    monolithic = p["newton_iterations"] * p["coupled_iterations"]
    partitioned = middle["fixed_point_iterations"] * middle["sub_problem_newton_iterations"]
    cycles = monolithic * middle["smoothing_steps"]
    return {
        "monolithic": monolithic, "partitioned": partitioned, "saving": 1 - monolithic / partitioned, "cycles": cycles,
        "cycles_per_system": cycles / (1 - p["saving"]) / partitioned
    }


def cost_table(found: Sequence[StepCost]) -> Table:
    table = Table(
        stem="cost_statement",
        title="What a time step takes",
        left=2,
        columns=[("", "mesh"), ("", "method"), ("", "coupling iterations"), ("", "Newton iterations"),
                 ("", "rounds as the paper counts"), ("", "sub-problem solves"), ("", "linear systems"),
                 ("", "linear iterations"), ("", "seconds")],
        csv_columns=[
            "mesh", "method", "coupling_iterations", "newton_iterations", "rounds", "sub_problem_solves",
            "linear_systems", "linear_iterations", "wall_s_per_step", "steps"
        ],
        notes=[
            "Means over the same steps. Rounds: coupled linear iterations, or Newton iterations of a sub-problem "
            "(half of those of fluid and wall together); the paper sets each equal to one use of the sub-problems' "
            "solvers. Sub-problem solves: what these uses are, cycles of a sub-problem's AMG in the coupled "
            "iterations (AMG_FGMRES), iterations of the coupled solver (`fast`), or iterations of a sub-problem's "
            "own solver, a factorised one counting once. Linear systems: of the whole, or of fluid and wall. Seconds "
            "without output."
        ])
    for c in found:
        mesh = mesh_of(c.run)
        table.rows.append([
            mesh, c.run.request.method.label,
            fixed(c.passes, ".1f"), f"{c.newton:.1f}", f"{c.rounds:.0f}", f"{c.solves:.0f}", f"{c.systems:.1f}",
            f"{c.linear:.0f}", f"{c.seconds:.3g}"
        ])
        table.csv_rows.append(
            [mesh, c.method, c.passes, c.newton, c.rounds, c.solves, c.systems, c.linear, c.seconds, c.run.steps])
    return table


@dataclass(frozen=True)
class Saving:
    """Of a monolithic run over a partitioned one: 0.5 is half, negative is more."""

    mesh: str
    monolithic: StepCost
    partitioned: StepCost

    def of(self, quantity: str) -> float:
        return 1 - getattr(self.monolithic, quantity) / getattr(self.partitioned, quantity)


SAVED = (("rounds", "rounds as the paper counts"), ("solves", "sub-problem solves"), ("seconds", "seconds"))


def savings(found: Sequence[StepCost]) -> List[Saving]:
    by = {(mesh_of(c.run), c.method): c for c in found}
    return [
        Saving(mesh, by[mesh, mono], by[mesh, part]) for mesh in MESHES for mono in (PAPER_MONOLITHIC, FAST_MONOLITHIC)
        for part in RIVALS if (mesh, mono) in by and (mesh, part) in by
    ]


def saving_table(found: Sequence[Saving]) -> Table:
    table = Table(
        stem="cost_saving", title="What the monolithic approach saves, in percent; negative: it takes more", left=3,
        columns=[("", "mesh"), ("", "monolithic"), ("", "over"), *(("saved in", name) for _, name in SAVED)],
        csv_columns=["mesh", "monolithic", "partitioned", *(f"saved_{name}" for name, _ in SAVED)])
    for s in found:
        table.rows.append([s.mesh, s.monolithic.run.request.method.label, s.partitioned.run.request.method.label,
                           *(f"{100 * s.of(name):.0f}" for name, _ in SAVED)])
        table.csv_rows.append([s.mesh, s.monolithic.method, s.partitioned.method, *(s.of(name) for name, _ in SAVED)])
    return table


def cycles_per_iteration(grid: Optional[Grid], mesh: str, method: str = "amg_fgmres") -> Optional[float]:
    """Cycles of a sub-problem's AMG in an iteration of the coupled one, counted on the finest level: each of its
    smoothing steps takes one."""
    for material in grid.materials if grid else ():
        solve = grid.entry(material, mesh, FIRST_SYSTEM, method).solve
        if solve and solve.iterations and "flow" in solve.cycles:
            return solve.cycles["flow"] / solve.iterations
    return None


def cost_claims(runs: PaperRuns, found: Sequence[StepCost], cycles: Optional[float] = None) -> List[Claim]:
    """`cycles`: of the sub-problems in a coupled iteration."""
    p, own = paper.cost(), paper_rounds()
    claims = [_fixed_point_claim(runs, found, p), _newton_claim(runs, found)]
    theirs = [c for c in found if c.method == PAPER_MONOLITHIC]
    each = "In each of them, fluid and structure take 4 to 5 Newton iterations"
    inner = "A Newton iteration takes about 10 coupled AMG or AMLI iterations"
    partitioned = [c for c in found if c.method == PAPER_PARTITIONED]
    if partitioned:
        per_pass = [c.rounds / c.passes for c in partitioned]
        claims.append(Claim("5.6", each, verdict(3.5 <= max(per_pass) <= 5.5, partly=max(per_pass) < 3.5),
                            "; ".join(f"{value:.1f} ({mesh_of(c.run)})" for c, value in zip(partitioned, per_pass)),
                            "sub-problems are solved no further than a hundredth of the interface's residual, with "
                            "Jacobians kept"))
    else:
        claims.append(unexamined("5.6", each))
    if theirs:
        per_newton = [c.linear / c.newton for c in theirs]
        claims.append(
            Claim("5.6", inner, verdict(max(per_newton) <= 12 and max(per_newton) >= 8, partly=max(per_newton) < 8),
                  "; ".join(f"{value:.1f} ({mesh_of(c.run)})" for c, value in zip(theirs, per_newton)),
                  "fewer, with the same ten smoothing steps in each" if max(per_newton) < 8 else ""))
    else:
        claims.append(unexamined("5.6", inner))
    text = "The monolithic approach saves almost 50 % of the partitioned one's cost"
    saved = savings(found)
    if not saved:
        return [*claims, unexamined("5.6", text)]
    mesh = saved[-1].mesh
    here = [s for s in saved if s.mesh == mesh]
    lines = []
    for name in (PAPER_MONOLITHIC, FAST_MONOLITHIC):
        over = [f"{s.partitioned.run.request.method.label} {' / '.join(f'{100 * s.of(q):.0f}' for q, _ in SAVED)}"
                for s in here if s.monolithic.method == name]
        if over:
            label = next(s.monolithic.run.request.method.label for s in here if s.monolithic.method == name)
            lines.append(f"{label} over {', '.join(over)}")
    like_paper = [
        s.of("seconds") for s in here
        if s.monolithic.method == PAPER_MONOLITHIC and s.partitioned.method == PAPER_PARTITIONED
    ]
    best = [s.of("seconds") for s in here if s.monolithic.method == FAST_MONOLITHIC]
    enough = [value >= ENOUGH for value in (*like_paper, *best)]
    inside = f" (here {cycles:.0f} a coupled iteration)" if cycles else ""
    claims.append(Claim(
        "5.6", text, verdict(all(enough), partly=any(enough)),
        f"saved in percent, {' / '.join(label for _, label in SAVED)}, {mesh} mesh: {'; '.join(lines)}",
        f"the paper's own numbers are {own['monolithic']:.0f} against {own['partitioned']:.0f} rounds, "
        f"{100 * own['saving']:.0f} % fewer, but a coupled iteration's 8 to 10 smoothing steps take as many "
        f"sub-problem cycles{inside}: {own['cycles']:.0f} a step, which are half of the partitioned ones if a "
        f"sub-problem's system takes {own['cycles_per_system']:.0f} cycles. Iterations are not seconds: what is saved "
        "depends on both solvers"))
    return claims


def _fixed_point_claim(runs: PaperRuns, found: Sequence[StepCost], p: dict) -> Claim:
    low, high = p["fixed_point_iterations"]
    text = f"The partitioned approach takes {low} to {high} fixed-point iterations a step"
    whole = [(run.request.case, run) for run in runs.all(FIXED_POINT)]
    if not whole:
        whole = [(mesh_of(c.run), c.run) for c in found if c.method == PAPER_PARTITIONED]
    if not whole:
        return unexamined("5.6", text)
    means, parts = [], []
    for name, run in whole:
        outer = run.columns("iterations.csv")["outer_iterations"]
        means.append(float(outer.mean()))
        parts.append(f"{name} {outer.mean():.1f} ({outer.min():.0f} to {outer.max():.0f})")
    inside = [low <= mean <= high for mean in means]
    near = [0.8 * low <= mean <= 1.2 * high for mean in means]
    return Claim("5.6", text, verdict(all(inside), partly=any(near)),
                 f"Aitken's factor, tolerance 1e-6: {', '.join(parts)}",
                 f"{whole[0][1].steps} steps; the paper gives neither tolerance nor relaxation")


def _newton_claim(runs: PaperRuns, found: Sequence[StepCost]) -> Claim:
    text = "The monolithic approach takes about 4 Newton iterations, the same at all steps"
    whole = [(run.request.case, run) for run in runs.all(NEWTON)]
    if not whole:
        whole = [(mesh_of(c.run), c.run) for c in found if c.method == "newton"]
    if not whole:
        return unexamined("5.2, 5.6", text)
    parts, most = [], 0.0
    for name, run in whole:
        newton = run.columns("iterations.csv")["newton_iterations"]
        most = max(most, float(newton.max()))
        parts.append(f"{name} {newton.mean():.1f} ({newton.min():.0f} to {newton.max():.0f})")
    return Claim("5.2, 5.6", text, verdict(most <= 5, partly=most <= 8),
                 f"new Jacobian in each iteration, relative increment 1e-8: {', '.join(parts)}",
                 "with Jacobians kept, the default, more and cheaper ones")
