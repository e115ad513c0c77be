"""Viscoelastic tube: a pressure wave that its wall and its blood damp

The pressure at the inlet of a tube of 2 mm radius, 0.5 mm wall and 40 mm length swings once in 8 ms. Its wall is
neo-Hookean with a viscosity of Kelvin and Voigt's kind and one Maxwell branch; its outer face is held along the axis, as tissue
holds an artery. The wave runs towards the outlet, weakened by both, and partly back.

Pressures p along the axis are e^(i w t) times waves e^(-i k z) and e^(i k z), whatever their shares, so that p(z - h) + p(z + h) =
2 cos(k h) p(z): that finds the complex wave number k. Its real part is the frequency over the phase speed, its imaginary
part the attenuation.

The exact k is that of small waves in a thick viscoelastic tube filled with a viscous liquid (docs/theory.md, section 13.4):
potential and shear waves in both media, by Bessel functions, with the complex shear modulus
G = mu + i w eta/2 + G_1 i w tau/(1 + i w tau) of the wall.
"""

import numpy as np
from matplotlib.figure import Figure

from fsi_compare.studies.gallery.scene import Number

MESH = "geo tube.geo --order 2"
QUICK_MESH = "geo tube.geo --order 2 --set along=16 --set across=4 --set through=1"
QUICK = {"time.step": 0.25, "time.end": 32}

INNER, OUTER, PERIOD = 2.0, 2.5, 8.0  # mm, mm, ms
BLOOD, VISCOSITY, WALL = 1.0, 0.02, 1.1  # mg/mm^3, kPa ms, mg/mm^3
SHEAR, ETA, BRANCH, TIME = 40.0, 4.0, 30.0, 1.5  # kPa, kPa ms, kPa, ms
OMEGA = 2 * np.pi / PERIOD
FIRST, LAST, APART = 8.0, 32.0, 4.0  # mm along the axis: where waves are alone; h


def shear_modulus(omega):
    """Complex, of the wall."""
    rate = 1j * omega
    return SHEAR + rate * ETA / 2 + BRANCH * rate * TIME / (1 + rate * TIME)


def modified_bessel(z):
    """I_0, I_1, K_0 and K_1 of a complex number of moderate size, by their series."""
    quarter, logarithm, harmonic = z * z / 4, np.log(z / 2) + np.euler_gamma, 0.0
    term = 1.0 + 0j  # of I_0; that of I_1 is term z / (2 (k + 1))
    i0, i1, k0, k1 = 0j, 0j, 0j, 1 / z
    for k in range(80):
        first = term * z / (2 * (k + 1))
        i0 += term
        i1 += first
        k0 += term * (harmonic - logarithm)
        k1 += first * (logarithm - harmonic - 0.5 / (k + 1))
        harmonic += 1 / (k + 1)
        term *= quarter / (k + 1) ** 2
    return i0, i1, k0, k1


def waves(inertia, modulus, k, r):
    """Rows (u_r, u_z, sigma_rr, sigma_rz) and a column for each wave in r that s u = -grad p + m lap u, div u = 0 allow: of
    I_0 and K_0, each as potential and as shear."""
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


def lack(k, omega):
    """Zero where blood and wall have a wave of this number: determinant of what they demand of each other."""
    blood = waves(1j * omega * BLOOD, VISCOSITY, k, INNER)[:, [0, 2]]  # regular on the axis
    wall = waves(-WALL * omega**2, shear_modulus(omega), k, INNER)
    outside = waves(-WALL * omega**2, shear_modulus(omega), k, OUTER)
    system = np.zeros((6, 6), dtype=complex)
    system[:4, :2] = blood
    system[:2, 2:] = -1j * omega * wall[:2]
    system[2:4, 2:] = -wall[2:]
    system[4, 2:], system[5, 2:] = outside[1], outside[2]  # held along the axis, free across
    system /= np.abs(system).max(axis=0)
    return np.linalg.det(system / np.abs(system).max(axis=1, keepdims=True))


def wave_number(omega=OMEGA):
    """By the secant method, from that of a thin wall held along its axis, without viscosity of the blood."""
    stiffness = 4 * shear_modulus(omega) * (OUTER - INNER)
    last = omega / np.sqrt(stiffness / (2 * BLOOD * INNER))
    k, at_last = 1.05 * last, lack(last, omega)
    for _ in range(60):
        here = lack(k, omega)
        if abs(k - last) < 1e-13 * abs(k) or here == at_last:
            break
        k, last, at_last = k - here * (k - last) / (here - at_last), k, here
    return k


EXACT = wave_number()


def swings(run):
    """Places on the axis in mm, and complex amplitudes there of e^(i w t) in the last period, in Pa."""
    table = run.table("centerline_pressure.csv")
    z = np.unique(table["z_mm"])
    pressures = table["pressure_Pa"].reshape(-1, len(z))
    times = table["time_ms"].reshape(-1, len(z))[:, 0]
    last = times > times[-1] - PERIOD + 1e-9
    t = times[last]
    shapes = np.stack([np.cos(OMEGA * t), np.sin(OMEGA * t), np.ones_like(t)], axis=1)
    cosine, sine, _ = np.linalg.lstsq(shapes, pressures[last], rcond=None)[0]
    return z, cosine - 1j * sine


def measured(run):
    """k, by least squares of p(z - h) + p(z + h) = 2 cos(k h) p(z)."""
    z, p = swings(run)
    apart = int(round(APART / (z[1] - z[0])))
    apart_mm = apart * (z[1] - z[0])
    here = np.flatnonzero((z >= FIRST + apart_mm) & (z <= LAST - apart_mm))
    both = p[here - apart] + p[here + apart]
    cosine = np.vdot(p[here], both) / (2 * np.vdot(p[here], p[here]))
    k = np.arccos(cosine) / apart_mm
    return k if k.real > 0 else -k


def numbers(runs):
    found = []
    for run in runs:
        k = measured(run)
        for what, unit, value, exact, tolerance in (
            ("phase speed", "mm/ms", OMEGA / k.real, OMEGA / EXACT.real, 0.02 if runs.quick else 0.003),
            ("attenuation", "1/mm", -k.imag, -EXACT.imag, 0.03 if runs.quick else 0.005),
        ):
            found.append(Number(what, unit, run.program, float(value), float(exact), tolerance, "dispersion relation"))
    return found


def draw(runs):
    figure = Figure(figsize=(6.4, 3.6), layout="constrained")
    axes = figure.add_subplot()
    for run, style, color in zip(runs, ("-", "--"), ("black", "tab:orange")):
        z, p = swings(run)
        axes.plot(z, np.abs(p), style, color=color, label=run.program)
    z, p = swings(runs.first)
    inside = (z >= FIRST) & (z <= LAST)
    both = np.stack([np.exp(-1j * EXACT * z[inside]), np.exp(1j * EXACT * z[inside])], axis=1)
    fitted = both @ np.linalg.lstsq(both, p[inside], rcond=None)[0]
    axes.plot(z[inside][::8], np.abs(fitted[::8]), "o", color="black", mfc="white", label="two waves of the exact k")
    axes.set_xlabel("place on the axis [mm]")
    axes.set_ylabel("pressure, amplitude [Pa]")
    axes.legend()
    return figure
