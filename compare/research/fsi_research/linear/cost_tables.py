"""What the methods cost on one system: seconds, cycles, work, memory."""

from dataclasses import dataclass
from typing import Any, Callable, List, Optional

from ..catalogue.names import MATERIALS
from fsi_compare.study.mesh_levels import MESHES
from fsi_compare.reporting.column import Column, fixed
from fsi_compare.reporting.layout import Table
from .grid import Entry, Grid, suffix
from .results import NewtonSystem, Solve, System

SAME_SOLUTION = 1e-7  # relative difference to the direct solver's


@dataclass(frozen=True)
class Spent:
    """Cost of one method on one system."""

    material: str
    mesh: str
    method: str
    first: bool  # of its mesh
    system: Optional[NewtonSystem]
    threads: Optional[int]
    entry: Entry

    def unknowns(self, name: str) -> Optional[int]:
        return self.system.unknowns.get(name) if self.system else None

    @property
    def failure(self) -> str:
        """Text for the notes; empty: it converged."""
        if self.entry.solve is not None:
            return ""
        method = "" if self.entry.status == "failed" else f"{self.method}, "
        return f"{self.entry.short}: {method}{MATERIALS[self.material]} {MESHES[self.mesh]}: {self.entry.message}"

    @property
    def apart(self) -> bool:
        """Whether the solution differs from the direct solver's."""
        solve = self.entry.solve
        return solve is not None and solve.difference is not None and solve.difference > SAME_SOLUTION


def _solved(value: Callable[[Solve], Any]) -> Callable[[Spent], Any]:
    return lambda spent: value(spent.entry.solve) if spent.entry.solve else None


def _columns(key: System, with_direct: bool) -> List[Column[Spent]]:
    """The difference to the direct solver's solution is shown where that was asked for."""
    return [
        Column(csv="step", value=lambda s: key[0]),
        Column(csv="newton_iteration", value=lambda s: key[1]),
        Column(csv="time", unit="ms", value=lambda s: s.system.time_ms if s.system else None),
        Column("material", "material", lambda s: s.material, text=lambda s: s.first * MATERIALS[s.material], left=True),
        Column("mesh", "mesh", lambda s: s.mesh, text=lambda s: s.first * s.mesh, left=True),
        Column(
            "unknowns",
            "unknowns",
            lambda s: s.unknowns("total"),
            text=lambda s: s.first * fixed(s.unknowns("total"), ",d"),
            left=True,
        ),
        Column(csv="mesh_unknowns", value=lambda s: s.unknowns("mesh")),
        Column(csv="flow_unknowns", value=lambda s: s.unknowns("flow")),
        Column(csv="wall_unknowns", value=lambda s: s.unknowns("wall")),
        Column(csv="threads", value=lambda s: s.threads),
        Column(csv="product_seconds", value=lambda s: s.system.product_seconds if s.system else None),
        Column("method", "method", lambda s: s.method, left=True),
        Column(csv="status", value=lambda s: s.entry.status),
        Column(
            "#it",
            "iterations",
            _solved(lambda s: s.iterations),
            text=lambda s: fixed(s.entry.iterations, "d") if s.entry.solve else s.entry.short,
        ),
        Column("set-up", "set_up_seconds", _solved(lambda s: s.set_up_seconds), ".3g", group="seconds"),
        Column("solve", "solve_seconds", _solved(lambda s: s.solve_seconds), ".3g", group="seconds"),
        Column("work units", "work_units", _solved(lambda s: s.work_units), ".1f"),
        *(Column(name, f"{name}_cycles", _cycles(name), "d", group="cycles") for name in ("mesh", "flow", "wall")),
        Column("levels", "levels", _solved(lambda s: s.levels), "d"),
        Column("complexity", "operator_complexity", _solved(lambda s: s.operator_complexity), ".2f", group="operator"),
        Column("{unit}", "memory", _solved(lambda s: s.memory_MiB), ".1f", "MiB", "memory"),
        Column("residual", "relative_residual", _solved(lambda s: s.relative_residual), ".1e", group="true relative"),
        Column(
            "to direct" if with_direct else "",
            "difference_to_direct",
            _solved(lambda s: s.difference),
            text=lambda s: fixed(_solved(lambda s: s.difference)(s), ".1e") + s.apart * "!",
            group="relative difference",
        ),
        Column(csv="message", value=lambda s: s.entry.message),
    ]


def _cycles(name: str) -> Callable[[Spent], Any]:
    return _solved(lambda solve: solve.cycles.get(name))


def cost_table(grid: Grid, key: System) -> Table:
    """What each method costs, all materials and meshes below each other."""
    spent = [one for material in grid.materials for mesh in grid.meshes for one in _spent(grid, key, material, mesh)]
    notes = [
        "work units: solve seconds / seconds of one product with the coupled matrix; cycles: of the sub-problems' AMG"
    ]
    if "direct" in grid.methods:
        apart = sum(one.apart for one in spent)
        notes.append(
            f"!: relative difference to the direct solver's solution above {SAME_SOLUTION:g}: {apart or 'none'}"
        )
    return Table(
        f"cost_{suffix(key)}",
        f"Cost of the methods, {grid.heading(key)}",
        _columns(key, "direct" in grid.methods),
        spent,
        notes=[*notes, *dict.fromkeys(one.failure for one in spent if one.failure)],
    )


def _spent(grid: Grid, key: System, material: str, mesh: str) -> List[Spent]:
    outcome, system = grid.outcome(material, mesh), grid.system(material, mesh, key)
    threads = outcome.results.threads if outcome and outcome.results else None
    entries = [(method, grid.entry(material, mesh, key, method)) for method in grid.methods]
    run = [(method, entry) for method, entry in entries if entry.status != "not run"]
    return [Spent(material, mesh, method, i == 0, system, threads, entry) for i, (method, entry) in enumerate(run)]
