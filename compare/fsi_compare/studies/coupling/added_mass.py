"""Added mass of the blood on a tube's wall: what linear theory says about partitioned schemes.

Causin, Gerbeau and Nobile (2005), carried over to a tube: of the potential flow in a tube of radius R, the wave of wave number
k = pi/L (the longest that fits between clamped ends) loads the wall with the mass rho_f m per area, m = I0(kR)/(k I1(kR)) in
mm, I0 and I1 modified Bessel functions. The wall is a ring with mass rho_s h and stiffness a = sum E_i h_i / ((1 - nu^2) R^2)
per area. All in mm, ms, mg, kPa."""

import math
from dataclasses import dataclass
from typing import Sequence, Tuple

from ..evidence.bessel import bessel_i


@dataclass(frozen=True)
class Tube:
    """Defaults: the paper's artery with neo-Hookean layers."""

    radius: float = 1.43  # mm
    length: float = 18.0  # mm
    layers: Sequence[Tuple[float, float]] = ((0.26, 3.0), (0.13, 0.3))  # thickness in mm, shear modulus in kPa
    fluid_density: float = 1.0  # mg/mm^3
    wall_density: float = 1.2  # mg/mm^3
    poisson: float = 0.5

    @property
    def thickness(self) -> float:
        return sum(h for h, _ in self.layers)

    @property
    def added_mass_length(self) -> float:
        """m in mm: the height of the column of fluid that moves with the wall."""
        k = math.pi / self.length
        return bessel_i(0, k * self.radius) / (k * bessel_i(1, k * self.radius))

    @property
    def hoop_stiffness(self) -> float:
        """a in kPa/mm; E = 2 (1 + nu) mu."""
        return sum(2 * (1 + self.poisson) * mu * h for h, mu in self.layers) / ((1 - self.poisson ** 2) * self.radius ** 2)

    @property
    def whole_wall(self) -> float:
        """e: the mass with which a thick ring answers that moves as a whole, over rho_s h; incompressible, so that the
        outside moves less than the inside: (R/h) ln(1 + h/R)."""
        return self.radius / self.thickness * math.log(1 + self.thickness / self.radius)

    def explicit_limit(self, order: int) -> float:
        """Density ratio below which the drivers' `explicit` is unstable, with first guesses extrapolated by `order` (1 or
        2): rho_s h e = M rho_f m, M = 2 or 6. At the root -1 of the amplification, where steps alternate, Newmark's beta =
        gamma = 1 leaves the wall half as heavy as central differences (M = 1), and the second order's extrapolation
        overshoots three times as far. Derived in docs/coupling.md; for a wall that moves as a whole."""
        return {1: 2.0, 2: 6.0}[order] * self.critical_density_ratio() / self.whole_wall

    def mass_ratio(self) -> float:
        """rho_s h/(rho_f m). In the semi-discrete theory a loosely coupled Dirichlet-Neumann scheme is unstable below 1."""
        return self.wall_density * self.thickness / (self.fluid_density * self.added_mass_length)

    def critical_density_ratio(self) -> float:
        """rho_s/rho_f at which `mass_ratio` is 1."""
        return self.added_mass_length / self.thickness

    def gain(self, step: float) -> float:
        """|G|: how many times larger than the displacement put in the wall's answer comes out, in a time step of `step` ms
        with backward Euler in the fluid and Newmark's beta = 1 in the wall."""
        return self.fluid_density * self.added_mass_length / (self.wall_density * self.thickness + self.hoop_stiffness * step ** 2)

    def largest_factor(self, step: float) -> float:
        """Constant relaxation d + omega (d~ - d) contracts every wave for omega < 2/(1 + |G|)."""
        return 2 / (1 + self.gain(step))
