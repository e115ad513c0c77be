"""The paper's Tables 1 and 2 beside ours: parameters and meshes."""

from pathlib import Path
from typing import Dict, List, Mapping, Optional

from ...base import paper
from ...base.errors import InputError
from ...base.files import read_toml
from ...base.names import MATERIALS, MESHES
from ...linear.solver_tables import Grid
from ...reporting.layout import Table, fixed
from .runs import WAVES, PaperRuns, mesh_of

LAYERS = ("media", "adventitia")
UNITS = {"c10": "kPa", "c01": "kPa", "k1": "kPa", "k2": "", "alpha": "deg", "density": "mg/mm^3", "bulk_modulus": "kPa"}


def parameter_table(cases: Mapping[str, Path], printed_density: bool) -> Table:
    """`printed_density`: the study has runs with the wall's density as the paper prints it."""
    table = Table(
        stem="table1_parameters",
        title="Table 1: parameters of the walls, ours and the paper's",
        left=3,
        columns=[("", "material"), ("", "layer"), ("", "parameter"), ("", "ours"), ("", "paper")],
        csv_columns=["material", "layer", "parameter", "unit", "ours", "paper", "same"],
    )
    differing = set()
    for material in [name for name in MATERIALS if name in cases]:
        structure = _structure(cases[material])
        rows = [
            (layer, name, structure.get("layers", {}).get(layer, {}).get(name), values[i])
            for name, values in paper.parameters(material).items()
            for i, layer in enumerate(LAYERS)
        ]
        rows += [("both", name, structure.get(name), value) for name, value in paper.wall().items()]
        for i, (layer, name, ours, theirs) in enumerate(rows):
            same = ours is not None and abs(ours - theirs) <= 1e-12 * abs(theirs)
            if not same:
                differing.add(name)
            unit = f" {UNITS[name]}" if UNITS[name] else ""
            table.rows.append(
                [
                    MATERIALS[material] if i == 0 else "",
                    layer,
                    name.replace("_", " "),
                    fixed(ours, "g") + unit + ("" if same else " !"),
                    f"{theirs:g}{unit}",
                ]
            )
            table.csv_rows.append([material, layer, name, UNITS[name], ours, theirs, "yes" if same else "no"])
    table.notes.append(
        "!: differs from the paper: "
        + (", ".join(sorted(differing)) or "none")
        + ". The paper prints the wall's density as 1.2 kg/m^3, a thousandth of any tissue's; here it "
        "is 1.2 mg/mm^3 = 1200 kg/m^3" + (", and the printed value is tried above." if printed_density else ".")
    )
    return table


def _structure(case: Path) -> dict:
    remedy = "give one of the paper's cases"
    structure = read_toml(case, remedy, remedy).get("structure", {})
    if not isinstance(structure, dict):
        raise InputError(case, "structure", "is not a section", remedy)
    return structure


def mesh_counts(runs: PaperRuns, grid: Optional[Grid]) -> Dict[str, Dict[str, int]]:
    """Nodes, tetrahedra and unknowns of our meshes by level. Unknowns are those of the paper's coupled system where the
    linear solvers were run: mesh displacement, velocity and pressure of the fluid, displacement and
    pressure of the wall."""
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


def mesh_table(counts: Mapping[str, Mapping[str, int]]) -> Table:
    names = ("nodes", "tetrahedra", "unknowns")
    table = Table(
        stem="table2_meshes",
        title="Table 2: the meshes, ours and the paper's",
        columns=[("", "mesh"), *((name, who) for name in names for who in ("ours", "paper"))],
        csv_columns=["mesh", "quantity", "ours", "paper"],
        notes=["The paper's 6,959 unknowns of the coarse mesh do not fit its other rows."],
    )
    for mesh, ours in counts.items():
        theirs = paper.mesh_counts(mesh)
        cells: List[str] = [mesh]
        for name in names:
            cells += [fixed(ours.get(name), ",d"), fixed(theirs.get(name), ",d")]
            table.csv_rows.append([mesh, name, ours.get(name), theirs.get(name)])
        table.rows.append(cells)
    return table
