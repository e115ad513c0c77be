"""A tube of layers filled with fluid, as the closed forms see it. The layers are incompressible, with shear modulus mu
and, as in [Holzapfel2000], two families of fibres at +-alpha to the circumference that act in
extension only. For small strains about rest

    W = mu (e_r^2 + e_h^2 + e_z^2) + 4 k1 (cos^2 alpha e_h + sin^2 alpha e_z)^2        energy per volume, kPa

with the radial, hoop and axial strains e_r, e_h, e_z."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Optional, Sequence

import numpy as np

from fsi_compare.base.errors import InputError
from fsi_compare.base.files import read_toml
from .bessel import bessel_i

# The rabbit's carotid artery [Holzapfel2000]: inner radius, thickness of media and adventitia, mm.
INNER_RADIUS = 1.43
CASE = "give one of the paper's cases"
THICKNESS = {"media": 0.26, "adventitia": 0.13}


@dataclass(frozen=True)
class Layer:
    inner: float  # radius, mm
    outer: float
    shear: float  # mu = c10 + c01, kPa
    fibre: float = 0.0  # k1 times fibre_scale, kPa
    angle: float = 0.0  # between fibres and circumference, degrees

    @property
    def thickness(self) -> float:
        return self.outer - self.inner

    def stiffness(self, fibres: bool = True) -> np.ndarray:
        """Second derivatives of W by (e_h, e_z), kPa, with e_r = -e_h - e_z."""
        k1 = self.fibre if fibres else 0.0
        hoop, axial = math.cos(math.radians(self.angle)) ** 2, math.sin(math.radians(self.angle)) ** 2
        return self.shear * np.array([[4.0, 2.0], [2.0, 4.0]]) + 8 * k1 * np.outer((hoop, axial), (hoop, axial))

    def stretches_fibres(self, hoop: float, axial: float) -> bool:
        cos2 = math.cos(math.radians(self.angle)) ** 2
        return cos2 * hoop + (1 - cos2) * axial > 0


@dataclass(frozen=True)
class Tube:
    layers: Sequence[Layer]  # from the inside to the outside
    fluid_density: float  # mg/mm^3
    wall_density: float

    @property
    def radius(self) -> float:
        return self.layers[0].inner

    @property
    def thickness(self) -> float:
        return sum(layer.thickness for layer in self.layers)

    def added_mass_length(self, wave_number: float) -> float:
        """m in mm: the height of the column of fluid that moves with the wall in a wave of `wave_number` k in 1/mm; of
        the potential flow in the tube m = I0(kR) / (k I1(kR)), I0 and I1 modified Bessel functions."""
        x = wave_number * self.radius
        return bessel_i(0, x) / (wave_number * bessel_i(1, x))


def read_tube(case: Path, inner: float = INNER_RADIUS, fibre_scale: Optional[float] = None) -> Tube:
    """The tube of a case file with the artery's geometry. `fibre_scale` replaces the case's."""
    try:
        data = read_toml(case, CASE, CASE)
        layers, radius = [], inner
        for name, thickness in THICKNESS.items():
            entry = data["structure"]["layers"][name]
            scale = entry.get("fibre_scale", 1.0) if fibre_scale is None else fibre_scale
            layers.append(
                Layer(
                    radius,
                    radius + thickness,
                    entry["c10"] + entry.get("c01", 0.0),
                    scale * entry.get("k1", 0.0),
                    entry.get("alpha", 0.0),
                )
            )
            radius += thickness
        return Tube(layers, float(data["fluid"]["density"]), float(data["structure"]["density"]))
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(case, "", f"holds no fluid-filled tube of media and adventitia ({error})", CASE) from None
