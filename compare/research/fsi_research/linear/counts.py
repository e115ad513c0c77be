"""Iterations of the methods on one system beside the paper's: larger counts are marked, and explained by notes."""

from dataclasses import dataclass, replace
from typing import List, Optional, Tuple

from ..catalogue import paper
from ..catalogue.names import BLOCK_PRECONDITIONERS, MATERIALS
from fsi_compare.study.mesh_levels import MESHES
from fsi_compare.reporting.column import Column
from .grid import Entry, Grid
from .results import NewtonSystem, System


@dataclass(frozen=True)
class Count:
    """Iterations of one method on one system."""

    material: str
    mesh: str
    method: str
    system: Optional[NewtonSystem]
    entry: Entry
    limit: Optional[int]  # the paper's count that it is held to
    shown: str = ""

    @property
    def papers(self) -> Optional[int]:
        return paper.iterations(self.method, self.material, self.mesh)

    @property
    def above(self) -> Optional[bool]:
        iterations = self.entry.iterations
        return None if iterations is None or self.limit is None else iterations > self.limit


def count_columns(key: System) -> List[Column[Count]]:
    """Columns of the CSV that come before a table's own."""
    return [
        Column(csv="step", value=lambda c: key[0]),
        Column(csv="newton_iteration", value=lambda c: key[1]),
        Column(csv="time", unit="ms", value=lambda c: c.system.time_ms if c.system else None),
        Column(csv="material", value=lambda c: c.material),
        Column(csv="mesh", value=lambda c: c.mesh),
        Column(csv="unknowns", value=lambda c: c.system.unknowns["total"] if c.system else None),
        Column(csv="method", value=lambda c: c.method),
        Column(csv="status", value=lambda c: c.entry.status),
        Column(csv="iterations", value=lambda c: c.entry.iterations),
        Column(csv="paper_iterations", value=lambda c: c.papers),
        Column(csv="limit_iterations", value=lambda c: c.limit),
        Column(csv="above_limit", value=lambda c: None if c.above is None else "yes" if c.above else "no"),
    ]


class Marks:
    """Counts with their mark, and the notes that a table of counts ends with."""

    def __init__(self, grid: Grid, key: System):
        self._grid, self._key = grid, key
        self._cells = self._above = 0
        self._failures: List[Tuple[str, str, str]] = []  # status, where, message

    def count(self, material: str, mesh: str, method: str, label: str) -> Count:
        entry = self._grid.entry(material, mesh, self._key, method)
        self.remember(material, mesh, label, entry)
        limit = paper.limit(method, material, mesh, at_rest=self._key == (1, 1))
        found = Count(material, mesh, method, self._grid.system(material, mesh, self._key), entry, limit)
        if found.above is not None:
            self._cells += 1
            self._above += found.above
        return replace(found, shown=entry.short + ("*" if found.above else ""))

    def remember(self, material: str, mesh: str, label: str, entry: Entry) -> None:
        if entry.status == "not converged":
            self._failures.append(("n.c.", f"{label}, {MATERIALS[material]} {MESHES[mesh]}", entry.message))
        elif entry.status == "failed":
            self._failures.append(("failed", f"{MATERIALS[material]} {MESHES[mesh]}", entry.message))

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


def order_note(grid: Grid, key: System) -> str:
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
