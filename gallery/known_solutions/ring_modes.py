"""Small oscillations of an elastic ring in a viscous liquid between it and a rigid circle around both, in plane strain:
what goes with cos(n theta) e^(s t). The waves of liquid and ring are sums of powers and of Bessel functions of r
(docs/theory.md, section 13.5). Lengths, times and stiffnesses in any units that go together."""

from dataclasses import dataclass
from math import factorial

import numpy as np

from .dispersion import root

SMALL = 4.0  # arguments below are taken by series, others by integrals
TERMS = 40  # of the series


def bessel_series(n: int, z: complex) -> tuple[complex, complex]:
    """I_n and K_n of a small argument."""
    half = z / 2

    def terms(weights: np.ndarray) -> complex:
        values = [weights[k] * half ** (2 * k + n) / (factorial(k) * factorial(k + n)) for k in range(TERMS)]
        return complex(sum(values))

    digamma = np.concatenate([[0.0], np.cumsum(1 / np.arange(1, TERMS + n + 1))]) - np.euler_gamma
    first = terms(np.ones(TERMS))
    finite = sum((-1) ** k * factorial(n - k - 1) / factorial(k) * half ** (2 * k - n) for k in range(n)) / 2
    rest = terms(digamma[:TERMS] + digamma[n : n + TERMS]) / 2 - np.log(half) * first
    return first, complex(finite + (-1) ** n * rest)


def bessel_integrals(n: int, z: complex) -> tuple[complex, complex]:
    """e^-z I_n and e^z K_n where the real part of z is positive, by the trapezoidal rule, which converges exponentially
    here: I_n = 1/pi int e^(z cos t) cos(n t) over 0 to pi, K_n = int e^(-z cosh t) cosh(n t) over 0 to infinity."""
    t = np.linspace(0, np.pi, 200 + 4 * int(abs(z)))
    values = np.exp(z * (np.cos(t) - 1)) * np.cos(n * t)
    first = (values.sum() - (values[0] + values[-1]) / 2) / (len(t) - 1)
    t = np.arange(0, np.arccosh(1 + 60 / z.real), 0.2 / (4 + abs(z) ** 0.5))
    values = np.exp(-z * (np.cosh(t) - 1)) * np.cosh(n * t)
    return complex(first), complex(t[1] * (values.sum() - values[0] / 2))


def bessel(n: int, z: complex, growth: complex = 0.0, fall: complex = 0.0) -> tuple[complex, complex, complex, complex]:
    """I_n(z) and its derivative, times e^-growth; K_n(z) and its derivative, times e^fall."""
    if abs(z) < SMALL:
        (i, k), (i1, k1) = bessel_series(n, z), bessel_series(n + 1, z)
        up, down = np.exp(-growth), np.exp(fall)
    else:
        (i, k), (i1, k1) = bessel_integrals(n, z), bessel_integrals(n + 1, z)
        up, down = np.exp(z - growth), np.exp(fall - z)
    return up * i, up * (i1 + n / z * i), down * k, down * (n / z * k - k1)


@dataclass(frozen=True)
class Ring:
    """An elastic ring between radii `inner` and `outer`, its inner face free; liquid from there to `rigid`.
    `viscosity` 0: it slips."""

    inner: float
    outer: float
    rigid: float
    young: float
    poisson: float
    density: float  # of the ring
    liquid: float  # density; 0: none
    viscosity: float

    @property
    def shear(self) -> float:
        return self.young / (2 * (1 + self.poisson))

    @property
    def lame(self) -> float:
        """Lame's first constant, as plane strain needs it."""
        return self.young * self.poisson / ((1 + self.poisson) * (1 - 2 * self.poisson))

    def mode(self, n: int, guess: complex) -> complex:
        """s of a mode, near `guess`."""
        return root(lambda s: self.lacking(n, s), 1.02 * guess, guess)

    def lacking(self, n: int, s: complex) -> complex:
        """Zero where ring and liquid swing together with e^(s t): determinant of what they demand of each other."""
        inner, outer = self.wall_waves(n, s, self.inner), self.wall_waves(n, s, self.outer)
        if self.liquid == 0:
            system = np.concatenate([inner[2:], outer[2:]])
        elif self.viscosity == 0:
            system = np.zeros((6, 6), dtype=complex)
            there, far = self.liquid_waves(n, s, self.outer), self.liquid_waves(n, s, self.rigid)
            system[:2, :4], system[2, :4] = inner[2:], outer[3]
            system[3, :4], system[4, :4] = -s * outer[0], -outer[2]
            system[3, 4:], system[4, 4:], system[5, 4:] = there[0], there[2], far[0]
        else:
            system = np.zeros((8, 8), dtype=complex)
            there, far = self.liquid_waves(n, s, self.outer), self.liquid_waves(n, s, self.rigid)
            system[:2, :4] = inner[2:]
            system[2:4, :4], system[4:6, :4] = -s * outer[:2], -outer[2:]
            system[2:6, 4:], system[6:, 4:] = there, far[:2]
        system = system / np.abs(system).max(axis=0)
        return complex(np.linalg.det(system / np.abs(system).max(axis=1, keepdims=True)))

    def wall_waves(self, n: int, s: complex, r: float) -> np.ndarray:
        """Rows (d_r, d_theta, sigma_rr, sigma_rtheta) of d = grad f + curl(g e_z) with f cos(n theta) of I_n and K_n,
        then g sin(n theta) of I_n and K_n."""
        mu, lam = self.shear, self.lame
        columns = []
        for potential, stiffness in ((True, lam + 2 * mu), (False, mu)):
            a = s * np.sqrt(self.density / stiffness)
            i, slope_i, k, slope_k = bessel(n, a * r)
            for f, slope in ((i, a * slope_i), (k, a * slope_k)):
                columns.append(
                    potential_wave(n, r, f, slope, a * a, mu, lam * a * a * f)
                    if potential
                    else shear_wave(n, r, f, slope, a * a, mu)
                )
        return np.array(columns).T

    def liquid_waves(self, n: int, s: complex, r: float) -> np.ndarray:
        """Rows of wall_waves() for velocities and stresses of the liquid: of r^n and r^-n, whose pressure is
        -density s f, then g of I_n and K_n. Without viscosity the first two alone. Each wave is about one where it is
        largest."""
        rho, mu = self.liquid, self.viscosity
        near, far = (r / self.rigid) ** n, (self.outer / r) ** n
        columns = [
            potential_wave(n, r, f, slope, 0.0, mu, rho * s * f)
            for f, slope in ((near, n * near / r), (far, -n * far / r))
        ]
        if mu > 0:
            kappa = np.sqrt(rho * s / mu)
            i, slope_i, k, slope_k = bessel(n, kappa * r, kappa * self.rigid, kappa * self.outer)
            for g, slope in ((i, kappa * slope_i), (k, kappa * slope_k)):
                columns.append(shear_wave(n, r, g, slope, kappa**2, mu))
        return np.array(columns).T


Wave = tuple[complex, complex, complex, complex]


def potential_wave(
    n: int, r: float, f: complex, slope: complex, square: complex, mu: float, spherical: complex
) -> Wave:
    """Rows of grad f, f'' + f'/r - n^2 f/r^2 = `square` f. `spherical`: what sigma_rr has beside 2 mu eps_rr."""
    second = (square + n * n / r**2) * f - slope / r
    return slope, -n * f / r, spherical + 2 * mu * second, 2 * mu * n * (f / r - slope) / r


def shear_wave(n: int, r: float, g: complex, slope: complex, square: complex, mu: float) -> Wave:
    """The four rows of curl(g e_z)."""
    second = (square + n * n / r**2) * g - slope / r
    return n * g / r, -slope, 2 * mu * n * (slope - g / r) / r, mu * (slope / r - second - n * n * g / r**2)
