"""The paper's numbers, as they stand in `paper.json`."""

import json
from functools import lru_cache
from pathlib import Path
from typing import Dict, List, Optional

from fsi_compare.study.mesh_levels import MESHES


@lru_cache(maxsize=None)
def _numbers() -> dict:
    return json.loads((Path(__file__).parent / "paper.json").read_text(encoding="utf-8"))


def source() -> str:
    return _numbers()["source"]


def tolerance() -> float:
    """Relative residual to which the iterations were counted."""
    return _numbers()["tolerance"]


def newton_increments(material: str, mesh: str) -> List[float]:
    """Norms of the increments in the first time step (Table 3); empty for a case that the paper does not have."""
    return _numbers()["newton_increments"].get(material, {}).get(mesh, [])


def iterations(method: str, material: str, mesh: str) -> Optional[int]:
    """Iterations to a relative residual of 1e-9 at the first Newton system (Tables 4 and 5); None where there are
    none."""
    counts = _numbers()["iterations"].get(method, {}).get(material)
    return counts[list(MESHES).index(mesh)] if counts and mesh in MESHES else None


def limit(method: str, material: str, mesh: str, at_rest: bool) -> Optional[int]:
    """The count that ours must not exceed. At rest the fibres do nothing and the artery is a neo-Hookean wall, so that
    it is held to that column."""
    return iterations(method, "neo-hookean" if at_rest and material == "artery" else material, mesh)


def parameters(material: str) -> Dict[str, List[float]]:
    """Constants of media and adventitia by the case file's names (Table 1)."""
    return _numbers()["parameters"].get(material, {})


def wall() -> Dict[str, float]:
    """Density as printed, 1.2 kg/m^3, in mg/mm^3, and bulk modulus in kPa."""
    return _numbers()["wall"]


def mesh_counts(mesh: str) -> Dict[str, int]:
    """Nodes, tetrahedra and unknowns (Table 2)."""
    return _numbers()["meshes"].get(mesh, {})


def cost() -> dict:
    """What the cost statement of section 5.6 counts, per time step or as its name says."""
    return _numbers()["cost"]


def unknowns(mesh: str) -> Optional[int]:
    found = _numbers()["meshes"].get(mesh)
    return found["unknowns"] if found else None
