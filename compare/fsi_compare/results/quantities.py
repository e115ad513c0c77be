"""What of a field is shown as one number for each node: magnitudes and components of vectors, stresses of tensors."""

from dataclasses import dataclass
from typing import Callable

import numpy as np

from .fields import MediumFields

WORDS = {"rrt": "relative residence time", "osi": "oscillatory shear index", "tawss": "time-averaged wall shear stress"}
WORDS |= {"von_mises_stress": "von Mises stress", "thickness": "thickness of the wall at rest"}
WORDS |= {"fibre_stress_1": "stress of the first fibres", "fibre_stress_2": "stress of the second fibres"}


@dataclass(frozen=True)
class Quantity:
    """A number for each node, of one field."""

    key: str  # of the field, or field:part
    field: str
    words: str
    unit: str
    signed: bool  # negative values mean something else than small ones
    of: Callable[[np.ndarray], np.ndarray]

    @property
    def shown_unit(self) -> str:
        """The unit as people read it: that of a plain number is empty."""
        return "" if self.unit == "1" else self.unit


def _magnitude(values: np.ndarray) -> np.ndarray:
    return np.sqrt(np.einsum("ij,ij->i", values, values))


def _von_mises(values: np.ndarray) -> np.ndarray:
    xx, xy, xz, yy, yz, zz = values.T
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy**2 + xz**2 + yz**2))


def quantities_of(medium: MediumFields) -> list[Quantity]:
    """Quantities of all fields of a medium, in the order of their names."""
    return [quantity for field in medium.names for quantity in quantities_of_field(medium, field)]


def quantities_of_field(medium: MediumFields, field: str) -> list[Quantity]:
    words, unit = WORDS.get(field, field.replace("_", " ")), medium.units[field]
    width = medium.width(field)
    if width == 1:
        signed = field.endswith("pressure") or field.startswith("fibre")
        return [Quantity(field, field, words, unit, signed, lambda values: values)]
    if width == 6:
        made = Quantity(field, field, f"von Mises stress of the {words}", unit, False, _von_mises)
        return [made] if "von_mises_stress" not in medium.names else []

    def component(i: int, part: str, words: str) -> Quantity:
        return Quantity(f"{field}:{part}", field, words, unit, True, lambda values: values[:, i])

    if field == "principal_stress":
        names = ("largest", "middle", "least")
        return [component(i, str(i + 1), f"{name} principal stress") for i, name in enumerate(names)]
    whole = Quantity(field, field, words, unit, False, _magnitude)
    return [whole, *(component(i, c, f"{words}, {c}") for i, c in enumerate("xyz"))]
