"""Names that the user may give, each with what it is called in tables, and the refusal of all others."""

from typing import List, Sequence

from fsi_compare.base.errors import InputError
from fsi_compare.base.suggestions import nearest

MATERIALS = {"neo-hookean": "neo-Hookean", "mooney-rivlin": "Mooney-Rivlin", "artery": "artery"}

# The paper's block preconditioners of GMRES (its Table 4); each also with exact sub-solves.
BLOCK_PRECONDITIONERS = {"diagonal": "P_D", "lower": "P_L", "upper": "P_U", "ssor": "P_SSOR", "ilu": "P_ILU"}
EXACT = {name: f"{name}_exact" for name in BLOCK_PRECONDITIONERS}
# The paper's coupled multilevel methods (its Table 5).
MULTILEVEL = {
    "amg": "AMG",
    "amg_gmres": "AMG_GMRES",
    "amg_fgmres": "AMG_FGMRES",
    "amli": "AMLI",
    "amli_gmres": "AMLI_GMRES",
    "amli_fgmres": "AMLI_FGMRES",
}
METHODS = ("direct", "fast", "petsc", *BLOCK_PRECONDITIONERS, *EXACT.values(), *MULTILEVEL)


def pick(option: str, text: str, known: Sequence[str]) -> List[str]:
    """The names in a list separated by commas, in the order given. Raises InputError for another, naming the
    nearest."""
    names = [name.strip() for name in text.split(",")]
    for name in names:
        if name not in known:
            raise InputError(
                "", option, f"'{name}' is unknown", f"nearest: {nearest(name, known)}; names are {', '.join(known)}"
            )
        if names.count(name) > 1:
            raise InputError("", option, f"'{name}' is given twice", "give each name once")
    return names
