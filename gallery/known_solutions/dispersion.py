"""What scenes share in which a wave runs along a tube: its exact wave number, and that of a computed pressure.

Small waves e^(i (w t - k z)) in a liquid and a thick wall around it are sums of Bessel functions of r (docs/theory.md,
section 13.4). Lengths, times and stiffnesses in any units that go together."""

from dataclasses import dataclass
from typing import Callable, Sequence

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.gallery.scene import Number, SceneRun

SERIES = 80  # terms: enough for arguments of moderate size


def modified_bessel(z: complex) -> tuple[complex, complex, complex, complex]:
    """I_0, I_1, K_0 and K_1 of a complex number of moderate size, by their series."""
    quarter, logarithm, harmonic = z * z / 4, np.log(z / 2) + np.euler_gamma, 0.0
    term = 1.0 + 0j  # of I_0; that of I_1 is term z / (2 (k + 1))
    i0, i1, k0, k1 = 0j, 0j, 0j, 1 / z
    for k in range(SERIES):
        first = term * z / (2 * (k + 1))
        i0 += term
        i1 += first
        k0 += term * (harmonic - logarithm)
        k1 += first * (logarithm - harmonic - 0.5 / (k + 1))
        harmonic += 1 / (k + 1)
        term *= quarter / (k + 1) ** 2
    return i0, i1, k0, k1


def incompressible_waves(inertia: complex, modulus: complex, k: complex, r: float) -> np.ndarray:
    """Rows (u_r, u_z, sigma_rr, sigma_rz) and a column for each wave in r that s u = -grad p + m lap u, div u = 0
    allow: I_0 and K_0 as potential, then each as shear. s: `inertia`, i w rho of a liquid, -w^2 rho of a solid."""
    columns = []
    kappa = np.sqrt(k * k + inertia / modulus)
    for potential, x in ((True, k * r), (False, kappa * r)):
        i0, i1, k0, k1 = modified_bessel(x)
        for value, slope in ((i0, i1), (k0, -k1)):
            second = value - slope / x
            if potential:
                u_r, u_z, p = -k / inertia * slope, 1j * k / inertia * value, value
                along_r, shear = -k * k / inertia * second, 2j * k * k / inertia * slope
            else:
                u_r, u_z, p = 1j * k / kappa * slope, value, 0.0
                along_r, shear = 1j * k * second, (kappa + k * k / kappa) * slope
            columns.append([u_r, u_z, -p + 2 * modulus * along_r, modulus * shear])
    return np.array(columns).T


def compressible_waves(density: float, shear: complex, lame: complex, omega: float, k: complex, r: float) -> np.ndarray:
    """Like incompressible_waves(), for an elastic solid, u = grad f + curl (g e_theta),
    sigma = lame div u 1 + 2 shear eps(u): with f of I_0 and K_0, then g of I_1 and K_1."""
    columns = []
    inertia = density * omega**2
    a = np.sqrt(k * k - inertia / (lame + 2 * shear) + 0j)
    i0, i1, k0, k1 = modified_bessel(a * r)
    for f, slope in ((i0, a * i1), (k0, -a * k1)):
        second = a * a * f - slope / r
        sigma_rr = lame * (a * a - k * k) * f + 2 * shear * second
        columns.append([slope, -1j * k * f, sigma_rr, -2j * shear * k * slope])
    b = np.sqrt(k * k - inertia / shear + 0j)
    i0, i1, k0, k1 = modified_bessel(b * r)
    for g, slope in ((i1, b * i0 - i1 / r), (k1, -b * k0 - k1 / r)):
        columns.append([1j * k * g, slope + g / r, 2j * shear * k * slope, shear * (k * k + b * b) * g])
    return np.array(columns).T


def lack(omega: float, liquid: np.ndarray, inner: np.ndarray, outer: Sequence[np.ndarray]) -> complex:
    """Zero where liquid and wall have a wave together: determinant of what they demand of each other.

    `liquid`, velocities, and `inner`, displacements: their waves at the wall's inner radius; those of K are no waves of
    a liquid that reaches the axis. `outer`: the two rows that vanish at the outer radius."""
    system = np.zeros((6, 6), dtype=complex)
    system[:4, :2] = liquid[:, [0, 2]]
    system[:2, 2:] = -1j * omega * inner[:2]
    system[2:4, 2:] = -inner[2:]
    system[4, 2:], system[5, 2:] = outer
    system /= np.abs(system).max(axis=0)
    return complex(np.linalg.det(system / np.abs(system).max(axis=1, keepdims=True)))


def root(function: Callable[[complex], complex], last: complex, k: complex) -> complex:
    """A zero of `function` by the secant method, from two values near it."""
    at_last = function(last)
    for _ in range(80):
        here = function(k)
        if abs(k - last) < 1e-13 * abs(k) or here == at_last:
            break
        k, last, at_last = k - here * (k - last) / (here - at_last), k, here
    return k


@dataclass(frozen=True)
class Swing:
    """Complex amplitudes p of e^(i w t), in Pa, in evenly spaced places z on the axis, in mm."""

    z: np.ndarray
    p: np.ndarray

    def between(self, first: float, last: float) -> "Swing":
        inside = (self.z >= first - 1e-9) & (self.z <= last + 1e-9)
        return Swing(self.z[inside], self.p[inside])


def swing_on_the_axis(run: SceneRun, period: float) -> Swing:
    """The pressure over the last period of a run, in ms, which swings with that period."""
    table = run.table("centerline_pressure.csv")
    z = np.unique(table["z_mm"])
    pressures = table["pressure_Pa"].reshape(-1, len(z))
    times = table["time_ms"].reshape(-1, len(z))[:, 0]
    last = times > times[-1] - period * (1 - 1e-9)
    t, omega = times[last], 2 * np.pi / period
    shapes = np.stack([np.cos(omega * t), np.sin(omega * t), np.ones_like(t)], axis=1)
    cosine, sine, _ = np.linalg.lstsq(shapes, pressures[last], rcond=None)[0]
    return Swing(z, cosine - 1j * sine)


def wave_number(swing: Swing, apart: float, others: Sequence[complex] = ()) -> complex:
    """k, in 1/mm, of p = A e^(-i k z) + B e^(i k z) with any A and B, by least squares of
    p(z - h) + p(z + h) = 2 cos(k h) p(z), where h is `apart`, in mm.

    `others`: wave numbers k' of further waves in p. p(z - h) + p(z + h) - 2 cos(k' h) p(z) is free of them, and has
    those that are sought with other amplitudes."""
    z, p = swing.z, swing.p
    n = int(round(apart / (z[1] - z[0])))
    h = n * (z[1] - z[0])
    for other in others:
        p = p[2 * n :] + p[: -2 * n] - 2 * np.cos(other * h) * p[n:-n]
    here, both = p[n:-n], p[2 * n :] + p[: -2 * n]
    k = complex(np.arccos(np.vdot(here, both) / (2 * np.vdot(here, here))) / h)
    return k if k.real > 0 else -k


def speed_and_attenuation(
    run: SceneRun, k: complex, exact: complex, omega: float, tolerances: tuple[float, float]
) -> list[Number]:
    """Speed and attenuation of a wave e^(i (w t - k z)) beside the exact ones; k in 1/mm, `omega` in 1/ms.
    `tolerances`: of the two, relative."""
    source = "dispersion relation"
    return [
        Number("phase speed", "mm/ms", run.program, omega / k.real, omega / exact.real, tolerances[0], source),
        Number("attenuation", "1/m", run.program, -1000 * k.imag, -1000 * exact.imag, tolerances[1], source),
    ]


def draw_swings(
    runs: Sequence[SceneRun], period: float, first: float, last: float, numbers: Sequence[complex]
) -> Figure:
    """Amplitudes along the axis, and the sum of waves of these numbers, there and back, that fits the first run best
    between `first` and `last`, in mm."""
    figure = Figure(figsize=(6.4, 3.6), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        swing = swing_on_the_axis(run, period)
        axes.plot(swing.z, np.abs(swing.p), style, color=color, label=run.words)
    inside = swing_on_the_axis(next(iter(runs)), period).between(first, last)
    waves = np.stack([np.exp(sign * 1j * k * inside.z) for k in numbers for sign in (-1, 1)], axis=1)
    fitted = waves @ np.linalg.lstsq(waves, inside.p, rcond=None)[0]
    label = f"{2 * len(numbers)} waves of exact k"
    axes.plot(inside.z[::8], np.abs(fitted[::8]), "o", color="black", mfc="white", label=label)
    axes.set_xlabel("place on the axis [mm]")
    axes.set_ylabel("pressure, amplitude [Pa]")
    axes.legend()
    return figure
