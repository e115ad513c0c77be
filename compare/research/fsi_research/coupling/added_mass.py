"""What theory says about partitioned schemes.

[Causin2005], carried over to a tube of radius R: the wave of wave number k = pi/L, the longest
that fits between clamped ends, loads the wall with the mass rho_f m per area (see Tube.added_mass_length). The wall is
a ring with mass rho_s h and stiffness a = sum E_i h_i / ((1 - nu^2) R^2) per area. All in mm, ms, mg, kPa."""

import math
from dataclasses import dataclass

from ..evidence.tube import Layer, Tube

ARTERY = Tube((Layer(1.43, 1.69, 3.0), Layer(1.69, 1.82, 0.3)), fluid_density=1.0, wall_density=1.2)


@dataclass(frozen=True)
class AddedMass:
    """Defaults: the paper's artery with neo-Hookean layers."""

    tube: Tube = ARTERY
    length: float = 18.0  # mm
    poisson: float = 0.5

    @property
    def column(self) -> float:
        """m in mm, of the wave as long as two tubes."""
        return self.tube.added_mass_length(math.pi / self.length)

    @property
    def hoop_stiffness(self) -> float:
        """a in kPa/mm; E = 2 (1 + nu) mu."""
        moduli = sum(2 * (1 + self.poisson) * layer.shear * layer.thickness for layer in self.tube.layers)
        return moduli / ((1 - self.poisson**2) * self.tube.radius**2)

    @property
    def whole_wall(self) -> float:
        """e: the inertia of a thick ring that moves as a whole, over rho_s h; incompressible, so that the
        outside moves less than the inside: (R/h) ln(1 + h/R)."""
        ratio = self.tube.thickness / self.tube.radius
        return math.log(1 + ratio) / ratio

    def explicit_limit(self, order: int) -> float:
        """Density ratio below which the drivers' `explicit` is unstable, with first guesses extrapolated by `order` (1
        or 2): rho_s h e = M rho_f m, M = 2 or 6. At the root -1 of the amplification, where steps alternate, Newmark's
        beta = gamma = 1 leaves the wall half as heavy as central differences (M = 1), and the second order's
        extrapolation overshoots three times as far. Derived in docs/coupling.md; for a wall that moves as a whole."""
        return {1: 2.0, 2: 6.0}[order] * self.critical_density_ratio() / self.whole_wall

    def mass_ratio(self) -> float:
        """rho_s h/(rho_f m). By semi-discrete theory loosely coupled Dirichlet-Neumann schemes are unstable below 1."""
        return self.tube.wall_density * self.tube.thickness / (self.tube.fluid_density * self.column)

    def critical_density_ratio(self) -> float:
        """rho_s/rho_f at which `mass_ratio` is 1."""
        return self.column / self.tube.thickness

    def gain(self, step: float) -> float:
        """|G|: how many times larger than the displacement put in the wall's answer comes out, in a time step of `step`
        ms with backward Euler in the fluid and Newmark's beta = 1 in the wall."""
        wall = self.tube.wall_density * self.tube.thickness + self.hoop_stiffness * step**2
        return self.tube.fluid_density * self.column / wall

    def largest_factor(self, step: float) -> float:
        """Constant relaxation d + omega (d~ - d) contracts every wave for omega < 2/(1 + |G|)."""
        return 2 / (1 + self.gain(step))
