"""The paper's claims about Newton's method and the linear solvers, its sections 5.1 to 5.5."""

import math
from typing import Callable, List, Mapping, Optional, Sequence, Tuple

from ... import paper
from ...names import BLOCK_PRECONDITIONERS, MESHES, MULTILEVEL
from ...solver_tables import Grid
from .claims import Claim, unexamined, verdict
from .linear import FIRST_SYSTEM

ROUNDING = 1e-11  # increments below this times the first are rounding
ALMOST_SAME = 0.15  # relative spread of counts that still are "almost the same"


def solver_claims(grid: Optional[Grid], meshes: Mapping[str, Mapping[str, int]]) -> List[Claim]:
    claims = [_mesh_claim(meshes)]
    for section, text, judge in CLAIMS:
        found = judge(grid) if grid else None
        claims.append(Claim(section, text, *found) if found else unexamined(section, text))
    return claims


def _mesh_claim(meshes: Mapping[str, Mapping[str, int]]) -> Claim:
    text = "Three meshes with 1,034, 7,249 and 54,521 nodes"
    apart = {mesh: counts["nodes"] / paper.mesh_counts(mesh)["nodes"] - 1
             for mesh, counts in meshes.items() if "nodes" in counts}
    if not apart:
        return unexamined("5.1", text)
    return Claim("5.1", text, verdict(all(abs(value) < 0.1 for value in apart.values())),
                 ", ".join(f"{meshes[mesh]['nodes']:,} ({100 * value:+.1f} %)" for mesh, value in apart.items()),
                 "" if len(apart) == len(MESHES) else f"this form of the study has the {' and '.join(apart)} mesh only")


Finding = Optional[Tuple[str, str, str]]  # verdict, numbers, why


def _first_steps(grid: Grid):
    """(material, mesh, norms of the increments) in the first time step."""
    for material in grid.materials:
        for mesh in grid.meshes:
            outcome = grid.outcome(material, mesh)
            for step in outcome.results.newton if outcome and outcome.results else ():
                if step.step == 1:
                    yield material, mesh, step.increments


def _newton_order(grid: Grid) -> Finding:
    orders, steps = {}, {}
    for material, mesh, increments in _first_steps(grid):
        e = [value for value in increments if value > ROUNDING * increments[0]]
        found = [math.log(c / b) / math.log(b / a) for a, b, c in zip(e, e[1:], e[2:]) if c < b < a]
        if found:
            orders[material, mesh] = max(found)
        steps[material, mesh] = len(increments)
    if not orders:
        return None
    low, high = min(orders.values()), max(orders.values())
    fewest, most = min(steps.values()), max(steps.values())
    return (verdict(low > 1.5, partly=high > 1.5),
            f"best observed order {low:.2f} to {high:.2f} over {len(orders)} cells; {fewest} to {most} iterations",
            "the artery takes one more: its fibres switch on in the first step" if most > fewest else "")


def _same_newton(grid: Grid) -> Finding:
    counts = [sum(value > 1e-8 * increments[0] for value in increments) for _, _, increments in _first_steps(grid)]
    if len(counts) < 2:
        return None
    spread = max(counts) - min(counts)
    numbers = f"{min(counts)} to {max(counts)} increments above 1e-8 of the first"
    return verdict(spread <= 1, partly=spread <= 2), numbers, ""


def _cells(grid: Grid, names: Sequence[str]):
    """(material, mesh, counts by name) of the cells where all of them converged."""
    for material in grid.materials:
        for mesh in grid.meshes:
            counts = {name: grid.entry(material, mesh, FIRST_SYSTEM, name).iterations for name in names}
            if None not in counts.values():
                yield material, mesh, counts


def _diagonal(grid: Grid) -> Finding:
    cells = list(_cells(grid, list(BLOCK_PRECONDITIONERS)))
    if not cells:
        return None
    ratios = [counts["diagonal"] / max(v for name, v in counts.items() if name != "diagonal") for _, _, counts in cells]
    numbers = f"{min(ratios):.1f} to {max(ratios):.1f} times as many ({len(cells)} cells; paper 1.8 to 2.0)"
    return verdict(min(ratios) > 1), numbers, ""


def _four_alike(grid: Grid) -> Finding:
    names = [name for name in BLOCK_PRECONDITIONERS if name != "diagonal"]
    cells = list(_cells(grid, names))
    if not cells:
        return None
    spreads = [max(counts.values()) / min(counts.values()) - 1 for _, _, counts in cells]
    numbers = f"apart by up to {100 * max(spreads):.0f} % (paper 9 %)"
    return verdict(max(spreads) <= ALMOST_SAME, partly=min(spreads) <= ALMOST_SAME), numbers, ""


def _grows(grid: Grid) -> Finding:
    if len(grid.meshes) < 2:
        return None
    first, last = grid.meshes[0], grid.meshes[-1]
    factors = []
    for material in grid.materials:
        for name in BLOCK_PRECONDITIONERS:
            a, b = (grid.entry(material, mesh, FIRST_SYSTEM, name).iterations for mesh in (first, last))
            if a and b:
                factors.append(b / a)
    if not factors:
        return None
    numbers = f"times {min(factors):.1f} to {max(factors):.1f} from {first} to {last} mesh"
    return verdict(min(factors) > 1.2), numbers, ""


def _multilevel_robust(grid: Grid) -> Finding:
    if len(grid.meshes) < 2:
        return None
    first, last = grid.meshes[0], grid.meshes[-1]
    growth, worst = [], []
    for material in grid.materials:
        for name in MULTILEVEL:
            a, b = (grid.entry(material, mesh, FIRST_SYSTEM, name).iterations for mesh in (first, last))
            if a is not None and b is not None:
                growth.append(b - a)
                worst.append(b)
    if not growth:
        return None
    numbers = (f"{min(growth)} to {max(growth)} more iterations on the {last} mesh than on the {first} one, at most "
               f"{max(worst)} (paper: 1 to 5 more, at most 12)")
    why = "few everywhere, but growing: the smoother does the work, not the coarse levels" if max(growth) > 3 else ""
    return verdict(max(growth) <= 3, partly=max(worst) <= 12), numbers, why


def _amg_amli(grid: Grid) -> Finding:
    pairs = [(name, name.replace("amg", "amli", 1)) for name in MULTILEVEL if name.startswith("amg")]
    apart = [abs(counts[a] - counts[b]) for a, b in pairs for _, _, counts in _cells(grid, (a, b))]
    if not apart:
        return None
    same = sum(value == 0 for value in apart)
    numbers = f"the same in {same} of {len(apart)} cells, apart by up to {max(apart)}"
    return verdict(same == len(apart), partly=max(apart) <= 1), numbers, ""


def _within_krylov(grid: Grid) -> Finding:
    pairs = [(alone, f"{alone}_{krylov}") for alone in ("amg", "amli") for krylov in ("gmres", "fgmres")]
    gains = [counts[alone] - counts[inside] for alone, inside in pairs
             for _, _, counts in _cells(grid, (alone, inside))]
    if not gains:
        return None
    fewer = sum(value > 0 for value in gains)
    enough = fewer >= len(gains) / 2
    return (verdict(min(gains) >= 0 and enough, partly=min(gains) >= 0 or fewer > 0),
            f"fewer in {fewer} of {len(gains)} cells, by {min(gains)} to {max(gains)}",
            "" if enough else "with the best damping of the smoother a Krylov method has little to gain")


def _not_above(names: Mapping[str, str]) -> Callable[[Grid], Finding]:
    def judge(grid: Grid) -> Finding:
        cells = [(counts[name], paper.limit(name, material, mesh, at_rest=True)) for name in names
                 for material, mesh, counts in _cells(grid, (name,))]
        cells = [(ours, theirs) for ours, theirs in cells if theirs is not None]
        if not cells:
            return None
        above = sum(ours > theirs for ours, theirs in cells)
        ratios = [ours / theirs for ours, theirs in cells]
        numbers = (f"ours are {min(ratios):.2f} to {max(ratios):.2f} times the paper's, above them in {above} of "
                   f"{len(cells)} cells")
        why = ("from rest the artery's matrix is the neo-Hookean one, so that it is held to that column; the paper's "
               "artery column is lower") if "artery" in grid.materials else ""
        return verdict(above == 0, partly=above < len(cells) / 4), numbers, why
    return judge


CLAIMS: Sequence[Tuple[str, str, Callable[[Grid], Finding]]] = (
    ("5.2", "Newton's method converges (nearly) quadratically", _newton_order),
    ("5.2", "Nearly the same convergence for all materials and meshes", _same_newton),
    ("5.3", "Table 4, iterations of GMRES with block preconditioners: no more here", _not_above(BLOCK_PRECONDITIONERS)),
    ("5.3", "The diagonal preconditioner needs more iterations than the other four", _diagonal),
    ("5.3", "Lower, upper, SSOR and ILU need almost the same number", _four_alike),
    ("5.3", "Their iterations increase when the mesh is refined", _grows),
    ("5.4", "Table 5, iterations of the coupled AMG and AMLI methods: no more here", _not_above(MULTILEVEL)),
    ("5.4", "AMG and AMLI require the same number in each case", _amg_amli),
    ("5.4", "As preconditioners of GMRES and FGMRES they need fewer iterations than alone", _within_krylov),
    ("5.4", "Their iterations stay in a similar range when the mesh is refined", _multilevel_robust),
)
