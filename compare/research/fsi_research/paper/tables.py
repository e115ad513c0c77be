"""The paper's Tables 1 and 2 beside ours: parameters and meshes."""

from pathlib import Path
from typing import Dict, List, Mapping, NamedTuple, Optional, Sequence

from ..catalogue import paper
from fsi_compare.base.errors import InputError
from fsi_compare.base.files import read_toml
from ..catalogue.names import MATERIALS
from fsi_compare.study.mesh_levels import MESHES
from ..linear.grid import Grid
from fsi_compare.reporting.column import Column, Facts, fixed
from fsi_compare.reporting.layout import Table
from .runs import WAVES, PaperRuns, mesh_of

QUANTITIES = ("nodes", "tetrahedra", "unknowns")  # of a mesh
LAYERS = ("media", "adventitia")
UNITS = {"c10": "kPa", "c01": "kPa", "k1": "kPa", "k2": "", "alpha": "deg", "density": "mg/mm^3", "bulk_modulus": "kPa"}


class Parameter(NamedTuple):
    """A constant of a wall, ours and the paper's."""

    material: str
    first: bool  # of its material
    layer: str
    name: str
    ours: Optional[float]
    theirs: float

    @property
    def same(self) -> bool:
        return self.ours is not None and abs(self.ours - self.theirs) <= 1e-12 * abs(self.theirs)

    @property
    def unit(self) -> str:
        return UNITS[self.name]

    def shown(self, value: Optional[float]) -> str:
        return fixed(value, "g") + (f" {self.unit}" if self.unit else "")


PARAMETERS: Sequence[Column[Parameter]] = (
    Column("material", "material", lambda p: p.material, text=lambda p: p.first * MATERIALS[p.material], left=True),
    Column("layer", "layer", lambda p: p.layer, left=True),
    Column("parameter", "parameter", lambda p: p.name, lambda name: name.replace("_", " "), left=True),
    Column(csv="unit", value=lambda p: p.unit),
    Column("ours", "ours", lambda p: p.ours, text=lambda p: p.shown(p.ours) + ("" if p.same else " !")),
    Column("paper", "paper", lambda p: p.theirs, text=lambda p: p.shown(p.theirs)),
    Column(csv="same", value=lambda p: "yes" if p.same else "no"),
)


def parameter_table(cases: Mapping[str, Path], printed_density: bool) -> Table:
    """`printed_density`: the study has runs with the wall's density as the paper prints it."""
    found = [p for material in MATERIALS if material in cases for p in _parameters(material, cases[material])]
    differing = {p.name for p in found if not p.same}
    return Table(
        "table1_parameters",
        "Table 1: parameters of the walls, ours and the paper's",
        PARAMETERS,
        found,
        notes=[
            "!: differs from the paper: "
            + (", ".join(sorted(differing)) or "none")
            + ". The paper prints the wall's density as 1.2 kg/m^3, a thousandth of any tissue's; here it "
            "is 1.2 mg/mm^3 = 1200 kg/m^3" + (", and the printed value is tried above." if printed_density else ".")
        ],
    )


def _parameters(material: str, case: Path) -> List[Parameter]:
    structure = _structure(case)
    rows = [
        (layer, name, structure.get("layers", {}).get(layer, {}).get(name), values[i])
        for name, values in paper.parameters(material).items()
        for i, layer in enumerate(LAYERS)
    ]
    rows += [("both", name, structure.get(name), value) for name, value in paper.wall().items()]
    return [Parameter(material, i == 0, *row) for i, row in enumerate(rows)]


def _structure(case: Path) -> dict:
    remedy = "give one of the paper's cases"
    structure = read_toml(case, remedy, remedy).get("structure", {})
    if not isinstance(structure, dict):
        raise InputError(case, "structure", "is not a section", remedy)
    return structure


def mesh_counts(runs: PaperRuns, grid: Optional[Grid]) -> Dict[str, Dict[str, int]]:
    """Nodes, tetrahedra and unknowns of our meshes by level. Unknowns are those of the paper's coupled system where the
    linear solvers were run: mesh displacement, velocity and pressure of the fluid, displacement and pressure of the
    wall."""
    found: Dict[str, Dict[str, int]] = {}
    for run in runs.all(WAVES):
        mesh = run.summary.get("mesh", {})
        if mesh_of(run) in MESHES and "nodes" in mesh:
            found[mesh_of(run)] = {name: mesh[name] for name in ("nodes", "tetrahedra") if name in mesh}
    if grid is None:
        return {mesh: found[mesh] for mesh in MESHES if mesh in found}
    for mesh in grid.meshes:
        for material in grid.materials:
            outcome = grid.outcome(material, mesh)
            if outcome and outcome.results:
                counts = outcome.results.mesh
                found[mesh] = {name: counts[name] for name in ("nodes", "tetrahedra") if name in counts}
                system = next(iter(outcome.results.systems.values()), None)
                if system:
                    found[mesh]["unknowns"] = system.unknowns["total"]
    return {mesh: found[mesh] for mesh in MESHES if mesh in found}


class Counted(NamedTuple):
    """A quantity of a mesh, ours and the paper's."""

    mesh: str
    quantity: str
    ours: Optional[int]
    theirs: Optional[int]


COUNTED: Sequence[Column[Counted]] = (
    Column(csv="mesh", value=lambda c: c.mesh),
    Column(csv="quantity", value=lambda c: c.quantity),
    Column(csv="ours", value=lambda c: c.ours),
    Column(csv="paper", value=lambda c: c.theirs),
)


def _of_quantity(place: int, name: str) -> List[Column[Sequence[Counted]]]:
    return [
        Column("ours", value=lambda row: row[place].ours, format=",d", group=name),
        Column("paper", value=lambda row: row[place].theirs, format=",d", group=name),
    ]


MESH_ROWS: Sequence[Column[Sequence[Counted]]] = (
    Column("mesh", value=lambda row: row[0].mesh, left=True),
    *(column for place, name in enumerate(QUANTITIES) for column in _of_quantity(place, name)),
)


def mesh_table(counts: Mapping[str, Mapping[str, int]]) -> Table:
    rows = [
        [Counted(mesh, name, ours.get(name), paper.mesh_counts(mesh).get(name)) for name in QUANTITIES]
        for mesh, ours in counts.items()
    ]
    return Table(
        "table2_meshes",
        "Table 2: the meshes, ours and the paper's",
        MESH_ROWS,
        rows,
        Facts(COUNTED, [counted for row in rows for counted in row]),
        ["The paper's 6,959 unknowns of the coarse mesh do not fit its other rows."],
    )
