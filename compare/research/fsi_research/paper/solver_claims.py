"""The paper's claims about Newton's method and the linear solvers, its sections 5.1 to 5.4 and 6."""

import itertools
import math
import sys
from typing import Callable, Collection, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple

from ..catalogue import paper
from ..catalogue.names import BLOCK_PRECONDITIONERS, MATERIALS, MULTILEVEL
from fsi_compare.study.mesh_levels import MESHES
from ..linear.grid import Grid
from .claims import Claim, compared, unexamined, verdict
from .linear import FIRST_SYSTEM

# Increments below this times the first are round-off: they are sums over some thousand unknowns, each with the
# machine's epsilon of what was subtracted.
ROUND_OFF = 100 * sys.float_info.epsilon

# What each verdict asks for. The numbers are the claims' own, or the paper's tables'; none is ours.
NODES_WITHIN = 0.1
MESH_RULE = f"reproduced: nodes within {100 * NODES_WITHIN:.0f} %"

QUADRATIC = 1.8  # "(near)quadratic"
QUADRATIC_ORDER = f"ln(e3/e2) / ln(e2/e1) of the last three increments above {ROUND_OFF:.0e} of the first"
QUADRATIC_RULE = (
    f"reproduced: the observed order, {QUADRATIC_ORDER}, is at least {QUADRATIC:g} in every cell; in part: in half of "
    "the cells"
)

SAME_NEWTON, ABOUT_SAME_NEWTON = 1, 2  # iterations
SAME_NEWTON_RULE = (
    f"reproduced: counts of increments above 1e-8 of the first differ by at most {SAME_NEWTON}; in "
    f"part: by {ABOUT_SAME_NEWTON}"
)

DIAGONAL_RULE = "reproduced: more in every cell"

ALMOST_SAME = 0.15  # relative spread of counts
ALMOST_SAME_RULE = (
    f"reproduced: the four differ by at most {100 * ALMOST_SAME:.0f} % in every cell; in part: in some cell"
)

GROWS = 1.2  # factor from the coarsest to the finest mesh
GROWS_RULE = f"reproduced: by a factor of at least {GROWS:g} for each material and preconditioner"

SIMILAR_SYSTEMS, ROUGHLY_SIMILAR_SYSTEMS = 1.25, 1.5  # largest over smallest count, or one iteration
SIMILAR_SYSTEMS_RULE = (
    f"reproduced: counts of the first three Newton systems within a factor of {SIMILAR_SYSTEMS:g} "
    f"or one iteration, in every cell; in part: within {ROUGHLY_SIMILAR_SYSTEMS:g}"
)

STEPS_RULE = (
    "reproduced: at most 10 smoothing steps a level and cycle, one cycle of each sub-problem in each, and no "
    "count above the paper's Table 5; in part: the steps alone"
)

SAME_COUNTS_RULE = "reproduced: the same count in every cell; in part: apart by at most 1"

FEWER_WITHIN = 0.5  # of the cells
FEWER_WITHIN_RULE = (
    f"reproduced: fewer in at least {100 * FEWER_WITHIN:.0f} % of the cells and more in none; in "
    f"part: fewer in {100 * FEWER_WITHIN:.0f} %"
)

# The largest growth in the paper's Table 5, rounded up: what it calls a very similar range.
SIMILAR_RANGE = 1.75
SIMILAR_RANGE_RULE = (
    f"reproduced: from the coarsest to the finest mesh by a factor of at most {SIMILAR_RANGE:g} (the "
    "paper's table: 1.71) for each material and method; in part: for most"
)

ROBUST_RULE = (
    f"reproduced: counts of the multilevel methods grow by at most {SIMILAR_RANGE:g} and by less than those "
    "of every block preconditioner, material by material; in part: the latter only"
)


def solver_claims(grid: Optional[Grid], later: Optional[Grid], meshes: Mapping[str, Mapping[str, int]]) -> List[Claim]:
    """`later`: later Newton systems of the first step."""
    claims = [_mesh_claim(meshes)]
    for section, text, rule, judge in CLAIMS:
        found = judge(grid) if grid else None
        claims.append(Claim(section, text, *found, rule) if found else unexamined(section, text, rule))
    for section, text, names in SIMILAR_CLAIMS:
        found = _later_systems(grid, later, names) if grid and later else None
        rule = SIMILAR_SYSTEMS_RULE
        claims.append(Claim(section, text, *found, rule) if found else unexamined(section, text, rule))
    return claims


def comparisons(grid: Optional[Grid]) -> List[Claim]:
    """Counts of the paper's tables beside ours: nothing that the paper claims."""
    found = []
    for section, text, names in COMPARISONS:
        numbers = _compare(grid, names) if grid else None
        if numbers:
            found.append(Claim(section, text, *numbers))
    return found


def _mesh_claim(meshes: Mapping[str, Mapping[str, int]]) -> Claim:
    text = "Three meshes with 1,034, 7,249 and 54,521 nodes"
    apart = {
        mesh: counts["nodes"] / paper.mesh_counts(mesh)["nodes"] - 1
        for mesh, counts in meshes.items()
        if "nodes" in counts
    }
    if not apart:
        return unexamined("5.1", text, MESH_RULE)
    return Claim(
        "5.1",
        text,
        verdict(all(abs(value) < NODES_WITHIN for value in apart.values())),
        ", ".join(f"{meshes[mesh]['nodes']:,} ({100 * value:+.1f} %)" for mesh, value in apart.items()),
        "" if len(apart) == len(MESHES) else f"this form of the study has the {' and '.join(apart)} mesh only",
        MESH_RULE,
    )


Finding = Optional[Tuple[str, str, str]]  # verdict, numbers, why


def _first_steps(grid: Grid) -> Iterator[Tuple[str, str, List[float]]]:
    """(material, mesh, norms of the increments) in the first time step."""
    for material in grid.materials:
        for mesh in grid.meshes:
            outcome = grid.outcome(material, mesh)
            for step in outcome.results.newton if outcome and outcome.results else ():
                if step.step == 1:
                    yield material, mesh, step.increments


def observed_orders(increments: Sequence[float]) -> List[float]:
    """ln(c/b) / ln(b/a) for each three increments a, b, c in a row, up to the first that is round-off. Where b is not
    below a there is no convergence yet, and no order."""
    above = list(itertools.takewhile(lambda value: value > ROUND_OFF * increments[0], increments))
    return [math.log(c / b) / math.log(b / a) for a, b, c in zip(above, above[1:], above[2:]) if b < a]


def _newton_order(grid: Grid) -> Finding:
    """Judges by the last order above round-off: convergence is quadratic near the solution, not from the start."""
    orders: Dict[Tuple[str, str], float] = {}
    theirs: Dict[Tuple[str, str], float] = {}
    steps = {}
    for material, mesh, increments in _first_steps(grid):
        steps[material, mesh] = len(increments)
        for found, norms in ((orders, increments), (theirs, paper.newton_increments(material, mesh))):
            observed = observed_orders(norms)
            if observed:
                found[material, mesh] = observed[-1]
    if not orders:
        return None
    reached = sum(order >= QUADRATIC for order in orders.values())
    below = [
        f"{MATERIALS[material]} {MESHES[mesh]} {order:.2f}"
        for (material, mesh), order in orders.items()
        if order < QUADRATIC
    ]
    numbers = (
        f"observed order {_range(orders.values())}, at least {QUADRATIC:g} in {reached} of {len(orders)} cells; "
        f"{_range(steps.values(), 'd')} iterations"
        + (f"; the paper's own increments: {_range(theirs.values())}" if theirs else "")
    )
    why = f"the order: {QUADRATIC_ORDER}; {QUADRATIC:g} and more count as quadratic"
    if below:
        why += f"; below it: {', '.join(below)}"
        if any(name.startswith(MATERIALS["artery"]) for name in below):
            why += "; the artery's fibres switch on in this step, where its stress is differentiable only once"
    return verdict(reached == len(orders), partly=2 * reached >= len(orders)), numbers, why


def _same_newton(grid: Grid) -> Finding:
    counts = [sum(value > 1e-8 * increments[0] for value in increments) for _, _, increments in _first_steps(grid)]
    if len(counts) < 2:
        return None
    spread = max(counts) - min(counts)
    numbers = f"{min(counts)} to {max(counts)} increments above 1e-8 of the first"
    return verdict(spread <= SAME_NEWTON, partly=spread <= ABOUT_SAME_NEWTON), numbers, ""


def _cells(grid: Grid, names: Sequence[str]) -> Iterator[Tuple[str, str, Dict[str, int]]]:
    """(material, mesh, counts by name) of the cells where all of them converged, at the first system."""
    for material in grid.materials:
        for mesh in grid.meshes:
            entries = {name: grid.entry(material, mesh, FIRST_SYSTEM, name).iterations for name in names}
            counts = {name: count for name, count in entries.items() if count is not None}
            if len(counts) == len(entries):
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


def _growth(grid: Grid, names: Sequence[str]) -> Dict[str, List[float]]:
    """Counts on the finest mesh over those on the coarsest one, by material; empty with a single mesh."""
    if len(grid.meshes) < 2:
        return {}
    found: Dict[str, List[float]] = {}
    for material in grid.materials:
        for name in names:
            a, b = (
                grid.entry(material, mesh, FIRST_SYSTEM, name).iterations for mesh in (grid.meshes[0], grid.meshes[-1])
            )
            if a and b:
                found.setdefault(material, []).append(b / a)
    return found


def _paper_growth(grid: Grid, names: Sequence[str]) -> List[float]:
    counts = [
        [paper.iterations(name, material, mesh) for mesh in (grid.meshes[0], grid.meshes[-1])]
        for material in grid.materials
        for name in names
    ]
    return [b / a for a, b in counts if a and b]


def _all(by_material: Mapping[str, Sequence[float]]) -> List[float]:
    return [value for values in by_material.values() for value in values]


def _growth_text(grid: Grid, ours: Sequence[float], names: Sequence[str]) -> str:
    theirs = _paper_growth(grid, names)
    return f"times {_range(ours, '.1f')} from {grid.meshes[0]} to {grid.meshes[-1]} mesh" + (
        f" (paper {_range(theirs, '.1f')})" if theirs else ""
    )


def _grows(grid: Grid) -> Finding:
    factors = _all(_growth(grid, list(BLOCK_PRECONDITIONERS)))
    if not factors:
        return None
    return verdict(min(factors) >= GROWS), _growth_text(grid, factors, list(BLOCK_PRECONDITIONERS)), ""


def _similar_range(grid: Grid) -> Finding:
    factors = _all(_growth(grid, list(MULTILEVEL)))
    if not factors:
        return None
    kept = sum(factor <= SIMILAR_RANGE for factor in factors)
    counts = [
        grid.entry(material, grid.meshes[-1], FIRST_SYSTEM, name).iterations
        for material in grid.materials
        for name in MULTILEVEL
    ]
    most = max(count for count in counts if count is not None)
    why = (
        "few everywhere, but growing: the smoother does the work, not the coarse levels" if kept < len(factors) else ""
    )
    return (
        verdict(kept == len(factors), partly=2 * kept > len(factors)),
        f"{_growth_text(grid, factors, list(MULTILEVEL))}; at most {most} iterations",
        why,
    )


def _more_robust(grid: Grid) -> Finding:
    multilevel, block = _growth(grid, list(MULTILEVEL)), _growth(grid, list(BLOCK_PRECONDITIONERS))
    both = [material for material in multilevel if material in block]
    if not both:
        return None
    less = all(max(multilevel[material]) < min(block[material]) for material in both)
    inside = max(_all(multilevel)) <= SIMILAR_RANGE
    return (
        verdict(less and inside, partly=less),
        f"multilevel {_growth_text(grid, _all(multilevel), list(MULTILEVEL))}; block preconditioners "
        f"{_growth_text(grid, _all(block), list(BLOCK_PRECONDITIONERS))}",
        ""
        if less and inside
        else "in numbers of iterations the multilevel methods are far ahead, in their growth they are not",
    )


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
    gains = [
        counts[alone] - counts[inside] for alone, inside in pairs for _, _, counts in _cells(grid, (alone, inside))
    ]
    if not gains:
        return None
    fewer, more = sum(value > 0 for value in gains), sum(value < 0 for value in gains)
    enough = fewer >= FEWER_WITHIN * len(gains)
    return (
        verdict(enough and not more, partly=enough),
        f"fewer in {fewer} of {len(gains)} cells, more in {more}, by {min(gains)} to {max(gains)}",
        "" if enough else "with the best damping of the smoother a Krylov method has little to gain",
    )


def _smoothing_steps(grid: Grid) -> Finding:
    """Steps of the methods alone: a W-cycle visits the level below the finest twice, and so on, and every visit takes
    the same number of steps, each with its sub-problem cycles."""
    steps, equal = [], True
    for material in grid.materials:
        for mesh in grid.meshes:
            for name in ("amg", "amli"):
                solve = grid.entry(material, mesh, FIRST_SYSTEM, name).solve
                if solve and solve.iterations and solve.cycles and solve.levels and solve.levels > 1:
                    visits = 2 ** (solve.levels - 1) - 1
                    equal = equal and len(set(solve.cycles.values())) == 1
                    steps.append(max(solve.cycles.values()) / (solve.iterations * visits))
    comparison = _cells_of_paper(grid, list(MULTILEVEL))
    if not steps or not comparison:
        return None
    above = sum(ours > theirs for ours, theirs in comparison)
    few = equal and max(steps) <= 10
    return (
        verdict(few and not above, partly=few),
        f"{_range(steps, '.0f')} steps, one cycle of each sub-problem {'' if equal else 'not '}in each; above the "
        f"paper's count in {above} of {len(comparison)} cells",
        "a sub-problem's cycle is a W(2,2) here; the paper does not say what its own is",
    )


def _later_systems(grid: Grid, later: Grid, names: Sequence[str]) -> Finding:
    apart, ratios, counted, systems = [], [], 0, set()
    for material in later.materials:
        for mesh in later.meshes:
            for name in names:
                entries = [grid.entry(material, mesh, FIRST_SYSTEM, name)]
                entries += [later.entry(material, mesh, key, name) for key in later.systems]
                counts = [entry.iterations for entry in entries if entry.iterations]
                if len(counts) < len(entries):
                    continue
                counted += 1
                systems.update(later.systems)
                apart.append(max(counts) - min(counts))
                ratios.append(max(counts) / min(counts))
    if not counted:
        return None

    def within(factor: float) -> bool:
        return all(ratio <= factor or step <= 1 for ratio, step in zip(ratios, apart))

    return (
        verdict(within(SIMILAR_SYSTEMS), partly=within(ROUGHLY_SIMILAR_SYSTEMS)),
        f"largest over smallest count of the systems 1 to {max(k for _, k in systems)}: {_range(ratios)} over "
        f"{counted} cells ({', '.join(later.meshes)}), apart by up to {max(apart)}",
        "",
    )


def _cells_of_paper(grid: Grid, names: Sequence[str]) -> List[Tuple[int, int]]:
    """(ours, the paper's) counts at the first system."""
    cells = [
        (counts[name], paper.limit(name, material, mesh, at_rest=True))
        for name in names
        for material, mesh, counts in _cells(grid, (name,))
    ]
    return [(ours, theirs) for ours, theirs in cells if theirs is not None]


def _compare(grid: Grid, names: Sequence[str]) -> Finding:
    cells = _cells_of_paper(grid, names)
    if not cells:
        return None
    fewer, above = sum(ours < theirs for ours, theirs in cells), sum(ours > theirs for ours, theirs in cells)
    numbers = (
        f"ours are {_range([ours / theirs for ours, theirs in cells])} times the paper's: fewer in {fewer}, "
        f"more in {above} of {len(cells)} cells"
    )
    why = (
        (
            "from rest the artery's matrix is the neo-Hookean one, so that it is compared with that column; the "
            "paper's artery column is lower"
        )
        if "artery" in grid.materials
        else ""
    )
    return compared(fewer, above), numbers, why


def _range(values: Collection[float], form: str = ".2f") -> str:
    low, high = format(min(values), form), format(max(values), form)
    return low if low == high else f"{low} to {high}"


CLAIMS: Sequence[Tuple[str, str, str, Callable[[Grid], Finding]]] = (
    ("5.2", "Newton's method converges (nearly) quadratically", QUADRATIC_RULE, _newton_order),
    ("5.2", "Nearly the same convergence for all materials and meshes", SAME_NEWTON_RULE, _same_newton),
    ("5.3", "The diagonal preconditioner needs more iterations than the other four", DIAGONAL_RULE, _diagonal),
    ("5.3", "Lower, upper, SSOR and ILU need almost the same number", ALMOST_SAME_RULE, _four_alike),
    ("5.3", "Their iterations increase when the mesh is refined", GROWS_RULE, _grows),
    ("5.4", "AMG and AMLI require the same number in each case", SAME_COUNTS_RULE, _amg_amli),
    (
        "5.4",
        "As preconditioners of GMRES and FGMRES they need fewer iterations than alone",
        FEWER_WITHIN_RULE,
        _within_krylov,
    ),
    (
        "5.4",
        "Their iterations stay in a very similar range when the mesh is refined",
        SIMILAR_RANGE_RULE,
        _similar_range,
    ),
    ("5.4", "With 8 to 10 smoothing steps, each with one AMG cycle of each sub-problem", STEPS_RULE, _smoothing_steps),
    ("6", "AMG and AMLI are more robust than the preconditioned Krylov methods", ROBUST_RULE, _more_robust),
)
SIMILAR_CLAIMS = (
    (
        "5.3",
        "GMRES with block preconditioners performs similarly for all Newton iterations",
        list(BLOCK_PRECONDITIONERS),
    ),
)
COMPARISONS = (
    ("5.3", "Table 4, iterations of GMRES with block preconditioners, compared", list(BLOCK_PRECONDITIONERS)),
    ("5.4", "Table 5, iterations of the coupled AMG and AMLI methods, compared", list(MULTILEVEL)),
)
