"""Speed of a pressure wave in a layered elastic tube filled with an inviscid incompressible fluid, from the constants
of fluid and wall. Small strains about rest; the layers are incompressible, with shear modulus mu and, as in Holzapfel,
Gasser and Ogden (2000), two families of fibres at +-alpha to the circumference that act in extension only:

    W = mu (e_r^2 + e_h^2 + e_z^2) + 4 k1 (cos^2 alpha e_h + sin^2 alpha e_z)^2        energy per volume, kPa

with the radial, hoop and axial strains e_r, e_h, e_z. Units: mm, ms, mg, kPa; so speeds are in mm/ms."""

import math
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Optional, Sequence, Tuple

import numpy as np

from ...errors import InputError
from .bessel import bessel_i

# The rabbit's carotid artery (Holzapfel 2000): inner radius, thickness of media and adventitia, mm.
INNER_RADIUS = 1.43
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


def read_tube(case: Path, inner: float = INNER_RADIUS, fibre_scale: Optional[float] = None) -> Tube:
    """The tube of a case file with the artery's geometry. `fibre_scale` replaces the case's."""
    try:
        data = tomllib.loads(case.read_text(encoding="utf-8"))
        layers, radius = [], inner
        for name, thickness in THICKNESS.items():
            entry = data["structure"]["layers"][name]
            scale = entry.get("fibre_scale", 1.0) if fibre_scale is None else fibre_scale
            layers.append(Layer(radius, radius + thickness, entry["c10"] + entry.get("c01", 0.0),
                                scale * entry.get("k1", 0.0), entry.get("alpha", 0.0)))
            radius += thickness
        return Tube(layers, float(data["fluid"]["density"]), float(data["structure"]["density"]))
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(case, "", f"holds no fluid-filled tube of media and adventitia ({error})",
                         "give one of the paper's cases") from None


def moens_korteweg(tube: Tube, restrained: bool = False) -> float:
    """c^2 = E h / (2 rho R) of a thin wall, R the inner radius (Moens 1878, Korteweg 1878). E is the hoop modulus of a
    wall free to shorten; `restrained`: of one held at its length, E / (1 - nu^2) = 4 E / 3 without fibres."""
    hoop, coupling, axial = _sums(tube, [True] * len(tube.layers))
    stiffness = hoop
    if not restrained:
        active = [True] * len(tube.layers)
        for _ in range(len(tube.layers) + 1):  # fibres that the shortening slackens do not act
            hoop, coupling, axial = _sums(tube, active)
            strain = -coupling / axial
            found = [layer.stretches_fibres(1.0, strain) for layer in tube.layers]
            if found == active:
                break
            active = found
        stiffness = hoop - coupling ** 2 / axial
    return math.sqrt(stiffness / (2 * tube.fluid_density * tube.radius))


def _sums(tube: Tube, active: Sequence[bool]) -> Tuple[float, float, float]:
    total = sum(layer.thickness * layer.stiffness(on) for layer, on in zip(tube.layers, active))
    return float(total[0, 0]), float(total[0, 1]), float(total[1, 1])


def wall_stiffness(tube: Tube) -> float:
    """dp/du in kPa/mm: inner pressure over radial displacement of the inner face, of the thick wall at its length.
    There e_h = -e_r = u R / r^2, so that p = u R sum over layers H/2 (1/A^2 - 1/B^2), H = 4 mu + 8 k1 cos^4 alpha, A
    and B the layer's radii. For small u the derivative of the closed-form inflation pressure."""
    return tube.radius * sum(0.5 * float(layer.stiffness()[0, 0]) * (layer.inner ** -2 - layer.outer ** -2)
                             for layer in tube.layers)


def long_wave(tube: Tube) -> float:
    """c^2 = A/rho dp/dA = R/(2 rho) dp/du: the limit of long waves in the thick wall at its length."""
    return math.sqrt(tube.radius / (2 * tube.fluid_density) * wall_stiffness(tube))


def phase_speed(tube: Tube, wave_number: float) -> float:
    """Dispersion at `wave_number` k in 1/mm: (rho m + rho_s h) c^2 k^2 = dp/du with the fluid's added mass per area
    rho m, m = I0(kR) / (k I1(kR)), and the wall's mass rho_s h."""
    x = wave_number * tube.radius
    added = bessel_i(0, x) / (wave_number * bessel_i(1, x))
    mass = tube.fluid_density * added + tube.wall_density * tube.thickness
    return math.sqrt(wall_stiffness(tube) / mass) / wave_number
