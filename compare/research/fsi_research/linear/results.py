"""`linear_solvers.json`: what fsi-linear-study found when it solved single Newton systems by several methods."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Dict, List, NoReturn, Optional, Tuple, Union

from fsi_compare.base.errors import InputError
from fsi_compare.base.files import read_json
from .programs import NAME

FILE = "linear_solvers.json"
System = Tuple[int, int]  # time step, Newton iteration; both from 1
# A residual that is met to the last digit may be printed a rounding above the tolerance.
RESIDUAL_SLACK = 1 + 1e-6
MEASURED = ("set_up_seconds", "solve_seconds", "work_units", "operator_complexity", "memory_MiB", "difference")


@dataclass(frozen=True)
class Solve:
    """One method on one system. What a method does not have, or did not reach, is None."""

    name: str
    converged: bool
    message: str  # why not
    iterations: Optional[int]
    relative_residual: Optional[float]  # true, of the unpreconditioned system
    set_up_seconds: Optional[float]
    solve_seconds: Optional[float]
    work_units: Optional[float]  # solve seconds / seconds of one product with the coupled matrix
    cycles: Dict[str, int]  # of the sub-problems mesh, flow and wall
    operator_complexity: Optional[float]
    levels: Optional[int]
    memory_MiB: Optional[float]
    difference: Optional[float]  # relative L2 difference to the solution by `direct`

    @property
    def total_seconds(self) -> Optional[float]:
        if self.set_up_seconds is None or self.solve_seconds is None:
            return None
        return self.set_up_seconds + self.solve_seconds


@dataclass(frozen=True)
class NewtonSystem:
    step: int
    newton_iteration: int
    time_ms: float
    unknowns: Dict[str, int]  # mesh, flow, wall, total
    product_seconds: float
    solves: Dict[str, Solve]

    @property
    def key(self) -> System:
        return self.step, self.newton_iteration


@dataclass(frozen=True)
class NewtonStep:
    step: int
    time_ms: float
    increments: List[float]
    residuals: List[float]


@dataclass(frozen=True)
class SubProblem:
    """A sub-problem's AMG alone."""

    problem: str  # mesh, fluid, wall
    coarsening: str
    smoother: str
    cycle: str
    levels: int
    factor: Optional[float]  # mean contraction of the residual per cycle
    iterations: Optional[int]
    operator_complexity: Optional[float]


@dataclass(frozen=True)
class LinearSolvers:
    version: str
    title: str
    case_hash: str
    threads: int
    mesh: dict
    tolerance: float
    newton: List[NewtonStep]
    systems: Dict[System, NewtonSystem]
    sub_problems: List[SubProblem]


def read_linear_solvers(path: Path) -> LinearSolvers:
    """Raises InputError naming file and key unless the file is complete."""
    data = read_json(path, "", "")
    top = _Object(path, "", data)
    if top.text("program") != NAME:
        raise InputError(path, "program", f"'{top.text('program')}' is not {NAME}")
    tolerance = top.number("tolerance")
    systems = [_system(entry, tolerance) for entry in top.objects("systems")]
    return LinearSolvers(
        version=top.text("version"),
        title=top.text("title"),
        case_hash=top.text("case_hash"),
        threads=top.count("threads"),
        mesh=_mesh(top.object("mesh")),
        tolerance=tolerance,
        newton=[
            NewtonStep(
                entry.count("step"), entry.number("time_ms"), entry.numbers("increments"), entry.numbers("residuals")
            )
            for entry in top.objects("newton")
        ],
        systems={system.key: system for system in systems},
        sub_problems=[_sub_problem(entry) for entry in top.objects("sub_problems")]
        if "sub_problems" in top.values
        else [],
    )


class _Object:
    """A JSON object that says which key is wrong."""

    def __init__(self, path: Path, key: str, values: Any) -> None:
        self.path, self.key, self.values = path, key, values
        if not isinstance(values, dict):
            raise InputError(path, key, "is not a JSON object")

    def refuse(self, key: str, problem: str) -> NoReturn:
        raise InputError(self.path, f"{self.key}.{key}".lstrip("."), problem)

    def _value(self, key: str, kinds: Union[type, Tuple[type, ...]], expected: str) -> Any:
        if key not in self.values:
            self.refuse(key, "is missing")
        value = self.values[key]
        if not isinstance(value, kinds) or (isinstance(value, bool) and kinds is not bool):
            self.refuse(key, f"is not {expected}")
        return value

    def text(self, key: str) -> str:
        return self._value(key, str, "a text")

    def flag(self, key: str) -> bool:
        return self._value(key, bool, "true or false")

    def count(self, key: str) -> int:
        value = self._value(key, int, "a whole number")
        if not 0 <= value < 1 << 53:
            self.refuse(key, "is negative" if value < 0 else "is too large")
        return value

    def number(self, key: str) -> float:
        try:
            value = float(self._value(key, (int, float), "a number"))
        except OverflowError:
            self.refuse(key, "is too large")
        if not math.isfinite(value):
            self.refuse(key, f"is {value}")
        return value

    def optional(self, key: str, read: Optional[Callable[[str], Any]] = None) -> Any:
        """None where the entry is absent, null or not finite."""
        value = self.values.get(key)
        if value is None or (isinstance(value, float) and not math.isfinite(value)):
            return None
        return (read or self.number)(key)

    def numbers(self, key: str) -> List[float]:
        values = self._value(key, list, "a list")
        for value in values:
            if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) < 1e300:
                self.refuse(key, "is not a list of numbers")
        return [float(value) for value in values]

    def object(self, key: str) -> "_Object":
        return _Object(self.path, f"{self.key}.{key}".lstrip("."), self._value(key, dict, "a JSON object"))

    def objects(self, key: str) -> List["_Object"]:
        return [
            _Object(self.path, f"{self.key}.{key}[{i}]".lstrip("."), entry)
            for i, entry in enumerate(self._value(key, list, "a list"))
        ]


def _mesh(entry: _Object) -> dict:
    if "nodes" in entry.values:
        entry.count("nodes")
    return entry.values


def _system(entry: _Object, tolerance: float) -> NewtonSystem:
    unknowns = entry.object("unknowns")
    solves = [_solve(solver, tolerance) for solver in entry.objects("solvers")]
    return NewtonSystem(
        step=entry.count("step"),
        newton_iteration=entry.count("newton_iteration"),
        time_ms=entry.number("time_ms"),
        unknowns={name: unknowns.count(name) for name in ("mesh", "flow", "wall", "total")},
        product_seconds=entry.number("product_seconds"),
        solves={solve.name: solve for solve in solves},
    )


def _solve(entry: _Object, tolerance: float) -> Solve:
    """A method has converged when it says so and its true residual shows it."""
    converged = entry.flag("converged")
    residual = entry.optional("relative_residual")
    message = " ".join(entry.optional("message", entry.text).split()) if entry.values.get("message") else ""
    if converged:
        entry.count("iterations"), entry.number("solve_seconds")
        if residual is None or residual > tolerance * RESIDUAL_SLACK:
            converged = False
            shown = "not finite" if residual is None else f"{residual:.1e}, above {tolerance:g}"
            message = f"true residual is {shown}" + (f"; {message}" if message else "")
    cycles = entry.object("cycles") if entry.values.get("cycles") else None
    return Solve(
        name=entry.text("name"),
        converged=converged,
        message=message or ("" if converged else "no reason given"),
        relative_residual=residual,
        cycles={name: cycles.count(name) for name in cycles.values} if cycles else {},
        **{name: entry.optional(name, entry.count) for name in ("iterations", "levels")},
        **{name: entry.optional(name) for name in MEASURED},
    )


def _sub_problem(entry: _Object) -> SubProblem:
    return SubProblem(
        **{name: entry.text(name) for name in ("problem", "coarsening", "smoother", "cycle")},
        levels=entry.count("levels"),
        factor=entry.optional("factor"),
        iterations=entry.optional("iterations", entry.count),
        operator_complexity=entry.optional("operator_complexity"),
    )
